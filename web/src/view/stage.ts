// The stage: renderer, lights, sky, and all layers that a frame fills. It draws what it is given and decides nothing.
import {
  type Box3, DirectionalLight, HemisphereLight, NoToneMapping, PCFShadowMap, Scene, Vector2, Vector3, WebGLRenderer, Raycaster, Group,
} from "three";
import type { Frame, SceneDescription, Surface } from "../engine/protocol";
import { BodyStyles } from "./body-styles";
import { EdgeLayer } from "./edges";
import { HalfSpaceLayer } from "./half-spaces";
import { HandLayer } from "./hands";
import { JointLayer } from "./joints";
import { GhostLayer, WireLayer } from "./off-slice";
import { OrbitCamera } from "./orbit";
import { Picker, type Picked } from "./pick";
import { HAZE, makeSky } from "./sky";
import { SurfaceLayer } from "./surfaces";

/** Where the key light stands, seen from what it lights. */
const KEY_FROM = new Vector3(0.45, 1, 0.55).normalize();
const SHADOW_PIXELS = 2048;

/** Lights, floors and newcomers need some room, however small the scene, m. */
const LEAST_EXTENT = 1.6;
/** From where: a little from the side and above; worlds of two dimensions straight on. */
const FIRST_VIEW = { yaw: 0.55, pitch: 0.3 };
const FLAT_VIEW = { yaw: 0, pitch: 0.02 };
/** What panels take of the picture, CSS pixels: above, right, below, left; where it is low, where it is narrow, and where it is wide. */
const LOW = { height: 520, width: 600 };
const NARROW = 759;
const PANELS = { low: [64, 116, 80, 62], narrow: [76, 10, 152, 10], wide: [84, 186, 96, 72] };
/** Flatland's window: a share of the width on the left, or of the height above where that is narrow. */
const WINDOW = { narrow: 0.4, wide: 0.48 };
/** What is looked at first fills so much of the room. */
const FILLED = 0.94;

export class Stage {
  readonly renderer: WebGLRenderer;
  /** No graphics card: the processor draws. */
  readonly software: boolean;
  readonly scene = new Scene();
  readonly orbit = new OrbitCamera();
  /** Carries the camera: VR moves and scales it, everything else leaves it alone. */
  readonly rig = new Group();
  readonly styles = new BodyStyles();
  readonly surfaces = new SurfaceLayer(this.styles);
  readonly edges = new EdgeLayer(this.styles);
  readonly ghosts = new GhostLayer();
  readonly wires = new WireLayer();
  readonly joints = new JointLayer();
  readonly halfSpaces = new HalfSpaceLayer();
  readonly hands = new HandLayer();
  /** Called when a new scene has its place in the picture. */
  onSight: () => void = () => undefined;
  private readonly picker = new Picker();
  private readonly key = new DirectionalLight("#fff2e0", 2.05);
  private extent = 4;
  private size: [number, number] = [1, 1];
  private roomMade = false;
  private flatWorld = false;
  private readonly middle = new Vector3();

  /** Throws where the browser has no WebGL. */
  constructor(canvas: HTMLCanvasElement) {
    this.software = drawsInSoftware();
    this.renderer = new WebGLRenderer({ canvas, antialias: !this.software, powerPreference: "high-performance" });
    this.renderer.toneMapping = NoToneMapping;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.xr.enabled = true;
    this.scene.background = HAZE;
    this.rig.add(this.orbit.camera);
    this.light();
    this.scene.add(
      this.rig, makeSky(), this.halfSpaces.group, this.surfaces.mesh, this.edges.lines, this.ghosts.mesh, this.wires.lines, this.joints.group, this.hands.group,
    );
  }

  private light(): void {
    const rim = new DirectionalLight("#7fa8ff", 0.9);
    rim.position.set(-0.7, 0.35, -0.8);
    this.scene.add(new HemisphereLight("#e2e8fa", "#3c415a", 2.0), rim, this.key, this.key.target);
    this.key.castShadow = true;
    this.key.shadow.mapSize.set(SHADOW_PIXELS, SHADOW_PIXELS);
    this.key.shadow.bias = -0.0006;
    this.key.shadow.normalBias = 0.02;
    this.key.shadow.radius = 4;
  }

  /** A new scene: its colours. */
  setScene(scene: SceneDescription): void {
    this.styles.setBodies(scene.bodies);
    this.flatWorld = scene.dimension === 2;
  }

