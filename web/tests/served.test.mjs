// The page as `hyperbody play` serves it: it runs, a second visit fetches nothing anew, and nothing of it outlives the program.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { after, before, test } from "node:test";
import { DESKTOP, launch, open, until } from "./support.mjs";

/** The program, where this repository builds it; HYPERBODY names another. */
const root = fileURLToPath(new URL("../../", import.meta.url));
const target = process.env.CARGO_TARGET_DIR ?? join(root, "target");
const program = [process.env.HYPERBODY, join(target, "release/hyperbody"), join(target, "debug/hyperbody")].find((path) => path && existsSync(path));
const skip = !program && !process.env.CI && "the program is not built: `cargo xtask play --build-only`";

let browser, child, address;
before(async () => {
  if (skip) return;
  browser = await launch();
  child = spawn(program, ["play", "--no-open", "--port", "0"], { stdio: ["ignore", "pipe", "inherit"] });
  const line = await new Promise((resolve, reject) => {
    child.stdout.setEncoding("utf8").once("data", resolve);
    child.once("exit", (status) => reject(new Error(`\`${program} play\` ended with ${status}`)));
  });
  address = `${line.match(/http:\/\/[^\s/]+/)[0]}/`;
});
after(async () => {
  await browser?.close();
  child?.kill();
});

test("a second visit is told that nothing has changed, and no worker of the page stays behind", { skip }, async (t) => {
  const context = await browser.newContext({ ...DESKTOP, serviceWorkers: "allow" });
  const { page, errors } = await open(context, address, { scene: "hello4d" });
  const session = await context.newCDPSession(page);
  await session.send("Network.enable");
  const answers = new Map();
  session.on("Network.responseReceivedExtraInfo", ({ requestId, statusCode }) => answers.set(requestId, { ...answers.get(requestId), statusCode }));
  session.on("Network.requestWillBeSent", ({ requestId, request }) => answers.set(requestId, { ...answers.get(requestId), path: request.url.replace(address, "/") }));
  await page.reload();
  await until(page, () => (window.hyperbody?.frame?.number ?? 0) > 2, null, 30_000);
  const seen = [...answers.values()].filter(({ statusCode, path }) => statusCode && path?.startsWith("/"));
  const told = seen.map(({ path, statusCode }) => `${path} ${statusCode}`).join(", ");
  t.diagnostic(`asked for again: ${told}`);
  assert.ok(seen.some(({ path, statusCode }) => path.startsWith("/?") && statusCode === 304), told);
  assert.deepEqual(seen.filter(({ statusCode }) => statusCode === 200).map(({ path }) => path), []);
  await page.waitForFunction(async () => (await navigator.serviceWorker.getRegistrations()).length === 0 && (await caches.keys()).length === 0, null, { timeout: 15_000 });
  assert.deepEqual(errors, []);
  await context.close();
});
