// Panels: language, scenes dropped and broken, back through time, gravity, the gallery.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { DESKTOP, launch, open, pictures, serve, until, whereIs } from "./support.mjs";

let browser, server;
before(async () => ([browser, server] = await Promise.all([launch(), serve()])));
after(async () => {
  await browser?.close();
  server?.close();
});

const drop = (page, text) => page.evaluate((content) => {
  const transfer = new DataTransfer();
  transfer.items.add(new File([content], "scene.json", { type: "application/json" }));
  window.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, cancelable: true }));
}, text);

const GOOD = `{
  "format": "hyperbody-scene", "version": 1, "name": "Dropped", "dimension": 4,
  "bodies": [
    {"name": "only", "shape": {"ball": {"radius": 0.5}}, "position": [0, 3, 0, 0]}
  ]
}`;

test("the language is the browser's, and can be switched", async () => {
  const context = await browser.newContext({ ...DESKTOP, locale: "zh-CN" });
  const { page, errors } = await open(context, server.address);
  await page.getByRole("button", { name: "场景", exact: true }).waitFor();
  assert.equal(await page.evaluate(() => document.documentElement.lang), "zh-CN");
  await page.getByRole("button", { name: "更多" }).click();
  await page.getByTestId("language").click();
  await page.getByRole("button", { name: "Scenes", exact: true }).waitFor();
  assert.equal(await page.evaluate(() => document.documentElement.lang), "en");
  assert.deepEqual(errors, []);
  await context.close();
});

test("a dropped scene runs; a broken one names its line and the running scene goes on", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address);
  await drop(page, GOOD);
  await until(page, () => window.hyperbody.scene.title === "Dropped");
  await drop(page, GOOD.replace('"radius": 0.5', '"radius": "half"'));
  const problem = page.getByTestId("problem");
  await problem.waitFor();
  assert.match(await problem.innerText(), /^Line 4: /);
  assert.equal(await page.evaluate(() => window.hyperbody.scene.title), "Dropped");
  const step = await page.evaluate(() => window.hyperbody.frame.step);
  await until(page, (before) => window.hyperbody.frame.step > before, step);
  // An unknown key too, wherever its object begins.
  await page.getByTestId("editor-text").fill(GOOD.replace('"bodies": [', '"gravty": [0, 0, 0, 0],\n  "bodies": ['));
  await page.keyboard.press("Control+Enter");
  await until(page, () => /^Line 3: .*gravty.*nearest known one is "gravity"/.test(document.querySelector("[data-testid=problem]").innerText));
  // Put right in the editor, it runs.
  await page.getByTestId("editor-text").fill(GOOD.replace("Dropped", "Mended"));
  await page.keyboard.press("Control+Enter");
  await until(page, () => window.hyperbody.scene.title === "Mended");
  assert.deepEqual(errors, []);
  await context.close();
});

test("a scene travels in a link", async () => {
  const context = await browser.newContext(DESKTOP);
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  const { page } = await open(context, server.address);
  await page.keyboard.press("x");
  await page.getByTestId("editor-text").fill(GOOD.replace("Dropped", "Travelled"));
  await page.getByRole("button", { name: "Copy link" }).click();
  await page.getByText("Link copied").waitFor();
  const link = await page.evaluate(() => navigator.clipboard.readText());
  assert.match(link, /#scene=/);
  assert.equal(new URL(page.url()).hash, "", "the address says what runs, and this text does not");
  await page.getByRole("button", { name: "Run scene" }).click();
  await until(page, () => window.hyperbody.scene.title === "Travelled");
  await page.getByRole("button", { name: "Copy link" }).click();
  await until(page, () => location.hash.startsWith("#scene="));
  assert.equal(page.url().split("#")[1], link.split("#")[1]);
  const second = await context.newPage();
  await second.goto(link);
  await until(second, () => window.hyperbody?.scene?.title === "Travelled");
  await context.close();
});

test("scrubbing shows an earlier moment, and running goes on from there", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  await until(page, () => window.hyperbody.frame.history.seconds > 1.5);
  const time = await page.getByTestId("scrub").evaluate((slider) => {
    slider.value = "-1";
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    return window.hyperbody.frame.time;
  });
  await until(page, () => window.hyperbody.frame.history.secondsBack > 0.8);
  const back = await page.evaluate(() => ({ time: window.hyperbody.frame.time, paused: window.hyperbody.frame.paused }));
  assert.ok(back.time < time, `the moment shown (${back.time} s) is not before ${time} s`);
  assert.equal(back.paused, true);
  await page.keyboard.press("Space");
  await until(page, (at) => !window.hyperbody.frame.paused && window.hyperbody.frame.time > at && window.hyperbody.frame.history.secondsBack === 0, back.time);
  assert.deepEqual(errors, []);
  await context.close();
});

