// Moves the slice: keys and sliders set speeds and goals, this eases the frame towards them, keeps it on a followed body,
// and says when the worker has to be told.
import { dot, homeFrame, nearestQuarter, shifted, turned, turnsBetween, toWorld, type SliceFrame, type Turn } from "./slice-frame";

/** How fast goals are approached, 1/s. */
const EASE_RATE = 12;
/** Full speed of the keys: along w in m/s, turning in rad/s; and how fast speeds build up, 1/s. */
export const GLIDE_SPEED = 1.6;
export const TURN_SPEED = 1.1;
const SPEED_RATE = 10;
/** Length of an animated turn (snap, home), s. */
const TURN_SECONDS = 0.55;
const STILL = 1e-5;

interface Animation {
  from: SliceFrame;
  turns: Turn[];
  /** Offsets along the rows of the goal that the origin ends with, or null to keep the pivot where it is. */
  origin: readonly number[] | null;
  elapsed: number;
}

export class SliceControl {
  frame: SliceFrame = homeFrame(4, 3);
  /** Rates asked for by keys and sticks, −1 to 1: along each off direction, and view axis → off direction. */
  private readonly glideGoal: number[] = [];
  private readonly glide: number[] = [];
  private readonly spinGoal = new Map<string, number>();
  private readonly spin = new Map<string, number>();
  private offsetGoals: (number | null)[] = [];
  private animation: Animation | null = null;
  private changed = true;
  /** No easing: for those who ask for reduced motion. */
  calm = false;
  /** The world point that stays where it is while the slice turns. */
  pivot: () => readonly number[] = () => this.frame.origin;

  /** Number of off directions. */
  get offCount(): number {
    return this.frame.rows.length - this.frame.shown;
  }

  /** Where the slice stands along its off direction `j`, m from the world's origin; 0 where all is drawn. */
  offset(j = 0): number {
    const row = this.frame.rows[this.frame.shown + j];
    return row ? dot(this.frame.origin, row) : 0;
  }

  /** A new scene's slice: home, or with one axis of the view turned into the first off direction. */
  reset(dimension: number, shown: number, turnedAxis: number | null = null): void {
    const home = homeFrame(dimension, shown);
    this.frame = turnedAxis === null ? home : nearestQuarter(turned(home, turnedAxis, shown, Math.PI / 2, home.origin));
    this.glide.length = this.glideGoal.length = 0;
    this.spin.clear();
    this.spinGoal.clear();
    this.offsetGoals = [];
    this.animation = null;
    this.changed = true;
  }

  setGlide(j: number, rate: number): void {
    this.glideGoal[j] = rate;
    if (rate !== 0) this.offsetGoals[j] = null;
  }

  setSpin(i: number, j: number, rate: number): void {
    this.spinGoal.set(`${i},${j}`, rate);
    if (rate !== 0) this.animation = null;
  }

  /** Eases the slice to an offset along off direction `j`. */
  moveTo(offset: number, j = 0): void {
    this.offsetGoals[j] = offset;
  }

  /** Turns at once, as under a dragging hand. */
  turnBy(i: number, j: number, angle: number): void {
    this.animation = null;
    this.frame = turned(this.frame, i, this.frame.shown + j, angle, this.pivot());
    this.offsetGoals = [];
    this.changed = true;
  }

  /** A quarter turn from view axis `i` towards off direction `j`, ending on the nearest whole quarter. */
  quarter(i: number, j: number, sign: number): void {
    const from = this.animation ? this.goalOf(this.animation) : this.frame;
    const goal = nearestQuarter(turned(from, i, this.frame.shown + j, (sign * Math.PI) / 2, this.pivot()));
    this.animate(goal, null);
  }

  snap(): void {
    this.animate(nearestQuarter(this.frame), null);
  }

  home(): void {
    const goal = homeFrame(this.frame.rows.length, this.frame.shown);
    this.animate(goal, goal.origin);
  }

