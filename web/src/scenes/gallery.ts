// The gallery's order: groups as a newcomer does well to meet them, and in them the scenes of the engine and the page's own.
import type { BuiltIn } from "../engine/protocol";
import { ownScenes } from "./own";

const ORDER = ["first", "stacks", "dice", "piles", "games", "links", "friction", "joints", "spins", "bounces", "flatland", "higher", "plane"];

/** Scenes of the engine that stand elsewhere than where their sort puts them. */
const MOVED: Record<string, string> = { dice4d: "dice", dice_pit4d: "dice", rounded4d: "dice", embedded4d: "first" };

/** Scenes whose bodies stand side by side along an off direction: the view's axis that begins as that direction. */
const BEGINS_TURNED: Record<string, number> = { ramp4d: 2 };

/** Which axis of the view, 0 to 2, a scene's first slice has turned into the first off direction; null for the usual slice. */
export function firstTurn(name: string | null): number | null {
  return name === null ? null : (BEGINS_TURNED[name] ?? null);
}

/** Scenes whose things leave the slice at once: the body that the slice goes with from the start, from which the others are never far. */
const BEGINS_FOLLOWING: Record<string, string> = { pendulum4d: "upper" };

/** The name of the body that the slice of a scene follows at first. */
export function firstFollowed(name: string | null): string | null {
  return name === null ? null : (BEGINS_FOLLOWING[name] ?? null);
}

/** From this dimension on scenes have a group of their own, as have those of two. */
const HIGHER = 5;

export interface GalleryGroup {
  group: string;
  scenes: BuiltIn[];
}

/** All scenes, in the order in which they are shown. */
export function allScenes(builtins: readonly BuiltIn[]): BuiltIn[] {
  return galleryGroups(builtins).flatMap(({ scenes }) => scenes);
}

/** The scenes by group; groups that the order does not know come last. */
export function galleryGroups(builtins: readonly BuiltIn[]): GalleryGroup[] {
  const groups = new Map<string, BuiltIn[]>();
  for (const scene of [...ownScenes, ...builtins]) {
    const group = groupOf(scene);
    groups.set(group, [...(groups.get(group) ?? []), scene]);
  }
  const rank = (group: string) => (ORDER.includes(group) ? ORDER.indexOf(group) : ORDER.length);
  return [...groups].map(([group, scenes]) => ({ group, scenes })).sort((a, b) => rank(a.group) - rank(b.group));
}

function groupOf(scene: BuiltIn): string {
  if (scene.dimension >= HIGHER) return "higher";
  if (scene.dimension === 2) return "plane";
  return MOVED[scene.name] ?? scene.group;
}

/** Where the picture of a scene lies, from the page's folder. */
export function pictureOf(name: string): string {
  return `./gallery/${name}.avif`;
}
