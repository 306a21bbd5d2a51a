//! Shapes that stand in a file of their own.

use std::path::{Path, PathBuf};

use hyperbody::geometry::MassProperties;
use hyperbody::geometry::regular::Regular;
use hyperbody::geometry::star;
use hyperbody::math::{Dim, EvenAlgebra};
use hyperbody::prelude::Shape;

use crate::build::ShapeBuilder;
use crate::dimension::DIMENSIONS;
use crate::error::SceneError;
use crate::json::Json;
use crate::model::{Beside, PolytopeSpec, ShapeSpec};
use crate::off;
use crate::read::{At, MAX_FILE_BYTES, Result, read_text, shape};

/// A shape and its dimension, read from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct ShapeFile {
    /// Number of axes, 2..=6.
    pub dimension: usize,
    /// What the file says.
    pub shape: ShapeSpec,
    /// Whether its surface has no holes; only files that list faces can have some.
    pub closed: bool,
    /// The file.
    pub file: PathBuf,
}

impl ShapeFile {
    /// Whether a file holds a scene and not a shape: it is JSON and says its format.
    ///
    /// # Errors
    /// If the file cannot be read or is neither OFF nor JSON.
    pub fn holds_scene(path: &Path) -> Result<bool> {
        if is_off(path) {
            return Ok(false);
        }
        let json = Json::parse(&read_text(path, MAX_FILE_BYTES)?).map_err(|error| error.in_file(Some(path)))?;
        Ok(matches!(json, Json::Object(fields) if fields.iter().any(|(key, _)| key == "format" || key == "bodies")))
    }

    /// Reads an OFF file, or the shape of a scene as JSON, such as `{"ball": {"radius": 1}}`. The dimension is that of the
    /// shape's numbers or name; where these do not tell, as for a ball, it is `dimension`.
    ///
    /// # Errors
    /// If the file cannot be read, holds no shape, or one of another dimension, or does not tell and `dimension` is
    /// `None`.
    pub fn load(path: impl AsRef<Path>, dimension: Option<usize>) -> Result<Self> {
        let path = path.as_ref();
        Self::read(path, dimension).map_err(|error| error.in_file(Some(path)))
    }

    fn read(path: &Path, dimension: Option<usize>) -> Result<Self> {
        let text = read_text(path, MAX_FILE_BYTES)?;
        let (shape, told, closed) = if is_off(path) {
            let file = off::read(&text, "")?;
            let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
            (ShapeSpec::Polytope(PolytopeSpec::File(name)), Some(file.dimension()), off::is_closed(&file))
        } else {
            let shape = shape(&At::root(&Json::parse(&text)?))?;
            let told = shape.dimension();
            (shape, told, true)
        };
        let refuse = |message: String| Err(SceneError::value("", message));
        let dimension = match (told, dimension) {
            (Some(told), Some(wanted)) if told != wanted => {
                return refuse(format!("holds a shape of {told} dimensions, not {wanted}"));
            }
            (Some(told), _) => told,
            (None, Some(wanted)) => wanted,
            (None, None) => return refuse("does not tell its dimension; say it, from 2 to 6".to_owned()),
        };
        if !DIMENSIONS.contains(&dimension) {
            return refuse(format!("holds a shape of {dimension} dimensions; there are shapes of 2 to 6"));
        }
        Ok(Self { dimension, shape, closed, file: path.to_path_buf() })
    }

    /// Numbers of vertices, edges, …, facets, and mass properties at unit density, of a surface that is not convex: an OFF file's,
    /// or that of a star polytope, where what the surface winds around twice counts twice. `None` for all other files. `N` has to
    /// be [`ShapeFile::dimension`].
    ///
    /// # Errors
    /// If the surface is open or cannot be oriented.
    pub fn mesh<const N: usize>(&self) -> Result<Option<(Vec<usize>, MassProperties<N>)>> {
        if let ShapeSpec::Star { name, size } = &self.shape {
            return off::star_mass::<N>(name, *size, "star").map(Some).map_err(|error| error.in_file(Some(&self.file)));
        }
        if !is_off(&self.file) {
            return Ok(None);
        }
        let text = read_text(&self.file, MAX_FILE_BYTES)?;
        off::mesh::<N>(&text, "").map_err(|error| error.in_file(Some(&self.file)))
    }

    /// The shape, in `N` dimensions, for cutting and weighing; `N` has to be [`ShapeFile::dimension`]. Star polytopes may have more
    /// cells here than as bodies.
    ///
    /// # Errors
    /// If the numbers of the shape are not those of a shape.
    pub fn build<const N: usize>(&self) -> Result<Shape<N>>
    where
        Dim<N>: EvenAlgebra,
    {
        let folder = self.file.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let shape = ShapeBuilder::for_sections(Beside { carried: None, folder: Some(folder) }).shape(&self.shape, "");
        shape.map_err(|error| error.in_file(Some(&self.file)))
    }
}

fn is_off(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("off"))
}

impl ShapeSpec {
    /// The dimension, as far as the shape's own numbers and names tell.
    #[must_use]
    pub fn dimension(&self) -> Option<usize> {
        match self {
            Self::Ball { .. } | Self::Capsule { .. } => None,
            Self::Box { half_extents } => Some(half_extents.len()),
            Self::HalfSpace { normal, .. } => Some(normal.len()),
            Self::Polytope(PolytopeSpec::Vertices(vertices)) => vertices.first().map(Vec::len),
            Self::Polytope(PolytopeSpec::Regular { name, .. }) => {
                let mut known = DIMENSIONS.filter(|&dimension| Regular::from_name(dimension, name).is_ok());
                let first = known.next();
                first.filter(|_| known.next().is_none())
            }
            Self::Polytope(PolytopeSpec::File(_)) | Self::Mesh { .. } => None,
            Self::Star { name, .. } => star::symbol(name).ok().map(|symbol| symbol.len() + 1),
            Self::Pyramid { base, .. } => Some(base.axes.chars().count() + 1),
            Self::Rounded { shape, .. } => shape.dimension(),
            Self::Product { factors } => Some(factors.iter().map(|factor| factor.axes.chars().count()).sum()),
            Self::Compound { parts } => parts.iter().find_map(|part| {
                let told = (!part.position.is_empty()).then_some(part.position.len());
                told.or_else(|| part.shape.dimension())
            }),
        }
    }
}
