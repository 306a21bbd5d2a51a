// Mouse and touch: pulling a body moves it, and the panel tells so; a second finger pushes it along w.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { DESKTOP, PHONE, centreOf, idOf, launch, open, pictures, serve, until, whereIs } from "./support.mjs";

/** The place of w in a centre: three coordinates lie in the slice. */
const W = 3;

let browser, server;
before(async () => ([browser, server] = await Promise.all([launch(), serve()])));
after(async () => {
  await browser?.close();
  server?.close();
});

/** Waits until a body of the first scene lies still, so that it is where it was seen. */
const settle = (page) => until(page, () => window.hyperbody.frame.time > 1.2);

/** A finger takes what lies there, and goes up 20 pixels. It is sent at once: a finger that rests for half a second asks for a menu. */
const take = (touch, x, y) => Promise.all([touch("touchStart", [x, y, 1]), ...[1, 2, 3, 4].map((k) => touch("touchMove", [x, y - 5 * k, 1]))]);

const numbers = async (page, name) => {
  const text = await page.getByTestId(name).innerText();
  return [...text.replaceAll("−", "-").matchAll(/[a-z]\s*(-?\d+\.\d+)/g)].map((match) => Number(match[1]));
};

test("the mouse selects a body, pulls it, and the panel's numbers follow", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  await settle(page);
  const body = await idOf(page, "tesseract");
  const from = await whereIs(page, body);
  await page.mouse.click(from.x, from.y);
  await until(page, (id) => window.hyperbody.selected === id && window.hyperbody.frame.selected?.body === id, body);
  await page.getByTestId("body-panel").waitFor();
  const before = await centreOf(page, body);
  const shown = await numbers(page, "position");
  assert.equal(shown.length, 4);
  before.forEach((value, axis) => assert.ok(Math.abs(value - shown[axis]) < 0.02, `the panel says ${shown}, the world ${before}`));
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  for (let k = 1; k <= 12; k++) await page.mouse.move(from.x + k, from.y - 10 * k);
  await until(page, ([id, y]) => {
    const { frame } = window.hyperbody;
    for (let at = 0; at < frame.centres.length; at += 5) if (frame.centres[at] === id) return frame.centres[at + 2] > y;
    return false;
  }, [body, before[1] + 0.4]);
  assert.equal(await page.evaluate(() => window.hyperbody.frame.hands.length), 1);
  await page.waitForFunction((y) => Number(document.querySelector("[data-testid=position]")?.textContent?.replaceAll("−", "-").match(/y\s*(-?\d+\.\d+)/)?.[1]) > y, before[1] + 0.3);
  // The wheel pushes what is held out along w.
  await page.mouse.wheel(0, -600);
  await until(page, ([id, w]) => {
    const { frame } = window.hyperbody;
    for (let at = 0; at < frame.centres.length; at += 5) if (frame.centres[at] === id) return frame.centres[at + 4] > w;
    return false;
  }, [body, before[W] + 0.3]);
  await page.mouse.up();
  await until(page, () => window.hyperbody.frame.hands.length === 0);
  assert.deepEqual(errors, []);
  await context.close();
});

for (const scene of ["pyramid2d", "dominoes3d", "flatland_pile3d"]) {
  test(`the first drag of a newcomer, in ${scene}, moves what is under the pointer, and every body is where the page says`, async () => {
    const context = await browser.newContext(DESKTOP);
    const { page, errors } = await open(context, server.address, { scene });
    await page.keyboard.press("v");
    const bodies = await page.evaluate(() => window.hyperbody.scene.bodies.filter((body) => body.kind === "dynamic").map(({ id }) => id));
    const places = await Promise.all(bodies.map((body) => whereIs(page, body)));
    assert.ok(places.every(Boolean), "some body is nowhere");
    const body = bodies.at(-1);
    const before = await centreOf(page, body);
    await page.keyboard.press("p");
    await until(page, (id) => window.hyperbody.selected === id, body);
    await page.keyboard.down("Alt");
    // In short presses: held down on a busy machine, the key would carry it out of the picture before that is seen.
    for (let risen = 0; risen < 0.3; risen = (await centreOf(page, body))[1] - before[1]) {
      await page.keyboard.press("i");
      await pictures(page, 3);
    }
    await page.keyboard.up("Alt");
    const at = await whereIs(page, body);
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    for (let k = 1; k <= 8; k++) await page.mouse.move(at.x + 4 * k, at.y - 2 * k);
    await until(page, () => window.hyperbody.frame.hands.length === 1);
    await page.mouse.up();
    await until(page, () => window.hyperbody.frame.hands.length === 0);
    assert.deepEqual(errors, []);
    await context.close();
  });
}

