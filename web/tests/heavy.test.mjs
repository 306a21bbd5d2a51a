// Many bodies: what the worker needs for a frame is told; the page stays at hand with five hundred of them, and says so when the
// machine cannot keep up.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { DESKTOP, launch, open, serve, until } from "./support.mjs";
import { pile } from "./engine/pile.mjs";

/** Small: software graphics is slow, and not what is looked at here. */
const SMALL = { ...DESKTOP, viewport: { width: 640, height: 400 } };
const FRAMES = 120;

let browser, server;
before(async () => ([browser, server] = await Promise.all([launch(), serve()])));
after(async () => {
  await browser?.close();
  server?.close();
});

async function run(page, count, steps, sleeping) {
  await page.evaluate((text) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([text], "pile.json", { type: "application/json" }));
    window.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, cancelable: true }));
  }, pile(count, sleeping));
  await until(page, ([wanted, least]) => window.hyperbody.scene?.bodies.length === wanted && window.hyperbody.frame.step > least, [count + 1, steps]);
}

/** Keeps what every frame of the worker says of its cost: the page draws more seldom than frames come, and shows the newest. */
function rememberFrames() {
  const times = (globalThis.workerTimes = []);
  const Plain = globalThis.Worker;
  globalThis.Worker = class extends Plain {
    constructor(...given) {
      super(...given);
      this.addEventListener("message", ({ data }) => {
        if (data.type === "frame") times.push({ number: data.frame.number, step: data.frame.step, ...data.frame.workerMs });
      });
    }
  };
}

test("two hundred tesseracts: the worker's time for a frame is told", async (t) => {
  const context = await browser.newContext(SMALL);
  await context.addInitScript(rememberFrames);
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  // When the lower layers have landed.
  await run(page, 200, 80, true);
  const from = await page.evaluate(() => window.hyperbody.frame.number);
  await until(page, (last) => window.hyperbody.frame.number >= last, from + FRAMES);
  const frames = (await page.evaluate(() => globalThis.workerTimes)).filter(({ number }) => number >= from);
  // A busy machine takes several steps for a frame: what counts is one step and one picture.
  const whole = frames.slice(1).map((frame, index) => ({ ...frame, steps: frame.step - frames[index].step })).filter(({ steps }) => steps >= 1);
  assert.ok(whole.length > FRAMES / 2, `of ${frames.length} frames ${whole.length} had a step`);
  const sums = whole.map(({ steps, physics, slicing }) => physics / steps + slicing).sort((a, b) => a - b);
  const quantile = (share) => sums[Math.floor(share * (sums.length - 1))].toFixed(2);
  t.diagnostic(`worker time of a frame with one step, ms: median ${quantile(0.5)}, 95 % below ${quantile(0.95)}, of ${sums.length} frames`);
  assert.deepEqual(errors, []);
  await context.close();
});

test("with five hundred, no input is lost; and a machine that cannot keep up says so", async (t) => {
  const context = await browser.newContext(SMALL);
  const { page, errors } = await open(context, server.address, { scene: "hello4d", query: "&speed=4" });
  await run(page, 500, 30, false);
  // Four times real time is more than any machine has for them while none of them may sleep.
  await page.locator(".warning").filter({ hasText: "too slow" }).waitFor();
  const waits = [];
  const answered = async (act, seen, argument) => {
    const start = Date.now();
    await act();
    await until(page, seen, argument);
    waits.push(Date.now() - start);
  };
  const step = await page.evaluate(() => window.hyperbody.frame.step);
  for (let k = 1; k <= 5; k++) {
    const selected = await page.evaluate(() => window.hyperbody.selected);
    await answered(() => page.keyboard.press("n"), (before) => window.hyperbody.selected !== before && window.hyperbody.frame.selected?.body === window.hyperbody.selected, selected);
    const place = await page.evaluate(() => window.hyperbody.slice.origin[3]);
    await answered(() => page.keyboard.press("e", { delay: 120 }), (before) => window.hyperbody.frame.slice.origin[3] > before, place);
  }
  assert.ok((await page.evaluate(() => window.hyperbody.frame.step)) > step, "the world stood still meanwhile");
  await answered(() => page.keyboard.press("Space"), () => window.hyperbody.frame.paused);
  t.diagnostic(`from a key to the frame that shows it, ms: ${waits.join(", ")}`);
  assert.deepEqual(errors, []);
  await context.close();
});
