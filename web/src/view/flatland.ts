// Flatland (after Abbott, 1884): a world of three dimensions, the plane that cuts it drawn as a sheet of glass, and beside
// it what beings in that plane see. The cut is made by the graphics card: seen straight onto the plane, with nothing in
// front of it drawn, a point lies inside a body exactly where the first surface behind the plane faces away.
import { BackSide, Color, DoubleSide, EdgesGeometry, EqualDepth, Group, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshBasicMaterial, OrthographicCamera, PlaneGeometry, Ray, Scene, ShaderMaterial, Vector3, Vector4 } from "three";
import { homeFrame, type SliceFrame } from "../app/slice-frame";
import type { Frame } from "../engine/protocol";
import { COOL } from "./palette";
import type { Picked } from "./pick";
import type { Stage } from "./stage";

/** Half the height of the cut that is shown, in extents of the scene. */
const HALF_HEIGHT_EXTENTS = 0.85;
const DEPTH = 400;
const MOST_PLANES = 8;
/** From where rays onto the plane start, m above it. */
const ABOVE = 100;

/** The same for both passes: their depths are compared to the last bit. */
const CUT_VERTEX = /* glsl */ `
  attribute vec3 color; varying vec3 tint; invariant gl_Position;
  void main() { tint = color; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`;

/** Where on the canvas the cut is drawn, in CSS pixels from the top left. */
export interface Inset {
  left: number;
  top: number;
  width: number;
  height: number;
}

export class FlatlandView {
  readonly wholeWorld: SliceFrame = homeFrame(3, 3);
  inset: Inset = { left: 0, top: 0, width: 1, height: 1 };
  private readonly camera = new OrthographicCamera(-1, 1, 1, -1, 0, DEPTH);
  private readonly scene = new Scene();
  private readonly sheet = new Group();
  private readonly ground: Mesh<PlaneGeometry, ShaderMaterial>;

  constructor(private readonly stage: Stage) {
    const passes = [depthMaterial(), cutMaterial()].map((material) => new Mesh(stage.surfaces.mesh.geometry, material));
    passes.forEach((pass, order) => Object.assign(pass, { frustumCulled: false, renderOrder: order }));
    this.ground = new Mesh(new PlaneGeometry(2, 2), groundMaterial());
    this.ground.frustumCulled = false;
    this.ground.renderOrder = -1;
    this.scene.background = new Color("#0d1326");
    this.scene.add(...passes, this.ground, stage.joints.flat);
    this.makeSheet();
  }

  private makeSheet(): void {
    const square = new PlaneGeometry(2, 2);
    const glass = new MeshBasicMaterial({ color: COOL, transparent: true, opacity: 0.12, side: DoubleSide, depthWrite: false });
    const rim = new LineBasicMaterial({ color: COOL, transparent: true, opacity: 0.9 });
    this.sheet.add(new Mesh(square, glass), new LineSegments(new EdgesGeometry(square), rim));
    this.sheet.visible = false;
    this.sheet.renderOrder = 4;
    this.stage.scene.add(this.sheet);
  }

  setVisible(on: boolean): void {
    this.sheet.visible = on;
    this.stage.makeRoom(on);
    // The cut shows insides: cells have no place there.
    this.stage.surfaces.plain = on;
  }

  show(frame: Frame): void {
    if (!this.sheet.visible) return;
    const planes = this.ground.material.uniforms.planes.value as Vector4[];
    const count = Math.min(MOST_PLANES, frame.halfSpaces.length / 5);
    for (let i = 0; i < count; i++) planes[i].fromArray(frame.halfSpaces, 5 * i + 1);
    this.ground.material.uniforms.planeCount.value = count;
  }

  /** The ray through a place on the page, if that lies in the inset: from far above the plane straight onto it. */
  rayAt(x: number, y: number): Ray | null {
    const { left, top, width, height } = this.inset;
    if (!this.sheet.visible || x < left || y < top || x > left + width || y > top + height) return null;
    const inPicture = new Vector3((2 * (x - left)) / width - 1, 1 - (2 * (y - top)) / height, -1);
    const onPlane = inPicture.unproject(this.camera);
    const normal = this.normal;
    return new Ray(onPlane.addScaledVector(normal, ABOVE), normal.clone().negate());
  }

  /** The body that the plane cuts where the ray meets it. */
  pick(ray: Ray): Picked | null {
    const onPlane = ray.at(ABOVE, new Vector3());
    const first = this.stage.pick(new Ray(onPlane, ray.direction));
    return first?.fromWithin ? { ...first, point: onPlane } : null;
  }

  /** The plane's normal in the whole world. */
  get normal(): Vector3 {
    return new Vector3(0, 0, 1).applyQuaternion(this.camera.quaternion);
  }

