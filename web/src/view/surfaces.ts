// The sections themselves: one mesh for all bodies, coloured by body and cell, with soft light and shadows.
import { Mesh, MeshStandardMaterial } from "three";
import type { Surface } from "../engine/protocol";
import type { BodyStyles } from "./body-styles";
import { CELL_SHADES } from "./palette";
import { StreamGeometry } from "./stream-geometry";

export type SurfaceMode = "solid" | "glass" | "off";

const GLASS_OPACITY = 0.34;

/** How much brighter a body is that is selected or under the pointer. */
const LIT = 1.16;

export class SurfaceLayer {
  private readonly stream = new StreamGeometry([
    { name: "position", size: 3, make: (length) => new Float32Array(length) },
    { name: "normal", size: 3, make: (length) => new Float32Array(length) },
    { name: "color", size: 3, make: (length) => new Uint8Array(length), normalized: true },
  ]);
  private readonly material = new MeshStandardMaterial({ vertexColors: true, roughness: 0.42, metalness: 0.0, envMapIntensity: 0.85 });
  /** Draws all cells of a body in one shade. */
  plain = false;
  readonly mesh = new Mesh(this.stream.geometry, this.material);

  constructor(private readonly styles: BodyStyles) {
    this.mesh.frustumCulled = false;
    this.mesh.castShadow = true;
    this.mesh.receiveShadow = true;
    // Sections of bodies that the slice grazes are thin: without an offset their edges would fight them.
    this.material.polygonOffset = true;
    this.material.polygonOffsetFactor = 1;
    this.material.polygonOffsetUnits = 1;
  }

  setMode(mode: SurfaceMode): void {
    this.mesh.visible = mode !== "off";
    this.mesh.castShadow = mode === "solid";
    this.material.transparent = mode === "glass";
    this.material.opacity = mode === "glass" ? GLASS_OPACITY : 1;
    this.material.depthWrite = mode !== "glass";
    this.material.needsUpdate = true;
  }

  update(surface: Surface): void {
    const vertices = surface.positions.length / 3;
    this.stream.reserve(vertices);
    if (vertices > 0) {
      this.stream.array("position").set(surface.positions);
      this.stream.array("normal").set(surface.normals);
      this.paint(surface, this.stream.array<Uint8Array>("color"));
    }
    this.stream.commit(vertices);
  }

  private paint(surface: Surface, colours: Uint8Array): void {
    const { ranges, cells } = surface;
    for (let range = 0; range < ranges.length; range += 3) {
      const body = ranges[range];
      const { shades } = this.styles.of(body);
      const light = body === this.styles.hovered || body === this.styles.selected ? LIT : 1;
      const end = ranges[range + 1] + ranges[range + 2];
      for (let vertex = ranges[range + 1]; vertex < end; vertex++) {
        const shade = this.plain ? 0 : 3 * (cells[vertex] % CELL_SHADES);
        colours[3 * vertex] = Math.min(255, shades[shade] * light);
        colours[3 * vertex + 1] = Math.min(255, shades[shade + 1] * light);
        colours[3 * vertex + 2] = Math.min(255, shades[shade + 2] * light);
      }
    }
  }
}
