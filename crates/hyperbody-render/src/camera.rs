//! Where the eye is in the slice, and what it looks at.

use hyperbody::collision::ray::Ray;
use hyperbody::math::{Vector, scalar};

/// A pinhole camera in the coordinates of the slice. Lengths in metres, angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where the eye is.
    pub eye: Vector<3>,
    /// What is in the middle of the picture.
    pub target: Vector<3>,
    /// What is up; need not be orthogonal to the view.
    pub up: Vector<3>,
    /// Angle of view from the lower to the upper edge, in (0, π).
    pub field_of_view: f64,
}

impl Camera {
    /// A camera at a distance from its target: `azimuth` turns it around the vertical, from the front (0) to the right,
    /// `elevation` lifts it, from −π/2 (straight below) to π/2 (straight above). In the view from there, too, what lies
    /// beyond the target as seen from the azimuth is up in the picture.
    #[must_use]
    pub fn around(target: Vector<3>, up: Vector<3>, distance: f64, azimuth: f64, elevation: f64) -> Self {
        // The front is where the third direction points to, or the first if that is up.
        let front = flat(Vector::unit(2), up).or_else(|| flat(Vector::unit(0), up)).unwrap_or(Vector::unit(2));
        let right = cross(up, front);
        let (sin_azimuth, cos_azimuth) = scalar::sin_cos(azimuth);
        let (sin_elevation, cos_elevation) = scalar::sin_cos(elevation);
        let outward = front * cos_azimuth + right * sin_azimuth;
        let eye = target + (outward * cos_elevation + up * sin_elevation) * distance;
        // Along the vertical the vertical says nothing; the limit of views from nearby does.
        let up = if cos_elevation.abs() < STEEP { outward * -sin_elevation } else { up };
        Self { eye, target, up, field_of_view: 0.6 }
    }

    /// The camera farther to the right, so that what was in the middle of the picture is in the middle of what a share of its
    /// width at the right edge leaves free. `aspect` is width over height.
    #[must_use]
    pub fn with_room(mut self, share: f64, aspect: f64) -> Self {
        let forward = self.target - self.eye;
        let right = cross(forward, self.up).normalize_or_zero();
        let half_width = forward.norm() * scalar::tan(0.5 * self.field_of_view) * aspect;
        self.eye += right * (share * half_width);
        self.target += right * (share * half_width);
        self
    }
}

/// Least sine of the angle between a view and the upward direction at which the latter tells what is up.
const STEEP: f64 = 1e-6;

/// The unit vector of the part of `v` across `up`.
fn flat(v: Vector<3>, up: Vector<3>) -> Option<Vector<3>> {
    let across = v - up * up.dot(v);
    (across.norm() > 0.1).then(|| across.normalize_or_zero())
}

pub(crate) fn cross(a: Vector<3>, b: Vector<3>) -> Vector<3> {
    Vector([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
}

/// A camera with the frame of a picture: makes the rays of its points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lens {
    eye: Vector<3>,
    forward: Vector<3>,
    /// Of half the picture's height.
    right: Vector<3>,
    above: Vector<3>,
    half_width: f64,
    half_height: f64,
    /// Angle of a pixel, radians.
    pub(crate) pixel_angle: f64,
}

impl Lens {
    pub(crate) fn new(camera: &Camera, width: u32, height: u32) -> Self {
        let forward = (camera.target - camera.eye).try_normalize().unwrap_or(-Vector::unit(2));
        // A view straight along `up` takes any other direction for it.
        let side = [camera.up, Vector::unit(0), Vector::unit(1)].map(|up| cross(forward, up));
        let right = side.into_iter().find(|side| side.norm() > STEEP).unwrap_or(Vector::unit(0)).normalize_or_zero();
        let tangent = scalar::tan(0.5 * camera.field_of_view);
        Self {
            eye: camera.eye,
            forward,
            right: right * tangent,
            above: cross(right, forward) * tangent,
            half_width: 0.5 * f64::from(width),
            half_height: 0.5 * f64::from(height),
            pixel_angle: 2.0 * tangent / f64::from(height),
        }
    }

    /// The ray through a point of the picture, in pixels from the upper left corner. The direction is a unit vector.
    #[inline]
    pub(crate) fn ray(&self, x: f64, y: f64) -> Ray<3> {
        let across = (x - self.half_width) / self.half_height;
        let upward = (self.half_height - y) / self.half_height;
        let direction = self.forward + self.right * across + self.above * upward;
        Ray::new(self.eye, direction * (1.0 / direction.norm()))
    }
}
