// Loads the module and starts the three experiments.

import init, * as selvedge from "./selvedge/selvedge.js";
import { startCloth } from "./cloth.js";
import { startPair } from "./pair.js";
import { startStep } from "./step.js";

const begin = performance.now();
try {
  const cloth = startCloth();
  await init();
  startPair(selvedge);
  startStep(selvedge.methodNames());
  await cloth;
  document.getElementById("loaded").textContent = `Ready after ${((performance.now() - begin) / 1000).toFixed(2)} s.`;
  document.documentElement.dataset.ready = "true";
} catch (error) {
  const failure = document.getElementById("failure");
  failure.textContent = `The page cannot start: ${error.message}. It needs WebAssembly with SIMD, and a server (not a file opened from disk).`;
  failure.hidden = false;
}
