//! Products of shapes of several convex pieces: (A ∪ B) × C is (A × C) ∪ (B × C), and where pieces do not overlap neither do their products.
//! A piece that stands elsewhere in its factor moves its products by the same pose, on the axes of the factor.

use hyperbody_math::{Matrix, Pose, Rotation, Vector};

use super::{ConvexFactor, of_convex};
use crate::error::GeometryErrorKind::BadCount;
use crate::tolerances::MAX_PRODUCT_PIECES;
use crate::{GeometryError, Result, Shape};

/// One factor of a product: a shape of lower dimension on some of the axes.
#[derive(Clone, Debug)]
pub struct Factor {
    axes: Vec<usize>,
    /// At least one.
    pieces: Vec<FactorPiece>,
}

/// A convex piece of a factor, and where it stands in it.
#[derive(Clone, Debug)]
pub(crate) struct FactorPiece {
    pub(crate) convex: ConvexFactor,
    /// Columns of the rotation, one behind the other.
    turn: Vec<f64>,
    shift: Vec<f64>,
}

impl Factor {
    /// A segment from −`half_length` to `half_length` on one axis.
    ///
    /// # Errors
    /// If the half-length is not a number of metres in the range of lengths.
    pub fn segment(axis: usize, half_length: f64) -> Result<Self> {
        Self::new([axis], &Shape::<1>::cuboid([half_length])?)
    }

    /// A shape of `K` dimensions whose i-th axis is axis `axes[i]` of the product. It has to be bounded. A compound, such as the cells of a
    /// star or a mesh, is a factor of several pieces.
    ///
    /// # Errors
    /// `Unsupported` for half-spaces, cones and products (give the factors of a product one by one), also as parts of a compound, and for
    /// curved shapes of more than four dimensions, which contacts would need too many facets for.
    pub fn new<const K: usize>(axes: [usize; K], shape: &Shape<K>) -> Result<Self> {
        let Shape::Compound { parts } = shape else { return Ok(Self::from(ConvexFactor::new(axes, shape)?)) };
        let piece = |(pose, part): &(Pose<K>, Shape<K>)| {
            let turn = (0..K).flat_map(|column| pose.rotation.matrix().column(column).0).collect();
            Ok(FactorPiece { convex: ConvexFactor::new(axes, part)?, turn, shift: pose.translation.0.to_vec() })
        };
        Ok(Self { axes: axes.to_vec(), pieces: parts.iter().map(piece).collect::<Result<_>>()? })
    }

    pub(crate) fn axes(&self) -> &[usize] {
        &self.axes
    }

    pub(crate) fn pieces(&self) -> &[FactorPiece] {
        &self.pieces
    }
}

impl From<ConvexFactor> for Factor {
    fn from(convex: ConvexFactor) -> Self {
        let axes = convex.axes().to_vec();
        let count = axes.len();
        let turn = (0..count * count).map(|k| if k % (count + 1) == 0 { 1.0 } else { 0.0 }).collect();
        Self { axes, pieces: vec![FactorPiece { convex, turn, shift: vec![0.0; count] }] }
    }
}

impl FactorPiece {
    /// Puts the pose of the piece into those rows and columns that are its axes.
    fn place<const N: usize>(&self, turn: &mut Matrix<N>, shift: &mut Vector<N>) {
        let axes = self.convex.axes();
        for (i, &row) in axes.iter().enumerate() {
            shift[row] = self.shift[i];
            for (j, &column) in axes.iter().enumerate() {
                turn[row][column] = self.turn[j * axes.len() + i];
            }
        }
    }

    /// Where products with the piece stand: as the piece in its factor.
    pub(crate) fn pose<const N: usize>(&self) -> Pose<N> {
        pose_of(&[self])
    }

    /// Whether the piece is where it is in its own frame, but for a turn.
    pub(crate) fn is_centred(&self) -> bool {
        self.shift.iter().all(|&c| c == 0.0)
    }
}

