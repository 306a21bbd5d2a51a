// Prints, as JSON, the state hash of every scene of the gallery after some steps in the browser's engine: node hashes.mjs STEPS
// [SCENE…]. Built-in scenes go by their names, those of the page by their files, as `hyperbody run` takes both.
// `cargo xtask play --check-hashes` compares the hashes with those of the native program.
import { readdirSync, readFileSync } from "node:fs";
import { builtins, Checked } from "./engine.mjs";

const ROOT = new URL("../../../", import.meta.url);
/** The page's own scenes, from the root of the repository. */
const OWN = "web/src/scenes/files/";

const [steps = "300", ...wanted] = process.argv.slice(2);
const own = readdirSync(new URL(OWN, ROOT)).filter((name) => name.endsWith(".json"));
const names = wanted.length > 0 ? wanted : [...builtins().map((scene) => scene.name), ...own.map((name) => OWN + name)];
const hashes = {};
for (const name of names) {
  const engine = new Checked();
  if (name.endsWith(".json")) engine.ask({ type: "load", text: readFileSync(new URL(name, ROOT), "utf8") });
  else engine.ask({ type: "loadBuiltin", name });
  engine.steps(Number(steps));
  hashes[name] = engine.ask({ type: "hash" }).hash;
  engine.free();
}
console.log(JSON.stringify(hashes));
