//! Closed forms: balls and capsules against each other, balls against boxes.

use hyperbody_geometry::{Core, Polytope};
use hyperbody_math::{Pose, Vector};

/// Closest points of two cores and the direction between them, in any one frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Witness<const N: usize> {
    /// Unit, from a to b.
    pub(crate) normal: Vector<N>,
    pub(crate) on_a: Vector<N>,
    pub(crate) on_b: Vector<N>,
    /// Along the normal; negative if the cores overlap.
    pub(crate) separation: f64,
}

impl<const N: usize> Witness<N> {
    /// The same in the target frame.
    pub(crate) fn transformed(&self, target_from_here: &Pose<N>) -> Self {
        Self {
            normal: target_from_here.rotation.rotate(self.normal),
            on_a: target_from_here.transform_point(self.on_a),
            on_b: target_from_here.transform_point(self.on_b),
            separation: self.separation,
        }
    }

    /// The same with a and b exchanged.
    pub(crate) fn flipped(&self) -> Self {
        Self { normal: -self.normal, on_a: self.on_b, on_b: self.on_a, separation: self.separation }
    }
}

/// A direction to use where geometry leaves it open: `wish` if it is one, or else the first axis.
fn any_direction<const N: usize>(wish: Vector<N>) -> Vector<N> {
    wish.try_normalize().unwrap_or_else(|| Vector::unit(0))
}

/// Two points. `wish` is the direction for coincident ones.
pub(crate) fn points<const N: usize>(on_a: Vector<N>, on_b: Vector<N>, wish: Vector<N>) -> Witness<N> {
    let offset = on_b - on_a;
    match offset.try_normalize() {
        Some(normal) => Witness { normal, on_a, on_b, separation: offset.dot(normal) },
        None => Witness { normal: any_direction(wish), on_a, on_b, separation: 0.0 },
    }
}

/// The box |x_i| ≤ h_i (a) and a point (b), in the frame of the box: the clamped point, or from inside the facet of
/// least depth.
fn box_and_point<const N: usize>(half_extents: &Vector<N>, point: Vector<N>) -> Witness<N> {
    let clamped = point.min(*half_extents).max(-*half_extents);
    if let Some(normal) = (point - clamped).try_normalize() {
        return Witness { normal, on_a: clamped, on_b: point, separation: (point - clamped).dot(normal) };
    }
    let mut along = 0;
    for axis in 1..N {
        if half_extents[axis] - point[axis].abs() < half_extents[along] - point[along].abs() {
            along = axis;
        }
    }
    let sign = if point[along] < 0.0 { -1.0 } else { 1.0 };
    let mut on_a = point;
    on_a[along] = sign * half_extents[along];
    let separation = point[along].abs() - half_extents[along];
    Witness { normal: Vector::unit(along) * sign, on_a, on_b: point, separation }
}

/// A core (a) and a point (b), in the frame of the core, where there is a closed form: `None` for a point outside a
/// polytope.
pub(crate) fn nearest_known<const N: usize>(core: &Core<N>, point: Vector<N>) -> Option<Witness<N>> {
    match core {
        Core::Box { half_extents } => Some(box_and_point(half_extents, point)),
        Core::Polytope(polytope) => point_in_polytope(polytope, point),
        Core::Point | Core::Segment { .. } => None,
    }
}

/// A polytope (a) and a point (b) inside it, in the frame of the polytope: the facet of least depth. `None` if the
/// point is outside by more than `tolerance`.
fn point_in_polytope<const N: usize>(polytope: &Polytope<N>, point: Vector<N>) -> Option<Witness<N>> {
    let mut best: Option<(Vector<N>, f64)> = None;
    for facet in polytope.facets() {
        let separation = facet.normal.dot(point) - facet.offset;
        if best.is_none_or(|(_, most)| separation > most) {
            best = Some((facet.normal, separation));
        }
    }
    let (normal, separation) = best?;
    (separation <= 0.0).then(|| Witness { normal, on_a: point - normal * separation, on_b: point, separation })
}

/// A segment by its middle and half its extent; a point has none.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment<const N: usize> {
    pub(crate) middle: Vector<N>,
    pub(crate) half: Vector<N>,
}

impl<const N: usize> Segment<N> {
    fn at(&self, parameter: f64) -> Vector<N> {
        self.middle + self.half * parameter
    }

    /// The parameter in [−1, 1] of the point closest to `point`.
    fn closest(&self, point: Vector<N>) -> f64 {
        let length_sq = self.half.norm_sq();
        if length_sq > 0.0 { ((point - self.middle).dot(self.half) / length_sq).clamp(-1.0, 1.0) } else { 0.0 }
    }
}

