/** A type of the program's environment, if it is declared there: the DOM's, Node's, or none. */
type Declared<Name extends string> = typeof globalThis extends { [name in Name]: { prototype: infer Type } } ? Type : never;
type CompiledModule = typeof globalThis extends { WebAssembly: { Module: { prototype: infer Type } } } ? Type : never;

/** A URL, a response, bytes, or a compiled module. */
export type ModuleSource = string | Declared<"URL"> | Declared<"Response"> | ArrayBuffer | ArrayBufferView | CompiledModule;
