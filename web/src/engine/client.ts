/** The page's end of the protocol: typed messages to the worker, promises for what it answers, the latest frame. */

import type { BuiltIn, Commands, Frame, FromWorker, Refusal, Requests, SceneDescription, ToWorker } from "./protocol";

/** Thrown by `EngineClient.request` where the worker refuses: `message` says why, `line` where in the scene's text. */
export class RefusedError extends Error {
  readonly line: number | undefined;
  readonly column: number | undefined;
  readonly code: string | undefined;

  constructor(refusal: Refusal) {
    super(refusal.message);
    this.name = "RefusedError";
    this.line = refusal.line;
    this.column = refusal.column;
    this.code = refusal.code;
  }
}

interface Waiting {
  resolve(answer: unknown): void;
  reject(reason: Error): void;
}

type Listener<T> = (value: T) => void;

/** The part of `Worker` that the client uses, so that tests can stand in for it. */
export interface Channel {
  postMessage(message: ToWorker, transfer?: Transferable[]): void;
  addEventListener(type: "message" | "error", listener: (event: never) => void): void;
  terminate(): void;
}

/** The worker of this package. */
const startWorker = (): Channel => new Worker(new URL("./worker.ts", import.meta.url), { type: "module", name: "engine" }) as Channel;

type Ready = { version: string; builtins: BuiltIn[] };

/** A world in a worker. */
export class EngineClient {
  /** The newest frame; its arrays are valid until the next one arrives. */
  frame: Frame | null = null;
  /** The scene that is running. */
  scene: SceneDescription | null = null;

  private channel!: Channel;
  private readonly waiting = new Map<number, Waiting>();
  private readonly frameListeners = new Set<Listener<Frame>>();
  private readonly sceneListeners = new Set<(scene: SceneDescription, loaded: boolean) => void>();
  private readonly failureListeners = new Set<Listener<string>>();
  private readonly crashListeners = new Set<Listener<string>>();
  private lastRequest = 0;
  /** The frame whose buffers the running worker gets back. */
  private lent: Frame | null = null;
  private up = false;
  private becomesReady!: Promise<Ready>;
  private resolveReady!: (value: Ready) => void;
  private rejectReady!: (reason: Error) => void;

  /** Starts the worker of this package, or speaks through what `open` gives. */
  constructor(private readonly open: () => Channel = startWorker) {
    this.connect();
  }

  private connect(): void {
    this.up = false;
    this.lent = null;
    this.becomesReady = new Promise((resolve, reject) => {
      this.resolveReady = resolve;
      this.rejectReady = reject;
    });
    // The failure also reaches those who never ask.
    this.becomesReady.catch(() => undefined);
    const channel = this.open();
    this.channel = channel;
    // What a worker that was replaced has left to say is of no use.
    channel.addEventListener("message", (event: MessageEvent<FromWorker>) => this.channel === channel && this.receive(event.data));
    channel.addEventListener("error", (event: ErrorEvent) => {
      if (this.channel === channel) this.break(event.message || "the worker of the engine could not be loaded");
    });
  }

  /** The built-in scenes, once the engine is up. Rejects where wasm cannot run. */
  ready(): Promise<Ready> {
    return this.becomesReady;
  }

  /** A new worker in place of this one; the last frame stays, and a scene has to be loaded. */
  restart(): Promise<Ready> {
    this.channel.terminate();
    this.rejectAll(new Error("the engine was started again"));
    this.connect();
    return this.ready();
  }

  /** Sends a message that is not answered. */
  send<K extends keyof Commands>(type: K, message: Commands[K], transfer: Transferable[] = []): void {
    this.channel.postMessage({ ...message, type } as ToWorker, transfer);
  }

  /** Sends a message and waits for its answer; rejects with a `RefusedError`. */
  request<K extends keyof Requests>(type: K, message: Requests[K]["takes"]): Promise<Requests[K]["answers"]> {
    this.lastRequest += 1;
    const id = this.lastRequest;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve: (answer) => resolve(answer as Requests[K]["answers"]), reject });
      this.channel.postMessage({ ...message, type, id } as unknown as ToWorker);
    });
  }

  /** Calls `listener` with every frame; the function that is returned ends it. */
  onFrame(listener: Listener<Frame>): () => void {
    this.frameListeners.add(listener);
    return () => this.frameListeners.delete(listener);
  }

  /** Calls `listener` when the list of bodies is new; `loaded` tells a new scene from a body more or less. */
  onScene(listener: (scene: SceneDescription, loaded: boolean) => void): () => void {
    this.sceneListeners.add(listener);
    return () => this.sceneListeners.delete(listener);
  }

  /** Calls `listener` when the engine cannot run in this browser. */
  onFailure(listener: Listener<string>): () => void {
    this.failureListeners.add(listener);
    return () => this.failureListeners.delete(listener);
  }

  /** Calls `listener` when an engine that ran has stopped by an error of its own: `restart` goes on. */
  onCrash(listener: Listener<string>): () => void {
    this.crashListeners.add(listener);
    return () => this.crashListeners.delete(listener);
  }

  /** Ends the worker. */
  dispose(): void {
    this.channel.terminate();
    this.rejectAll(new Error("the engine was closed"));
  }

  private receive(message: FromWorker): void {
    switch (message.type) {
      case "ready":
        this.up = true;
        this.resolveReady({ version: message.version, builtins: message.builtins });
        break;
      case "failed":
        this.break(message.message);
        break;
      case "scene":
        this.scene = message.scene;
        for (const listener of this.sceneListeners) listener(message.scene, message.loaded);
        break;
      case "frame": {
        const old = this.lent;
        this.frame = this.lent = message.frame;
        try {
          for (const listener of this.frameListeners) listener(message.frame);
        } finally {
          // Whatever a listener does: a worker that gets nothing back sends nothing more.
          if (old) {
            const buffers = buffersOf(old);
            this.send("recycle", { buffers }, buffers);
          }
        }
        break;
      }
      case "answer":
        this.take(message.id)?.resolve(message.answer);
        break;
      case "refused":
        this.take(message.id)?.reject(new RefusedError(message.refusal));
        break;
    }
  }

  private take(id: number): Waiting | undefined {
    const waiting = this.waiting.get(id);
    this.waiting.delete(id);
    return waiting;
  }

  private break(message: string): void {
    const error = new Error(message);
    this.rejectReady(error);
    this.rejectAll(error);
    for (const listener of this.up ? this.crashListeners : this.failureListeners) listener(message);
  }

  private rejectAll(error: Error): void {
    for (const waiting of this.waiting.values()) waiting.reject(error);
    this.waiting.clear();
  }
}

/** The buffers behind the arrays of a frame, each once. */
export function buffersOf(frame: Frame): ArrayBuffer[] {
  const views = [
    frame.surface.positions,
    frame.surface.normals,
    frame.surface.cells,
    frame.surface.ranges,
    frame.edges.positions,
    frame.edges.ranges,
    frame.ghosts?.positions,
    frame.ghosts?.normals,
    frame.ghosts?.ranges,
    frame.ghosts?.distances,
    frame.wires?.positions,
    frame.wires?.off,
    frame.wires?.ranges,
    frame.joints.rods,
    frame.joints.marks,
    frame.halfSpaces,
    frame.strip,
    frame.centres,
    frame.asleep,
  ];
  const buffers = new Set<ArrayBuffer>();
  for (const view of views) {
    if (view && view.buffer.byteLength > 0) buffers.add(view.buffer);
  }
  return [...buffers];
}
