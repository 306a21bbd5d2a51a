// The panel on the left wrist: what one cannot reach the page for in VR. A picture drawn on a canvas, pressed by pointing
// with the other hand.
import { CanvasTexture, Mesh, MeshBasicMaterial, PlaneGeometry, Raycaster, SRGBColorSpace, type Ray } from "three";
import type { Playground } from "../../app/playground";
import { allScenes } from "../../scenes/gallery";
import { settings } from "../../app/settings";
import { t } from "../../i18n";
import { toggleGravity } from "../../ui/more-panel";

const WIDTH = 0.24;
const HEIGHT = 0.19;
const PIXELS = { width: 512, height: 405 };
const COLUMNS = 2;
const HEADER = 85;

interface Button {
  label: () => string;
  pressed: () => boolean;
  act: () => void;
}

export class WristPanel {
  readonly mesh: Mesh<PlaneGeometry, MeshBasicMaterial>;
  private readonly canvas = document.createElement("canvas");
  private readonly texture: CanvasTexture;
  private readonly buttons: readonly Button[];
  private pointed = -1;
  private drawn = "";

  constructor(private readonly playground: Playground) {
    Object.assign(this.canvas, PIXELS);
    this.texture = new CanvasTexture(this.canvas);
    this.texture.colorSpace = SRGBColorSpace;
    this.mesh = new Mesh(new PlaneGeometry(WIDTH, HEIGHT), new MeshBasicMaterial({ map: this.texture, transparent: true }));
    // Above the back of the hand, tilted towards the face.
    this.mesh.position.set(0, 0.1, 0.06);
    this.mesh.rotation.set(-0.7, 0, 0);
    this.buttons = this.makeButtons();
  }

  private makeButtons(): Button[] {
    const { playground } = this;
    const paused = () => playground.paused.value;
    return [
      { label: () => t().vrPanel.pause, pressed: paused, act: () => playground.togglePaused() },
      { label: () => t().vrPanel.reset, pressed: () => false, act: () => playground.reset() },
      { label: () => t().vrPanel.home, pressed: () => false, act: () => playground.slice.home() },
      { label: () => t().vrPanel.undo, pressed: () => false, act: () => void playground.undo() },
      { label: () => t().vrPanel.ghosts, pressed: () => settings.ghosts.value, act: () => (settings.ghosts.value = !settings.ghosts.value) },
      { label: () => t().vrPanel.wires, pressed: () => settings.wires.value, act: () => (settings.wires.value = !settings.wires.value) },
      {
        label: () => t().vrPanel.gravity, pressed: () => playground.gravity.value.some((value) => value !== 0),
        act: () => toggleGravity(playground, playground.gravity.value.every((value) => value === 0)),
      },
      { label: () => t().vrPanel.next, pressed: () => false, act: () => this.nextScene() },
    ];
  }

  private nextScene(): void {
    const scenes = allScenes(this.playground.builtins.value);
    const at = scenes.findIndex(({ name }) => name === this.playground.sceneName.value);
    void this.playground.open(scenes[(at + 1) % scenes.length].name);
  }

  /** Lights the button that is pointed at, and draws anew where anything changed. */
  update(rays: readonly Ray[]): void {
    this.pointed = -1;
    for (const ray of rays) this.pointed = Math.max(this.pointed, this.buttonAt(ray));
    const title = this.playground.scene.value?.title ?? "Hyperbody";
    const state = [title, this.pointed, this.playground.slice.offset().toFixed(1), ...this.buttons.map(({ label, pressed }) => label() + pressed())].join("|");
    if (state === this.drawn) return;
    this.drawn = state;
    this.draw(title);
  }

  /** Presses what the ray meets; false if it misses the panel. */
  press(ray: Ray): boolean {
    const button = this.buttonAt(ray);
    if (button < 0) return false;
    this.buttons[button].act();
    return true;
  }

  private buttonAt(ray: Ray): number {
    const caster = new Raycaster(ray.origin, ray.direction);
    const uv = this.mesh.visible ? caster.intersectObject(this.mesh)[0]?.uv : undefined;
    if (!uv) return -1;
    const [x, y] = [uv.x * PIXELS.width, (1 - uv.y) * PIXELS.height - HEADER];
    if (y < 0) return -1;
    const height = (PIXELS.height - HEADER) / Math.ceil(this.buttons.length / COLUMNS);
    return Math.min(this.buttons.length - 1, Math.floor(y / height) * COLUMNS + Math.floor((x / PIXELS.width) * COLUMNS));
  }

  private draw(title: string): void {
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
    context.fillText(title, 28, HEADER / 2 + 2, width - 190);
    context.font = "26px system-ui, sans-serif";
    if (this.playground.slice.offCount > 0) context.fillText(`w ${this.playground.slice.offset().toFixed(1)}`, width - 130, HEADER / 2 + 2);
    const buttonHeight = (height - HEADER) / Math.ceil(this.buttons.length / COLUMNS);
    this.buttons.forEach(({ label, pressed }, i) => {
      const [x, y] = [((i % COLUMNS) * width) / COLUMNS + 10, HEADER + Math.floor(i / COLUMNS) * buttonHeight];
      context.fillStyle = i === this.pointed ? "#4f7fd6" : pressed() ? "#2d4a80" : "#1d2745";
      context.beginPath();
      context.roundRect(x, y, width / COLUMNS - 20, buttonHeight - 12, 18);
      context.fill();
      context.fillStyle = "#fff";
      context.fillText(label(), x + 20, y + (buttonHeight - 12) / 2 + 2, width / COLUMNS - 60);
    });
    this.texture.needsUpdate = true;
  }
}
