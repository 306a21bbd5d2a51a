//! Factors of products: shapes of as many dimensions as they have axes.

use hyperbody::geometry::product::Factor;
use hyperbody::math::{Dim, EvenAlgebra};

use super::shape::{ShapeBuilder, axis};
use super::{Result, shape_error};
use crate::dimension::{DimensionVisitor, visit_dimension};
use crate::error::SceneError;
use crate::model::{self, Beside, ShapeSpec};

/// The factor that stands at `path`, of a product in `N` dimensions.
pub(super) fn factor<const N: usize>(
    factor: &model::Factor,
    beside: Beside<'_>,
    path: &str,
    depth: usize,
) -> Result<Factor> {
    let place = format!("{path}.axes");
    let axes: Result<Vec<usize>> =
        factor.axes.chars().map(|letter| axis::<N>(letter.encode_utf8(&mut [0; 4]), &place)).collect();
    let axes = axes?;
    if let [only] = axes[..] {
        return segment(&factor.shape, only, path);
    }
    let build = BuildFactor { spec: &factor.shape, axes: &axes, beside, path, depth };
    visit_dimension(axes.len(), build).unwrap_or_else(|| {
        let message = format!("names {} axes; a factor has 1 to {}, such as \"xw\"", axes.len(), N - 1);
        Err(SceneError::value(place, message))
    })
}

/// In one dimension there is only one shape.
fn segment(spec: &ShapeSpec, axis: usize, path: &str) -> Result<Factor> {
    let half_length = match spec {
        ShapeSpec::Ball { radius } => *radius,
        ShapeSpec::Box { half_extents } if half_extents.len() == 1 => half_extents[0],
        _ => {
            let message =
                "has one axis: it has to be a box with one half-extent, or a ball, which is a segment there too";
            return Err(SceneError::value(format!("{path}.shape"), message));
        }
    };
    Factor::segment(axis, half_length).map_err(|error| shape_error(&format!("{path}.shape"), &error))
}

struct BuildFactor<'a> {
    spec: &'a ShapeSpec,
    axes: &'a [usize],
    beside: Beside<'a>,
    path: &'a str,
    depth: usize,
}

impl DimensionVisitor for BuildFactor<'_> {
    type Output = Result<Factor>;

    fn visit<const K: usize>(self) -> Result<Factor>
    where
        Dim<K>: EvenAlgebra,
    {
        let place = format!("{}.shape", self.path);
        let shape = ShapeBuilder::<K>::new(self.beside).shape_at_depth(self.spec, &place, self.depth + 1)?;
        let axes: [usize; K] = std::array::from_fn(|i| self.axes[i]);
        Factor::new(axes, &shape).map_err(|error| shape_error(&place, &error))
    }
}
