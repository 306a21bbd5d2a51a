// Colours of bodies and of directions. The body colours are brightened from Okabe and Ito's set (2008), which people with
// the common colour blindnesses tell apart; warm and cool for the two sides of the slice differ in lightness too.
import { Color } from "three";

/** Body colours on the dark ground, in an order that keeps neighbours far apart. */
export const BODY_COLOURS = ["#62bdf2", "#f6a53a", "#2cc79f", "#ee86b7", "#f3dd58", "#8090fa", "#ef6c4d", "#bcc6da"] as const;

/** Off the slice on the positive side (towards +w at home), and on the negative side. */
export const WARM = "#ffb04a";
export const COOL = "#57a8ff";

/** Number of shades among which the cells of a body are spread. */
export const CELL_SHADES = 16;

/** How far cells of one body differ: in lightness and in hue, as fractions of the full range. */
const LIGHTNESS_SPREAD = 0.15;
const HUE_SPREAD = 0.035;

/** The golden ratio's fractional part spreads consecutive cells evenly however many there are (Weyl 1916). */
const GOLDEN = 0.618033988749895;

/** CSS colour of a body. */
export function bodyColour(index: number, own: readonly number[] | null): string {
  if (own) return `#${new Color(own[0], own[1], own[2]).getHexString()}`;
  return BODY_COLOURS[index % BODY_COLOURS.length];
}

/** Linear RGB bytes of the shades of a body's cells: `CELL_SHADES` triples, cell c takes the triple c mod CELL_SHADES. */
export function cellShades(colour: string): Uint8Array {
  const shades = new Uint8Array(CELL_SHADES * 3);
  const hsl = { h: 0, s: 0, l: 0 };
  const base = new Color(colour).getHSL(hsl);
  const shade = new Color();
  for (let cell = 0; cell < CELL_SHADES; cell++) {
    const t = ((cell * GOLDEN) % 1) - 0.5;
    const u = ((cell * GOLDEN * GOLDEN) % 1) - 0.5;
    shade.setHSL((base.h + 2 * HUE_SPREAD * u + 1) % 1, base.s, Math.min(0.92, base.l * (1 + 2 * LIGHTNESS_SPREAD * t)));
    shades[3 * cell] = Math.round(255 * shade.r);
    shades[3 * cell + 1] = Math.round(255 * shade.g);
    shades[3 * cell + 2] = Math.round(255 * shade.b);
  }
  return shades;
}
