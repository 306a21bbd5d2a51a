//! Products of shapes of lower dimension: prisms, duoprisms, cylinders, duocylinders, spherinders.
//!
//! A point belongs to A × B if its coordinates on A's axes lie in A and those on B's axes in B. Supports, volumes and
//! second moments of the factors stand side by side. Products of polytopes are polytopes, with each facet a facet of one
//! factor times the others. Products with curved factors keep their exact support function, mass and sections; contacts see
//! them as the product of polytopes that follow the curved factors as closely as [`Product::faceting`] says. Of factors of several
//! convex pieces, such as stars, every piece of one is multiplied with every piece of the others (`pieces`).

pub(crate) mod pieces;

use std::sync::Arc;

pub use pieces::Factor;

use hyperbody_math::{Matrix, Vector};

use crate::error::GeometryErrorKind::{BadCount, Unsupported};
use crate::mass::MassProperties;
use crate::polytope::Facet;
use crate::round_parts::RoundPart;
use crate::section::density::{self, Simplex, Term};
use crate::section::{SectionFunction, SupportMap, approximate};
use crate::shape::Piece;
use crate::tolerances::{COARSENING, COARSEST, FACETING, MAX_PRODUCT_VERTICES, MOST_COARSER};
use crate::{Convex, Core, GeometryError, Polytope, Result, Shape};

/// A convex shape of lower dimension on some of the axes.
#[derive(Clone, Debug)]
pub(crate) struct ConvexFactor {
    axes: Vec<usize>,
    /// The core's vertices, one behind the other; the factor is all points at most `radius` away from their hull.
    corners: Vec<f64>,
    radius: f64,
    volume: f64,
    centre: Vec<f64>,
    /// By rows, about the centre, at unit density.
    second_moments: Vec<f64>,
    /// The factor itself, or a polytope close to it.
    faceted: Faceted,
    faceting: f64,
    measure: Arc<dyn FactorMeasure>,
    /// The shape as bytes, whose type is lost otherwise.
    definition: Arc<[u8]>,
}

/// The section function of a factor, whose dimension is in its type only.
trait FactorMeasure: std::fmt::Debug + Send + Sync {
    /// The volume of the section across a unit normal, as a function of offset and tolerance.
    fn section_function<'a>(&'a self, normal: &[f64]) -> SectionOf<'a>;

    /// The polytope that contacts see in place of a curved factor, so many times as far from it as usual, and how far that is.
    fn faceted(&self, coarser: f64) -> Option<Result<(Faceted, f64)>>;
}

type SectionOf<'a> = Box<dyn Fn(f64, f64) -> f64 + 'a>;

/// A factor with flat faces, filled with simplices.
#[derive(Debug)]
struct FlatMeasure<const K: usize>(Vec<Simplex<K>>);

impl<const K: usize> FactorMeasure for FlatMeasure<K> {
    fn section_function<'a>(&'a self, normal: &[f64]) -> SectionOf<'a> {
        let normal = Vector::from_slice(normal).unwrap_or(Vector::ZERO);
        Box::new(move |offset, _tolerance| density::of_simplices(&self.0, normal, offset))
    }

    fn faceted(&self, _coarser: f64) -> Option<Result<(Faceted, f64)>> {
        None
    }
}

impl<const K: usize> FactorMeasure for Convex<K> {
    fn section_function<'a>(&'a self, normal: &[f64]) -> SectionOf<'a> {
        let normal = Vector::from_slice(normal).unwrap_or(Vector::ZERO);
        // What all sections across one direction have in common is made once.
        match SectionFunction::of_convex(self, normal) {
            Some(function) => Box::new(move |offset, _tolerance| function.at(offset)),
            None => Box::new(move |offset, tolerance| SupportMap::<K>::section_volume(self, normal, offset, tolerance)),
        }
    }

    fn faceted(&self, coarser: f64) -> Option<Result<(Faceted, f64)>> {
        Some(Faceted::of_convex(self, coarser))
    }
}

/// A polytope of any dimension from one up.
#[derive(Clone, Debug)]
struct Faceted {
    vertices: Vec<f64>,
    facets: Vec<FactorFacet>,
}

#[derive(Clone, Debug)]
struct FactorFacet {
    normal: Vec<f64>,
    offset: f64,
    vertices: Vec<u32>,
    neighbours: Vec<u32>,
}

