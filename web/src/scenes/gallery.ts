// The gallery's order: groups as a newcomer does well to meet them, and in them the built-in scenes.
import type { BuiltIn } from "../engine/protocol";

const ORDER = ["first", "stacks", "dice", "piles", "games", "links", "friction", "joints", "spins", "bounces", "compounds", "flatland", "higher"];

export interface GalleryGroup {
  group: string;
  scenes: BuiltIn[];
}

/** The built-in scenes by group; groups that the order does not know come last. */
export function galleryGroups(builtins: readonly BuiltIn[]): GalleryGroup[] {
  const groups = new Map<string, BuiltIn[]>();
  for (const scene of builtins) groups.set(scene.group, [...(groups.get(scene.group) ?? []), scene]);
  const rank = (group: string) => (ORDER.includes(group) ? ORDER.indexOf(group) : ORDER.length);
  return [...groups].map(([group, scenes]) => ({ group, scenes })).sort((a, b) => rank(a.group) - rank(b.group));
}

/** Where the picture of a scene lies, from the page's folder. */
export function pictureOf(name: string): string {
  return `./gallery/${name}.webp`;
}
