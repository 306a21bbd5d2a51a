// What the page does when things go wrong: the engine stops, a link carries too much, a file is too large, nobody looks.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { deflateRawSync } from "node:zlib";
import { DESKTOP, launch, open, pictures, serve, until } from "./support.mjs";

let browser, server;
before(async () => ([browser, server] = await Promise.all([launch(), serve()])));
after(async () => {
  await browser?.close();
  server?.close();
});

const scene = (name, position) => JSON.stringify({
  format: "hyperbody-scene", version: 1, name, dimension: 4,
  bodies: [{ name: "only", shape: { ball: { radius: 0.5 } }, position }],
});
const link = (text) => `#scene=${deflateRawSync(text).toString("base64url")}`;

/** Makes the engine's loop fail inside the worker, as a broken program would: it is sent what it cannot digest. */
const stopEngine = (worker) => worker.evaluate(() => self.dispatchEvent(new MessageEvent("message", { data: { type: "recycle", buffers: 1 } })));

test("an engine that stops is started again with its scene, and says so", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  await until(page, () => window.hyperbody.frame.step > 200);
  // What lasts only for seconds is waited for from before it begins.
  const told = page.getByText("was started again").waitFor();
  const anew = until(page, () => window.hyperbody.sceneName === "hello4d" && window.hyperbody.frame.step < 200);
  await stopEngine(page.workers()[0]);
  await Promise.all([told, anew]);
  const step = await page.evaluate(() => window.hyperbody.frame.step);
  await until(page, (before) => window.hyperbody.frame.step > before + 20, step);
  assert.equal(page.workers().length, 1, "the worker that stopped is still there");
  assert.deepEqual(errors, []);
  await context.close();
});

test("a scene that always stops the engine gives way to another, and its text stays in the editor", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page } = await open(context, `${server.address}`, { scene: "dice4d" });
  const text = scene("Breaker", [0, 3, 0, 0]);
  await page.evaluate((hash) => (location.hash = hash), link(text));
  for (let times = 1; times <= 2; times++) {
    await until(page, () => window.hyperbody.scene?.title === "Breaker");
    const workers = page.workers();
    const told = page.getByText(times === 1 ? "was started again" : "another one runs now").waitFor();
    await stopEngine(workers[workers.length - 1]);
    await told;
  }
  await until(page, () => window.hyperbody.sceneName === "dice4d");
  await page.keyboard.press("x");
  assert.equal(await page.getByTestId("editor-text").inputValue(), text);
  await page.keyboard.press("Escape");
  // It is not started for ever: the fourth time in a minute a person has to ask for it.
  for (let times = 3; times <= 4; times++) {
    await until(page, () => window.hyperbody.frame.step > 3);
    const workers = page.workers();
    const told = times === 3 && page.getByText("was started again").waitFor();
    await stopEngine(workers[workers.length - 1]);
    await told;
  }
  await page.getByRole("button", { name: "Start the engine again" }).click();
  await until(page, () => document.querySelector(".failure") === null && window.hyperbody.frame.step > 3);
  await context.close();
});

test("a link opened in the same tab runs, and leaves the address with the next scene", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  await page.evaluate((hash) => (location.hash = hash), link(scene("From a link", [0, 3, 0, 0])));
  await until(page, () => window.hyperbody.scene.title === "From a link");
  assert.match(page.url(), /#scene=/);
  await page.keyboard.press("c");
  await page.locator("[data-scene=dice4d]").click();
  await until(page, () => window.hyperbody.sceneName === "dice4d");
  assert.match(page.url(), /\?scene=dice4d$/);
  await page.reload();
  await until(page, () => window.hyperbody?.sceneName === "dice4d");
  assert.deepEqual(errors, []);
  await context.close();
});

test("a link that unpacks to gigabytes, and a file that is none of a scene's size, are turned away", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  const bomb = link(Buffer.alloc(60e6, " "));
  assert.ok(bomb.length < 100_000);
  await page.evaluate((hash) => (location.hash = hash), bomb);
  await page.getByText("is damaged").waitFor();
  await page.evaluate(() => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([new Uint8Array(9e6)], "huge.json"));
    window.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, cancelable: true }));
  });
  await page.getByText("huge.json is larger than 8 MB").waitFor();
  assert.equal(await page.evaluate(() => window.hyperbody.sceneName), "hello4d");
  assert.deepEqual(errors, []);
  await context.close();
});

test("of two scenes asked for one after the other the later one runs, however slowly the first one comes", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "dice4d" });
  let letThrough;
  const waits = new Promise((resolve) => (letThrough = resolve));
  await page.route(/smash4d/, async (route) => {
    if (route.request().resourceType() !== "image") await waits;
    await route.continue();
  });
  const choose = async (name) => {
    await page.keyboard.press("c");
    await page.locator(`[data-scene=${name}]`).click();
  };
  await choose("smash4d");
  await choose("pyramid3d");
  await until(page, () => window.hyperbody.sceneName === "pyramid3d");
  letThrough();
  await page.waitForResponse(/smash4d.*js/);
  await pictures(page, 20);
  assert.equal(await page.evaluate(() => window.hyperbody.sceneName), "pyramid3d");
  assert.equal(await page.evaluate(() => window.hyperbody.scene.dimension), 3);
  assert.deepEqual(errors, []);
  await context.close();
});

test("a page that nobody sees does not simulate, and goes on where it was", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page } = await open(context, server.address, { scene: "hello4d" });
  const hide = (hidden) => page.evaluate((value) => {
    Object.defineProperty(document, "hidden", { configurable: true, value });
    document.dispatchEvent(new Event("visibilitychange"));
  }, hidden);
  await hide(true);
  const step = await page.evaluate(async () => (await window.hyperbody.hash()).step);
  await page.waitForTimeout(3000);
  assert.equal(await page.evaluate(async () => (await window.hyperbody.hash()).step), step);
  await hide(false);
  // A second late at most on a busy machine; what it missed are three.
  const first = await until(page, (before) => window.hyperbody.frame.step > before && window.hyperbody.frame.step, step);
  const after = await first.jsonValue();
  assert.ok(after < step + 60, `it made up for ${after - step} steps`);
  await context.close();
});
