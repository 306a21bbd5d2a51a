// Writes the scenes that the playground adds to the built-in ones, as scene files under src/scenes/files: worlds to play
// with rather than to measure. `node tools/scenes.mjs`; the same bytes every time.
import { mkdirSync, writeFileSync } from "node:fs";

const OUT = new URL("../src/scenes/files/", import.meta.url);
const round = (value) => Math.round(value * 1e6) / 1e6;
const at = (n, ...first) => Array.from({ length: n }, (_, axis) => round(first[axis] ?? 0));
const floor = (n) => ({ name: "floor", kind: "static", shape: { half_space: { normal: at(n, 0, 1), offset: 0 } } });
const box = (...half) => ({ box: { half_extents: half.map(round) } });
const ball = (radius) => ({ ball: { radius } });
const regular = (name, circumradius) => ({ polytope: { regular: name, circumradius } });
const product = (...factors) => ({ product: { factors: factors.map(([shape, axes]) => ({ shape, axes })) } });
const turns = (planes) => Object.entries(planes).map(([plane, angle_deg]) => ({ plane, angle_deg }));
const duocylinder = (a, b) => product([ball(a), "xy"], [ball(b), "zw"]);
const spherinder = (radius, half) => product([ball(radius), "xyz"], [box(half), "w"]);
const cubinder = (radius, half) => product([ball(radius), "xy"], [box(half, half), "zw"]);

/** Walls that face each other `half` apart from the middle on all axes but y. */
function pit(n, half) {
  const names = "xyzwvu";
  return Array.from({ length: n }, (_, axis) => axis).filter((axis) => axis !== 1).flatMap((axis) => [-1, 1].map((sign) => ({
    name: `${sign < 0 ? "far" : "near"} ${names[axis]} wall`, kind: "static",
    shape: { half_space: { normal: Array.from({ length: n }, (_, i) => (i === axis ? sign : 0)), offset: -half } },
  })));
}

/** A ring of boxes in the plane of two axes, as one body. */
function ring(radius, thick, segments, [i, j]) {
  const parts = Array.from({ length: segments }, (_, k) => {
    const angle = (360 * k) / segments;
    const position = at(4);
    position[i] = round(radius * Math.cos((angle * Math.PI) / 180));
    position[j] = round(radius * Math.sin((angle * Math.PI) / 180));
    const half = [thick, thick, thick, thick];
    half[j] = round(1.04 * radius * Math.tan(Math.PI / segments) + thick * Math.tan(Math.PI / segments));
    return { shape: box(...half), position, rotation: [{ plane: "xyzw"[i] + "xyzw"[j], angle_deg: angle }] };
  });
  return { compound: { parts } };
}

/** What rolls comes to rest, as on a carpet: nothing leaves the shelf by itself. */
const ROLLS_OUT = { linear_damping: 0.5, angular_damping: 2 };

