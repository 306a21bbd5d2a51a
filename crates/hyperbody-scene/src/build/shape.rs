//! Shapes of a scene, with their polytopes shared between bodies that are alike.

use std::collections::BTreeMap;
use std::path::{Component, Path};
use std::rc::Rc;
use std::sync::Arc;

use hyperbody::geometry;
use hyperbody::geometry::regular::Regular;
use hyperbody::math::planes::{AXIS_NAMES, axis_from_name};
use hyperbody::math::{Dim, EvenAlgebra};
use hyperbody::prelude::{Polytope, Pose, Shape};

use super::{Result, product, rotation, shape_error, vector, vector_or_zero};
use crate::error::{ErrorKind, SceneError};
use crate::model::{Beside, PolytopeSpec, ShapeSpec, Size};
use crate::off;
use crate::read::{join, read_text};
use crate::shape_file::is_star;

/// Most vertices of one polytope: the 120-cell has 600, and the cost of a hull grows fast with their number.
pub const MAX_VERTICES: usize = 10_000;

/// Most levels of shapes inside shapes: a rounded box in a compound has three.
const MAX_DEPTH: usize = 8;

/// Largest size of a shape file, bytes.
pub(crate) const MAX_SHAPE_FILE_BYTES: u64 = 16 << 20;

/// Makes the shapes of one scene.
pub(crate) struct ShapeBuilder<'a, const N: usize> {
    beside: Beside<'a>,
    /// Regular polytopes and files that were made already, by what the scene says of them: hundreds of equal dice share
    /// one polytope.
    made: BTreeMap<String, Arc<Polytope<N>>>,
    /// The convex cells of meshes and star polytopes, likewise: taking them apart is done once.
    made_of_cells: BTreeMap<String, Cells<N>>,
}

impl<'a, const N: usize> ShapeBuilder<'a, N>
where
    Dim<N>: EvenAlgebra,
{
    /// A builder that takes files from there.
    pub(crate) fn new(beside: Beside<'a>) -> Self {
        Self { beside, made: BTreeMap::new(), made_of_cells: BTreeMap::new() }
    }

    /// The shape that stands at `path` in the scene.
    pub(crate) fn shape(&mut self, spec: &ShapeSpec, path: &str) -> Result<Shape<N>> {
        self.shape_at_depth(spec, path, 0)
    }

    pub(super) fn shape_at_depth(&mut self, spec: &ShapeSpec, path: &str, depth: usize) -> Result<Shape<N>> {
        if depth == MAX_DEPTH {
            let message = format!("shapes lie in shapes more than {MAX_DEPTH} deep; flatten them");
            return Err(SceneError::value(path, message));
        }
        let path = join(path, spec.key());
        let refuse = |place: &str| {
            let place = place.to_owned();
            move |error| shape_error(&place, &error)
        };
        match spec {
            ShapeSpec::Ball { radius } => Shape::ball(*radius).map_err(refuse(&format!("{path}.radius"))),
            ShapeSpec::Box { half_extents } => {
                let place = format!("{path}.half_extents");
                Shape::cuboid(vector(half_extents, &place)?).map_err(refuse(&place))
            }
            ShapeSpec::HalfSpace { normal, offset } => {
                if !offset.is_finite() {
                    let message = format!("is {offset}; it has to be finite");
                    return Err(SceneError::value(format!("{path}.offset"), message));
                }
                let normal = vector(normal, &format!("{path}.normal"))?;
                Shape::half_space(normal, *offset).map_err(refuse(&path))
            }
            ShapeSpec::Capsule { half_length, radius, along } => {
                let along = axis::<N>(along, &format!("{path}.along"))?;
                Shape::capsule(*half_length, *radius, along).map_err(refuse(&path))
            }
            ShapeSpec::Polytope(polytope) => Shape::polytope(self.polytope(polytope, &path)?).map_err(refuse(&path)),
            ShapeSpec::Rounded { shape, radius } => {
                let core = self.shape_at_depth(shape, &format!("{path}.shape"), depth + 1)?;
                Shape::rounded(core, *radius).map_err(refuse(&path))
            }
            ShapeSpec::Mesh { file } => {
                let place = format!("{path}.file");
                let beside = self.beside;
                let cells = || off::cells(&read_beside(beside, file, &place)?, &place);
                compound_of(&self.cells(format!("mesh {file}"), cells)?).map_err(refuse(&place))
            }
            ShapeSpec::Star { name, size } => {
                let cells = || off::star_cells(name, *size, &path);
                compound_of(&self.cells(format!("star {name} {size:?}"), cells)?).map_err(refuse(&path))
            }
            ShapeSpec::Pyramid { base, height } => {
                product::check_base_axes::<N>(&base.axes, &format!("{path}.base.axes"))?;
                let base = product::base::<N>(base, self.beside, &format!("{path}.base"), depth)?;
                Shape::pyramid(base, *height).map_err(refuse(&path))
            }
            ShapeSpec::Product { factors } => {
                let made = product::factors::<N>(factors, self.beside, &format!("{path}.factors"), depth)?;
                product::check_axes(N, factors, &format!("{path}.factors"))?;
                Shape::product(made).map_err(refuse(&path))
            }
            ShapeSpec::Compound { parts } => {
                let mut placed = Vec::with_capacity(parts.len());
                for (index, part) in parts.iter().enumerate() {
                    let place = format!("{path}.parts[{index}]");
                    let position = vector_or_zero(&part.position, &format!("{place}.position"))?;
                    let turn = rotation::rotation(&part.rotation, &format!("{place}.rotation"))?;
                    let shape = self.shape_at_depth(&part.shape, &format!("{place}.shape"), depth + 1)?;
                    let pose = Pose::new(turn, position);
                    match shape {
                        // Meshes, stars and compounds within compounds are lists of parts themselves.
                        Shape::Compound { parts } => {
                            placed.extend(parts.into_iter().map(|(own, part)| (pose * own, part)));
                        }
                        shape => placed.push((pose, shape)),
                    }
                }
                Shape::compound(placed).map_err(refuse(&path))
            }
        }
    }

    fn polytope(&mut self, spec: &PolytopeSpec, path: &str) -> Result<Arc<Polytope<N>>> {
        let key = match spec {
            PolytopeSpec::Vertices(vertices) => return hull(vertices, &format!("{path}.vertices")).map(Arc::new),
            PolytopeSpec::Regular { name, size } => format!("regular {name} {size:?}"),
            PolytopeSpec::File(file) => format!("file {file}"),
        };
        if let Some(made) = self.made.get(&key) {
            return Ok(Arc::clone(made));
        }
        let polytope = match spec {
            PolytopeSpec::Regular { name, size } => regular(name, *size, path)?,
            PolytopeSpec::File(file) => {
                let place = format!("{path}.file");
                off::polytope(&read_beside(self.beside, file, &place)?, &place)?
            }
            PolytopeSpec::Vertices(vertices) => hull(vertices, path)?,
        };
        let polytope = Arc::new(polytope);
        self.made.insert(key, Arc::clone(&polytope));
        Ok(polytope)
    }

    /// The cells that go by this key, made if there are none yet.
    fn cells(&mut self, key: String, make: impl FnOnce() -> Result<Vec<Polytope<N>>>) -> Result<Cells<N>> {
        if let Some(made) = self.made_of_cells.get(&key) {
            return Ok(Rc::clone(made));
        }
        let made: Cells<N> = make()?.into_iter().map(Arc::new).collect();
        self.made_of_cells.insert(key, Rc::clone(&made));
        Ok(made)
    }
}

