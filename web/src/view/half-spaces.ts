// Floors and walls: planes without end, with the world's own lattice drawn on them. The lines are where a world
// coordinate is whole, whatever the slice: turn the slice from x towards w and the lines of x thin out while those of w,
// in gold, close in. So the floor itself tells how the slice lies.
import { FrontSide, Group, Mesh, MeshStandardMaterial, PlaneGeometry, Vector3, Vector4, type WebGLProgramParametersWithUniforms } from "three";
import type { Slice } from "../engine/protocol";

/** Half-spaces that can be drawn at once: a pit of six dimensions shows at most six walls in a slice; one floor. */
const MOST_PLANES = 12;
const MOST_AXES = 6;

/** Side of the square that stands for a plane, m; it has faded to nothing long before. */
const SIDE = 600;

/** Floors are nearly opaque, walls a hint. */
const FLOOR_OPACITY = 1;
const WALL_OPACITY = 0.16;

/** A plane is a floor when its normal is this near to the view's up. */
const FLOOR_COSINE = 0.5;

/** Where the floor has faded into the haze, in extents of the scene. */
const FADE_EXTENTS = 9;

const UP = new Vector3(0, 0, 1);

interface Shared {
  lattice: { value: Vector4[] };
  axes: { value: number };
  planes: { value: Vector4[] };
  planeCount: { value: number };
  middle: { value: Vector3 };
  fadeAt: { value: number };
}

export class HalfSpaceLayer {
  readonly group = new Group();
  private readonly meshes: Mesh<PlaneGeometry, MeshStandardMaterial>[] = [];
  private readonly own: { value: number }[] = [];
  private readonly shared: Shared = {
    lattice: { value: Array.from({ length: MOST_AXES }, () => new Vector4()) },
    axes: { value: 0 },
    planes: { value: Array.from({ length: MOST_PLANES }, () => new Vector4()) },
    planeCount: { value: 0 },
    middle: { value: new Vector3() },
    fadeAt: { value: 60 },
  };

  /** Around what, and how large, the scene is: planes are centred and fade there. */
  setScale(middle: Vector3, extent: number): void {
    this.shared.middle.value.copy(middle);
    this.shared.fadeAt.value = Math.max(24, FADE_EXTENTS * extent);
  }

  update(halfSpaces: Float32Array, slice: Slice): void {
    const count = Math.min(MOST_PLANES, halfSpaces.length / 5);
    this.shared.planeCount.value = count;
    this.shared.axes.value = slice.origin.length;
    slice.origin.forEach((origin, axis) => {
      const along = (k: number) => slice.axes[k]?.[axis] ?? 0;
      this.shared.lattice.value[axis].set(along(0), along(1), along(2), origin);
    });
    for (let i = 0; i < count; i++) {
      const [nx, ny, nz, offset] = halfSpaces.subarray(5 * i + 1, 5 * i + 5);
      this.shared.planes.value[i].set(nx, ny, nz, offset);
      this.place(this.mesh(i), new Vector3(nx, ny, nz), offset);
    }
    this.meshes.forEach((mesh, i) => (mesh.visible = i < count));
  }

  private place(mesh: Mesh<PlaneGeometry, MeshStandardMaterial>, normal: Vector3, offset: number): void {
    const middle = this.shared.middle.value;
    mesh.quaternion.setFromUnitVectors(UP, normal);
    mesh.position.copy(middle).addScaledVector(normal, offset - normal.dot(middle));
    const floor = normal.y > FLOOR_COSINE;
    mesh.material.opacity = floor ? FLOOR_OPACITY : WALL_OPACITY;
    mesh.receiveShadow = floor;
    mesh.renderOrder = floor ? 0 : 1;
  }

  private mesh(index: number): Mesh<PlaneGeometry, MeshStandardMaterial> {
    if (!this.meshes[index]) {
      const own = { value: index };
      const mesh = new Mesh(new PlaneGeometry(SIDE, SIDE), this.material(own));
      mesh.frustumCulled = false;
      this.own[index] = own;
      this.meshes[index] = mesh;
      this.group.add(mesh);
    }
    return this.meshes[index];
  }

  private material(own: { value: number }): MeshStandardMaterial {
    const material = new MeshStandardMaterial({ color: "#1d2338", roughness: 0.85, transparent: true, side: FrontSide, depthWrite: false });
    material.onBeforeCompile = (shader: WebGLProgramParametersWithUniforms) => {
      Object.assign(shader.uniforms, this.shared, { own });
      shader.vertexShader = shader.vertexShader
        .replace("#include <common>", "#include <common>\nvarying vec3 inSlice;")
        .replace("#include <begin_vertex>", "#include <begin_vertex>\ninSlice = (modelMatrix * vec4(position, 1.0)).xyz;");
      shader.fragmentShader = shader.fragmentShader
        .replace("#include <common>", `#include <common>\n${LATTICE}`)
        .replace("#include <color_fragment>", "#include <color_fragment>\nlayLattice(diffuseColor);");
    };
    return material;
  }
}

const LATTICE = /* glsl */ `
  varying vec3 inSlice;
  uniform vec4 lattice[${MOST_AXES}];
  uniform int axes, planeCount, own;
  uniform vec4 planes[${MOST_PLANES}];
  uniform vec3 middle;
  uniform float fadeAt;

  // A line where c is a multiple of every, one to two pixels wide, gone before lines would run together.
  float line(float c, float every, float slope) {
    float x = c / every;
    float w = max(fwidth(x), 1e-6);
    float l = 1.0 - smoothstep(0.6, 1.6, abs(fract(x - 0.5) - 0.5) / w);
    return l * (1.0 - smoothstep(0.12, 0.45, w)) * smoothstep(0.03, 0.3, slope);
  }

  vec3 lineColour(int axis) {
    if (axis < 3) return vec3(0.50, 0.62, 1.0);
    if (axis == 3) return vec3(1.0, 0.62, 0.18);
    if (axis == 4) return vec3(0.25, 0.95, 0.72);
    return vec3(0.95, 0.40, 0.75);
  }

  void layLattice(inout vec4 colour) {
    // What lies inside another half-space is hidden in it: rooms have corners.
    for (int i = 0; i < ${MOST_PLANES}; i++) {
      if (i >= planeCount) break;
      if (i != own && dot(planes[i].xyz, inSlice) < planes[i].w - 1e-3) discard;
    }
    vec3 n = planes[own].xyz;
    vec3 lines = vec3(0.0);
    float cover = 0.0;
    for (int axis = 0; axis < ${MOST_AXES}; axis++) {
      if (axis >= axes) break;
      vec3 a = lattice[axis].xyz;
      float slope = length(a - dot(a, n) * n);
      float c = dot(a, inSlice) + lattice[axis].w;
      float fine = line(c, 1.0, slope), coarse = line(c, 5.0, slope);
      lines += lineColour(axis) * (0.06 * fine + 0.15 * coarse);
      cover = max(cover, 0.6 * fine + coarse);
    }
    float d = length(inSlice - middle) / fadeAt;
    colour.rgb *= mix(1.35, 0.35, smoothstep(0.0, 0.65, d));
    colour.rgb += lines * mix(1.0, 0.3, smoothstep(0.0, 0.8, d));
    colour.a = mix(colour.a, min(1.0, colour.a + 0.5 * cover), step(colour.a, 0.99));
    colour.a *= 1.0 - smoothstep(0.25, 1.0, d);
  }
`;
