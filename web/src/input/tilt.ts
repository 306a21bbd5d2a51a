// Gravity by the phone's tilt: down in the hand is down in the view's slice.
import { signal } from "@preact/signals";
import type { Playground } from "../app/playground";

/** Waits this long for a first reading before it says that there is no sensor, ms. */
const FIRST_READING_MS = 1500;
const STRENGTH = 9.81;

interface AsksPermission {
  requestPermission(): Promise<"granted" | "denied">;
}

const asks = (type: unknown): type is AsksPermission => typeof type === "function" && "requestPermission" in type;

class Tilt {
  readonly on = signal(false);
  readonly available = typeof DeviceMotionEvent !== "undefined" && matchMedia("(pointer: coarse)").matches;
  private listener: ((event: DeviceMotionEvent) => void) | null = null;

  /** Follows the device from now on; false if it reports no tilt. */
  async start(playground: Playground): Promise<boolean> {
    if (asks(DeviceMotionEvent) && (await DeviceMotionEvent.requestPermission()) !== "granted") return false;
    return new Promise((resolve) => {
      const giveUp = setTimeout(() => {
        this.stop();
        resolve(false);
      }, FIRST_READING_MS);
      this.listener = (event) => {
        const pull = event.accelerationIncludingGravity;
        if (!pull || pull.x === null || pull.y === null || pull.z === null) return;
        clearTimeout(giveUp);
        this.on.value = true;
        playground.setGravityInView(downOf(pull.x, pull.y, pull.z, asks(DeviceMotionEvent)), STRENGTH);
        resolve(true);
      };
      addEventListener("devicemotion", this.listener);
    });
  }

  stop(): void {
    if (this.listener) removeEventListener("devicemotion", this.listener);
    this.listener = null;
    this.on.value = false;
  }
}

/**
 * Down in the screen's axes (right, up, towards the viewer), unit length. By the standard a device at rest reports what holds
 * it, which points up (+z on a table); Apple's report gravity itself, which points down. They are the ones that have to be asked.
 */
export function downOf(x: number, y: number, z: number, reportsGravity: boolean): [number, number, number] {
  const length = (reportsGravity ? 1 : -1) * (Math.hypot(x, y, z) || 1);
  const angle = ((screen.orientation?.angle ?? 0) * Math.PI) / 180;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const [dx, dy] = [x / length, y / length];
  return [c * dx - s * dy, s * dx + c * dy, z / length];
}

export const tilt = new Tilt();
