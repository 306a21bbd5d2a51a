// What a w-strip shows: every body a bar over its extent along an off direction, the slice a bright line. Nothing that leaves the
// slice is lost without a trace: its bar is still there. Drawn on the page and on the wrist in VR.
import type { Playground } from "../app/playground";
import { COOL, WARM } from "../view/palette";
import { offName, signed } from "./axes";

/** Bars have lanes of their own up to this many; more bodies share lanes. */
const MOST_LANES = 26;
const MARGIN = 16;
/** The shown range follows the bodies at this share per picture, so that it does not jump. */
const RANGE_EASE = 0.08;
const LEAST_HALF_RANGE = 1.5;
/** Bodies that fly off do not squeeze the rest: the range ends so many extents from the slice. */
const MOST_EXTENTS = 1.6;

interface Bar {
  body: number;
  low: number;
  high: number;
  lane: number;
}

interface View {
  middle: number;
  half: number;
}

export class StripPicture {
  private readonly view: View = { middle: 0, half: 2 };
  private readonly bars: { list: Bar[]; lanes: number } = { list: [], lanes: 1 };

  constructor(private readonly playground: Playground) {}

  /** The name of an off direction. */
  axis(off: number): string {
    const { frame } = this.playground.slice;
    return offName(frame, Math.min(off, frame.rows.length - frame.shown - 1));
  }

  draw(context: CanvasRenderingContext2D, width: number, height: number, off: number): void {
    collect(this.playground, off, this.bars);
    follow(this.view, this.bars.list, this.playground, off);
    paint(context, width, height, this.view, this.bars, this.playground, off, this.axis(off));
  }

  /** Pixels for a metre, on a strip of this length. */
  scale(length: number): number {
    return (length - 2 * MARGIN) / (2 * this.view.half);
  }

  /** The offset that stands so many pixels along. */
  valueAt(at: number, length: number): number {
    return this.view.middle + (at - length / 2) / this.scale(length);
  }

  /** A tap there goes to the body whose bar it meets, or moves the slice; `across` is a share of the strip's width. */
  tap(value: number, across: number, off: number): void {
    const bar = barAt(this.bars, value, across);
    if (bar) this.playground.goTo(bar.body);
    else this.playground.moveSlice(value, off);
  }
}

function barAt({ list, lanes }: { list: Bar[]; lanes: number }, value: number, across: number): Bar | undefined {
  const lane = across * lanes - 0.5;
  const near = list.filter((bar) => bar.low - 0.1 <= value && value <= bar.high + 0.1 && Math.abs(bar.lane - lane) < 1.2);
  return near.sort((a, b) => Math.abs(a.lane - lane) - Math.abs(b.lane - lane))[0];
}

function collect(playground: Playground, off: number, into: { list: Bar[]; lanes: number }): void {
  const { frame } = playground.client;
  into.list.length = 0;
  if (!frame) return;
  const extents = playground.flatland.value ? playground.flat.extents(frame, playground.slice.frame) : frame.strip;
  const count = playground.slice.offCount;
  const stride = 1 + 2 * count;
  const cut = frame.slice.off[off];
  const origin = playground.flatland.value || !cut ? playground.slice.offset(off) : frame.slice.origin.reduce((sum, value, axis) => sum + value * cut[axis], 0);
  into.lanes = Math.max(1, Math.min(MOST_LANES, Math.floor(extents.length / stride)));
  for (let at = 0, i = 0; at + stride <= extents.length; at += stride, i++) {
    into.list.push({ body: extents[at], low: origin + extents[at + 1 + 2 * off], high: origin + extents[at + 2 + 2 * off], lane: i % into.lanes });
  }
}

function follow(view: View, bars: readonly Bar[], playground: Playground, off: number): void {
  const here = playground.slice.offset(off);
  const most = Math.max(3, MOST_EXTENTS * (playground.scene.value?.extent ?? 3));
  let [low, high] = [here - 0.3, here + 0.3];
  for (const bar of bars) {
    if (bar.high < here - most || bar.low > here + most) continue;
    low = Math.min(low, Math.max(bar.low, here - most));
    high = Math.max(high, Math.min(bar.high, here + most));
  }
  const goal = { middle: (low + high) / 2, half: Math.max(LEAST_HALF_RANGE, (0.56 * (high - low))) };
  view.middle += (goal.middle - view.middle) * RANGE_EASE;
  view.half += (goal.half - view.half) * RANGE_EASE;
}

