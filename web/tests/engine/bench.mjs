// Times what the worker does for a frame: one step, all sections, and the copy of the arrays. node bench.mjs [COUNT…]
import { Checked, memory } from "./engine.mjs";

/** A pile of tesseracts of one metre: layers of a grid, every second one turned, dropped from a little above each other. */
function pile(count) {
  const bodies = [
    { name: "ground", kind: "static", shape: { half_space: { normal: [0, 1, 0, 0], offset: 0 } } },
  ];
  const wide = 3;
  for (let index = 0; index < count; index += 1) {
    const layer = Math.floor(index / wide ** 3);
    const place = index % wide ** 3;
    const at = [place % wide, Math.floor(place / wide) % wide, Math.floor(place / wide ** 2)];
    const shift = (layer % 2) * 0.3;
    const [x, z, w] = at.map((k) => (k - 1) * 1.25 + shift);
    const rotation = layer % 2 === 0 ? [] : [{ plane: "xw", angle_deg: 20 + index }, { plane: "yz", angle_deg: 10 }];
    bodies.push({ shape: { box: { half_extents: [0.5, 0.5, 0.5, 0.5] } }, position: [x, 0.6 + 1.3 * layer, z, w], rotation });
  }
  return JSON.stringify({ format: "hyperbody-scene", version: 1, name: "pile", dimension: 4, bodies });
}

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
  for (let frame = 0; frame < 400; frame += 1) {
    const start = performance.now();
    engine.engine.step();
    const middle = performance.now();
    const layout = engine.engine.draw();
    bytes = 0;
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
  const total = physics.map((time, index) => time + slicing[index]);
  const told = (values) => `${quantile(values, 0.5).toFixed(2)} (95 %: ${quantile(values, 0.95).toFixed(2)})`;
  console.log(
    `${count} tesseracts: ${told(total)} ms a frame; physics ${told(physics)}, slicing ${told(slicing)}; ` +
      `${(bytes / 1024).toFixed(0)} KiB at the end`,
  );
  engine.free();
}
