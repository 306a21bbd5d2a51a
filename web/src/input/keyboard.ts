// The keyboard: everything that hands can do. Keys that are held set speeds, keys that are pressed act once. Letters and signs
// are known by what they write, as the sheet of shortcuts shows them; digits, and letters of other scripts, by their place.
import { Vector3 } from "three";
import { HAND } from "../app/hand-control";
import type { Playground } from "../app/playground";
import { settings } from "../app/settings";
import { centreStride, DRAWN } from "../engine/protocol";
import { toggleGravity, toggleFullscreen } from "../ui/more-panel";
import { menu, sheet, toggleSheet, tourStep } from "../ui/state";
import { SLOW_FACTOR } from "../ui/transport";

const ORBIT_SPEED = 1.6;
const ZOOM_SPEED = 1.4;
const CARRY_SPEED = 1.8;
const SPIN_SPEED = 1.6;
const SCRUB_SPEED = 1.2;
const SCRUB_MEMORY_MS = 300;
/** Turn keys: the view's axis, and the sense. */
const TURN_KEYS: Record<string, [number, number]> = { KeyR: [0, 1], KeyF: [0, -1], KeyT: [1, 1], KeyG: [1, -1], KeyY: [2, 1], KeyH: [2, -1] };
/** Carrying keys: direction in the picture (right, up, away from the viewer). */
const CARRY_KEYS: Record<string, [number, number, number]> = {
  KeyL: [1, 0, 0], KeyJ: [-1, 0, 0], KeyI: [0, 1, 0], KeyK: [0, -1, 0], KeyO: [0, 0, 1], KeyU: [0, 0, -1],
};
/** The keys of an English keyboard that write these, which is what keys are called here. */
const SIGNS: Record<string, string> = { "+": "Equal", "-": "Minus", "[": "BracketLeft", "]": "BracketRight", ".": "Period", ",": "Comma" };

