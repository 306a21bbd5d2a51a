//! Factors of products: shapes of as many dimensions as they have axes.

use hyperbody::geometry::product::Factor;
use hyperbody::math::planes::AXIS_NAMES;
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

/// Refuses a product unless it has two factors or more and each axis belongs to one of them.
pub(super) fn check_axes<const N: usize>(factors: &[model::Factor], path: &str) -> Result<()> {
    if factors.len() < 2 {
        let message = format!("holds {} factors; a product has two or more, with axes of their own", factors.len());
        return Err(SceneError::value(path, message));
    }
    let all: String = factors.iter().map(|factor| factor.axes.as_str()).collect();
    let (twice, missing) = twice_and_missing::<N>(&all);
    if twice.is_empty() && missing.is_empty() {
        return Ok(());
    }
    let named: Vec<String> = factors.iter().map(|factor| format!("\"{}\"", factor.axes)).collect();
    let mut wrong = Vec::new();
    if !twice.is_empty() {
        wrong.push(format!("{} more than once", twice.join(", ")));
    }
    if !missing.is_empty() {
        wrong.push(format!("{} not at all", missing.join(", ")));
    }
    let message = format!(
        "name {} on the axes {}; in {N} dimensions each of {} belongs to exactly one factor",
        wrong.join(" and "),
        named.join(", "),
        AXIS_NAMES[..N].iter().map(char::to_string).collect::<Vec<_>>().join(", ")
    );
    Err(SceneError::value(path, message))
}

/// Refuses the base of a pyramid unless it has all axes but one.
pub(super) fn check_base_axes<const N: usize>(axes: &str, path: &str) -> Result<()> {
    axes.chars().try_for_each(|letter| axis::<N>(letter.encode_utf8(&mut [0; 4]), path).map(|_| ()))?;
    let (twice, missing) = twice_and_missing::<N>(axes);
    if twice.is_empty() && missing.len() == 1 {
        return Ok(());
    }
    let message = format!(
        "are \"{axes}\"; in {N} dimensions the base of a pyramid has {} axes, each once, and its height the one that is left: \"{}\" \
         for a pyramid along {}",
        N - 1,
        AXIS_NAMES[..N].iter().filter(|&&name| name != AXIS_NAMES[1]).collect::<String>(),
        AXIS_NAMES[1]
    );
    Err(SceneError::value(path, message))
}

/// Names of the axes of `N` dimensions that stand more than once in `axes`, and of those that do not.
fn twice_and_missing<const N: usize>(axes: &str) -> (Vec<String>, Vec<String>) {
    let count = |name: &&char| axes.chars().filter(|letter| letter == *name).count();
    let of = |wanted: fn(usize) -> bool| {
        AXIS_NAMES[..N].iter().filter(|name| wanted(count(name))).map(char::to_string).collect::<Vec<_>>()
    };
    (of(|count| count > 1), of(|count| count == 0))
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
