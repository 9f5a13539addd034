// The page in a browser: drags, switches, files, nonsense, numbers, pictures and accessibility. `SELVEDGE_WEB` is the folder that
// build.sh writes. Screenshots of the page go into its folder `screenshots`.

import assert from "node:assert/strict";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { open, serve } from "./browser.mjs";

const built = process.env.SELVEDGE_WEB;
const pictures = join(built, "screenshots");
const axe = readFileSync(new URL("../node_modules/axe-core/axe.min.js", import.meta.url), "utf8");
const isFirefox = process.env.SELVEDGE_BROWSER === "firefox";
let server, browser;
before(async () => {
  mkdirSync(pictures, { recursive: true });
  server = await serve(join(built, "site"));
  browser = await open();
});
after(async () => {
  await browser?.close();
  server?.close();
});

/** Opens the page, hands it to `work`, and finds no error in the console and no request to elsewhere. */
async function visit(options, work) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, reducedMotion: "reduce", ...options });
  const page = await context.newPage();
  const problems = [];
  page.on("console", (message) => message.type() === "error" && problems.push(message.text()));
  page.on("pageerror", (error) => problems.push(error.message));
  page.on("request", (request) => {
    if (!/^(data|blob):/.test(request.url()) && !request.url().startsWith(server.address)) problems.push(`request to ${request.url()}`);
  });
  if (options.prepare) await page.addInitScript(options.prepare);
  await page.goto(server.address);
  await page.waitForFunction(() => document.documentElement.dataset.ready, null, { timeout: 60_000 });
  await work(page);
  await context.close();
  assert.deepEqual(problems, []);
}

const text = (page, id) => page.locator(`#${id}`).textContent();
const verdict = (page, name) => page.locator("#verdicts tr", { hasText: name }).locator("td").first().textContent();
const until = (page, id, pattern) =>
  page.waitForFunction(([id, source]) => new RegExp(source).test(document.getElementById(id).textContent), [id, pattern.source], { timeout: 60_000 });