  /** Is moved along its off directions at once: for a new scene. */
  jump(away: readonly number[]): void {
    away.forEach((distance, j) => this.shift(j, distance));
  }

  /** True once after the frame changed. */
  takeChange(): boolean {
    const { changed } = this;
    this.changed = false;
    return changed;
  }

  /** Moves on by so many seconds; `followed` is the distance to what is followed along each off direction, if anything is. */
  update(seconds: number, followed: readonly number[] | null): void {
    this.animateStep(seconds);
    this.applySpeeds(seconds);
    // Where a body led the slice to, an older wish has nothing to say.
    if (followed) this.offsetGoals = [];
    for (let j = 0; j < this.offCount; j++) {
      const goal = this.offsetGoals[j];
      const away = followed ? followed[j] : goal !== null && goal !== undefined ? goal - this.offset(j) : 0;
      const share = this.calm || Math.abs(away) < 1e-3 ? 1 : 1 - Math.exp(-EASE_RATE * seconds);
      if (share === 1) this.offsetGoals[j] = null;
      if (Math.abs(away) >= STILL) this.shift(j, away * share);
    }
  }

  private shift(j: number, distance: number): void {
    this.frame = shifted(this.frame, this.frame.shown + j, distance);
    this.changed = true;
  }

  private applySpeeds(seconds: number): void {
    const share = this.calm ? 1 : 1 - Math.exp(-SPEED_RATE * seconds);
    for (let j = 0; j < this.offCount; j++) {
      const speed = (this.glide[j] ?? 0) + ((this.glideGoal[j] ?? 0) - (this.glide[j] ?? 0)) * share;
      this.glide[j] = Math.abs(speed) < 1e-3 ? 0 : speed;
      if (this.glide[j] !== 0) this.shift(j, this.glide[j] * GLIDE_SPEED * seconds);
    }
    for (const [key, goal] of this.spinGoal) {
      const old = this.spin.get(key) ?? 0;
      const speed = old + (goal - old) * share;
      this.spin.set(key, Math.abs(speed) < 1e-3 ? 0 : speed);
      if (Math.abs(speed) < 1e-3) continue;
      this.offsetGoals = [];
      const [i, j] = key.split(",").map(Number);
      this.frame = turned(this.frame, i, this.frame.shown + j, speed * TURN_SPEED * seconds, this.pivot());
      this.changed = true;
    }
  }

  private animate(goal: SliceFrame, origin: readonly number[] | null): void {
    this.offsetGoals = [];
    this.animation = { from: this.frame, turns: turnsBetween(this.frame, goal), origin, elapsed: 0 };
  }

  private goalOf(animation: Animation): SliceFrame {
    return this.along(animation, 1);
  }

  /** The frame at the share t of an animation. */
  private along({ from, turns, origin }: Animation, t: number): SliceFrame {
    const pivot = this.pivot();
    let frame = from;
    for (const { i, j, angle } of turns) frame = turned(frame, i, j, angle * t, pivot);
    if (!origin) return frame;
    return { ...frame, origin: from.origin.map((value, axis) => value + (origin[axis] - value) * t) };
  }

  private animateStep(seconds: number): void {
    const { animation } = this;
    if (!animation) return;
    animation.elapsed += seconds;
    const x = this.calm ? 1 : Math.min(1, animation.elapsed / TURN_SECONDS);
    this.frame = this.along(animation, x * x * (3 - 2 * x));
    this.changed = true;
    if (x < 1) return;
    // The end is exact: the rows of a snap are world axes to the bit.
    this.frame = { ...this.frame, rows: this.frame.rows.map((row) => row.map(exactQuarter)) };
    this.animation = null;
  }

  /** The world point at view coordinates. */
  world(coordinates: readonly number[]): number[] {
    return toWorld(this.frame, coordinates);
  }
}

/** 0, 1 or −1 where rounding is all that is missing. */
function exactQuarter(value: number): number {
  const whole = Math.round(value);
  return Math.abs(value - whole) < 1e-9 ? whole + 0 : value;
}