test("gravity off: what is thrown up does not come down; added bodies can be undone", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  const bodies = await page.evaluate(() => window.hyperbody.scene.bodies.length);
  await page.keyboard.press("v");
  await page.locator("[data-shape=ball]").click();
  await until(page, (count) => window.hyperbody.scene.bodies.length === count + 1, bodies);
  await until(page, () => window.hyperbody.frame.selected !== null);
  // Half a second of fall would be 4.9 m/s.
  const added = await page.evaluate(() => window.hyperbody.frame.time);
  await until(page, (time) => window.hyperbody.frame.time > time + 0.5, added);
  const velocity = await page.evaluate(() => window.hyperbody.frame.selected.velocity.map(Math.abs));
  assert.ok(Math.max(...velocity) < 1, `a body added without gravity moves at ${velocity}`);
  await page.keyboard.press("Control+z");
  await until(page, (count) => window.hyperbody.scene.bodies.length === count, bodies);
  assert.deepEqual(errors, []);
  await context.close();
});

test("what is added appears in the picture, in the slice, above everything and inside nothing", async () => {
  const context = await browser.newContext(DESKTOP);
  for (const scene of ["dice4d", "flatland_pile3d", "pyramid2d"]) {
    const { page, errors } = await open(context, server.address, { scene, query: "&speed=0.01" });
    // Off the middle of the scene too.
    for (const turn of ["KeyE", "ArrowLeft"]) {
      await page.keyboard.press(turn === "KeyE" ? "e" : turn);
      const count = await page.evaluate(() => window.hyperbody.scene.bodies.length);
      await page.locator("[data-shape=ball]").click();
      await until(page, (before) => window.hyperbody.scene.bodies.length > before && window.hyperbody.frame.selected?.body === window.hyperbody.selected, count);
      const { body, off, lowest } = await page.evaluate(() => {
        const { frame, selected: id } = window.hyperbody;
        const stride = 4 + frame.slice.off.length;
        const all = Array.from({ length: frame.centres.length / stride }, (_, k) => Array.from(frame.centres.subarray(k * stride, (k + 1) * stride)));
        const its = all.find(([which]) => which === id);
        // How near other bodies' sections come to its middle.
        const { positions, ranges } = frame.surface;
        let nearest = Infinity;
        for (let range = 0; range < ranges.length; range += 3) {
          if (ranges[range] === id) continue;
          for (let at = 3 * ranges[range + 1]; at < 3 * (ranges[range + 1] + ranges[range + 2]); at += 3) {
            nearest = Math.min(nearest, Math.hypot(positions[at] - its[1], positions[at + 1] - its[2], positions[at + 2] - its[3]));
          }
        }
        return { body: id, off: its.slice(4), lowest: nearest };
      });
      const { x, y } = await whereIs(page, body);
      assert.ok(x > 60 && x < 840 && y > 60 && y < 540, `in ${scene} it is added at ${x}, ${y} of the page`);
      assert.ok(off.every((value) => Math.abs(value) < 0.05), `in ${scene} it is added ${off} m off the slice`);
      assert.ok(lowest > 0.5, `in ${scene} it is added ${lowest} m from another body`);
    }
    assert.deepEqual(errors, []);
    await page.close();
  }
  await context.close();
});

test("what was started again, or left for another scene, comes back by undo; the tour gives it back by itself", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "smash4d" });
  const isThere = (count, name = "smash4d") => until(page, ([bodies, scene]) => window.hyperbody.scene.bodies.length === bodies && window.hyperbody.sceneName === scene, [count, name]);
  const bodies = await page.evaluate(() => window.hyperbody.scene.bodies.length);
  await page.locator("[data-shape=ball]").click();
  await isThere(bodies + 1);
  // A key that is easily hit: the words that say what it did bring back what was.
  await page.keyboard.press("Backspace");
  await isThere(bodies);
  const wayBack = page.locator(".notice").filter({ hasText: "Started again" }).getByRole("button", { name: "Undo" });
  await wayBack.click();
  await isThere(bodies + 1);
  await wayBack.waitFor({ state: "detached" });
  await page.keyboard.press("p");
  await page.keyboard.press("Delete");
  await isThere(bodies);
  await page.locator(".notice").filter({ hasText: "Deleted “Ball”" }).getByRole("button", { name: "Undo" }).click();
  await isThere(bodies + 1);
  // From there a new start is that of the scene, not of the moment that came back.
  await page.keyboard.press("Backspace");
  await isThere(bodies);
  await page.keyboard.press("Control+z");
  await isThere(bodies + 1);
  await page.keyboard.press("c");
  await page.locator("[data-scene=dice5d]").click();
  await until(page, () => window.hyperbody.sceneName === "dice5d");
  await page.keyboard.press("Control+z");
  await isThere(bodies + 1);
  await page.getByRole("button", { name: "Tour" }).click();
  await until(page, () => window.hyperbody.sceneName === "hello4d");
  await page.getByRole("button", { name: "End tour" }).click();
  await isThere(bodies + 1);
  assert.deepEqual(errors, []);
  await context.close();
});