test("the pair: a newcomer finds out why the plain filter misses a contact", () => visit({}, async (page) => {
  assert.equal(await verdict(page, "the paper's filter"), "keeps the pair");
  assert.match(await verdict(page, "certified time of impact"), /^not before 0\.[45]/);
  const missed = page.locator("#case optgroup").nth(1).locator("option");
  assert.ok(await missed.count() > 0);
  await page.selectOption("#case", await missed.first().getAttribute("value"));
  assert.match(await text(page, "explanation"), /paper's filter drops it: a contact is missed/);
  assert.equal(await verdict(page, "the paper's filter"), "drops the pair");
  assert.equal(await verdict(page, "certified filter"), "keeps the pair");
  assert.equal(await verdict(page, "exact verdict"), "touches");
  await page.locator("#pair").screenshot({ path: join(pictures, "missed.png") });
}));

test("the pair: points are dragged and moved by keys, and NaN is never dropped", () => visit({}, async (page) => {
  const input = page.locator("#coordinates input").nth(5); // The vertex's z at the end.
  await page.locator("summary").click();
  await page.evaluate(() => scrollTo(0, 0));
  assert.ok(Number(await input.inputValue()) < 0);
  const handle = await page.locator('.point[data-frame="end"][data-point="0"]').boundingBox();
  await page.mouse.move(handle.x + handle.width / 2, handle.y + handle.height / 2);
  // Above the plane of the triangle at both ends: no contact any more.
  await page.mouse.down();
  await page.mouse.move(handle.x, handle.y - 260, { steps: 8 });
  await page.mouse.up();
  assert.ok(Number(await input.inputValue()) > 0);
  assert.equal(await verdict(page, "exact verdict"), "never touches");
  assert.equal(await verdict(page, "certified filter"), "drops the pair");
  await page.locator('.point[data-frame="end"][data-point="0"]').focus();
  for (let i = 0; i < 40; i++) await page.keyboard.press("ArrowDown");
  assert.equal(await verdict(page, "exact verdict"), "touches");
  await input.fill("abc");
  await input.press("Tab");
  assert.match(await verdict(page, "exact verdict"), /not finite/);
  assert.equal(await verdict(page, "certified filter"), "keeps the pair");
  assert.match(await text(page, "explanation"), /not finite/);
}));

const OBJ = (height) => `v -5 -5 0\nv 5 -5 0\nv 0 5 0\nv 0 0 ${height}\nv 1 0 ${height}.1\nv 0 1 ${height}.2\nf 1 2 3\nf 4 5 6\n`;
const file = (name, content) => ({ name, mimeType: "application/octet-stream", buffer: Buffer.from(content) });

test("the step: methods side by side, own files, and nonsense", () => visit({}, async (page) => {
  await until(page, "step-summary", /1,345 triangles/);
  const rows = () => page.locator("#stages tbody tr").count();
  assert.equal(await rows(), 5);
  const [all, , boxes, filtered] = await page.locator("#stages tbody td:nth-child(2)").allTextContents();
  const number = (words) => Number(words.replaceAll(",", ""));
  assert.ok(number(all) > number(boxes) && number(boxes) > number(filtered));
  await page.selectOption("#method", "selvedge");
  await until(page, "step-summary", /is certified/);
  await page.locator("#all-methods").click();
  await page.waitForFunction(() => document.querySelectorAll("#methods tbody tr").length === 11, null, { timeout: 60_000 });
  await page.locator("#step").screenshot({ path: join(pictures, "step.png") });

  await page.setInputFiles("#files", [file("a.obj", OBJ(1)), file("b.obj", OBJ(-1))]);
  await until(page, "step-summary", /a\.obj to b\.obj: 2 triangles, 3 contacts/);
  const say = (pattern) => until(page, "step-message", pattern);
  await page.setInputFiles("#files", [file("text.ply", "hello, this is text"), file("b.ply", "")]);
  await say(/text\.ply: .*/);
  await page.setInputFiles("#files", [file("a.obj", OBJ(1).replace("v 0 5 0", "v 0 nan 0")), file("b.obj", OBJ(-1))]);
  await say(/a\.obj: line 3/);
  await page.setInputFiles("#files", [file("a.obj", OBJ(1)), file("b.obj", `${OBJ(1)}v 9 9 9\n`)]);
  await say(/6 vertices, the second 7/);
  await page.setInputFiles("#files", [file("a.obj", OBJ(1)), file("b.obj", OBJ(1).replace("f 4 5 6", "f 4 6 5"))]);
  await say(/their triangles differ/);
  await page.setInputFiles("#files", [file("a.obj", OBJ(1))]);
  await say(/Now drop the mesh at its end/);
  // The second file is dropped.
  const data = await page.evaluateHandle((content) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([content], "dropped.obj"));
    return transfer;
  }, OBJ(-1));
  await page.locator("#drop-here").dispatchEvent("drop", { dataTransfer: data });
  await until(page, "step-summary", /a\.obj to dropped\.obj: 2 triangles, 3 contacts/);
  await page.locator("#own-sleeve").click();
  await until(page, "step-summary", /sleeve/);
}));

test("the step: a mesh of a million triangles is answered, and refused where a method cannot", () => visit({}, async (page) => {
  await until(page, "step-summary", /sleeve/);
  // Made in the page, as binary PLY: a grid of 708 by 708 squares that shifts by little.
  await page.evaluate(() => {
    const cells = 708, side = cells + 1;
    const ply = (name, height) => {
      const header = `ply\nformat binary_little_endian 1.0\nelement vertex ${side * side}\nproperty float x\nproperty float y\nproperty float z\nelement face ${2 * cells * cells}\nproperty list uchar int vertex_indices\nend_header\n`;
      const vertices = new Float32Array(3 * side * side);
      for (let v = 0; v < side * side; v++) vertices.set([v % side, Math.floor(v / side), height], 3 * v);
      const faces = new DataView(new ArrayBuffer(13 * 2 * cells * cells));
      let at = 0;
      const face = (...corners) => {
        faces.setUint8(at, 3);
        corners.forEach((corner, i) => faces.setInt32(at + 1 + 4 * i, corner, true));
        at += 13;
      };
      for (let y = 0; y < cells; y++) {
        for (let x = 0; x < cells; x++) {
          const a = y * side + x;
          face(a, a + 1, a + side);
          face(a + 1, a + side + 1, a + side);
        }
      }
      return new File([header, vertices, faces], name);
    };
    const transfer = new DataTransfer();
    transfer.items.add(ply("one.ply", 0));
    transfer.items.add(ply("two.ply", 0.5));
    document.getElementById("files").files = transfer.files;
    document.getElementById("files").dispatchEvent(new Event("change"));
  });
  await page.waitForFunction(() => /1,002,528 triangles, 0 contacts/.test(document.getElementById("step-summary").textContent), null, { timeout: 120_000 });
  await page.selectOption("#method", "naive");
  await until(page, "step-message", /too many for this method/);
}));

