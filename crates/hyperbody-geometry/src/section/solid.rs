//! What a shape is to a hyperplane, and what the hyperplane leaves of it: the same type, so that cuts follow on cuts.

use std::sync::Arc;

use hyperbody_math::{Pose, Vector};

use super::support::{InHyperplane, SupportOfSection};
use super::{SectionPolytope, SliceFrame, SupportMap, approximate, density};
use crate::error::GeometryErrorKind::{BadNumber, Unsupported};
use crate::shape::Piece;
use crate::volume::unit_ball;
use crate::{Convex, Core, GeometryError, Polytope, Result, Shape};

/// One convex piece of a shape, or of a section of it.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Solid<const N: usize> {
    /// All points at most `radius` from the centre.
    Ball {
        /// Its centre.
        centre: Vector<N>,
        /// > 0, in metres.
        radius: f64,
    },
    /// All points with normal·p ≤ offset. The normal is a unit vector.
    HalfSpace {
        /// Outward.
        normal: Vector<N>,
        /// Distance of the boundary from the origin along the normal.
        offset: f64,
    },
    /// A polytope with all its faces.
    Polytope(SectionPolytope<N>),
    /// A convex body with curved parts.
    Curved(Arc<dyn SupportMap<N>>),
}

/// A convex body at another place.
#[derive(Clone, Debug)]
struct Placed<const N: usize> {
    body: Arc<dyn SupportMap<N>>,
    pose: Pose<N>,
}

impl<const N: usize> SupportMap<N> for Placed<N> {
    fn support(&self, direction: Vector<N>) -> Vector<N> {
        self.pose.transform_point(self.body.support(self.pose.rotation.inverse_rotate(direction)))
    }

    fn section_volume(&self, normal: Vector<N>, offset: f64, tolerance: f64) -> f64 {
        let offset = offset - normal.dot(self.pose.translation);
        self.body.section_volume(self.pose.rotation.inverse_rotate(normal), offset, tolerance)
    }

    fn volume(&self, tolerance: f64) -> f64 {
        self.body.volume(tolerance)
    }
}

impl<const N: usize> Shape<N> {
    /// The convex pieces of the shape, in its frame, ready to be cut. Worth keeping from one cut to the next: for polytopes
    /// all faces are found here.
    #[must_use]
    pub fn solids(&self) -> Vec<Solid<N>> {
        let mut solids = Vec::new();
        self.add_solids(&Pose::IDENTITY, &mut solids);
        solids
    }

    /// The volume (m^(N−1)) of the section by the hyperplane of `frame`, without making the section: in closed form for
    /// balls, boxes and polytopes, and for curved shapes as integrals to within about `tolerance`, in parts of the volume of
    /// the box around the section. Parts of compounds add up, as their masses do.
    ///
    /// The section function of a product is the convolution of those of its factors, that of a simplex is a B-spline (H. B.
    /// Curry, I. J. Schoenberg, 1966), and those of capsules are integrals of powers of roots: these take microseconds to
    /// milliseconds. Rounded boxes and polytopes are sums over their faces, to 1e-9 whatever the tolerance,
    /// in about a millisecond for a simplex of 4D and in tenths of a second for the hundreds of faces of a cube of 6D.
    ///
    /// # Errors
    /// `Unsupported` for a half-space, which has no end; `BadNumber` if the tolerance is not positive.
    ///
    /// ```
    /// use hyperbody_geometry::product::Factor;
    /// use hyperbody_geometry::{Shape, SliceFrame};
    /// let disc = Shape::<2>::ball(1.0)?;
    /// let duocylinder = Shape::<4>::product(vec![Factor::new([0, 1], &disc)?, Factor::new([2, 3], &disc)?])?;
    /// // Across w, a cylinder.
    /// let volume = duocylinder.section_volume(&SliceFrame::from_normal([0.0, 0.0, 0.0, 1.0], 0.6)?, 1e-9)?;
    /// assert!((volume - std::f64::consts::PI * 1.6).abs() < 1e-9);
    /// # Ok::<(), hyperbody_geometry::GeometryError>(())
    /// ```
    pub fn section_volume(&self, frame: &SliceFrame<N>, tolerance: f64) -> Result<f64> {
        let solids = self.solids();
        let mut sum = 0.0;
        for (solid, stand) in solids.iter().zip(cut_stands(&solids, frame)) {
            sum += match stand {
                None => 0.0,
                Some(Stand::Across) => solid.section_volume(frame, tolerance)?,
                // By a hair within the piece, for at the end itself rounding decides whether there is anything.
                Some(Stand::Touches(slack)) => solid.section_volume(
                    &SliceFrame::from_normal(frame.normal(), frame.offset() + 4.0 * slack)?,
                    tolerance,
                )?,
            };
        }
        Ok(sum)
    }

