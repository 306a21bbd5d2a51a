// Virtual reality: whether there is a headset, entering, and where one stands. The world keeps its coordinates; the rig
// that carries the viewer is placed and scaled instead, so that a scene is as large as a table or a room.
import { signal } from "@preact/signals";
import type { Playground } from "../../app/playground";
import { t } from "../../i18n";
import { Controllers } from "./controllers";

/** Scenes of this extent are shown in their own size, m; larger ones are looked at by a larger viewer. */
const NATURAL_EXTENT = 2.2;
const MOST_SCALE = 8;
/** One stands so many extents in front of the middle. */
const STAND_BACK = 1.7;

class Xr {
  readonly supported = signal(false);
  readonly presenting = signal(false);
  private controllers: Controllers | null = null;

  prepare(playground: Playground): void {
    navigator.xr
      ?.isSessionSupported("immersive-vr")
      .then((supported) => (this.supported.value = supported))
      .catch(() => undefined); // The browser forbids asking: there is no headset for this page.
    const manager = playground.stage.renderer.xr;
    manager.addEventListener("sessionstart", () => this.begin(playground));
    manager.addEventListener("sessionend", () => this.end(playground));
    playground.onPicture.add((seconds) => this.presenting.value && this.controllers?.update(seconds));
  }

  async enter(playground: Playground): Promise<void> {
    try {
      const session = await navigator.xr?.requestSession("immersive-vr", { optionalFeatures: ["local-floor", "bounded-floor"] });
      if (!session) throw new Error(t().vrMissing);
      playground.stage.renderer.xr.setReferenceSpaceType("local-floor");
      await playground.stage.renderer.xr.setSession(session);
    } catch (error) {
      playground.say(error instanceof Error ? error.message : t().vrMissing);
    }
  }

  private begin(playground: Playground): void {
    this.presenting.value = true;
    this.controllers ??= new Controllers(playground);
    const { rig, sceneExtent, sceneMiddle } = playground.stage;
    rig.scale.setScalar(Math.min(MOST_SCALE, Math.max(1, sceneExtent / NATURAL_EXTENT)));
    rig.position.set(sceneMiddle.x, Math.min(0, sceneMiddle.y - sceneExtent), sceneMiddle.z + STAND_BACK * sceneExtent);
    if (sceneMiddle.y >= 0) rig.position.y = 0;
    this.controllers.setVisible(true);
  }

  private end(playground: Playground): void {
    this.presenting.value = false;
    this.controllers?.setVisible(false);
    playground.hands.releaseAll();
    playground.stage.rig.position.set(0, 0, 0);
    playground.stage.rig.scale.setScalar(1);
  }
}

export const xr = new Xr();
