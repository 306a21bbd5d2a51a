// The running playground: the engine's client, the stage, the slice and the hands, tied together once a frame. Panels and
// input call its methods and read its signals; nothing here knows of buttons or pointers.
import { batch, signal } from "@preact/signals";
import { Vector3, type Ray } from "three";
import type { EngineClient } from "../engine/client";
import { centreStride, DRAWN, type BodyDescription, type BuiltIn, type Frame, type SceneDescription, type Selected } from "../engine/protocol";
import { Stage } from "../view/stage";
import type { Picked } from "../view/pick";
import { FlatlandView } from "../view/flatland";
import { HAND, HandControl } from "./hand-control";
import { t, wordsOf } from "../i18n";
import { AXES } from "../ui/axes";
import { firstFollowed, firstTurn } from "../scenes/gallery";
import { textOfOwn } from "../scenes/own";
import { FirstLook } from "./first-look";
import { isSeen, whereToLand } from "./landing";
import { Plots } from "./plots";
import { QualityGuard } from "./quality";
import { Recovery } from "./recovery";
import { calm, settings } from "./settings";
import { SliceControl } from "./slice-control";
import { toFrame, toWorld, type SliceFrame } from "./slice-frame";

/** How near to the slice ghosts are shown, m. */
export const GHOST_REACH = 1.5;

/** Panels are told of a frame this often: text that changes faster cannot be read. */
const READOUT_MS = 80;

/** A longer pause between two pictures is no motion: the tab was hidden. */
const LONGEST_FRAME = 0.1;
/** The camera, which only follows, makes up for more of it: pictures of a slow machine come seldom, and the world does not wait. */
const LONGEST_CAMERA_FRAME = 0.6;

/** Pictures to keep have so many pixels a CSS pixel at least, however coarsely a slow machine draws. */
const PICTURE_RATIO = 2;

/** What runs after a scene has stopped the engine twice: built in, and small. */
const SAFE_SCENE = "dice4d";

/** A scene that is asked for: built in (a name and no text), the page's own (both), or from elsewhere (a text). */
export interface Load {
  name: string | null;
  text: string | null;
  /** With all that was chosen: the same scene as before. */
  again: boolean;
  /** Its text at a later moment, which it goes on from. */
  moment?: string;
}

/** Words that come and go; after something that is easily done by mistake, with a way back. */
export interface Notice {
  text: string;
  undo: boolean;
}

/** What the panels show of a frame. */
export interface Readout {
  time: number;
  step: number;
  slowdown: number;
  workerMs: Frame["workerMs"];
  selected: Selected | null;
  history: Frame["history"];
  energy: Frame["energy"];
  asleep: number;
  quarantined: readonly number[];
  slice: SliceFrame;
}

export class Playground {
  readonly scene = signal<SceneDescription | null>(null);
  /** What the gallery calls the running scene; null for scenes from elsewhere. */
  readonly sceneName = signal<string | null>(null);
  readonly builtins = signal<BuiltIn[]>([]);
  readonly readout = signal<Readout | null>(null);
  /** Whether time stands. Said here and obeyed by the worker: a frame that is still under way knows nothing of the last key. */
  readonly paused = signal(false);
  readonly selected = signal<number | null>(null);
  readonly followed = signal<number | null>(null);
  /** The off direction, counted from 0, that wheel, second finger, sticks and keys mean: worlds of five and six dimensions have more than one. */
  readonly along = signal(0);
  readonly speed = signal(1);
  /** What a scene begins with: real time, unless the address asks for another. */
  usualSpeed = 1;
  readonly gravity = signal<readonly number[]>([]);
  readonly flatland = signal(false);
  readonly notice = signal<Notice | null>(null);
  /** Why nothing runs: the engine cannot start here, or has stopped too often. */
  readonly failure = signal<{ kind: "start" | "stopped"; message: string } | null>(null);
  /** The text of a scene that keeps stopping the engine: it is not lost. */
  readonly lost = signal<string | null>(null);
  readonly plots = new Plots();
  readonly stage: Stage;
  readonly slice = new SliceControl();
  readonly hands: HandControl;
  readonly flat: FlatlandView;
  readonly quality: QualityGuard;
  private readonly look: FirstLook;
  /** Called with every frame of the engine, before it is drawn. */
  readonly onFrame = new Set<(frame: Frame) => void>();
  /** Called once a picture, with the seconds since the last one. */
  readonly onPicture = new Set<(seconds: number) => void>();
  private pictureWanted: ((picture: Blob) => void) | null = null;
  /** Loads that the worker has been asked for, in its order. */
  private readonly loads: Load[] = [];
  /** What ran before the running scene was opened or started again: the first thing that undo has when the scene has nothing more. */
  private readonly before = signal<Load | null>(null);
  /** What runs, for a new start. */
  private running: Load | null = null;
  /** Counts wishes for a scene: the latest one wins. */
  private wishes = 0;
  private readonly recovery = new Recovery();
  private fresh = false;
  /** What the slice is to follow once the scene's first picture is chosen. */
  private toFollow: number | null = null;
  private lastReadout = 0;
  private lastPicture = 0;