    fn add_solids(&self, outer_from_shape: &Pose<N>, solids: &mut Vec<Solid<N>>) {
        match self {
            Self::Compound { parts } => {
                for (pose, part) in parts {
                    part.add_solids(&(*outer_from_shape * *pose), solids);
                }
            }
            Self::Product(product) => solids.push(Solid::curved(Arc::clone(product) as _, outer_from_shape)),
            Self::Pyramid(pyramid) => solids.push(Solid::curved(Arc::clone(pyramid) as _, outer_from_shape)),
            _ => {
                let placed = |(pose, piece)| Solid::from_piece(piece, *outer_from_shape * pose);
                solids.extend(self.pieces().into_iter().map(placed));
            }
        }
    }
}

/// Parts of the size of a piece by which it may stand off a hyperplane that it touches.
const TOUCHING: f64 = 1e-12;

/// How a piece stands to a hyperplane.
#[derive(Clone, Copy, PartialEq)]
enum Stand {
    /// On both sides, or beside it.
    Across,
    /// It ends there, and what it has lies on this side of it: 1 above, −1 below, by the height that is taken for none.
    Touches(f64),
}

impl Stand {
    fn of<const N: usize>(piece: &Solid<N>, frame: &SliceFrame<N>) -> Self {
        let (normal, offset) = (frame.normal(), frame.offset());
        let (low, high) = (-piece.reach(-normal) - offset, piece.reach(normal) - offset);
        let slack = TOUCHING * (high - low + offset.abs());
        // Half-spaces have no end.
        if !slack.is_finite() {
            Self::Across
        } else if low.abs() <= slack {
            Self::Touches(slack)
        } else if high.abs() <= slack {
            Self::Touches(-slack)
        } else {
            Self::Across
        }
    }

    fn is_above(self) -> bool {
        matches!(self, Self::Touches(slack) if slack >= 0.0)
    }
}

/// Which pieces of one solid a hyperplane cuts. Where pieces meet wall on wall within the hyperplane, both would give the wall as
/// their section, and it would count twice: those that end there from below are left out, so that the section is that just above it.
/// Where no piece begins there, as at the top of a body, they stay.
#[must_use]
pub fn cut_pieces<const N: usize>(pieces: &[Solid<N>], frame: &SliceFrame<N>) -> Vec<bool> {
    cut_stands(pieces, frame).into_iter().map(|stand| stand.is_some()).collect()
}

/// How those pieces stand that are cut.
fn cut_stands<const N: usize>(pieces: &[Solid<N>], frame: &SliceFrame<N>) -> Vec<Option<Stand>> {
    let stands: Vec<Stand> = pieces.iter().map(|piece| Stand::of(piece, frame)).collect();
    let begins = stands.iter().any(|stand| stand.is_above());
    let is_cut = |stand: &Stand| *stand == Stand::Across || stand.is_above() || !begins;
    stands.into_iter().map(|stand| Some(stand).filter(is_cut)).collect()
}

impl<const N: usize> Solid<N> {
    fn curved(body: Arc<dyn SupportMap<N>>, outer_from_body: &Pose<N>) -> Self {
        Self::Curved(Arc::new(Placed { body, pose: *outer_from_body }))
    }

    fn from_piece(piece: Piece<N>, pose: Pose<N>) -> Self {
        let convex = match piece {
            Piece::HalfSpace { normal, offset } => {
                let normal = pose.rotation.rotate(normal);
                return Self::HalfSpace { normal, offset: offset + normal.dot(pose.translation) };
            }
            Piece::Convex(convex) => convex,
        };
        let polytope = match &convex.core {
            Core::Point => return Self::Ball { centre: pose.translation, radius: convex.radius },
            core @ Core::Box { .. } if convex.radius == 0.0 => {
                Polytope::from_points(&core.corners()).ok().map(Arc::new)
            }
            Core::Polytope(polytope) if convex.radius == 0.0 => Some(Arc::clone(polytope)),
            _ => None,
        };
        match polytope {
            Some(polytope) => Self::Polytope(SectionPolytope::from_polytope(&polytope).placed(&pose)),
            // Boxes thinner than a hull can be come here too.
            None => Self::Curved(Arc::new(Placed { body: Arc::new(convex), pose })),
        }
    }

    /// The intersection with the hyperplane of `frame`, in its coordinates: a ball of a ball, a half-space of a half-space,
    /// a polytope with its faces of a polytope. `M` has to be `N − 1`. `None` if nothing is left, or if the hyperplane only
    /// touches a curved body.
    ///
    /// A hyperplane within a half-space is a half-space without end, and gives one that is [`MAX_LENGTH`] deep.
    ///
    /// [`MAX_LENGTH`]: crate::tolerances::MAX_LENGTH
    #[must_use]
    pub fn section<const M: usize>(&self, frame: &SliceFrame<N>) -> Option<Solid<M>> {
        match self {
            Self::Ball { centre, radius } => {
                let height = frame.height(*centre);
                let left = (radius - height) * (radius + height);
                (left > 0.0).then(|| Solid::Ball { centre: frame.to_slice(*centre), radius: left.sqrt() })
            }
            Self::HalfSpace { normal, offset } => {
                let within = frame.direction_to_slice::<M>(*normal);
                let rest = offset - normal.dot(frame.space_from_slice().translation);
                let length = within.norm();
                if length > 1e-12 {
                    return Some(Solid::HalfSpace { normal: within / length, offset: rest / length });
                }
                let all = Solid::HalfSpace { normal: Vector::unit(0), offset: crate::tolerances::MAX_LENGTH };
                (rest >= 0.0).then_some(all)
            }
            Self::Polytope(polytope) => {
                let section = polytope.section::<M>(frame);
                (!section.is_empty()).then_some(Solid::Polytope(section))
            }
            Self::Curved(body) => {
                let section = SupportOfSection::new(body, frame)?;
                Some(Solid::Curved(Arc::new(InHyperplane::<N, M>(section))))
            }
        }
    }

