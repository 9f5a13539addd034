"use strict";

/** Returns the data blocks of a page: the header with the arrays added. Numbers are little endian. */
function readRecording(page = document) {
  const text = (id) => page.getElementById(id).textContent;
  const buffer = (id) => {
    const binary = atob(text(id));
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
    return bytes.buffer;
  };
  const recording = JSON.parse(text("recording"));
  recording.triangles = new Uint32Array(buffer("triangles"));
  recording.bounds = new Float32Array(buffer("bounds"));
  recording.positions = new Uint16Array(buffer("positions"));
  const values = new Float32Array(buffer("values"));
  const each = recording.series.length ? values.length / recording.series.length : 0;
  recording.series.forEach((series, i) => {
    series.values = values.subarray(i * each, (i + 1) * each);
  });
  const measured = new Float32Array(buffer("measured"));
  const count = recording.measuredSteps.length;
  recording.measures.forEach((measure, i) => {
    measure.values = measured.subarray(i * count, (i + 1) * count);
    measure.steps = recording.measuredSteps;
  });
  recording.write = (frame, out) => writeFrame(recording, frame, out);
  recording.frameTimes = recording.frameSteps.map((step) => step * recording.timeStep);
  return recording;
}

/** Writes the positions of a frame into `out`, three numbers a vertex. */
function writeFrame(recording, frame, out) {
  const [x, y, z, width, height, depth] = recording.bounds.subarray(6 * frame, 6 * frame + 6);
  const count = 3 * recording.vertices;
  const packed = recording.positions.subarray(count * frame, count * (frame + 1));
  for (let i = 0; i < count; i += 3) {
    out[i] = x + (packed[i] / 65535) * width;
    out[i + 1] = y + (packed[i + 1] / 65535) * height;
    out[i + 2] = z + (packed[i + 2] / 65535) * depth;
  }
}

/** Formats a number with three significant digits. */
function few(number) {
  if (!Number.isFinite(number)) return "–";
  const size = Math.abs(number);
  if (size >= 99.95) return Math.round(number).toLocaleString("en");
  if (size !== 0 && size < 1e-4) return number.toExponential(1);
  return String(Number(number.toPrecision(3)));
}

/** Formats a time in a suitable unit. */
function duration(seconds) {
  const [unit, name] = timeUnit(seconds);
  return Number.isFinite(seconds) ? `${few(seconds / unit)} ${name}` : "–";
}

function timeUnit(seconds) {
  return [[1, "s"], [1e-3, "ms"], [1e-6, "µs"]].find(([unit]) => seconds >= unit) ?? [1e-9, "ns"];
}

/** Returns 1, 2 or 5 times a power of ten, such that about `count` of them make `range`. */
function niceStep(range, count) {
  const rough = range / Math.max(count, 1);
  const power = 10 ** Math.floor(Math.log10(rough));
  return power * ([1, 2, 5].find((n) => n * power >= rough) ?? 10);
}