impl ConvexFactor {
    /// A convex and bounded shape; errors as [`Factor::new`].
    pub(crate) fn new<const K: usize>(axes: [usize; K], shape: &Shape<K>) -> Result<Self> {
        let refuse = |what: &str| Err(GeometryError::new(Unsupported, format!("a factor of a product is {what}")));
        let convex = match shape {
            Shape::Compound { .. } => return refuse("a compound where a convex shape should be"),
            Shape::Product(_) => return refuse("a product: give its factors one by one"),
            Shape::Pyramid(_) => return refuse("a cone, which is not supported there: use a pyramid over a polytope"),
            _ => match shape.pieces().pop() {
                Some((_, Piece::Convex(convex))) => convex,
                _ => return refuse("a half-space, which has no end: use a long box"),
            },
        };
        let mass = shape.mass_properties(1.0)?;
        let (faceted, faceting) = Faceted::of_convex(&convex, 1.0)?;
        let measure: Arc<dyn FactorMeasure> =
            if convex.radius == 0.0 { Arc::new(FlatMeasure(filling(&convex.core)?)) } else { Arc::new(convex.clone()) };
        Ok(Self {
            axes: axes.to_vec(),
            corners: convex.core.corners().iter().flat_map(|c| c.0).collect(),
            radius: convex.radius,
            volume: mass.mass,
            centre: mass.centre.iter().collect(),
            second_moments: mass.second_moments.0.iter().flatten().copied().collect(),
            faceted,
            faceting,
            measure,
            definition: crate::bytes::shape_bytes(shape),
        })
    }

    /// The largest direction·p over the factor, for a unit direction.
    fn reach(&self, direction: &[f64]) -> f64 {
        let along = |corner: &[f64]| corner.iter().zip(direction).map(|(c, d)| c * d).sum::<f64>();
        self.corners.chunks(self.axes.len()).map(along).fold(f64::NEG_INFINITY, f64::max) + self.radius
    }

    /// The factor as the section function of the product along a normal sees it; `None` if the normal does not.
    pub(crate) fn term<const N: usize>(&self, normal: Vector<N>) -> Option<Term<'_>> {
        let part: Vec<f64> = self.axes.iter().map(|&axis| normal[axis]).collect();
        let weight = part.iter().map(|c| c * c).sum::<f64>().sqrt();
        if weight < BLIND {
            return None;
        }
        let unit: Vec<f64> = part.iter().map(|c| c / weight).collect();
        let opposite: Vec<f64> = unit.iter().map(|c| -c).collect();
        let range = [-self.reach(&opposite), self.reach(&unit)];
        Some(Term { weight, range, section: self.measure.section_function(&unit) })
    }

    /// Whether its faces are flat.
    pub(crate) fn is_flat(&self) -> bool {
        self.faceting == 0.0
    }

    pub(crate) fn axes(&self) -> &[usize] {
        &self.axes
    }

    /// The axes and the shape, to be stored.
    pub(crate) fn definition(&self) -> (&[usize], &[u8]) {
        (&self.axes, &self.definition)
    }

    /// m^K.
    pub(crate) const fn volume(&self) -> f64 {
        self.volume
    }

    /// How far the polytope that contacts see is from the factor, m.
    pub(crate) const fn faceting(&self) -> f64 {
        self.faceting
    }

    /// What is round, for a polytope whose vertices have this factor's at the given stride: balls, whose core is a point.
    pub(crate) fn round_part(&self, stride: usize, total: usize) -> Option<RoundPart> {
        let ball = self.radius > 0.0 && self.axes.len() > 1 && self.corners.iter().all(|&c| c == 0.0);
        let count = self.faceted.vertices.len() / self.axes.len();
        (ball && self.corners.len() == self.axes.len()).then(|| RoundPart {
            axes: self.axes.clone(),
            stride,
            count,
            total,
            radius: self.radius,
        })
    }

    /// The vertices of that polytope; zero on other axes.
    pub(crate) fn faceted_vertices<const N: usize>(&self) -> Vec<Vector<N>> {
        let place = |own: &[f64]| {
            let mut point = Vector::ZERO;
            self.axes.iter().zip(own).for_each(|(&axis, &c)| point[axis] = c);
            point
        };
        self.faceted.vertices.chunks(self.axes.len()).map(place).collect()
    }

    /// The centre, and the second moments about it per unit volume; zero on other axes.
    pub(crate) fn placed_moments<const N: usize>(&self) -> (Vector<N>, Matrix<N>) {
        let mut centre = Vector::ZERO;
        let mut second = Matrix::ZERO;
        for (i, &row) in self.axes.iter().enumerate() {
            centre[row] = self.centre[i];
            for (j, &column) in self.axes.iter().enumerate() {
                second[row][column] = self.second_moments[i * self.axes.len() + j] / self.volume;
            }
        }
        (centre, second)
    }

    /// Puts the farthest point in `direction` into the coordinates that are this factor's.
    pub(crate) fn support<const N: usize>(&self, direction: Vector<N>, point: &mut Vector<N>) {
        let along = |corner: &[f64]| self.axes.iter().zip(corner).map(|(&axis, c)| direction[axis] * c).sum::<f64>();
        let mut best: (&[f64], f64) = (&[], f64::NEG_INFINITY);
        for corner in self.corners.chunks(self.axes.len()) {
            let distance = along(corner);
            if distance > best.1 {
                best = (corner, distance);
            }
        }
        let own = Vector::<N>::from_fn(|axis| if self.axes.contains(&axis) { direction[axis] } else { 0.0 });
        let outward = own.normalize_or_zero() * self.radius;
        for (&axis, &c) in self.axes.iter().zip(best.0) {
            point[axis] = c + outward[axis];
        }
    }
}

