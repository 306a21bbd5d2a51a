// What is drawn, where gravity points, what goes out as files, and the measured times.
import { toggleRecording, recording } from "../app/recorder";
import { settings } from "../app/settings";
import { tilt } from "../input/tilt";
import { xr } from "../input/xr/session";
import { language, t, wordsOf } from "../i18n";
import { AXES, AXIS_COLOURS, short } from "./axes";
import { usePlayground } from "./context";
import { Dialog } from "./dialog";
import { download, fileName } from "./files";
import { IconButton } from "./icons";
import { sheet } from "./state";
import type { Playground } from "../app/playground";
import type { Signal } from "@preact/signals";

const STANDARD_GRAVITY = 9.81;
const STRONGEST_GRAVITY = 20;

export function MorePanel() {
  return (
    <Dialog title={t().more} kind="more">
      <ViewChoices />
      <Gravity />
      <Files />
      <section class="choices">
        <Switch label={t().sound} value={settings.sound} />
        <Switch label={t().vibration} value={settings.vibration} />
      </section>
      <section class="row">
        <button type="button" class="button text" data-testid="language" onClick={() => (language.value = language.value === "en" ? "zh" : "en")}>{t().changeLanguage}</button>
        <IconButton icon="help" text label={t().help} onPress={() => (sheet.value = "help")} />
        <IconButton icon="full" text label={t().fullscreen} onPress={toggleFullscreen} />
      </section>
      <VirtualReality />
      <Measured />
    </Dialog>
  );
}

export function toggleFullscreen(): void {
  if (document.fullscreenElement) void document.exitFullscreen();
  else document.documentElement.requestFullscreen?.().catch(() => undefined); // Refused: the page stays as it is.
}

export function Switch({ label, value }: { label: string; value: Signal<boolean> }) {
  return (
    <label class="switch">
      <input type="checkbox" role="switch" checked={value.value} onChange={(event) => (value.value = event.currentTarget.checked)} />
      <span>{label}</span>
    </label>
  );
}

function ViewChoices() {
  const modes = [["solid", t().solid], ["glass", t().glass], ["off", t().hidden]] as const;
  return (
    <section class="choices">
      <h3>{t().viewMode}</h3>
      <div class="segments" role="radiogroup" aria-label={t().viewMode}>
        {modes.map(([mode, label]) => (
          <button key={mode} type="button" role="radio" aria-checked={settings.surface.value === mode} onClick={() => (settings.surface.value = mode)}>{label}</button>
        ))}
      </div>
      <Switch label={t().edges} value={settings.edges} />
      <Switch label={t().ghosts} value={settings.ghosts} />
      <Switch label={t().wires} value={settings.wires} />
      <Switch label={t().joints} value={settings.joints} />
    </section>
  );
}

function Gravity() {
  const playground = usePlayground();
  const vector = playground.gravity.value;
  const strength = Math.hypot(...vector);
  const set = (axis: number, sign: number, size: number) => playground.setGravity(vector.map((_, i) => (i === axis ? sign * size : 0)));
  const axis = vector.reduce((best, value, i) => (Math.abs(value) > Math.abs(vector[best]) ? i : best), 0);
  const sign = strength > 0 ? Math.sign(vector[axis]) : -1;
  const isAlongAxis = strength > 0 && Math.abs(vector[axis]) > 0.999 * strength;
  return (
    <section class="choices gravity">
      <h3>{t().gravity}</h3>
      <label class="switch">
        <input type="checkbox" role="switch" checked={strength > 0} data-testid="gravity-on" onChange={(event) => toggleGravity(playground, event.currentTarget.checked)} />
        <span>{t().gravityOn}</span>
      </label>
      <div class="directions" role="radiogroup" aria-label={t().direction}>
        {vector.flatMap((_, i) => [-1, 1].map((s) => (
          <button
            key={`${i}${s}`} type="button" role="radio" aria-checked={isAlongAxis && i === axis && s === sign} style={{ color: AXIS_COLOURS[i] }}
            onClick={() => set(i, s, strength || STANDARD_GRAVITY)}
          >{s < 0 ? "−" : "+"}{AXES[i]}</button>
        )))}
      </div>
      <div class="row">
        <button type="button" class="button" data-testid="gravity-view" onClick={() => playground.setGravityInView([0, -1, 0], strength || STANDARD_GRAVITY)}>{t().gravityView}</button>
      </div>
      <label class="slider">
        <span>{t().strength}</span>
        <input
          type="range" min={0} max={STRONGEST_GRAVITY} step={0.1} value={strength}
          onInput={(event) => {
            const size = Number(event.currentTarget.value);
            if (strength > 0) playground.setGravity(vector.map((value) => (value * size) / strength));
            else set(1, -1, size);
          }}
        />
        <output>{short(strength)}</output>
      </label>
      {tilt.available && (
        <label class="switch">
          <input
            type="checkbox" role="switch" checked={tilt.on.value}
            onChange={(event) => void setTilt(playground, event.currentTarget)}
          />
          <span>{t().gravityTilt}</span>
        </label>
      )}
    </section>
  );
}

