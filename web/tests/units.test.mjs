// What needs no picture: parts of the page, read through its builder and run under Node.
import assert from "node:assert/strict";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { createServer } from "vite";

let vite;
before(async () => {
  // What the modules find of a browser when they are read.
  Object.assign(globalThis, {
    window: { devicePixelRatio: 2 },
    document: { documentElement: { classList: { toggle: () => undefined } } },
    matchMedia: () => ({ matches: false, addEventListener: () => undefined }),
    localStorage: undefined,
    addEventListener: () => undefined,
    screen: {},
  });
  vite = await createServer({ root: fileURLToPath(new URL("..", import.meta.url)), server: { middlewareMode: true, ws: false, watch: null }, appType: "custom", logLevel: "error", optimizeDeps: { noDiscovery: true } });
});
after(() => vite?.close());

test("the picture gets coarser when it is slow, finer when there is room, and tries again later and later", async () => {
  const { QualityGuard } = await vite.ssrLoadModule("/src/app/quality.ts");
  let ratio = 0;
  const stage = { software: false, renderer: { xr: { isPresenting: false } }, setShadows: () => undefined, resize: (_w, _h, value) => (ratio = value) };
  const guard = new QualityGuard(stage);
  guard.resize(100, 100);
  const finest = ratio;
  const pass = (seconds, frame) => {
    for (let spent = 0; spent < seconds; spent += frame) guard.pictureTook(frame);
  };
  // A machine that is too slow for the finest alone.
  const live = (seconds) => {
    let changes = 0;
    for (let spent = 0; spent < seconds; ) {
      const frame = ratio === finest ? 1 / 20 : 1 / 60;
      const before = ratio;
      guard.pictureTook(frame);
      spent += frame;
      if (ratio !== before) changes += 1;
    }
    return changes;
  };
  pass(2, 1 / 20);
  assert.ok(ratio < finest, "too slow, and as fine as before");
  const first = live(300);
  const second = live(300);
  assert.ok(first >= 2, "a machine that was slow once stays coarse for ever");
  assert.ok(second <= first / 2, `it goes up and down as often as before: ${first}, then ${second} times`);
  pass(700, 1 / 60);
  assert.equal(ratio, finest, "with room for minutes it is not as fine as at first");
});

test("on a screen of 30 pictures a second the picture stays fine, and on weak graphics it does not", async () => {
  const { QualityGuard } = await vite.ssrLoadModule("/src/app/quality.ts");
  const live = (frameAt, seconds) => {
    let ratio = 0;
    let coarse = 0;
    const stage = { software: false, renderer: { xr: { isPresenting: false } }, setShadows: () => undefined, resize: (_w, _h, value) => (ratio = value) };
    const guard = new QualityGuard(stage);
    guard.resize(100, 100);
    const finest = ratio;
    for (let spent = 0; spent < seconds; spent += frameAt(ratio)) {
      guard.pictureTook(frameAt(ratio) * (1 + 0.04 * Math.sin(97 * spent)));
      if (ratio < finest) coarse += frameAt(ratio);
    }
    return { coarse, ratio, finest };
  };
  const screen = live(() => 1 / 30, 600);
  assert.equal(screen.ratio, screen.finest);
  assert.ok(screen.coarse < 4, `a screen of 30 Hz was drawn coarsely for ${screen.coarse.toFixed(1)} s`);
  // Shown at multiples of a sixtieth: a quarter of the pixels is fluent, what is between is not.
  const weak = live((ratio) => Math.ceil((ratio / 2) ** 2 * 3.2) / 60, 60);
  assert.ok(weak.ratio < weak.finest && weak.coarse > 40, `weak graphics draw at ${weak.ratio} after a minute`);
});

