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
  /** Whether there is a headset to enter; null while the browser has not said. */
  readonly supported = signal<boolean | null>(null);
  readonly presenting = signal(false);
  private controllers: Controllers | null = null;

  prepare(playground: Playground): void {
    const asked = navigator.xr?.isSessionSupported("immersive-vr") ?? Promise.resolve(false);
    // A browser that forbids asking has no headset for this page.
    asked.then((supported) => (this.supported.value = supported)).catch(() => (this.supported.value = false));
    // Headsets that are plugged in later count too.
    navigator.xr?.addEventListener("devicechange", () => {
      void navigator.xr?.isSessionSupported("immersive-vr").then((supported) => (this.supported.value = supported), () => undefined);
    });
    const manager = playground.stage.renderer.xr;
    manager.addEventListener("sessionstart", () => this.begin(playground));
    manager.addEventListener("sessionend", () => this.end(playground));
    playground.stage.onSight = () => this.presenting.value && this.place(playground);
    playground.onPicture.add((seconds) => this.presenting.value && this.controllers?.update(seconds));
  }

  async enter(playground: Playground): Promise<void> {
    let session: XRSession | undefined;
    try {
      session = await navigator.xr?.requestSession("immersive-vr", { optionalFeatures: ["local-floor", "bounded-floor"] });
      if (!session) throw new Error(t().vrMissing);
      // Before the session runs: the controllers tell of themselves when it starts.
      this.controllers ??= new Controllers(playground);
      playground.stage.renderer.xr.setReferenceSpaceType("local-floor");
      await playground.stage.renderer.xr.setSession(session);
    } catch (error) {
      // A session that nothing draws into would leave its wearer in the dark.
      await session?.end().catch(() => undefined);
      playground.say(t().vrFailed(error instanceof Error ? error.message : String(error)));
    }
  }

  /** Why there is no VR here, in words; null where there is. */
  missing(): string | null {
    if (this.supported.value !== false) return null;
    if (!isSecureContext) return t().vrInsecure;
    return navigator.xr ? t().vrNoHeadset : t().vrMissing;
  }

  private begin(playground: Playground): void {
    this.presenting.value = true;
    this.place(playground);
    this.controllers?.setVisible(true);
  }

  /** In front of the scene, as large as it asks for. */
  private place(playground: Playground): void {
    const { rig, sceneExtent, sceneMiddle } = playground.stage;
    rig.scale.setScalar(Math.min(MOST_SCALE, Math.max(1, sceneExtent / NATURAL_EXTENT)));
    rig.position.set(sceneMiddle.x, Math.min(0, sceneMiddle.y - sceneExtent), sceneMiddle.z + STAND_BACK * sceneExtent);
    if (sceneMiddle.y >= 0) rig.position.y = 0;
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
