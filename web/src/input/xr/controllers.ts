// Two controllers that grab independently: what one holds follows its place and its attitude. Sticks move and turn the
// slice, a pressed stick teleports, trigger or grip on the wrist panel presses its buttons, and impacts of what is held
// pulse in the hand that holds it.
import { Matrix4, Ray, Vector3, type XRTargetRaySpace } from "three";
import { HAND } from "../../app/hand-control";
import type { Playground } from "../../app/playground";
import { settings } from "../../app/settings";
import { toWorld } from "../../app/slice-frame";
import type { Frame } from "../../engine/protocol";
import { strengthOf } from "../feedback";
import { makePointer, Teleport } from "./pointer-visuals";
import { HEIGHT, WristPanel } from "./wrist-panel";
import { WristStrip } from "./wrist-strip";

const DEAD_ZONE = 0.18;
const PUSH_SPEED = 1.2;
const PULSE_MS = 60;
/** Index of the thumbstick's axes and button in the standard gamepad of WebXR ("xr-standard"). */
const STICK_X = 2;
const STICK_Y = 3;
const STICK_BUTTON = 3;

interface Controller {
  space: XRTargetRaySpace;
  source: XRInputSource | null;
  hand: number;
  /** The grabbed point in the controller's own axes. */
  grip: Vector3 | null;
  /** What was pressed to take it: only its release lets go. */
  by: "select" | "squeeze" | null;
  /** What it has taken is the strip. */
  onStrip: boolean;
  stickWasPressed: boolean;
}

export class Controllers {
  private readonly controllers: Controller[];
  private readonly panel: WristPanel;
  private readonly strip: WristStrip;
  private readonly teleport = new Teleport();

  constructor(private readonly playground: Playground) {
    const { renderer, rig } = playground.stage;
    this.panel = new WristPanel(playground);
    this.strip = new WristStrip(playground, this.panel.mesh, HEIGHT / 2);
    this.controllers = [0, 1].map((index) => {
      const space = renderer.xr.getController(index);
      const controller: Controller = { space, source: null, hand: index === 0 ? HAND.left : HAND.right, grip: null, by: null, onStrip: false, stickWasPressed: false };
      space.add(makePointer());
      rig.add(space);
      space.addEventListener("connected", ({ data }) => this.connect(controller, data));
      space.addEventListener("disconnected", () => this.disconnect(controller));
      for (const way of ["select", "squeeze"] as const) {
        space.addEventListener(`${way}start`, () => this.press(controller, way));
        space.addEventListener(`${way}end`, () => controller.by === way && this.release(controller));
      }
      return controller;
    });
    playground.stage.scene.add(this.teleport.marker);
    playground.onFrame.add((frame) => this.pulse(frame));
  }

  setVisible(on: boolean): void {
    this.teleport.marker.visible = false;
    this.panel.mesh.visible = on;
  }

  /** Once a picture: hands follow the controllers, sticks act. */
  update(seconds: number): void {
    const { slice } = this.playground;
    for (let j = 0; j < slice.offCount; j++) {
      for (let view = 0; view < slice.frame.shown; view++) slice.setSpin(view, j, 0);
      slice.setGlide(j, 0);
    }
    for (const controller of this.controllers) {
      if (!controller.source) continue;
      this.follow(controller);
      this.sticks(controller, seconds);
    }
    this.strip.update();
    const wrist = this.wrist();
    this.panel.update(this.controllers.filter((controller) => controller.source && controller !== wrist).map(({ space }) => rayOf(space)));
  }

  private connect(controller: Controller, source: XRInputSource): void {
    controller.source = source;
    controller.hand = source.handedness === "right" ? HAND.right : HAND.left;
    this.hangPanel();
  }

  /** The hand that carries the panel: the left one, if there is another to press it with. */
  private wrist(): Controller | undefined {
    const there = this.controllers.filter(({ source }) => source);
    return there.length > 1 ? there.find(({ source }) => source?.handedness === "left") : undefined;
  }

  private hangPanel(): void {
    this.panel.hangOn(this.wrist()?.space ?? null, this.playground.stage.rig);
  }

  private disconnect(controller: Controller): void {
    this.release(controller);
    controller.source = null;
    this.hangPanel();
  }