/// Length of the part of a unit normal below which a factor stands along the hyperplane.
const BLIND: f64 = 1e-12;

/// Simplices that fill a core.
fn filling<const K: usize>(core: &Core<K>) -> Result<Vec<Simplex<K>>> {
    let corners = core.corners();
    if K == 1 {
        return Ok(density::simplices(&corners, &[vec![0, 1]]));
    }
    let polytope = match core {
        Core::Polytope(polytope) => Arc::clone(polytope),
        _ => Arc::new(Polytope::from_points(&corners)?),
    };
    Ok(density::filling(&polytope))
}

impl Faceted {
    /// The polytope of a convex shape, and how far the two are apart at most.
    fn of_convex<const K: usize>(convex: &Convex<K>, coarser: f64) -> Result<(Self, f64)> {
        if K == 1 {
            let reach = convex.support(Vector::unit(0))[0];
            let start = convex.support(-Vector::unit(0))[0];
            let end = |normal: f64, offset: f64, vertex: u32| FactorFacet {
                normal: vec![normal],
                offset,
                vertices: vec![vertex],
                // They share no face at all.
                neighbours: Vec::new(),
            };
            return Ok((
                Self { vertices: vec![start, reach], facets: vec![end(-1.0, -start, 0), end(1.0, reach, 1)] },
                0.0,
            ));
        }
        if convex.radius == 0.0 {
            let polytope = match &convex.core {
                Core::Polytope(polytope) => Arc::clone(polytope),
                core => Arc::new(Polytope::from_points(&core.corners())?),
            };
            return Ok((Self::of_polytope(&polytope), 0.0));
        }
        // A polytope inside the shape, grown by half of what it may leave out.
        let Some(part) = FACETING.get(K) else {
            let most = FACETING.len() - 1;
            let message =
                format!("a curved factor of a product has {K} dimensions: the limit is {most}; use a polytope");
            return Err(GeometryError::new(Unsupported, message));
        };
        let error = (part * coarser).min(COARSEST) * convex.radius;
        let inner = approximate(convex, error)?;
        let centre = inner.vertex_mean();
        let inner = inner.translated(-centre);
        let inradius = inner.facets().iter().map(|facet| facet.offset).fold(f64::INFINITY, f64::min);
        let grown = inner.scaled(1.0 + 0.5 * error / inradius)?.translated(centre);
        let outward = 0.5 * error * grown.bounding_radius() / inradius;
        Ok((Self::of_polytope(&grown), outward.max(0.5 * error)))
    }

    fn of_polytope<const K: usize>(polytope: &Polytope<K>) -> Self {
        let facet = |facet: &Facet<K>| FactorFacet {
            normal: facet.normal.iter().collect(),
            offset: facet.offset,
            vertices: facet.vertices.clone(),
            neighbours: facet.neighbours.clone(),
        };
        Self {
            vertices: polytope.vertices().iter().flat_map(|v| v.0).collect(),
            facets: polytope.facets().iter().map(facet).collect(),
        }
    }
}

/// A product with at least one curved factor.
#[derive(Clone, Debug)]
pub struct Product<const N: usize> {
    factors: Vec<ConvexFactor>,
    faceted: Arc<Polytope<N>>,
    faceting: f64,
}

impl<const N: usize> SupportMap<N> for Product<N> {
    fn support(&self, direction: Vector<N>) -> Vector<N> {
        let mut point = Vector::ZERO;
        for factor in &self.factors {
            factor.support(direction, &mut point);
        }
        point
    }

    fn section_volume(&self, normal: Vector<N>, offset: f64, tolerance: f64) -> f64 {
        let mut across = 1.0;
        let mut terms = Vec::with_capacity(self.factors.len());
        for factor in &self.factors {
            match factor.term(normal) {
                Some(term) => terms.push(term),
                None => across *= factor.volume,
            }
        }
        across * density::of_sum(&terms, offset, tolerance / across)
    }
}

impl<const N: usize> Product<N> {
    pub(crate) fn factors(&self) -> &[ConvexFactor] {
        &self.factors
    }

