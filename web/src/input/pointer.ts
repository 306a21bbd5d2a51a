// Mouse and touch on the view. One finger or the left button pulls a body or orbits; the right button turns a body or
// shifts the view; the wheel or a second finger pushes what is held along the chosen off direction (moved aside, the finger turns it); a long press or right click asks for a menu.
import { Plane, Vector3 } from "three";
import { HAND } from "../app/hand-control";
import { calm } from "../app/settings";
import type { Playground } from "../app/playground";
import { toWorld } from "../app/slice-frame";
import type { Picked } from "../view/pick";
import { menu } from "../ui/state";

/** A press that moves less than this is a tap, CSS pixels; fingers are less exact than mice. */
const TAP_PIXELS = { mouse: 4, touch: 9 };
const LONG_PRESS_MS = 480;
const ORBIT_PER_PIXEL = 0.0062;
const TURN_PER_PIXEL = 0.01;
/** Along w, m: for a notch of the wheel (100 units), and for a pixel of the second finger. */
const PUSH_PER_WHEEL = 0.0012;
const PUSH_PER_PIXEL = 0.008;
const SLICE_PER_WHEEL = 0.0016;
const ZOOM_PER_WHEEL = 0.0012;
/** A second finger has to move so far before it is clear what it wants, CSS pixels. */
const SENSE_PIXELS = 10;
/** A release this long after the last movement throws nothing, ms. */
const STALE_MS = 60;

type Act = "undecided" | "orbit" | "pan" | "pull" | "turn" | "done";

interface Press {
  id: number;
  touch: boolean;
  button: number;
  start: [number, number];
  last: [number, number];
  when: number;
  /** Of the orbit, rad/s. */
  speed: [number, number];
  picked: Picked | null;
  act: Act;
  /** Where a pulled body moves: the plane through the grabbed point that faces the camera. */
  plane: Plane | null;
}

interface SecondFinger {
  id: number;
  start: [number, number];
  last: [number, number];
  /** What it does to a held body: by how it first moves, and that until it is lifted. */
  sense: "push" | "turn" | null;
}

export class PointerInput {
  private main: Press | null = null;
  private second: SecondFinger | null = null;
  private longPress = 0;
  /** Distance and middle of two fingers on the ground. */
  private pinch: { distance: number; middle: [number, number] } | null = null;

