import init from "./cloth/selvedge.js";
import { loadModule } from "./load.js";

export * from "./cloth/selvedge.js";

/** Loads the WebAssembly module. Call it once, before anything else. */
export function load(source) {
  return loadModule(init, new URL("./cloth/selvedge_bg.wasm", import.meta.url), source);
}
