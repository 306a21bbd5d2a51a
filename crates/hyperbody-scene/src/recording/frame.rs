//! The bodies at one step.

use hyperbody::math::{Dim, EvenAlgebra, Matrix, Pose, Rotation, Vector};
use hyperbody::prelude::{BodyHandle, World};

use crate::dimension::{DimensionVisitor, visit_dimension};
use crate::world::AnyWorld;
use hyperbody::dynamics::POSITION_LIMIT;

/// Where every body of a scene is at one step, in the order of the scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Number of the step, 0 before the first.
    pub step: u64,
    /// Simulated time, s.
    pub time: f64,
    /// For each body the position of the origin of its frame in m, N numbers, and the rows of the matrix that turns body
    /// axes into world axes, N² numbers.
    pub poses: Vec<f64>,
    /// For each body, [`Frame::SLEEPING`] and [`Frame::QUARANTINED`].
    pub flags: Vec<u8>,
}

/// Largest coordinate of a pose, m: of the origin of a body's frame, which may lie beside its middle, and of a body that
/// passes the limit of the simulation in the very step that is recorded.
const FARTHEST: f64 = 2.0 * POSITION_LIMIT;

/// What is wrong with the numbers of a frame.
struct Fault<'a>(&'a Frame);

impl DimensionVisitor for Fault<'_> {
    type Output = Option<String>;

    fn visit<const N: usize>(self) -> Option<String>
    where
        Dim<N>: EvenAlgebra,
    {
        let frame = self.0;
        (0..frame.body_count()).find_map(|body| {
            let numbers = frame.poses.chunks_exact(Frame::numbers(N)).nth(body)?;
            if let Some(number) = numbers.iter().find(|number| !number.is_finite()) {
                return Some(format!("a number of the pose of body {body} is {number}, which is not finite"));
            }
            if let Some(place) = numbers[..N].iter().find(|place| place.abs() > FARTHEST) {
                let limit = format!("places lie within ±{POSITION_LIMIT:e} m");
                return Some(format!("body {body} is at a coordinate of {place:e} m; {limit}"));
            }
            frame.pose::<N>(body).is_none().then(|| format!("the matrix of body {body} is no rotation"))
        })
    }
}

struct Capture<'a>(&'a AnyWorld);

impl DimensionVisitor for Capture<'_> {
    type Output = Frame;

    fn visit<const N: usize>(self) -> Frame
    where
        Dim<N>: EvenAlgebra,
    {
        let mut frame = Frame { step: self.0.step_count(), time: self.0.time(), ..Frame::default() };
        if let (Some(world), Some(handles)) = (self.0.get::<N>(), self.0.handles::<N>()) {
            frame.capture(world, handles);
        }
        frame
    }
}

impl Frame {
    /// Flag of a body that is asleep.
    pub const SLEEPING: u8 = 1;

    /// Flag of a body that was taken out of the simulation because its state turned non-finite.
    pub const QUARANTINED: u8 = 2;

    /// Numbers that the pose of a body has in `dimension` dimensions.
    #[must_use]
    pub const fn numbers(dimension: usize) -> usize {
        dimension + dimension * dimension
    }

    /// The bodies of a world as they are now.
    #[must_use]
    pub fn of(world: &AnyWorld) -> Self {
        visit_dimension(world.dimension(), Capture(world)).unwrap_or_default()
    }

    fn capture<const N: usize>(&mut self, world: &World<N>, handles: &[BodyHandle]) {
        self.poses.reserve(handles.len() * Self::numbers(N));
        for handle in handles {
            // Only programs remove bodies; these leave an empty place, so that the others keep their numbers.
            let pose = world.body(*handle).map_or(Pose::IDENTITY, |body| body.pose());
            self.poses.extend(pose.translation.iter());
            self.poses.extend(pose.rotation.matrix().0.iter().flatten());
            self.flags.push(world.body(*handle).map_or(0, |body| {
                u8::from(body.is_sleeping()) * Self::SLEEPING + u8::from(body.is_quarantined()) * Self::QUARANTINED
            }));
        }
    }

    /// What of it no simulation could mean, if anything, in words.
    pub(super) fn fault(&self, dimension: usize) -> Option<String> {
        if !self.time.is_finite() {
            return Some(format!("the time is {}, which is not finite", self.time));
        }
        visit_dimension(dimension, Fault(self)).flatten()
    }

    /// Number of bodies.
    #[must_use]
    pub fn body_count(&self) -> usize {
        self.flags.len()
    }

    /// The pose of a body, bit by bit as it was recorded; `None` if there is no such body, or its numbers are no pose of
    /// `N` dimensions.
    #[must_use]
    pub fn pose<const N: usize>(&self, body: usize) -> Option<Pose<N>> {
        let numbers = self.poses.chunks_exact(Self::numbers(N)).nth(body)?;
        let translation = Vector::from_slice(&numbers[..N])?;
        let matrix = Matrix(std::array::from_fn(|row| std::array::from_fn(|column| numbers[N + row * N + column])));
        let rotation = Rotation::from_exact_matrix(matrix)?;
        translation.is_finite().then(|| Pose::new(rotation, translation))
    }

    /// Whether a body is asleep.
    #[must_use]
    pub fn is_sleeping(&self, body: usize) -> bool {
        self.flags.get(body).is_some_and(|flags| flags & Self::SLEEPING != 0)
    }

    /// Whether a body was taken out of the simulation.
    #[must_use]
    pub fn is_quarantined(&self, body: usize) -> bool {
        self.flags.get(body).is_some_and(|flags| flags & Self::QUARANTINED != 0)
    }
}
