// Compiles without the DOM's declarations and without a library newer than ES2022.

import { load, Detector, type Contacts } from "selvedge/detector";
import { Simulation } from "selvedge";

await load();
await load("selvedge_bg.wasm");
await load(new Uint8Array());
// @ts-expect-error: this is no source of a module.
await load(7);
const detector = new Detector(6, [0, 1, 2, 3, 4, 5]);
export const contacts: Contacts = detector.contacts(new Float64Array(18), new Float32Array(18));
detector[Symbol.dispose]();
export const cloth = new Simulation("", undefined);
