// The page comes up: without an error on the console, within the weight that a phone can bear.
import assert from "node:assert/strict";
import { readdirSync, statSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { after, before, test } from "node:test";
import { DESKTOP, PHONE, launch, open, serve } from "./support.mjs";

/** All that can be fetched, the pictures too, as `hyperbody play` sends it: with brotli where the build has put that beside a file, bytes. */
const MOST_BYTES = 1.5e6;

/** A busy machine slows single loads: the fastest of so many is the page's own time. */
const LOADS = 3;

/** Milliseconds from the start of the page's load to its first slice. */
async function fastestLoad(page) {
  let fastest = Infinity;
  for (let k = 0; k < LOADS; k++) {
    await page.reload();
    const first = await page.waitForFunction(() => (window.hyperbody?.frame?.surface.positions.length ?? 0) > 0 && performance.now());
    fastest = Math.min(fastest, await first.jsonValue());
  }
  return fastest;
}

let browser, server;
before(async () => ([browser, server] = await Promise.all([launch(), serve()])));
after(async () => {
  await browser?.close();
  server?.close();
});

test("the first slice is drawn, and the console is clean", async (t) => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address);
  const took = await fastestLoad(page);
  const vertices = await page.evaluate(() => window.hyperbody.frame.surface.positions.length / 3);
  assert.ok(vertices > 0, "the first frame holds no triangle");
  assert.deepEqual(errors, []);
  // How long it took depends on the machine and what else it does: told, not tested.
  t.diagnostic(`the first slice took ${took.toFixed(0)} ms, the fastest of ${LOADS} loads`);
  await context.close();
});

test("on a phone of 360 px nothing sticks out", async () => {
  const context = await browser.newContext(PHONE);
  const { page, errors } = await open(context, server.address);
  const out = await page.evaluate(() =>
    [...document.querySelectorAll("#app button, #app canvas, #app input")]
      .filter((element) => element.checkVisibility())
      .map((element) => ({ name: element.getAttribute("aria-label") ?? element.className, box: element.getBoundingClientRect() }))
      .filter(({ box }) => box.width > 0 && (box.left < -1 || box.right > innerWidth + 1))
      .map(({ name }) => name),
  );
  assert.deepEqual(out, []);
  assert.deepEqual(errors, []);
  await context.close();
});

test("the page weighs at most 1.5 MB compressed", (t) => {
  const dist = fileURLToPath(new URL("../dist/", import.meta.url));
  const files = readdirSync(dist, { recursive: true, withFileTypes: true }).filter((entry) => entry.isFile());
  const sizes = new Map(files.map((entry) => join(entry.parentPath ?? entry.path, entry.name)).map((path) => [path, statSync(path).size]));
  const total = [...sizes].reduce((sum, [path, size]) => sum + (path.endsWith(".br") ? 0 : (sizes.get(`${path}.br`) ?? size)), 0);
  assert.ok([...sizes.keys()].some((path) => path.endsWith(".wasm.br")), "the engine is not packed");
  t.diagnostic(`the page weighs ${(total / 1e6).toFixed(3)} MB compressed`);
  assert.ok(total <= MOST_BYTES, `the page weighs ${(total / 1e6).toFixed(2)} MB compressed`);
});
