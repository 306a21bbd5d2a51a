// Flatland's picture: coloured is what the plane cuts, and nothing of what lies behind it, in whatever order surfaces are drawn.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { DESKTOP, launch, open, pictures, serve, until } from "./support.mjs";

/** Places that are looked at, across and down. */
const [COLUMNS, ROWS] = [22, 18];
/** At the edge of a figure picture and pointer may differ by a pixel of the picture. */
const EDGE = 5;

let browser, server;
before(async () => ([browser, server] = await Promise.all([launch(), serve()])));
after(async () => {
  await browser?.close();
  server?.close();
});

/** Whether the picture has a body's colour at each place and all around it: true, false, or null at an edge. The plane itself is grey. */
const coloured = (page, picture, places) => page.evaluate(async ([data, points, edge]) => {
  const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
  const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
  context.drawImage(bitmap, 0, 0);
  const at = (x, y) => {
    const [r, g, b] = context.getImageData(x, y, 1, 1).data;
    return Math.max(r, g, b) - Math.min(r, g, b) > 60;
  };
  return points.map(([x, y]) => {
    const around = [at(x, y), at(x - edge, y), at(x + edge, y), at(x, y - edge), at(x, y + edge)];
    return around.every((one) => one === around[0]) ? around[0] : null;
  });
}, [picture.toString("base64"), places, EDGE]);

for (const scene of ["flatland_pile3d", "flatland_solids3d"]) {
  test(`the cut of ${scene} is where the pointer finds bodies`, async () => {
    const context = await browser.newContext(DESKTOP);
    const { page, errors } = await open(context, server.address, { scene, query: "&detail=1" });
    await until(page, () => window.hyperbody.frame.time > 1.5);
    await page.keyboard.press("Space");
    await until(page, () => window.hyperbody.frame.paused);
    await pictures(page, 10);
    const inset = await page.locator(".flatland").boundingBox();
    const places = Array.from({ length: COLUMNS * ROWS }, (_, k) => [
      Math.round(inset.x + (inset.width * ((k % COLUMNS) + 0.5)) / COLUMNS), Math.round(inset.y + (inset.height * (Math.floor(k / COLUMNS) + 0.5)) / (ROWS + 2)),
    ]);
    const seen = await coloured(page, await page.screenshot(), places);
    const found = await page.evaluate((points) => points.map(([clientX, clientY]) => {
      const canvas = document.querySelector("canvas");
      canvas.dispatchEvent(new PointerEvent("pointermove", { clientX, clientY, pointerType: "mouse", bubbles: true }));
      return canvas.style.cursor === "grab";
    }), places);
    const clear = places.map((place, k) => ({ place, seen: seen[k], found: found[k] })).filter((one) => one.seen !== null);
    for (const { place, seen: body, found: pointed } of clear) {
      assert.equal(body, pointed, `at ${place} of the page the picture has ${body ? "a" : "no"} body, the pointer finds ${pointed ? "one" : "none"}`);
    }
    const within = clear.filter((one) => one.found).length;
    const without = clear.length - within;
    assert.ok(within > 20 && without > 100, `${within} places lay in bodies, ${without} beside them`);
    assert.deepEqual(errors, []);
    await context.close();
  });
}
