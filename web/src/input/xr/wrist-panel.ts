// The panel on the left wrist: what one cannot reach the page for in VR. A picture drawn on a canvas, pressed by pointing
// with the other hand; with one hand alone it hangs beside the viewer.
import { CanvasTexture, Mesh, MeshBasicMaterial, PlaneGeometry, Raycaster, SRGBColorSpace, type Object3D, type Ray } from "three";
import type { Playground } from "../../app/playground";
import { allScenes } from "../../scenes/gallery";
import { settings } from "../../app/settings";
import { t } from "../../i18n";
import { shapesFor } from "../../scenes/shapes";
import { sceneWords } from "../../ui/gallery";
import { toggleGravity } from "../../ui/more-panel";
import { offName } from "../../ui/axes";
import { SLOW_FACTOR, SLOW_SHARE } from "../../ui/transport";

const WIDTH = 0.3;
export const HEIGHT = 0.30625;
const PIXELS = { width: 720, height: 735 };
const COLUMNS = 3;
const HEADER = 126;
/** A press on "back" goes so far into the past, s. */
const BACK_SECONDS = 2;

interface Button {
  label: () => string;
  pressed: () => boolean;
  act: () => void;
  /** Path of a sign on a 24 × 24 grid, before the label. */
  icon?: string;
}

/** Its size on the canvas, in parts of its grid. */
const ICON_SCALE = 1.9;

export class WristPanel {
  readonly mesh: Mesh<PlaneGeometry, MeshBasicMaterial>;
  private readonly canvas = document.createElement("canvas");
  private readonly texture: CanvasTexture;
  private readonly usual: readonly Button[];
  /** Instead of the usual buttons there are shapes to add. */
  private adding = false;
  private pointed = -1;
  private drawn = "";

  constructor(private readonly playground: Playground) {
    Object.assign(this.canvas, PIXELS);
    this.texture = new CanvasTexture(this.canvas);
    this.texture.colorSpace = SRGBColorSpace;
    this.mesh = new Mesh(new PlaneGeometry(WIDTH, HEIGHT), new MeshBasicMaterial({ map: this.texture, transparent: true }));
    this.usual = this.makeButtons();
  }

  /** Above the back of the left hand, tilted towards the face; or, where only one hand is there, beside the viewer, in its reach. */
  hangOn(wrist: Object3D | null, rig: Object3D): void {
    if (wrist) this.mesh.position.set(0, 0.1, 0.06);
    else this.mesh.position.set(-0.42, 1.25, -0.6);
    this.mesh.rotation.set(wrist ? -0.7 : -0.2, wrist ? 0 : 0.6, 0);
    (wrist ?? rig).add(this.mesh);
  }

  private get buttons(): readonly Button[] {
    return this.adding ? this.palette() : this.usual;
  }

  private makeButtons(): Button[] {
    const { playground } = this;
    const { slice } = playground;
    const never = () => false;
    const selected = (act: (body: number) => void) => () => playground.selected.value !== null && act(playground.selected.value);
    const frozen = () => playground.readout.value?.selected?.frozen ?? false;
    const words = () => t().vrPanel;
    return [
      { label: () => words().pause, pressed: () => playground.paused.value, act: () => playground.togglePaused() },
      { label: () => words().slow, pressed: () => playground.speed.value < 1, act: () => playground.setSpeed(playground.speed.value < 1 ? 1 : SLOW_FACTOR) },
      { label: () => words().back, pressed: never, act: () => this.goBack() },
      { label: () => words().undo, pressed: never, act: () => void playground.undo() },
      { label: () => words().reset, pressed: never, act: () => void playground.reset() },
      { label: () => words().add, pressed: never, act: () => (this.adding = true) },
      { label: () => words().goThere, pressed: never, act: selected((body) => playground.goTo(body)) },
      { label: () => words().freeze, pressed: frozen, act: selected((body) => playground.freeze(body, !frozen())) },
      { label: () => words().remove, pressed: never, act: selected((body) => void playground.remove(body)) },
      { label: () => words().home, pressed: never, act: () => slice.home() },
      { label: () => words().snap, pressed: never, act: () => slice.snap() },
      {
        label: () => words().gravity, pressed: () => playground.gravity.value.some((value) => value !== 0),
        act: () => toggleGravity(playground, playground.gravity.value.every((value) => value === 0)),
      },
      { label: () => words().ghosts, pressed: () => settings.ghosts.value, act: () => (settings.ghosts.value = !settings.ghosts.value) },
      { label: () => words().wires, pressed: () => settings.wires.value, act: () => (settings.wires.value = !settings.wires.value) },
      { label: () => words().step, pressed: never, act: () => playground.stepOnce() },
      { label: () => words().follow, pressed: () => playground.followed.value !== null, act: () => (playground.followed.value = playground.followed.value === null ? playground.selected.value : null) },
      { label: () => words().joints, pressed: () => settings.joints.value, act: () => (settings.joints.value = !settings.joints.value) },
      { label: () => words().glass, pressed: () => settings.surface.value === "glass", act: () => (settings.surface.value = settings.surface.value === "glass" ? "solid" : "glass") },
      { label: () => words().last, pressed: never, act: () => this.openNeighbour(-1) },
      { label: () => words().next, pressed: never, act: () => this.openNeighbour(1) },
      { label: () => words().leave, pressed: never, act: () => void playground.stage.renderer.xr.getSession()?.end() },
    ];
  }

