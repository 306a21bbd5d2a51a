// Where panels are, on wide, narrow and low pages: none covers another, and the panel of a body not the body that was touched. And
// the tour rings what it speaks of.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launch, open, serve, until, whereIs } from "./support.mjs";

let browser, server;
before(async () => ([browser, server] = await Promise.all([launch(), serve()])));
after(async () => {
  await browser?.close();
  server?.close();
});

const boxes = (page, ...kinds) => page.evaluate((wanted) => wanted.flatMap((kind) => [...document.querySelectorAll(kind)].filter((element) => element.checkVisibility()).map((element) => {
  const { left, top, right, bottom } = element.getBoundingClientRect();
  return { kind, left, top, right, bottom };
})), kinds);

const meet = (a, b) => a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1;

for (const [width, height] of [[1280, 800], [1024, 500], [740, 360], [360, 640]]) {
  test(`at ${width} × ${height} no panel covers another, or the body that was touched`, async () => {
    const context = await browser.newContext({ viewport: { width, height }, locale: "en-GB", serviceWorkers: "block" });
    const { page, errors } = await open(context, server.address, { scene: "hello4d" });
    await until(page, () => window.hyperbody.frame.time > 1.2);
    const bodies = await page.evaluate(() => window.hyperbody.scene.bodies.filter(({ kind }) => kind === "dynamic").map(({ id }) => id));
    const places = await Promise.all(bodies.map(async (id) => ({ id, ...(await whereIs(page, id)) })));
    places.sort((a, b) => a.x - b.x);
    for (const { x, y } of [places[0], places.at(-1)]) {
      await page.mouse.click(x, y);
      await until(page, () => window.hyperbody.selected !== null && document.querySelector(".body-panel"));
      const at = await whereIs(page, await page.evaluate(() => window.hyperbody.selected));
      const panels = await boxes(page, ".top-actions", ".brand", ".shapes", ".body-panel", ".strips", ".compass", ".transport");
      for (const one of panels) {
        assert.ok(one.left >= 0 && one.top >= 0 && one.right <= width && one.bottom <= height, `${one.kind} sticks out of the page`);
        assert.ok(!meet(one, { left: at.x - 5, right: at.x + 5, top: at.y - 5, bottom: at.y + 5 }), `${one.kind} covers the body`);
        for (const other of panels) assert.ok(one === other || !meet(one, other), `${one.kind} and ${other.kind} cover each other`);
      }
      await page.keyboard.press("Escape");
      await until(page, () => !document.querySelector(".body-panel"));
    }
    // What the page says lies over the world, and over no panel.
    await page.keyboard.press("Backspace");
    await page.locator(".notice").waitFor();
    const all = await boxes(page, ".notice", ".top-actions", ".strips", ".compass", ".transport", ".hint-line");
    for (const other of all.slice(1)) assert.ok(!meet(all[0], other), `the notice covers ${other.kind}`);
    assert.deepEqual(errors, []);
    await context.close();
  });
}

test("the tour rings what it speaks of: the strip, then a body, wherever they are", async () => {
  const context = await browser.newContext({ viewport: { width: 900, height: 600 }, locale: "en-GB", reducedMotion: "reduce", serviceWorkers: "block" });
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  await page.getByRole("button", { name: "Tour" }).click();
  const next = page.getByRole("button", { name: "Next" });
  const around = (kind) => until(page, (what) => {
    const [ring, inside] = [".ring", what].map((each) => document.querySelector(each)?.getBoundingClientRect());
    return ring && inside && ring.width > 0 && ring.left < inside.left && ring.right > inside.right && ring.top < inside.top && ring.bottom > inside.bottom;
  }, kind);
  await next.click();
  await around(".strip");
  // Who asked for less motion sees it stand still.
  assert.equal(await page.evaluate(() => getComputedStyle(document.querySelector(".ring")).animationName), "none");
  for (let k = 0; k < 3; k++) await next.click();
  await until(page, () => {
    const ring = document.querySelector(".ring.round")?.getBoundingClientRect();
    return ring && window.hyperbody.scene.bodies.some(({ id, kind }) => {
      const place = kind === "dynamic" && window.hyperbody.whereIs(id);
      return place && Math.hypot(ring.x + ring.width / 2 - place.x, ring.y + ring.height / 2 - place.y) < 5;
    });
  });
  await page.getByRole("button", { name: "End tour" }).click();
  await page.locator(".ring").waitFor({ state: "detached" });
  assert.deepEqual(errors, []);
  await context.close();
});
