// What a person has chosen, kept in the browser where it allows that: language, sound, what is drawn.
import { effect, signal, type Signal } from "@preact/signals";

const PREFIX = "hyperbody.";

/** A signal that is kept in local storage; what is found there is used if `valid` accepts it. */
export function kept<T>(name: string, initial: T, valid: (value: unknown) => value is T): Signal<T> {
  const value = signal(read(PREFIX + name, initial, valid));
  effect(() => write(PREFIX + name, value.value));
  return value;
}

function read<T>(key: string, initial: T, valid: (value: unknown) => value is T): T {
  try {
    const found: unknown = JSON.parse(localStorage.getItem(key) ?? "null");
    return valid(found) ? found : initial;
  } catch {
    return initial; // Storage is closed to the page, or holds something else.
  }
}

function write(key: string, value: unknown): void {
  try {
    localStorage.setItem(key, JSON.stringify(value));
  } catch {
    // Storage is closed or full: the choice lasts as long as the page.
  }
}

export const isBoolean = (value: unknown): value is boolean => typeof value === "boolean";

export function oneOf<T extends string>(...values: readonly T[]): (value: unknown) => value is T {
  return (value): value is T => values.some((allowed) => allowed === value);
}

export const settings = {
  ghosts: kept("ghosts", true, isBoolean),
  wires: kept("wires", false, isBoolean),
  joints: kept("joints", true, isBoolean),
  edges: kept("edges", true, isBoolean),
  surface: kept<"solid" | "glass" | "off">("surface", "solid", oneOf("solid", "glass", "off")),
  sound: kept("sound", false, isBoolean),
  vibration: kept("vibration", true, isBoolean),
};

/** Whether the person asked the system for less motion. */
export const calm = signal(matchMedia("(prefers-reduced-motion: reduce)").matches);
matchMedia("(prefers-reduced-motion: reduce)").addEventListener("change", (event) => (calm.value = event.matches));
