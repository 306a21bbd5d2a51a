// Sheets over the world: the keyboard stays inside, and scenes that are kept are not lost.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { DESKTOP, launch, open, serve, until } from "./support.mjs";

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

test("the keyboard stays inside an open sheet", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page } = await open(context, server.address, { scene: "hello4d" });
  await page.getByRole("button", { name: "More" }).click();
  const dialog = page.locator("[role=dialog][aria-modal=true]");
  await dialog.waitFor();
  const inside = () => page.evaluate(() => document.activeElement?.closest("[role=dialog]") !== null);
  const seen = new Set();
  for (let k = 0; k < 24; k++) {
    await page.keyboard.press(k < 12 ? "Tab" : "Shift+Tab");
    assert.ok(await inside(), `after ${k + 1} presses the focus is outside`);
    seen.add(await page.evaluate(() => document.activeElement?.outerHTML));
  }
  assert.ok(seen.size > 5, "the focus does not move");
  await page.keyboard.press("Escape");
  await dialog.waitFor({ state: "detached" });
  await context.close();
});

test("kept scenes: none is lost to another tab or to an equal name, and a file takes them along", async () => {
  const context = await browser.newContext(DESKTOP);
  const [one, two] = [await open(context, server.address, { scene: "hello4d" }), await open(context, server.address, { scene: "hello4d" })];
  const keep = async ({ page }, text) => {
    if (!(await page.getByTestId("editor-text").isVisible())) await page.keyboard.press("x");
    await page.getByTestId("editor-text").fill("");
    await page.getByRole("button", { name: "Take the running scene" }).click();
    await until(page, () => document.querySelector("[data-testid=editor-text]").value.includes("tesseract"));
    await page.getByTestId("editor-text").fill(text);
    await page.getByRole("button", { name: "Save here" }).click();
    await page.getByText("is kept in this browser").waitFor();
  };
  const names = (page) => page.evaluate(() => JSON.parse(localStorage.getItem("hyperbody.scenes")).map(({ name }) => name).sort());
  await keep(one, GOOD.replace("Dropped", "First"));
  await keep(two, GOOD.replace("Dropped", "Second"));
  await keep(one, GOOD.replace("Dropped", "Second").replace("0.5", "0.7"));
  assert.deepEqual(await names(one.page), ["First", "Second", "Second 2"]);
  // What was kept and is edited further is kept in its place.
  await one.page.getByTestId("editor-text").fill(GOOD.replace("Dropped", "Second").replace("0.5", "0.9"));
  await one.page.getByRole("button", { name: "Save here" }).click();
  await until(one.page, () => JSON.parse(localStorage.getItem("hyperbody.scenes")).some(({ text }) => text.includes("0.9")));
  assert.equal((await names(one.page)).length, 3);
  // The other tab has noticed, and its file brings them to a browser that has none.
  await two.page.keyboard.press("Escape");
  await two.page.keyboard.press("c");
  const download = two.page.waitForEvent("download");
  await two.page.getByRole("button", { name: "All as a file" }).click();
  const stream = await (await download).createReadStream();
  const chunks = [];
  for await (const chunk of stream) chunks.push(chunk);
  const other = await browser.newContext(DESKTOP);
  const { page } = await open(other, server.address, { scene: "hello4d" });
  await drop(page, Buffer.concat(chunks).toString());
  await page.getByText("3 scenes were added to yours").waitFor();
  await drop(page, Buffer.concat(chunks).toString());
  await page.getByText("0 scenes were added to yours").waitFor();
  assert.equal((await names(page)).length, 3);
  await other.close();
  await context.close();
});