  constructor(private readonly playground: Playground, private readonly canvas: HTMLCanvasElement) {
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.up(event));
    canvas.addEventListener("pointercancel", (event) => this.up(event));
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("pointerleave", () => (playground.stage.styles.hovered = null));
  }

  private down(event: PointerEvent): void {
    this.canvas.setPointerCapture(event.pointerId);
    menu.value = null;
    const at: [number, number] = [event.clientX, event.clientY];
    if (this.main) {
      if (this.main.touch) this.secondDown(event.pointerId, at);
      return;
    }
    const picked = this.playground.pickAt(...at);
    this.main = {
      id: event.pointerId, touch: event.pointerType === "touch", button: event.button, start: at, last: at, when: event.timeStamp, speed: [0, 0], picked,
      act: "undecided", plane: null,
    };
    if (picked && this.main.touch) this.longPress = window.setTimeout(() => this.openMenu(), LONG_PRESS_MS);
  }

  private secondDown(id: number, at: [number, number]): void {
    clearTimeout(this.longPress);
    const main = this.main;
    if (!main) return;
    this.second = { id, start: at, last: at, sense: null };
    // On a body the second finger pushes along w, so the body has to be held by now.
    const frozen = main.picked !== null && this.isFrozen(main.picked.body);
    if (main.picked && !frozen && main.act === "undecided") this.begin(main, false);
    if (main.act === "pull" && !frozen) return;
    // The ground, or something that nothing moves: two fingers move the camera.
    main.act = "pan";
    this.pinch = { distance: distance(main.last, at), middle: middle(main.last, at) };
  }

  /** Whether the panel shows a body as frozen: the list of bodies tells how it takes part when it is let go. */
  private isFrozen(body: number): boolean {
    const selected = this.playground.readout.value?.selected;
    return selected?.body === body && selected.frozen;
  }

  private move(event: PointerEvent): void {
    const at: [number, number] = [event.clientX, event.clientY];
    const { main } = this;
    if (!main) {
      this.hover(event, at);
      return;
    }
    if (this.second?.id === event.pointerId) this.secondMove(at);
    if (main.id !== event.pointerId) return;
    if (main.act === "done" && event.timeStamp < main.when + LONG_PRESS_MS && distance(main.start, at) >= TAP_PIXELS.touch) {
      // It moved in time; a busy machine told of it late.
      menu.value = null;
      main.act = "undecided";
    }
    if (main.act === "undecided") {
      if (distance(main.start, at) < TAP_PIXELS[main.touch ? "touch" : "mouse"]) return;
      clearTimeout(this.longPress);
      this.begin(main, event.shiftKey);
    }
    this.continue(main, at, event);
    main.last = at;
    main.when = event.timeStamp;
  }

  /** A press becomes an act: it has moved far enough. */
  private begin(main: Press, shift: boolean): void {
    const { picked } = main;
    const movable = picked && this.playground.body(picked.body)?.kind === "dynamic";
    if (picked && movable) {
      this.playground.select(picked.body);
      const turning = main.button === 2;
      main.act = turning ? "turn" : "pull";
      const point = toWorld(this.playground.drawnFrame(), this.coordinates(picked.point));
      const grip = (turning && this.playground.centre(picked.body)) || point;
      this.playground.hands.grab(HAND.pointer, picked.body, grip, turning);
      main.plane = new Plane().setFromNormalAndCoplanarPoint(this.playground.pullNormal(...main.start), picked.point);
      return;
    }
    main.act = main.button !== 0 || shift ? "pan" : "orbit";
  }

  private continue(main: Press, at: [number, number], event: PointerEvent): void {
    const [dx, dy] = [at[0] - main.last[0], at[1] - main.last[1]];
    const { orbit } = this.playground.stage;
    if (main.act === "orbit") {
      orbit.orbit(-dx * ORBIT_PER_PIXEL, dy * ORBIT_PER_PIXEL);
      const seconds = Math.max(0.004, (event.timeStamp - main.when) / 1000);
      main.speed = [(-dx * ORBIT_PER_PIXEL) / seconds, (dy * ORBIT_PER_PIXEL) / seconds];
    } else if (main.act === "pan" && !this.pinch) {
      orbit.pan(dx / this.canvas.clientHeight, -dy / this.canvas.clientHeight);
    } else if (main.act === "pan" && this.second) {
      this.pinchTo(at, this.second.last);
    } else if (main.act === "pull") {
      this.pull(main, at);
    } else if (main.act === "turn") {
      this.turn(dx, dy, event.shiftKey);
    }
  }

  private pull(main: Press, at: [number, number]): void {
    const hit = main.plane && this.playground.rayAt(...at).intersectPlane(main.plane, new Vector3());
    if (hit) this.playground.hands.moveTo(HAND.pointer, this.coordinates(hit));
  }

  /** Turns the held body about the picture's axes, or with Shift from them into the first off direction. */
  private turn(dx: number, dy: number, intoW: boolean): void {
    const { hands, slice } = this.playground;
    const n = slice.frame.rows.length;
    const direction = (column: number) => {
      const inView = new Vector3().setFromMatrixColumn(this.playground.stage.orbit.camera.matrixWorld, column);
      return Array.from({ length: n }, (_, axis) => (axis < 3 ? inView.getComponent(axis) : 0));
    };
    const [right, up, back] = [direction(0), direction(1), direction(2)];
    const off = Array.from({ length: n }, (_, axis) => (axis === this.playground.pushRow ? 1 : 0));
    const target = intoW && n > 3 ? off : back;
    hands.turn(HAND.pointer, target, right, dx * TURN_PER_PIXEL);
    hands.turn(HAND.pointer, up, target, dy * TURN_PER_PIXEL);
  }

  private secondMove(at: [number, number]): void {
    const { main, second } = this;
    if (!main || !second) return;
    if (main.act === "pull") this.secondActs(second, at);
    second.last = at;
    if (this.pinch) this.pinchTo(main.last, at);
  }

  /** Beside a finger that holds something: up and down pushes it along w, aside turns it about the picture's upright axis. */
  private secondActs(second: SecondFinger, at: [number, number]): void {
    const [dx, dy] = [at[0] - second.start[0], at[1] - second.start[1]];
    if (!second.sense && Math.hypot(dx, dy) > SENSE_PIXELS) second.sense = Math.abs(dy) >= Math.abs(dx) ? "push" : "turn";
    const { hands } = this.playground;
    if (second.sense === "push") hands.push(HAND.pointer, this.playground.pushRow, (second.last[1] - at[1]) * PUSH_PER_PIXEL);
    else if (second.sense === "turn") this.turn(at[0] - second.last[0], 0, false);
  }

  private pinchTo(a: [number, number], b: [number, number]): void {
    if (!this.pinch) return;
    const now = { distance: distance(a, b), middle: middle(a, b) };
    const { orbit } = this.playground.stage;
    orbit.zoom(this.pinch.distance / Math.max(1, now.distance));
    const height = this.canvas.clientHeight;
    orbit.pan((now.middle[0] - this.pinch.middle[0]) / height, -(now.middle[1] - this.pinch.middle[1]) / height);
    this.pinch = now;
  }

  private up(event: PointerEvent): void {
    clearTimeout(this.longPress);
    if (this.second?.id === event.pointerId) {
      this.second = this.pinch = null;
      return;
    }
    const { main } = this;
    if (!main || main.id !== event.pointerId) return;
    this.main = this.second = this.pinch = null;
    this.playground.hands.release(HAND.pointer);
    if (main.act === "undecided" && event.type === "pointerup") this.tap(main);
    if (main.act === "orbit" && event.timeStamp - main.when < STALE_MS && !calm.value) this.playground.stage.orbit.throw(...main.speed);
  }

  private tap(main: Press): void {
    this.playground.select(main.picked?.body ?? null);
    if (main.button === 2 && main.picked) menu.value = { x: main.last[0], y: main.last[1], body: main.picked.body };
  }

  private openMenu(): void {
    const { main } = this;
    if (!main?.picked || main.act !== "undecided") return;
    main.act = "done";
    navigator.vibrate?.(12);
    this.playground.select(main.picked.body);
    menu.value = { x: main.last[0], y: main.last[1], body: main.picked.body };
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const amount = event.deltaY || event.deltaX;
    const { hands, slice, stage } = this.playground;
    if (hands.holds(HAND.pointer) !== null) hands.push(HAND.pointer, this.playground.pushRow, -amount * PUSH_PER_WHEEL);
    else if ((event.shiftKey || event.altKey) && slice.offCount > 0) this.playground.moveSlice(slice.offset(this.playground.along.value) - amount * SLICE_PER_WHEEL, this.playground.along.value);
    else stage.orbit.zoom(Math.exp(amount * ZOOM_PER_WHEEL * (event.ctrlKey ? 5 : 1)));
  }

  private hover(event: PointerEvent, at: [number, number]): void {
    if (event.pointerType === "touch") return;
    const picked = this.playground.pickAt(...at);
    this.playground.stage.styles.hovered = picked?.body ?? null;
    this.canvas.style.cursor = picked ? "grab" : "default";
  }

  /** A point of the view as coordinates in the drawn frame. */
  private coordinates(point: Vector3): number[] {
    return point.toArray().slice(0, this.playground.drawnFrame().shown);
  }
}

function distance(a: readonly [number, number], b: readonly [number, number]): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}

function middle(a: readonly [number, number], b: readonly [number, number]): [number, number] {
  return [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
}
