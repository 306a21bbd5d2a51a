// The compass: the world's axes as the slice shows them, in the camera's view, and a knob for each way of turning the
// slice off. An axis that leaves the slice shortens to a ring; what takes its place grows.
import { Vector3 } from "three";
import type { Playground } from "../app/playground";
import { t } from "../i18n";
import { AXES, AXIS_COLOURS } from "./axes";
import { LiveCanvas } from "./canvas";
import { usePlayground } from "./context";
import { Dial } from "./dial";
import { IconButton } from "./icons";

const REACH = 0.7;
/** An axis with less than this in the slice is drawn as a ring. */
const GONE = 0.06;

export function Compass() {
  const playground = usePlayground();
  // Read for its sake: the compass is drawn anew as often as the readout.
  if (!playground.readout.value) return null;
  const { frame } = playground.slice;
  const dimension = frame.rows.length;
  if (dimension === frame.shown) return null;
  // A row for each off direction.
  const planes = Array.from({ length: dimension - frame.shown }, (_, j) => Array.from({ length: frame.shown }, (_, i) => [i, j] as const)).flat();
  return (
    <section class="compass glass" aria-label={t().slice}>
      <LiveCanvas class="gimbal" role="img" aria-label={t().compass} title={t().compass} draw={(context, width, height) => paint(context, width, height, playground)} />
      <div class="compass-buttons">
        <IconButton icon="home" label={t().goHome} onPress={() => playground.slice.home()} />
        <IconButton icon="snap" label={t().snap} onPress={() => playground.slice.snap()} />
      </div>
      <div class="knobs">{planes.map(([i, j]) => <Knob key={`${i}${j}`} view={i} off={j} />)}</div>
    </section>
  );
}

function paint(context: CanvasRenderingContext2D, width: number, height: number, playground: Playground): void {
  const { rows, shown } = playground.slice.frame;
  const size = (Math.min(width, height) / 2) * REACH;
  const turnToCamera = playground.stage.orbit.camera.quaternion.clone().invert();
  const arrows = rows.map((_, axis) => {
    const inSlice = new Vector3(rows[0][axis], rows[1][axis], shown > 2 ? rows[2][axis] : 0);
    return { axis, length: inSlice.length(), tip: inSlice.applyQuaternion(turnToCamera) };
  });
  arrows.sort((a, b) => a.tip.z - b.tip.z);
  context.translate(width / 2, height / 2);
  context.strokeStyle = "rgba(150, 170, 220, 0.2)";
  context.beginPath();
  context.arc(0, 0, size, 0, 2 * Math.PI);
  context.stroke();
  context.lineCap = "round";
  context.font = "600 11px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  let rings = 0;
  for (const { axis, length, tip } of arrows) {
    context.strokeStyle = context.fillStyle = AXIS_COLOURS[axis];
    if (length < GONE) {
      rings += 1;
      context.lineWidth = 1.5;
      context.beginPath();
      context.arc(0, 0, 3 + 3.5 * rings, 0, 2 * Math.PI);
      context.stroke();
      continue;
    }
    const [x, y] = [tip.x * size, -tip.y * size];
    context.globalAlpha = 0.55 + 0.45 * (tip.z + 1) / 2;
    context.lineWidth = 3;
    context.beginPath();
    context.moveTo(0, 0);
    context.lineTo(x, y);
    context.stroke();
    const away = Math.hypot(x, y) || 1;
    context.fillText(AXES[axis], x + (x / away) * 10, y + (y / away) * 10);
    context.globalAlpha = 1;
  }
}

/** Turns the slice from one of the view's axes into an off direction; a double click, or Enter, by 90°. */
function Knob({ view, off }: { view: number; off: number }) {
  const { slice, readout } = usePlayground();
  // The slice's frame is no signal: the readout, which comes with each, is what draws the knob anew.
  const { rows, shown } = readout.value?.slice ?? slice.frame;
  const name = `${AXES[view]}${AXES[shown + off]}`;
  const angle = Math.atan2(rows[view][shown + off], rows[view][view]);
  return (
    <Dial
      label={t().turnPlane(name)} name={name} angle={angle} colour={AXIS_COLOURS[shown + off]}
      onTurn={(by) => slice.turnBy(view, off, by)} onQuarter={() => slice.quarter(view, off, 1)}
    />
  );
}