function paint(
  context: CanvasRenderingContext2D, width: number, height: number, view: View, bars: { list: Bar[]; lanes: number }, playground: Playground, off: number, axis: string,
): void {
  const flat = width > height;
  const [length, across] = flat ? [width, height] : [height, width];
  const upright = context.getTransform();
  // Everything is drawn for a strip that lies flat; an upright one is turned.
  if (!flat) context.transform(0, -1, 1, 0, 0, height);
  const scale = (length - 2 * MARGIN) / (2 * view.half);
  const place = (value: number) => length / 2 + (value - view.middle) * scale;
  const here = place(playground.slice.offset(off));
  const shade = context.createLinearGradient(here - 90, 0, here + 90, 0);
  shade.addColorStop(0, `${COOL}00`);
  shade.addColorStop(0.499, `${COOL}2e`);
  shade.addColorStop(0.501, `${WARM}2e`);
  shade.addColorStop(1, `${WARM}00`);
  context.fillStyle = shade;
  context.fillRect(0, 0, length, across);
  paintTicks(context, view, place, length, across);
  const lane = (across - 14) / bars.lanes;
  const thick = Math.max(1.5, Math.min(9, lane * 0.72));
  const now = playground.slice.offset(off);
  for (const bar of bars.list) {
    const y = 7 + (bar.lane + 0.5) * lane;
    const [from, to] = [Math.max(2, place(bar.low)), Math.min(length - 2, place(bar.high))];
    if (to < from) continue;
    context.globalAlpha = bar.low <= now && now <= bar.high ? 0.95 : 0.36;
    context.fillStyle = playground.stage.styles.of(bar.body).css;
    context.beginPath();
    context.roundRect(from, y - thick / 2, Math.max(2, to - from), thick, thick / 2);
    context.fill();
    if (bar.body !== playground.selected.value) continue;
    context.globalAlpha = 1;
    context.strokeStyle = "#fff";
    context.lineWidth = 1.5;
    context.stroke();
  }
  context.globalAlpha = 1;
  paintSlice(context, here, across);
  context.setTransform(upright);
  label(context, flat, width, height, here, `${axis} ${signed(now).trim()}`);
}

function paintTicks(context: CanvasRenderingContext2D, view: View, place: (value: number) => number, length: number, across: number): void {
  const every = view.half > 12 ? 5 : view.half > 5 ? 2 : 1;
  context.strokeStyle = "rgba(150, 170, 220, 0.16)";
  context.lineWidth = 1;
  const first = Math.ceil((view.middle - 2 * view.half) / every) * every;
  for (let value = first; value < view.middle + 2 * view.half; value += every) {
    const x = Math.round(place(value)) + 0.5;
    if (x < 0 || x > length) continue;
    context.beginPath();
    context.moveTo(x, 0);
    context.lineTo(x, across);
    context.stroke();
  }
}

function paintSlice(context: CanvasRenderingContext2D, here: number, across: number): void {
  context.save();
  context.shadowColor = "#9cc4ff";
  context.shadowBlur = 10;
  context.strokeStyle = "#fff";
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(here, 0);
  context.lineTo(here, across);
  context.stroke();
  context.restore();
  context.fillStyle = "#fff";
  for (const [tip, base] of [[7, 0], [across - 7, across]]) {
    context.beginPath();
    context.moveTo(here, tip);
    context.lineTo(here - 5, base);
    context.lineTo(here + 5, base);
    context.fill();
  }
}

function label(context: CanvasRenderingContext2D, flat: boolean, width: number, height: number, here: number, text: string): void {
  context.font = "600 11px system-ui, sans-serif";
  const wide = context.measureText(text).width + 12;
  const x = flat ? Math.max(wide / 2 + 2, Math.min(width - wide / 2 - 2, here)) : width / 2;
  const y = flat ? height - 11 : Math.max(12, Math.min(height - 12, height - here - 14));
  context.fillStyle = "rgba(8, 12, 26, 0.86)";
  context.beginPath();
  context.roundRect(x - wide / 2, y - 9, wide, 18, 9);
  context.fill();
  context.fillStyle = "#fff";
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText(text, x, y + 0.5);
}
