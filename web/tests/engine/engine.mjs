// The engine under Node, as the worker loads it in a browser.
import { readFileSync } from "node:fs";
import { Engine, initSync } from "../../src/engine/pkg/hyperbody_wasm.js";

const bytes = readFileSync(new URL("../../src/engine/pkg/hyperbody_wasm_bg.wasm", import.meta.url));
const program = initSync({ module: bytes });

/** The memory of the program, as it is now. */
export const memory = () => program.memory.buffer;

/** Names of the built-in scenes. */
export const builtins = () => JSON.parse(Engine.builtins());

/** An engine that throws what it refuses. */
export class Checked {
  engine = new Engine();

  ask(message) {
    const reply = JSON.parse(this.engine.handle(JSON.stringify(message)));
    if (reply.refused) throw new Error(`${message.type} was refused: ${reply.refused.message}`);
    return reply.answer;
  }

  steps(count) {
    for (let step = 0; step < count; step += 1) this.engine.step();
  }

  free() {
    this.engine.free();
  }
}
