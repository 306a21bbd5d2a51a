// What to do when the engine has stopped by an error of its own: the scene once more, then another one, then nothing more, so
// that a scene that always stops the engine does not start it for ever.

/** Stops that are longer ago than this are forgotten, ms. */
const MEMORY_MS = 60_000;
/** So many of them end it. */
const MOST = 4;

export type Remedy = "again" | "another" | "stop";

export class Recovery {
  private stops: { when: number; scene: string }[] = [];

  /** The engine has stopped at this time while it ran this scene. */
  after(when: number, scene: string): Remedy {
    this.stops = this.stops.filter((stop) => when - stop.when < MEMORY_MS);
    const before = this.stops.some((stop) => stop.scene === scene);
    this.stops.push({ when, scene });
    if (this.stops.length >= MOST) return "stop";
    return before ? "another" : "again";
  }

  /** A person asks for a new start: what was is forgotten. */
  forget(): void {
    this.stops = [];
  }
}
