// Prints, as JSON, the state hash of built-in scenes after some steps in the browser's engine:
// node hashes.mjs STEPS [SCENE…]. `cargo xtask play --check-hashes` compares them with those of the native program.
import { builtins, Checked } from "./engine.mjs";

const [steps = "300", ...wanted] = process.argv.slice(2);
const names = wanted.length > 0 ? wanted : builtins().map((scene) => scene.name);
const hashes = {};
for (const name of names) {
  const engine = new Checked();
  engine.ask({ type: "loadBuiltin", name });
  engine.steps(Number(steps));
  hashes[name] = engine.ask({ type: "hash" }).hash;
  engine.free();
}
console.log(JSON.stringify(hashes));