    /// The volume (m^(N−1)) of the section by the hyperplane of `frame`; see [`Shape::section_volume`].
    ///
    /// # Errors
    /// As [`Shape::section_volume`].
    pub fn section_volume(&self, frame: &SliceFrame<N>, tolerance: f64) -> Result<f64> {
        self.check_measurable(tolerance)?;
        let normal = frame.normal();
        Ok(match self {
            Self::Ball { centre, radius } => density::of_ball(N, *radius, frame.height(*centre)),
            Self::HalfSpace { .. } => f64::INFINITY,
            Self::Polytope(polytope) => {
                let simplices = density::simplices(polytope.vertices(), &polytope.filling());
                density::of_simplices(&simplices, normal, frame.offset())
            }
            Self::Curved(body) => {
                let around = self.box_volume() / (self.reach(normal) + self.reach(-normal));
                body.section_volume(normal, frame.offset(), tolerance * around)
            }
        })
    }

    /// The volume (m^N): exactly that of balls and polytopes, and that of curved pieces to within about `tolerance`, in parts
    /// of the volume of the box around the piece. Of a section it is that of [`Shape::section_volume`].
    ///
    /// # Errors
    /// As [`Shape::section_volume`].
    pub fn volume(&self, tolerance: f64) -> Result<f64> {
        self.check_measurable(tolerance)?;
        Ok(match self {
            Self::Ball { radius, .. } => unit_ball(N) * (0..N).map(|_| radius).product::<f64>(),
            Self::HalfSpace { .. } => f64::INFINITY,
            Self::Polytope(polytope) => polytope.mass_properties().mass,
            Self::Curved(body) => body.volume(tolerance * self.box_volume()),
        })
    }

    fn check_measurable(&self, tolerance: f64) -> Result<()> {
        if matches!(self, Self::HalfSpace { .. }) {
            return Err(GeometryError::new(Unsupported, "a half-space has no end, and so no volume: use a large box"));
        }
        if tolerance > 0.0 && tolerance.is_finite() {
            return Ok(());
        }
        let message =
            format!("the tolerance of a volume is {tolerance}: it must be positive, in parts of the box around");
        Err(GeometryError::new(BadNumber, message))
    }

    /// The volume of the axis-aligned box around the piece.
    fn box_volume(&self) -> f64 {
        (0..N).map(|axis| self.reach(Vector::unit(axis)) + self.reach(-Vector::unit(axis))).product()
    }

    /// How far the piece reaches in a direction: the largest direction·p. Infinite for half-spaces.
    #[must_use]
    pub fn reach(&self, direction: Vector<N>) -> f64 {
        match self {
            Self::Ball { centre, radius } => centre.dot(direction) + radius * direction.norm(),
            Self::HalfSpace { .. } => f64::INFINITY,
            Self::Polytope(polytope) => {
                polytope.vertices().iter().map(|v| v.dot(direction)).fold(f64::NEG_INFINITY, f64::max)
            }
            Self::Curved(body) => body.support(direction).dot(direction),
        }
    }

    /// The piece as a polytope: exactly that of polytopes, and for curved pieces one whose vertices lie on the boundary and
    /// whose facets no point of the piece passes by more than `tolerance`, in metres. `None` if a curved piece is thinner
    /// than a hull can be.
    ///
    /// # Errors
    /// `Unsupported` for a half-space, which has no end; `BadNumber` if the tolerance is not positive, or so small that the
    /// polytope would have more than [`MAX_APPROXIMATION_VERTICES`](super::MAX_APPROXIMATION_VERTICES) vertices.
    pub fn to_polytope(&self, tolerance: f64) -> Result<Option<SectionPolytope<N>>> {
        let approximation = match self {
            Self::Polytope(polytope) => return Ok(Some(polytope.clone())),
            Self::HalfSpace { .. } => {
                return Err(GeometryError::new(
                    Unsupported,
                    "a half-space has no end: it cannot be written as a polytope",
                ));
            }
            Self::Ball { centre, radius } => {
                let convex = Convex { core: Core::Point, radius: *radius };
                approximate(&Placed { body: Arc::new(convex), pose: Pose::from_translation(*centre) }, tolerance)
            }
            Self::Curved(body) => approximate(body.as_ref(), tolerance),
        };
        match approximation {
            Ok(polytope) => Ok(Some(SectionPolytope::from_polytope(&polytope))),
            Err(error) if error.kind() == crate::GeometryErrorKind::Flat => Ok(None),
            Err(error) => Err(error),
        }
    }
}