  constructor(readonly client: EngineClient, canvas: HTMLCanvasElement) {
    this.stage = new Stage(canvas);
    this.flat = new FlatlandView(this.stage);
    this.quality = new QualityGuard(this.stage);
    this.hands = new HandControl(client, () => this.drawnFrame(), (reason) => this.say(reason));
    this.slice.pivot = () => this.pivot();
    this.look = new FirstLook(this.stage, {
      drawn: () => this.drawnFrame(),
      jump: (away) => {
        this.slice.jump(away);
        this.sendSlice();
      },
    });
    client.onFrame((frame) => this.take(frame));
    client.onScene((scene, loaded) => batch(() => this.takeScene(scene, loaded)));
    client.onFailure((message) => (this.failure.value = { kind: "start", message }));
    client.onCrash((message) => void this.recover(message));
  }

  start(): void {
    document.addEventListener("visibilitychange", () => this.sendRest());
    this.stage.renderer.setAnimationLoop((time: number) => this.picture(time));
  }

  /** The frame whose points the view draws: the slice, or for Flatland the whole world. */
  drawnFrame(): SliceFrame {
    return this.flatland.value ? this.flat.wholeWorld : this.slice.frame;
  }

  body(id: number | null): BodyDescription | undefined {
    return this.scene.value?.bodies.find((body) => body.id === id);
  }

  /** What a body is called: in the page's language where its scene is the page's. */
  nameOf(body: number): string {
    const name = this.body(body)?.name ?? String(body);
    return this.sceneName.value === null ? name : t().bodyName(name);
  }

  // --- what a person does ---------------------------------------------------------------------------------------------

  /** Opens a scene of the gallery; nothing happens if another one is asked for meanwhile. */
  async open(name: string): Promise<void> {
    const wish = ++this.wishes;
    const text = await this.attempt(textOfOwn(name), () => t().notFetched);
    if (text === undefined || wish !== this.wishes) return;
    await this.attempt(this.replace({ name, text, again: false }));
  }

  /** Loads scene text; rejects with a `RefusedError` that names the line, and the running scene goes on. */
  async loadText(text: string): Promise<void> {
    this.wishes += 1;
    await this.replace({ name: null, text, again: false });
  }

  /** The text that the running scene was loaded from, where the page has it. */
  get text(): string | null {
    return this.running?.text ?? null;
  }

  /** The scene from its start; slice, camera and choices stay. */
  async reset(): Promise<void> {
    if (!this.running) return;
    await this.attempt(this.replace({ ...this.running, again: true, moment: undefined }).then(() => this.say(t().startedAgain, true)));
  }

  /** The running scene as it is now, to come back to. */
  async now(): Promise<Load | null> {
    const { running } = this;
    if (!running) return null;
    const { text } = await this.client.request("sceneText", {});
    return { ...running, moment: text };
  }

  /** Goes back to a scene as it was. */
  async goBackTo(load: Load): Promise<void> {
    this.wishes += 1;
    this.before.value = null;
    await this.attempt(this.load(load));
  }

