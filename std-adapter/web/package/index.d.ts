import type { ModuleSource } from "./load.js";

export * from "./cloth/selvedge.js";

/**
 * Loads the WebAssembly module. Call it once, before anything else: calls before it throw an `InputError`.
 *
 * `source`: where the module comes from, if not from beside this file: a URL, a response, its bytes, or a compiled module.
 */
export function load(source?: ModuleSource): Promise<void>;
