//! Factors of products: shapes of as many dimensions as they have axes.

use hyperbody::geometry::product::Factor;
use hyperbody::math::planes::AXIS_NAMES;
use hyperbody::math::{Dim, EvenAlgebra};
use hyperbody::prelude::Shape;

use super::shape::{ShapeBuilder, UNKNOWN_AXIS, axis};
use super::{Result, shape_error};
use crate::dimension::{DimensionVisitor, visit_dimension};
use crate::error::{ErrorKind, SceneError};
use crate::model::{self, Beside, ShapeSpec};

/// The factors that stand at `path`, of a product in `N` dimensions. Factors that are products of curved shapes themselves are
/// taken apart into theirs.
pub(super) fn factors<const N: usize>(
    factors: &[model::Factor],
    beside: Beside<'_>,
    path: &str,
    depth: usize,
) -> Result<Vec<Factor>> {
    let mut made = Vec::with_capacity(factors.len());
    for (index, factor) in factors.iter().enumerate() {
        let path = format!("{path}[{index}]");
        match &factor.shape {
            ShapeSpec::Product { factors: inner } if is_curved(&factor.shape, &factor.axes) => {
                let path = format!("{path}.shape.product.factors");
                let outer = outer_axes(inner, &factor.axes, &path)?;
                made.extend(self::factors::<N>(&outer, beside, &path, depth + 1)?);
            }
            _ => made.push(self::factor::<N>(factor, Role::Factor, beside, &path, depth)?),
        }
    }
    Ok(made)
}

/// The base that stands at `path`, of a pyramid in `N` dimensions.
pub(super) fn base<const N: usize>(
    base: &model::Factor,
    beside: Beside<'_>,
    path: &str,
    depth: usize,
) -> Result<Factor> {
    factor::<N>(base, Role::Base, beside, path, depth)
}

/// What a shape of lower dimension is part of.
#[derive(Clone, Copy)]
enum Role {
    Factor,
    Base,
}

impl Role {
    /// What cannot stand there.
    fn check<const K: usize>(self, shape: &Shape<K>, path: &str) -> Result<()> {
        let what = match shape {
            Shape::Product(_) => "a product with curved factors, which is not supported there",
            Shape::Pyramid(_) => "a cone, which is not supported there: use a pyramid over a polytope",
            Shape::HalfSpace { .. } => "a half-space, which has no end: use a long box",
            _ => return Ok(()),
        };
        let place = match self {
            Self::Factor => "a factor of a product",
            Self::Base => "the base of a pyramid",
        };
        Err(SceneError::new(ErrorKind::Shape, path, format!("{place} is {what}")))
    }
}

/// Whether a shape is not a polytope, of those that can be factors.
fn is_curved(shape: &ShapeSpec, axes: &str) -> bool {
    match shape {
        ShapeSpec::Ball { .. } => axes.chars().count() > 1,
        ShapeSpec::Capsule { .. } | ShapeSpec::Rounded { .. } => true,
        ShapeSpec::Product { factors } => factors.iter().any(|factor| is_curved(&factor.shape, &factor.axes)),
        _ => false,
    }
}

/// The factors of a factor on the axes of the whole, which its own x, y, … stand for.
fn outer_axes(inner: &[model::Factor], axes: &str, path: &str) -> Result<Vec<model::Factor>> {
    let outer: Vec<char> = axes.chars().collect();
    if outer.len() > AXIS_NAMES.len() {
        let message = format!("are {} axes; a factor has at most {}", outer.len(), AXIS_NAMES.len() - 1);
        return Err(SceneError::value(path, message));
    }
    check_axes(outer.len(), inner, path).map_err(|error| error.explained("", &renamed(Role::Factor, &outer)))?;
    let rename = |letter: char| AXIS_NAMES.iter().position(|&name| name == letter).and_then(|axis| outer.get(axis));
    let mut renamed_factors = inner.to_vec();
    for (index, factor) in renamed_factors.iter_mut().enumerate() {
        let axes: Option<String> = factor.axes.chars().map(rename).collect();
        let Some(axes) = axes else {
            let message = format!("{UNKNOWN_AXIS} among \"{}\"{}", factor.axes, renamed(Role::Factor, &outer));
            return Err(SceneError::value(format!("{path}[{index}].axes"), message));
        };
        factor.axes = axes;
    }
    Ok(renamed_factors)
}

/// What axes of the whole are called inside a factor or base.
fn renamed(role: Role, outer: &[char]) -> String {
    if outer == &AXIS_NAMES[..outer.len()] {
        return String::new();
    }
    let list = |axes: &[char]| axes.iter().map(char::to_string).collect::<Vec<_>>().join(", ");
    let place = match role {
        Role::Factor => "factor",
        Role::Base => "base",
    };
    format!("; inside this {place} its axes {} are called {}", list(outer), list(&AXIS_NAMES[..outer.len()]))
}

/// The factor or base that stands at `path`, in `N` dimensions.
fn factor<const N: usize>(
    factor: &model::Factor,
    role: Role,
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
    let build = BuildFactor { spec: &factor.shape, axes: &axes, role, beside, path, depth };
    visit_dimension(axes.len(), build).unwrap_or_else(|| {
        let message = format!("names {} axes; a factor has 1 to {}, such as \"xw\"", axes.len(), N - 1);
        Err(SceneError::value(place, message))
    })
}

/// Refuses a product unless it has two factors or more and each axis belongs to one of them.
pub(super) fn check_axes(dimension: usize, factors: &[model::Factor], path: &str) -> Result<()> {
    if factors.len() < 2 {
        let message = format!("holds {} factors; a product has two or more, with axes of their own", factors.len());
        return Err(SceneError::value(path, message));
    }
    let all: String = factors.iter().map(|factor| factor.axes.as_str()).collect();
    let (twice, missing) = twice_and_missing(dimension, &all);
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
        "name {} on the axes {}; in {dimension} dimensions each of {} belongs to exactly one factor",
        wrong.join(" and "),
        named.join(", "),
        AXIS_NAMES[..dimension].iter().map(char::to_string).collect::<Vec<_>>().join(", ")
    );
    Err(SceneError::value(path, message))
}

/// Refuses the base of a pyramid unless it has all axes but one.
pub(super) fn check_base_axes<const N: usize>(axes: &str, path: &str) -> Result<()> {
    axes.chars().try_for_each(|letter| axis::<N>(letter.encode_utf8(&mut [0; 4]), path).map(|_| ()))?;
    let (twice, missing) = twice_and_missing(N, axes);
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

/// Names of the axes of so many dimensions that stand more than once in `axes`, and of those that do not.
fn twice_and_missing(dimension: usize, axes: &str) -> (Vec<String>, Vec<String>) {
    let count = |name: &&char| axes.chars().filter(|letter| letter == *name).count();
    let of = |wanted: fn(usize) -> bool| {
        AXIS_NAMES[..dimension].iter().filter(|name| wanted(count(name))).map(char::to_string).collect::<Vec<_>>()
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
    role: Role,
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
        let outer: Vec<char> = self.axes.iter().map(|&axis| AXIS_NAMES[axis]).collect();
        let shape = ShapeBuilder::<K>::new(self.beside)
            .shape_at_depth(self.spec, &place, self.depth + 1)
            .map_err(|error| error.explained(UNKNOWN_AXIS, &renamed(self.role, &outer)))?;
        self.role.check(&shape, &place)?;
        let axes: [usize; K] = std::array::from_fn(|i| self.axes[i]);
        Factor::new(axes, &shape).map_err(|error| shape_error(&place, &error))
    }
}