  /** Loads a scene in place of the running one, which undo brings back. */
  private async replace(load: Load): Promise<void> {
    // Both requests are sent at once, so that loads keep their order.
    const now = this.now().catch(() => null);
    await this.load(load);
    const before = await now;
    this.before.value = before && { ...before, again: load.again };
  }

  /** Whether there is something to take back. */
  get canUndo(): boolean {
    return this.readout.value?.history.undo != null || this.before.value !== null;
  }

  /** Asks the worker, whose scenes come in the order in which they were asked for. */
  private async load(load: Load): Promise<void> {
    this.loads.push(load);
    const { client } = this;
    try {
      if (load.moment !== undefined) await client.request("load", { text: load.moment });
      else if (load.again && this.running?.moment === undefined) await client.request("reset", {});
      else if (load.text !== null) await client.request("load", { text: load.text });
      else await client.request("loadBuiltin", { name: load.name ?? "" });
    } finally {
      // Refused: no scene has come that would have taken it.
      const at = this.loads.indexOf(load);
      if (at >= 0) this.loads.splice(at, 1);
    }
  }

  /** The engine has stopped by an error of its own: a new one gets the scene, unless the scene is what stops it. */
  private async recover(message: string): Promise<void> {
    const { running } = this;
    const remedy = this.recovery.after(performance.now(), running?.name ?? running?.text ?? "");
    this.hands.forget();
    this.loads.length = 0;
    if (remedy !== "again" && running?.text) this.lost.value = running.text;
    if (remedy === "stop") this.failure.value = { kind: "stopped", message };
    else await this.startAgain(remedy === "again" ? running : null);
  }

  /** A new engine after the last one stopped, when a person asks for it. */
  async startOver(): Promise<void> {
    this.recovery.forget();
    this.failure.value = null;
    await this.startAgain(null);
  }

  /** A new engine, with a scene, or with one that comes with it. */
  private async startAgain(load: Load | null): Promise<void> {
    try {
      await this.client.restart();
      this.paused.value = false;
      this.sendRest();
      await this.load(load ? { ...load, again: false } : { name: SAFE_SCENE, text: null, again: false });
      this.say(load ? t().restarted : t().restartedElsewhere);
    } catch (error) {
      this.say(wordsOf(error));
    }
  }

  async undo(): Promise<void> {
    const answer = await this.attempt(this.client.request("undo", {}));
    const before = this.before.value;
    if (answer?.undone) this.say(t().undone(answer.undone));
    else if (answer && before) {
      await this.goBackTo(before);
      this.say(t().undone(before.again ? "reset" : "open"));
    }
  }

  /** Stops time, or goes on from the moment that is shown. */
  setPaused(on: boolean): void {
    this.paused.value = on;
    if (!on) this.client.send("resumeHere", {});
    this.client.send("pause", { on });
  }

  togglePaused(): void {
    this.setPaused(!this.paused.value);
  }

  /** One step from the moment that is shown, after which time stands. */
  stepOnce(): void {
    this.paused.value = true;
    this.client.send("resumeHere", {});
    this.client.send("step", {});
  }

  /** Shows an earlier moment, at which time stands. */
  scrub(secondsBack: number): void {
    this.paused.value = true;
    this.client.send("scrub", { secondsBack });
  }

  setSpeed(factor: number): void {
    this.speed.value = factor;
    this.client.send("speed", { factor });
  }

  setGravity(vector: readonly number[]): void {
    this.gravity.value = vector;
    this.client.send("gravity", { vector: [...vector] });
  }

  /** Gravity along a direction of the picture: right, up, towards the viewer. */
  setGravityInView(direction: readonly [number, number, number], strength: number): void {
    const inSlice = new Vector3(...direction).applyQuaternion(this.stage.orbit.camera.quaternion).toArray();
    const { rows, shown } = this.drawnFrame();
    this.setGravity(rows[0].map((_, axis) => strength * rows.slice(0, shown).reduce((sum, row, i) => sum + row[axis] * inSlice[i], 0)));
  }

