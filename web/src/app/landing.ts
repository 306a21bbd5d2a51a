// Where a body appears that somebody adds: in the slice, above what is there, where it is seen, and inside nothing.
import { Vector3 } from "three";
import type { BodyDescription, Frame } from "../engine/protocol";
import { radiusOf } from "../scenes/shapes";
import { sections } from "../view/framing";
import type { Playground } from "./playground";
import { dot } from "./slice-frame";

/** It falls so far, so that it is seen to come, m. */
const FALL = 0.25;
/** Rings of places around what the camera looks at, in radii of the body; and what a radius aside counts against one of height. */
const RINGS = [0, 1.3, 2.6, 3.9];
const ASIDE_COUNTS = 0.6;
/** Floors are less steep than walls. */
const FLOOR = 0.2;

/** What lies within this share of the picture's half width and height is not under panels. */
const SEEN = 0.72;

/** Where a shape is added to the running world, in the slice. */
export function whereToLand(playground: Playground, shape: object): Vector3 {
  const { client: { frame }, stage: { orbit: { camera, target } } } = playground;
  const { shown, rows } = playground.drawnFrame();
  const middle = target.clone();
  if (!frame) return middle;
  const up = new Vector3(...rows.slice(0, shown).map((row) => -dot(row, playground.gravity.value)));
  // Where nothing falls, or falls off the slice, up is that of the picture.
  if (up.length() < 0.1) up.set(0, 1, 0);
  up.normalize();
  const right = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
  let aside = [0, 1, 2, 3, 4, 5].map((k) => right.clone().applyAxisAngle(up, (k * Math.PI) / 3));
  if (shown === 2) aside = [new Vector3(1, 0, 0), new Vector3(-1, 0, 0)];
  if (playground.flatland.value) {
    // In the plane.
    const { origin, rows: [, , normal] } = playground.slice.frame;
    const out = new Vector3(...normal);
    middle.addScaledVector(out, dot(origin, normal) - middle.dot(out));
    aside = [out.clone().cross(up).normalize(), up.clone().cross(out).normalize()];
  }
  return landingPlace(frame, playground.scene.value?.bodies ?? [], { target: middle, up, radius: radiusOf(shape), aside, sees: (place) => isSeen(playground, place) });
}

/** Whether a point of the slice is well within the picture. */
export function isSeen({ stage }: Playground, place: Vector3): boolean {
  const { x, y, z } = place.clone().project(stage.orbit.camera);
  return stage.renderer.xr.isPresenting || (Math.abs(x) < SEEN && Math.abs(y) < SEEN && z < 1);
}

interface Block {
  middle: Vector3;
  half: Vector3;
}

export interface Landing {
  /** What the camera looks at, and which way is up, unit length, in the slice. */
  target: Vector3;
  up: Vector3;
  /** All of the body lies within this distance of its middle, m. */
  radius: number;
  /** Ways aside, unit length: the places around the target. */
  aside: readonly Vector3[];
  sees: (place: Vector3) => boolean;
}

/** The middle of the new body: of all places that are seen the lowest near the target, or the lowest at all. */
export function landingPlace(frame: Frame, bodies: readonly BodyDescription[], landing: Landing): Vector3 {
  const { target, radius, aside, sees } = landing;
  const blocks = inTheWay(frame, bodies, radius);
  let best = target;
  let least = Infinity;
  for (const ring of RINGS) {
    for (const way of ring === 0 ? [new Vector3()] : aside) {
      const place = above(target.clone().addScaledVector(way, ring * radius), blocks, frame.halfSpaces, landing);
      const cost = (sees(place) ? 0 : 1e6) + place.dot(landing.up) + ASIDE_COUNTS * ring * radius;
      if (cost < least) [best, least] = [place, cost];
    }
  }
  return best;
}

/** Boxes around all that the body could meet: sections, and of what lies beside the slice, but nearer than the body reaches, all of it. */
function inTheWay(frame: Frame, bodies: readonly BodyDescription[], radius: number): Block[] {
  const cut = sections({ surface: frame.surface, ghosts: null });
  const blocks = [...cut.values()].map((box) => ({ middle: box.getCenter(new Vector3()), half: box.getSize(new Vector3()).multiplyScalar(0.5) }));
  const reach = new Map(bodies.map((body) => [body.id, body.kind === "static" ? 0 : body.radius]));
  const count = frame.slice.off.length;
  const stride = 4 + count;
  for (let at = 0, strip = 1; at < frame.centres.length; at += stride, strip += 1 + 2 * count) {
    const body = frame.centres[at];
    const isNear = Array.from({ length: count }, (_, j) => frame.strip[strip + 2 * j] < radius && frame.strip[strip + 2 * j + 1] > -radius).every(Boolean);
    const size = reach.get(body) ?? 0;
    if (isNear && size > 0 && !cut.has(body)) blocks.push({ middle: new Vector3().fromArray(frame.centres, at + 1), half: new Vector3(size, size, size) });
  }
  return blocks;
}

/** The place straight above or below a point where a ball of this radius has nothing under it but air, and a little of that. */
function above(point: Vector3, blocks: readonly Block[], planes: Float32Array, { up, radius }: Landing): Vector3 {
  const normal = new Vector3();
  let ground = -Infinity;
  for (let at = 0; at < planes.length; at += 5) {
    normal.fromArray(planes, at + 1);
    const within = planes[at + 4] + radius - normal.dot(point);
    const slope = normal.dot(up);
    if (Math.abs(slope) < FLOOR) point.addScaledVector(normal, Math.max(0, within));
    else if (slope > 0) ground = Math.max(ground, point.dot(up) + within / slope);
  }
  const away = new Vector3();
  for (const { middle, half } of blocks) {
    away.subVectors(point, middle);
    away.addScaledVector(up, -away.dot(up));
    const isAside = Math.abs(away.x) > half.x + radius || Math.abs(away.y) > half.y + radius || Math.abs(away.z) > half.z + radius;
    const top = Math.abs(up.x) * half.x + Math.abs(up.y) * half.y + Math.abs(up.z) * half.z;
    if (!isAside) ground = Math.max(ground, middle.dot(up) + top + radius);
  }
  if (ground > -Infinity) point.addScaledVector(up, ground + FALL - point.dot(up));
  return point;
}
