//! Shapes as bytes: by their definitions, so that bodies come back with the shape they had, and not with what collision made of
//! it. Polytopes keep their facets as they are, to the bit, and are checked face by face.

use std::sync::Arc;

use hyperbody_math::Vector;

use super::{BytesError, Reader, Stored, Writer};
use crate::polytope::Facet;
use crate::product::{ConvexFactor, Factor, Product};
use crate::pyramid::Pyramid;
use crate::tolerances::MAX_LENGTH;
use crate::{GeometryError, Polytope, Shape};

/// How far a stored normal may be from unit length.
const UNIT_TOLERANCE: f64 = 1e-9;

/// How far a vertex may be above the plane of a facet, and those of the facet off it, in parts of the polytope's size. Hulls
/// of points with few digits are made with tolerances up to this.
const PLANE_TOLERANCE: f64 = 1e-5;

/// What kind of shape is expected: shapes nest, but not without end.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Level {
    /// A box or a polytope, which alone can be rounded.
    Core,
    /// Anything convex.
    Part,
    Whole,
}

impl<const N: usize> Stored for Shape<N> {
    fn write(&self, out: &mut Writer) {
        match self {
            Self::Ball { radius } => tagged(0, out).write_all(radius),
            Self::Box { half_extents } => tagged(1, out).write_all(half_extents),
            Self::HalfSpace { normal, offset } => tagged(2, out).write_all(&(*normal, *offset)),
            Self::Capsule { half_length, radius, along } => {
                tagged(3, out).write_all(&((*half_length, *radius), *along as u32));
            }
            Self::Polytope(polytope) => tagged(4, out).write_all(polytope),
            Self::Rounded { core, radius } => {
                radius.write(tagged(5, out).0);
                core.write(out);
            }
            Self::Product(product) => tagged(6, out).write_all(product),
            Self::Pyramid(pyramid) => tagged(7, out).write_all(pyramid),
            Self::Compound { parts } => {
                tagged(8, out).0.length(parts.len());
                parts.iter().for_each(|(pose, shape)| {
                    pose.write(out);
                    shape.write(out);
                });
            }
        }
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        read_shape(from, Level::Whole)
    }
}

struct Tagged<'w>(&'w mut Writer);

impl Tagged<'_> {
    fn write_all(self, value: &impl Stored) {
        value.write(self.0);
    }
}

fn tagged(tag: u8, out: &mut Writer) -> Tagged<'_> {
    tag.write(out);
    Tagged(out)
}

/// A shape by itself, as factors keep theirs.
pub(crate) fn shape_bytes<const K: usize>(shape: &Shape<K>) -> Arc<[u8]> {
    let mut out = Writer::new();
    shape.write(&mut out);
    out.into_bytes().into()
}

/// The error of a constructor, at this place.
fn refused<T>(made: Result<T, GeometryError>, from: &Reader<'_>) -> Result<T, BytesError> {
    made.map_err(|error| from.error(error.to_string()))
}

fn read_shape<const N: usize>(from: &mut Reader<'_>, level: Level) -> Result<Shape<N>, BytesError> {
    let tag = u8::read(from)?;
    let allowed = match level {
        Level::Core => matches!(tag, 1 | 4),
        Level::Part => !matches!(tag, 2 | 8),
        Level::Whole => true,
    };
    if !allowed {
        return Err(from.error(format!("a shape of kind {tag} stands where none may")));
    }
    match tag {
        0 => {
            let radius = f64::read(from)?;
            refused(Shape::ball(radius), from)
        }
        1 => {
            let half_extents = Vector::read(from)?;
            refused(Shape::cuboid(half_extents), from)
        }
        2 => read_half_space(from),
        3 => {
            let ((half_length, radius), along): ((f64, f64), u32) = Stored::read(from)?;
            refused(Shape::capsule(half_length, radius, along as usize), from)
        }
        4 => {
            let polytope = Stored::read(from)?;
            refused(Shape::polytope(polytope), from)
        }
        5 => {
            let radius = f64::read(from)?;
            let core = read_shape(from, Level::Core)?;
            refused(Shape::rounded(core, radius), from)
        }
        6 => Ok(Shape::Product(Stored::read(from)?)),
        7 => Ok(Shape::Pyramid(Stored::read(from)?)),
        8 => {
            let count = from.length()?;
            let mut parts = Vec::new();
            for _ in 0..count {
                parts.push((Stored::read(from)?, read_shape(from, Level::Part)?));
            }
            refused(Shape::compound(parts), from)
        }
        other => Err(from.error(format!("{other} stands for no kind of shape"))),
    }
}

/// The constructor would divide by the length of the normal again, which changes bits.
fn read_half_space<const N: usize>(from: &mut Reader<'_>) -> Result<Shape<N>, BytesError> {
    let (normal, offset): (Vector<N>, f64) = Stored::read(from)?;
    check_unit(normal, from)?;
    if offset.abs() > MAX_LENGTH {
        return Err(from.error(format!("a half-space lies {offset} m from the origin: the limit is {MAX_LENGTH:e} m")));
    }
    Ok(Shape::HalfSpace { normal, offset })
}

fn check_unit<const N: usize>(normal: Vector<N>, from: &Reader<'_>) -> Result<(), BytesError> {
    if (normal.norm() - 1.0).abs() <= UNIT_TOLERANCE {
        return Ok(());
    }
    Err(from.error(format!("a normal is {:?}; its length must be 1", normal.0)))
}

crate::stored!(Facet<N> { normal, offset, vertices, neighbours });

