// How a new scene is first seen: through which slice, from where, and, until somebody takes hold, where to as it falls into place.
import { Box3, Vector3 } from "three";
import type { BodyDescription, Frame } from "../engine/protocol";
import { fullestSlice, sight } from "../view/framing";
import type { Stage } from "../view/stage";
import type { SliceFrame } from "./slice-frame";

/** Slices nearer to each other than this are the same, m and rad. */
const SAME_SLICE = 1e-6;
/** The camera goes with a new scene for so long, s of its own time, which a slow machine stretches; what the picture has to hold grows at once and shrinks at this rate, 1/s. */
const SETTLING_SECONDS = 6;
const SHRINK_RATE = 1;
/** What makes the picture larger than so many times what it was at first, is let go where it is farther off than this share of it. */
const MOST_GROWTH = 1.7;
const LET_GO = 0.35;

/** Where the slice stands, and how it is moved at once. */
interface Slicing {
  drawn(): SliceFrame;
  jump(away: readonly number[]): void;
}

export class FirstLook {
  /** A new scene is not drawn before its first frame has said where to look. */
  private opening: "slice" | "camera" | null = null;
  /** Until which time of the scene the camera still goes with it. */
  private until = -Infinity;
  /** Of what was seen at first, m. */
  private size = 0;
  private readonly seen = new Box3();
  private readonly limit = new Box3();
  private readonly first = new Box3();

  constructor(private readonly stage: Stage, private readonly slicing: Slicing) {
    for (const hand of ["pointerdown", "wheel", "keydown"]) addEventListener(hand, () => this.stay(), { capture: true, passive: true });
  }

  /** A new scene: its next frame is its first. */
  begin(): void {
    this.opening = "slice";
    this.until = -Infinity;
  }

  /** The camera stays where it is. */
  stay(): void {
    if (this.until > -Infinity) this.stage.orbit.halt();
    this.until = -Infinity;
  }

  /** Sends the camera to where all that the slice shows is seen. */
  seeAll(frame: Frame, bodies: readonly BodyDescription[]): void {
    const box = sight(frame, bodies);
    if (box) this.stage.see(box);
  }

  /** Whether a frame may be drawn. By the first frames of a scene it chooses where to cut, then, by the cut, from where to look. */
  take(frame: Frame, bodies: readonly BodyDescription[]): boolean {
    if (!this.opening) return true;
    // Frames of the slice that was left are still under way.
    if (!isCutBy(this.slicing.drawn(), frame)) return false;
    if (this.opening === "slice") {
      this.opening = "camera";
      const away = fullestSlice(frame, bodies);
      if (away.some((off) => off !== 0)) {
        this.slicing.jump(away);
        return false;
      }
    }
    this.opening = null;
    const box = sight(frame, bodies, "start");
    if (!box) return true;
    this.stage.setSight(box);
    this.seen.copy(box);
    this.first.copy(box);
    this.size = box.getSize(new Vector3()).length();
    this.limit.copy(box).expandByScalar(LET_GO * this.size);
    this.until = frame.time + SETTLING_SECONDS;
    return true;
  }

  /** Once a picture: goes with what falls, swings and comes to rest. */
  settle(seconds: number, frame: Frame, bodies: readonly BodyDescription[]): void {
    if (this.until === -Infinity) return;
    const now = this.toSee(frame, bodies);
    if (!now || now.isEmpty()) return;
    // What leaves as a whole would be gone: it is followed until somebody takes hold.
    if (frame.time > this.until && now.intersectsBox(this.first)) this.until = -Infinity;
    const share = 1 - Math.exp(-SHRINK_RATE * seconds);
    this.seen.min.lerp(now.min, share).min(now.min);
    this.seen.max.lerp(now.max, share).max(now.max);
    this.stage.see(this.seen, true);
  }

  /** All there is; what rolls away together, without what it leaves behind; of what flies apart, what stays. */
  private toSee(frame: Frame, bodies: readonly BodyDescription[]): Box3 | null {
    const isTooLarge = (box: Box3 | null) => box !== null && box.getSize(new Vector3()).length() > MOST_GROWTH * this.size;
    const all = sight(frame, bodies);
    if (!isTooLarge(all)) return all;
    const moving = sight(frame, bodies, "moving");
    return isTooLarge(moving) ? (all?.intersect(this.limit) ?? null) : moving;
  }
}

/** Whether a frame is a cut by this slice. */
function isCutBy({ origin, rows }: SliceFrame, { slice }: Frame): boolean {
  const isSame = (a: readonly number[], b: readonly number[]) => a.every((value, axis) => Math.abs(value - b[axis]) < SAME_SLICE);
  return isSame(origin, slice.origin) && slice.axes.every((axis, row) => isSame(axis, rows[row]));
}