  /** The next picture, as PNG. */
  takePicture(done: (picture: Blob) => void): void {
    this.pictureWanted = done;
  }

  select(body: number | null): void {
    this.selected.value = body;
    this.stage.styles.selected = body;
    this.plots.clear();
    this.client.send("select", { body });
    if (body === null || this.followed.value !== body) this.followed.value = null;
  }

  /** Moves the slice so that it passes through the body's centre, and selects it. */
  goTo(body: number): void {
    this.select(body);
    const centre = this.centre(body);
    if (!centre) return;
    const { shown } = this.slice.frame;
    toFrame(this.slice.frame, centre).slice(shown).forEach((away, j) => this.slice.moveTo(this.slice.offset(j) + away, j));
  }

  /** Moves the slice along an off direction, as a person asks: it follows nothing then. */
  moveSlice(offset: number, j = 0): void {
    this.followed.value = null;
    this.slice.moveTo(offset, j);
  }

  /** Chooses the off direction that hands push along, and says so. */
  setAlong(j: number): void {
    if (j === this.along.value) return;
    this.along.value = j;
    this.say(t().alongNow(AXES[this.slice.frame.shown + j]));
  }

  /** The row of the drawn frame that hands push along. */
  get pushRow(): number {
    return this.drawnFrame().shown + this.along.value;
  }

  async remove(body: number): Promise<void> {
    const name = this.nameOf(body);
    if (this.selected.value === body) this.select(null);
    if (await this.attempt(this.client.request("remove", { body }))) this.say(t().forgotten(name), true);
  }

  freeze(body: number, on: boolean): void {
    void this.attempt(this.client.request("freeze", { body, on }));
  }

  /** Adds a body where it is seen, in the slice, above what is there. */
  async spawn(shape: object, name: string): Promise<void> {
    const place = whereToLand(this, shape);
    const position = toWorld(this.drawnFrame(), place.toArray().slice(0, this.drawnFrame().shown));
    const answer = await this.attempt(this.client.request("spawn", { shape, position, name }));
    if (!answer) return;
    this.select(answer.body);
    if (isSeen(this, place)) return;
    // Once a frame has it.
    const look = () => {
      if (!this.centre(answer.body)) return;
      this.onFrame.delete(look);
      this.seeAll();
    };
    this.onFrame.add(look);
  }

  /** How far off the slice a body lies, along the off direction where that is most; null if the slice cuts it, or it is not there. */
  distanceOff(body: number): { off: number; away: number } | null {
    const { frame } = this.client;
    if (!frame || this.flatland.value) return null;
    const count = frame.slice.off.length;
    const stride = 1 + 2 * count;
    let farthest = { off: 0, away: 0 };
    for (let at = 0; at + stride <= frame.strip.length && count > 0; at += stride) {
      if (frame.strip[at] !== body) continue;
      for (let off = 0; off < count; off++) {
        const [low, high] = [frame.strip[at + 1 + 2 * off], frame.strip[at + 2 + 2 * off]];
        const away = low > 0 ? low : high < 0 ? high : 0;
        if (Math.abs(away) > Math.abs(farthest.away)) farthest = { off, away };
      }
    }
    return farthest.away === 0 ? null : farthest;
  }

  /** The ray under a place on the page, CSS pixels. */
  rayAt(x: number, y: number): Ray {
    const ontoPlane = this.flat.rayAt(x, y);
    if (ontoPlane) return ontoPlane;
    const box = this.stage.renderer.domElement.getBoundingClientRect();
    return this.stage.ray((2 * (x - box.left)) / box.width - 1, 1 - (2 * (y - box.top)) / box.height);
  }

  pickAt(x: number, y: number): Picked | null {
    const ontoPlane = this.flat.rayAt(x, y);
    return ontoPlane ? this.flat.pick(ontoPlane) : this.stage.pick(this.rayAt(x, y));
  }

  /** The normal of the plane in which what is grabbed there is pulled: towards the viewer. */
  pullNormal(x: number, y: number): Vector3 {
    if (this.flat.rayAt(x, y)) return this.flat.normal;
    return this.stage.orbit.camera.getWorldDirection(new Vector3()).negate();
  }

