// What the drawing layers know of bodies: their shades, and which is selected, held, pointed at or asleep.
import { Color } from "three";
import type { BodyDescription } from "../engine/protocol";
import { bodyColour, cellShades } from "./palette";

/** How a body looks in every layer. */
export interface BodyStyle {
  readonly css: string;
  /** Bytes of `cellShades`. */
  readonly shades: Uint8Array;
  /** Linear RGB 0..1 of its edges. */
  readonly edge: readonly [number, number, number];
}

/** Edges are the body's colour mixed with so much white. */
const EDGE_WHITENESS = 0.55;

/** Styles by body, and what is being pointed at. */
export class BodyStyles {
  selected: number | null = null;
  hovered: number | null = null;
  private readonly styles = new Map<number, BodyStyle>();
  private readonly fallback = styleOf(bodyColour(0, null));

  setBodies(bodies: readonly BodyDescription[]): void {
    this.styles.clear();
    for (const body of bodies) {
      const stone = body.kind === "static" && !body.colour;
      this.styles.set(body.id, styleOf(stone ? STATIC_COLOUR : bodyColour(body.colourIndex, body.colour)));
    }
  }

  of(body: number): BodyStyle {
    return this.styles.get(body) ?? this.fallback;
  }
}

/** Things that nothing moves are stone. */
const STATIC_COLOUR = "#5d6880";

function styleOf(css: string): BodyStyle {
  const edge = new Color(css).lerp(new Color(1, 1, 1), EDGE_WHITENESS);
  return { css, shades: cellShades(css), edge: [edge.r, edge.g, edge.b] };
}
