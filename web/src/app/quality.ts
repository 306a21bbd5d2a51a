// Keeps the picture fluent on weak graphics: when pictures take too long for a while, they get coarser, then lose their
// shadows; when there is room again, they get finer, and a level that was too slow once is tried again later and later. Where
// coarser pictures come no faster, drawing is not what takes the time: a screen of 30 pictures a second, or a busy processor.
// Then they stay as fine as they were. Where the processor has to draw (no graphics card), it begins coarse. In VR the headset decides.
import type { Stage } from "../view/stage";

/** Pictures slower than this are too slow, faster than that leave room, s. */
const TOO_SLOW = 1 / 34;
const ROOM = 1 / 55;
/** Coarser by two levels, a quarter of the pixels, pictures have to take less than this share of the time for it to have helped. */
const HELPED = 0.85;
const LEVELS_TO_TRY = 2;
/** Where drawing is not what takes the time, pictures may take so much longer than they usually do, and leave room up to so much. */
const SLACK = 1.3;
const USUAL = 1.1;
/** Time over which the length of pictures is averaged, s. */
const MEAN_OVER = 0.4;
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
  private fluent = 0;
  private size: [number, number] = [1, 1];
  /** What this screen can show. */
  private readonly finest: number;
  /** The finest level that has not been too slow lately. */
  private ceiling: number;
  /** Fluent pictures that it takes before a level that was too slow is tried again, s: longer each time that it fails. */
  private wait = FIRST_WAIT;
  /** Fixed by the address: nothing is adapted. */
  private fixed: number | null = null;

  /** Mean length of the pictures at this level, s. */
  private mean = 0;
  /** The level that began to be too slow, and its pictures' length, s. */
  private tried: { level: number; mean: number } | null = null;
  /** What a picture takes however coarse it is, s; 0 where that is not known. */
  private rhythm = 0;

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
    this.mean = this.mean === 0 ? seconds : this.mean + (seconds - this.mean) * Math.min(1, seconds / MEAN_OVER);
    if (this.mean < HELPED * this.rhythm) this.rhythm = 0;
    const slow = seconds > Math.max(TOO_SLOW, SLACK * this.rhythm);
    this.slow = slow ? this.slow + seconds : Math.max(0, this.slow - seconds);
    this.fluent = slow ? 0 : this.fluent + seconds;
    if (this.fluent > PATIENCE_DOWN) this.tried = null;
    this.quick = seconds < Math.max(ROOM, USUAL * this.rhythm) ? this.quick + seconds : 0;
    if (this.slow > PATIENCE_DOWN) this.coarser();
    else if (this.quick > (this.level < this.ceiling ? PATIENCE_UP : this.wait) && this.level < this.finest) {
      this.level += 1;
      this.ceiling = Math.max(this.ceiling, this.level);
      this.apply();
    }
  }

  private coarser(): void {
    this.tried ??= { level: this.level, mean: this.mean };
    const { level, mean } = this.tried;
    if (this.mean < HELPED * mean) this.tried = { level: this.level, mean: this.mean };
    else if (this.level < level && (this.level === 0 || level - this.level >= LEVELS_TO_TRY)) {
      this.rhythm = this.mean;
      this.level = this.ceiling = level;
      this.tried = null;
      this.apply();
      return;
    }
    if (this.level === 0) return;
    this.level -= 1;
    this.ceiling = this.level;
    this.wait = Math.min(LONGEST_WAIT, 2 * this.wait);
    this.apply();
  }

  private apply(): void {
    this.slow = this.quick = this.fluent = 0;
    this.mean = this.rhythm;
    this.stage.setShadows(this.fixed !== null || this.level > 0);
    this.stage.resize(...this.size, this.fixed ?? RATIOS[this.level]);
    // Blurred glass costs as much as the picture where the processor draws.
    document.documentElement.classList.toggle("plain", this.fixed === null && this.level < PLAIN);
  }
}
