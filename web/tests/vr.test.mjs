// Virtual reality with an emulated headset (IWER): a controller grabs a body, carries it, feels it hit, and lets go.
import assert from "node:assert/strict";
import { fileURLToPath } from "node:url";
import { after, before, test } from "node:test";
import { DESKTOP, idOf, launch, open, pictures, serve, until } from "./support.mjs";

const EMULATOR = fileURLToPath(new URL("../node_modules/iwer/build/iwer.min.js", import.meta.url));
/** Number of the right controller's hand in frames (`HAND.right`). */
const RIGHT = 11;
const LEFT = 10;

let browser, server;
before(async () => ([browser, server] = await Promise.all([launch(), serve()])));
after(async () => {
  await browser?.close();
  server?.close();
});

/** In the page: puts a controller at a place of the world and points it at another. */
const aim = (page, place, goal, side = "right") => page.evaluate(([from, to, which]) => {
  const { position, scale } = window.hyperbody.viewer;
  const controller = window.headset.controllers[which];
  controller.position.set(...from.map((value, axis) => (value - position[axis]) / scale));
  const d = to.map((value, axis) => value - from[axis]);
  const length = Math.hypot(...d);
  const [x, y, z] = d.map((value) => value / length);
  // The shortest turn from (0, 0, −1) to d: w = 1 + cos, axis = (0, 0, −1) × d.
  const norm = Math.hypot(y, -x, 1 - z);
  controller.quaternion.set(y / norm, -x / norm, 0, (1 - z) / norm);
}, [place, goal, side]);

const centreInSlice = (page, body) => page.evaluate((id) => {
  const { centres } = window.hyperbody.frame;
  for (let at = 0; at < centres.length; at += 5) if (centres[at] === id) return Array.from(centres.subarray(at + 1, at + 4));
  return null;
}, body);

/** A context whose browser has a headset, emulated. */
async function withHeadset() {
  const context = await browser.newContext(DESKTOP);
  await context.addInitScript({ path: EMULATOR });
  await context.addInitScript(() => {
    window.headset = new window.IWER.XRDevice(window.IWER.metaQuest3);
    window.headset.installRuntime({ forceInstall: true });
    window.pulses = [];
  });
  return context;
}

async function enter(page) {
  await page.getByRole("button", { name: "Enter VR" }).click();
  await until(page, () => window.headset.activeSession && window.hyperbody.viewer.presenting);
}

const pressTrigger = (page, side, value) => page.evaluate(([which, how]) => window.headset.controllers[which].updateButtonValue("trigger", how), [side, value]);

test("a controller grabs a body, carries it, feels it hit the floor, and lets go", async () => {
  const context = await withHeadset();
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  await until(page, () => window.hyperbody.frame.time > 1.2);
  await enter(page);
  await page.evaluate(() => {
    for (const source of window.headset.activeSession.inputSources) {
      const [actuator] = source.gamepad.hapticActuators;
      const pulse = actuator.pulse.bind(actuator);
      actuator.pulse = (strength, duration) => {
        window.pulses.push({ hand: source.handedness, strength, duration });
        return pulse(strength, duration);
      };
    }
  });
  const body = await idOf(page, "ball");
  const centre = await centreInSlice(page, body);
  const hand = [centre[0] + 0.2, centre[1] + 0.9, centre[2] + 1.6];
  await aim(page, hand, centre);
  await pictures(page, 5);
  await page.evaluate(() => window.headset.controllers.right.updateButtonValue("trigger", 1));
  await until(page, ([right, id]) => window.hyperbody.frame.hands.some((held) => held.hand === right && held.body === id), [RIGHT, body]);
  // Up by 0.8 m, in small steps, without turning.
  const lift = async (from, to) => {
    for (let k = 1; k <= 8; k++) {
      const y = from + ((to - from) * k) / 8;
      await aim(page, [hand[0], hand[1] + y, hand[2]], [centre[0], centre[1] + y, centre[2]]);
      await pictures(page, 2);
    }
  };
  await lift(0, 0.8);
  await until(page, ([id, y]) => {
    const { centres } = window.hyperbody.frame;
    for (let at = 0; at < centres.length; at += 5) if (centres[at] === id) return centres[at + 2] > y;
    return false;
  }, [body, centre[1] + 0.5]);
  // And down, faster than it would fall, onto the floor.
  await aim(page, [hand[0], hand[1] - 0.4, hand[2]], [centre[0], centre[1] - 0.4, centre[2]]);
  await until(page, () => window.pulses.length > 0);
  const pulses = await page.evaluate(() => window.pulses);
  assert.ok(pulses.every(({ hand: which, strength }) => which === "right" && strength > 0 && strength <= 1), JSON.stringify(pulses));
  await page.evaluate(() => window.headset.controllers.right.updateButtonValue("trigger", 0));
  await until(page, () => window.hyperbody.frame.hands.length === 0);
  assert.deepEqual(errors, []);
  await context.close();
});