/** What a key is called: by what it writes where that has a name, or else by its place. */
function nameOf({ key, code }: KeyboardEvent): string {
  return /^[a-z]$/i.test(key) ? `Key${key.toUpperCase()}` : (SIGNS[key] ?? code);
}
const ARROWS: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export class KeyboardInput {
  /** Keys that are down, by their place, with their names. */
  private readonly held = new Map<string, string>();
  /** Places of keys that were let go since the last picture: a short press on a slow machine is not lost. */
  private readonly leaving = new Set<string>();
  private alt = false;
  private shift = false;
  private readonly scrubbing = { at: 0, back: 0 };

  constructor(private readonly playground: Playground) {
    addEventListener("keydown", (event) => this.down(event));
    addEventListener("keyup", (event) => this.up(event));
    addEventListener("blur", () => this.releaseAll());
    playground.onPicture.add((seconds) => this.update(seconds));
  }

  private down(event: KeyboardEvent): void {
    [this.alt, this.shift] = [event.altKey, event.shiftKey];
    const name = nameOf(event);
    if (isTyping(event.target) || belongsToControl(event, name)) return;
    if (event.ctrlKey || event.metaKey) {
      if (event.key.toLowerCase() === "z") this.act(event, () => void this.playground.undo());
      return;
    }
    const single = event.repeat ? undefined : this.singleKey(event, name);
    if (single) {
      this.act(event, single);
      return;
    }
    this.held.set(event.code, name);
    this.leaving.delete(event.code);
    if (event.altKey || name in ARROWS) event.preventDefault();
  }

  private act(event: KeyboardEvent, action: () => void): void {
    event.preventDefault();
    action();
  }

  private singleKey(event: KeyboardEvent, name: string): (() => void) | undefined {
    const { playground } = this;
    const { slice } = playground;
    const selected = playground.selected.value;
    if (event.altKey) return undefined;
    if (event.key === "?") return () => toggleSheet("help");
    if (event.shiftKey && name in TURN_KEYS) return () => this.quarter(...TURN_KEYS[name]);
    if (event.shiftKey && (name === "KeyE" || name === "KeyQ")) return () => this.goToNeighbour(name === "KeyE" ? 1 : -1);
    if (name === "Space" && event.target instanceof HTMLButtonElement) return undefined; // Space presses the button.
    const actions: Record<string, () => void> = {
      Space: () => playground.togglePaused(),
      Period: () => playground.stepOnce(),
      Comma: () => playground.setSpeed(playground.speed.value < 1 ? 1 : SLOW_FACTOR),
      Backspace: () => void playground.reset(),
      Home: () => slice.home(),
      Digit0: () => slice.home(),
      Digit9: () => slice.snap(),
      Digit1: () => (settings.surface.value = ({ solid: "glass", glass: "off", off: "solid" } as const)[settings.surface.value]),
      Digit2: () => (settings.ghosts.value = !settings.ghosts.value),
      Digit3: () => (settings.wires.value = !settings.wires.value),
      Digit4: () => (settings.joints.value = !settings.joints.value),
      KeyL: () => (playground.followed.value = playground.followed.value === null ? selected : null),
      KeyN: () => this.cycle(1),
      KeyP: () => this.cycle(-1),
      KeyK: () => void (selected !== null && playground.freeze(selected, !playground.readout.value?.selected?.frozen)),
      Delete: () => void (selected !== null && void playground.remove(selected)),
      KeyV: () => toggleGravity(playground, playground.gravity.value.every((value) => value === 0)),
      KeyA: () => playground.seeAll(),
      KeyW: () => slice.offCount > 1 && playground.setAlong((playground.along.value + 1) % slice.offCount),
      KeyM: toggleFullscreen,
      KeyC: () => toggleSheet("gallery"),
      KeyX: () => toggleSheet("editor"),
      Escape: () => this.escape(),
    };
    return actions[name];
  }

  private escape(): void {
    if (menu.value) menu.value = null;
    else if (sheet.value) sheet.value = null;
    else if (tourStep.value !== null) tourStep.value = null;
    else this.playground.select(null);
  }

  private quarter(view: number, sign: number): void {
    const { slice } = this.playground;
    if (view < slice.frame.shown && slice.offCount > 0) slice.quarter(view, this.playground.along.value, sign);
  }

  private cycle(step: number): void {
    const bodies = (this.playground.scene.value?.bodies ?? []).filter((body) => !body.endless);
    if (bodies.length === 0) return;
    const at = bodies.findIndex((body) => body.id === this.playground.selected.value);
    // Before the first comes the last, also where nothing is selected yet.
    const from = at < 0 && step < 0 ? 0 : at;
    this.playground.select(bodies[(from + step + bodies.length) % bodies.length].id);
  }

  /** Goes to the body whose middle lies next along the chosen off direction. */
  private goToNeighbour(sign: number): void {
    const { frame } = this.playground.client;
    if (!frame || frame.slice.off.length === 0) return;
    let best: { body: number; away: number } | null = null;
    for (let at = 0; at < frame.centres.length; at += centreStride(frame.slice)) {
      const away = sign * frame.centres[at + 1 + DRAWN + this.playground.along.value];
      if (away > 0.05 && (!best || away < best.away)) best = { body: frame.centres[at], away };
    }
    if (best) this.playground.goTo(best.body);
  }

  private up(event: KeyboardEvent): void {
    [this.alt, this.shift] = [event.altKey, event.shiftKey];
    this.leaving.add(event.code);
    if (event.key === "Alt") this.playground.hands.release(HAND.keyboard);
  }

  private releaseAll(): void {
    this.held.clear();
    this.playground.hands.release(HAND.keyboard);
  }

  private update(seconds: number): void {
    this.move(seconds, new Set(this.held.values()));
    for (const place of this.leaving) this.held.delete(place);
    this.leaving.clear();
  }

  /** What the keys of these names, which are held, do in so many seconds. */
  private move(seconds: number, names: ReadonlySet<string>): void {
    const { slice, stage } = this.playground;
    const is = (name: string) => (names.has(name) ? 1 : 0);
    const along = is("KeyE") - is("KeyQ");
    const free = !this.alt && !this.shift;
    for (let j = 0; j < slice.offCount; j++) {
      const chosen = free && j === this.playground.along.value;
      slice.setGlide(j, chosen ? along : 0);
      for (let view = 0; view < slice.frame.shown; view++) {
        const rate = Object.entries(TURN_KEYS).reduce((sum, [code, [axis, sign]]) => sum + (axis === view ? sign * is(code) : 0), 0);
        slice.setSpin(view, j, chosen ? rate : 0);
      }
    }
    if (along !== 0 && free) this.playground.followed.value = null;
    if (this.alt) {
      this.carry(seconds, along, names);
      return;
    }
    for (const [code, [x, y]] of Object.entries(ARROWS)) if (is(code)) stage.orbit.orbit(-x * ORBIT_SPEED * seconds, -y * ORBIT_SPEED * seconds);
    const zoom = is("Minus") + is("NumpadSubtract") - is("Equal") - is("NumpadAdd");
    if (zoom !== 0) stage.orbit.zoom(Math.exp(zoom * ZOOM_SPEED * seconds));
    this.scrub(is("BracketRight") - is("BracketLeft"), seconds);
  }

  private scrub(sense: number, seconds: number): void {
    const history = this.playground.readout.value?.history;
    if (sense === 0 || !history) return;
    const now = performance.now();
    // Frames tell late how far back they are; while the key is held, its own count is the truth.
    if (now - this.scrubbing.at > SCRUB_MEMORY_MS) this.scrubbing.back = history.secondsBack;
    this.scrubbing.at = now;
    this.scrubbing.back = Math.min(history.seconds, Math.max(0, this.scrubbing.back - sense * SCRUB_SPEED * seconds));
    this.playground.scrub(this.scrubbing.back);
  }

  /** Alt and keys move the selected body with a hand of the keyboard's own, which grabs it when first needed. */
  private carry(seconds: number, along: number, names: ReadonlySet<string>): void {
    const { hands, stage } = this.playground;
    const body = this.playground.selected.value;
    const carrying = Object.entries(CARRY_KEYS).filter(([name]) => names.has(name));
    const turning = Object.entries(ARROWS).filter(([name]) => names.has(name));
    if (body === null || (carrying.length === 0 && turning.length === 0 && along === 0)) return;
    if (hands.holds(HAND.keyboard) !== body) {
      const centre = this.playground.centre(body);
      if (!centre || this.playground.body(body)?.kind !== "dynamic") return;
      hands.grab(HAND.keyboard, body, centre, true);
    }
    const { matrixWorld } = stage.orbit.camera;
    const column = (index: number) => new Vector3().setFromMatrixColumn(matrixWorld, index).toArray();
    const [right, up, back] = [column(0), column(1), column(2)];
    for (const [, [x, y, z]] of carrying) {
      for (let row = 0; row < this.playground.drawnFrame().shown; row++) {
        hands.push(HAND.keyboard, row, (x * right[row] + y * up[row] - z * back[row]) * CARRY_SPEED * seconds);
      }
    }
    const { shown } = this.playground.drawnFrame();
    const { pushRow } = this.playground;
    hands.push(HAND.keyboard, pushRow, along * CARRY_SPEED * seconds);
    const n = this.playground.slice.frame.rows.length;
    const pad = (v: number[]) => Array.from({ length: n }, (_, axis) => (axis < 3 ? v[axis] : 0));
    const away = this.shift && n > shown ? Array.from({ length: n }, (_, axis) => (axis === pushRow ? 1 : 0)) : pad(back);
    for (const [, [x, y]] of turning) {
      if (x !== 0) hands.turn(HAND.keyboard, away, pad(right), x * SPIN_SPEED * seconds);
      if (y !== 0) hands.turn(HAND.keyboard, away, pad(up), y * SPIN_SPEED * seconds);
    }
  }
}

/** Keys by which sliders and sheets are used; the world gets the others. In a sheet, all but those that close it. */
const CONTROL_KEYS = new Set(["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End", "PageUp", "PageDown"]);
const SHEET_KEYS = new Set(["Escape", "KeyC", "KeyX", "Slash"]);

function belongsToControl(event: KeyboardEvent, name: string): boolean {
  if (sheet.value !== null) return !SHEET_KEYS.has(name) && event.key !== "?";
  if (!(event.target instanceof HTMLElement)) return false;
  return CONTROL_KEYS.has(event.code) && event.target.matches("input, select, [role=slider], [role=radio]");
}

function isTyping(target: EventTarget | null): boolean {
  return target instanceof HTMLTextAreaElement || (target instanceof HTMLInputElement && target.type === "text");
}
