// A knob for a plane: drag it or use the arrow keys, and something turns in that plane.
import { useRef } from "preact/hooks";

const RADIANS_PER_PIXEL = 0.011;
const KEY_TURN = Math.PI / 36;
const DEGREES = 180 / Math.PI;

interface DialProps {
  /** What it does, for those who hear the page. */
  label: string;
  /** Of the plane, such as "xw". */
  name: string;
  /** Where its hand points, rad. */
  angle: number;
  colour: string;
  /** Turned by so much, rad. */
  onTurn: (angle: number) => void;
  /** Let go of, by pointer or key. */
  onEnd?: () => void;
  /** Double click, or Enter. */
  onQuarter?: () => void;
}

export function Dial({ label, name, angle, colour, onTurn, onEnd, onQuarter }: DialProps) {
  const last = useRef<number | null>(null);
  const along = (event: PointerEvent) => event.clientX - event.clientY;
  const move = (event: PointerEvent) => {
    if (last.current === null) return;
    onTurn((along(event) - last.current) * RADIANS_PER_PIXEL);
    last.current = along(event);
  };
  const end = () => {
    last.current = null;
    onEnd?.();
  };
  const key = (event: KeyboardEvent) => {
    const sign = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1 }[event.key];
    if (sign) onTurn(sign * KEY_TURN);
    else if (event.key === "Enter" && onQuarter) onQuarter();
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
  return (
    <button
      type="button" class="knob" role="slider" aria-label={label} aria-valuenow={Math.round(angle * DEGREES)} aria-valuemin={-180} aria-valuemax={180} title={label}
      onPointerDown={(event) => {
        (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
        last.current = along(event);
      }}
      onPointerMove={move} onPointerUp={end} onPointerCancel={end} onDblClick={onQuarter} onKeyDown={key} onKeyUp={end} onBlur={end}
    >
      <svg viewBox="-20 -20 40 40" aria-hidden="true">
        <circle r="15" class="knob-rim" />
        {[0, 90, 180, 270].map((tick) => <path key={tick} d="M0-18.500v3" transform={`rotate(${tick})`} class="knob-tick" />)}
        <path d="M0 0V-12" transform={`rotate(${angle * DEGREES})`} class="knob-hand" style={{ stroke: colour }} />
      </svg>
      <span>{name}</span>
    </button>
  );
}
