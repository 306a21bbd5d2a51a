// Times what the worker does for a frame: one step, all sections, and the copy of the arrays. node bench.mjs [COUNT…] [--most MS]
// It is processor time, so that other work on the machine counts little. With --most, a frame in twenty may take longer: it
// fails where more do. A benchmark that measured nothing fails too: a world that stood still, or pictures without bodies.
import assert from "node:assert/strict";
import { parseArgs } from "node:util";
import { Checked, memory } from "./engine.mjs";
import { pile } from "./pile.mjs";

const FRAMES = 400;
/** Of this process, ms: one thread works in it, and what compiles the engine beside it is done within the first frames. */
const now = () => {
  const { user, system } = process.cpuUsage();
  return (user + system) / 1000;
};
/** Frames before the engine is compiled well. */
const WARM_UP = 40;

function quantile(values, share) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
}

const { values: { most }, positionals } = parseArgs({ options: { most: { type: "string" } }, allowPositionals: true });
const counts = positionals.map(Number);
for (const count of counts.length > 0 ? counts : [200, 500]) {
  const engine = new Checked();
  engine.ask({ type: "load", text: pile(count) });
  engine.ask({ type: "ghosts", on: true, reach: 1 });
  const physics = [];
  const slicing = [];
  let bytes = 0;
  let drawn = 0;
  const before = JSON.parse(engine.engine.report());
  for (let frame = 0; frame < FRAMES; frame += 1) {
    const start = now();
    engine.engine.step();
    const middle = now();
    const layout = engine.engine.draw();
    bytes = 0;
    drawn = Math.max(drawn, layout[1]);
    for (let index = 0; index < layout.length; index += 2) {
      // The cells are the one array of two bytes.
      const size = layout[index + 1] * (index === 4 ? 2 : 4);
      new Uint8Array(size).set(new Uint8Array(memory(), layout[index], size));
      bytes += size;
    }
    JSON.parse(engine.engine.report());
    const end = now();
    // A pile at rest costs next to nothing: what counts is one that moves. The sleepers are the last array.
    if (frame < WARM_UP || layout.at(-1) === count) continue;
    physics.push(middle - start);
    slicing.push(end - middle);
  }
  const after = JSON.parse(engine.engine.report());
  assert.equal(after.step - before.step, FRAMES, "a call of step() made no step");
  // It falls from rest: what it has lost in height is more than what moves.
  assert.ok(after.energy.total < 0.95 * before.energy.total, `the pile has not fallen: ${before.energy.total} J, then ${after.energy.total} J`);
  assert.deepEqual(after.quarantined, [], "bodies had to be stopped");
  // The slice through the middle cuts a third of the grid, each into twelve triangles or more.
  assert.ok(drawn >= (count / 6) * 12 * 9, `the fullest picture had ${drawn} coordinates`);
  assert.ok(physics.length >= FRAMES / 8, `only ${physics.length} frames had bodies that moved`);
  const total = physics.map((time, index) => time + slicing[index]);
  const told = (values) => `${quantile(values, 0.5).toFixed(2)} (95 %: ${quantile(values, 0.95).toFixed(2)})`;
  console.log(
    `${count} tesseracts, ${total.length} frames in which they move: ${told(total)} ms of processor time a frame; physics ${told(physics)}, slicing ${told(slicing)}; ` +
      `${(bytes / 1024).toFixed(0)} KiB at the end`,
  );
  if (most !== undefined && quantile(total, 0.95) > Number(most)) {
    console.error(`a frame of ${count} tesseracts may take ${most} ms`);
    process.exitCode = 1;
  }
  engine.free();
}
