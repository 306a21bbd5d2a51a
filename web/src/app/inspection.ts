// `window.hyperbody`: a look at the running world from the browser's console and from tests. It only reads; to act on the
// world, use the page.
import type { Frame, SceneDescription } from "../engine/protocol";
import type { Playground } from "./playground";
import type { SliceFrame } from "./slice-frame";

export interface Inspection {
  /** The newest frame of the engine; its arrays are valid until the next one. */
  readonly frame: Frame | null;
  readonly scene: SceneDescription | null;
  /** What the gallery calls the scene; null for scenes from elsewhere. */
  readonly sceneName: string | null;
  readonly slice: SliceFrame;
  readonly selected: number | null;
  /** Where the viewer stands in VR: place and scale of the rig, and whether a headset shows it. */
  readonly viewer: { position: number[]; scale: number; presenting: boolean };
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
    get sceneName() {
      return playground.sceneName.value;
    },
    get slice() {
      return playground.slice.frame;
    },
    get selected() {
      return playground.selected.value;
    },
    get viewer() {
      const { rig, renderer } = playground.stage;
      return { position: rig.position.toArray(), scale: rig.scale.x, presenting: renderer.xr.isPresenting };
    },
    whereIs: (body: number) => playground.onPage(body),
    hash: () => playground.client.request("hash", {}),
  });
}