  private press(controller: Controller, way: "select" | "squeeze"): void {
    if (controller.by) return;
    const ray = rayOf(controller.space);
    if (controller !== this.wrist()) {
      if (this.panel.press(ray)) return;
      controller.onStrip = this.strip.press(ray);
      if (controller.onStrip) {
        controller.by = way;
        return;
      }
    }
    const picked = this.playground.stage.pick(ray);
    if (!picked || this.playground.body(picked.body)?.kind !== "dynamic") return;
    controller.by = way;
    controller.grip = controller.space.worldToLocal(picked.point.clone());
    const frame = this.playground.drawnFrame();
    this.playground.select(picked.body);
    this.playground.hands.grab(controller.hand, picked.body, toWorld(frame, picked.point.toArray().slice(0, frame.shown)), false);
    this.playground.hands.setAttitude(controller.hand, attitudeOf(controller.space));
  }

  private release(controller: Controller): void {
    if (controller.onStrip) this.strip.release(rayOf(controller.space));
    controller.onStrip = false;
    controller.grip = controller.by = null;
    this.playground.hands.release(controller.hand);
  }

  private follow(controller: Controller): void {
    if (controller.onStrip) this.strip.move(rayOf(controller.space));
    if (!controller.grip) return;
    const point = controller.space.localToWorld(controller.grip.clone());
    this.playground.hands.moveTo(controller.hand, point.toArray());
    this.playground.hands.setAttitude(controller.hand, attitudeOf(controller.space));
  }

  private sticks(controller: Controller, seconds: number): void {
    const gamepad = controller.source?.gamepad;
    if (!gamepad) return;
    const x = live(gamepad.axes[STICK_X] ?? 0);
    const y = live(-(gamepad.axes[STICK_Y] ?? 0));
    const { slice, hands, along: { value: off }, pushRow } = this.playground;
    if (slice.offCount > 0 && controller.source?.handedness === "left") {
      slice.setGlide(off, y);
      if (y !== 0) this.playground.followed.value = null;
      if (slice.frame.shown > 1) slice.setSpin(1, off, x);
    } else if (slice.offCount > 0) {
      slice.setSpin(0, off, x);
      if (hands.holds(controller.hand) !== null) hands.push(controller.hand, pushRow, y * PUSH_SPEED * seconds);
      else if (slice.frame.shown > 2) slice.setSpin(2, off, y);
    }
    this.teleportBy(controller, gamepad.buttons[STICK_BUTTON]?.pressed ?? false);
  }

  /** Aims while the stick is pressed, goes when it is let go. */
  private teleportBy(controller: Controller, pressed: boolean): void {
    const { rig } = this.playground.stage;
    if (pressed) this.teleport.aim(rayOf(controller.space), rig.position.y, rig.scale.x);
    else if (controller.stickWasPressed) {
      const goal = this.teleport.take();
      // The head lands above the ring: in the room it may stand beside its middle.
      const head = new Vector3().setFromMatrixPosition(this.playground.stage.renderer.xr.getCamera().matrixWorld);
      if (goal) rig.position.add(goal.sub(head).setY(0));
    }
    controller.stickWasPressed = pressed;
  }

  private pulse(frame: Frame): void {
    if (!settings.vibration.value) return;
    for (const controller of this.controllers) {
      const held = this.playground.body(this.playground.hands.holds(controller.hand));
      const its = frame.impacts.filter((impact) => impact.hands.includes(controller.hand));
      // A pulse takes the place of the one before: of all impacts of a frame the strongest is felt.
      const strength = its.reduce((most, impact) => Math.max(most, strengthOf(impact, held?.mass ?? 1)), 0);
      const actuator = controller.source?.gamepad?.hapticActuators?.[0];
      if (strength > 0 && actuator && "pulse" in actuator) void (actuator as Pulses).pulse(strength, PULSE_MS);
    }
  }
}

/** What WebXR gamepads have; the DOM types know only the newer effects. */
interface Pulses {
  pulse(strength: number, milliseconds: number): Promise<boolean>;
}

function live(value: number): number {
  return Math.abs(value) < DEAD_ZONE ? 0 : value;
}

/** Where a controller points, in the world. */
function rayOf(space: XRTargetRaySpace): Ray {
  space.updateWorldMatrix(true, false);
  const origin = new Vector3().setFromMatrixPosition(space.matrixWorld);
  return new Ray(origin, new Vector3(0, 0, -1).transformDirection(space.matrixWorld));
}

/** Rows of the controller's rotation in the world. */
function attitudeOf(space: XRTargetRaySpace): number[][] {
  const { elements } = new Matrix4().extractRotation(space.matrixWorld);
  return [0, 1, 2].map((row) => [0, 1, 2].map((column) => elements[4 * column + row]));
}