    /// The polytope that contacts see.
    #[must_use]
    pub fn faceted(&self) -> &Arc<Polytope<N>> {
        &self.faceted
    }

    /// How far the surface of that polytope is from that of the product at most, in metres.
    #[must_use]
    pub fn faceting(&self) -> f64 {
        self.faceting
    }

    /// Mass properties at unit density: volumes multiply, and second moments per volume stand side by side.
    pub(crate) fn unit_properties(&self) -> MassProperties<N> {
        let volume: f64 = self.factors.iter().map(|factor| factor.volume).product();
        let mut centre = Vector::ZERO;
        let mut second_moments = Matrix::ZERO;
        for factor in &self.factors {
            let (own_centre, own_second) = factor.placed_moments::<N>();
            centre += own_centre;
            second_moments += own_second * volume;
        }
        MassProperties { mass: volume, centre, second_moments }
    }
}

/// The product of convex factors, whose axes are all axes once.
fn of_convex<const N: usize>(factors: Vec<ConvexFactor>) -> Result<Shape<N>> {
    let factors = within_limit(factors)?;
    let polytope = Arc::new(multiply::<N>(&factors)?);
    let faceting = factors.iter().map(|factor| factor.faceting).fold(0.0, f64::max);
    if factors.iter().all(ConvexFactor::is_flat) {
        return Shape::polytope(polytope);
    }
    Ok(Shape::Product(Arc::new(Product { factors, faceted: polytope, faceting })))
}

/// The factors with as many facets as their product has room for.
fn within_limit(mut factors: Vec<ConvexFactor>) -> Result<Vec<ConvexFactor>> {
    let mut coarser = 1.0;
    while vertex_counts(&factors).iter().product::<usize>() > MAX_PRODUCT_VERTICES && coarser < MOST_COARSER {
        coarser *= COARSENING;
        for factor in &mut factors {
            if let Some(faceted) = factor.measure.faceted(coarser) {
                (factor.faceted, factor.faceting) = faceted?;
            }
        }
    }
    Ok(factors)
}

fn vertex_counts(factors: &[ConvexFactor]) -> Vec<usize> {
    factors.iter().map(|factor| factor.faceted.vertices.len() / factor.axes.len()).collect()
}

/// The product of the factors' polytopes. Vertex numbers count through the factors, the first one fastest.
fn multiply<const N: usize>(factors: &[ConvexFactor]) -> Result<Polytope<N>> {
    let counts = vertex_counts(factors);
    let total = counts.iter().fold(1_usize, |product, &count| product.saturating_mul(count));
    if total > MAX_PRODUCT_VERTICES {
        return Err(GeometryError::new(
            BadCount,
            format!(
                "a product of factors with {counts:?} vertices would have {total}: the limit is {MAX_PRODUCT_VERTICES}"
            ),
        ));
    }
    let vertex = |mut number: usize| {
        let mut point = Vector::<N>::ZERO;
        for (factor, &count) in factors.iter().zip(&counts) {
            let size = factor.axes.len();
            let own = &factor.faceted.vertices[number % count * size..];
            factor.axes.iter().zip(own).for_each(|(&axis, &c)| point[axis] = c);
            number /= count;
        }
        point
    };
    let vertices: Vec<Vector<N>> = (0..total).map(vertex).collect();
    let first_facet = |index: usize| factors[..index].iter().map(|f| f.faceted.facets.len()).sum::<usize>();
    let facet_total = first_facet(factors.len()) as u32;
    let mut facets: Vec<Facet<N>> = Vec::new();
    for (index, factor) in factors.iter().enumerate() {
        let step: usize = counts[..index].iter().product();
        let own = first_facet(index) as u32..first_facet(index + 1) as u32;
        for facet in &factor.faceted.facets {
            let mut normal = Vector::ZERO;
            factor.axes.iter().zip(&facet.normal).for_each(|(&axis, &c)| normal[axis] = c);
            let holds = |number: &u32| {
                facet.vertices.binary_search(&((*number as usize / step % counts[index]) as u32)).is_ok()
            };
            let beside = facet.neighbours.iter().map(|neighbour| own.start + neighbour);
            let mut neighbours: Vec<u32> =
                (0..facet_total).filter(|other| !own.contains(other)).chain(beside).collect();
            neighbours.sort_unstable();
            facets.push(Facet {
                normal,
                offset: facet.offset,
                vertices: (0..total as u32).filter(holds).collect(),
                neighbours,
            });
        }
    }
    let stride = |index: usize| counts[..index].iter().product::<usize>();
    let round = factors.iter().enumerate().filter_map(|(index, factor)| factor.round_part(stride(index), total));
    Ok(Polytope::from_parts(vertices, facets).standing_for(round.collect()))
}
