// The page's address follows what runs: a scene of the gallery stands in it by name, one that came in a link stays in it until
// another one runs. So a reload, a bookmark and a copied address show what was seen.
import { effect } from "@preact/signals";
import type { Playground } from "./playground";

/** Scenes from elsewhere have no name; those in a link have an address already, which is left alone. */
let linked: string | null = null;

/** The scene of this text is the one in the address. */
export function cameInLink(text: string): void {
  linked = text;
}

/** Keeps the address beside the running scene. */
export function followScene(playground: Playground): void {
  effect(() => {
    const name = playground.sceneName.value;
    if (!playground.scene.value) return;
    const address = new URL(location.href);
    if (name !== null) {
      address.hash = "";
      address.searchParams.set("scene", name);
    } else {
      address.searchParams.delete("scene");
      if (playground.text !== linked) address.hash = "";
    }
    try {
      if (address.href !== location.href) history.replaceState(null, "", address);
    } catch {
      // Browsers limit how often: the next change will do.
    }
  });
}