  /** Where a body's centre is on the page, CSS pixels. */
  onPage(body: number): { x: number; y: number } | null {
    const centre = this.centre(body);
    if (!centre) return null;
    const [x = 0, y = 0, z = 0] = toFrame(this.drawnFrame(), centre).slice(0, this.drawnFrame().shown);
    const inPicture = new Vector3(x, y, z).project(this.stage.orbit.camera);
    const box = this.stage.renderer.domElement.getBoundingClientRect();
    return { x: box.left + ((inPicture.x + 1) / 2) * box.width, y: box.top + ((1 - inPicture.y) / 2) * box.height };
  }

  say(text: string, undo = false): void {
    this.notice.value = { text, undo };
  }

  /** The world point of a body's centre in the latest frame. */
  centre(body: number): number[] | null {
    const { frame } = this.client;
    if (!frame) return null;
    const { centres, slice } = frame;
    for (let at = 0; at < centres.length; at += centreStride(slice)) {
      if (centres[at] !== body) continue;
      const along = (directions: readonly number[][], first: number, axis: number) => directions.reduce((sum, direction, row) => sum + centres[first + row] * direction[axis], 0);
      return slice.origin.map((value, axis) => value + along(slice.axes, at + 1, axis) + along(slice.off, at + 1 + DRAWN, axis));
    }
    return null;
  }

  /** Says why something did not work; undefined then. */
  private async attempt<T>(request: Promise<T>, words: (error: unknown) => string = wordsOf): Promise<T | undefined> {
    try {
      return await request;
    } catch (error) {
      this.say(words(error));
      return undefined;
    }
  }

  // --- once a picture -------------------------------------------------------------------------------------------------

  private picture(time: number): void {
    const since = Math.max(0, (time - this.lastPicture) / 1000);
    const seconds = Math.min(LONGEST_FRAME, since);
    const cameraSeconds = Math.min(LONGEST_CAMERA_FRAME, since);
    this.lastPicture = time;
    this.stage.orbit.calm = this.slice.calm = calm.value;
    tellAll(this.onPicture, seconds);
    this.slice.update(seconds, this.followedAway());
    if (this.slice.takeChange()) this.sendSlice();
    this.hands.update();
    const { frame } = this.client;
    if (this.fresh && frame) {
      this.fresh = false;
      this.stage.show(frame, GHOST_REACH);
      this.flat.show(frame);
      this.tell(frame, time);
      if (!calm.value) this.look.settle(cameraSeconds, frame, this.bodies);
    }
    const fine = this.pictureWanted !== null && !this.stage.renderer.xr.isPresenting;
    if (fine) this.stage.resize(innerWidth, innerHeight, Math.max(PICTURE_RATIO, devicePixelRatio));
    this.stage.render(cameraSeconds);
    if (this.flatland.value) this.flat.render(this.slice.frame, !this.stage.renderer.xr.isPresenting);
    this.quality.pictureTook(seconds);
    // The canvas still holds what was drawn: it is cleared once this callback returns.
    if (this.pictureWanted) this.stage.renderer.domElement.toBlob(handOver(this.pictureWanted), "image/png");
    this.pictureWanted = null;
    if (fine) this.quality.resize(innerWidth, innerHeight);
  }

  /** The worker rests while the page is hidden, unless a headset shows it. */
  private sendRest(): void {
    this.client.send("rest", { on: document.hidden && !this.stage.renderer.xr.isPresenting });
  }

  /** Tells the worker which slice to cut; Flatland cuts here, out of the whole world. */
  sendSlice(): void {
    const { rows, shown, origin } = this.drawnFrame();
    const axes = rows.slice(0, shown).map((row) => [...row]);
    this.client.send("slice", { origin: [...origin], axes, off: rows.slice(shown).map((row) => [...row]) });
  }

  private followedAway(): number[] | null {
    if (this.followed.value === null) return null;
    const centre = this.centre(this.followed.value);
    return centre && toFrame(this.slice.frame, centre).slice(this.slice.frame.shown);
  }

