//! Parts of scenes for programs that change a running world: its world itself, and bodies that join later.

use hyperbody::math::{Dim, EvenAlgebra};
use hyperbody::prelude::{BodyDef, BodyHandle, World};

use crate::build::{self, ShapeBuilder};
use crate::dimension::DIMENSIONS;
use crate::error::SceneError;
use crate::json::Json;
use crate::model::{Body, Joint, Scene, ShapeSpec};
use crate::read::{At, shape};

impl Scene {
    /// The world of the scene, on `threads` threads, and the handles of its bodies in their order; the same bits as
    /// [`AnyWorld::new`](crate::AnyWorld::new) builds.
    ///
    /// # Errors
    /// As there, and if the scene does not have `N` dimensions.
    pub fn world<const N: usize>(&self, threads: usize) -> Result<(World<N>, Vec<BodyHandle>), SceneError>
    where
        Dim<N>: EvenAlgebra,
    {
        if !DIMENSIONS.contains(&self.dimension) {
            let (lowest, highest) = (DIMENSIONS.start(), DIMENSIONS.end());
            let message = format!("is {}, expected a whole number from {lowest} to {highest}", self.dimension);
            return Err(SceneError::value("dimension", message));
        }
        if self.dimension != N {
            return Err(SceneError::value("dimension", format!("is {}, and {N} was asked for", self.dimension)));
        }
        build::world::<N>(self, threads).map_err(|error| error.in_file(self.file.as_deref()))
    }

    /// What a body would be in the world of this scene, with its materials. `place` is what messages call it.
    ///
    /// # Errors
    /// If a value of the body is not that of a body in `N` dimensions.
    pub fn definition<const N: usize>(&self, body: &Body, place: &str) -> Result<BodyDef<N>, SceneError>
    where
        Dim<N>: EvenAlgebra,
    {
        let materials = build::materials(self)?;
        build::body_def(body, place, &materials, &mut ShapeBuilder::new(self.beside()))
    }
}

impl ShapeSpec {
    /// A shape as scenes write it, such as `{"ball": {"radius": 1}}`.
    ///
    /// # Errors
    /// If the text is not JSON, or a key is unknown, missing or of the wrong type.
    pub fn from_json(text: &str) -> Result<Self, SceneError> {
        shape(&At::root(&Json::parse(text)?))
    }
}

impl Joint {
    /// The names of the bodies that it ties together; `None` for the world.
    #[must_use]
    pub fn body_names(&self) -> (Option<&str>, &str) {
        (self.a.as_deref(), &self.b)
    }
}
