//! Shapes that stand in a file of their own, or that have a name.

use std::path::{Path, PathBuf};

use hyperbody::geometry::MassProperties;
use hyperbody::geometry::regular::{self, Regular, Size};
use hyperbody::geometry::star;
use hyperbody::math::planes::AXIS_NAMES;
use hyperbody::math::{Dim, EvenAlgebra};
use hyperbody::prelude::Shape;

use crate::build::{ShapeBuilder, read_beside};
use crate::dimension::DIMENSIONS;
use crate::error::{ErrorKind, SceneError, meant};
use crate::json::Json;
use crate::model::{Beside, PolytopeSpec, ShapeSpec};
use crate::off;
use crate::read::{At, MAX_FILE_BYTES, Result, join, made_as, read_text, shape};

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
        refuse_other_formats(path)?;
        if is_off(path) {
            return Ok(false);
        }
        let json = Json::parse(&read_text(path, MAX_FILE_BYTES)?).map_err(|error| error.in_file(Some(path)))?;
        Ok(matches!(json, Json::Object(fields) if fields.iter().any(|(key, _)| key == "format" || key == "bodies")))
    }

    /// Reads an OFF file, or the shape of a scene as JSON, such as `{"ball": {"radius": 1}}`. The dimension is that of the
    /// shape's numbers or name, or of the OFF file that it names; where these do not tell, as for a ball, it is `dimension`.
    ///
    /// # Errors
    /// If the file cannot be read, holds no shape, or one of another dimension, or does not tell and `dimension` is
    /// `None`.
    pub fn load(path: impl AsRef<Path>, dimension: Option<usize>) -> Result<Self> {
        let path = path.as_ref();
        refuse_other_formats(path)?;
        Self::read(path, dimension).map_err(|error| error.in_file(Some(path)))
    }

    /// The regular polytope of circumradius 1 m, convex or a star, with a name such as `"24-cell"` or a Schläfli symbol such as
    /// `"{5/2,5}"`. The dimension is `dimension` where there are several of that name, as of `"simplex"`. `None` if no regular
    /// polytope of any dimension has this name.
    ///
    /// # Errors
    /// If there is none of that dimension, or several and `dimension` is `None`.
    #[must_use]
    pub fn named(name: &str, dimension: Option<usize>) -> Option<Result<Self>> {
        let (name, size) = (name.to_owned(), Size::Circumradius(1.0));
        let shape = if dimensions_of(&name).next().is_some() {
            ShapeSpec::Polytope(PolytopeSpec::Regular { name, size })
        } else if star::symbol(&name).is_ok() {
            ShapeSpec::Star { name, size }
        } else {
            return None;
        };
        let told = shape.dimension();
        let file = PathBuf::from(shape.regular_name().unwrap_or_default());
        let settled = settled_dimension(&shape, told, dimension).map_err(|error| error.in_file(Some(&file)));
        Some(settled.map(|dimension| Self { dimension, shape, closed: true, file }))
    }

    /// What is to be said of a name that [`ShapeFile::named`] does not know: what a symbol has to look like, or the nearest name, of a
    /// shape or one of `others`. Empty if nothing is near.
    #[must_use]
    pub fn hint(name: &str, others: &[&str]) -> String {
        if name.trim_start().starts_with('{') {
            // {6/2} and the like are told what they are.
            if let Some((_, what)) =
                star::symbol(name).err().map(|e| e.to_string()).as_ref().and_then(|e| e.split_once("\": "))
            {
                return format!("; {what}");
            }
            return "; a Schläfli symbol has numbers from 3 on, or fractions above 2 in lowest terms, with commas between them: \
                    {3,4,3}, {5/2,5}"
                .to_owned();
        }
        if let Some(own) = made_as(name) {
            return format!("; as a .json file it is {own}");
        }
        let mut known: Vec<&str> = DIMENSIONS.flat_map(regular::names).chain(ALSO).collect();
        known.extend(star::NAMES.iter().map(|(name, _)| *name));
        known.extend(others);
        meant(name, known).map_or(String::new(), |near| format!("; the nearest is \"{near}\""))
    }

    fn read(path: &Path, dimension: Option<usize>) -> Result<Self> {
        let text = read_text(path, MAX_FILE_BYTES)?;
        let (shape, told, closed) = if is_off(path) {
            let file = off::read(&text, "")?;
            let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
            (ShapeSpec::Polytope(PolytopeSpec::File(name)), Some(file.dimension()), off::is_closed(&file))
        } else {
            let shape = shape(&At::root(&Json::parse(&text)?))?;
            let told = match shape.dimension() {
                None => dimension_of_files(&shape, "", beside(path))?,
                told => told,
            };
            (shape, told, true)
        };
        let dimension = settled_dimension(&shape, told, dimension)?;
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

    /// Numbers of vertices, edges, …, facets that an OFF file lists. A convex body may have fewer: flat neighbours are one face of it, and
    /// vertices that no face names are none. `None` for all other files, and for those that list no facets.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn listed_faces(&self) -> Result<Option<Vec<usize>>> {
        if !is_off(&self.file) || !self.file.is_file() {
            return Ok(None);
        }
        let file = read_text(&self.file, MAX_FILE_BYTES).and_then(|text| off::read(&text, ""));
        let file = file.map_err(|error| error.in_file(Some(&self.file)))?;
        let mut counts = vec![file.vertex_count(), file.edge_count()];
        counts.extend((2..file.dimension()).map(|rank| file.elements(rank).len()));
        Ok((counts.last() != Some(&0)).then_some(counts))
    }

    /// The shape, in `N` dimensions, of convex cells if the surface in an OFF file is not convex; `N` has to be
    /// [`ShapeFile::dimension`].
    ///
    /// # Errors
    /// If the numbers of the shape are not those of a shape.
    pub fn build<const N: usize>(&self) -> Result<Shape<N>>
    where
        Dim<N>: EvenAlgebra,
    {
        let mut spec = self.shape.clone();
        if let ShapeSpec::Polytope(PolytopeSpec::File(file)) = &spec
            && is_off(&self.file)
            && self.mesh::<N>()?.is_some()
        {
            spec = ShapeSpec::Mesh { file: file.clone() };
        }
        let shape = ShapeBuilder::new(beside(&self.file)).shape(&spec, "");
        // In an OFF file itself nobody wrote the keys of a shape.
        let placed = |error: SceneError| if is_off(&self.file) { error.without_place() } else { error };
        shape.map_err(|error| placed(error).in_file(Some(&self.file)))
    }
}

