// What every browser test needs: the built page on a server, Debian's Chromium, a page that remembers its errors.
import { createServer } from "node:http";
import { existsSync, readFileSync } from "node:fs";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const DIST = fileURLToPath(new URL("../dist/", import.meta.url));
const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".svg": "image/svg+xml", ".avif": "image/avif", ".json": "application/json" };

/** Places where Chromium is looked for; CHROMIUM names another. */
const BROWSERS = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];

export const browserPath = BROWSERS.find((path) => path && existsSync(path));

const FLAGS = [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
  "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--disable-background-timer-throttling", "--disable-renderer-backgrounding",
];

/** Serves the built page, or another folder, on a free port of this machine. */
export function serve(folder = DIST) {
  const server = createServer((request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url, "http://x").pathname)).replace(/^(\.\.[/\\])+/, "");
    const file = join(folder, path.endsWith("/") ? `${path}index.html` : path);
    if (!file.startsWith(folder) || !existsSync(file)) {
      response.writeHead(404).end();
      return;
    }
    response.writeHead(200, { "content-type": TYPES[extname(file)] ?? "application/octet-stream", "cross-origin-opener-policy": "same-origin", "cross-origin-embedder-policy": "require-corp" });
    response.end(readFileSync(file));
  });
  return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve({ address: `http://127.0.0.1:${server.address().port}/`, close: () => (server.close(), server.closeAllConnections()) })));
}

export function launch() {
  if (!browserPath) throw new Error("no Chromium: install Debian's package chromium, or name one in CHROMIUM");
  return chromium.launch({ executablePath: browserPath, args: FLAGS });
}

/** Opens the page with a scene running; `errors` collects all that the console calls an error. */
export async function open(context, address, { scene, query = "", ready = true } = {}) {
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE_MS);
  const errors = [];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(error.message));
  await page.goto(`${address}?${scene ? `scene=${scene}` : ""}${query}`);
  if (ready) await page.waitForFunction(() => (window.hyperbody?.frame?.number ?? 0) > 2, null, { timeout: PATIENCE_MS });
  return { page, errors };
}

/** A context like a desktop's, small enough for software graphics. */
/** But for the test of it, nothing is kept for times without a net: all of it would be fetched anew in every test. */
const NOTHING_KEPT = { serviceWorkers: "block" };
export const DESKTOP = { viewport: { width: 900, height: 600 }, locale: "en-GB", ...NOTHING_KEPT };
export const PHONE = { viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true, locale: "en-GB", ...NOTHING_KEPT };

/** Longest wait for anything that has to come, ms: only what never comes takes so long, however busy the machine is. */
const PATIENCE_MS = 60_000;

/** Waits until a function of the page answers something true. */
export const until = (page, test, argument, timeout = PATIENCE_MS) => page.waitForFunction(test, argument, { timeout });

/** Waits until so many pictures have been drawn, which is how the page takes notice of hands, and draws what is switched. */
export const pictures = (page, count) => page.evaluate(async (wanted) => {
  for (let k = 0; k < wanted; k++) await new Promise((resolve) => requestAnimationFrame(resolve));
}, count);

/** Coordinates of a body, in the world: [slice point…, off…] of the newest frame. */
export const centreOf = (page, body) => page.evaluate((id) => {
  const { frame } = window.hyperbody;
  // Three coordinates in the slice, also where two are drawn.
  const stride = 4 + frame.slice.off.length;
  for (let at = 0; at < frame.centres.length; at += stride) if (frame.centres[at] === id) return Array.from(frame.centres.subarray(at + 1, at + stride));
  return null;
}, body);

/** The number of the body of this name. */
export const idOf = (page, name) => page.evaluate((wanted) => window.hyperbody.scene.bodies.find((body) => body.name === wanted)?.id ?? null, name);

export const whereIs = (page, body) => page.evaluate((id) => window.hyperbody.whereIs(id), body);
