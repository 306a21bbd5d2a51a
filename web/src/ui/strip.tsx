// The w-strip under pointer and keys: drag to move the slice, tap a bar to go to that body.
import { useMemo, useRef } from "preact/hooks";
import { t } from "../i18n";
import { signed } from "./axes";
import { LiveCanvas } from "./canvas";
import { usePlayground } from "./context";
import { StripPicture } from "./strip-picture";

const TAP_PIXELS = 5;
const KEY_STEP = 0.1;
/** What those who hear the page are told of the range, m: there is no end. */
const RANGE = 100;

export function Strip({ off }: { off: number }) {
  const playground = usePlayground();
  const picture = useMemo(() => new StripPicture(playground), [playground]);
  const drag = useRef<{ start: number; offset: number; moved: boolean } | null>(null);
  // Read for its sake: the slice may turn, and its directions have other names then.
  const axis = playground.readout.value ? picture.axis(off) : "w";

  const offset = playground.slice.offset(off);

  const along = (event: PointerEvent) => {
    const box = (event.currentTarget as HTMLElement).getBoundingClientRect();
    const flat = box.width > box.height;
    const [at, length] = flat ? [event.clientX - box.left, box.width] : [box.bottom - event.clientY, box.height];
    const across = flat ? (event.clientY - box.top) / box.height : (event.clientX - box.left) / box.width;
    return { at, value: picture.valueAt(at, length), scale: picture.scale(length), across };
  };
  const down = (event: PointerEvent) => {
    (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    playground.setAlong(off);
    drag.current = { start: along(event).at, offset: playground.slice.offset(off), moved: false };
  };
  const move = (event: PointerEvent) => {
    const held = drag.current;
    if (!held) return;
    const { at, scale } = along(event);
    if (Math.abs(at - held.start) > TAP_PIXELS) held.moved = true;
    if (!held.moved) return;
    playground.moveSlice(held.offset + (at - held.start) / scale, off);
  };
  const up = (event: PointerEvent) => {
    const held = drag.current;
    drag.current = null;
    if (!held || held.moved) return;
    const { value, across } = along(event);
    picture.tap(value, across, off);
  };
  const key = (event: KeyboardEvent) => {
    const sign = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1 }[event.key];
    if (!sign) return;
    event.preventDefault();
    event.stopPropagation();
    playground.moveSlice(playground.slice.offset(off) + sign * KEY_STEP, off);
  };
  return (
    <LiveCanvas
      class={`strip ${playground.slice.offCount > 1 && playground.along.value === off ? "chosen" : ""}`} role="slider" tabIndex={0} aria-label={t().sliceAlong(axis)} aria-valuenow={Number(offset.toFixed(2))} aria-valuemin={Math.min(-RANGE, offset)} aria-valuemax={Math.max(RANGE, offset)} aria-valuetext={`${axis} ${signed(offset).trim()} m`} title={t().strip}
      data-testid={`strip-${off}`} onPointerDown={down} onPointerMove={move} onPointerUp={up} onPointerCancel={() => (drag.current = null)} onKeyDown={key}
      draw={(context, width, height) => picture.draw(context, width, height, off)}
    />
  );
}
