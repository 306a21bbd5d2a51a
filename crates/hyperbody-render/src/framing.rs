//! Where a camera has to stand so that what matters is in the picture, and fills it.

use hyperbody::math::{Vector, scalar};
use hyperbody::prelude::BodyKind;

use crate::bodies::Bodies;
use crate::camera::{Camera, cross};
use crate::slice::Slice;
use crate::stage::{BodyLook, GHOST_REACH, Stage};

/// How far from the others, in typical distances between them, a body has flown away and is left out of the picture.
const FAR_AWAY: f64 = 5.0;

/// Radius of the ball around a body that has to be in the picture, in radii of the body.
const ROOM: f64 = 1.1;

/// Field of view if none is said, rad.
const USUAL_FIELD_OF_VIEW: f64 = 0.6;

/// Least distance at that, in radii of the largest body: a single one does not fill the picture from edge to edge.
const LEAST_DISTANCE: f64 = 4.6;

/// From where a camera looks whose distance is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// Angle around the vertical, from the front (0) to the right, rad.
    pub azimuth: f64,
    /// Angle above the horizon, from −π/2 to π/2, rad.
    pub elevation: f64,
    /// Angle of view from the lower to the upper edge, in (0, π). Default 0.6.
    pub field_of_view: f64,
    /// What is in the middle of the picture, in coordinates of the slice, m; chosen if `None`.
    pub target: Option<Vector<3>>,
}

impl Viewpoint {
    /// From the right and above; a flat world is seen nearly from the front.
    #[must_use]
    pub fn natural(dimension: usize) -> Self {
        let (azimuth, elevation) = if dimension == 2 { (0.12, 0.16) } else { (0.6, 0.3) };
        Self { azimuth, elevation, field_of_view: USUAL_FIELD_OF_VIEW, target: None }
    }
}

/// A camera that has the moving bodies in view that the slice cuts or nearly cuts, or all of them if there are none, but for
/// the few that flew far away. `aspect` is width over height.
#[must_use]
pub fn frame_bodies<const N: usize>(bodies: &Bodies<N>, slice: &Slice<N>, aspect: f64) -> Camera {
    frame_all(&[(bodies.clone(), *slice)], aspect)
}

/// As [`frame_bodies`], one camera for several moments or slices: for films, and for pictures beside each other.
#[must_use]
pub fn frame_all<const N: usize>(sights: &[(Bodies<N>, Slice<N>)], aspect: f64) -> Camera {
    frame_from(sights, aspect, &Viewpoint::natural(N))
}

/// As [`frame_all`], from a viewpoint of your own.
#[must_use]
pub fn frame_from<const N: usize>(sights: &[(Bodies<N>, Slice<N>)], aspect: f64, viewpoint: &Viewpoint) -> Camera {
    let stages: Vec<Stage<N>> = sights.iter().map(|(bodies, slice)| Stage::new(bodies, slice)).collect();
    let up = stages.first().map_or(Vector::unit(1), |stage| stage.up);
    let balls = without_outliers(choose(&stages));
    let around = middle(&balls, &[0, 1, 2].map(Vector::unit));
    let mut camera = Camera::around(around, up, 1.0, viewpoint.azimuth, viewpoint.elevation);
    camera.field_of_view = viewpoint.field_of_view;
    let outward = camera.eye - camera.target;
    let right = cross(camera.up, outward).try_normalize().unwrap_or(Vector::unit(0));
    let above = cross(outward, right);
    camera.target = viewpoint.target.unwrap_or_else(|| middle(&balls, &[right, above, outward]));
    let tangent = scalar::tan(0.5 * camera.field_of_view);
    // A ball that touches the edge of the picture touches a plane through the eye.
    let sight = |across: f64, radius: f64, tangent: f64| {
        across.abs() / tangent + radius * (1.0 + 1.0 / (tangent * tangent)).sqrt()
    };
    let distance = balls.iter().fold(0.0, |distance: f64, (centre, radius)| {
        let from_target = *centre - camera.target;
        let high = sight(from_target.dot(above), *radius, tangent);
        let wide = sight(from_target.dot(right), *radius, tangent * aspect);
        distance.max(outward.dot(from_target) + high.max(wide))
    });
    let largest = balls.iter().map(|(_, radius)| radius / ROOM).fold(0.0, f64::max);
    // A narrow view shows from farther away what a wide one shows from nearby.
    let stretch = scalar::tan(0.5 * USUAL_FIELD_OF_VIEW) / tangent;
    let distance = distance.max(LEAST_DISTANCE * stretch * largest);
    camera.eye = camera.target + outward * if distance > 0.0 { distance } else { 6.0 * stretch };
    camera
}

/// The balls around the bodies that matter, in coordinates of the slice.
fn choose<const N: usize>(stages: &[Stage<N>]) -> Vec<(Vector<3>, f64)> {
    // Flat bodies are drawn with a thickness, which comes closer to the eye.
    let room = if N == 2 { 1.5 } else { ROOM };
    let balls = |choice: Choice| {
        let looks = stages.iter().flat_map(|stage| stage.bodies.iter().filter(move |look| choice.takes(stage, look)));
        looks.map(|look| (look.seen_middle(), room * look.radius)).collect::<Vec<_>>()
    };
    let choices = [Choice::Shown, Choice::Moving, Choice::Solid];
    choices.into_iter().map(balls).find(|balls| !balls.is_empty()).unwrap_or_default()
}

/// What matters, in this order.
#[derive(Clone, Copy)]
enum Choice {
    /// Moving bodies that the slice cuts or nearly cuts.
    Shown,
    /// Moving bodies.
    Moving,
    /// Everything but half-spaces.
    Solid,
}

impl Choice {
    fn takes<const N: usize>(self, stage: &Stage<N>, look: &BodyLook) -> bool {
        let is_moving = look.kind == BodyKind::Dynamic;
        match self {
            Self::Shown => is_moving && look.gap().is_some_and(|gap| gap <= GHOST_REACH * stage.size),
            Self::Moving => is_moving,
            Self::Solid => look.hidden_extents.is_some(),
        }
    }
}

/// Leaves out what is far from the median, measured by the median distance from it.
fn without_outliers(mut balls: Vec<(Vector<3>, f64)>) -> Vec<(Vector<3>, f64)> {
    let median = |values: &mut Vec<f64>| {
        values.sort_unstable_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(0.0)
    };
    let middle: Vector<3> =
        Vector::from_fn(|axis| median(&mut balls.iter().map(|(centre, _)| centre[axis]).collect::<Vec<_>>()));
    let typical = median(&mut balls.iter().map(|(centre, radius)| centre.distance(middle) + radius).collect());
    balls.retain(|(centre, _)| centre.distance(middle) <= FAR_AWAY * typical);
    balls
}

/// The point half-way between the outermost balls along each of three orthonormal directions.
fn middle(balls: &[(Vector<3>, f64)], directions: &[Vector<3>; 3]) -> Vector<3> {
    directions.iter().fold(Vector::ZERO, |sum, direction| {
        let ends = |sign: f64| {
            balls.iter().map(|(centre, radius)| sign * centre.dot(*direction) + radius).reduce(f64::max).unwrap_or(0.0)
        };
        sum + *direction * (0.5 * (ends(1.0) - ends(-1.0)))
    })
}
