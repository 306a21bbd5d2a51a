/** The worker: loads the engine and lets `EngineLoop` run. */

import init, { Engine } from "./pkg/hyperbody_wasm.js";
import wasmAddress from "./pkg/hyperbody_wasm_bg.wasm?url";
import { EngineLoop } from "./loop";
import type { BuiltIn, FromWorker, ToWorker } from "./protocol";

/** A module of one function with one vector instruction: whether the browser knows those. */
const VECTOR_PROBE = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11,
]);

const scope = globalThis as unknown as {
  postMessage(message: FromWorker, transfer?: Transferable[]): void;
  addEventListener(type: "message", listener: (event: MessageEvent<ToWorker>) => void): void;
};

// What arrives before the engine is up waits for it.
const early: ToWorker[] = [];
let loop: EngineLoop | null = null;
let broken = false;

scope.addEventListener("message", (event) => {
  if (loop) guarded(loop, (running) => running.receive(event.data));
  else early.push(event.data);
});

/** A program that has stopped in the middle of something is not asked again: the page is told, and starts another. */
function guarded(running: EngineLoop, act: (running: EngineLoop) => void): void {
  if (broken) return;
  try {
    act(running);
  } catch (error) {
    broken = true;
    scope.postMessage({ type: "failed", message: reasonOf(error) });
  }
}

const reasonOf = (error: unknown) => (error instanceof Error ? error.message : String(error));

async function start(): Promise<void> {
  if (typeof WebAssembly === "undefined") throw new Error("This browser has no WebAssembly, which the engine runs in.");
  if (!WebAssembly.validate(VECTOR_PROBE)) {
    throw new Error("This browser's WebAssembly has no vector instructions (SIMD), which the engine needs; a newer one has.");
  }
  const program = await init({ module_or_path: wasmAddress });
  loop = new EngineLoop({
    engine: new Engine(),
    memory: () => program.memory.buffer as ArrayBuffer,
    clock: () => performance.now(),
    send: (message, transfer) => scope.postMessage(message, transfer),
  });
  const builtins = JSON.parse(Engine.builtins()) as BuiltIn[];
  scope.postMessage({ type: "ready", version: Engine.version(), builtins });
  const running = loop;
  for (const message of early.splice(0)) guarded(running, () => running.receive(message));
  beat(running);
}

function beat(running: EngineLoop): void {
  let pause = 16;
  guarded(running, () => (pause = running.round()));
  if (!broken) setTimeout(() => beat(running), pause);
}

start().catch((error: unknown) => scope.postMessage({ type: "failed", message: reasonOf(error) }));