test("what was written in the editor is kept aside when something else is dropped, and a deleted scene comes back", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  const area = page.getByTestId("editor-text");
  await page.keyboard.press("x");
  await until(page, () => document.querySelector("[data-testid=editor-text]").value.includes("tesseract"));
  await page.keyboard.press("Escape");
  // What nobody has touched is the running scene's.
  await page.keyboard.press("c");
  await page.locator("[data-scene=dice5d]").click();
  await until(page, () => window.hyperbody.sceneName === "dice5d");
  await page.keyboard.press("x");
  await until(page, () => document.querySelector("[data-testid=editor-text]").value.includes("Dice of five dimensions"));
  // What is written while the running scene's text is on its way stays.
  await area.evaluate((element) => {
    [...document.querySelectorAll("[role=dialog] button")].find(({ textContent }) => textContent.includes("Take the running scene")).click();
    element.value = "an hour of work";
    element.dispatchEvent(new InputEvent("input", { bubbles: true }));
  });
  await pictures(page, 20);
  assert.equal(await area.inputValue(), "an hour of work");
  await drop(page, "not json at all");
  await until(page, () => document.querySelector("[data-testid=editor-text]").value === "not json at all");
  await page.getByRole("button", { name: "Bring mine back" }).click();
  assert.equal(await area.inputValue(), "an hour of work");
  await area.fill(GOOD);
  await page.getByRole("button", { name: "Save here" }).click();
  await page.keyboard.press("Escape");
  await page.keyboard.press("c");
  const own = page.locator(".own");
  await own.getByRole("button", { name: "Delete" }).click();
  await until(page, () => document.querySelectorAll(".own").length === 0);
  await page.locator(".gallery").getByRole("button", { name: "Undo" }).click();
  await own.getByText("Dropped").waitFor();
  assert.deepEqual(errors, []);
  await context.close();
});

test("down can be any direction: here that of the picture, through a slice that is turned", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  await page.keyboard.press("Shift+T");
  await until(page, () => Math.abs(window.hyperbody.slice.rows[1][3]) === 1);
  await page.getByRole("button", { name: "More" }).click();
  await page.getByTestId("gravity-view").click();
  await page.keyboard.press("Escape");
  // The picture's upright axis is w now: what is selected falls along it.
  await page.keyboard.press("n");
  await until(page, () => window.hyperbody.frame.selected && Math.abs(window.hyperbody.frame.selected.velocity[3]) > 2);
  assert.deepEqual(errors, []);
  await context.close();
});

test("started again, the scene keeps its slice, its gravity and what is selected", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  await page.keyboard.down("e");
  await until(page, () => window.hyperbody.slice.origin[3] > 0.2);
  await page.keyboard.up("e");
  await page.keyboard.press("v");
  await page.keyboard.press("n");
  await until(page, () => window.hyperbody.frame.selected !== null && window.hyperbody.frame.step > 30);
  // In slow motion the first steps are not missed, however few pictures a busy machine draws.
  await page.keyboard.press(",");
  await page.keyboard.press("Backspace");
  await until(page, () => window.hyperbody.frame.step < 30);
  await until(page, () => window.hyperbody.frame.step > 30 && window.hyperbody.frame.selected !== null);
  const { told, cut, speeds } = await page.evaluate(() => ({
    told: window.hyperbody.slice.origin[3], cut: window.hyperbody.frame.slice.origin[3], speeds: window.hyperbody.frame.selected.velocity.map(Math.abs),
  }));
  assert.ok(Math.abs(told - cut) < 1e-6 && cut > 0.1, `the strip stands at ${told}, the slice at ${cut}`);
  assert.ok(Math.max(...speeds) < 0.2, `without gravity it moves at ${speeds}`);
  assert.deepEqual(errors, []);
  await context.close();
});

test("arrows move the slider that has the focus, and not the world", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page } = await open(context, server.address, { scene: "hello4d" });
  await until(page, () => window.hyperbody.frame.history.seconds > 1);
  await page.getByTestId("scrub").focus();
  for (let k = 0; k < 5; k++) await page.keyboard.press("ArrowLeft");
  await until(page, () => window.hyperbody.frame.history.secondsBack > 0.01 && window.hyperbody.frame.paused);
  await page.keyboard.press("c");
  await page.keyboard.press("Backspace");
  await page.keyboard.press("Escape");
  assert.ok(await page.evaluate(() => window.hyperbody.frame.step > 30), "Backspace in the gallery started the scene again");
  await context.close();
});
