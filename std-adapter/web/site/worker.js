// Runs steps and simulations beside the page, which stays responsive.

import init, * as selvedge from "./selvedge/selvedge.js";

const ready = init();
let simulation = null;
let certified = 0;
let hold = null;
let placed = {};

const functions = {
  armStep: selvedge.armStep,
  readMesh: selvedge.readMesh,
  runMethod: selvedge.runMethod,
  effectNames: selvedge.effectNames,

  /** Makes the scene and returns what does not change from step to step. */
  create(text, files) {
    simulation?.free();
    simulation = null;
    simulation = new selvedge.Simulation(text, files);
    certified = 0;
    hold = null;
    placed = {};
    const bodies = simulation.bodyNames.map((name) => ({ name, vertices: simulation.bodyVertices(name) }));
    const { triangles, clothVertexCount, clothTriangleCount, timeStep, steps, up, name } = simulation;
    return { triangles, clothVertexCount, clothTriangleCount, timeStep, steps, up, name, bodies, ...state() };
  },

  /** Lets seconds pass, in as many steps as the cloth needs; without seconds it runs one step of the scene. */
  run(seconds, wantsContacts) {
    const begin = performance.now();
    pull(seconds ?? simulation.timeStep);
    let done = 1;
    if (seconds === null) simulation.step(1);
    else done = simulation.advance(seconds, 32).steps;
    if (simulation.isCertified) certified += done;
    const milliseconds = performance.now() - begin;
    return { ...state(), done, milliseconds, contacts: wantsContacts ? simulation.nearPairs.vertices : null };
  },

  /** Holds the cloth around a vertex, or a driven body, and leads it to a point. `null` lets go. */
  hold(what) {
    if (what?.vertex !== undefined && hold?.vertex !== what.vertex) {
      const positions = simulation.positions.slice(0, 3 * simulation.clothVertexCount);
      const at = (v, i) => positions[3 * v + i];
      const near = [];
      for (let v = 0; v < simulation.clothVertexCount; v++) {
        const distance = Math.hypot(...[0, 1, 2].map((i) => at(v, i) - at(what.vertex, i)));
        if (distance <= what.reach) near.push(v);
      }
      what.vertices = Uint32Array.from(near);
    } else if (hold) {
      what = what && { ...hold, target: what.target };
    }
    hold = what;
  },
};

/** Leads what is held towards its target, at no more than 3 m/s. */
function pull(seconds) {
  if (!hold) return;
  const limited = (way, longest) => way.map((x) => x * Math.min(1, longest / Math.max(Math.hypot(...way), 1e-12)));
  if (hold.body !== undefined) {
    const from = placed[hold.body] ?? [0, 0, 0];
    const way = limited(hold.target.map((x, i) => x - from[i]), 3 * seconds);
    placed[hold.body] = from.map((x, i) => x + way[i]);
    simulation.placeBody(hold.body, placed[hold.body]);
  } else {
    const now = simulation.positions.subarray(3 * hold.vertex, 3 * hold.vertex + 3);
    const way = hold.target.map((x, i) => (x - now[i]) / (2 * seconds));
    simulation.setVelocity(hold.vertices, limited(way, 3));
  }
}

function state() {
  const { effectSeconds, solveSeconds, contactSeconds, time, stepsDone, isCertified, blockedSteps, contactCounts } = simulation;
  return {
    positions: new Float32Array(simulation.positions), effectSeconds, stageSeconds: { solve: solveSeconds, ...contactSeconds }, time, stepsDone, isCertified,
    certified, blockedSteps, hasContact: contactCounts !== undefined,
  };
}

onmessage = async ({ data: { id, name, values } }) => {
  await ready;
  try {
    const value = functions[name](...values);
    postMessage({ id, value }, value?.positions?.buffer instanceof ArrayBuffer ? [value.positions.buffer] : []);
  } catch (error) {
    postMessage({ id, error: { name: error.name, message: error.message, isFatal: error instanceof WebAssembly.RuntimeError } });
  }
};
