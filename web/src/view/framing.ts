// Where to look at first: around what can move, as far as it lies in the slice's own directions. What waits far off the
// slice makes a scene large, but not its picture.
import { Box3, Vector3 } from "three";
import type { BodyDescription, Frame } from "../engine/protocol";

/** Where between the lowest and the highest point the camera looks: below the middle, because things fall. */
const LOOK_HEIGHT = 0.45;
/** In a pit, with walls, things lie this much lower in the end than where they begin. */
const FALLEN = 0.45;
/** The corners of the box are rarely full. */
const FILLED = 0.86;

/** Middle and radius of a first picture; null where nothing can be seen. */
export function framing(frame: Frame, bodies: readonly BodyDescription[]): { middle: Vector3; extent: number } | null {
  const stride = frame.slice.origin.length + 1;
  const shown = frame.slice.axes.length;
  const byId = new Map(bodies.map((body) => [body.id, body]));
  const movable = bodies.some((body) => body.kind !== "static" && !body.endless);
  const box = new Box3();
  const centre = new Vector3();
  for (let at = 0; at + stride <= frame.centres.length; at += stride) {
    const body = byId.get(frame.centres[at]);
    if (!body || (movable && body.kind === "static")) continue;
    centre.set(frame.centres[at + 1], frame.centres[at + 2], shown > 2 ? frame.centres[at + 3] : 0);
    // A body's radius reaches its corners; its faces are nearer.
    const reach = 0.7 * body.radius;
    box.expandByPoint(centre.clone().addScalar(reach)).expandByPoint(centre.addScalar(-reach));
  }
  if (box.isEmpty()) return null;
  if (bodies.filter((body) => body.endless).length > 1) box.max.y = box.min.y + FALLEN * (box.max.y - box.min.y);
  const size = box.getSize(new Vector3());
  const middle = box.getCenter(new Vector3());
  middle.y = box.min.y + LOOK_HEIGHT * size.y;
  const extent = FILLED * Math.max(0.52 * Math.hypot(size.x, size.z), 0.74 * size.y, 0.5 * size.x);
  return { middle, extent };
}
