// The w-strip in VR: above the panel, for the ray of a controller. Dragged, it moves the slice; a bar that is tapped is gone to.
import { CanvasTexture, Mesh, MeshBasicMaterial, PlaneGeometry, Raycaster, SRGBColorSpace, type Ray } from "three";
import type { Playground } from "../../app/playground";
import { StripPicture } from "../../ui/strip-picture";

const WIDTH = 0.3;
const HEIGHT = 0.1;
/** Of the strip as it is drawn, and of the canvas for each of its pixels. */
const PIXELS = { width: 360, height: 120 };
const RATIO = 2;
/** A ray that moves less is a tap, pixels. */
const TAP_PIXELS = 9;
/** Drawn anew with every so many pictures: headsets have little time for one. */
const EVERY = 3;

export class WristStrip {
  readonly mesh: Mesh<PlaneGeometry, MeshBasicMaterial>;
  private readonly canvas = document.createElement("canvas");
  private readonly texture: CanvasTexture;
  private readonly picture: StripPicture;
  private pictures = 0;
  private drag: { start: number; offset: number; moved: boolean } | null = null;

  /** On the panel, whose upper edge is so high above its middle, m. */
  constructor(private readonly playground: Playground, panel: Mesh, edge: number) {
    Object.assign(this.canvas, { width: RATIO * PIXELS.width, height: RATIO * PIXELS.height });
    this.texture = new CanvasTexture(this.canvas);
    this.texture.colorSpace = SRGBColorSpace;
    this.picture = new StripPicture(playground);
    this.mesh = new Mesh(new PlaneGeometry(WIDTH, HEIGHT), new MeshBasicMaterial({ map: this.texture, transparent: true }));
    this.mesh.position.y = edge + 0.01 + HEIGHT / 2;
    panel.add(this.mesh);
  }

  /** Once a picture. */
  update(): void {
    this.mesh.visible = this.playground.slice.offCount > 0;
    const context = this.canvas.getContext("2d");
    this.pictures += 1;
    if (!context || !this.mesh.visible || this.pictures % EVERY !== 0) return;
    const { width, height } = PIXELS;
    context.setTransform(RATIO, 0, 0, RATIO, 0, 0);
    context.clearRect(0, 0, width, height);
    context.fillStyle = "rgba(12, 17, 34, 0.92)";
    context.beginPath();
    context.roundRect(0, 0, width, height, 15);
    context.fill();
    this.picture.draw(context, width, height, this.playground.along.value);
    this.texture.needsUpdate = true;
  }

  /** Takes hold of the strip where the ray meets it; false if it misses. */
  press(ray: Ray): boolean {
    const place = this.placeOf(ray);
    if (place) this.drag = { start: place.x, offset: this.playground.slice.offset(this.playground.along.value), moved: false };
    return place !== null;
  }

  /** The ray that took hold moves. */
  move(ray: Ray): void {
    const place = this.placeOf(ray);
    if (!place || !this.drag) return;
    const away = place.x - this.drag.start;
    this.drag.moved ||= Math.abs(away) > TAP_PIXELS;
    if (this.drag.moved) this.playground.moveSlice(this.drag.offset + away / this.picture.scale(PIXELS.width), this.playground.along.value);
  }

  release(ray: Ray): void {
    const place = this.placeOf(ray);
    if (place && this.drag && !this.drag.moved) this.picture.tap(this.picture.valueAt(place.x, PIXELS.width), place.across, this.playground.along.value);
    this.drag = null;
  }

  /** Where a ray meets the strip: pixels along it, and a share of its width. */
  private placeOf(ray: Ray): { x: number; across: number } | null {
    if (!this.mesh.visible || !this.mesh.parent?.visible) return null;
    const uv = new Raycaster(ray.origin, ray.direction).intersectObject(this.mesh)[0]?.uv;
    return uv ? { x: uv.x * PIXELS.width, across: 1 - uv.y } : null;
  }
}
