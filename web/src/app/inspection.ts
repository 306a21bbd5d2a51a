// `window.hyperbody`: a look at the running world from the browser's console and from tests. It only reads; to act on the
// world, use the page.
import type { Frame, SceneDescription } from "../engine/protocol";
import type { Playground } from "./playground";
import type { SliceFrame } from "./slice-frame";

export interface Inspection {
  /** The newest frame of the engine; its arrays are valid until the next one. */
  readonly frame: Frame | null;
  readonly scene: SceneDescription | null;
  readonly slice: SliceFrame;
  readonly selected: number | null;
  /** Where a body's centre is on the page, CSS pixels; null if there is no such body. */
  whereIs(body: number): { x: number; y: number } | null;
  /** The state hash of the world, as `hyperbody run --json` gives it. */
  hash(): Promise<{ hash: string; step: number }>;
}

declare global {
  interface Window {
    hyperbody?: Inspection;
  }
}

export function offerReadOnly(playground: Playground): void {
  window.hyperbody = Object.freeze({
    get frame() {
      return playground.client.frame;
    },
    get scene() {
      return playground.scene.value;
    },
    get slice() {
      return playground.slice.frame;
    },
    get selected() {
      return playground.selected.value;
    },
    whereIs: (body: number) => playground.onPage(body),
    hash: () => playground.client.request("hash", {}),
  });
}
