// Keeps the picture fluent on weak graphics: when pictures take too long for a while, they get coarser, then lose their
// shadows; when there is room again, they get finer. In VR the headset decides.
import type { Stage } from "../view/stage";

/** Pictures slower than this are too slow, faster than that leave room, s. */
const TOO_SLOW = 1 / 34;
const ROOM = 1 / 55;
/** Pictures in a row that decide. */
const PATIENCE = 45;
const RATIOS = [0.5, 0.75, 1, 1.5, 2] as const;

export class QualityGuard {
  private level: number;
  private slow = 0;
  private quick = 0;
  private size: [number, number] = [1, 1];
  /** Once a finer level was too slow, it is not tried again. */
  private ceiling: number;

  constructor(private readonly stage: Stage) {
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    this.level = Math.max(2, RATIOS.findLastIndex((step) => step <= ratio + 0.01));
    this.ceiling = this.level;
  }

  resize(width: number, height: number): void {
    this.size = [width, height];
    this.apply();
  }

  pictureTook(seconds: number): void {
    if (this.stage.renderer.xr.isPresenting || seconds === 0) return;
    this.slow = seconds > TOO_SLOW ? this.slow + 1 : Math.max(0, this.slow - 1);
    this.quick = seconds < ROOM ? this.quick + 1 : 0;
    if (this.slow > PATIENCE && this.level > 0) {
      this.level -= 1;
      this.ceiling = this.level;
      this.apply();
    } else if (this.quick > 8 * PATIENCE && this.level < this.ceiling) {
      this.level += 1;
      this.apply();
    }
  }

  private apply(): void {
    this.slow = this.quick = 0;
    this.stage.setShadows(this.level > 0);
    this.stage.resize(...this.size, RATIOS[this.level]);
  }
}