/// Where the files lie that a shape in this file names.
fn beside(file: &Path) -> Beside<'_> {
    let folder = file.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    Beside { carried: None, folder: Some(folder) }
}

/// The dimension of the first OFF file that a shape at `path` names.
fn dimension_of_files(shape: &ShapeSpec, path: &str, beside: Beside<'_>) -> Result<Option<usize>> {
    let path = join(path, shape.key());
    match shape {
        ShapeSpec::Mesh { file } | ShapeSpec::Polytope(PolytopeSpec::File(file)) => {
            let place = format!("{path}.file");
            Ok(Some(off::read(&read_beside(beside, file, &place)?, &place)?.dimension()))
        }
        ShapeSpec::Rounded { shape, .. } => dimension_of_files(shape, &format!("{path}.shape"), beside),
        ShapeSpec::Compound { parts } => {
            for (index, part) in parts.iter().enumerate() {
                let told = dimension_of_files(&part.shape, &format!("{path}.parts[{index}].shape"), beside)?;
                if told.is_some() {
                    return Ok(told);
                }
            }
            Ok(None)
        }
        _ => Ok(None),
    }
}

fn is_off(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("off"))
}

/// Files of triangles that many programs write: they are written here too, and not read.
const WRITTEN_ONLY: [&str; 5] = ["stl", "obj", "glb", "gltf", "ply"];

fn refuse_other_formats(path: &Path) -> Result<()> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if !WRITTEN_ONLY.contains(&extension.as_str()) {
        return Ok(());
    }
    let message = format!(
        "is a .{extension} file, and shapes are read from .off files: save it as one, with corners that faces share, as most \
         programs for meshes can"
    );
    Err(SceneError::new(ErrorKind::File, "", message).in_file(Some(path)))
}

