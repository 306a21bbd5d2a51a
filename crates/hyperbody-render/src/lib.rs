//! Pictures of worlds of two to six dimensions, without a window or a graphics driver.
//!
//! A picture shows a three-dimensional slice of the world, cut through every body exactly: each ray of the picture lies in
//! the slice and is cast against the solids themselves by the engine's own ray query. Sun, sky and soft shadows are rays
//! as well. Work is shared among threads by rows, and the picture is the same bytes for every number of them.
//!
//! ```
//! use hyperbody::prelude::*;
//! use hyperbody_render::{Bodies, Settings, Slice, render};
//!
//! let mut world = World::<4>::new(WorldDef::default())?;
//! world.add_body(BodyDef::fixed(Shape::half_space([0.0, 1.0, 0.0, 0.0], 0.0)?))?;
//! world.add_body(BodyDef::new(Shape::cuboid([0.5; 4])?).position([0.0, 0.5, 0.0, 0.0]))?;
//! // From x towards w: the tesseract is cut at a slant.
//! let slice = Slice::natural().turned(0, 3, 0.5);
//! let settings = Settings { width: 64, height: 36, ..Settings::default() };
//! let image = render(&Bodies::of(&world), &slice, None, &settings, &|_| ())?;
//! let mut png = Vec::new();
//! image.write_png(&mut png)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | module | holds |
//! |---|---|
//! | [`slice`](mod@slice) | [`Slice`]: which three directions of the world are seen |
//! | [`bodies`] | [`Bodies`]: what there is, and where it is |
//! | [`camera`] | [`Camera`]: where the eye is in the slice |
//! | [`framing`] | [`frame_bodies`], [`frame_all`], [`frame_from`]: cameras that have everything in view |
//! | [`picture`] | [`render`], [`Settings`] |
//! | [`image`] | [`Image`]: the finished picture, and PNG |
//! | [`sheet`] | [`Sheet`]: pictures beside each other |
//! | [`film`] | [`Film`]: GIF and animated PNG |
//! | `stage`, `solid` | the world cut by the slice: sections, ghosts, planes |
//! | `surface` | what a ray sees: colours of cells, edges, floor, glass |
//! | `light`, `occlusion`, `frame` | sun and sky, how much of them arrives, and the picture |
//! | `colour` | palette and tone mapping |
//! | `palette` | the few colours of a GIF |
//! | `overlay`, `text` | the strip of hidden directions, and captions |

pub mod bodies;
pub mod camera;
mod colour;
pub mod error;
pub mod film;
mod frame;
pub mod framing;
pub mod image;
mod light;
mod occlusion;
mod overlay;
mod palette;
pub mod picture;
pub mod sheet;
pub mod slice;
mod solid;
mod stage;
mod surface;
mod text;

pub use bodies::Bodies;
pub use camera::Camera;
pub use error::RenderError;
pub use film::{Film, FilmFormat};
pub use framing::{Viewpoint, frame_all, frame_bodies, frame_from};
pub use image::Image;
pub use overlay::strips_share;
pub use picture::{Settings, render};
pub use sheet::Sheet;
pub use slice::Slice;
