// An exported page works without a net once it was loaded, scenes that were never opened included, and takes updates.
import assert from "node:assert/strict";
import { cpSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { after, before, test } from "node:test";
import { DESKTOP, launch, open, serve, until } from "./support.mjs";

let browser, folder;
before(async () => {
  browser = await launch();
  folder = mkdtempSync(join(tmpdir(), "hyperbody-site-"));
  cpSync(fileURLToPath(new URL("../dist/", import.meta.url)), join(folder, "play"), { recursive: true });
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true });
});

const controlled = (page) => until(page, () => navigator.serviceWorker.controller?.state === "activated");

test("the page runs from any folder, without its server once loaded, and an update arrives", async () => {
  const worker = join(folder, "play/sw.js");
  assert.ok(existsSync(worker) && !readFileSync(worker, "utf8").includes("__"), "the builder has not filled in sw.js");
  const server = await serve(`${folder}/`);
  const context = await browser.newContext({ ...DESKTOP, serviceWorkers: "allow" });
  const { page, errors } = await open(context, `${server.address}play/`, { scene: "dice4d" });
  await controlled(page);
  // An update: another title, another version.
  const index = join(folder, "play/index.html");
  writeFileSync(index, readFileSync(index, "utf8").replace("<title>Hyperbody", "<title>Newer"));
  writeFileSync(worker, readFileSync(worker, "utf8").replace(/VERSION = "/, 'VERSION = "new'));
  await page.reload();
  assert.equal(await page.title(), "Newer");
  // The new worker keeps everything anew, and then the old one's is gone.
  const names = () => page.evaluate(() => caches.keys());
  for (let k = 0; k < 300 && !(await names()).every((name) => name.startsWith("hyperbody-new")); k++) await page.waitForTimeout(100);
  assert.equal((await names()).length, 1);
  await controlled(page);
  server.close();
  await page.reload();
  await until(page, () => (window.hyperbody?.frame?.number ?? 0) > 2);
  assert.equal(await page.title(), "Newer");
  // One of the page's own scenes, which come in files of their own.
  await page.keyboard.press("c");
  await page.locator("[data-scene=smash4d]").click();
  await until(page, () => window.hyperbody.sceneName === "smash4d");
  assert.deepEqual(errors, []);
  await context.close();
});
