// Every scene of the gallery is opened by its card and runs five seconds of its time without an error.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { DESKTOP, launch, open, serve, until } from "./support.mjs";

const SECONDS = 5;
const LEAST_SCENES = 24;

let browser, server;
before(async () => ([browser, server] = await Promise.all([launch(), serve()])));
after(async () => {
  await browser?.close();
  server?.close();
});

test("every scene runs", async (t) => {
  // A small picture: what is tested is the worlds, and software graphics is slow.
  const context = await browser.newContext({ ...DESKTOP, viewport: { width: 480, height: 360 } });
  const { page, errors } = await open(context, server.address, { query: "&speed=4" });
  await page.keyboard.press("c");
  const names = await page.locator("[data-scene]").evaluateAll((cards) => cards.map((card) => card.dataset.scene));
  await page.keyboard.press("Escape");
  assert.ok(names.length >= LEAST_SCENES, `the gallery has ${names.length} scenes`);
  for (const name of names) {
    await t.test(name, async () => {
      await page.keyboard.press("c");
      await page.locator(`[data-scene=${name}]`).click();
      await until(page, (wanted) => window.hyperbody.sceneName === wanted, name);
      // Frames that come from now on are the new scene's.
      const number = await page.evaluate(() => window.hyperbody.frame.number);
      await until(page, ([before, seconds]) => window.hyperbody.frame.number > before && window.hyperbody.frame.time >= seconds, [number, SECONDS]);
      assert.deepEqual(await page.evaluate(() => [...window.hyperbody.frame.quarantined]), []);
      assert.deepEqual(errors.splice(0), []);
    });
  }
  await context.close();
});
