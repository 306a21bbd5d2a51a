/**
 * What the page and the worker say to each other.
 *
 * The worker owns the world: it steps it in real time, cuts every body with the slice, keeps the last seconds, and sends
 * frames. The page draws the latest frame and turns input into the messages below; it holds no physics and cuts nothing.
 *
 * Units are metres, kilograms, seconds and radians. A `Vector` has one number per axis of the world, in the order
 * x y z w v u. A *slice point* has k numbers, in the axes of the slice. Rotations are n rows of n numbers and take body
 * axes to world axes. Bodies are named by a whole number, stable for the life of a scene: undo brings a removed body
 * back under its old number.
 */

/** One number per axis of the world. */
export type Vector = number[];

/** A number per plane, by names such as "xw", in lexicographic order of the axes. */
export type Planes = Record<string, number>;

/** The flat that is drawn. Whatever is not in it lies along the remaining n − k directions, the *off directions*. */
export interface Slice {
  /** A point of the world that is drawn at (0, 0, 0). */
  origin: Vector;
  /**
   * k orthonormal directions of the world, drawn as x, y and z: three, or two for worlds of two dimensions and for the
   * Flatland view of worlds of three. The worker orthonormalises what rounding left.
   */
  axes: Vector[];
  /**
   * The n − k off directions. May be left out: the worker then completes the frame, right-handed where n − k = 1 (at
   * home: +w), and otherwise as near to its previous off directions as it can, so that slow turns stay smooth.
   */
  off?: Vector[];
}

/** One of the scenes that are built in. */
export interface BuiltIn {
  /** What `loadBuiltin` calls it, such as "pit4d". */
  name: string;
  /** For people, in English. */
  title: string;
  /** Number of axes of its world, 2 to 6. */
  dimension: number;
  /** The sort of scene it is: "stacks", "piles", … */
  group: string;
  /** One sentence that says what to see, in English; may be empty. */
  sentence: string;
  /** Number of its bodies at the start. */
  bodies: number;
}

export type BodyKind = "dynamic" | "static" | "kinematic";

/** A body, as far as it stays the same. */
export interface BodyDescription {
  /** What messages and frames call it. */
  id: number;
  name: string;
  kind: BodyKind;
  /** The key of its shape in the scene format: "box", "ball", "half_space", "polytope", … */
  shape: string;
  /** The n-volume of half-spaces is not drawn from triangles: see `Frame.halfSpaces`. */
  endless: boolean;
  /** Which colour of the palette it has: counts bodies that are not endless, from 0. */
  colourIndex: number;
  /** Colour that the scene gives it, red, green, blue in 0..1; null: by `colourIndex`. */
  colour: [number, number, number] | null;
  /** Kilograms; 0 for bodies that nothing moves. */
  mass: number;
  /** All of it lies within this distance of its centre of mass, m; 0 for endless ones. */
  radius: number;
}

/** What a load answers, and what a change of the list of bodies announces. */
export interface SceneDescription {
  /** Name of the built-in scene, or null for a scene from text. */
  builtin: string | null;
  /** The scene's own name, for people. */
  title: string;
  dimension: number;
  /** What to see, in English; may be empty. */
  sentence: string;
  gravity: Vector;
  /** Length of a step, s. */
  dt: number;
  bodies: BodyDescription[];
  /** Where a view does well to begin: the middle and the radius of what can move (of all, if nothing can). */
  middle: Vector;
  extent: number;
}

/** Refused: what is wrong, in one English line with the remedy. */
export interface Refusal {
  message: string;
  /** What it is about, where the page has words of its own for it: "past", "frozen", … */
  code?: string;
  /** Of the scene's text, from 1, where it is known. */
  line?: number;
  column?: number;
}

/** What a ray of the slice met. */
export interface Hit {
  body: number;
  /** Where, in the world. */
  point: Vector;
  /** Along the ray, in lengths of its direction. */
  distance: number;
}