test("a new scene is cut where most of it shows, and at home where that is nearly as good", async () => {
  const { fullestSlice } = await vite.ssrLoadModule("/src/view/framing.ts");
  const scene = (...extents) => [
    { slice: { off: extents[0].length === 4 ? [[], []] : [[]] }, strip: Float32Array.from(extents.flatMap((extent, id) => [id, ...extent])) },
    extents.map((_, id) => ({ id, kind: "dynamic" })),
  ];
  assert.deepEqual(fullestSlice(...scene([-1, 1], [2, 3])), [0]);
  assert.deepEqual(fullestSlice(...scene([1, 2], [2.5, 3.5], [2.5, 3.5])), [3]);
  // Of two off directions a body has to be met along both.
  assert.deepEqual(fullestSlice(...scene([-1, 1, 4, 6], [-1, 1, 4, 6])), [0, 5]);
  const [frame, bodies] = scene([4, 5]);
  assert.deepEqual(fullestSlice(frame, bodies.map((body) => ({ ...body, kind: "static" }))), [0]);
});

test("the camera sees a box whole, and as near as it can", async () => {
  const { placeToSee } = await vite.ssrLoadModule("/src/view/framing.ts");
  const { Box3, Vector3 } = await import("three");
  for (const [yaw, pitch, wide, high] of [[0.55, 0.3, 0.5, 0.3], [-2, 1, 0.12, 0.3], [0, 0.02, 0.9, 0.1]]) {
    const back = new Vector3(Math.cos(pitch) * Math.sin(yaw), Math.sin(pitch), Math.cos(pitch) * Math.cos(yaw));
    const right = new Vector3(Math.cos(yaw), 0, -Math.sin(yaw));
    const axes = [right, back.clone().cross(right), back.clone().negate()];
    const box = new Box3(new Vector3(-3, 0, 1), new Vector3(2, 1.5, 2));
    const place = placeToSee(box, axes, [wide, high]);
    const shares = [];
    for (let k = 0; k < 8; k++) {
      const corner = new Vector3(k & 1 ? 2 : -3, k & 2 ? 1.5 : 0, k & 4 ? 2 : 1).sub(place);
      const depth = corner.dot(axes[2]);
      assert.ok(depth > 0, "a corner lies behind the camera");
      shares.push(corner.dot(axes[0]) / (depth * wide), corner.dot(axes[1]) / (depth * high));
    }
    assert.ok(Math.max(...shares.map(Math.abs)) < 1 + 1e-6, `a corner is outside: ${shares}`);
    // It touches two opposite sides.
    const touches = [0, 1].some((odd) => {
      const its = shares.filter((_, k) => k % 2 === odd);
      return Math.max(...its) > 1 - 1e-6 && Math.min(...its) < -1 + 1e-6;
    });
    assert.ok(touches, `there is room left: ${shares}`);
  }
});

test("what is wrong with a scene is said in Chinese, with its place, and unknown words stay as they are", async () => {
  const { zhProblem } = await vite.ssrLoadModule("/src/i18n/zh-problems.ts");
  assert.equal(zhProblem('bodies[0].shape: unknown key "bal"; the nearest known one is "ball" (known: ball, box)'), "bodies[0].shape：没有“bal”这个键，最接近的是“ball”（可用：ball, box）");
  assert.equal(zhProblem("bodies[0].position: has 3 numbers, expected 4, one for each dimension"), "bodies[0].position：有 3 个数，应为 4 个");
  assert.equal(zhProblem("bodies[0].shape.ball.radius: the radius of a ball is -1: it must be a number of metres between 1e-6 and 1e6"), "bodies[0].shape.ball.radius：半径（ball） 是 -1，必须是 1e-6 到 1e6 之间的米数");
  assert.equal(zhProblem("line 1, column 129: not JSON: trailing comma"), "多了一个逗号");
  assert.equal(zhProblem("a: something new"), "场景有误。a：something new");
});

test("bodies of the page's scenes have Chinese names, each of them, with their numbers", async () => {
  const { zhName } = await vite.ssrLoadModule("/src/i18n/zh-names.ts");
  assert.deepEqual(["knot 04", "Ball 2", "friction 0.3", "16-cell", "far w wall", "mine alone"].map(zhName), ["结 04", "球 2", "摩擦 0.3", "正十六胞体", "w 远墙", "mine alone"]);
  const folder = fileURLToPath(new URL("../src/scenes/files/", import.meta.url));
  for (const file of readdirSync(folder)) {
    const names = JSON.parse(readFileSync(folder + file, "utf8")).bodies.flatMap(({ name }) => name ?? []);
    assert.deepEqual(names.filter((name) => zhName(name) === name), [], `${file} has bodies without a Chinese name`);
  }
});

