// Everything about the selected body, live: where it is, how it moves and turns, what it holds, and the last seconds of it.
import { useEffect, useMemo, useState } from "preact/hooks";
import { HAND } from "../app/hand-control";
import { t } from "../i18n";
import { BODY_COLOURS } from "../view/palette";
import { AXES, AXIS_COLOURS, inOrder, short, signed } from "./axes";
import { LiveCanvas, type Draw } from "./canvas";
import { usePlayground } from "./context";
import { Dial } from "./dial";
import { Icon, IconButton } from "./icons";
import { bodyOpen } from "./state";
import type { Plots, Sample } from "../app/plots";
import type { Planes } from "../engine/protocol";

/** What the panel lies over in its usual place, CSS pixels: so far from the right on wide pages, from below on narrow ones. */
const COVERS = { right: 540, below: 260 };
/** Where it is as far from both its places, from the page's middle. */
const BETWEEN = -71;
const NARROW = 759;
const LOW = 520;

/** Whether the panel goes to its other place, because it would lie over the body that somebody has just touched. */
function covers(place: { x: number; y: number } | null): boolean {
  const { x, y } = place ?? { x: innerWidth / 2, y: innerHeight / 2 };
  if (innerWidth <= NARROW && innerHeight > LOW) return y > innerHeight - COVERS.below;
  return x > Math.max(innerWidth - COVERS.right, innerWidth / 2 + BETWEEN);
}

export function BodyPanel() {
  const playground = usePlayground();
  const selected = playground.readout.value?.selected;
  const id = playground.selected.value;
  const away = useMemo(() => id !== null && covers(playground.onPage(id)), [id]);
  if (!selected || id === null || selected.body !== id) return null;
  const following = playground.followed.value === id;
  return (
    <section class={`body-panel glass ${away ? "away" : ""}`} aria-label={t().body} data-testid="body-panel">
      <header>
        <span class="swatch" style={{ background: playground.stage.styles.of(id).css }} />
        <h2 title={playground.nameOf(id)}>{playground.nameOf(id)}</h2>
        <span class="state">{selected.frozen ? t().frozen : selected.sleeping ? t().asleep : `${short(selected.mass)} kg`}</span>
        <button type="button" class="button" aria-expanded={bodyOpen.value} aria-label={t().body} onClick={() => (bodyOpen.value = !bodyOpen.value)}>
          <Icon name="chevron" />
        </button>
        <IconButton icon="close" label={t().close} onPress={() => playground.select(null)} />
      </header>
      <div class="body-actions">
        <IconButton icon="target" label={t().goThere} onPress={() => playground.goTo(id)} />
        <IconButton icon="follow" label={following ? t().unfollow : t().follow} pressed={following} onPress={() => (playground.followed.value = following ? null : id)} />
        <IconButton icon="freeze" label={selected.frozen ? t().thaw : t().freeze} pressed={selected.frozen} onPress={() => playground.freeze(id, !selected.frozen)} />
        <IconButton icon="trash" label={t().remove} onPress={() => void playground.remove(id)} />
      </div>
      {bodyOpen.value && (
        <div class="numbers">
          {selected.kind === "dynamic" && !selected.frozen && <TurnKnobs key={id} body={id} />}
          <Coordinates name={t().position} unit="m" values={selected.position} testid="position" />
          <Coordinates name={t().velocity} unit="m/s" values={selected.velocity} testid="velocity" />
          <Bars name={t().spin} unit="rad/s" planes={selected.angularVelocity} />
          <Bars name={t().angularMomentum} unit="kg m²/s" planes={selected.angularMomentum} />
          <Coordinates name={t().momentum} unit="kg m/s" values={selected.momentum} />
          <h3>{t().rotor}</h3>
          <p class="rotor">{selected.rotor.map((value) => signed(value)).join(" ")}</p>
          <h3>{t().energy} <small>J</small></h3>
          <p class="energy"><b style={{ color: BODY_COLOURS[1] }}>{short(selected.energy.kinetic)}</b> {t().kinetic} · <b style={{ color: BODY_COLOURS[0] }}>{short(selected.energy.potential)}</b> {t().potential}</p>
          <h3>{t().plots}</h3>
          <LiveCanvas class="plot" role="img" aria-label={t().energy} draw={energyPlot(playground.plots)} />
          <LiveCanvas class="plot" role="img" aria-label={t().spin} draw={spinPlot(playground.plots)} />
        </div>
      )}
    </section>
  );
}

/** An angle within half a turn either way. */
function remainder(angle: number): number {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}