test("the cloth: it runs, is certified, and an effect that is off costs nothing", () => visit({}, async (page) => {
  await page.locator("#cloth").scrollIntoViewIfNeeded();
  await page.locator("#one-step").click();
  await until(page, "certified", /^1 of 1$/);
  await page.locator("#play").click();
  await until(page, "time", /^0\.[1-9]/);
  await until(page, "effects", /stretch[\d.]+.*solve[^\d]*[\d.]+/s);
  const [certified, done] = (await text(page, "certified")).replaceAll(",", "").split(" of ").map(Number);
  assert.equal(certified, done);
  await page.locator('#effects input[data-effect="friction"]').click();
  await until(page, "effects", /friction0 \(off\)/);
  await until(page, "saved", /With friction off, a step takes \d+ µs; before it took \d+ µs/);
  await page.locator('#effects input[data-effect="friction"]').click();
  await until(page, "effects", /friction–/);
  // This is docs/page.png, from a quiet machine.
  await page.selectOption("#colours", "strain");
  await until(page, "time", /^0\.9|^[1-9]/);
  await page.locator("#play").click();
  await page.locator("#cloth").screenshot({ path: join(pictures, "cloth.png") });
  await page.selectOption("#colours", "contacts");
  await page.locator("#edges").check();
  await page.locator("#cloth").screenshot({ path: join(pictures, "contacts.png") });
}));

test("the cloth: scenes, a pulled sheet and a moved ball, by pointer and by keyboard", () => visit({}, async (page) => {
  await page.locator("#cloth").scrollIntoViewIfNeeded();
  for (const name of ["flag.toml", "walker.toml", "hammock.toml", "drop.toml"]) {
    await page.selectOption("#scene", name);
    await until(page, "time", /^0\.000/);
    await page.locator("#one-step").click();
    await until(page, "time", /^0\.00[1-9]/);
  }
  const canvas = page.locator("#cloth-canvas");
  const box = await canvas.boundingBox();
  await canvas.focus();
  await page.keyboard.press("g");
  for (let i = 0; i < 12; i++) await page.keyboard.press("ArrowUp");
  await page.locator("#play").click();
  await until(page, "time", /^0\.[2-9]/);
  const stretched = parseFloat(await text(page, "stretch"));
  assert.ok(stretched > 1.002 && stretched < 1.5, `${stretched}`);
  await canvas.focus();
  await page.keyboard.press("Escape");
  await page.keyboard.press("b");
  for (let i = 0; i < 5; i++) await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("b");
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 60, box.y + box.height / 2 - 80, { steps: 6 });
  await page.mouse.up();
  await until(page, "time", /^0\.[5-9]|^[1-9]/);
  const [certified, done] = (await text(page, "certified")).replaceAll(",", "").split(" of ").map(Number);
  assert.equal(certified, done);
}));

// Software draws slowly; without drawing the rest of a frame shows, as with a graphics card.
const withoutDrawing = () => {
  for (const name of ["drawElements", "drawArrays", "clear"]) WebGL2RenderingContext.prototype[name] = () => {};
};
for (const [what, prepare] of [["drawn", undefined], ["not drawn", withoutDrawing]]) {
  test(`the cloth, ${what}: the first frame comes soon, and frames leave time to spare`, () => visit({ reducedMotion: "no-preference", prepare }, async (page) => {
    const seconds = parseFloat((await text(page, "loaded")).match(/[\d.]+/));
    await page.locator("#cloth").scrollIntoViewIfNeeded();
    if ((await text(page, "play")) === "Play") await page.locator("#play").click();
    await until(page, "time", /^0\.[3-9]/);
    await page.waitForTimeout(1500);
    const [steps, drawing] = (await text(page, "frame-time")).match(/[\d.]+/g).map(Number);
    const rate = Number(await text(page, "frame-rate"));
    console.log(`${what}: ready after ${seconds} s; a frame of the sleeve: ${steps} ms of steps in the worker, ${drawing} ms on the page's thread; ${rate} frames drawn a second; ${await text(page, "pace")}`);
    // Rates depend on the machine: they are printed. Drawing by software does not hold the cloth back, only the processor does.
    if (process.env.SELVEDGE_TIMES !== "no") assert.ok(seconds < 1.5, `${seconds} s`);
  }));
}

