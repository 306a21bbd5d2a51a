// The slice slider changes the section as it must: the section of a 24-cell in the page has the volume that the program
// `hyperbody slice` gives for the same hyperplane, and that of a ball the closed form.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { after, before, test } from "node:test";
import { centreOf, DESKTOP, idOf, launch, open, pictures, serve, until } from "./support.mjs";

const CELL = { polytope: { regular: "24-cell", circumradius: 1 } };
const scene = (shape) => JSON.stringify({ format: "hyperbody-scene", version: 1, name: "probe", dimension: 4, gravity: [0, 0, 0, 0], bodies: [{ name: "probe", kind: "static", shape, position: [0, 0, 0, 0] }] });

/** The program, where this repository builds it; HYPERBODY names another. */
const root = fileURLToPath(new URL("../../", import.meta.url));
const target = process.env.CARGO_TARGET_DIR ?? join(root, "target");
const program = [process.env.HYPERBODY, join(target, "release/hyperbody"), join(target, "debug/hyperbody")].find((path) => path && existsSync(path));

let browser, server;
before(async () => ([browser, server] = await Promise.all([launch(), serve()])));
after(async () => {
  await browser?.close();
  server?.close();
});

/** Volume inside triangles (divergence theorem: a sixth of the sum of their triple products). */
function volume(corners) {
  let sum = 0;
  for (let at = 0; at < corners.length; at += 9) {
    const [ax, ay, az, bx, by, bz, cx, cy, cz] = corners.slice(at, at + 9);
    sum += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
  }
  return Math.abs(sum) / 6;
}

/** Corners of the triangles of a binary STL file. */
function corners(stl) {
  const list = [];
  for (let k = 0; k < stl.readUInt32LE(80); k++) for (let i = 0; i < 9; i++) list.push(stl.readFloatLE(84 + 50 * k + 12 + 4 * i));
  return list;
}

/** Drops a scene onto the page and moves the slice by the strip's keys, a tenth of a metre each. */
async function section(page, shape, steps) {
  await page.evaluate((text) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([text], "probe.json", { type: "application/json" }));
    window.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, cancelable: true }));
  }, scene(shape));
  await until(page, () => window.hyperbody.scene?.bodies[0]?.name === "probe");
  await page.getByTestId("strip-0").focus();
  for (let k = 1; k <= steps; k++) {
    await page.keyboard.press("ArrowUp");
    await until(page, (w) => Math.abs(window.hyperbody.slice.origin[3] - w) < 1e-9, k / 10);
  }
  await until(page, (w) => Math.abs(window.hyperbody.frame.slice.origin[3] - w) < 1e-9 && window.hyperbody.frame.surface.positions.length > 0, steps / 10);
  return page.evaluate(() => Array.from(window.hyperbody.frame.surface.positions));
}

test("a 24-cell is cut as `hyperbody slice` cuts it", { skip: program ? false : process.env.CI ? false : "the program is not built here" }, async () => {
  assert.ok(program, "build the program first: cargo build -p hyperbody-cli");
  const folder = mkdtempSync(join(tmpdir(), "hyperbody-slice-"));
  try {
    writeFileSync(join(folder, "cell.json"), JSON.stringify(CELL));
    execFileSync(program, ["slice", join(folder, "cell.json"), "-o", join(folder, "cell.stl"), "--normal", "0,0,0,1", "--offset", "0.3"], { timeout: 60_000, stdio: "pipe" });
    const expected = volume(corners(readFileSync(join(folder, "cell.stl"))));
    const context = await browser.newContext(DESKTOP);
    const { page, errors } = await open(context, server.address, { scene: "hello4d" });
    const found = volume(await section(page, CELL, 3));
    assert.ok(expected > 0.1);
    assert.ok(Math.abs(found - expected) < 1e-4 * expected, `the page cuts ${found} m³, the program ${expected} m³`);
    assert.deepEqual(errors, []);
    await context.close();
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test("a ball of radius 1 is cut 0.6 off its middle into a ball of radius 0.8", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page } = await open(context, server.address, { scene: "hello4d" });
  const positions = await section(page, { ball: { radius: 1 } }, 6);
  const radii = positions.flatMap((_, at) => (at % 3 === 0 ? [Math.hypot(positions[at], positions[at + 1], positions[at + 2])] : []));
  assert.ok(Math.abs(Math.max(...radii) - 0.8) < 1e-5, `the farthest vertex is ${Math.max(...radii)} from the middle`);
  assert.ok(Math.abs(Math.min(...radii) - 0.8) < 1e-5, `the nearest vertex is ${Math.min(...radii)} from the middle`);
  await context.close();
});

test("the knobs say how the slice is turned", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  const knob = (name) => page.getByRole("slider", { name: `Turn the slice in ${name}` });
  assert.equal(await knob("yw").getAttribute("aria-valuenow"), "0");
  await page.keyboard.press("Shift+T");
  // To the last digit: a degree before its end the turn is told as 90, and its hand is still on the way.
  await until(page, () => document.querySelector(".compass [aria-label='Turn the slice in yw'] .knob-hand")?.getAttribute("transform") === "rotate(90)");
  assert.equal(await knob("yw").getAttribute("aria-valuenow"), "90");
  assert.equal(await knob("xw").getAttribute("aria-valuenow"), "0");
  assert.deepEqual(errors, []);
  await context.close();
});

/** Waits until a slice that was pushed has come to rest: for ten pictures it is where it was. A slice that follows something never is. */
const still = (page) => page.evaluate(async () => {
  for (let rest = 0, last = NaN; rest < 10; ) {
    await new Promise((resolve) => requestAnimationFrame(resolve));
    const now = window.hyperbody.slice.origin[3];
    rest = now === last ? rest + 1 : 0;
    last = now;
  }
});

test("the slice goes along with the double pendulum until somebody moves it, and again after a new start only if nobody did", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "pendulum4d" });
  const upper = await idOf(page, "upper");
  const w = () => page.evaluate(() => window.hyperbody.slice.origin[3]);
  // Where it is along w, seen from the slice; the lower rod draws it along.
  const away = async () => Math.abs((await centreOf(page, upper))[3]);
  await until(page, () => window.hyperbody.frame.time > 0.8 && Math.abs(window.hyperbody.slice.origin[3]) > 0.1);
  assert.ok((await away()) < 0.5, `the rod is ${await away()} m off the slice that follows it`);
  await page.keyboard.press("Backspace");
  await until(page, () => window.hyperbody.frame.time > 0.8 && Math.abs(window.hyperbody.slice.origin[3]) > 0.1);
  await page.keyboard.press("e");
  await still(page);
  const before = await w();
  await pictures(page, 20);
  assert.ok(Math.abs((await w()) - before) < 1e-6, "the slice still follows");
  await page.keyboard.press("Backspace");
  await until(page, () => window.hyperbody.frame.time > 0.5);
  assert.ok(Math.abs((await w()) - before) < 1e-6, "a new start forgot that the slice was moved");
  assert.deepEqual(errors, []);
  await context.close();
});
