// Where to look at first: at what the slice shows of all that can move, and at its ghosts, as near as the panels allow.
import { Box3, Vector3 } from "three";
import type { BodyDescription, Frame } from "../engine/protocol";

/** In a pit, with walls, things lie this much lower in the end than where they begin. */
const FALLEN = 0.5;
/** The floor belongs to the picture where things hang over it by no more than this share of their size. */
const NEAR_FLOOR = 0.8;
/** What stands still belongs to the picture up to so many times the size of what moves. */
const LARGEST_FIXED = 2;
/** Room around it all: a share of its size, and metres. */
const ROOM = 0.05;
const LEAST_ROOM = 0.2;

/**
 * A box in the slice that holds all that a picture has to hold; null where nothing can be seen. At the start things are about
 * to fall; of what only moves, what stands still is left out.
 */
export function sight(frame: Frame, bodies: readonly BodyDescription[], what: "start" | "all" | "moving" = "all"): Box3 | null {
  const fixed = new Set(bodies.filter(({ kind }) => kind === "static").map(({ id }) => id));
  const boxes = sections(frame);
  const box = new Box3();
  for (const [body, its] of boxes) if (!fixed.has(body)) box.union(its);
  const size = box.getSize(new Vector3()).length();
  for (const [body, its] of boxes) {
    if (fixed.has(body) && what !== "moving" && (size === 0 || its.getSize(new Vector3()).length() < LARGEST_FIXED * size)) box.union(its);
  }
  if (box.isEmpty()) return null;
  const height = box.max.y - box.min.y;
  if (what === "start" && bodies.filter((body) => body.endless).length > 1) box.max.y = box.min.y + FALLEN * height;
  const floor = floorBelow(frame, box.getCenter(new Vector3()));
  if (box.min.y - floor < NEAR_FLOOR * size) box.min.y = Math.min(box.min.y, floor);
  return box.expandByScalar(LEAST_ROOM + ROOM * size);
}

/** The box of every section and every ghost. */
export function sections({ surface, ghosts }: Pick<Frame, "surface" | "ghosts">): Map<number, Box3> {
  const boxes = new Map<number, Box3>();
  const corner = new Vector3();
  for (const { positions, ranges } of ghosts ? [surface, ghosts] : [surface]) {
    for (let range = 0; range < ranges.length; range += 3) {
      const box = boxes.get(ranges[range]) ?? new Box3();
      boxes.set(ranges[range], box);
      const end = 3 * (ranges[range + 1] + ranges[range + 2]);
      for (let at = 3 * ranges[range + 1]; at < end; at += 3) box.expandByPoint(corner.fromArray(positions, at));
    }
  }
  return boxes;
}

/** Height of the highest floor straight below a point; −∞ where there is none. */
function floorBelow({ halfSpaces }: Frame, { x, z }: Vector3): number {
  let floor = -Infinity;
  for (let at = 0; at < halfSpaces.length; at += 5) {
    const [nx, ny, nz, offset] = halfSpaces.subarray(at + 1, at + 5);
    if (ny > 0.5) floor = Math.max(floor, (offset - nx * x - nz * z) / ny);
  }
  return floor;
}

/**
 * From where a camera of this attitude sees a box just whole: its place, for half the picture's width and height as tangents.
 * Every corner allows the camera to lie on or behind four planes; seen along one axis at a time they leave an interval, which
 * is not empty from some depth on.
 */
export function placeToSee(box: Box3, [right, up, forward]: readonly Vector3[], tangents: readonly [number, number]): Vector3 {
  const allowed = tangents.map(() => [-Infinity, Infinity]);
  const { min, max } = box;
  for (let k = 0; k < 8; k++) {
    const corner = new Vector3(k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z);
    const depth = corner.dot(forward);
    [right, up].forEach((axis, i) => {
      allowed[i][0] = Math.max(allowed[i][0], corner.dot(axis) - tangents[i] * depth);
      allowed[i][1] = Math.min(allowed[i][1], corner.dot(axis) + tangents[i] * depth);
    });
  }
  const depth = Math.min(...allowed.map(([low, high], i) => (high - low) / (2 * tangents[i])));
  const [across, above] = allowed.map(([low, high]) => (low + high) / 2);
  return new Vector3().addScaledVector(right, across).addScaledVector(up, above).addScaledVector(forward, depth);
}

/** How much of a slice through all off coordinates at 0 counts against a fuller one elsewhere. */
const HOME_IS_BETTER = 1.6;

/**
 * Off coordinates of the slice that shows most of what can move, measured from the frame's slice; zeros where that is nearly as
 * good as any, because that is where scenes are made for. A body counts by how near to its middle it is cut.
 */
export function fullestSlice({ strip, slice }: Frame, bodies: readonly BodyDescription[]): number[] {
  const count = slice.off.length;
  const stride = 1 + 2 * count;
  const movable = new Set(bodies.filter(({ kind }) => kind !== "static").map(({ id }) => id));
  const extents: Float32Array[] = [];
  for (let at = 0; at < strip.length; at += stride) if (movable.has(strip[at])) extents.push(strip.subarray(at + 1, at + stride));
  const fullness = (place: readonly number[]) => extents.reduce((sum, extent) => sum + place.reduce((share, off, j) => {
    const [low, high] = [extent[2 * j], extent[2 * j + 1]];
    const away = (2 * off - low - high) / (high - low);
    return share * Math.sqrt(Math.max(0, 1 - away * away));
  }, 1), 0);
  const home = new Array<number>(count).fill(0);
  let [best, most] = [home, HOME_IS_BETTER * fullness(home)];
  for (const extent of extents) {
    const place = home.map((_, j) => (extent[2 * j] + extent[2 * j + 1]) / 2);
    const here = fullness(place);
    if (here > most) [best, most] = [place, here];
  }
  return best;
}
