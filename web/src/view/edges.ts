// Crisp edges of the sections: lines as wide as a pen's on every screen, brighter on what is selected. Wide lines are
// instanced quads (three's LineMaterial); graphics drivers draw plain lines one pixel thin.
import { DynamicDrawUsage, InstancedInterleavedBuffer, InterleavedBufferAttribute } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import type { Lines } from "../engine/protocol";
import type { BodyStyles } from "./body-styles";

/** Floats of an instance: two ends of three coordinates. */
const STRIDE = 6;
const LEAST_SEGMENTS = 512;

const EDGE_PIXELS = 1.5;
const EDGE_OPACITY = 0.85;

export class EdgeLayer {
  private readonly geometry = new LineSegmentsGeometry();
  private readonly material = new LineMaterial({ vertexColors: true, linewidth: EDGE_PIXELS, transparent: true, opacity: EDGE_OPACITY });
  readonly lines = new LineSegments2(this.geometry, this.material);
  private ends = new InstancedInterleavedBuffer(new Float32Array(0), STRIDE, 1);
  private colours = new InstancedInterleavedBuffer(new Float32Array(0), STRIDE, 1);
  private capacity = 0;
  private on = true;

  constructor(private readonly styles: BodyStyles) {
    this.lines.frustumCulled = false;
    this.material.depthWrite = false;
    this.reserve(1);
    this.geometry.instanceCount = 0;
  }

  setOn(on: boolean): void {
    this.on = on;
    this.lines.visible = on;
  }

  update(edges: Lines): void {
    if (!this.on) return;
    const segments = edges.positions.length / STRIDE;
    this.reserve(segments);
    this.geometry.instanceCount = segments;
    this.lines.visible = segments > 0;
    if (segments === 0) return;
    (this.ends.array as Float32Array).set(edges.positions);
    this.paint(edges);
    for (const buffer of [this.ends, this.colours]) {
      buffer.clearUpdateRanges();
      buffer.addUpdateRange(0, segments * STRIDE);
      buffer.needsUpdate = true;
    }
  }

  private paint({ ranges }: Lines): void {
    const colours = this.colours.array as Float32Array;
    for (let range = 0; range < ranges.length; range += 3) {
      const body = ranges[range];
      const bright = body === this.styles.selected || body === this.styles.hovered;
      const [r, g, b] = bright ? [1.6, 1.6, 1.6] : this.styles.of(body).edge;
      const end = 3 * (ranges[range + 1] + ranges[range + 2]);
      for (let at = 3 * ranges[range + 1]; at < end; at += 3) {
        colours[at] = r;
        colours[at + 1] = g;
        colours[at + 2] = b;
      }
    }
  }

  private reserve(segments: number): void {
    if (segments <= this.capacity) return;
    this.capacity = LEAST_SEGMENTS;
    while (this.capacity < segments) this.capacity *= 2;
    this.geometry.dispose();
    this.ends = new InstancedInterleavedBuffer(new Float32Array(this.capacity * STRIDE), STRIDE, 1);
    this.colours = new InstancedInterleavedBuffer(new Float32Array(this.capacity * STRIDE), STRIDE, 1);
    for (const [buffer, start, end] of [
      [this.ends, "instanceStart", "instanceEnd"],
      [this.colours, "instanceColorStart", "instanceColorEnd"],
    ] as const) {
      buffer.setUsage(DynamicDrawUsage);
      this.geometry.setAttribute(start, new InterleavedBufferAttribute(buffer, 3, 0));
      this.geometry.setAttribute(end, new InterleavedBufferAttribute(buffer, 3, 3));
    }
  }
}
