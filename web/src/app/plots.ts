// The last seconds of the selected body: its energies and its angular velocity in every plane, for the live plots.
import { inOrder } from "../ui/axes";
import type { Selected } from "../engine/protocol";

const SECONDS = 8;
const MOST_SAMPLES = 600;

export interface Sample {
  time: number;
  kinetic: number;
  potential: number;
  angular: readonly number[];
}

export class Plots {
  readonly samples: Sample[] = [];
  planes: readonly string[] = [];
  private body: number | null = null;

  clear(): void {
    this.samples.length = 0;
    this.body = null;
  }

  add(time: number, selected: Selected): void {
    const last = this.samples.at(-1);
    if (this.body !== selected.body || (last && time < last.time)) this.clear();
    if (last?.time === time) return;
    this.body = selected.body;
    const planes = inOrder(selected.angularVelocity);
    this.planes = planes.map(([plane]) => plane);
    const { kinetic, potential } = selected.energy;
    this.samples.push({ time, kinetic, potential, angular: planes.map(([, rate]) => rate) });
    while (this.samples.length > MOST_SAMPLES || time - this.samples[0].time > SECONDS) this.samples.shift();
  }
}
