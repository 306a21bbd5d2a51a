// What lies off the slice, drawn as light: ghosts of near bodies as glowing shells, and wireframes of whole bodies. Both
// are warm on the positive side and cool on the negative one, fade with distance, and add to what is behind them, so that
// nothing has to be sorted.
import { AdditiveBlending, Color, LineSegments, Mesh, ShaderMaterial } from "three";
import type { Ghosts, Wires } from "../engine/protocol";
import { COOL, WARM } from "./palette";
import { StreamGeometry } from "./stream-geometry";

const SIDES = /* glsl */ `
  uniform vec3 warm, cool;
  uniform float reach, strength;
  vec3 sideColour(float off) { return off > 0.0 ? warm : cool; }
  float fade(float off) { float t = clamp(1.0 - abs(off) / reach, 0.0, 1.0); return t * t * (3.0 - 2.0 * t); }
`;

function sideUniforms(reach: number, strength: number) {
  return { warm: { value: new Color(WARM) }, cool: { value: new Color(COOL) }, reach: { value: reach }, strength: { value: strength } };
}

/** Of a lone ghost; and the number of ghosts that halves it. */
const STRENGTH = 1.1;
const CROWD = 14;

export class GhostLayer {
  private readonly stream = new StreamGeometry([
    { name: "position", size: 3, make: (length) => new Float32Array(length) },
    { name: "normal", size: 3, make: (length) => new Float32Array(length) },
    { name: "off", size: 1, make: (length) => new Float32Array(length) },
  ]);
  // A rim that is brightest where the surface is seen edge-on shows the shape and leaves the middle clear.
  private readonly material = new ShaderMaterial({
    uniforms: sideUniforms(1, 1),
    vertexShader: /* glsl */ `
      attribute float off;
      varying vec3 n, toEye; varying float o;
      void main() {
        vec4 p = modelViewMatrix * vec4(position, 1.0);
        n = normalMatrix * normal; toEye = -p.xyz; o = off;
        gl_Position = projectionMatrix * p;
      }`,
    fragmentShader: /* glsl */ `
      ${SIDES}
      varying vec3 n, toEye; varying float o;
      void main() {
        float facing = abs(dot(normalize(n), normalize(toEye)));
        float glow = 0.10 + 0.55 * pow(1.0 - facing, 2.0);
        gl_FragColor = vec4(sideColour(o) * strength * fade(o) * glow, 1.0);
      }`,
    blending: AdditiveBlending,
    transparent: true,
    depthWrite: false,
  });
  readonly mesh = new Mesh(this.stream.geometry, this.material);

  constructor() {
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 2;
  }

  update(ghosts: Ghosts | null, reach: number): void {
    this.mesh.visible = ghosts !== null;
    if (!ghosts) return;
    this.material.uniforms.reach.value = reach;
    // Light adds up: many ghosts are fainter each.
    this.material.uniforms.strength.value = STRENGTH / (1 + ghosts.distances.length / CROWD);
    const vertices = ghosts.positions.length / 3;
    this.stream.reserve(vertices);
    if (vertices > 0) {
      this.stream.array("position").set(ghosts.positions);
      this.stream.array("normal").set(ghosts.normals);
      const off = this.stream.array("off");
      for (let range = 0; range < ghosts.distances.length; range++) {
        const first = ghosts.ranges[3 * range + 1];
        off.fill(ghosts.distances[range], first, first + ghosts.ranges[3 * range + 2]);
      }
    }
    this.stream.commit(vertices);
  }
}

export class WireLayer {
  private readonly stream = new StreamGeometry([
    { name: "position", size: 3, make: (length) => new Float32Array(length) },
    { name: "off", size: 1, make: (length) => new Float32Array(length) },
  ]);
  private readonly material = new ShaderMaterial({
    uniforms: sideUniforms(2.5, 0.6),
    vertexShader: /* glsl */ `
      attribute float off; varying float o;
      void main() { o = off; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
    fragmentShader: /* glsl */ `
      ${SIDES}
      varying float o;
      void main() {
        vec3 hue = mix(cool, warm, smoothstep(-0.25, 0.25, o));
        gl_FragColor = vec4(hue * strength * (0.15 + 0.85 * fade(o)), 1.0);
      }`,
    blending: AdditiveBlending,
    transparent: true,
    depthWrite: false,
  });
  readonly lines = new LineSegments(this.stream.geometry, this.material);

  constructor() {
    this.lines.frustumCulled = false;
    this.lines.renderOrder = 3;
  }

  update(wires: Wires | null): void {
    this.lines.visible = wires !== null;
    if (!wires) return;
    const vertices = wires.positions.length / 3;
    this.stream.reserve(vertices);
    if (vertices > 0) {
      this.stream.array("position").set(wires.positions);
      this.stream.array("off").set(wires.off);
    }
    this.stream.commit(vertices);
  }
}
