// Virtual reality with an emulated headset (IWER): a controller grabs a body, carries it, feels it hit, and lets go.
import assert from "node:assert/strict";
import { fileURLToPath } from "node:url";
import { after, before, test } from "node:test";
import { DESKTOP, idOf, launch, open, serve, until } from "./support.mjs";

const EMULATOR = fileURLToPath(new URL("../node_modules/iwer/build/iwer.min.js", import.meta.url));
/** Number of the right controller's hand in frames (`HAND.right`). */
const RIGHT = 11;

let browser, server;
before(async () => ([browser, server] = await Promise.all([launch(), serve()])));
after(async () => {
  await browser?.close();
  server?.close();
});

/** In the page: puts the right controller at a place of the world and points it at another. */
const aim = (page, place, goal) => page.evaluate(([from, to]) => {
  const { position, scale } = window.hyperbody.viewer;
  const controller = window.headset.controllers.right;
  controller.position.set(...from.map((value, axis) => (value - position[axis]) / scale));
  const d = to.map((value, axis) => value - from[axis]);
  const length = Math.hypot(...d);
  const [x, y, z] = d.map((value) => value / length);
  // The shortest turn from (0, 0, −1) to d: w = 1 + cos, axis = (0, 0, −1) × d.
  const norm = Math.hypot(y, -x, 1 - z);
  controller.quaternion.set(y / norm, -x / norm, 0, (1 - z) / norm);
}, [place, goal]);

const centreInSlice = (page, body) => page.evaluate((id) => {
  const { centres } = window.hyperbody.frame;
  for (let at = 0; at < centres.length; at += 5) if (centres[at] === id) return Array.from(centres.subarray(at + 1, at + 4));
  return null;
}, body);

test("a controller grabs a body, carries it, feels it hit the floor, and lets go", async () => {
  const context = await browser.newContext(DESKTOP);
  await context.addInitScript({ path: EMULATOR });
  await context.addInitScript(() => {
    window.headset = new window.IWER.XRDevice(window.IWER.metaQuest3);
    window.headset.installRuntime({ forceInstall: true });
    window.pulses = [];
  });
  const { page, errors } = await open(context, server.address, { scene: "hello4d" });
  await until(page, () => window.hyperbody.frame.time > 1.2, null, 30_000);
  await page.getByRole("button", { name: "Enter VR" }).click();
  await until(page, () => window.headset.activeSession && window.hyperbody.viewer.presenting);
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
  await page.waitForTimeout(300);
  await page.evaluate(() => window.headset.controllers.right.updateButtonValue("trigger", 1));
  await until(page, ([right, id]) => window.hyperbody.frame.hands.some((held) => held.hand === right && held.body === id), [RIGHT, body]);
  // Up by 0.8 m, in small steps, without turning.
  const lift = async (from, to) => {
    for (let k = 1; k <= 8; k++) {
      const y = from + ((to - from) * k) / 8;
      await aim(page, [hand[0], hand[1] + y, hand[2]], [centre[0], centre[1] + y, centre[2]]);
      await page.waitForTimeout(30);
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
