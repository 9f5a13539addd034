/** Loads a module from its URL: from the disk in Node, otherwise by the network. */
export async function loadModule(init, url, source) {
  if (source === undefined && url.protocol === "file:" && typeof process !== "undefined") {
    // Bundlers need not follow this import.
    const files = "node:fs/promises";
    source = await (await import(/* @vite-ignore */ /* webpackIgnore: true */ files)).readFile(url);
  }
  await init({ module_or_path: source ?? url });
}
