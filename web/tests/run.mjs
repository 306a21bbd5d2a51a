// Runs the browser tests, one file after the other, each with a hard limit, so that a browser that hangs ends the run. There are
// no second tries: a test that passes only sometimes has a defect, in itself or in the page.
import { spawn, spawnSync } from "node:child_process";
import { existsSync, readdirSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { browserPath } from "./support.mjs";

const here = fileURLToPath(new URL(".", import.meta.url));

/** Longest run of a file, s, on a machine that is busy with other things; the gallery runs every scene. */
const LIMIT_SECONDS = { "gallery.test.mjs": 900 };
const USUAL_LIMIT_SECONDS = 420;

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
if (files.length === 0) {
  console.error(`no test file has one of these in its name: ${wanted.join(", ")}`);
  process.exit(1);
}
const failed = [];
for (const file of files) {
  const names = await failures(file);
  if (names !== null) failed.push(`${file} (${names})`);
}

/** What failed in a file, in a line; null if nothing did. */
function failures(file) {
  const seconds = LIMIT_SECONDS[file] ?? USUAL_LIMIT_SECONDS;
  return new Promise((resolve) => {
    const child = spawn(process.execPath, ["--test", "--test-reporter=spec", `${here}${file}`], { stdio: ["ignore", "pipe", "inherit"] });
    const names = new Set();
    let late = false;
    child.stdout.setEncoding("utf8").on("data", (text) => {
      process.stdout.write(text);
      for (const [, name] of text.matchAll(/^\s*✖ (.+?)(?: \([\d.]+ms\))?$/gm)) if (name !== "failing tests:") names.add(name);
    });
    const limit = setTimeout(() => {
      late = true;
      endAll(child.pid);
    }, 1000 * seconds);
    child.on("close", (status) => {
      clearTimeout(limit);
      if (late) resolve(`ended after its limit of ${seconds} s`);
      else resolve(status === 0 ? null : [...names].join("; ") || "failed");
    });
  });
}

/** Ends a process with all that it started: browsers have process groups of their own. */
function endAll(pid) {
  const listed = spawnSync("ps", ["-eo", "pid=,ppid="], { encoding: "utf8" }).stdout ?? "";
  const pairs = listed.trim().split("\n").map((line) => line.trim().split(/\s+/).map(Number));
  const family = [pid];
  for (const parent of family) for (const [child, its] of pairs) if (its === parent) family.push(child);
  for (const member of family) {
    try {
      process.kill(member, "SIGKILL");
    } catch {
      // Gone already.
    }
  }
}

console.log(`${files.length - failed.length} files passed, ${failed.length} failed`);
for (const line of failed) console.log(`==> FAILED: ${line}`);
process.exit(failed.length === 0 ? 0 : 1);
