// Which body is under the pointer, and where: rays against the triangles of the latest frame, boxes of the bodies first.
// Done here because the pointer's shape and colour have to answer within the same frame.
import { Box3, Vector3, type Ray } from "three";
import type { Surface } from "../engine/protocol";

export interface Picked {
  body: number;
  point: Vector3;
  /** Whether the ray met the inside of the surface: it began within the body. */
  fromWithin: boolean;
}

export class Picker {
  private surface: Surface | null = null;
  private boxes: Box3[] | null = null;

  setSurface(surface: Surface): void {
    this.surface = surface;
    this.boxes = null;
  }

  pick(ray: Ray): Picked | null {
    const { surface } = this;
    if (!surface) return null;
    this.boxes ??= boxesOf(surface);
    const { positions, ranges } = surface;
    const [a, b, c, hit, normal] = Array.from({ length: 5 }, () => new Vector3());
    let nearest = Infinity;
    let found: Picked | null = null;
    this.boxes.forEach((box, range) => {
      if (!ray.intersectsBox(box)) return;
      const end = 3 * (ranges[3 * range + 1] + ranges[3 * range + 2]);
      for (let at = 3 * ranges[3 * range + 1]; at < end; at += 9) {
        a.fromArray(positions, at);
        b.fromArray(positions, at + 3);
        c.fromArray(positions, at + 6);
        if (!ray.intersectTriangle(a, b, c, false, hit)) continue;
        const distance = hit.distanceToSquared(ray.origin);
        if (distance >= nearest) continue;
        nearest = distance;
        // By the corners, which go around it as seen from outside: normals of round bodies are smooth.
        const outward = normal.crossVectors(b.sub(a), c.sub(a));
        found = { body: ranges[3 * range], point: hit.clone(), fromWithin: outward.dot(ray.direction) > 0 };
      }
    });
    return found;
  }
}

function boxesOf({ positions, ranges }: Surface): Box3[] {
  const boxes: Box3[] = [];
  const corner = new Vector3();
  for (let range = 0; range < ranges.length; range += 3) {
    const box = new Box3();
    const end = 3 * (ranges[range + 1] + ranges[range + 2]);
    for (let at = 3 * ranges[range + 1]; at < end; at += 3) box.expandByPoint(corner.fromArray(positions, at));
    boxes.push(box);
  }
  return boxes;
}
