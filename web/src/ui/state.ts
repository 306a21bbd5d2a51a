// What of the page's panels is open; apart from the world, so that closing a panel never touches the simulation.
import { signal } from "@preact/signals";

export type Sheet = "gallery" | "editor" | "help" | "more";

export const sheet = signal<Sheet | null>(null);
/** The menu of a body: where on the page, and whose. */
export const menu = signal<{ x: number; y: number; body: number } | null>(null);
/** Step of the tour, or null when none runs. */
export const tourStep = signal<number | null>(null);
/** On narrow screens: whether the shapes, and the numbers of the body, are unfolded. */
export const shapesOpen = signal(false);
export const bodyOpen = signal(matchMedia("(min-width: 760px)").matches);

export function toggleSheet(name: Sheet): void {
  sheet.value = sheet.value === name ? null : name;
}
