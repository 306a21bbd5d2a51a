// The camera on its orbit: yaw, pitch and distance about a target, each eased towards where the hand last sent it, with a
// little inertia after a throw. Input only sets goals; `update` moves the camera.
import { MathUtils, PerspectiveCamera, Vector3, type Box3 } from "three";
import { placeToSee } from "./framing";

/** How fast the camera follows, 1/s: fast enough to feel held, slow enough to be smooth. */
const FOLLOW_RATE = 16;
/** And where nobody sent it, 1/s. */
const GLIDE_RATE = 1.8;
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
  private rate = FOLLOW_RATE;
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
    this.rate = FOLLOW_RATE;
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
    this.rate = FOLLOW_RATE;
    this.distanceGoal = MathUtils.clamp(this.distanceGoal * factor, NEAREST, FARTHEST);
  }

  /** Moves the target in the plane of the picture, by fractions of the picture's height. */
  pan(right: number, up: number): void {
    this.rate = FOLLOW_RATE;
    const scale = 2 * this.distance * Math.tan(MathUtils.degToRad(this.camera.fov) / 2);
    const across = new Vector3().setFromMatrixColumn(this.camera.matrix, 0).multiplyScalar(-right * scale);
    const upward = new Vector3().setFromMatrixColumn(this.camera.matrix, 1).multiplyScalar(-up * scale);
    this.targetGoal.add(across).add(upward);
  }

  /**
   * Sees a box whole from now on, in a part of the picture: its width and height as shares. From a side that is given, or, slowly,
   * from where it is.
   */
  see(box: Box3, [width, height]: readonly [number, number], from: { yaw: number; pitch: number } | null): void {
    const { yaw, pitch } = from ?? { yaw: this.yawGoal, pitch: this.pitchGoal };
    this.rate = from ? FOLLOW_RATE : GLIDE_RATE;
    const back = direction(yaw, pitch);
    const right = new Vector3(Math.cos(yaw), 0, -Math.sin(yaw));
    const half = Math.tan(MathUtils.degToRad(this.camera.fov) / 2);
    const axes = [right, back.clone().cross(right), back.clone().negate()];
    const place = placeToSee(box, axes, [half * this.camera.aspect * width, half * height]);
    const distance = place.clone().sub(box.getCenter(new Vector3())).dot(back);
    this.distanceGoal = MathUtils.clamp(distance, NEAREST, FARTHEST);
    this.targetGoal.copy(place).addScaledVector(back, -distance);
    [this.yawGoal, this.pitchGoal] = [yaw, pitch];
    this.yawSpeed = this.pitchSpeed = 0;
  }

  /** Ends a glide where it is; where a hand sends it, it still goes. */
  halt(): void {
    if (this.rate === FOLLOW_RATE) return;
    this.targetGoal.copy(this.target);
    this.distanceGoal = this.distance;
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
    const slow = Math.exp(-INERTIA_DECAY * seconds);
    const glide = (1 - slow) / INERTIA_DECAY;
    this.yawGoal += this.yawSpeed * glide;
    this.pitchGoal = MathUtils.clamp(this.pitchGoal + this.pitchSpeed * glide, LEAST_PITCH, PITCH_LIMIT);
    this.yawSpeed *= slow;
    this.pitchSpeed *= slow;
    const share = this.calm ? 1 : 1 - Math.exp(-this.rate * seconds);
    this.yaw += (this.yawGoal - this.yaw) * share;
    this.pitch += (this.pitchGoal - this.pitch) * share;
    this.distance += (this.distanceGoal - this.distance) * share;
    this.target.lerp(this.targetGoal, share);
    this.place();
  }

  private place(): void {
    const { camera, target, yaw, pitch, distance } = this;
    camera.position.copy(target).addScaledVector(direction(yaw, pitch), distance);
    camera.lookAt(target);
    camera.updateMatrixWorld();
  }
}

/** From what is looked at to the camera. */
function direction(yaw: number, pitch: number): Vector3 {
  return new Vector3(Math.cos(pitch) * Math.sin(yaw), Math.sin(pitch), Math.cos(pitch) * Math.cos(yaw));
}