test("after stops of the engine: again, then another scene, then no more", async () => {
  const { Recovery } = await vite.ssrLoadModule("/src/app/recovery.ts");
  const recovery = new Recovery();
  assert.equal(recovery.after(0, "a"), "again");
  assert.equal(recovery.after(1000, "a"), "another");
  assert.equal(recovery.after(2000, "b"), "again");
  assert.equal(recovery.after(3000, "c"), "stop");
  assert.equal(recovery.after(90_000, "a"), "again", "an hour later it is forgotten");
});

test("down is down, whichever way a device counts", async () => {
  const { downOf } = await vite.ssrLoadModule("/src/input/tilt.ts");
  const same = (a, b) => a.forEach((value, axis) => assert.ok(Math.abs(value - b[axis]) < 1e-12, `${a} and ${b}`));
  // On a table, face up: the standard says +9.81 along z, Apple's devices −9.81.
  same(downOf(0, 0, 9.81, false), [0, 0, -1]);
  same(downOf(0, 0, -9.81, true), [0, 0, -1]);
  // Upright in the hand.
  same(downOf(0, 9.81, 0, false), [0, -1, 0]);
  same(downOf(0, -9.81, 0, true), [0, -1, 0]);
});

test("too slow a machine loses time, and says how much", async () => {
  const { Pacer } = await vite.ssrLoadModule("/src/engine/pacer.ts");
  const pacer = new Pacer();
  let now = 0;
  const clock = () => now;
  let steps = 0;
  for (let k = 0; k < 400; k++) {
    // A step takes twice as long as it simulates.
    pacer.run(now, 0.01, 30, clock, () => {
      now += 20;
      steps += 1;
    });
    now += 1;
  }
  assert.ok(Math.abs(steps * 0.01 - 0.5 * (now / 1000)) < 0.05 * (now / 1000), `${steps} steps in ${now} ms`);
  assert.ok(Math.abs(pacer.slowdown - 0.5) < 0.1, `it says ${pacer.slowdown}`);
});

test("a die tells the cell that lies in the ground, and nothing where the slice misses it", async () => {
  const { restsOn } = await vite.ssrLoadModule("/src/app/dice.ts");
  const frame = (axes, normals) => ({
    slice: { axes },
    surface: { ranges: [3, 0, 3, 5, 3, 3 * normals.length], normals: [[0, -1, 0], ...normals].flatMap((normal) => [normal, normal, normal].flat()), cells: [9, 9, 9, ...normals.flatMap((_, cell) => [cell, cell, cell])] },
  });
  const axes = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]];
  const down = [0, -9.81, 0, 0];
  const [c, s] = [Math.cos(0.1), Math.sin(0.1)];
  assert.equal(restsOn(frame(axes, [[1, 0, 0], [0, -1, 0], [0, 1, 0]]), 5, down), 2);
  assert.equal(restsOn(frame(axes, [[1, 0, 0], [0, 1, 0], [s, -c, 0]]), 5, down), null, "it stands on an edge");
  assert.equal(restsOn(frame(axes, [[0, -1, 0]]), 7, down), null, "the slice misses it");
  assert.equal(restsOn(frame(axes, [[0, -1, 0]]), 5, [0, 0, 0, 0]), null, "without weight nothing lies");
  // The slice is turned in its own axes: its second one points along z.
  assert.equal(restsOn(frame([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0]], [[0, -1, 0], [0, 0, 1]]), 5, down), 2);
});

test("what a frame fills has its normals before the first frame: without them three.js would shade round bodies flat, for good", async () => {
  const { SurfaceLayer } = await vite.ssrLoadModule("/src/view/surfaces.ts");
  const { BodyStyles } = await vite.ssrLoadModule("/src/view/body-styles.ts");
  const { mesh } = new SurfaceLayer(new BodyStyles());
  assert.deepEqual(Object.keys(mesh.geometry.attributes).sort(), ["color", "normal", "position"]);
  assert.equal(mesh.geometry.drawRange.count, 0);
});