test("in six dimensions what is held is pushed along w, v or u: by wheel and keys, along the strip that was touched last", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "dice6d" });
  await page.keyboard.press("v");
  await page.keyboard.press("n");
  await until(page, () => window.hyperbody.frame.selected?.body === window.hyperbody.selected);
  const start = await page.evaluate(() => window.hyperbody.frame.selected.position);
  const reaches = (axis) => until(page, ([which, least]) => window.hyperbody.frame.selected.position[which] > least, [axis, start[axis] + 0.4]);
  // Alt and E carry it along v once W has gone on from w, then along u.
  const carry = async (axis) => {
    await page.keyboard.down("Alt");
    await page.keyboard.down("e");
    await reaches(axis);
    await page.keyboard.up("e");
    await page.keyboard.up("Alt");
  };
  await page.keyboard.press("w");
  await page.getByText("now push along v").waitFor();
  await carry(4);
  await page.keyboard.press("w");
  await page.getByText("now push along u").waitFor();
  await carry(5);
  const { position } = await page.evaluate(() => window.hyperbody.frame.selected);
  assert.ok(Math.abs(position[3] - start[3]) < 0.3, `it went from ${start} to ${position}`);
  const box = await page.getByTestId("strip-0").boundingBox();
  await page.mouse.move(box.x + 5, box.y + 50);
  await page.mouse.down();
  await page.mouse.move(box.x + 5, box.y + 70);
  await page.mouse.up();
  await page.getByText("now push along w").waitFor();
  assert.deepEqual(errors, []);
  await context.close();
});

test("a second finger pushes what the first one holds along w", async () => {
  const context = await browser.newContext(PHONE);
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  await settle(page);
  const body = await idOf(page, "tesseract");
  const { x, y } = await whereIs(page, body);
  const before = await centreOf(page, body);
  const session = await context.newCDPSession(page);
  const touch = (type, ...points) => session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([px, py, id]) => ({ x: px, y: py, id })) });
  await take(touch, x, y);
  const second = [x + 90, 420];
  await touch("touchStart", [x, y - 20, 1], [...second, 2]);
  for (let k = 1; k <= 15; k++) await touch("touchMove", [x, y - 20, 1], [second[0], second[1] - 8 * k, 2]);
  await until(page, ([id, w]) => {
    const { frame } = window.hyperbody;
    for (let at = 0; at < frame.centres.length; at += 5) if (frame.centres[at] === id) return frame.centres[at + 4] > w;
    return false;
  }, [body, before[W] + 0.4]);
  await touch("touchEnd");
  await until(page, () => window.hyperbody.frame.hands.length === 0);
  assert.deepEqual(errors, []);
  await context.close();
});

test("a knob of the panel turns the selected body into w, by pointer and by key, and lets go", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  await settle(page);
  const body = await idOf(page, "tesseract");
  await page.keyboard.press("n");
  while ((await page.evaluate(() => window.hyperbody.selected)) !== body) await page.keyboard.press("n");
  const turned = (least) => until(page, (sine) => Math.abs(window.hyperbody.frame.selected.rotation[0][3]) > sine, least);
  const knob = page.getByRole("slider", { name: "Turn the body in xw" });
  const box = await knob.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let k = 1; k <= 10; k++) await page.mouse.move(x + 5 * k, y);
  await turned(0.35);
  assert.equal(await page.evaluate(() => window.hyperbody.frame.hands.length), 1);
  await page.mouse.up();
  await until(page, () => window.hyperbody.frame.hands.length === 0);
  await knob.focus();
  await page.keyboard.down("ArrowUp");
  for (let k = 0; k < 5; k++) await page.keyboard.down("ArrowUp");
  await turned(0.7);
  await page.keyboard.up("ArrowUp");
  await until(page, () => window.hyperbody.frame.hands.length === 0);
  assert.deepEqual(errors, []);
  await context.close();
});

