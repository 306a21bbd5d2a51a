/** The page's end of the protocol: typed messages to the worker, promises for what it answers, the latest frame. */

import type { BuiltIn, Commands, Frame, FromWorker, Refusal, Requests, SceneDescription, ToWorker } from "./protocol";

/** Thrown by `EngineClient.request` where the worker refuses: `message` says why, `line` where in the scene's text. */
export class RefusedError extends Error {
  readonly line: number | undefined;
  readonly column: number | undefined;

  constructor(refusal: Refusal) {
    super(refusal.message);
    this.name = "RefusedError";
    this.line = refusal.line;
    this.column = refusal.column;
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

/** A world in a worker. */
export class EngineClient {
  /** The newest frame; its arrays are valid until the next one arrives. */
  frame: Frame | null = null;
  /** The scene that is running. */
  scene: SceneDescription | null = null;

  private readonly channel: Channel;
  private readonly waiting = new Map<number, Waiting>();
  private readonly frameListeners = new Set<Listener<Frame>>();
  private readonly sceneListeners = new Set<(scene: SceneDescription, loaded: boolean) => void>();
  private readonly errorListeners = new Set<Listener<string>>();
  private lastRequest = 0;
  private readonly becomesReady: Promise<{ version: string; builtins: BuiltIn[] }>;
  private resolveReady!: (value: { version: string; builtins: BuiltIn[] }) => void;
  private rejectReady!: (reason: Error) => void;

  /** Starts the worker of this package, or speaks through a channel that is given. */
  constructor(channel?: Channel) {
    this.becomesReady = new Promise((resolve, reject) => {
      this.resolveReady = resolve;
      this.rejectReady = reject;
    });
    // The failure also reaches those who never ask.
    this.becomesReady.catch(() => undefined);
    this.channel =
      channel ?? (new Worker(new URL("./worker.ts", import.meta.url), { type: "module", name: "engine" }) as Channel);
    this.channel.addEventListener("message", (event: MessageEvent<FromWorker>) => this.receive(event.data));
    this.channel.addEventListener("error", (event: ErrorEvent) =>
      this.fail(event.message || "the worker of the engine could not be loaded"),
    );
  }

  /** The built-in scenes, once the engine is up. Rejects where wasm cannot run. */
  ready(): Promise<{ version: string; builtins: BuiltIn[] }> {
    return this.becomesReady;
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

  /** Calls `listener` when the engine stops for good. */
  onError(listener: Listener<string>): () => void {
    this.errorListeners.add(listener);
    return () => this.errorListeners.delete(listener);
  }

  /** Ends the worker. */
  dispose(): void {
    this.channel.terminate();
    this.rejectAll(new Error("the engine was closed"));
  }

  private receive(message: FromWorker): void {
    switch (message.type) {
      case "ready":
        this.resolveReady({ version: message.version, builtins: message.builtins });
        break;
      case "failed":
        this.fail(message.message);
        break;
      case "scene":
        this.scene = message.scene;
        for (const listener of this.sceneListeners) listener(message.scene, message.loaded);
        break;
      case "frame": {
        const old = this.frame;
        this.frame = message.frame;
        for (const listener of this.frameListeners) listener(message.frame);
        if (old) {
          const buffers = buffersOf(old);
          this.send("recycle", { buffers }, buffers);
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

  private fail(message: string): void {
    const error = new Error(message);
    this.rejectReady(error);
    this.rejectAll(error);
    for (const listener of this.errorListeners) listener(message);
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
