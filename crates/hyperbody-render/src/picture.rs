//! From a world to a picture: the settings, and what is chosen where nothing is set.

use std::f64::consts::PI;

use crate::bodies::Bodies;
use crate::camera::{Camera, Lens};
use crate::error::RenderError;
use crate::frame::Frame;
use crate::framing::frame_bodies;
use crate::image::Image;
use crate::light::Light;
use crate::occlusion::LightRays;
use crate::slice::Slice;
use crate::stage::Stage;

/// How a picture is made. `..Settings::default()` fills in the rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Pixels across, 16..=8192. Default 1280.
    pub width: u32,
    /// Pixels down, 16..=8192. Default 720.
    pub height: u32,
    /// Rays to the sun, and as many to the sky, per pixel, 1..=64. Default 3; blocks of 16 pixels share theirs.
    pub light_rays: u32,
    /// Samples of a pixel that holds an edge, 1..=64. Default 8.
    pub edge_samples: u32,
    /// Whether bodies close beside the slice show as tinted glass. Default true.
    pub ghosts: bool,
    /// The strip that shows where bodies are along the hidden directions. Default true.
    pub strip: bool,
    /// Lines of text in the lower left corner. Default none.
    pub caption: Vec<String>,
    /// Threads; 0 for one per core. The picture is the same for every number. Default 0.
    pub threads: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            width: 1280,
            height: 720,
            light_rays: 3,
            edge_samples: 8,
            ghosts: true,
            strip: true,
            caption: Vec::new(),
            threads: 0,
        }
    }
}

/// Least pixels across or down.
pub const MIN_SIDE: u32 = 16;

/// Most pixels across or down.
pub const MAX_SIDE: u32 = 8192;

/// How many parts of the work [`render`] tells of for a picture so many pixels high: every row is gone over four times.
#[must_use]
pub fn parts(height: u32) -> u64 {
    4 * u64::from(height)
}

impl Settings {
    fn validate(&self) -> Result<(), RenderError> {
        for (name, value) in [("width", self.width), ("height", self.height)] {
            if !(MIN_SIDE..=MAX_SIDE).contains(&value) {
                return Err(RenderError::new(format!(
                    "the {name} is {value} pixels; it must lie between {MIN_SIDE} and {MAX_SIDE}"
                )));
            }
        }
        for (name, value) in [("light_rays", self.light_rays), ("edge_samples", self.edge_samples)] {
            if !(1..=64).contains(&value) {
                return Err(RenderError::new(format!("{name} is {value}; it must lie between 1 and 64")));
            }
        }
        if self.threads > 256 {
            return Err(RenderError::new(format!("threads is {}; it must lie between 0 and 256", self.threads)));
        }
        Ok(())
    }
}

/// A picture of a slice of a world with these bodies. Without a camera, one is chosen by [`frame_bodies`]. `progress` is told
/// that so many more [`parts`] are done.
///
/// # Errors
/// If a setting is outside its range, the camera is not finite, or the threads cannot be started.
pub fn render<const N: usize>(
    bodies: &Bodies<N>,
    slice: &Slice<N>,
    camera: Option<&Camera>,
    settings: &Settings,
    progress: &(dyn Fn(u64) + Sync),
) -> Result<Image, RenderError> {
    settings.validate()?;
    let camera = camera
        .copied()
        .unwrap_or_else(|| frame_bodies(bodies, slice, f64::from(settings.width) / f64::from(settings.height)));
    check(&camera)?;
    let stage = Stage::new(bodies, slice);
    let light = Light::new(stage.up, camera.target - camera.eye);
    let frame = Frame {
        stage: &stage,
        lens: Lens::new(&camera, settings.width, settings.height),
        // Where a pixel's own light is not known, more rays make up for the missing mean.
        rays: [settings.light_rays, 2 * settings.light_rays].map(|rays| LightRays::new(&light, rays)),
        light,
        width: settings.width as usize,
        height: settings.height as usize,
        rows_at_once: Frame::<N>::rows_at_once(settings.width),
        edge_samples: settings.edge_samples,
        ghosts: settings.ghosts,
        progress,
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(settings.threads).build();
    let pool = pool.map_err(|error| RenderError::new(format!("{} threads: {error}", settings.threads)))?;
    let mut image = pool.install(|| frame.image());
    crate::overlay::draw(&mut image, &stage, settings);
    Ok(image)
}

fn check(camera: &Camera) -> Result<(), RenderError> {
    let finite = camera.eye.is_finite() && camera.target.is_finite() && camera.up.is_finite();
    if !finite || camera.eye == camera.target {
        return Err(RenderError::new(format!(
            "the camera stands at {:?} and looks at {:?}: both must be finite, and apart",
            camera.eye.0, camera.target.0
        )));
    }
    if !(1e-6..PI).contains(&camera.field_of_view) {
        return Err(RenderError::new(format!(
            "the field of view is {} rad; it must lie between 1e-6 and π",
            camera.field_of_view
        )));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use hyperbody::math::{Rotation, Vector};
    use hyperbody::prelude::{BodyDef, Shape, World, WorldDef};

    use super::*;

    /// A large picture is worked on in bands of rows, to save memory: nobody must see where they meet.
    #[test]
    fn bands_of_rows_do_not_show() {
        let mut world = World::<4>::new(WorldDef::default()).unwrap();
        world.add_body(BodyDef::fixed(Shape::half_space(Vector::unit(1), 0.0).unwrap())).unwrap();
        for index in 0..6 {
            let away = f64::from(index);
            let cube = BodyDef::new(Shape::cuboid([0.5; 4]).unwrap()).rotation(Rotation::in_plane(0, 3, 0.3 * away));
            world.add_body(cube.position([0.7 * away - 2.0, 0.5 + 0.3 * away, -0.4 * away, 0.2 * away])).unwrap();
        }
        let bodies = Bodies::of(&world);
        let stage = Stage::new(&bodies, &Slice::natural());
        let camera = frame_bodies(&bodies, &Slice::natural(), 1.0);
        let light = Light::new(stage.up, camera.target - camera.eye);
        let draw = |rows_at_once: usize| {
            let frame = Frame {
                stage: &stage,
                lens: Lens::new(&camera, 60, 60),
                rays: [2, 4].map(|rays| LightRays::new(&light, rays)),
                light: light.clone(),
                width: 60,
                height: 60,
                rows_at_once,
                edge_samples: 8,
                ghosts: true,
                progress: &|_| (),
            };
            frame.image()
        };
        let whole = draw(60);
        for rows in [7, 16, 59] {
            assert_eq!(draw(rows), whole, "{rows} rows at once");
        }
    }
}