/// The dimensions in which there is a regular convex polytope of that name.
fn dimensions_of(name: &str) -> impl Iterator<Item = usize> {
    DIMENSIONS.filter(move |&dimension| Regular::from_name(dimension, name).is_ok())
}

/// The dimension that a shape tells, or the one that is wanted.
fn settled_dimension(shape: &ShapeSpec, told: Option<usize>, wanted: Option<usize>) -> Result<usize> {
    let refuse = |message: String| Err(SceneError::value("", message));
    let dimension = match (told, wanted) {
        (Some(told), Some(wanted)) if told != wanted => {
            return refuse(format!("holds a shape of {told} dimensions, not {wanted}"));
        }
        (Some(told), _) => told,
        (None, Some(wanted)) => wanted,
        (None, None) => {
            let name = shape.regular_name().filter(|name| dimensions_of(name).next().is_none());
            return refuse(match name {
                Some(name) => unknown_name(name),
                None => "does not tell its dimension; say it, from 2 to 6".to_owned(),
            });
        }
    };
    if !DIMENSIONS.contains(&dimension) {
        return refuse(format!("holds a shape of {dimension} dimensions; there are shapes of 2 to 6"));
    }
    Ok(dimension)
}

/// What a name is told that stands for nothing in any dimension.
fn unknown_name(name: &str) -> String {
    let known: Vec<&str> = DIMENSIONS.flat_map(regular::names).chain(ALSO).collect();
    if is_star(name) {
        return format!("\"{name}\" is a star polytope: use \"star\" in place of \"polytope\"");
    }
    // What stands for a polytope by its form is told why it is none: {4,4} is a tiling.
    if let Some(Err(error)) = star::symbol(name).ok().map(|symbol| Regular::from_name(symbol.len() + 1, name)) {
        return error.to_string();
    }
    let stars = star::NAMES.iter().map(|(name, _)| *name);
    let hint = meant(name, known.iter().copied().chain(stars))
        .map_or(String::new(), |near| format!("; the nearest is \"{near}\""));
    format!(
        "\"{name}\" is no regular polytope of any dimension{hint} (known: {}, star polytopes, Schläfli symbols)",
        known.join(", ")
    )
}

/// Whether a name or symbol is that of a polytope whose faces or vertices are stars.
pub(crate) fn is_star(name: &str) -> bool {
    star::symbol(name).is_ok_and(|symbol| symbol.iter().any(|&(_, d)| d > 1))
}

/// Names that [`regular::names`] leaves out: second ones, and those of whole families.
const ALSO: [&str; 4] = ["tesseract", "simplex", "hypercube", "cross-polytope"];

/// The least dimension that has all the axes that are named, so that one that is left out is told as missing.
fn axes_up_to(axes: &str) -> usize {
    axes.chars()
        .filter_map(|letter| AXIS_NAMES.iter().position(|&name| name == letter))
        .map(|axis| axis + 1)
        .max()
        .unwrap_or(0)
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
                let mut known = dimensions_of(name);
                let first = known.next();
                first.filter(|_| known.next().is_none())
            }
            Self::Polytope(PolytopeSpec::File(_)) | Self::Mesh { .. } => None,
            Self::Star { name, .. } => star::symbol(name).ok().map(|symbol| symbol.len() + 1),
            Self::Pyramid { base, .. } => Some((base.axes.chars().count() + 1).max(axes_up_to(&base.axes))),
            Self::Rounded { shape, .. } => shape.dimension(),
            Self::Product { factors } => {
                let axes: String = factors.iter().map(|factor| factor.axes.as_str()).collect();
                Some(axes.chars().count().max(axes_up_to(&axes)))
            }
            Self::Compound { parts } => parts.iter().find_map(|part| {
                let told = (!part.position.is_empty()).then_some(part.position.len());
                told.or_else(|| part.shape.dimension())
            }),
        }
    }

    /// The name of a regular polytope, be it rounded.
    fn regular_name(&self) -> Option<&str> {
        match self {
            Self::Polytope(PolytopeSpec::Regular { name, .. }) | Self::Star { name, .. } => Some(name),
            Self::Rounded { shape, .. } => shape.regular_name(),
            _ => None,
        }
    }
}
