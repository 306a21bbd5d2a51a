// Hands as the page knows them: where each wants its body, in the slice's own coordinates. Kept in the slice, a held body
// goes and turns with the slice when that moves.
import type { EngineClient } from "../engine/client";
import type { Held } from "../engine/protocol";
import { wordsOf } from "../i18n";
import { toFrame, toWorld, type SliceFrame } from "./slice-frame";

/** Rows of an n×n matrix. */
type Matrix = number[][];

interface Hand {
  body: number;
  /** Place in the slice, then off it. */
  place: number[];
  /** Attitude of the hand, in the axes of the slice. */
  attitude: Matrix;
  /** Whether the attitude counts: a mouse that drags leaves the body free to swing. */
  turns: boolean;
  /** The worker has taken hold of it: from then on its frames tell of the hand. */
  confirmed: boolean;
}

/** Which hand is whose: one number for each thing that can hold. */
export const HAND = { pointer: 0, keyboard: 1, panel: 2, left: 10, right: 11 } as const;

export class HandControl {
  private readonly hands = new Map<number, Hand>();

  constructor(
    private readonly client: EngineClient,
    private readonly frame: () => SliceFrame,
    private readonly refused: (reason: string) => void,
  ) {}

  holds(hand: number): number | null {
    return this.hands.get(hand)?.body ?? null;
  }

  /** Takes hold of a body at a world point. */
  grab(hand: number, body: number, point: readonly number[], turns: boolean): void {
    const taking: Hand = { body, place: toFrame(this.frame(), point), attitude: identity(point.length), turns, confirmed: false };
    this.hands.set(hand, taking);
    this.client.request("grab", { hand, body, point: [...point] }).then(() => (taking.confirmed = true)).catch((reason: unknown) => {
      if (this.hands.get(hand) === taking) this.hands.delete(hand);
      this.refused(wordsOf(reason));
    });
  }

  /** Moves a hand to a place in the slice; what it was pushed off the slice stays. */
  moveTo(hand: number, place: readonly number[]): void {
    const held = this.hands.get(hand);
    if (held) place.forEach((value, axis) => axis < this.frame().shown && (held.place[axis] = value));
  }

  /** Moves a hand along a row of the slice's frame. */
  push(hand: number, row: number, distance: number): void {
    const held = this.hands.get(hand);
    if (held && row < held.place.length) held.place[row] += distance;
  }

  place(hand: number): readonly number[] | null {
    return this.hands.get(hand)?.place ?? null;
  }

  /** Turns a hand from one direction of the slice's frame towards another (unit, orthogonal). */
  turn(hand: number, from: readonly number[], to: readonly number[], angle: number): void {
    const held = this.hands.get(hand);
    if (!held) return;
    held.turns = true;
    held.attitude = multiply(planeTurn(from, to, angle), held.attitude);
  }

  /** Gives a hand an attitude in the slice (3×3 rows), for controllers. */
  setAttitude(hand: number, attitude: Matrix): void {
    const held = this.hands.get(hand);
    if (!held) return;
    held.turns = true;
    held.attitude = identity(held.place.length).map((row, i) => row.map((value, j) => attitude[i]?.[j] ?? value));
  }

  release(hand: number): void {
    if (this.hands.delete(hand)) this.client.send("release", { hand });
  }

  releaseAll(): void {
    for (const hand of [...this.hands.keys()]) this.release(hand);
  }

  /** What the worker has let go of, such as a body that was frozen or taken away, is held no more. */
  agree(held: readonly Held[]): void {
    for (const [hand, { confirmed }] of this.hands) {
      if (confirmed && !held.some((each) => each.hand === hand)) this.hands.delete(hand);
    }
  }

  /** The scene is new: nothing is held any more. */
  forget(): void {
    this.hands.clear();
  }

  /** Tells the worker where all hands are; once a frame. */
  update(): void {
    const frame = this.frame();
    for (const [hand, { place, attitude, turns }] of this.hands) {
      const point = toWorld(frame, place);
      if (turns) this.client.send("moveHand", { hand, point, rotation: multiply(transpose(frame.rows), attitude) });
      else this.client.send("moveHand", { hand, point });
    }
  }
}

function identity(n: number): Matrix {
  return Array.from({ length: n }, (_, i) => Array.from({ length: n }, (_, j) => (i === j ? 1 : 0)));
}

function transpose(m: readonly (readonly number[])[]): Matrix {
  return m.map((_, i) => m.map((row) => row[i]));
}

function multiply(a: readonly (readonly number[])[], b: readonly (readonly number[])[]): Matrix {
  return a.map((row) => b[0].map((_, j) => row.reduce((sum, value, k) => sum + value * b[k][j], 0)));
}

/** 1 + (cos − 1)(aaᵀ + bbᵀ) + sin (baᵀ − abᵀ): turns a towards b. */
function planeTurn(a: readonly number[], b: readonly number[], angle: number): Matrix {
  const [c, s] = [Math.cos(angle) - 1, Math.sin(angle)];
  return a.map((_, i) => a.map((_, j) => (i === j ? 1 : 0) + c * (a[i] * a[j] + b[i] * b[j]) + s * (b[i] * a[j] - a[i] * b[j])));
}
