// Names and colours of axes and planes, and how numbers are written in panels.
import type { SliceFrame } from "../app/slice-frame";

export const AXES = ["x", "y", "z", "w", "v", "u"] as const;

export const AXIS_COLOURS = ["#f0857d", "#86d98b", "#7fb0ff", "#ffb04a", "#4fe3bd", "#ee86b7"] as const;

/** Beyond this cosine a direction is called by its axis. */
const ALIGNED = 0.9995;

/** The name of a direction: an axis, with a minus where it points back, or the letter of the slice's own, primed. */
export function directionName(direction: readonly number[], otherwise: string): string {
  const axis = direction.findIndex((value) => Math.abs(value) > ALIGNED);
  return axis < 0 ? `${otherwise}′` : `${direction[axis] < 0 ? "−" : ""}${AXES[axis]}`;
}

export function offName(frame: SliceFrame, j: number): string {
  return directionName(frame.rows[frame.shown + j], AXES[frame.shown + j]);
}

/** Planes in lexicographic order of the axes, x y z w v u. */
export function inOrder<T>(planes: Readonly<Record<string, T>>): [string, T][] {
  const rank = (plane: string) => AXES.findIndex((axis) => axis === plane[0]) * AXES.length + AXES.findIndex((axis) => axis === plane[1]);
  return Object.entries(planes).sort(([a], [b]) => rank(a) - rank(b));
}

/** A number with a sign that keeps its width: the true minus, and a space of the same width for plus. */
export function signed(value: number, digits = 2): string {
  const text = Math.abs(value).toFixed(digits);
  return value < 0 && Number(text) !== 0 ? `−${text}` : `\u2007${text}`;
}

export function short(value: number): string {
  const size = Math.abs(value);
  const text = size >= 1000 ? size.toExponential(1) : size >= 100 ? size.toFixed(0) : size >= 10 ? size.toFixed(1) : size.toFixed(2);
  return value < 0 && Number(text) !== 0 ? `−${text}` : text;
}
