// Selvedge in WebAssembly. Argument: the built package's detector.js.
import { pathToFileURL } from 'node:url';
import { serve } from './common.mjs';

const { load, Detector, timeOfImpact } = await import(pathToFileURL(process.argv[2]));
await load();

const pair = (kind) => ({ x }) => {
  const [start, end] = [x.slice(0, 12), x.slice(12)].map((points) => Float64Array.from(points));
  return () => {
    const time = timeOfImpact(kind, start, end);
    return [time !== undefined, time];
  };
};

/** A detector with its positions. The one before is freed. */
let last;
function detector(vertices, faces, start, end) {
  last?.free();
  last = new Detector(vertices, Uint32Array.from(faces.flat()));
  return [last, Float64Array.from(start), Float64Array.from(end)];
}

const atRest = ({ x, faces }) => {
  const [made, start] = detector(x.length / 3, faces, x, x);
  return () => [made.hasIntersections(start), null];
};

await serve('of this repository', {
  'vertex-face': pair('vertex-face'),
  'edge-edge': pair('edge-edge'),
  triangles: atRest,
  meshes: atRest,
  'moving-triangle': ({ x, faces }) => {
    const moved = x.slice(0, 18).map((value, i) => (i < 9 ? value : value + x[18 + (i % 3)]));
    const [made, start, end] = detector(6, faces, x.slice(0, 18), moved);
    return () => {
      if (made.hasIntersections(start)) return [true, 0];
      const first = made.earliest(start, end);
      return [first !== undefined, first?.time];
    };
  },
  'moving-mesh': ({ x, faces, vertices }) => {
    const [made, start, end] = detector(vertices, faces, x.slice(0, 3 * vertices), x.slice(3 * vertices));
    return () => {
      const first = made.earliest(start, end);
      return [first !== undefined, first?.time];
    };
  },
});
