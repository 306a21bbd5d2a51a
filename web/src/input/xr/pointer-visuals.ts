// What one sees of the controllers: a beam that fades out, and the ring where a teleport would land.
import { BufferGeometry, Float32BufferAttribute, Group, Line, LineBasicMaterial, Mesh, MeshBasicMaterial, Plane, RingGeometry, SphereGeometry, Vector3, type Ray } from "three";
import { COOL } from "../../view/palette";

const BEAM_LENGTH = 3;
const KNOB_RADIUS = 0.018;
const FARTHEST_TELEPORT = 30;

export function makePointer(): Group {
  const beam = new BufferGeometry();
  beam.setAttribute("position", new Float32BufferAttribute([0, 0, 0, 0, 0, -BEAM_LENGTH], 3));
  beam.setAttribute("color", new Float32BufferAttribute([1, 1, 1, 0.85, 1, 1, 1, 0], 4));
  const group = new Group();
  group.add(new Line(beam, new LineBasicMaterial({ vertexColors: true, transparent: true })));
  group.add(new Mesh(new SphereGeometry(KNOB_RADIUS, 16, 12), new MeshBasicMaterial({ color: COOL })));
  return group;
}

export class Teleport {
  readonly marker = new Mesh(new RingGeometry(0.22, 0.28, 40).rotateX(-Math.PI / 2), new MeshBasicMaterial({ color: COOL, transparent: true, opacity: 0.9 }));
  private goal: Vector3 | null = null;

  constructor() {
    this.marker.visible = false;
  }

  /** Shows where the ray meets the ground of this height, to a viewer of this scale. */
  aim(ray: Ray, ground: number, scale: number): void {
    const hit = ray.intersectPlane(new Plane(new Vector3(0, 1, 0), -ground), new Vector3());
    this.goal = hit && hit.distanceTo(ray.origin) < FARTHEST_TELEPORT * scale ? hit : null;
    this.marker.visible = this.goal !== null;
    this.marker.scale.setScalar(scale);
    if (this.goal) this.marker.position.copy(this.goal).setY(ground + 0.01);
  }

  /** Where it was aimed last, once. */
  take(): Vector3 | null {
    const { goal } = this;
    this.goal = null;
    this.marker.visible = false;
    return goal;
  }
}