test("two controllers hold two bodies, and each moves its own", async () => {
  const context = await withHeadset();
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  await until(page, () => window.hyperbody.frame.time > 1.2);
  await enter(page);
  const hold = async (side, name, hand) => {
    const body = await idOf(page, name);
    const centre = await centreInSlice(page, body);
    // Straight from above: nothing else stands in the way.
    const place = [centre[0], centre[1] + 1.6, centre[2] + 0.01];
    await aim(page, place, centre, side);
    await pictures(page, 5);
    await pressTrigger(page, side, 1);
    await until(page, ([which, id]) => window.hyperbody.frame.hands.some((held) => held.hand === which && held.body === id), [hand, body]);
    return { side, body, centre, place };
  };
  const right = await hold("right", "ball", RIGHT);
  const left = await hold("left", "tesseract", LEFT);
  assert.equal(await page.evaluate(() => window.hyperbody.frame.hands.length), 2);
  const move = async ({ side, place, centre }, by) => {
    for (let k = 1; k <= 8; k++) {
      const shifted = (point) => point.map((value, axis) => value + (by[axis] * k) / 8);
      await aim(page, shifted(place), shifted(centre), side);
      await pictures(page, 2);
    }
  };
  const reaches = (body, axis, least) => until(page, ([id, which, value]) => {
    const { centres } = window.hyperbody.frame;
    for (let at = 0; at < centres.length; at += 5) if (centres[at] === id) return centres[at + 1 + which] > value;
    return false;
  }, [body, axis, least]);
  // The right hand lifts; what the left one holds stays where it is held.
  await move(right, [0, 0.9, 0]);
  await reaches(right.body, 1, right.centre[1] + 0.7);
  const stayed = await centreInSlice(page, left.body);
  assert.ok(Math.hypot(...stayed.map((value, axis) => value - left.centre[axis])) < 0.25, `the left hand's body went from ${left.centre} to ${stayed}`);
  // The left hand lifts too, higher; the right one stays up.
  await move(left, [0, 1.4, 0]);
  await reaches(left.body, 1, left.centre[1] + 1.2);
  const up = await centreInSlice(page, right.body);
  assert.ok(Math.abs(up[1] - right.centre[1] - 0.9) < 0.25, `the right hand's body is at ${up}`);
  // Letting go with one hand leaves the other its own.
  await pressTrigger(page, "right", 0);
  await until(page, (hand) => window.hyperbody.frame.hands.length === 1 && window.hyperbody.frame.hands[0].hand === hand, LEFT);
  assert.deepEqual(errors, []);
  await context.close();
});

/** A place of the room where one stands, in the world. */
const inRoom = async (page, point) => {
  const { position, scale } = await page.evaluate(() => window.hyperbody.viewer);
  return point.map((value, axis) => position[axis] + scale * value);
};

/** The right hand points from one place of the room at another, and pulls the trigger. */
async function press(page, from, at) {
  await aim(page, await inRoom(page, from), await inRoom(page, at));
  await pictures(page, 5);
  await pressTrigger(page, "right", 1);
  await pictures(page, 5);
  await pressTrigger(page, "right", 0);
}

/** A place on the panel, from its middle, where the panel is pitched. */
const turned = (x, y, pitch) => [x, y * Math.cos(pitch), y * Math.sin(pitch)];

/** Where the panel's button of this row and column is while the left hand points straight ahead, in the room. */
const onWrist = (row, column) => turned(0.1 * (column - 1), 0.0825 - 0.03625 * row, -0.7).map((value, axis) => value + [-0.2, 1.3, -0.34][axis]);
const leftAhead = async (page) => aim(page, await inRoom(page, [-0.2, 1.2, -0.4]), await inRoom(page, [-0.2, 1.2, -1.4]), "left");
const FROM = [0.2, 1.4, 0];