  private openNeighbour(step: number): void {
    const scenes = allScenes(this.playground.builtins.value);
    const at = scenes.findIndex(({ name }) => name === this.playground.sceneName.value);
    void this.playground.open(scenes[(Math.max(0, at) + step + scenes.length) % scenes.length].name);
  }

  /** Time stands two seconds earlier; "pause" goes on from there. */
  private goBack(): void {
    const history = this.playground.readout.value?.history;
    if (history) this.playground.scrub(Math.min(history.seconds, history.secondsBack + BACK_SECONDS));
  }

  /** The shapes that the page has beside the picture. It stays until it is closed: who builds adds more than one. */
  private palette(): Button[] {
    const { playground } = this;
    const shapes = shapesFor(playground.scene.value?.dimension ?? 4).map(({ name, icon, shape }): Button => ({
      label: () => t().shape[name], pressed: () => false, act: () => void playground.spawn(shape, t().shape[name]), icon,
    }));
    return [{ label: () => t().close, pressed: () => true, act: () => (this.adding = false) }, ...shapes];
  }

  /** Lights the button that is pointed at, and draws anew where anything changed. */
  update(rays: readonly Ray[]): void {
    this.pointed = -1;
    for (const ray of rays) this.pointed = Math.max(this.pointed, this.buttonAt(ray) ?? -1);
    const scene = this.playground.scene.value;
    const title = scene ? sceneWords(this.playground.sceneName.value, scene).title : "Hyperbody";
    const told = this.told();
    const state = [title, told, this.pointed, this.playground.slice.offset().toFixed(1), ...this.buttons.map(({ label, pressed }) => label() + pressed())].join("|");
    if (state === this.drawn) return;
    this.drawn = state;
    this.draw(title, told);
  }

  /** What the page says just now; else the body that was touched last, and how fast it goes. */
  private told(): string {
    const { notice, readout, paused } = this.playground;
    if (notice.value) return notice.value.text;
    const share = readout.value?.slowdown ?? 1;
    if (!paused.value && share < SLOW_SHARE) return t().tooSlow((100 * share).toFixed(0));
    const body = this.playground.readout.value?.selected;
    if (!body) return t().vrPanel.hint;
    return `${this.playground.nameOf(body.body)} · ${Math.hypot(...body.velocity).toFixed(1)} m/s`;
  }

  /** Presses what the ray meets; false if it misses the panel. */
  press(ray: Ray): boolean {
    const button = this.buttonAt(ray);
    if (button === null) return false;
    this.buttons[button]?.act();
    return true;
  }

  /** Rows are as high as the usual buttons fill the panel. */
  private get rowHeight(): number {
    return (PIXELS.height - HEADER) / Math.ceil(this.usual.length / COLUMNS);
  }

  /** The number of the button; −1 beside them on the panel, null beside the panel. */
  private buttonAt(ray: Ray): number | null {
    const caster = new Raycaster(ray.origin, ray.direction);
    const uv = this.mesh.visible ? caster.intersectObject(this.mesh, false)[0]?.uv : undefined;
    if (!uv) return null;
    const [x, y] = [uv.x * PIXELS.width, (1 - uv.y) * PIXELS.height - HEADER];
    if (y < 0) return -1;
    const button = Math.floor(y / this.rowHeight) * COLUMNS + Math.floor((x / PIXELS.width) * COLUMNS);
    return button < this.buttons.length ? button : -1;
  }

  private draw(title: string, told: string): void {
    const context = this.canvas.getContext("2d");
    if (!context) return;
    const { width, height } = PIXELS;
    context.clearRect(0, 0, width, height);
    context.fillStyle = "rgba(12, 17, 34, 0.92)";
    context.beginPath();
    context.roundRect(0, 0, width, height, 30);
    context.fill();
    context.fillStyle = "#fff";
    context.textBaseline = "middle";
    context.font = "600 30px system-ui, sans-serif";
    context.fillText(title, 28, 44, width - 190);
    context.font = "26px system-ui, sans-serif";
    if (this.playground.slice.offCount > 0) context.fillText(`${offName(this.playground.slice.frame, 0)} ${this.playground.slice.offset().toFixed(1)}`, width - 130, 44);
    context.fillStyle = "#b9c6e8";
    context.fillText(told, 28, 92, width - 56);
    const buttonHeight = this.rowHeight;
    this.buttons.forEach(({ label, pressed, icon }, i) => {
      const [x, y] = [((i % COLUMNS) * width) / COLUMNS + 10, HEADER + Math.floor(i / COLUMNS) * buttonHeight];
      context.fillStyle = i === this.pointed ? "#4f7fd6" : pressed() ? "#2d4a80" : "#1d2745";
      context.beginPath();
      context.roundRect(x, y, width / COLUMNS - 20, buttonHeight - 12, 18);
      context.fill();
      context.fillStyle = "#fff";
      const middle = y + (buttonHeight - 12) / 2;
      const indent = icon ? 24 * ICON_SCALE + 12 : 0;
      if (icon) drawIcon(context, icon, x + 12, middle - 12 * ICON_SCALE);
      context.fillText(label(), x + 20 + indent, middle + 2, width / COLUMNS - 60 - indent);
    });
    this.texture.needsUpdate = true;
  }
}

function drawIcon(context: CanvasRenderingContext2D, path: string, left: number, top: number): void {
  context.save();
  context.translate(left, top);
  context.scale(ICON_SCALE, ICON_SCALE);
  context.strokeStyle = "#9ec1ff";
  context.lineWidth = 1.4;
  context.stroke(new Path2D(path));
  context.restore();
}