/** Messages that are answered: what each takes, and what it answers. Any of them may be refused. */
export interface Requests {
  /** Replaces the scene. A text that is no scene is refused, with its line, and the running scene goes on. */
  load: { takes: { text: string }; answers: SceneDescription };
  loadBuiltin: { takes: { name: string }; answers: SceneDescription };
  /** The scene as it was loaded. */
  reset: { takes: object; answers: SceneDescription };
  /** Takes back the last change of the list of bodies, or the last push, turn or freeze: the world as it was before. */
  undo: { takes: object; answers: { undone: string | null } };
  /** What a ray in the slice meets first; nothing is touched. `origin` and `direction` are slice points. */
  pick: { takes: { origin: number[]; direction: number[] }; answers: Hit | null };
  /**
   * Takes hold of a body with a spring, at a point of the world or where a ray of the slice meets it. Answers null where
   * nothing is; a body that nothing moves is refused. A hand that holds something lets go of it first.
   */
  grab: {
    takes: { hand: number } & ({ body: number; point: Vector } | { origin: number[]; direction: number[] });
    answers: Hit | null;
  };
  /** Adds a body; `shape` as in the scene format: `{ "ball": { "radius": 0.5 } }`. It answers its number. */
  spawn: {
    takes: { shape: object; position: Vector; velocity?: Vector; name?: string; kind?: BodyKind };
    answers: { body: number };
  };
  remove: { takes: { body: number }; answers: object };
  /** Makes a body immovable where it is, or lets it move again. */
  freeze: { takes: { body: number; on: boolean }; answers: object };
  /** Turns a body about its centre by an angle in a plane of the world, such as "xw"; or of two directions. */
  turn: { takes: { body: number; plane: string | [Vector, Vector]; angle: number }; answers: object };
  /** The current slice, as a file: bodies that end. */
  export: { takes: { format: "stl" | "glb" }; answers: { bytes: Uint8Array<ArrayBuffer> } };
  /** The running scene as scene JSON, for editing, sharing and saving. */
  sceneText: { takes: object; answers: { text: string } };
  /** The state hash of the world, hexadecimal, as `hyperbody run --json` gives it. */
  hash: { takes: object; answers: { hash: string; step: number } };
}

/** Messages that are not answered. Those that name something that is not there do nothing. */
export interface Commands {
  slice: Slice;
  /** Whether frames hold ghosts, and of bodies up to what distance from the slice, m. */
  ghosts: { on: boolean; reach: number };
  /** Whether frames hold wireframes. */
  wires: { on: boolean };
  pause: { on: boolean };
  /** One step; pauses. */
  step: object;
  /** 1: real time; 0.25: slow motion. 0.01 to 4. */
  speed: { factor: number };
  /** Shows an earlier moment, paused. 0 is now. Up to `Frame.history.seconds`. */
  scrub: { secondsBack: number };
  /** Goes on from the moment that scrubbing shows; what came after is forgotten. */
  resumeHere: object;
  gravity: { vector: Vector };
  /**
   * Where a hand is. With `rotation`, the body turns as the hand has turned since the grab: n×n rows, the hand's own
   * attitude in the world, of which only the change counts. `planes` is for hands that have no attitude, and adds a turn:
   * angles by names of world planes.
   */
  moveHand: { hand: number; point: Vector; rotation?: number[][]; planes?: Planes };
  /** Lets go; the body keeps the motion that it has, which throws it. */
  release: { hand: number };
  /** The body that `Frame.selected` tells of. */
  select: { body: number | null };
  /** Nobody looks: no steps and no frames until somebody does. Apart from `pause`, which is the person's. */
  rest: { on: boolean };
  /** Gives the buffers of a frame back, for the worker to fill again. `EngineClient` does this by itself. */
  recycle: { buffers: ArrayBuffer[] };
}

/**
 * Triangles of all sections, three corners each, none shared. `ranges` has [body, first vertex, number of vertices] for
 * every body that is cut, ascending by body. Coordinates are slice points with a third number 0 where k = 2.
 */
export interface Surface {
  /** xyz for each vertex. */
  positions: Float32Array<ArrayBuffer>;
  /** xyz for each vertex, unit length: flat on polytopes, smooth on curved parts; (0, 0, 1) where k = 2. */
  normals: Float32Array<ArrayBuffer>;
  /** For each vertex the cell (facet) of the body that its triangle was cut from, numbered within the body. */
  cells: Uint16Array<ArrayBuffer>;
  ranges: Uint32Array<ArrayBuffer>;
}

/** Line segments, two vertices each, in slice points. `ranges` as in `Surface`. */
export interface Lines {
  positions: Float32Array<ArrayBuffer>;
  ranges: Uint32Array<ArrayBuffer>;
}

/**
 * Bodies that the slice misses, but not by more than `reach`: the section through the body's own middle, parallel to the
 * slice and drawn straight below or above it, so that one sees what would come if the slice moved there.
 */
export interface Ghosts {
  positions: Float32Array<ArrayBuffer>;
  normals: Float32Array<ArrayBuffer>;
  ranges: Uint32Array<ArrayBuffer>;
  /**
   * For each range the signed distance of the body's nearest point from the slice, m: positive on the side of the first
   * off direction. Never 0.
   */
  distances: Float32Array<ArrayBuffer>;
}

/** Whole bodies as wireframes, projected straight into the slice. */
export interface Wires extends Lines {
  /** For each vertex how far off the slice it is, signed by the first off direction, m. */
  off: Float32Array<ArrayBuffer>;
}