/// Two segments: closest points by the quadratic in both parameters, clamped (Ericson 2005, §5.1.9). `wish` is the
/// direction where segments cross.
pub(crate) fn segments<const N: usize>(a: &Segment<N>, b: &Segment<N>, wish: Vector<N>) -> Witness<N> {
    let (aa, bb, ab) = (a.half.norm_sq(), b.half.norm_sq(), a.half.dot(b.half));
    let offset = b.middle - a.middle;
    let determinant = aa * bb - ab * ab;
    let mut s = 0.0;
    if determinant > crate::limits::PARALLEL_SQ * aa * bb {
        s = ((bb * offset.dot(a.half) - ab * offset.dot(b.half)) / determinant).clamp(-1.0, 1.0);
    }
    let mut t = b.closest(a.at(s));
    s = a.closest(b.at(t));
    // A second turn removes what is left of rounding in the determinant.
    t = b.closest(a.at(s));
    let mut witness = points(a.at(s), b.at(t), wish);
    let size = aa.sqrt() + bb.sqrt();
    if determinant <= crate::limits::PARALLEL_SQ * aa * bb {
        // All but parallel segments may still be closest at an end.
        for end in [-1.0, 1.0] {
            for (on_a, on_b) in [(a.at(end), b.at(b.closest(a.at(end)))), (a.at(a.closest(b.at(end))), b.at(end))] {
                let at_end = points(on_a, on_b, wish);
                if at_end.separation < witness.separation - CROSSING * size {
                    witness = at_end;
                }
            }
        }
    }
    if witness.separation > CROSSING * size || size == 0.0 { witness } else { crossing(a, b, &witness, wish) }
}

/// Distance of two segments, in parts of their length, below which they cross and the direction between the closest
/// points is noise.
const CROSSING: f64 = 1e-10;

/// Segments that cross: separated along the perpendicular of both with the least overlap. From three dimensions on
/// there is one along which they do not overlap at all.
fn crossing<const N: usize>(a: &Segment<N>, b: &Segment<N>, witness: &Witness<N>, wish: Vector<N>) -> Witness<N> {
    let mut best: Option<(Vector<N>, f64)> = None;
    let mut consider = |direction: Vector<N>| {
        let along = (b.middle - a.middle).dot(direction);
        let normal = if along < 0.0 || (along == 0.0 && wish.dot(direction) < 0.0) { -direction } else { direction };
        let separation = along.abs() - a.half.dot(normal).abs() - b.half.dot(normal).abs();
        if best.is_none_or(|(_, most)| separation > most) {
            best = Some((normal, separation));
        }
    };
    let (first, second) = (a.half.normalize_or_zero(), b.half.normalize_or_zero());
    // What is left of parallel segments is rounding, and no direction.
    let across = |v: Vector<N>, along: Vector<N>| {
        let rest = v - along * along.dot(v);
        if rest.norm_sq() > crate::limits::PARALLEL_SQ { rest.normalize_or_zero() } else { Vector::ZERO }
    };
    let (second_part, first_part) = (across(second, first), across(first, second));
    // Perpendicular to one segment inside their common plane, for the plane; perpendicular to both beyond it.
    for direction in [second_part, first_part] {
        if direction != Vector::ZERO {
            consider(direction);
        }
    }
    // Of segments so parallel that they span no plane, each has perpendiculars of its own.
    let bases = if second_part == Vector::ZERO { [first, second] } else { [first; 2] };
    for axis in 0..=N {
        let trial = if axis == N { wish } else { Vector::unit(axis) };
        for base in bases {
            let in_one = trial - base * base.dot(trial);
            let rest = in_one - second_part * second_part.dot(in_one);
            if rest.norm() > 1e-3 {
                consider(rest.normalize_or_zero());
            }
        }
    }
    let Some((normal, separation)) = best else { return *witness };
    let (reach_a, reach_b) = (a.half.dot(normal), b.half.dot(normal));
    // Along the perpendicular of one, the end of the other is deepest; beyond their plane it is the crossing itself.
    let rounding = CROSSING * (a.half.norm() + b.half.norm());
    let (on_a, on_b) = if reach_a.abs() > reach_b.abs() + rounding {
        let on_a = a.at(reach_a.signum());
        (on_a, b.at(b.closest(on_a)))
    } else if reach_b.abs() > reach_a.abs() + rounding {
        let on_b = b.at(-reach_b.signum());
        (a.at(a.closest(on_b)), on_b)
    } else {
        (witness.on_a, witness.on_b)
    };
    Witness { normal, on_a, on_b, separation }
}

/// The parameters on segment a between which the two segments run side by side, or `None` unless they are parallel to
/// within about ten degrees and do so over some length.
pub(crate) fn side_by_side<const N: usize>(a: &Segment<N>, b: &Segment<N>) -> Option<[f64; 2]> {
    let (aa, bb, ab) = (a.half.norm_sq(), b.half.norm_sq(), a.half.dot(b.half));
    if !(aa * bb > 0.0 && aa * bb - ab * ab <= 0.03 * aa * bb) {
        return None;
    }
    let middle = (b.middle - a.middle).dot(a.half) / aa;
    let reach = ab.abs() / aa;
    let (low, high) = ((middle - reach).max(-1.0), (middle + reach).min(1.0));
    (high - low > 1e-6).then_some([low, high])
}

/// The two contact positions of near-parallel segments: for each end of the common stretch the point on a and the
/// point on b straight across, in the order of a's parameter.
pub(crate) fn ends<const N: usize>(a: &Segment<N>, b: &Segment<N>, stretch: [f64; 2]) -> [(Vector<N>, Vector<N>); 2] {
    stretch.map(|parameter| {
        let on_a = a.at(parameter);
        (on_a, b.at(b.closest(on_a)))
    })
}
