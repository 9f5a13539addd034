// Rapier.
import R from '@dimforge/rapier3d-compat';
import { serve } from './common.mjs';

await R.init();
const ORIGIN = { x: 0, y: 0, z: 0 };
const UPRIGHT = { x: 0, y: 0, z: 0, w: 1 };
const point = (x, i) => ({ x: x[3 * i], y: x[3 * i + 1], z: x[3 * i + 2] });
const triangles = ({ x }) => [0, 3].map((i) => new R.Triangle(point(x, i), point(x, i + 1), point(x, i + 2)));

await serve(R.version(), {
  triangles: (given) => {
    const [a, b] = triangles(given);
    return () => [a.intersectsShape(ORIGIN, UPRIGHT, b, ORIGIN, UPRIGHT), null];
  },
  'moving-triangle': (given) => {
    const [a, b] = triangles(given);
    const step = point(given.x, 6);
    return () => {
      const hit = a.castShape(ORIGIN, UPRIGHT, ORIGIN, b, ORIGIN, UPRIGHT, step, 0, 1, true);
      return hit ? [true, hit.time_of_impact] : [false, null];
    };
  },
});
