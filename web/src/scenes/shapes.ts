// Shapes to add by hand, in the scene format, for worlds of every dimension.
import type { Words } from "../i18n/en";

export interface ShapeChoice {
  /** Key of its name among the words. */
  name: keyof Words["shape"];
  /** Path of its icon on a 24 × 24 grid. */
  icon: string;
  shape: object;
}

const SQUARE = "M5 9h10v10H5zM9 5h10v10H9zM5 9l4-4M15 9l4-4M15 19l4-4M5 19l4-4";
const ROUND = "M12 4a8 8 0 1 0 0 16 8 8 0 0 0 0-16M4 12c3 3 13 3 16 0";
const STAR = "M12 3l7.600 5.500-2.900 9H7.300l-2.900-9zM12 3L7.300 17.500l12.300-9H4.400l12.300 9z";
const DIAMOND = "M12 3l8 9-8 9-8-9zM4 12h16M12 3l-3 9 3 9 3-9z";
const LOG = "M8 6h8a5.500 5.500 0 0 1 0 11H8A5.500 5.500 0 0 1 8 6z";
const SLAB = "M3 13l7-4 11 3-7 4zM3 13v2l11 3 7-4v-2";
const BAR = "M4 17L17 4l3 3L7 20z";
const HEX = "M12 3l8 4.500v9L12 21l-8-4.500v-9zM12 3v18M4 7.500l16 9M20 7.500l-16 9";
const CELLS = "M12 3l8.500 6.200-3.200 10H6.700l-3.200-10zM12 8l4 2.900-1.500 4.700h-5L8 10.900zM12 3v5M20.500 9.200L16 10.900M17.300 19.200l-2.800-3.600M6.700 19.200l2.800-3.600M3.500 9.200L8 10.900";
const FINE = "M12 3.500a8.500 8.500 0 1 0 0 17 8.500 8.500 0 0 0 0-17M12 3.500l7.400 12.700H4.600zM12 20.500L4.600 7.800h14.800z";
const DUO = "M12 5a7 3 0 1 0 0 6 7 3 0 0 0 0-6M5 8v8a7 3 0 0 0 14 0V8M12 8l3.500 8";
const TUBE = "M12 4a6 2.500 0 1 0 0 5 6 2.500 0 0 0 0-5M6 6.500v11a6 2.500 0 0 0 12 0v-11";

/** All of a shape lies within this distance of its middle, m. */
export function radiusOf(shape: object): number {
  const { box, ball, capsule, polytope, product } = shape as Record<string, Record<string, unknown> | undefined>;
  if (box) return Math.hypot(...(box.half_extents as number[]));
  if (capsule) return Number(capsule.half_length) + Number(capsule.radius);
  if (product) return Math.hypot(...(product.factors as { shape: object }[]).map((factor) => radiusOf(factor.shape)));
  return Number(ball?.radius ?? polytope?.circumradius);
}

/** What can be added to a world of this dimension. */
export function shapesFor(n: number): ShapeChoice[] {
  const extents = (first: number, others: number) => Array.from({ length: n }, (_, axis) => (axis === 0 ? first : others));
  const flat = Array.from({ length: n }, (_, axis) => (axis === 1 ? 0.12 : 0.8));
  const always: ShapeChoice[] = [
    { name: "tesseract", icon: SQUARE, shape: { box: { half_extents: extents(0.5, 0.5) } } },
    { name: "ball", icon: ROUND, shape: { ball: { radius: 0.5 } } },
    { name: "capsule", icon: LOG, shape: { capsule: { half_length: 0.5, radius: 0.3, along: "x" } } },
    { name: "plate", icon: SLAB, shape: { box: { half_extents: flat } } },
    { name: "rod", icon: BAR, shape: { box: { half_extents: extents(1.1, 0.18) } } },
  ];
  const regular = (name: ShapeChoice["name"], icon: string, which: string, circumradius = 0.8): ShapeChoice => ({
    name, icon, shape: { polytope: { regular: which, circumradius } },
  });
  if (n === 4) {
    return [
      ...always,
      regular("simplex", STAR, "5-cell"),
      regular("cross", DIAMOND, "16-cell"),
      regular("c24", HEX, "24-cell"),
      regular("c120", CELLS, "120-cell"),
      regular("c600", FINE, "600-cell"),
      { name: "duocylinder", icon: DUO, shape: product({ ball: { radius: 0.5 } }, "xy", { ball: { radius: 0.5 } }, "zw") },
      { name: "spherinder", icon: TUBE, shape: product({ ball: { radius: 0.5 } }, "xyz", { box: { half_extents: [0.5] } }, "w") },
    ];
  }
  return [...always, regular("simplexN", STAR, "simplex"), regular("crossN", DIAMOND, "cross-polytope")];
}

function product(first: object, axes: string, second: object, others: string): object {
  return { product: { factors: [{ shape: first, axes }, { shape: second, axes: others }] } };
}
