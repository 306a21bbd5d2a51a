// What an impact feels and sounds like: a short knock whose strength and pitch follow the impulse and the body's size, and
// a pulse of the phone when something that is held hits. Controllers pulse in xr.ts.
import type { Playground } from "../app/playground";
import { settings } from "../app/settings";
import type { Frame, Impact } from "../engine/protocol";
import { HAND } from "../app/hand-control";

/** Impulses per unit mass below this are not felt or heard; from the other on they are at full strength, m/s. */
const FAINT = 0.25;
const FULL = 6;
const MOST_KNOCKS = 6;
/** Pitch of a body of 1 m radius, Hz; smaller ones are higher in proportion. */
const PITCH = 190;
const KNOCK_SECONDS = 0.16;
const LONGEST_PULSE_MS = 45;

/** Strength of an impact, 0 to 1, by the change of speed that it made. */
export function strengthOf(impact: Impact, mass: number): number {
  const speed = impact.impulse / Math.max(mass, 1e-6);
  return Math.min(1, Math.max(0, (speed - FAINT) / (FULL - FAINT)));
}

export class Feedback {
  private audio: AudioContext | null = null;

  constructor(private readonly playground: Playground) {
    playground.onFrame.add((frame) => this.take(frame));
    settings.sound.subscribe((on) => on && this.wake());
    // Browsers let sound start only after a press.
    addEventListener("pointerdown", () => settings.sound.value && this.wake());
  }

  private wake(): void {
    this.audio ??= typeof AudioContext === "undefined" ? null : new AudioContext();
    void this.audio?.resume();
  }

  private take(frame: Frame): void {
    if (frame.impacts.length === 0) return;
    const loudest = frame.impacts
      .map((impact) => ({ impact, strength: strengthOf(impact, this.lightest(impact)) }))
      .filter(({ strength }) => strength > 0)
      .sort((a, b) => b.strength - a.strength)
      .slice(0, MOST_KNOCKS);
    for (const { impact, strength } of loudest) {
      if (settings.sound.value) this.knock(impact, strength);
    }
    // A pulse takes the place of the one before: the strongest of a frame is felt.
    const felt = loudest.find(({ impact }) => impact.hands.includes(HAND.pointer));
    if (felt && settings.vibration.value) navigator.vibrate?.(Math.ceil(LONGEST_PULSE_MS * felt.strength));
  }

  private lightest({ body, other }: Impact): number {
    const masses = [body, other].map((id) => this.playground.body(id)?.mass ?? 0).filter((mass) => mass > 0);
    return Math.min(...masses, Infinity);
  }

  private knock(impact: Impact, strength: number): void {
    const { audio } = this;
    if (audio?.state !== "running") return;
    const radii = [impact.body, impact.other].map((id) => this.playground.body(id)?.radius ?? 0).filter((radius) => radius > 0);
    const pitch = PITCH / Math.max(0.15, Math.min(...radii, 4));
    const now = audio.currentTime;
    const gain = audio.createGain();
    gain.gain.setValueAtTime(0.35 * strength ** 1.5, now);
    gain.gain.exponentialRampToValueAtTime(1e-4, now + KNOCK_SECONDS);
    gain.connect(audio.destination);
    // Two partials that are not in a simple ratio sound like wood rather than like a note.
    for (const [ratio, type] of [[1, "sine"], [2.76, "triangle"]] as const) {
      const tone = audio.createOscillator();
      tone.type = type;
      tone.frequency.setValueAtTime(pitch * ratio * 1.15, now);
      tone.frequency.exponentialRampToValueAtTime(pitch * ratio, now + 0.03);
      tone.connect(gain);
      tone.start(now);
      tone.stop(now + KNOCK_SECONDS);
    }
  }
}
