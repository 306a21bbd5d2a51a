// Times what the worker does for a frame: one step, all sections, and the copy of the arrays. node bench.mjs [COUNT…]
// Times are told; what fails is a benchmark that measured nothing: a world that stood still, or pictures without bodies.
import assert from "node:assert/strict";
import { Checked, memory } from "./engine.mjs";
import { pile } from "./pile.mjs";

const FRAMES = 400;

function quantile(values, share) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
}

const counts = process.argv.slice(2).map(Number);
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
    const start = performance.now();
    engine.engine.step();
    const middle = performance.now();
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
    const end = performance.now();
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
  const total = physics.map((time, index) => time + slicing[index]);
  const told = (values) => `${quantile(values, 0.5).toFixed(2)} (95 %: ${quantile(values, 0.95).toFixed(2)})`;
  console.log(
    `${count} tesseracts: ${told(total)} ms a frame; physics ${told(physics)}, slicing ${told(slicing)}; ` +
      `${(bytes / 1024).toFixed(0)} KiB at the end`,
  );
  engine.free();
}
