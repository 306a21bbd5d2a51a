/** From the memory of the wasm program to frames that can be sent: arrays are copied once, into buffers that come back. */

import type { Frame } from "./protocol";

/** Buffers that frames have given back. */
export class BufferPool {
  private free: ArrayBuffer[] = [];

  /** Takes buffers back. */
  put(buffers: ArrayBuffer[]): void {
    this.free.push(...buffers);
    // Two frames are under way at most; more buffers than they have are of a scene that is gone.
    if (this.free.length > 40) this.free.splice(0, this.free.length - 40);
  }

  /** A buffer of at least so many bytes: the smallest that fits, else a new one with room to grow. */
  take(bytes: number): ArrayBuffer {
    let best = -1;
    for (let index = 0; index < this.free.length; index += 1) {
      const size = this.free[index]!.byteLength;
      if (size >= bytes && (best < 0 || size < this.free[best]!.byteLength)) best = index;
    }
    // One that is far too large is worth more elsewhere.
    if (best >= 0 && this.free[best]!.byteLength <= 4 * bytes + 1024) return this.free.splice(best, 1)[0]!;
    let size = 256;
    while (size < bytes) size *= 2;
    return new ArrayBuffer(size);
  }
}

/** The arrays of a frame in the order of the engine's layout. */
const ARRAYS = [
  ["surfacePositions", Float32Array],
  ["surfaceNormals", Float32Array],
  ["surfaceCells", Uint16Array],
  ["surfaceRanges", Uint32Array],
  ["edgePositions", Float32Array],
  ["edgeRanges", Uint32Array],
  ["ghostPositions", Float32Array],
  ["ghostNormals", Float32Array],
  ["ghostRanges", Uint32Array],
  ["ghostDistances", Float32Array],
  ["wirePositions", Float32Array],
  ["wireOff", Float32Array],
  ["wireRanges", Uint32Array],
  ["jointRods", Float32Array],
  ["jointMarks", Float32Array],
  ["halfSpaces", Float32Array],
  ["strip", Float32Array],
  ["centres", Float32Array],
  ["asleep", Uint32Array],
] as const;

type Arrays = {
  [K in (typeof ARRAYS)[number] as K[0]]: K[1] extends Float32ArrayConstructor
    ? Float32Array<ArrayBuffer>
    : K[1] extends Uint16ArrayConstructor
      ? Uint16Array<ArrayBuffer>
      : Uint32Array<ArrayBuffer>;
};

/** What the engine's report holds: the parts of a frame that are no arrays. */
export type Report = Pick<
  Frame,
  "time" | "step" | "slice" | "selected" | "impacts" | "hands" | "quarantined" | "history" | "energy"
>;

/** Copies the arrays that `layout` (address and length of each) describes out of the program's memory. */
export function copyArrays(memory: ArrayBuffer, layout: ArrayLike<number>, pool: BufferPool): Arrays {
  const arrays: Record<string, unknown> = {};
  ARRAYS.forEach(([name, Type], index) => {
    const length = layout[2 * index + 1] ?? 0;
    const source = new Type(memory, length > 0 ? layout[2 * index]! : 0, length);
    const copy = new Type(pool.take(length * Type.BYTES_PER_ELEMENT), 0, length);
    copy.set(source);
    arrays[name] = copy;
  });
  return arrays as Arrays;
}

/** A frame of the engine's arrays and report, and of what the worker knows. */
export function assemble(
  arrays: Arrays,
  report: Report,
  own: Pick<Frame, "number" | "paused" | "slowdown" | "workerMs">,
  shown: { ghosts: boolean; wires: boolean },
): Frame {
  return {
    ...own,
    ...report,
    surface: {
      positions: arrays.surfacePositions,
      normals: arrays.surfaceNormals,
      cells: arrays.surfaceCells,
      ranges: arrays.surfaceRanges,
    },
    edges: { positions: arrays.edgePositions, ranges: arrays.edgeRanges },
    ghosts: shown.ghosts
      ? {
          positions: arrays.ghostPositions,
          normals: arrays.ghostNormals,
          ranges: arrays.ghostRanges,
          distances: arrays.ghostDistances,
        }
      : null,
    wires: shown.wires
      ? { positions: arrays.wirePositions, off: arrays.wireOff, ranges: arrays.wireRanges }
      : null,
    joints: { rods: arrays.jointRods, marks: arrays.jointMarks },
    halfSpaces: arrays.halfSpaces,
    strip: arrays.strip,
    centres: arrays.centres,
    asleep: arrays.asleep,
  };
}