/** Turns the body in every plane of the world, as the numbers beneath count them: by a hand of the panel's own. */
function TurnKnobs({ body }: { body: number }) {
  const playground = usePlayground();
  const { hands } = playground;
  const [turned, setTurned] = useState<Record<string, number>>({});
  const release = () => hands.release(HAND.panel);
  useEffect(() => release, []);
  const n = playground.slice.frame.rows.length;
  const planes = Array.from({ length: n }, (_, i) => Array.from({ length: n - 1 - i }, (_, k) => [i, i + 1 + k] as const)).flat();
  // An axis of the world, in the frame that is drawn.
  const direction = (axis: number) => playground.drawnFrame().rows.map((row) => row[axis]);
  const turn = (name: string, i: number, j: number, by: number) => {
    const centre = playground.centre(body);
    if (hands.holds(HAND.panel) === null && centre) hands.grab(HAND.panel, body, centre, true);
    hands.turn(HAND.panel, direction(i), direction(j), by);
    setTurned((before) => ({ ...before, [name]: remainder((before[name] ?? 0) + by) }));
  };
  return (
    <>
      <h3>{t().turnBody}</h3>
      <div class="knobs turn-knobs">
        {planes.map(([i, j]) => {
          const name = AXES[i] + AXES[j];
          return (
            <Dial
              key={name} label={t().turnBodyIn(name)} name={name} angle={turned[name] ?? 0} colour={AXIS_COLOURS[j]}
              onTurn={(by) => turn(name, i, j, by)} onEnd={release}
            />
          );
        })}
      </div>
    </>
  );
}

function Coordinates({ name, unit, values, testid }: { name: string; unit: string; values: readonly number[]; testid?: string }) {
  return (
    <>
      <h3>{name} <small>{unit}</small></h3>
      <p class="coordinates" data-testid={testid}>
        {values.map((value, axis) => (
          <span key={axis}><i style={{ color: AXIS_COLOURS[axis] }}>{AXES[axis]}</i>{signed(value)}</span>
        ))}
      </p>
    </>
  );
}

function Bars({ name, unit, planes }: { name: string; unit: string; planes: Planes }) {
  const entries = inOrder(planes);
  const most = Math.max(1, ...entries.map(([, value]) => Math.abs(value)));
  return (
    <>
      <h3>{name} <small>{unit}</small></h3>
      <div class="bars">
        {entries.map(([plane, value], index) => (
          <div key={plane} class="bar">
            <i style={{ color: planeColour(index) }}>{plane}</i>
            <span class="track"><span style={{ left: `${value < 0 ? 50 + (50 * value) / most : 50}%`, width: `${(50 * Math.abs(value)) / most}%`, background: planeColour(index) }} /></span>
            <b>{signed(value)}</b>
          </div>
        ))}
      </div>
    </>
  );
}

function planeColour(index: number): string {
  return BODY_COLOURS[index % BODY_COLOURS.length];
}

function energyPlot(plots: Plots): Draw {
  return (context, width, height) => {
    lines(context, width, height, plots.samples, [(sample) => sample.kinetic, (sample) => sample.potential], [BODY_COLOURS[1], BODY_COLOURS[0]]);
  };
}

function spinPlot(plots: Plots): Draw {
  return (context, width, height) => {
    const planes = plots.planes.map((_, i) => (sample: Sample) => sample.angular[i]);
    lines(context, width, height, plots.samples, planes, plots.planes.map((_, i) => planeColour(i)));
  };
}

function lines(
  context: CanvasRenderingContext2D, width: number, height: number, samples: readonly Sample[], values: ((sample: Sample) => number)[], colours: readonly string[],
): void {
  const last = samples.at(-1);
  if (!last || samples.length < 2) return;
  let [low, high] = [0, 1e-6];
  for (const sample of samples) for (const value of values) [low, high] = [Math.min(low, value(sample)), Math.max(high, value(sample))];
  const y = (value: number) => height - 3 - ((value - low) / (high - low)) * (height - 6);
  const x = (time: number) => width - ((last.time - time) / 8) * width;
  context.strokeStyle = "rgba(150, 170, 220, 0.25)";
  context.beginPath();
  context.moveTo(0, y(0));
  context.lineTo(width, y(0));
  context.stroke();
  context.lineWidth = 1.5;
  context.lineJoin = "round";
  values.forEach((value, i) => {
    context.strokeStyle = colours[i];
    context.beginPath();
    samples.forEach((sample, k) => (k === 0 ? context.moveTo(x(sample.time), y(value(sample))) : context.lineTo(x(sample.time), y(value(sample)))));
    context.stroke();
  });
}
