// The camera on its orbit: yaw, pitch and distance about a target, each eased towards where the hand last sent it, with a
// little inertia after a throw. Input only sets goals; `update` moves the camera.
import { MathUtils, PerspectiveCamera, Vector3 } from "three";

/** How fast the camera follows, 1/s: fast enough to feel held, slow enough to be smooth. */
const FOLLOW_RATE = 16;
/** How fast a thrown orbit comes to rest, 1/s. */
const INERTIA_DECAY = 4.5;
const PITCH_LIMIT = 1.45;
const LEAST_PITCH = -0.35;
const NEAREST = 0.6;
const FARTHEST = 160;

export class OrbitCamera {
  readonly camera = new PerspectiveCamera(38, 1, 0.05, 2000);
  /** Calm for those who ask for reduced motion: no easing, no inertia. */
  calm = false;
  readonly target = new Vector3();
  private readonly targetGoal = new Vector3();
  private yaw = 0.6;
  private pitch = 0.35;
  private distance = 12;
  private yawGoal = this.yaw;
  private pitchGoal = this.pitch;
  private distanceGoal = this.distance;
  private yawSpeed = 0;
  private pitchSpeed = 0;

  /** Radians by which the hand turned the view. */
  orbit(yaw: number, pitch: number): void {
    this.yawGoal += yaw;
    this.pitchGoal = MathUtils.clamp(this.pitchGoal + pitch, LEAST_PITCH, PITCH_LIMIT);
    this.yawSpeed = this.pitchSpeed = 0;
  }

  /** Lets the orbit go on with this speed, rad/s. */
  throw(yaw: number, pitch: number): void {
    if (this.calm) return;
    this.yawSpeed = yaw;
    this.pitchSpeed = pitch;
  }

  zoom(factor: number): void {
    this.distanceGoal = MathUtils.clamp(this.distanceGoal * factor, NEAREST, FARTHEST);
  }

  /** Moves the target in the plane of the picture, by fractions of the picture's height. */
  pan(right: number, up: number): void {
    const scale = 2 * this.distance * Math.tan(MathUtils.degToRad(this.camera.fov) / 2);
    const across = new Vector3().setFromMatrixColumn(this.camera.matrix, 0).multiplyScalar(-right * scale);
    const upward = new Vector3().setFromMatrixColumn(this.camera.matrix, 1).multiplyScalar(-up * scale);
    this.targetGoal.add(across).add(upward);
  }

  /** Looks at this from now on. */
  lookAt(target: Vector3, distance?: number, at?: { yaw: number; pitch: number }): void {
    this.targetGoal.copy(target);
    if (distance !== undefined) this.distanceGoal = MathUtils.clamp(distance, NEAREST, FARTHEST);
    if (at) [this.yawGoal, this.pitchGoal] = [at.yaw, at.pitch];
    this.yawSpeed = this.pitchSpeed = 0;
  }

  /** Is where it was sent, at once: for a new scene. */
  jump(): void {
    this.yaw = this.yawGoal;
    this.pitch = this.pitchGoal;
    this.distance = this.distanceGoal;
    this.target.copy(this.targetGoal);
    this.place();
  }

  update(seconds: number): void {
    this.yawGoal += this.yawSpeed * seconds;
    this.pitchGoal = MathUtils.clamp(this.pitchGoal + this.pitchSpeed * seconds, LEAST_PITCH, PITCH_LIMIT);
    const slow = Math.exp(-INERTIA_DECAY * seconds);
    this.yawSpeed *= slow;
    this.pitchSpeed *= slow;
    const share = this.calm ? 1 : 1 - Math.exp(-FOLLOW_RATE * seconds);
    this.yaw += (this.yawGoal - this.yaw) * share;
    this.pitch += (this.pitchGoal - this.pitch) * share;
    this.distance += (this.distanceGoal - this.distance) * share;
    this.target.lerp(this.targetGoal, share);
    this.place();
  }

  private place(): void {
    const { camera, target, yaw, pitch, distance } = this;
    camera.position.set(
      target.x + distance * Math.cos(pitch) * Math.sin(yaw),
      target.y + distance * Math.sin(pitch),
      target.z + distance * Math.cos(pitch) * Math.cos(yaw),
    );
    camera.lookAt(target);
    camera.updateMatrixWorld();
  }
}
