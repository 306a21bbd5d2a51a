/**
 * How many steps are due: keeps simulated time beside real time, and when the machine is too slow lets simulated time fall
 * behind instead of piling up work.
 */
export class Pacer {
  /** Simulated over wanted time, mean over about a second; 1 when nothing was lost. */
  slowdown = 1;

  private debt = 0;
  private last: number | null = null;
  private factor = 1;

  /** 1 is real time. */
  setSpeed(factor: number): void {
    if (Number.isFinite(factor)) this.factor = Math.min(4, Math.max(0.01, factor));
  }

  /** After a pause: what went by meanwhile does not count. */
  restart(): void {
    this.last = null;
    this.debt = 0;
  }

  /**
   * Calls `step` as often as is due at time `now`, in milliseconds by `clock`, at steps of `dt` seconds, and for no longer
   * than `budget` milliseconds. Says how many it took.
   */
  run(now: number, dt: number, budget: number, clock: () => number, step: () => void): number {
    if (this.last === null) {
      this.last = now;
      return 0;
    }
    // A tab that slept for long does not wake up to a storm of steps.
    const wanted = (Math.min(now - this.last, 250) / 1000) * this.factor;
    this.last = now;
    this.debt += wanted;
    const end = clock() + budget;
    let steps = 0;
    // The rounding of real time must not turn every other frame into none and two steps.
    while (this.debt >= 0.98 * dt) {
      step();
      steps += 1;
      this.debt -= dt;
      if (clock() >= end) break;
    }
    // What could not be done is forgotten, and shown as slowness.
    const lost = Math.max(0, this.debt - dt);
    this.debt -= lost;
    if (wanted > 0) {
      const share = Math.max(0, 1 - lost / Math.max(wanted, dt));
      const weight = Math.min(1, wanted / this.factor);
      this.slowdown += (share - this.slowdown) * weight;
      if (this.slowdown > 0.995) this.slowdown = 1;
    }
    return steps;
  }

  /** Milliseconds until the next step is due, at most 16. */
  pause(now: number, dt: number): number {
    if (this.last === null) return 0;
    const due = ((dt - this.debt) / this.factor) * 1000 - (now - this.last);
    return Math.min(16, Math.max(0, due));
  }
}
