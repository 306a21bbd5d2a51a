// Time: run and pause, single steps, slow motion, back through the last seconds, undo, start again.
import { t } from "../i18n";
import { usePlayground } from "./context";
import { IconButton } from "./icons";

export const SLOW_FACTOR = 0.2;
/** Below this share of real time the page says that the machine is too slow. */
export const SLOW_SHARE = 0.85;

export function Transport() {
  const playground = usePlayground();
  const paused = playground.paused.value;
  const slow = playground.speed.value < 1;
  return (
    <section class="transport glass" aria-label={t().play}>
      <IconButton icon="undo" label={t().undo} disabled={!playground.canUndo} onPress={() => void playground.undo()} />
      <IconButton icon="reset" label={t().reset} onPress={() => void playground.reset()} />
      <IconButton icon={paused ? "play" : "pause"} kind="primary" label={paused ? t().play : t().pause} onPress={() => playground.togglePaused()} />
      <IconButton icon="step" label={t().stepOnce} onPress={() => playground.stepOnce()} />
      <IconButton icon="slow" label={t().slow} pressed={slow} onPress={() => playground.setSpeed(slow ? 1 : SLOW_FACTOR)} />
      <Scrub />
    </section>
  );
}

function Scrub() {
  const playground = usePlayground();
  const history = playground.readout.value?.history;
  const seconds = history?.seconds ?? 0;
  const back = history?.secondsBack ?? 0;
  return (
    <label class="scrub" title={t().scrub}>
      <input
        type="range" min={-Math.max(0.1, seconds)} max={0} step={0.02} value={-back} disabled={seconds < 0.1} aria-label={t().scrub} data-testid="scrub"
        onInput={(event) => playground.scrub(-Number(event.currentTarget.value))}
      />
      <output>{back > 0.01 ? t().secondsBack(back.toFixed(1)) : t().now}</output>
    </label>
  );
}

/** Says so when the machine is too slow, and which bodies had to be stopped. */
export function Warnings() {
  const playground = usePlayground();
  const readout = playground.readout.value;
  if (!readout) return null;
  const slow = !playground.paused.value && readout.slowdown < SLOW_SHARE;
  const stopped = readout.quarantined.map((body) => playground.nameOf(body));
  return (
    <div class="warnings" role="status">
      {slow && <p class="warning">{t().tooSlow((100 * readout.slowdown).toFixed(0))}</p>}
      {stopped.length > 0 && <p class="warning">{t().quarantined(stopped.join(", "))}</p>}
    </div>
  );
}
