// Colours of strain and of contacts.

import { linear } from "./view.js";

const HOT = linear("#d02040", 0.9), COOL = linear("#2f7fd0", 0.9), TOUCH = linear("#d02040", 0.9);

/** The lengths of the cloth's edges relative to the first state. */
export class Strain {
  #ends;
  #rest;
  #vertices;

  constructor({ triangles, clothTriangleCount, positions }) {
    const seen = new Set();
    const ends = [];
    for (let i = 0; i < 3 * clothTriangleCount; i++) {
      const [a, b] = [triangles[i], triangles[i % 3 === 2 ? i - 2 : i + 1]];
      const key = Math.min(a, b) * 2 ** 26 + Math.max(a, b);
      if (!seen.has(key)) ends.push(a, b);
      seen.add(key);
    }
    this.#ends = Uint32Array.from(ends);
    this.#vertices = positions.length / 3;
    this.#rest = this.#lengths(positions);
  }

  #lengths(positions) {
    const ends = this.#ends;
    const lengths = new Float32Array(ends.length / 2);
    for (let i = 0; i < lengths.length; i++) {
      const a = 3 * ends[2 * i], b = 3 * ends[2 * i + 1];
      lengths[i] = Math.hypot(positions[a] - positions[b], positions[a + 1] - positions[b + 1], positions[a + 2] - positions[b + 2]);
    }
    return lengths;
  }

  /** Returns each edge's length relative to rest, and the largest. */
  measure(positions) {
    const ratios = this.#lengths(positions);
    let largest = 0;
    for (let i = 0; i < ratios.length; i++) {
      ratios[i] /= this.#rest[i];
      largest = Math.max(largest, ratios[i]);
    }
    return { ratios, largest };
  }

  /** Returns red where an edge is 10 % longer than at rest, blue where it is 10 % shorter. */
  tints(ratios) {
    const tints = new Float32Array(4 * this.#vertices);
    for (let i = 0; i < ratios.length; i++) {
      const colour = ratios[i] > 1 ? HOT : COOL;
      const share = Math.min(1, Math.abs(ratios[i] - 1) / 0.1) * 0.9;
      for (const vertex of [this.#ends[2 * i], this.#ends[2 * i + 1]]) {
        if (share > tints[4 * vertex + 3]) tints.set([colour[0], colour[1], colour[2], share], 4 * vertex);
      }
    }
    return tints;
  }
}

/** Returns red at the vertices of pairs that are near each other. */
export function contactTints(scene, vertices) {
  const tints = new Float32Array((4 * scene.positions.length) / 3 || 0);
  for (const vertex of vertices ?? []) tints.set(TOUCH, 4 * vertex);
  return tints;
}
