// Keeps the picture fluent on weak graphics: when pictures take too long for a while, they get coarser, then lose their
// shadows; when there is room again, they get finer, and a level that was too slow once is tried again later and later. Where the processor has to draw (no graphics card), it begins coarse.
// In VR the headset decides.
import type { Stage } from "../view/stage";

/** Pictures slower than this are too slow, faster than that leave room, s. */
const TOO_SLOW = 1 / 34;
const ROOM = 1 / 55;
/** So long pictures have to be too slow, or to leave room, before anything changes, s. */
const PATIENCE_DOWN = 1.2;
const PATIENCE_UP = 6;
/** A level that was too slow is tried again after so many fluent seconds, and at most after so many. */
const FIRST_WAIT = 15;
const LONGEST_WAIT = 600;
/** Pixels of the picture for a pixel of the page (CSS). */
const RATIOS = [0.55, 0.7, 0.85, 1, 1.5, 2] as const;
const PLAIN = 3;

export class QualityGuard {
  private level: number;
  private slow = 0;
  private quick = 0;
  private size: [number, number] = [1, 1];
  /** What this screen can show. */
  private readonly finest: number;
  /** The finest level that has not been too slow lately. */
  private ceiling: number;
  /** Fluent pictures that it takes before a level that was too slow is tried again, s: longer each time that it fails. */
  private wait = FIRST_WAIT;
  /** Fixed by the address: nothing is adapted. */
  private fixed: number | null = null;

  constructor(private readonly stage: Stage) {
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    this.finest = this.ceiling = Math.max(PLAIN, RATIOS.findLastIndex((step) => step <= ratio + 0.01));
    this.level = stage.software ? 0 : this.ceiling;
  }

  /** Draws with this pixel ratio from now on, whatever it costs. */
  fix(ratio: number): void {
    this.fixed = ratio;
    this.apply();
  }

  resize(width: number, height: number): void {
    this.size = [width, height];
    this.apply();
  }

  pictureTook(seconds: number): void {
    if (this.fixed !== null || this.stage.renderer.xr.isPresenting || seconds === 0) return;
    this.slow = seconds > TOO_SLOW ? this.slow + seconds : Math.max(0, this.slow - seconds);
    this.quick = seconds < ROOM ? this.quick + seconds : 0;
    if (this.slow > PATIENCE_DOWN && this.level > 0) {
      this.level -= 1;
      this.ceiling = this.level;
      this.wait = Math.min(LONGEST_WAIT, 2 * this.wait);
      this.apply();
    } else if (this.quick > (this.level < this.ceiling ? PATIENCE_UP : this.wait) && this.level < this.finest) {
      this.level += 1;
      this.ceiling = Math.max(this.ceiling, this.level);
      this.apply();
    }
  }

  private apply(): void {
    this.slow = this.quick = 0;
    this.stage.setShadows(this.fixed !== null || this.level > 0);
    this.stage.resize(...this.size, this.fixed ?? RATIOS[this.level]);
    // Blurred glass costs as much as the picture where the processor draws.
    document.documentElement.classList.toggle("plain", this.fixed === null && this.level < PLAIN);
  }
}