test("the panel is on the left wrist, for the right hand to press; with one hand alone it hangs beside the viewer", async () => {
  const context = await withHeadset();
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  await enter(page);
  // The button at the panel's upper left stops time.
  await leftAhead(page);
  await press(page, FROM, onWrist(0, 0));
  await until(page, () => window.hyperbody.frame.paused);
  // Without a left hand, in the room: a turn about y after the one about x.
  await page.evaluate(() => (window.headset.controllers.left.connected = false));
  await pictures(page, 10);
  const [x, y, z] = turned(-0.1, 0.0825, -0.2);
  const [c, s] = [Math.cos(0.6), Math.sin(0.6)];
  await press(page, FROM, [-0.42 + c * x + s * z, 1.25 + y, -0.6 - s * x + c * z]);
  await until(page, () => !window.hyperbody.frame.paused);
  assert.deepEqual(errors, []);
  await context.close();
});

test("the panel has the palette: shapes are added from it until it is closed", async () => {
  const context = await withHeadset();
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  await enter(page);
  await leftAhead(page);
  const names = () => page.evaluate(() => window.hyperbody.scene.bodies.map(({ name }) => name));
  const before = await names();
  const added = async (row, column) => {
    const count = (await names()).length;
    await press(page, FROM, onWrist(row, column));
    await until(page, (least) => window.hyperbody.scene.bodies.length > least, count);
    return (await names()).at(-1);
  };
  // "Add a body"; then the first and the last shape of four dimensions.
  await press(page, FROM, onWrist(1, 2));
  assert.match(await added(0, 1), /Box/);
  assert.match(await added(4, 0), /Spherinder/);
  assert.equal((await names()).length, before.length + 2);
  // Below the last shape there is nothing to press; "Close" brings the usual buttons back, of which this one stops time.
  await press(page, FROM, onWrist(5, 2));
  await press(page, FROM, onWrist(0, 0));
  assert.equal(await page.evaluate(() => window.hyperbody.frame.paused), false);
  await press(page, FROM, onWrist(0, 0));
  await until(page, () => window.hyperbody.frame.paused);
  assert.deepEqual([(await names()).length, errors], [before.length + 2, []]);
  await context.close();
});

test("the strip above the panel is dragged by a ray, which moves the slice, and a bar is tapped, which goes to its body", async () => {
  const context = await withHeadset();
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  await enter(page);
  await leftAhead(page);
  await pictures(page, 10);
  // Its middle is 0.213 m above that of the panel.
  const onStrip = (x, y = 0) => turned(x, 0.213 + y, -0.7).map((value, axis) => value + [-0.2, 1.3, -0.34][axis]);
  const point = async (at) => {
    await aim(page, await inRoom(page, FROM), await inRoom(page, at));
    await pictures(page, 5);
  };
  await point(onStrip(0));
  await pressTrigger(page, "right", 1);
  await pictures(page, 5);
  for (let k = 1; k <= 5; k++) await point(onStrip(0.01 * k));
  await until(page, () => window.hyperbody.slice.origin[3] > 0.3);
  await pressTrigger(page, "right", 0);
  await pictures(page, 5);
  // Across the middle of the strip lie bars, one below the other: some tap meets one.
  for (let k = -4; k <= 4 && (await page.evaluate(() => window.hyperbody.selected)) === null; k++) {
    await point(onStrip(-0.02, 0.01 * k));
    await pressTrigger(page, "right", 1);
    await pictures(page, 5);
    await pressTrigger(page, "right", 0);
    await pictures(page, 5);
  }
  const body = await page.evaluate(() => window.hyperbody.selected);
  assert.ok(body !== null, "no tap met a bar");
  await until(page, (id) => {
    const { centres } = window.hyperbody.frame;
    for (let at = 0; at < centres.length; at += 5) if (centres[at] === id) return Math.abs(centres[at + 4]) < 0.05;
    return false;
  }, body);
  assert.deepEqual(errors, []);
  await context.close();
});

