import init from "./detector/selvedge.js";
import { loadModule } from "./load.js";

export * from "./detector/selvedge.js";

/** Loads the WebAssembly module. Call it once, before anything else. */
export function load(source) {
  return loadModule(init, new URL("./detector/selvedge_bg.wasm", import.meta.url), source);
}
