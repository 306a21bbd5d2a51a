// What a die has come to show. One that lies on a cell lies with all of it in the ground, so the slice cuts that cell in a face
// whose normal points straight down: the read-out is exact where the slice cuts the cell, and silent where it does not.
import type { Frame } from "../engine/protocol";

/** Cosine from which on a face counts as level. */
const LEVEL = 0.9995;

/** The cell that a body lies on, numbered from 1; null where it stands on an edge, moves over it, or the slice misses the cell. */
export function restsOn(frame: Frame, body: number, gravity: readonly number[]): number | null {
  const { ranges, normals, cells } = frame.surface;
  const strength = Math.hypot(...gravity);
  if (strength === 0) return null;
  const down = [0, 1, 2].map((row) => (frame.slice.axes[row] ?? []).reduce((sum, value, axis) => sum + value * gravity[axis], 0) / strength);
  for (let at = 0; at + 2 < ranges.length; at += 3) {
    if (ranges[at] !== body) continue;
    for (let vertex = ranges[at + 1]; vertex < ranges[at + 1] + ranges[at + 2]; vertex += 3) {
      const level = normals[3 * vertex] * down[0] + normals[3 * vertex + 1] * down[1] + normals[3 * vertex + 2] * down[2];
      if (level > LEVEL) return cells[vertex] + 1;
    }
  }
  return null;
}
