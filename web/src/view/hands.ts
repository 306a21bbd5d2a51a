// Hands that hold something: a taut line from the grabbed point to where the hand is, and a bead at either end, so that
// one sees the spring that pulls. Warm or cool when the hand wants the body off the slice.
import { BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, SphereGeometry } from "three";
import type { Held, Slice } from "../engine/protocol";
import { COOL, WARM } from "./palette";

const MOST_HANDS = 12;
const BEAD_RADIUS = 0.035;
const LEVEL = "#ffffff";
/** Beyond this distance off the slice the bead takes the side's colour, m. */
const OFF_THRESHOLD = 0.05;

export class HandLayer {
  readonly group = new Group();
  private readonly positions = new BufferAttribute(new Float32Array(6 * MOST_HANDS), 3);
  private readonly lines: LineSegments;
  private readonly beads: Mesh<SphereGeometry, MeshBasicMaterial>[] = [];

  constructor() {
    const geometry = new BufferGeometry().setAttribute("position", this.positions);
    this.lines = new LineSegments(geometry, new LineBasicMaterial({ color: LEVEL, transparent: true, opacity: 0.7, depthTest: false }));
    this.lines.frustumCulled = false;
    this.group.renderOrder = 5;
    this.group.add(this.lines);
    const sphere = new SphereGeometry(BEAD_RADIUS, 16, 12);
    for (let i = 0; i < 2 * MOST_HANDS; i++) {
      const bead = new Mesh(sphere, new MeshBasicMaterial({ color: LEVEL, transparent: true, opacity: 0.95, depthTest: false }));
      bead.renderOrder = 6;
      this.beads.push(bead);
      this.group.add(bead);
    }
  }

  update(held: readonly Held[], slice: Required<Slice>): void {
    const count = Math.min(MOST_HANDS, held.length);
    for (let i = 0; i < count; i++) {
      this.bead(2 * i, held[i].point, slice);
      this.bead(2 * i + 1, held[i].target, slice);
    }
    this.beads.forEach((bead, i) => (bead.visible = i < 2 * count));
    this.positions.needsUpdate = count > 0;
    this.lines.geometry.setDrawRange(0, 2 * count);
  }

  private bead(index: number, point: readonly number[], slice: Required<Slice>): void {
    const along = (direction: readonly number[] | undefined) =>
      direction ? direction.reduce((sum, value, i) => sum + value * (point[i] - slice.origin[i]), 0) : 0;
    const bead = this.beads[index];
    bead.position.set(along(slice.axes[0]), along(slice.axes[1]), along(slice.axes[2]));
    bead.position.toArray(this.positions.array as Float32Array, 3 * index);
    const off = along(slice.off[0]);
    bead.material.color.set(Math.abs(off) < OFF_THRESHOLD ? LEVEL : off > 0 ? WARM : COOL);
  }
}