  /** Extents of all bodies along the plane's normal, measured from the plane, as `Frame.strip` has them. */
  extents({ surface }: Frame, slice: SliceFrame): Float32Array {
    const { positions, ranges } = surface;
    const [nx, ny, nz] = slice.rows[2];
    const start = slice.origin[0] * nx + slice.origin[1] * ny + slice.origin[2] * nz;
    const extents = new Float32Array(ranges.length);
    for (let range = 0; range < ranges.length; range += 3) {
      let [low, high] = [Infinity, -Infinity];
      const end = 3 * (ranges[range + 1] + ranges[range + 2]);
      for (let at = 3 * ranges[range + 1]; at < end; at += 3) {
        const off = positions[at] * nx + positions[at + 1] * ny + positions[at + 2] * nz - start;
        low = Math.min(low, off);
        high = Math.max(high, off);
      }
      extents.set([ranges[range], low, high], range);
    }
    return extents;
  }

  /** Puts the sheet into the world, and draws the cut by the plane of `slice` (two rows drawn, the third its normal) into the inset, where there is one: a headset has no corner to put it. */
  render(slice: SliceFrame, inset: boolean): void {
    const { renderer } = this.stage;
    const half = HALF_HEIGHT_EXTENTS * this.stage.sceneExtent;
    const aspect = this.inset.width / Math.max(1, this.inset.height);
    this.place(slice, half, aspect);
    if (!inset) return;
    const height = renderer.domElement.clientHeight;
    const { left, top, width, height: insetHeight } = this.inset;
    renderer.setScissorTest(true);
    renderer.setScissor(left, height - top - insetHeight, width, insetHeight);
    renderer.setViewport(left, height - top - insetHeight, width, insetHeight);
    renderer.render(this.scene, this.camera);
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, renderer.domElement.clientWidth, height);
  }

  private place(slice: SliceFrame, half: number, aspect: number): void {
    const [x, y, z] = slice.rows.map((row) => new Vector3(row[0], row[1], row[2]));
    const origin = new Vector3(...(slice.origin as [number, number, number]));
    const middle = this.stage.sceneMiddle.clone();
    // The middle of the scene, dropped onto the plane.
    middle.addScaledVector(z, -middle.clone().sub(origin).dot(z));
    const basis = new Matrix4().makeBasis(x, y, z);
    this.sheet.quaternion.setFromRotationMatrix(basis);
    this.sheet.position.copy(middle);
    this.sheet.scale.set(half * aspect, half, 1);
    [this.camera.left, this.camera.right, this.camera.top, this.camera.bottom] = [-half * aspect, half * aspect, half, -half];
    this.camera.updateProjectionMatrix();
    this.camera.quaternion.copy(this.sheet.quaternion);
    this.camera.position.copy(middle);
    this.camera.updateMatrixWorld();
    this.stage.joints.setPlane(z, middle);
    const { uniforms } = this.ground.material;
    (uniforms.inWorld.value as Matrix4).multiplyMatrices(this.camera.matrixWorld, this.camera.projectionMatrixInverse);
  }
}

/** Of all surfaces the nearest behind the plane is found first, in whatever order they are drawn. */
function depthMaterial(): ShaderMaterial {
  return new ShaderMaterial({ vertexShader: CUT_VERTEX, fragmentShader: "void main() {}", side: DoubleSide, colorWrite: false });
}

/**
 * Where that one faces away, the plane is within its body; where it faces us, the plane is outside, and what lies behind is
 * not seen by those who live there. Faces are told by the way around their triangles: normals of round bodies are smooth.
 */
function cutMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: CUT_VERTEX,
    fragmentShader: /* glsl */ `
      varying vec3 tint;
      void main() {
        gl_FragColor = vec4(tint, 1.0);
        #include <colorspace_fragment>
      }`,
    side: BackSide,
    depthFunc: EqualDepth,
    depthWrite: false,
  });
}

/** The half-spaces, cut exactly, and the lattice of the plane. */
function groundMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: {
      planes: { value: Array.from({ length: MOST_PLANES }, () => new Vector4()) },
      planeCount: { value: 0 },
      inWorld: { value: new Matrix4() },
    },
    vertexShader: /* glsl */ `
      uniform mat4 inWorld; varying vec3 place;
      void main() { place = (inWorld * vec4(position.xy, -1.0, 1.0)).xyz; gl_Position = vec4(position.xy, 0.999, 1.0); }`,
    fragmentShader: /* glsl */ `
      uniform vec4 planes[${MOST_PLANES}]; uniform int planeCount; varying vec3 place;
      void main() {
        float outside = 1e9;
        for (int i = 0; i < ${MOST_PLANES}; i++) { if (i < planeCount) outside = min(outside, dot(planes[i].xyz, place) - planes[i].w); }
        float pixel = max(fwidth(outside), 1e-6);
        vec3 colour = mix(vec3(0.10, 0.13, 0.22), vec3(0.012, 0.018, 0.04), smoothstep(-pixel, pixel, outside));
        colour += vec3(0.35, 0.45, 0.75) * (1.0 - smoothstep(pixel, 2.0 * pixel, abs(outside)));
        gl_FragColor = vec4(colour, 1.0);
        #include <colorspace_fragment>
      }`,
    depthWrite: false,
    depthTest: false,
  });
}