  /** Turns of the slice go about what is held, selected, or looked at. */
  private pivot(): readonly number[] {
    const body = this.hands.holds(HAND.pointer) ?? this.selected.value;
    const centre = body === null ? null : this.centre(body);
    const { frame } = this.slice;
    if (centre) return centre;
    return toWorld(frame, this.stage.orbit.target.toArray().slice(0, frame.shown));
  }

  private get bodies(): readonly BodyDescription[] {
    return this.scene.value?.bodies ?? [];
  }

  /** Sends the camera to where all is seen. */
  seeAll(): void {
    if (this.client.frame) this.look.seeAll(this.client.frame, this.bodies);
  }

  private take(frame: Frame): void {
    this.fresh = this.look.take(frame, this.bodies);
    if (this.fresh && this.toFollow !== null) {
      this.followed.value = this.toFollow;
      this.toFollow = null;
    }
    this.stage.setPickSurface(frame.surface);
    this.hands.agree(frame.hands);
    // Undo would take back what is done now, and not what the words are about.
    if (this.notice.value?.undo && frame.hands.length > 0) this.notice.value = null;
    tellAll(this.onFrame, frame);
  }

  private tell(frame: Frame, time: number): void {
    if (frame.selected) this.plots.add(frame.time, frame.selected);
    if (time - this.lastReadout < READOUT_MS) return;
    this.lastReadout = time;
    const { slowdown, workerMs, selected, history, energy, quarantined, step } = frame;
    this.readout.value = {
      time: frame.time, step, slowdown, workerMs, selected, history, energy, quarantined,
      asleep: frame.asleep.length, slice: this.slice.frame,
    };
  }

  private takeScene(scene: SceneDescription, loaded: boolean): void {
    const load = loaded ? this.loads.shift() : undefined;
    this.scene.value = scene;
    const again = load?.again ?? false;
    if (load) this.running = load;
    if (loaded && !again) this.begin(scene, load?.name ?? null);
    else this.stage.styles.setBodies(scene.bodies);
    if (loaded) this.hands.forget();
    const isThere = (id: number | null) => id === null || scene.bodies.some((body) => body.id === id);
    if (!isThere(this.selected.value)) this.select(null);
    if (!isThere(this.followed.value)) this.followed.value = null;
    if (loaded && again) this.sendChoices();
  }

  /** The worker's world is new; what was chosen before goes on. */
  private sendChoices(): void {
    this.sendSlice();
    this.client.send("gravity", { vector: [...this.gravity.value] });
    this.client.send("select", { body: this.selected.value });
  }

  private begin(scene: SceneDescription, name: string | null): void {
    this.sceneName.value = name;
    this.select(null);
    this.toFollow = scene.bodies.find((body) => body.name === firstFollowed(name))?.id ?? null;
    this.gravity.value = scene.gravity;
    this.along.value = 0;
    this.setFlatland(this.sceneName.value?.startsWith("flatland") ?? false);
    this.stage.setScene(scene);
    this.look.begin();
    this.client.send("ghosts", { on: settings.ghosts.value, reach: GHOST_REACH });
    this.client.send("wires", { on: settings.wires.value });
    this.setSpeed(this.usualSpeed);
  }

  /** Worlds of three dimensions: the whole world, with the plane of Flatland in it and beside it what its people see. */
  setFlatland(on: boolean): void {
    const dimension = this.scene.value?.dimension ?? 4;
    const allowed = on && dimension === 3;
    this.flatland.value = allowed;
    this.slice.reset(dimension, allowed ? 2 : Math.min(3, dimension), allowed ? null : firstTurn(this.sceneName.value));
    this.flat.setVisible(allowed);
    this.sendSlice();
  }
}

/** Calls all, whatever becomes of one: an error of an instrument must not keep the world from being drawn. */
function tellAll<T>(listeners: ReadonlySet<(value: T) => void>, value: T): void {
  for (const listener of listeners) {
    try {
      listener(value);
    } catch (error) {
      reportError(error);
    }
  }
}

function handOver(take: (picture: Blob) => void): BlobCallback {
  return (picture) => picture && take(picture);
}
