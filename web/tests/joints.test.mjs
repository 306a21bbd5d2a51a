// Joints are seen: the stem of the gyroscope, which is no body, leads from its post to its disc, also in Flatland; a key and a
// switch take it away.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { DESKTOP, idOf, launch, open, pictures, serve, until, whereIs } from "./support.mjs";

/** Where pictures differ, of a pixel's colours, and how far from the line between two points, pixels of the page. */
const DIFFERENT = 40;
const BESIDE = 14;
/** So slowly that the stem stands as it begins, seen from the side, whenever a busy machine comes to stop it. */
const SLOWLY = "&detail=1&speed=0.01";

let browser, server;
before(async () => ([browser, server] = await Promise.all([launch(), serve()])));
after(async () => {
  await browser?.close();
  server?.close();
});

/** Places where two pictures of the page differ. */
const differences = (page, pictures) => page.evaluate(async ([data, least]) => {
  const pixels = await Promise.all(data.map(async (one) => {
    const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${one}`)).blob());
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
    context.drawImage(bitmap, 0, 0);
    return context.getImageData(0, 0, bitmap.width, bitmap.height);
  }));
  const [{ data: one, width }, { data: other }] = pixels;
  const places = [];
  for (let at = 0; at < one.length; at += 4) {
    if ([0, 1, 2].some((k) => Math.abs(one[at + k] - other[at + k]) > least)) places.push({ x: (at / 4) % width, y: Math.floor(at / 4 / width) });
  }
  return places;
}, [pictures.map((picture) => picture.toString("base64")), DIFFERENT]);

/** How far a place is from the segment between two others. */
function fromSegment(place, a, b) {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const t = Math.min(1, Math.max(0, ((place.x - a.x) * dx + (place.y - a.y) * dy) / (dx * dx + dy * dy)));
  return Math.hypot(place.x - a.x - t * dx, place.y - a.y - t * dy);
}

/** The paused page with and without joints. */
async function bothPictures(page) {
  await page.keyboard.press("Space");
  await until(page, () => window.hyperbody.frame.paused);
  await page.addStyleTag({ content: "#app > :not(.flatland) { visibility: hidden }" });
  await pictures(page, 20);
  const drawn = await page.screenshot();
  await page.keyboard.press("4");
  await pictures(page, 20);
  return [drawn, await page.screenshot()];
}

test("the stem of the gyroscope leads from its post to its disc, and a key takes it away", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "gyroscope3d", query: SLOWLY });
  const [post, disc] = [await idOf(page, "post"), await idOf(page, "disc")];
  const places = await differences(page, await bothPictures(page));
  const [foot, middle] = [await whereIs(page, post), await whereIs(page, disc)];
  // The post is seen by its middle; the stem begins a metre above.
  const top = { x: foot.x, y: foot.y - Math.abs(middle.y - foot.y) };
  assert.ok(places.length > 30, `${places.length} pixels were the stem's`);
  for (const place of places) {
    const away = fromSegment(place, top, middle);
    assert.ok(away < BESIDE, `at ${place.x}, ${place.y} something else went too, ${away.toFixed(0)} pixels beside the stem`);
  }
  await page.addStyleTag({ content: "#app > * { visibility: visible !important }" });
  await page.getByRole("button", { name: "More" }).click();
  const choice = page.getByRole("switch", { name: "Joints" });
  assert.equal(await choice.isChecked(), false, "the key and the switch say the same");
  await choice.check();
  await page.keyboard.press("Escape");
  await page.reload();
  await until(page, () => (window.hyperbody?.frame?.number ?? 0) > 2);
  await page.getByRole("button", { name: "More" }).click();
  assert.equal(await page.getByRole("switch", { name: "Joints" }).isChecked(), true, "the choice is kept");
  assert.deepEqual(errors, []);
  await context.close();
});

test("in Flatland joints are drawn beside the plane and in it", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "gyroscope3d", query: SLOWLY });
  await page.getByRole("button", { name: "Flatland" }).click();
  const inset = await page.locator(".flatland").boundingBox();
  const places = await differences(page, await bothPictures(page));
  const within = places.filter(({ x, y }) => x > inset.x && x < inset.x + inset.width && y > inset.y && y < inset.y + inset.height);
  assert.ok(within.length > 20, `${within.length} pixels of the stem lay in Flatland's window`);
  assert.ok(places.length - within.length > 40, `${places.length - within.length} pixels of the stem lay beside it`);
  assert.deepEqual(errors, []);
  await context.close();
});