  /** What the camera frames and the light reaches from now on: a box in the slice. */
  setSight(box: Box3): void {
    this.extent = Math.max(LEAST_EXTENT, 0.5 * box.getSize(this.middle).length());
    box.getCenter(this.middle);
    this.see(box);
    this.orbit.jump();
    this.aimLight();
    this.halfSpaces.setScale(this.middle, this.extent);
    this.joints.setScale(this.extent);
    this.onSight();
  }

  /** Sends the camera to where a box of the slice is seen whole, beside all panels; or lets it glide there, from where it looks now. */
  see(box: Box3, glide = false): void {
    const [top, right, bottom, left] = this.panels();
    const [width, height] = this.size;
    const room: [number, number] = [FILLED * (1 - (left + right) / width), FILLED * (1 - (top + bottom) / height)];
    this.orbit.see(box, room, glide ? null : this.flatWorld ? FLAT_VIEW : FIRST_VIEW);
  }

  /** What panels hide at the four sides, at most half of each length. */
  private panels(): number[] {
    const [width, height] = this.size;
    const low = height <= LOW.height && width >= LOW.width;
    const narrow = width <= NARROW && !low;
    const [top, right, bottom, left] = PANELS[low ? "low" : narrow ? "narrow" : "wide"];
    const all = [top, right, bottom, left];
    if (this.roomMade) all[narrow ? 0 : 3] = narrow ? WINDOW.narrow * height + top : WINDOW.wide * width;
    return all.map((side, k) => Math.min(side, (k % 2 === 0 ? height : width) / 2.2));
  }

  private aimLight(): void {
    const reach = 2.2 * this.extent;
    const { camera } = this.key.shadow;
    [camera.left, camera.right, camera.bottom, camera.top] = [-reach, reach, -reach, reach];
    [camera.near, camera.far] = [0.1, 6 * reach];
    camera.updateProjectionMatrix();
    this.key.target.position.copy(this.middle);
    this.key.position.copy(this.middle).addScaledVector(KEY_FROM, 3 * reach);
  }

  /** Takes the contents of a frame over; its arrays may be reused afterwards. */
  show(frame: Frame, reach: number): void {
    this.surfaces.update(frame.surface);
    this.edges.update(frame.edges);
    this.ghosts.update(frame.ghosts, reach);
    this.wires.update(frame.wires);
    this.joints.update(frame.joints, reach);
    this.halfSpaces.update(frame.halfSpaces, frame.slice);
    this.hands.update(frame.hands, frame.slice);
  }

  /** What the pointer is tried against from now on; its arrays have to stay valid until the next call. */
  setPickSurface(surface: Surface): void {
    this.picker.setSurface(surface);
  }

  setShadows(on: boolean): void {
    this.key.castShadow = on;
  }

  get sceneExtent(): number {
    return this.extent;
  }

  get sceneMiddle(): Vector3 {
    return this.middle;
  }

  resize(width: number, height: number, pixelRatio: number): void {
    this.renderer.setPixelRatio(pixelRatio);
    this.renderer.setSize(width, height, false);
    this.size = [width, height];
    this.orbit.camera.aspect = width / Math.max(1, height);
    this.makeRoom(this.roomMade);
  }

  /** Leaves room for Flatland's window, or not. */
  makeRoom(on: boolean): void {
    this.roomMade = on;
    const [width, height] = this.size;
    const [top, right, bottom, left] = this.panels();
    // The middle of what no panel hides is the middle of the picture.
    this.orbit.camera.setViewOffset(width, height, (right - left) / 2, (bottom - top) / 2, width, height);
    this.orbit.camera.updateProjectionMatrix();
  }

  render(seconds: number): void {
    if (!this.renderer.xr.isPresenting) this.orbit.update(seconds);
    this.renderer.render(this.scene, this.orbit.camera);
  }

  /** The ray through a point of the picture; x and y from −1 to 1, right and up. */
  ray(x: number, y: number): Raycaster["ray"] {
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2(x, y), this.orbit.camera);
    return caster.ray;
  }

  pick(ray: Raycaster["ray"]): Picked | null {
    return this.picker.pick(ray);
  }
}

/** Asks a context of its own, because smooth edges have to be chosen before the real one is made. */
function drawsInSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name: unknown = info && gl?.getParameter(info.UNMASKED_RENDERER_WEBGL);
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return typeof name === "string" && /swiftshader|llvmpipe|software|basic render/i.test(name);
}
