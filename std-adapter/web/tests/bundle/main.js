import { load, Detector } from "selvedge/detector";

await load();
const detector = new Detector(6, Uint32Array.of(0, 1, 2, 3, 4, 5));
const start = Float64Array.of(-5, -5, 0, 5, -5, 0, 0, 5, 0, 0, 0, 1, 1, 0, 1.1, 0, 1, 1.2);
document.body.dataset.contacts = detector.contacts(start, start.map((x, i) => (i >= 9 && i % 3 === 2 ? x - 2 : x))).count;