for (const [width, colorScheme] of [[360, "light"], [800, "dark"], [1600, "light"]]) {
  test(`${width} pixels, ${colorScheme}: nothing sticks out, axe finds nothing, and the picture is as before`, () =>
    visit({ viewport: { width, height: 900 }, colorScheme, hasTouch: width === 360 }, async (page) => {
      await until(page, "step-summary", /1,345 triangles/);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(wide <= width, `${wide} pixels wide`);
      await page.screenshot({ path: join(pictures, `page-${width}.png`), fullPage: true });
      await page.addScriptTag({ content: axe });
      const { violations } = await page.evaluate(() => globalThis.axe.run());
      assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html.slice(0, 90)).join("; ")}`), []);
      await compare(page, width);
    }));
}

/** Compares the canvases with pictures made before, coarsely: fonts and drivers differ, shapes and colours do not. */
async function compare(page, width) {
  const coarse = (id) => page.evaluate(async (id) => {
    const canvas = document.getElementById(id);
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    const small = new OffscreenCanvas(16, 9).getContext("2d");
    // A canvas keeps its picture only until the page is shown.
    canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" }));
    canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight" }));
    await new Promise((done) => requestAnimationFrame(done));
    small.drawImage(canvas, 0, 0, 16, 9);
    return [...small.getImageData(0, 0, 16, 9).data];
  }, id);
  const path = new URL(`pictures/${width}.json`, import.meta.url);
  const now = { step: await coarse("step-canvas"), cloth: await coarse("cloth-canvas") };
  if (process.env.SELVEDGE_PICTURES === "write") {
    mkdirSync(new URL("pictures/", import.meta.url), { recursive: true });
    return writeFileSync(path, `${JSON.stringify(now)}\n`);
  }
  const expected = JSON.parse(readFileSync(path, "utf8"));
  for (const name of ["step", "cloth"]) {
    assert.ok(now[name].some((value) => value > 0), `${name}: the picture is empty`);
    if (isFirefox && width === 800) continue; // It is not dark there.
    const difference = now[name].reduce((sum, value, i) => sum + Math.abs(value - expected[name][i]), 0) / now[name].length;
    assert.ok(difference < 12, `${name}: the picture differs by ${difference.toFixed(1)} of 255`);
  }
}

test("without WebGL there are messages and numbers, not blanks", () => {
  const prepare = () => {
    HTMLCanvasElement.prototype.getContext = () => null;
  };
  return visit({ prepare }, async (page) => {
    await until(page, "step-summary", /1,345 triangles/);
    for (const section of ["step", "cloth"]) assert.ok(await page.locator(`#${section} .fallback`).isVisible());
    await page.locator("#one-step").click();
    await until(page, "certified", /^1 of 1$/);
  });
});

test("everything is reached by keyboard", () => visit({}, async (page) => {
  const reached = new Set();
  for (let i = 0; i < 120; i++) {
    await page.keyboard.press("Tab");
    reached.add(await page.evaluate(() => document.activeElement.id || document.activeElement.dataset.effect || document.activeElement.className?.baseVal));
  }
  const wanted = ["case", "placement", "moment", "pair-play", "point", "method", "bend", "files", "all-methods", "step-canvas", "scene", "colours",
    "report", "cloth-canvas", "play", "one-step", "restart", "speed", "edges", "repeat", "friction"];
  assert.deepEqual(wanted.filter((id) => !reached.has(id)), []);
}));

test("a report of `selvedge simulate` opens in the page", { skip: !process.env.SELVEDGE_REPORT }, () => visit({}, async (page) => {
  await page.setInputFiles("#report", process.env.SELVEDGE_REPORT);
  await page.locator("#scrub").waitFor();
  await page.locator("#one-step").click();
  assert.notEqual(await text(page, "time"), "0.000 s");
  await page.setInputFiles("#report", file("no.html", "<p>no report</p>"));
  await until(page, "cloth-message", /is not a report/);
}));

test("the package works in a bundle by Vite", async () => {
  const bundled = await serve(join(built, "bundle/dist"));
  const page = await browser.newPage();
  await page.goto(bundled.address);
  await page.waitForFunction(() => document.body.dataset.contacts === "3");
  await page.close();
  bundled.close();
});
