// The scenes that the playground brings along beside the engine's: worlds to play with. Their texts are fetched when they
// are opened; `index.json` says what there is. Both are written by tools/scenes.mjs.
import type { BuiltIn } from "../engine/protocol";
import index from "./index.json";

const texts = import.meta.glob<string>("./files/*.json", { query: "?raw", import: "default" });

export const ownScenes: readonly BuiltIn[] = index;

/** The text of one of `ownScenes`; null for other names. */
export async function textOfOwn(name: string): Promise<string | null> {
  const load = texts[`./files/${name}.json`];
  return load ? load() : null;
}
