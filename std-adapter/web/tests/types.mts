// Compiles with `tsc --strict`: the declarations of the package.

import { load, Detector, Simulation, pairVerdicts, type Contacts } from "selvedge";
import { load as loadDetector, timeOfImpact } from "selvedge/detector";
import { BufferAttribute, BufferGeometry } from "three";

await load();
await loadDetector(new URL("https://example.org/selvedge_bg.wasm"));
const detector: Detector = new Detector(6, Uint32Array.of(0, 1, 2, 3, 4, 5));
const contacts: Contacts = detector.contacts(detector.start, new Float32Array(18), true);
const first: number = contacts.time[0] ?? contacts.normal?.[0] ?? detector.earliest([], [])?.time ?? 1;
const verdict: "never" | "happens" | "undefined" = pairVerdicts("edge-edge", detector.start, detector.end).contact;
const time: number | undefined = timeOfImpact("vertex-face", [], []);
// @ts-expect-error: there is no such kind.
timeOfImpact("vertex-vertex", [], []);
// @ts-expect-error: this is no length.
detector.near(detector.start, "1");
const cloth = new Simulation("", { "shirt.ply": new Uint8Array() });
const geometry = new BufferGeometry();
geometry.setIndex(new BufferAttribute(cloth.triangles, 1));
geometry.setAttribute("position", new BufferAttribute(Float32Array.from(cloth.positions), 3));
const height: number | undefined = cloth.bodyMotion("ball")?.centre[2] ?? cloth.placement("ball")?.translation[2];
console.log(height, first, verdict, time, cloth.effectSeconds["stretch"]);
