// Runs the browser tests, one file after the other, each with a hard limit, so that a browser that hangs ends the run. A file
// that fails is run once more: a browser that draws in software on a busy machine misses moments that no user would.
import { spawnSync } from "node:child_process";
import { existsSync, readdirSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { browserPath } from "./support.mjs";

const here = fileURLToPath(new URL(".", import.meta.url));

/** Longest run of a file, s; the gallery runs every scene, and the weight of the page takes a slow compression. */
const LIMIT_SECONDS = { "gallery.test.mjs": 420, "load.test.mjs": 240 };
const USUAL_LIMIT_SECONDS = 120;

if (!existsSync(`${here}../dist/index.html`)) {
  console.error("the page is not built: run `cargo xtask play --no-open` once, or `npm run build` with the engine's wasm in place");
  process.exit(1);
}
if (!browserPath) {
  if (process.env.CI) {
    console.error("no Chromium: the browser tests need Debian's package chromium (apt-get install chromium)");
    process.exit(1);
  }
  console.log("browser tests skipped: no Chromium here (Debian: apt-get install chromium; or name one in CHROMIUM)");
  process.exit(0);
}

const wanted = process.argv.slice(2);
const files = readdirSync(here).filter((name) => name.endsWith(".test.mjs") && (wanted.length === 0 || wanted.some((part) => name.includes(part))));
let failed = 0;
for (const file of files) {
  if (passes(file)) continue;
  console.error(`${file}: once more`);
  if (!passes(file)) failed += 1;
}

/** Whether the tests of a file pass within their limit; says so if they do not. */
function passes(file) {
  const seconds = LIMIT_SECONDS[file] ?? USUAL_LIMIT_SECONDS;
  const { status, error } = spawnSync(process.execPath, ["--test", "--test-reporter=spec", `${here}${file}`], { stdio: "inherit", timeout: 1000 * seconds, killSignal: "SIGKILL" });
  if (status !== 0) console.error(`${file}: ${error ? `ended after its limit of ${seconds} s` : "failed"}`);
  return status === 0;
}
console.log(`${files.length - failed} passed, ${failed} failed`);
process.exit(failed === 0 ? 0 : 1);