test("a pressed stick teleports", async () => {
  const context = await withHeadset();
  const { page } = await open(context, server.address, { scene: "hello4d" });
  await enter(page);
  const before = await page.evaluate(() => window.hyperbody.viewer.position);
  await aim(page, [before[0], before[1] + 1.4, before[2]], [before[0] + 1, before[1], before[2] - 1]);
  await pictures(page, 5);
  await page.evaluate(() => window.headset.controllers.right.updateButtonValue("thumbstick", 1));
  await pictures(page, 5);
  await page.evaluate(() => window.headset.controllers.right.updateButtonValue("thumbstick", 0));
  await until(page, ([x, z]) => Math.abs(window.hyperbody.viewer.position[0] - x - 1) < 0.15 && Math.abs(window.hyperbody.viewer.position[2] - z + 1) < 0.15, [before[0], before[2]]);
  await page.evaluate(() => window.headset.activeSession.end());
  await until(page, () => !window.hyperbody.viewer.presenting);
  await context.close();
});

for (const [scene, what] of [["cradle2d", "two dimensions"], ["dominoes3d", "three dimensions"], ["flatland_solids3d", "Flatland"]]) {
  test(`a world of ${what} is drawn in VR, and its panel works`, async () => {
    const context = await withHeadset();
    const { page, errors } = await open(context, server.address, { scene });
    await enter(page);
    await leftAhead(page);
    await pictures(page, 20);
    assert.deepEqual(errors, []);
    await press(page, FROM, onWrist(0, 0));
    await until(page, () => window.hyperbody.frame.paused);
    // The next scene, from its last row; and one stands in front of that.
    const before = await page.evaluate(() => window.hyperbody.viewer.position);
    await press(page, FROM, onWrist(6, 1));
    await until(page, (name) => window.hyperbody.sceneName !== name, scene);
    await until(page, (place) => window.hyperbody.viewer.position.some((value, axis) => Math.abs(value - place[axis]) > 0.05), before);
    assert.deepEqual(errors, []);
    await context.close();
  });
}

test("a teleport puts the head above the ring, wherever in the room it is", async () => {
  const context = await withHeadset();
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  await page.evaluate(() => window.headset.position.set(0.8, 1.6, 0.5));
  await enter(page);
  const before = await page.evaluate(() => window.hyperbody.viewer.position);
  const scale = await page.evaluate(() => window.hyperbody.viewer.scale);
  const goal = [before[0] + 1.5, before[1], before[2] - 0.5];
  await aim(page, [before[0] + 0.5, before[1] + 1.4, before[2]], goal);
  await pictures(page, 5);
  await page.evaluate(() => window.headset.controllers.right.updateButtonValue("thumbstick", 1));
  await pictures(page, 5);
  await page.evaluate(() => window.headset.controllers.right.updateButtonValue("thumbstick", 0));
  await until(page, ([x, z]) => Math.abs(window.hyperbody.viewer.position[0] - x) < 0.15 && Math.abs(window.hyperbody.viewer.position[2] - z) < 0.15, [goal[0] - 0.8 * scale, goal[2] - 0.5 * scale]);
  assert.deepEqual(errors, []);
  await context.close();
});

test("a session that cannot be set up is ended, and the page says why", async () => {
  const context = await withHeadset();
  const { page } = await open(context, server.address, { scene: "hello4d" });
  // It has no space to stand in.
  await page.evaluate(() => {
    const system = navigator.xr;
    const request = system.requestSession.bind(system);
    system.requestSession = async (...asked) => {
      const session = await request(...asked);
      session.requestReferenceSpace = () => Promise.reject(new Error("no floor"));
      window.refused = session;
      session.addEventListener("end", () => (window.ended = true));
      return session;
    };
  });
  const told = page.getByText("VR could not start: no floor").waitFor();
  await page.getByRole("button", { name: "Enter VR" }).click();
  await told;
  await until(page, () => window.ended && !window.hyperbody.viewer.presenting);
  await context.close();
});

test("without a headset the page says what is missing", async () => {
  const context = await browser.newContext(DESKTOP);
  const { page } = await open(context, server.address, { scene: "hello4d" });
  await page.getByRole("button", { name: "More" }).click();
  await page.getByTestId("vr-missing").waitFor();
  assert.match(await page.getByTestId("vr-missing").innerText(), /headset/);
  await context.close();
});