test("every scene has its picture, its words in both languages, and a group with a name", async () => {
  const { galleryGroups } = await vite.ssrLoadModule("/src/scenes/gallery.ts");
  const { en } = await vite.ssrLoadModule("/src/i18n/en.ts");
  const { zh } = await vite.ssrLoadModule("/src/i18n/zh.ts");
  const { Engine } = await import("./engine/engine.mjs").then(() => import("../src/engine/pkg/hyperbody_wasm.js"));
  for (const { group, scenes } of galleryGroups(JSON.parse(Engine.builtins()))) {
    assert.ok(en.group[group] && zh.group[group], `the group ${group} has no name`);
    for (const { name } of scenes) {
      assert.ok(existsSync(new URL(`../public/gallery/${name}.avif`, import.meta.url)), `${name} has no picture: node tools/pictures.mjs ${name}`);
      assert.ok(zh.scene[name]?.title && zh.scene[name]?.sentence, `${name} has no words in Chinese`);
    }
  }
});

test("joints of a frame fill their buffers, and no more is allocated once they have grown", async () => {
  const { JointLayer } = await vite.ssrLoadModule("/src/view/joints.ts");
  const layer = new JointLayer();
  const [rods, beads] = layer.group.children.map((mesh) => mesh.geometry);
  const frame = (count) => ({ rods: Float32Array.from({ length: 8 * count }, (_, k) => k), marks: Float32Array.from({ length: 4 * count }, (_, k) => -k) });
  layer.update(frame(40), 1.5);
  assert.deepEqual([rods.instanceCount, beads.instanceCount], [40, 40]);
  const { array } = rods.getAttribute("start").data;
  assert.equal(rods.getAttribute("end").data.array, array, "both ends of a rod lie in one buffer");
  assert.deepEqual([rods.getAttribute("end").getX(39), rods.getAttribute("end").getW(39)], [316, 319]);
  layer.update(frame(3), 1.5);
  assert.deepEqual([rods.instanceCount, beads.instanceCount], [3, 3]);
  assert.equal(rods.getAttribute("start").data.array, array, "the buffer was made anew");
  // The picture of Flatland shares them.
  assert.deepEqual(layer.flat.children.map((mesh) => mesh.geometry), [rods, beads]);
});

test("a new scene's camera follows what drives away whole, and of what flies apart keeps what stays", async () => {
  const { FirstLook } = await vite.ssrLoadModule("/src/app/first-look.ts");
  const { Box3 } = await import("three");
  const rows = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const kinds = ["static", "dynamic", "dynamic"];
  const bodies = kinds.map((kind, id) => ({ id, kind, endless: false }));
  // Every body is the segment from its place to a metre up, right and ahead.
  const frameAt = (time, places) => ({
    time, slice: { origin: [0, 0, 0], axes: rows, off: [] }, halfSpaces: new Float32Array(0), ghosts: null, strip: new Float32Array(0),
    surface: { ranges: Uint32Array.from(places.flatMap((_, id) => [id, 2 * id, 2])), positions: Float32Array.from(places.flatMap((x) => [x, 0, 0, x + 1, 1, 1])) },
  });
  const watch = (placesAt) => {
    const seen = new Box3();
    let looks = 0;
    const stage = { setSight: (box) => seen.copy(box), see: (box) => (seen.copy(box), (looks += 1)), orbit: { halt: () => undefined } };
    const look = new FirstLook(stage, { drawn: () => ({ origin: [0, 0, 0], rows, shown: 3 }), jump: () => undefined });
    look.begin();
    assert.ok(look.take(frameAt(0, placesAt(0)), bodies));
    for (let time = 0; time < 12; time += 0.05) look.settle(0.05, frameAt(time, placesAt(time)), bodies);
    return { seen, looks };
  };
  const holds = ({ seen }, x) => seen.min.x <= x && seen.max.x >= x + 1;
  const away = watch((time) => [3, 4 * time, 4 * time + 1.5]);
  assert.ok(holds(away, 47) && !holds(away, 3), `it drove to 48 m, and the picture is from ${away.seen.min.x} to ${away.seen.max.x}`);
  const apart = watch((time) => [3, 0, 4 * time]);
  assert.ok(holds(apart, 0) && apart.seen.max.x < 15, `one stayed, and the picture is from ${apart.seen.min.x} to ${apart.seen.max.x}`);
  assert.ok(apart.looks < away.looks, "it comes to rest where something stays");
});