/// The pose of a product of pieces.
fn pose_of<const N: usize>(pieces: &[&FactorPiece]) -> Pose<N> {
    let (mut turn, mut shift) = (Matrix::IDENTITY, Vector::ZERO);
    pieces.iter().for_each(|piece| piece.place(&mut turn, &mut shift));
    // Blocks that are rotations make a rotation.
    Pose::new(Rotation::from_matrix(turn).unwrap_or(Rotation::IDENTITY), shift)
}

/// A convex shape where it has its own frame, and a compound of all others.
pub(crate) fn in_place<const N: usize>(mut parts: Vec<(Pose<N>, Shape<N>)>) -> Result<Shape<N>> {
    match parts.pop() {
        Some((pose, shape)) if parts.is_empty() && pose == Pose::IDENTITY => Ok(shape),
        last => {
            parts.extend(last);
            Shape::compound(parts)
        }
    }
}

impl<const N: usize> Shape<N> {
    /// The product of shapes of lower dimension, each on axes of its own: a polytope if all factors are, and otherwise a
    /// [`Shape::Product`]. Where contacts would need more than [`MAX_PRODUCT_VERTICES`] vertices, curved factors get fewer than
    /// usual: [`Product::faceting`] says how far that is from the shape. Factors of several pieces make a compound of the
    /// products of all pieces.
    ///
    /// # Errors
    /// `BadCount` unless there are two factors or more whose axes are all axes once, if even with fewer facets contacts would
    /// need more than [`MAX_PRODUCT_VERTICES`] vertices, or if there would be more than [`MAX_PRODUCT_PIECES`] pieces.
    ///
    /// [`MAX_PRODUCT_VERTICES`]: crate::tolerances::MAX_PRODUCT_VERTICES
    /// [`Product::faceting`]: super::Product::faceting
    ///
    /// ```
    /// use hyperbody_geometry::product::Factor;
    /// use hyperbody_geometry::regular::Size;
    /// use hyperbody_geometry::{Shape, star};
    /// use hyperbody_math::Pose;
    /// let cells = star::cells::<2>(&star::symbol("{5/2}")?, Size::Circumradius(1.0), 10)?;
    /// let parts = cells.into_iter().map(|cell| Ok((Pose::IDENTITY, Shape::polytope(cell.into())?)));
    /// let pentagram = Shape::compound(parts.collect::<Result<_, hyperbody_geometry::GeometryError>>()?)?;
    /// let prism = Shape::<3>::product(vec![Factor::new([0, 1], &pentagram)?, Factor::segment(2, 0.5)?])?;
    /// let area = pentagram.mass_properties(1.0)?.mass;
    /// assert!((prism.mass_properties(1.0)?.mass - area).abs() < 1e-12);
    /// # Ok::<(), hyperbody_geometry::GeometryError>(())
    /// ```
    pub fn product(factors: Vec<Factor>) -> Result<Self> {
        let refuse = |message| Err(GeometryError::new(BadCount, message));
        let mut axes: Vec<usize> = factors.iter().flat_map(|factor| factor.axes.iter().copied()).collect();
        axes.sort_unstable();
        if factors.len() < 2 || axes != (0..N).collect::<Vec<_>>() {
            return refuse(format!(
                "a product has {} factors on the axes {axes:?}: it needs two or more, whose axes are 0 to {} once each",
                factors.len(),
                N - 1
            ));
        }
        let counts: Vec<usize> = factors.iter().map(|factor| factor.pieces.len()).collect();
        let total = counts.iter().fold(1_usize, |product, &count| product.saturating_mul(count));
        if total > MAX_PRODUCT_PIECES {
            return refuse(format!(
                "a product of factors of {counts:?} convex pieces would have {total}: the limit is {MAX_PRODUCT_PIECES}"
            ));
        }
        let part = |mut number: usize| {
            let mut chosen: Vec<&FactorPiece> = Vec::with_capacity(factors.len());
            for factor in &factors {
                chosen.push(&factor.pieces[number % factor.pieces.len()]);
                number /= factor.pieces.len();
            }
            let shape = of_convex::<N>(chosen.iter().map(|piece| piece.convex.clone()).collect())?;
            Ok((pose_of(&chosen), shape))
        };
        in_place((0..total).map(part).collect::<Result<_>>()?)
    }
}