test("keys move and turn the slice, and bring it home", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  await page.keyboard.down("e");
  await until(page, () => window.hyperbody.slice.origin[3] > 0.4);
  await page.keyboard.up("e");
  await page.keyboard.press("Shift+R");
  await until(page, () => Math.abs(window.hyperbody.slice.rows[0][3]) === 1);
  await page.keyboard.press("Home");
  await until(page, () => window.hyperbody.slice.rows.every((row, i) => row[i] === 1) && Math.abs(window.hyperbody.slice.origin[3]) < 1e-9);
  assert.deepEqual(errors, []);
  await context.close();
});

test("letters are those that are printed on the keys, on every keyboard; keys of other scripts count by their place", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  const key = (type, values) => page.evaluate(([what, which]) => document.body.dispatchEvent(new KeyboardEvent(what, { ...which, bubbles: true })), [type, values]);
  // Of Dvorak, where E lies at D's place; pressed and let go between two pictures.
  const e = { key: "e", code: "KeyD" };
  await page.evaluate((values) => ["keydown", "keyup"].forEach((what) => document.body.dispatchEvent(new KeyboardEvent(what, { ...values, bubbles: true }))), e);
  await until(page, () => window.hyperbody.slice.origin[3] > 0);
  await key("keydown", e);
  await until(page, () => window.hyperbody.slice.origin[3] > 0.4);
  await key("keyup", e);
  // Of AZERTY, whose A lies at Q's place, and is not Q: the slice stays.
  await key("keydown", { key: "q", code: "KeyA" });
  await until(page, () => window.hyperbody.slice.origin[3] < 0.2);
  await key("keyup", { key: "q", code: "KeyA" });
  // Russian: what lies at N's place selects the next body.
  await key("keydown", { key: "т", code: "KeyN" });
  await until(page, () => window.hyperbody.selected !== null);
  assert.deepEqual(errors, []);
  await context.close();
});

test("two fingers on something immovable move the camera, and aside a second finger turns what is held", async () => {
  const context = await browser.newContext(PHONE);
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  await settle(page);
  const session = await context.newCDPSession(page);
  const touch = (type, ...points) => session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([px, py, id]) => ({ x: px, y: py, id })) });
  const body = await idOf(page, "tesseract");
  // Turned: its first row no longer points along x.
  const { x, y } = await whereIs(page, body);
  await page.touchscreen.tap(x, y);
  await until(page, (id) => window.hyperbody.frame.selected?.body === id, body);
  await take(touch, x, y);
  await touch("touchStart", [x, y - 20, 1], [60, 500, 2]);
  for (let k = 1; k <= 15; k++) await touch("touchMove", [x, y - 20, 1], [60 + 10 * k, 500, 2]);
  await until(page, () => Math.abs(window.hyperbody.frame.selected.rotation[0][2]) > 0.5);
  await touch("touchEnd");
  await until(page, () => window.hyperbody.frame.hands.length === 0);
  // Frozen, nothing moves it: two fingers on it bring the camera nearer instead.
  await page.keyboard.press("k");
  await until(page, () => window.hyperbody.frame.selected.frozen);
  const place = await whereIs(page, body);
  const bodies = [await idOf(page, "ball"), body];
  const spread = () => page.evaluate(([a, b]) => {
    const [p, q] = [window.hyperbody.whereIs(a), window.hyperbody.whereIs(b)];
    return Math.hypot(p.x - q.x, p.y - q.y);
  }, bodies);
  const before = await spread();
  await touch("touchStart", [place.x, place.y, 1]);
  await touch("touchStart", [place.x, place.y, 1], [place.x + 40, place.y, 2]);
  for (let k = 1; k <= 12; k++) await touch("touchMove", [place.x, place.y, 1], [place.x + 40 + 6 * k, place.y, 2]);
  await touch("touchEnd");
  // Fingers that went apart bring it nearer.
  await until(page, ([[a, b], least]) => {
    const [p, q] = [window.hyperbody.whereIs(a), window.hyperbody.whereIs(b)];
    return Math.hypot(p.x - q.x, p.y - q.y) >= least;
  }, [bodies, 1.1 * before]);
  assert.deepEqual(errors, []);
  await context.close();
});
