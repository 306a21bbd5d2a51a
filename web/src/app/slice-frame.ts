// The slice as a frame of the whole world: an origin and n orthonormal directions, of which the first k are drawn as the
// view's x, y, z and the others lead off the slice. Keeping all n makes a turn into w one rotation of two rows.

/** An orthonormal frame of an n-dimensional world; its first `shown` rows are the axes that the view draws. */
export interface SliceFrame {
  readonly shown: number;
  readonly origin: readonly number[];
  readonly rows: readonly (readonly number[])[];
}

/** The frame whose rows are the world's own axes. */
export function homeFrame(dimension: number, shown: number): SliceFrame {
  const rows = Array.from({ length: dimension }, (_, i) => Array.from({ length: dimension }, (_, j) => (i === j ? 1 : 0)));
  return { shown, origin: new Array<number>(dimension).fill(0), rows };
}

export function dot(a: readonly number[], b: readonly number[]): number {
  let sum = 0;
  for (let i = 0; i < a.length; i++) sum += a[i] * b[i];
  return sum;
}

/** Coordinates of a world point along all rows: the first `shown` are the place in the view, the others lead off it. */
export function toFrame(frame: SliceFrame, point: readonly number[]): number[] {
  const offset = point.map((value, i) => value - frame.origin[i]);
  return frame.rows.map((row) => dot(row, offset));
}

/** The world point at these coordinates; missing ones are zero. */
export function toWorld(frame: SliceFrame, coordinates: readonly number[]): number[] {
  const point = [...frame.origin];
  coordinates.forEach((coordinate, row) => {
    for (let i = 0; i < point.length; i++) point[i] += coordinate * frame.rows[row][i];
  });
  return point;
}

/** The frame turned by `angle` from row `i` towards row `j`, about a world point that keeps its coordinates. */
export function turned(frame: SliceFrame, i: number, j: number, angle: number, pivot: readonly number[]): SliceFrame {
  const kept = toFrame(frame, pivot);
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const rows = frame.rows.map((row) => [...row]);
  rows[i] = frame.rows[i].map((value, axis) => c * value + s * frame.rows[j][axis]);
  rows[j] = frame.rows[j].map((value, axis) => c * value - s * frame.rows[i][axis]);
  return movedTo({ ...frame, rows: orthonormal(rows) }, pivot, kept);
}

/** The frame with its origin moved so that a world point has the given coordinates. */
function movedTo(frame: SliceFrame, point: readonly number[], coordinates: readonly number[]): SliceFrame {
  const origin = [...point];
  coordinates.forEach((coordinate, row) => {
    for (let i = 0; i < origin.length; i++) origin[i] -= coordinate * frame.rows[row][i];
  });
  return { ...frame, origin };
}

/** The frame pushed along its own row `row`. */
export function shifted(frame: SliceFrame, row: number, distance: number): SliceFrame {
  return { ...frame, origin: frame.origin.map((value, i) => value + distance * frame.rows[row][i]) };
}

/** Gram–Schmidt: repairs the round-off of many small turns. */
function orthonormal(rows: number[][]): number[][] {
  rows.forEach((row, i) => {
    for (let j = 0; j < i; j++) {
      const along = dot(row, rows[j]);
      for (let axis = 0; axis < row.length; axis++) row[axis] -= along * rows[j][axis];
    }
    const length = Math.sqrt(dot(row, row));
    for (let axis = 0; axis < row.length; axis++) row[axis] /= length;
  });
  return rows;
}

/** One turn of a path between frames. */
export interface Turn {
  readonly i: number;
  readonly j: number;
  readonly angle: number;
}

/**
 * Turns that lead from the rows of `from` to the rows of `to`, by Givens elimination: applied in order with their full
 * angles they end at `to`; with all angles scaled by t they make a smooth path.
 */
export function turnsBetween(from: SliceFrame, to: SliceFrame): Turn[] {
  const n = from.rows.length;
  // m[i][j] = to_i · from_j is the rotation written in the rows of `from`; eliminating it column by column factors it.
  const m = to.rows.map((row) => from.rows.map((other) => dot(row, other)));
  const turns: Turn[] = [];
  for (let i = 0; i < n; i++) {
    for (let j = i + 1; j < n; j++) {
      const angle = Math.atan2(m[i][j], m[i][i]);
      if (Math.abs(angle) < 1e-12) continue;
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      for (let row = 0; row < n; row++) {
        const [a, b] = [m[row][i], m[row][j]];
        m[row][i] = c * a + s * b;
        m[row][j] = c * b - s * a;
      }
      turns.push({ i, j, angle });
    }
  }
  return turns;
}

/** The nearest frame whose rows are world axes (up to sign): what a 90° snap lands on. */
export function nearestQuarter(frame: SliceFrame): SliceFrame {
  const n = frame.rows.length;
  const taken = new Set<number>();
  const rows = frame.rows.map((row) => {
    let best = -1;
    for (let axis = 0; axis < n; axis++) {
      if (!taken.has(axis) && (best < 0 || Math.abs(row[axis]) > Math.abs(row[best]))) best = axis;
    }
    taken.add(best);
    return Array.from({ length: n }, (_, axis) => (axis === best ? Math.sign(row[best]) || 1 : 0));
  });
  if (determinant(rows) < 0) rows[n - 1] = rows[n - 1].map((value) => -value);
  return { ...frame, rows };
}

/** Determinant of a signed permutation, by counting swaps. */
function determinant(rows: number[][]): number {
  const place = rows.map((row) => row.findIndex((value) => value !== 0));
  let sign = rows.reduce((product, row, i) => product * row[place[i]], 1);
  for (let i = 0; i < place.length; i++) {
    for (let j = i + 1; j < place.length; j++) if (place[i] > place[j]) sign = -sign;
  }
  return sign;
}
