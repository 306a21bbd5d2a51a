// Joints: a thin rod from each anchor to the body that it belongs to, and a bead at the anchor. Like ghosts they are warm and
// cool off the slice and fade with the distance from it, along each rod. Rods are instances of one cylinder and beads of one
// ball, so a frame copies two small arrays and allocates nothing.
import {
  BufferGeometry, Color, CylinderGeometry, DynamicDrawUsage, GreaterDepth, Group, IcosahedronGeometry, InstancedBufferGeometry, InstancedInterleavedBuffer, InterleavedBufferAttribute, Mesh, ShaderMaterial, Vector3, Vector4,
} from "three";
import type { Joints } from "../engine/protocol";
import { COOL, WARM } from "./palette";

/** Radius of a rod: a share of the scene's extent, within limits, m. A bead is so many times as thick. */
const RADIUS_SHARE = 0.0055;
const RADIUS_LIMITS = [0.008, 0.05] as const;
const BEAD = 1.8;
/** They are seen so many times as far off the slice as ghosts: they are few and thin. */
const FARTHER = 2;
/** What is seen of a bead through what covers it: a dark point, as of a pin, so many times as thick, and so strong. */
const PIN = { colour: "#0b1020", thick: 1.7, strength: 0.75 };
const STEEL = "#ccd5ea";
/** Numbers of a point: its place, and how far off the slice it is. */
const POINT = 4;
const LEAST_INSTANCES = 16;

/** Rods and beads, drawn into the world, and for Flatland flattened onto its plane. */
export class JointLayer {
  readonly group = new Group();
  /** The same in the picture of Flatland. */
  readonly flat = new Group();
  private readonly rods = new Instances(new CylinderGeometry(1, 1, 1, 10, 1, true), ["start", "end"]);
  private readonly beads = new Instances(new IcosahedronGeometry(BEAD, 2), ["start"]);
  private readonly radius = { value: RADIUS_LIMITS[0] as number };
  private readonly reach = { value: 1 };
  /** Flatland's plane: its normal, and how far from the origin it is. */
  private readonly plane = { value: new Vector4() };

  constructor() {
    this.group.add(...this.meshes(false), this.covered());
    this.flat.add(...this.meshes(true));
  }

  private meshes(flat: boolean): Mesh[] {
    return [this.rods, this.beads].map((instances) => {
      const mesh = new Mesh(instances.geometry, this.material(instances === this.beads, flat));
      mesh.frustumCulled = false;
      mesh.renderOrder = 1;
      return mesh;
    });
  }

  /** Beads that lie within bodies, as hinges do, show through as pins. */
  private covered(): Mesh {
    const material = this.material(true, false);
    Object.assign(material, { depthFunc: GreaterDepth, depthWrite: false });
    material.uniforms.strength.value = PIN.strength;
    material.uniforms.thick.value = PIN.thick;
    for (const name of ["steel", "warm", "cool"]) material.uniforms[name].value = new Color(PIN.colour);
    const mesh = new Mesh(this.beads.geometry, material);
    mesh.frustumCulled = false;
    mesh.renderOrder = 1;
    return mesh;
  }

  setOn(on: boolean): void {
    this.group.visible = this.flat.visible = on;
  }

  setScale(extent: number): void {
    this.radius.value = Math.min(RADIUS_LIMITS[1], Math.max(RADIUS_LIMITS[0], RADIUS_SHARE * extent));
  }

  setPlane(normal: Vector3, point: Vector3): void {
    this.plane.value.set(normal.x, normal.y, normal.z, normal.dot(point));
  }

  update(joints: Joints, reach: number): void {
    this.reach.value = FARTHER * reach;
    this.rods.fill(joints.rods);
    this.beads.fill(joints.marks);
  }

  private material(bead: boolean, flat: boolean): ShaderMaterial {
    return new ShaderMaterial({
      defines: { ...(bead && { BEAD: 1 }), ...(flat && { FLAT: 1 }) },
      uniforms: {
        radius: this.radius, reach: this.reach, plane: this.plane,
        strength: { value: 1 }, thick: { value: 1 }, steel: { value: new Color(STEEL) }, warm: { value: new Color(WARM) }, cool: { value: new Color(COOL) },
      },
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      transparent: true,
      depthTest: !flat,
    });
  }
}

/** Instances of a geometry, each with points of its own; their buffer grows by doubling. */
class Instances {
  readonly geometry = new InstancedBufferGeometry();
  private points = new InstancedInterleavedBuffer(new Float32Array(0), POINT, 1);
  private capacity = 0;

  constructor(shape: BufferGeometry, private readonly names: readonly string[]) {
    this.geometry.setIndex(shape.getIndex());
    this.geometry.setAttribute("position", shape.getAttribute("position"));
    this.reserve(1);
    this.geometry.instanceCount = 0;
  }

  fill(points: Float32Array): void {
    const stride = POINT * this.names.length;
    this.reserve(points.length / stride);
    this.geometry.instanceCount = points.length / stride;
    if (points.length === 0) return;
    (this.points.array as Float32Array).set(points);
    this.points.clearUpdateRanges();
    this.points.addUpdateRange(0, points.length);
    this.points.needsUpdate = true;
  }

  private reserve(count: number): void {
    if (count <= this.capacity) return;
    this.capacity = LEAST_INSTANCES;
    while (this.capacity < count) this.capacity *= 2;
    this.geometry.dispose();
    const stride = POINT * this.names.length;
    this.points = new InstancedInterleavedBuffer(new Float32Array(this.capacity * stride), stride, 1);
    this.points.setUsage(DynamicDrawUsage);
    this.names.forEach((name, at) => this.geometry.setAttribute(name, new InterleavedBufferAttribute(this.points, POINT, POINT * at)));
  }
}

const VERTEX = /* glsl */ `
  attribute vec4 start;
  uniform float radius, thick; uniform vec4 plane;
  varying vec3 n; varying float o;
  #ifdef BEAD
    void main() {
      vec3 around = position;
      vec4 point = start;
  #else
    attribute vec4 end;
    void main() {
      vec3 along = normalize(end.xyz - start.xyz + vec3(0.0, 1e-9, 0.0));
      vec3 side = normalize(cross(along, abs(along.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
      vec3 around = side * position.x + cross(along, side) * position.z;
      vec4 point = mix(start, end, position.y + 0.5);
  #endif
      vec3 place = point.xyz + radius * thick * around;
      o = point.w;
  #ifdef FLAT
      o += dot(plane.xyz, point.xyz) - plane.w;
      // Just behind the plane, where the camera of Flatland begins to see.
      place -= plane.xyz * (dot(plane.xyz, place) - plane.w + 0.01);
  #endif
      n = normalMatrix * around;
      gl_Position = projectionMatrix * modelViewMatrix * vec4(place, 1.0);
    }`;

const FRAGMENT = /* glsl */ `
  uniform vec3 steel, warm, cool; uniform float reach, strength;
  varying vec3 n; varying float o;
  void main() {
    float t = clamp(1.0 - abs(o) / reach, 0.0, 1.0);
    float alpha = strength * t * t * (3.0 - 2.0 * t);
    if (alpha < 0.01) discard;
    vec3 colour = mix(steel, o > 0.0 ? warm : cool, smoothstep(0.05, 0.4, abs(o)));
    #ifndef FLAT
      vec3 light = normalize((viewMatrix * vec4(0.45, 1.0, 0.55, 0.0)).xyz);
      colour *= 0.5 + 0.5 * max(0.0, dot(normalize(n), light));
    #endif
    gl_FragColor = vec4(colour, alpha);
    #include <colorspace_fragment>
  }`;
