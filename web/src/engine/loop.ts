/**
 * The worker's work, apart from the worker: messages to the engine, steps in real time, frames to the page. Written against two
 * small interfaces, so that it runs under Node in tests and benchmarks.
 */

import { buffersOf } from "./client";
import { assemble, BufferPool, copyArrays, type Report } from "./frames";
import { Pacer } from "./pacer";
import type { Frame, FromWorker, Refusal, SceneDescription, ToWorker } from "./protocol";

/** The wasm side; see crates/hyperbody-wasm/src/bindings.rs. */
export interface EngineProgram {
  handle(message: string): string;
  step(): void;
  draw(): ArrayLike<number>;
  report(): string;
  file(): Uint8Array;
}

/** What the loop stands in. */
export interface Surroundings {
  engine: EngineProgram;
  /** The program's memory as it is now: it moves when it grows. */
  memory(): ArrayBuffer;
  /** Milliseconds. */
  clock(): number;
  send(message: FromWorker, transfer: Transferable[]): void;
}

interface Reply {
  answer?: unknown;
  refused?: Refusal;
  scene?: SceneDescription;
  loaded: boolean;
}

/** Steps of one round take at most this, ms: a frame must come now and then, however slow the machine is. */
const STEP_BUDGET_MS = 30;

/** While nobody looks, messages are all there is to do, ms. */
const REST_MS = 250;

/** Frames that the page has not given back: it is behind, and gets no more until it has. */
const MOST_UNDER_WAY = 2;

export class EngineLoop {
  private readonly around: Surroundings;
  private readonly pacer = new Pacer();
  private readonly pool = new BufferPool();
  private scene: SceneDescription | null = null;
  private paused = false;
  private resting = false;
  /** Chosen for the running scene. */
  private gravity: number[] | null = null;
  private ghosts = false;
  private wires = false;
  private frames = 0;
  private underWay = 0;
  /** Something has changed since the last frame. */
  private dirty = false;
  private physicsMs = 0;

  constructor(around: Surroundings) {
    this.around = around;
  }

  /** Obeys a message of the page. */
  receive(message: ToWorker): void {
    switch (message.type) {
      case "recycle":
        this.pool.put(message.buffers);
        this.underWay = Math.max(0, this.underWay - 1);
        return;
      case "pause":
        this.setPaused(message.on);
        return;
      case "rest":
        if (!message.on) this.pacer.restart();
        this.resting = message.on;
        this.dirty = true;
        return;
      case "speed":
        this.pacer.setSpeed(message.factor);
        return;
      case "step":
        this.setPaused(true);
        this.goOnFromNow();
        this.step();
        return;
      case "scrub":
        this.setPaused(true);
        break;
      case "gravity":
        this.gravity = message.vector;
        break;
      case "ghosts":
        this.ghosts = message.on;
        break;
      case "wires":
        this.wires = message.on;
        break;
      default:
        break;
    }
    this.forward(message);
  }

  /** Does what is due and says in how many milliseconds it wants to be called again. */
  round(): number {
    const { clock } = this.around;
    if (this.resting) return REST_MS;
    const now = clock();
    if (this.scene && !this.paused) {
      this.pacer.run(now, this.scene.dt, STEP_BUDGET_MS, clock, () => this.step());
    }
    if (this.dirty && this.scene && this.underWay < MOST_UNDER_WAY) this.sendFrame();
    if (!this.scene || this.paused) return this.dirty ? 4 : 16;
    return this.pacer.pause(clock(), this.scene.dt);
  }

  private setPaused(on: boolean): void {
    if (this.paused && !on) {
      this.pacer.restart();
      this.goOnFromNow();
    }
    this.paused = on;
    this.dirty = true;
  }

  /** Ends scrubbing. */
  private goOnFromNow(): void {
    this.around.engine.handle('{"type":"scrub","secondsBack":0}');
  }

  private step(): void {
    const start = this.around.clock();
    this.around.engine.step();
    this.physicsMs += this.around.clock() - start;
    this.dirty = true;
  }

  private forward(message: ToWorker): void {
    const reply = JSON.parse(this.around.engine.handle(JSON.stringify(message))) as Reply;
    this.dirty = true;
    if (reply.scene) {
      this.scene = reply.scene;
      if (reply.loaded) this.begin(message.type === "reset");
      this.around.send({ type: "scene", scene: reply.scene, loaded: reply.loaded }, []);
    }
    if (!("id" in message)) return;
    const id = message.id;
    if (reply.refused) {
      this.around.send({ type: "refused", id, refusal: reply.refused }, []);
    } else if (message.type === "export") {
      const bytes = this.around.engine.file() as Uint8Array<ArrayBuffer>;
      this.around.send({ type: "answer", id, answer: { bytes } }, [bytes.buffer]);
    } else {
      this.around.send({ type: "answer", id, answer: reply.answer ?? {} }, []);
    }
  }

  /** A new scene; the same one from its start keeps its gravity, before it takes a step. */
  private begin(again: boolean): void {
    if (!again) this.gravity = null;
    else if (this.gravity) this.around.engine.handle(JSON.stringify({ type: "gravity", vector: this.gravity }));
    this.pacer.restart();
    this.pacer.slowdown = 1;
  }

  private sendFrame(): void {
    const { engine, clock } = this.around;
    const start = clock();
    const layout = engine.draw();
    const arrays = copyArrays(this.around.memory(), layout, this.pool);
    const slicing = clock() - start;
    const report = JSON.parse(engine.report()) as Report;
    this.frames += 1;
    const frame: Frame = assemble(
      arrays,
      report,
      {
        number: this.frames,
        paused: this.paused,
        slowdown: this.paused ? 1 : this.pacer.slowdown,
        workerMs: { physics: this.physicsMs, slicing },
      },
      { ghosts: this.ghosts, wires: this.wires },
    );
    this.physicsMs = 0;
    this.dirty = false;
    this.underWay += 1;
    this.around.send({ type: "frame", frame }, buffersOf(frame));
  }
}