const scenes = {
  hello4d() {
    return {
      name: "A shelf of shapes", dimension: 4, description: "Eight solids of four dimensions. Pull one, throw it, push it out along w with the wheel, and follow it there.",
      bodies: [
        floor(4),
        { name: "tesseract", shape: box(0.5, 0.5, 0.5, 0.5), position: at(4, -1.6, 0.5, 0.4, 0), rotation: turns({ xz: 20 }) },
        { name: "24-cell", shape: regular("24-cell", 0.8), position: at(4, 0.1, 0.9, -0.9, 0.1), rotation: turns({ xw: 25, yz: 20 }) },
        { name: "ball", shape: ball(0.55), position: at(4, 1.75, 0.55, -0.4, 0.15), ...ROLLS_OUT },
        { name: "16-cell", shape: regular("16-cell", 0.85), position: at(4, 0.55, 1.2, 1.15, -0.1), rotation: turns({ xy: 30, zw: 20 }) },
        { name: "duocylinder", shape: duocylinder(0.5, 0.5), position: at(4, -0.55, 2.4, 0.3, 0.1), rotation: turns({ yz: 25, xw: 15 }), ...ROLLS_OUT },
        { name: "plank", shape: box(1.1, 0.12, 0.3, 0.5), position: at(4, -1.2, 1.7, -0.6, 0), rotation: turns({ xz: 35 }) },
        { name: "in front, along w", shape: box(0.45, 0.45, 0.45, 0.45), position: at(4, 1.2, 0.45, 0.9, 1.35), rotation: turns({ xz: 30 }) },
        { name: "behind, along w", shape: regular("24-cell", 0.65), position: at(4, -0.4, 0.6, 1.5, -1.3), rotation: turns({ xw: 10 }) },
      ],
    };
  },
  staircase4d() {
    const steps = 9;
    return {
      name: "A staircase into w", dimension: 4, description: "Nine tesseracts stand in a row that leads along w as well as along x. Move the slice and walk up the stairs.",
      bodies: [floor(4), ...Array.from({ length: steps }, (_, k) => ({
        name: `step ${k + 1}`, shape: box(0.3, 0.15 * (k + 1), 0.5, 0.5), position: at(4, (k - 4) * 0.68, 0.15 * (k + 1), 0, (k - 4) * 0.42),
      })), { name: "marble", shape: ball(0.28), position: at(4, 4 * 0.68, 3.4, 0, 4 * 0.42), velocity: at(4, -0.5, 0, 0, -0.3) }],
    };
  },
  smash4d() {
    const bodies = [floor(4)];
    for (let y = 0; y < 4; y++) for (let z = 0; z < 3; z++) for (let w = 0; w < 2; w++) {
      bodies.push({ name: `brick ${y}${z}${w}`, shape: box(0.3, 0.3, 0.45, 0.45), position: at(4, 0, 0.3 + 0.6 * y, (z - 1) * 0.92, w * 0.92 - 0.2) });
    }
    bodies.push({ name: "wrecking ball", shape: ball(0.55), mass: 30, position: at(4, -7, 1.6, 0.2, 0.15), velocity: at(4, 11, 2, 0, 0) });
    return { name: "Wall and wrecking ball", dimension: 4, description: "A heavy ball flies into a wall of bricks; half of them leave along w. Reset, and throw it yourself.", bodies };
  },
  dominoes_w4d() {
    // The row runs along x, bends out of the slice into w, by so much and over this length either way, and comes back.
    const [out, half, straight, apart] = [1.6, 3, 1.6, 0.44];
    const places = [];
    for (let x = -half - straight, since = apart; x <= half + straight; x += 0.001) {
      const slope = Math.abs(x) < half ? -((out * Math.PI) / (2 * half)) * Math.sin((Math.PI * x) / half) : 0;
      since += 0.001 * Math.hypot(1, slope);
      if (since < apart) continue;
      since -= apart;
      places.push({ x, w: Math.abs(x) < half ? (out / 2) * (1 + Math.cos((Math.PI * x) / half)) : 0, angle: (Math.atan(slope) * 180) / Math.PI });
    }
    return {
      name: "Dominoes through w", dimension: 4, description: "The row of dominoes leaves your space along w and comes back: the wave runs on where you see ghosts. Go after it with the slice, or turn it from x to w (R).",
      bodies: [floor(4), ...places.map(({ x, w, angle }, k) => ({
        name: `domino ${k + 1}`, shape: box(0.08, 0.6, 0.35, 0.35), position: at(4, x, 0.6, 0, w), rotation: turns({ xw: round(angle) }), ...(k === 0 ? { angular_velocity: { xy: -2.4 } } : {}),
      }))],
    };
  },
  regular_dice4d() {
    const names = ["5-cell", "8-cell", "16-cell", "24-cell", "120-cell", "600-cell"];
    return {
      name: "The six regular dice", dimension: 4, description: "Dice of 5, 8, 16, 24, 120 and 600 cells, all there are in four dimensions, are thrown and come to rest on a cell.",
      materials: { default: { friction: 0.45, restitution: 0.2 } },
      bodies: [floor(4), ...names.map((name, k) => ({
        name, shape: regular(name, name === "5-cell" ? 0.95 : 0.78), position: at(4, ((k % 3) - 1) * 1.9, 1.4 + 0.15 * k, k < 3 ? -0.95 : 0.95, 0.06 * (k - 2.5)),
        rotation: turns({ xy: 17 * k + 9, zw: 23 * k + 5 }), angular_velocity: { xy: round(0.6 - 0.25 * k), yz: round(-0.4 + 0.2 * k), xz: 0.5 },
      }))],
    };
  },
  rings4d() {
    return {
      name: "Linked rings", dimension: 4, description: "In three dimensions these rings could never come apart. Pull one along w (wheel while dragging), past the other, and let it back in.",
      gravity: at(4), materials: { default: { friction: 0.1, restitution: 0.3 } },
      bodies: [
        { name: "gold ring", shape: ring(1, 0.14, 10, [0, 1]), position: at(4, -0.5), colour: [0.96, 0.62, 0.15], linear_damping: 0.4, angular_damping: 0.6 },
        { name: "silver ring", shape: ring(1, 0.14, 10, [0, 2]), position: at(4, 0.5), colour: [0.78, 0.83, 0.92], linear_damping: 0.4, angular_damping: 0.6 },
      ],
    };
  },
  sorter4d() {
    const [hole, outer, thick, top] = [{ x: 0.6, z: 0.6, w: 0.32 }, 2.4, 0.12, 1.6];
    const frame = [];
    const slab = (name, axis, sign) => {
      const half = { x: outer, z: outer, w: outer };
      const place = { x: 0, z: 0, w: 0 };
      for (const other of ["x", "z", "w"].slice(0, ["x", "z", "w"].indexOf(axis))) half[other] = hole[other];
      half[axis] = (outer - hole[axis]) / 2;
      place[axis] = sign * (hole[axis] + outer) / 2;
      frame.push({ name, kind: "static", shape: box(half.x, thick, half.z, half.w), position: at(4, place.x, top, place.z, place.w) });
    };
    for (const axis of ["x", "z", "w"]) for (const sign of [-1, 1]) slab(`board ${sign < 0 ? "−" : "+"}${axis}`, axis, sign);
    return {
      name: "The hyper-hole sorter", dimension: 4, description: "The board has one hole, wide along x and z and narrow along w. Which solids go through, and which only once you turn them in w?",
      bodies: [
        floor(4), ...frame,
        { name: "flat in w: fits", shape: box(0.5, 0.5, 0.5, 0.22), position: at(4, -1.5, 2.4, 1.2, 0) },
        { name: "flat in x: turn it", shape: box(0.22, 0.5, 0.5, 0.5), position: at(4, 1.4, 2.4, 1.1, 0), rotation: turns({ xz: 10 }) },
        { name: "ball: never", shape: ball(0.5), position: at(4, -1.4, 2.5, -1.2, 0) },
        { name: "pea", shape: ball(0.28), position: at(4, 1.5, 2.4, -1.2, 0) },
        { name: "spherinder: upright", shape: spherinder(0.3, 0.55), position: at(4, 0.9, 2.6, -1.7, 0.1) },
      ],
    };
  },
  rotation_lab4d() {
    const spin = (name, x, z, planes) => ({ name, shape: box(0.75, 0.5, 0.3, 0.15), position: at(4, x, 0, z, 0), angular_velocity: planes, can_sleep: false });
    return {
      name: "The rotation laboratory", dimension: 4, description: "Four equal boxes float and spin in different planes. Select one and watch the plots: two spin steadily, two tumble.",
      gravity: at(4),
      bodies: [
        spin("xy and zw: steady", -1.4, -1.2, { xy: 2.5, zw: 1.2, xz: 0.02 }),
        spin("xz and yw: tumbles", 1.4, -1.2, { xz: 2.5, yw: 1, xy: 0.02 }),
        spin("xw alone: tumbles", -1.4, 1.2, { xw: 2.8, xy: 0.02, yz: 0.01 }),
        spin("yz alone: steady", 1.4, 1.2, { yz: 2.8, xy: 0.02 }),
      ],
    };
  },
  toybox4d() {
    const shapes = [box(0.4, 0.4, 0.4, 0.4), ball(0.42), duocylinder(0.42, 0.42), regular("24-cell", 0.58), { capsule: { half_length: 0.3, radius: 0.28, along: "x" } }, regular("16-cell", 0.68), spherinder(0.4, 0.35)];
    const bodies = [floor(4), ...pit(4, 1.75)];
    for (let k = 0; k < 42; k++) {
      const [x, z, w, y] = [k % 3, Math.floor(k / 3) % 3, Math.floor(k / 9) % 2, Math.floor(k / 18)];
      bodies.push({
        name: `toy ${k + 1}`, shape: shapes[k % shapes.length], position: at(4, (x - 1) * 1.12 + 0.03 * (k % 4), 0.8 + 1.1 * y, (z - 1) * 1.12 - 0.03 * (k % 3), (w - 0.5) * 1.3 + 0.02 * (k % 5)),
        rotation: turns({ xy: (37 * k) % 90, zw: (53 * k) % 90, xw: (11 * k) % 60 }),
      });
    }
    return { name: "Toy box", dimension: 4, description: "Forty-two toys of seven kinds in a pit with six walls. Reach in.", bodies };
  },
  rolling4d() {
    const slope = 12;
    const [c, s] = [Math.cos((slope * Math.PI) / 180), Math.sin((slope * Math.PI) / 180)];
    const rise = (x, r) => at(4, x, (-s * x) / c + r / c + 0.02);
    const put = (name, shape, x, z, w, r, more = {}) => ({ name, shape, position: [...rise(x, r).slice(0, 2), z, w], ...more });
    return {
      name: "Who rolls, who slides", dimension: 4, description: "Ball, duocylinder, spherinder, cubinder and tesseract on one slope: some roll in every direction, some in a plane only, one not at all.",
      materials: { default: { friction: 0.18 } },
      bodies: [
        { name: "slope", kind: "static", shape: { half_space: { normal: at(4, s, c), offset: 0 } } },
        { name: "end", kind: "static", shape: { half_space: { normal: at(4, -1), offset: -7 } } },
        put("ball", ball(0.45), -3, -2.4, 0, 0.45),
        put("duocylinder", duocylinder(0.45, 0.45), -3, -1.2, 0, 0.45),
        put("spherinder", spherinder(0.45, 0.45), -3, 0, 0, 0.45),
        put("cubinder", cubinder(0.45, 0.45), -3, 1.2, 0, 0.45),
        put("tesseract", box(0.45, 0.45, 0.45, 0.45), -3, 2.4, 0, 0.45, { rotation: turns({ xy: -slope }) }),
      ],
    };
  },
  net4d() {
    const [side, gap] = [5, 0.6];
    const bodies = [floor(4)];
    const joints = [];
    const name = (i, j) => `knot ${i}${j}`;
    for (let i = 0; i < side; i++) for (let j = 0; j < side; j++) {
      const corner = (i === 0 || i === side - 1) && (j === 0 || j === side - 1);
      bodies.push({ name: name(i, j), kind: corner ? "static" : "dynamic", shape: ball(0.14), position: at(4, (i - 2) * gap, 2.2, (j - 2) * gap, 0), linear_damping: 0.1 });
      const half = [gap / 2, 0, 0, 0];
      const across = [0, 0, gap / 2, 0];
      const minus = (v) => v.map((value) => (value === 0 ? 0 : -value));
      if (i > 0) joints.push({ ball: { a: name(i - 1, j), b: name(i, j), anchor_a: half, anchor_b: minus(half) } });
      if (j > 0) joints.push({ ball: { a: name(i, j - 1), b: name(i, j), anchor_a: across, anchor_b: minus(across) } });
    }
    bodies.push({ name: "guest", shape: regular("24-cell", 0.5), position: at(4, 0.1, 3.4, 0.1, 0), rotation: turns({ xw: 20 }) });
    return { name: "A net with room beside it", dimension: 4, description: "A net hung by four corners would hold a 3D guest. In 4D it has a side through which the guest can leave: push it a little along w.", bodies, joints };
  },
  flatland_solids3d() {
    const spin = (name, shape, x, y, z, planes) => ({ name, shape, position: at(3, x, y, z), angular_velocity: planes, can_sleep: false });
    return {
      name: "Flatland: visitors", dimension: 3, description: "Solids of three dimensions turn and pass through a plane. Its people see flat figures that grow, change and vanish: as you see 4D.",
      gravity: at(3),
      bodies: [
        spin("cube", box(0.6, 0.6, 0.6), -1.5, 2.4, 0, { xz: 0.5, yz: 0.35 }),
        spin("ball", ball(0.7), 1.5, 2.5, 0.2, { xz: 0.3 }),
        spin("octahedron", regular("octahedron", 0.9), 0, 0.9, -0.1, { xy: 0.3, xz: 0.6 }),
        spin("dodecahedron", regular("dodecahedron", 0.8), -1.7, 0.6, 0.3, { yz: 0.5, xy: -0.2 }),
        spin("cylinder", product([ball(0.4), "xy"], [box(0.75), "z"]), 1.7, 0.7, -0.2, { xz: 0.6, yz: 0.45 }),
        spin("rod", box(1.1, 0.16, 0.16), 0, 3.7, 0, { xz: 0.7, yz: 0.25 }),
      ],
    };
  },
  flatland_pile3d() {
    const shapes = [box(0.45, 0.45, 0.45), ball(0.5), regular("octahedron", 0.7), regular("icosahedron", 0.55), { capsule: { half_length: 0.35, radius: 0.3, along: "x" } }];
    return {
      name: "Flatland: a pile", dimension: 3, description: "A heap of solids, cut by a plane. In Flatland the figures hang in the air without touching: what holds them up lies off the plane.",
      bodies: [floor(3), ...pit(3, 1.9), ...Array.from({ length: 22 }, (_, k) => ({
        name: `thing ${k + 1}`, shape: shapes[k % shapes.length], position: at(3, ((k % 3) - 1) * 1.15 + 0.05 * (k % 4), 0.7 + Math.floor(k / 9) * 1.15, ((Math.floor(k / 3) % 3) - 1) * 1.15 - 0.04 * (k % 3)),
        rotation: turns({ xy: (31 * k) % 90, xz: (57 * k) % 90 }),
      }))],
    };
  },
  dice5d() {
    const names = ["simplex", "cube", "cross-polytope"];
    const radius = { simplex: 1, cube: 1.05, "cross-polytope": 1 };
    return {
      name: "Dice of five dimensions", dimension: 5, description: "Only three regular dice are left in five dimensions. Each of the two strips is a direction in which they can hide.",
      bodies: [floor(5), ...Array.from({ length: 9 }, (_, k) => ({
        name: `${names[k % 3]} ${Math.floor(k / 3) + 1}`, shape: regular(names[k % 3], radius[names[k % 3]]), position: at(5, ((k % 3) - 1) * 1.8, 1.6 + 0.5 * Math.floor(k / 3), (Math.floor(k / 3) - 1) * 1.8, 0.12 * (k % 4) - 0.2, 0.1 * (k % 5) - 0.2),
        rotation: turns({ xy: 20 * k, zw: 13 * k, yv: 17 * k }),
      }))],
    };
  },
  dice6d() {
    const names = ["simplex", "cube", "cross-polytope"];
    const radius = { simplex: 1.05, cube: 1.15, "cross-polytope": 1.1 };
    return {
      name: "Dice of six dimensions", dimension: 6, description: "Simplex, cube and cross-polytope in six dimensions: three strips, nine ways to turn the slice, and still they come to rest.",
      bodies: [floor(6), ...Array.from({ length: 6 }, (_, k) => ({
        name: `${names[k % 3]} ${Math.floor(k / 3) + 1}`, shape: regular(names[k % 3], radius[names[k % 3]]), position: at(6, ((k % 3) - 1) * 1.9, 1.7, (Math.floor(k / 3) - 0.5) * 2, 0.1 * (k % 3) - 0.1, 0.06 * k - 0.15, 0.1 - 0.05 * k),
        rotation: turns({ xy: 20 * k, zw: 13 * k, yu: 15 * k }),
      }))],
    };
  },
};