/// Convex cells that make a body.
type Cells<const N: usize> = Rc<[Arc<Polytope<N>>]>;

fn compound_of<const N: usize>(cells: &[Arc<Polytope<N>>]) -> geometry::Result<Shape<N>> {
    let parts: geometry::Result<Vec<_>> =
        cells.iter().map(|cell| Ok((Pose::IDENTITY, Shape::polytope(Arc::clone(cell))?))).collect();
    parts.and_then(Shape::compound)
}

/// How the message begins that an axis has no such name.
pub(super) const UNKNOWN_AXIS: &str = "unknown axis";

pub(super) fn axis<const N: usize>(name: &str, path: &str) -> Result<usize> {
    let mut letters = name.chars();
    match (letters.next().and_then(|letter| axis_from_name(N, letter)), letters.next()) {
        (Some(axis), None) => Ok(axis),
        _ => {
            let known: Vec<String> = AXIS_NAMES[..N].iter().map(char::to_string).collect();
            let message = format!("{UNKNOWN_AXIS} \"{name}\"; in {N} dimensions there are {}", known.join(", "));
            Err(SceneError::value(path, message))
        }
    }
}

fn hull<const N: usize>(vertices: &[Vec<f64>], path: &str) -> Result<Polytope<N>> {
    if vertices.len() > MAX_VERTICES {
        let message = format!("has {} points; at most {MAX_VERTICES} are allowed", vertices.len());
        return Err(SceneError::value(path, message));
    }
    let mut points = Vec::with_capacity(vertices.len());
    for (index, vertex) in vertices.iter().enumerate() {
        points.push(vector(vertex, &format!("{path}[{index}]"))?);
    }
    Polytope::from_points(&points).map_err(|error| shape_error(path, &error))
}

fn regular<const N: usize>(name: &str, size: Size, path: &str) -> Result<Polytope<N>> {
    if is_star(name) {
        let message = format!("\"{name}\" is a star polytope: use \"star\" in place of \"polytope\"");
        return Err(SceneError::new(ErrorKind::Shape, format!("{path}.regular"), message));
    }
    let regular = Regular::from_name(N, name).map_err(|error| shape_error(&format!("{path}.regular"), &error))?;
    regular.polytope(size).map_err(|error| shape_error(path, &error))
}

/// The text of the file `name`, which is carried along or has to lie in the folder or below it: a scene from elsewhere reads
/// nothing else.
pub(crate) fn read_beside(beside: Beside<'_>, name: &str, path: &str) -> Result<String> {
    if let Some(text) = beside.carried.and_then(|files| files.get(name)) {
        return Ok(text.clone());
    }
    let refuse = |message: String| Err(SceneError::new(ErrorKind::File, path, message));
    let relative = Path::new(name);
    if name.is_empty() || !relative.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir)) {
        return refuse(format!("\"{name}\" is not the name of a file beside the scene, such as \"shape.off\""));
    }
    let Some(folder) = beside.folder else {
        return refuse(format!("names the file \"{name}\", but the scene lies in no folder; save it as a file first"));
    };
    read_text(&folder.join(relative), MAX_SHAPE_FILE_BYTES)
        .map_err(|error| SceneError::new(ErrorKind::File, path, error.to_string()))
}