impl<const N: usize> Stored for Polytope<N> {
    fn write(&self, out: &mut Writer) {
        out.length(self.vertices().len());
        self.vertices().iter().for_each(|vertex| vertex.write(out));
        out.length(self.facets().len());
        self.facets().iter().for_each(|facet| facet.write(out));
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let vertices: Vec<Vector<N>> = Stored::read(from)?;
        let facets: Vec<Facet<N>> = Stored::read(from)?;
        check_polytope(&vertices, &facets).map_err(|reason| from.error(format!("a polytope is none: {reason}")))?;
        Ok(Self::from_parts(vertices, facets))
    }
}

/// That the facets fit the vertices: planes that hold them, incidences that agree, and neighbours that lean inwards. Facets that are
/// neighbours may share less than a ridge.
fn check_polytope<const N: usize>(vertices: &[Vector<N>], facets: &[Facet<N>]) -> Result<(), String> {
    if vertices.len() <= N || facets.len() <= N {
        return Err(format!("it has {} vertices and {} facets", vertices.len(), facets.len()));
    }
    let size = vertices.iter().fold(0.0, |size: f64, v| size.max(v.max_abs()));
    if size > MAX_LENGTH {
        return Err(format!("a vertex is {size} m from the origin: the limit is {MAX_LENGTH:e} m"));
    }
    let mut held = vec![0_usize; vertices.len()];
    for (index, facet) in facets.iter().enumerate() {
        let ascending = |list: &[u32], end: usize| {
            list.is_sorted_by(|a, b| a < b) && list.last().is_none_or(|&last| (last as usize) < end)
        };
        if !(ascending(&facet.vertices, vertices.len()) && ascending(&facet.neighbours, facets.len())) {
            return Err(format!("facet {index} names vertices or neighbours out of order, or that are not there"));
        }
        if facet.vertices.len() < N || facet.neighbours.len() < N {
            return Err(format!("facet {index} has too few vertices or neighbours"));
        }
        if (facet.normal.norm() - 1.0).abs() > UNIT_TOLERANCE {
            return Err(format!("the normal of facet {index} is not of length 1"));
        }
        let height = |v: &Vector<N>| facet.normal.dot(*v) - facet.offset;
        // What is convex from each facet to the next is convex.
        let beside = |&other: &u32| facets[other as usize].vertices.iter().filter_map(|&v| vertices.get(v as usize));
        if facet.neighbours.iter().flat_map(beside).any(|v| height(v) > PLANE_TOLERANCE * size) {
            return Err(format!("a vertex of a neighbour lies outside of facet {index}"));
        }
        if facet.vertices.iter().any(|&v| height(&vertices[v as usize]) < -PLANE_TOLERANCE * size) {
            return Err(format!("a vertex of facet {index} does not lie in it"));
        }
        let knows = |&other: &u32| facets[other as usize].neighbours.binary_search(&(index as u32)).is_ok();
        if facet.neighbours.binary_search(&(index as u32)).is_ok() || !facet.neighbours.iter().all(knows) {
            return Err(format!("facet {index} is its own neighbour, or of one that does not know it"));
        }
        facet.vertices.iter().for_each(|&v| held[v as usize] += 1);
    }
    if held.iter().any(|&count| count < N) {
        return Err("a vertex lies in too few facets".to_owned());
    }
    Ok(())
}

impl Stored for ConvexFactor {
    fn write(&self, out: &mut Writer) {
        let (axes, definition) = self.definition();
        out.length(axes.len());
        axes.iter().for_each(|&axis| (axis as u32).write(out));
        out.length(definition.len());
        out.raw(definition);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let axes: Vec<u32> = Stored::read(from)?;
        let length = from.length()?;
        let definition = from.take(length)?;
        // The dimension of a factor is in its type only.
        match axes.len() {
            1 => read_factor::<1>(&axes, definition, from),
            2 => read_factor::<2>(&axes, definition, from),
            3 => read_factor::<3>(&axes, definition, from),
            4 => read_factor::<4>(&axes, definition, from),
            5 => read_factor::<5>(&axes, definition, from),
            other => Err(from.error(format!("a factor has {other} axes; it must have 1 to 5"))),
        }
    }
}

fn read_factor<const K: usize>(axes: &[u32], definition: &[u8], from: &Reader<'_>) -> Result<ConvexFactor, BytesError> {
    let mut inner = Reader::new(definition);
    let shape = Shape::<K>::read(&mut inner).and_then(|shape| inner.finish().map(|()| shape));
    let shape = shape.map_err(|error| from.error(format!("a factor: {error}")))?;
    let mut own = [0; K];
    own.iter_mut().zip(axes).for_each(|(own, &axis)| *own = axis as usize);
    refused(ConvexFactor::new(own, &shape), from)
}

impl<const N: usize> Stored for Product<N> {
    fn write(&self, out: &mut Writer) {
        out.length(self.factors().len());
        self.factors().iter().for_each(|factor| factor.write(out));
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let factors: Vec<ConvexFactor> = Stored::read(from)?;
        match refused(Shape::product(factors.into_iter().map(Factor::from).collect()), from)? {
            Shape::Product(product) => Ok(Arc::unwrap_or_clone(product)),
            _ => Err(from.error("a product has no curved factor")),
        }
    }
}

impl<const N: usize> Stored for Pyramid<N> {
    fn write(&self, out: &mut Writer) {
        let (base, height) = self.definition();
        base.write(out);
        height.write(out);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let (base, height): (ConvexFactor, f64) = Stored::read(from)?;
        match refused(Shape::pyramid(Factor::from(base), height), from)? {
            Shape::Pyramid(pyramid) => Ok(Arc::unwrap_or_clone(pyramid)),
            _ => Err(from.error("a cone has a flat base")),
        }
    }
}