/** Where in the gallery each stands. */
const groups = {
  hello4d: "first",
  staircase4d: "first",
  smash4d: "stacks",
  dominoes_w4d: "games",
  regular_dice4d: "dice",
  rings4d: "links",
  sorter4d: "links",
  rotation_lab4d: "spins",
  toybox4d: "piles",
  rolling4d: "friction",
  net4d: "links",
  flatland_solids3d: "flatland",
  flatland_pile3d: "flatland",
  dice5d: "higher",
  dice6d: "higher",
};

const index = [];
mkdirSync(OUT, { recursive: true });
for (const [name, build] of Object.entries(scenes)) {
  const { bodies, joints, ...head } = build();
  index.push({ name, title: head.name, dimension: head.dimension, group: groups[name], sentence: head.description, bodies: bodies.length });
  const lines = (list) => list.map((item) => `    ${JSON.stringify(item)}`).join(",\n");
  const top = Object.entries({ format: "hyperbody-scene", version: 1, ...head }).map(([key, value]) => `  ${JSON.stringify(key)}: ${JSON.stringify(value)}`).join(",\n");
  const tail = joints ? `,\n  "joints": [\n${lines(joints)}\n  ]` : "";
  writeFileSync(new URL(`${name}.json`, OUT), `{\n${top},\n  "bodies": [\n${lines(bodies)}\n  ]${tail}\n}\n`);
}
writeFileSync(new URL("../src/scenes/index.json", import.meta.url), `${JSON.stringify(index, null, 2)}\n`);
