// Pairs that touch, exactly, and that the paper's filter drops as printed: found among random ones, with few decimals.

const pair = (name, start, end) => ({
  name, placement: "1 m", kind: "vertex-face", exact: "touches", start: Float64Array.from(start), end: Float64Array.from(end),
});

export const MISSED = [
  pair("a vertex glides along a moving face",
    [-0.20000000000000007, 0.21999999999999997, 0.1, -0.4, -0.5, 0.8, -0.4, 0.7, -0.1, 0.6, 0.7, -0.9],
    [-0.28, 0.08000000000000006, 0.44, -0.4, -0.3, 0.3, -0.2, 0.4, 0.5, -0.2, 0.2, 0.6]),
  pair("a vertex moves in a face that turns",
    [0.58, -0.78, -0.8, 0.6, -1, -0.9, 0.1, 0.7, -0.1, 0.5, 0.1, -0.4],
    [0.41999999999999943, -0.6000000000000001, 0.56, 0.3, -1, 0.5, 0.9, 0.2, -0.4, 0.9, 1, 0.8]),
  pair("a vertex lifts off a resting face",
    [-0.4, 0.07, 0.15, 0.6, -0.7, 0, -1, 0.1, 0.6, -0.6, 0.8, -0.3],
    [-0.39999999999999974, 0.07, 0.15, 0.6, -0.7, 0, -1, 0.1, 0.6, -0.6, 0.8, -0.3]),
];
