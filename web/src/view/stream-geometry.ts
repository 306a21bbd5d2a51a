// Geometry whose contents change with every frame. Its buffers grow by doubling and are refilled in place, so that a
// steady scene allocates nothing and the graphics memory is written once a frame.
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, type TypedArray } from "three";

/** Smallest number of vertices that a buffer is made for. */
const LEAST_VERTICES = 1024;

interface Layout {
  name: string;
  size: number;
  make(length: number): TypedArray;
  normalized?: boolean;
}

/** A vertex buffer geometry that is refilled each frame. */
export class StreamGeometry {
  readonly geometry = new BufferGeometry();
  private capacity = 0;

  constructor(private readonly layout: readonly Layout[]) {
    // From the start: three.js shades flat, for good, what has no normals when it is drawn first.
    this.reserve(LEAST_VERTICES);
    this.geometry.setDrawRange(0, 0);
  }

  /** Makes room for so many vertices; what the buffers held is lost when they grow. */
  reserve(vertices: number): void {
    if (vertices <= this.capacity) return;
    this.capacity = LEAST_VERTICES;
    while (this.capacity < vertices) this.capacity *= 2;
    this.geometry.dispose();
    for (const { name, size, make, normalized } of this.layout) {
      const attribute = new BufferAttribute(make(this.capacity * size), size, normalized ?? false);
      attribute.setUsage(DynamicDrawUsage);
      this.geometry.setAttribute(name, attribute);
    }
  }

  /** The array of an attribute, to be filled; call `reserve` before and `commit` after. */
  array<T extends TypedArray>(name: string): T {
    return (this.geometry.getAttribute(name) as BufferAttribute).array as T;
  }

  /** Draws the first `vertices` from now on. */
  commit(vertices: number): void {
    this.geometry.setDrawRange(0, vertices);
    if (vertices === 0) return;
    for (const { name, size } of this.layout) {
      const attribute = this.geometry.getAttribute(name) as BufferAttribute;
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, vertices * size);
      attribute.needsUpdate = true;
    }
  }
}