/** Joints that tie places together, four numbers a point: the slice point, and how far off the slice it is, signed as in `Wires`, m. */
export interface Joints {
  /** Two points each: from an anchor to the body that it belongs to, where that lies apart, or from anchor to anchor. */
  rods: Float32Array<ArrayBuffer>;
  /** A point for each anchor; one where the two of a joint coincide. */
  marks: Float32Array<ArrayBuffer>;
}

/** What panels tell of the selected body. */
export interface Selected {
  body: number;
  name: string;
  kind: BodyKind;
  mass: number;
  /** Of the centre of mass. */
  position: Vector;
  velocity: Vector;
  rotation: number[][];
  /** The rotor of `rotation`: 2^(n−1) numbers in the order scalar, planes, 4-vectors, … */
  rotor: number[];
  angularVelocity: Planes;
  angularMomentum: Planes;
  /** Moments of inertia of the principal planes would be sums of pairs of these: kg·m², one per principal axis. */
  principalMoments: number[];
  momentum: Vector;
  /** Of this body, J; potential against gravity from the origin. */
  energy: { kinetic: number; potential: number; total: number };
  sleeping: boolean;
  frozen: boolean;
}

/** A contact that stopped something in the steps of this frame. */
export interface Impact {
  body: number;
  other: number;
  /** N·s. */
  impulse: number;
  /** In the world. */
  point: Vector;
  /** Hands that hold one of the two: what their pulse is for. */
  hands: number[];
}

/** A hand that holds a body. */
export interface Held {
  hand: number;
  body: number;
  /** Where the grabbed point of the body is now, and where the hand wants it, in the world. */
  point: Vector;
  target: Vector;
}

/** One picture of the world. Its arrays are valid until the next frame arrives at the client. */
export interface Frame {
  /** Counts frames since the worker began. */
  number: number;
  /** Simulated seconds and steps since the scene's start. */
  time: number;
  step: number;
  paused: boolean;
  /** Simulated over wanted time, 1 = as fast as wanted, less when the machine is too slow; mean over a second. */
  slowdown: number;
  /** Milliseconds of this frame: steps, and all that the slice takes. */
  workerMs: { physics: number; slicing: number };
  /** The slice that this frame was cut with, with its off directions. */
  slice: Required<Slice>;
  surface: Surface;
  /** Crisp edges of the sections. */
  edges: Lines;
  /** null unless asked for. */
  ghosts: Ghosts | null;
  wires: Wires | null;
  joints: Joints;
  /**
   * Sections of half-spaces, five numbers each: [body, nx, ny, nz, offset], solid where n·p ≤ offset, n a unit vector in
   * slice points. Those that the slice lies wholly inside or outside of are left out.
   */
  halfSpaces: Float32Array<ArrayBuffer>;
  /**
   * How far bodies reach along the off directions, measured from the slice: [body, then lowest and highest for each off
   * direction] for every body that ends.
   */
  strip: Float32Array<ArrayBuffer>;
  /** [body, x, y, z, off…] of the centre of mass of every body that ends: slice point (z = 0 where k = 2) and n − k off coordinates. */
  centres: Float32Array<ArrayBuffer>;
  selected: Selected | null;
  impacts: Impact[];
  hands: Held[];
  /** Bodies that sleep. */
  asleep: Uint32Array<ArrayBuffer>;
  /** Bodies that were stopped because their state turned non-finite. */
  quarantined: number[];
  /** How far one can scrub back, how far back this frame is, s; and what `undo` would take back. */
  history: { seconds: number; secondsBack: number; undo: string | null };
  energy: { kinetic: number; potential: number; total: number };
}

/** Numbers of a slice point in arrays, also where k = 2. */
export const DRAWN = 3;

/** Numbers of a body in `Frame.centres`. */
export const centreStride = (slice: Required<Slice>): number => 1 + DRAWN + slice.off.length;

/** Page → worker: the name in `type`, the number of the request in `id`, and what it takes. */
export type ToWorker =
  | { [K in keyof Requests]: { type: K; id: number } & Requests[K]["takes"] }[keyof Requests]
  | { [K in keyof Commands]: { type: K } & Commands[K] }[keyof Commands];

/** Worker → page. */
export type FromWorker =
  /** The world is up; a scene has to be loaded. */
  | { type: "ready"; version: string; builtins: BuiltIn[] }
  /** Before `ready`: wasm cannot run here, and what is missing. After it: the engine has stopped by an error of its own. */
  | { type: "failed"; message: string }
  /** The list of bodies is new: after loads, spawns, removals and undo. Comes before the first frame with it. */
  | { type: "scene"; scene: SceneDescription; loaded: boolean }
  | { type: "frame"; frame: Frame }
  | { type: "answer"; id: number; answer: unknown }
  | { type: "refused"; id: number; refusal: Refusal };
