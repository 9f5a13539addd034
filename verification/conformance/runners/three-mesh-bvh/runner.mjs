// three-mesh-bvh.
import { BufferAttribute, BufferGeometry, Matrix4, Vector3 } from 'three';
import { ExtendedTriangle, MeshBVH } from 'three-mesh-bvh';
import { serve, two } from './common.mjs';

function triangle(x, i) {
  const made = new ExtendedTriangle(...[i, i + 1, i + 2].map((k) => new Vector3(...x.slice(3 * k, 3 * k + 3))));
  made.needsUpdate = true;
  return made;
}

function geometry([x, index]) {
  const made = new BufferGeometry();
  made.setAttribute('position', new BufferAttribute(new Float32Array(x), 3));
  return made.setIndex(index);
}

await serve('0.9.17', {
  triangles: ({ x }) => {
    const [a, b] = [triangle(x, 0), triangle(x, 3)];
    return () => [a.intersectsTriangle(b, null, true), null];
  },
  meshes: (given) => {
    const [a, b] = two(given).map(geometry);
    const tree = new MeshBVH(a);
    const place = new Matrix4();
    return () => [tree.intersectsGeometry(b, place), null];
  },
});