/** Follows the device, or not; where it cannot, the switch says so too. */
async function setTilt(playground: Playground, box: HTMLInputElement): Promise<void> {
  if (!box.checked) {
    tilt.stop();
    return;
  }
  // Refused permission is no tilt either.
  const works = await tilt.start(playground).catch(() => false);
  box.checked = works;
  if (!works) playground.say(t().gravityNoTilt);
}

/** Gravity off, or on again as the scene has it (straight down where the scene has none). */
export function toggleGravity(playground: Playground, on: boolean): void {
  const scene = playground.scene.value;
  if (!scene) return;
  const own = scene.gravity.some((value) => value !== 0) ? scene.gravity : scene.gravity.map((_, axis) => (axis === 1 ? -STANDARD_GRAVITY : 0));
  playground.setGravity(on ? own : own.map(() => 0));
}

function Files() {
  const playground = usePlayground();
  const title = playground.scene.value?.title ?? "hyperbody";
  const save = (content: BlobPart, extension: string, type: string) => {
    download(fileName(title, extension), content, type);
    playground.say(t().saved(fileName(title, extension)));
  };
  const slice = async (format: "stl" | "glb") => {
    try {
      const { bytes } = await playground.client.request("export", { format });
      save(bytes, format, format === "stl" ? "model/stl" : "model/gltf-binary");
    } catch (error) {
      playground.say(wordsOf(error));
    }
  };
  const record = () => {
    const works = toggleRecording(playground.stage.renderer.domElement, (film, extension) => save(film, extension, film.type));
    if (!works) playground.say(t().noRecorder);
  };
  return (
    <section class="row files">
      <IconButton icon="camera" text label={t().picture} onPress={() => playground.takePicture((picture) => save(picture, "png", "image/png"))} />
      <IconButton icon="record" text label={recording.value ? t().stopRecording : t().record} pressed={recording.value} onPress={record} />
      <IconButton icon="save" text label={t().exportStl} onPress={() => void slice("stl")} />
      <IconButton icon="save" text label={t().exportGlb} onPress={() => void slice("glb")} />
    </section>
  );
}

/** The way into VR, or why there is none here. */
function VirtualReality() {
  const playground = usePlayground();
  const missing = xr.missing();
  if (missing === null && !xr.supported.value) return null;
  return (
    <section class="choices">
      <h3>{t().vr}</h3>
      {missing === null ? <IconButton icon="vr" text label={t().enterVr} onPress={() => void xr.enter(playground)} /> : <p class="hint" data-testid="vr-missing">{missing}</p>}
    </section>
  );
}

function Measured() {
  const playground = usePlayground();
  const readout = playground.readout.value;
  const scene = playground.scene.value;
  if (!readout || !scene) return null;
  return (
    <p class="measured">
      {t().dimensions(scene.dimension)} · {t().bodies(scene.bodies.length)} · {t().physicsMs} {readout.workerMs.physics.toFixed(1)} ms · {t().slicingMs} {readout.workerMs.slicing.toFixed(1)} ms ·{" "}
      {readout.step} {t().steps} · {t().energy} {short(readout.energy.total)} J
    </p>
  );
}
