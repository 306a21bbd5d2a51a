// The scene that is timed: many tesseracts that fall into a pile.

/** A pile of tesseracts of one metre: layers of a grid, every second one turned, dropped from a little above each other. */
export function pile(count, sleeping = true) {
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
  return JSON.stringify({ format: "hyperbody-scene", version: 1, name: "pile", dimension: 4, sleeping, bodies });
}
