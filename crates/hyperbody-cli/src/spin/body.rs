//! Which body spins: from its second moments, its moments of inertia, or its shape.

use std::path::Path;

use hyperbody::dynamics::free_top::{FreeTop, FreeTopError, FreeTopErrorKind};
use hyperbody::geometry::regular::{Regular, Size};
use hyperbody::math::{Dim, EvenAlgebra, Vector, planes};
use hyperbody::prelude::Shape;
use hyperbody_scene::{DIMENSIONS, DimensionVisitor, ShapeFile, visit_dimension};

use super::arguments::SpinArguments;
use crate::failure::Failure;

/// A body of a dimension known at run time only.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Body {
    /// Second moments by principal axis; there are as many as dimensions.
    pub(super) moments: Vec<f64>,
    /// Unit of the moments: of a shape they are per unit mass.
    pub(super) unit: &'static str,
}

impl Body {
    /// The body that the arguments name.
    pub(super) fn from_arguments(arguments: &SpinArguments) -> Result<Self, Failure> {
        if arguments.dimension.is_some() && arguments.shape.is_none() {
            return Err(Failure::Input(
                "--dimension: is for a --shape that does not tell its own; --moments and --inertia do by their number"
                    .to_owned(),
            ));
        }
        if let Some(text) = &arguments.moments {
            from_moments(text)
        } else if let Some(text) = &arguments.inertia {
            from_inertia(text)
        } else {
            let name = arguments.shape.as_deref().unwrap_or_default();
            from_shape(name, arguments.dimension.map(usize::from))
        }
    }

    pub(super) fn dimension(&self) -> usize {
        self.moments.len()
    }

    /// The body in `N` dimensions; `N` has to be [`Body::dimension`].
    pub(super) fn top<const N: usize>(&self) -> Result<FreeTop<N>, Failure> {
        let moments = Vector::from_slice(&self.moments).ok_or_else(|| no_such_dimension(self.dimension()))?;
        FreeTop::new(moments).map_err(|error| refused("--moments", &error))
    }
}

/// A refusal with the option that caused it: `option`, unless the error itself tells.
pub(super) fn refused(option: &str, error: &FreeTopError) -> Failure {
    match error.kind() {
        FreeTopErrorKind::NoConvergence => Failure::Input(format!("--dt: {error}")),
        FreeTopErrorKind::Tolerance => Failure::Input(format!("--tolerance: {error}")),
        _ => Failure::Input(format!("{option}: {error}")),
    }
}

/// What to say of a dimension that [`visit_dimension`] does not know.
pub(super) fn no_such_dimension(dimension: usize) -> Failure {
    Failure::Input(format!("there are no bodies of {dimension} dimensions here; there are those of 2 to 6"))
}

/// Numbers separated by commas.
pub(super) fn numbers(option: &str, text: &str) -> Result<Vec<f64>, Failure> {
    let number = |part: &str| {
        let part = part.trim();
        part.parse::<f64>().map_err(|_| {
            Failure::Input(format!(
                "{option}: \"{part}\" is not a number; give numbers separated by commas, such as 4,3,2,1"
            ))
        })
    };
    text.split(',').map(number).collect()
}

fn from_moments(text: &str) -> Result<Body, Failure> {
    let moments = numbers("--moments", text)?;
    if !DIMENSIONS.contains(&moments.len()) {
        return Err(Failure::Input(format!(
            "--moments: a body has one for each axis, so 2 to 6 of them, and not {}",
            moments.len()
        )));
    }
    let body = Body { moments, unit: "kg m²" };
    visit_dimension(body.dimension(), Check(&body)).unwrap_or_else(|| Err(no_such_dimension(body.dimension())))?;
    Ok(body)
}

struct Check<'a>(&'a Body);

impl DimensionVisitor for Check<'_> {
    type Output = Result<(), Failure>;

    fn visit<const N: usize>(self) -> Self::Output
    where
        Dim<N>: EvenAlgebra,
    {
        self.0.top::<N>().map(|_| ())
    }
}

fn from_inertia(text: &str) -> Result<Body, Failure> {
    let count = text.split(',').count();
    let Some(dimension) = DIMENSIONS.into_iter().find(|&dimension| planes::count(dimension) == count) else {
        return Err(Failure::Input(format!(
            "--inertia: {count} moments of inertia; give one for each plane, which are 1, 3, 6, 10 or 15 in 2 to 6 dimensions"
        )));
    };
    visit_dimension(dimension, Inertia(text)).unwrap_or_else(|| Err(no_such_dimension(dimension)))
}

struct Inertia<'a>(&'a str);

impl DimensionVisitor for Inertia<'_> {
    type Output = Result<Body, Failure>;

    fn visit<const N: usize>(self) -> Self::Output
    where
        Dim<N>: EvenAlgebra,
    {
        let mut moments = vec![f64::NAN; planes::count(N)];
        for part in self.0.split(',').map(str::trim) {
            let refuse = |what: String| Failure::Input(format!("--inertia: {what}"));
            let (name, value) = part
                .split_once('=')
                .ok_or_else(|| refuse(format!("\"{part}\" is not plane=moment, such as xy=3.2")))?;
            let (i, j) = planes::from_name(N, name.trim()).ok_or_else(|| {
                let names: Vec<String> = planes::all(N).map(|(i, j)| planes::name(i, j)).collect();
                refuse(format!("\"{}\" is no plane of {N} dimensions; the planes are {}", name.trim(), names.join(" ")))
            })?;
            let index = planes::index(N, i.min(j), i.max(j));
            if !moments[index].is_nan() {
                return Err(refuse(format!("plane {} is given twice", planes::name(i.min(j), i.max(j)))));
            }
            moments[index] = match value.trim().parse::<f64>() {
                Ok(value) if value.is_finite() => value,
                _ => {
                    return Err(refuse(format!("the moment \"{}\" of plane {name} is no finite number", value.trim())));
                }
            };
        }
        let top = FreeTop::<N>::from_plane_moments(&moments).map_err(|error| refused("--inertia", &error))?;
        Ok(Body { moments: top.principal_moments().0.to_vec(), unit: "kg m²" })
    }
}

fn from_shape(name: &str, dimension: Option<usize>) -> Result<Body, Failure> {
    let path = Path::new(name);
    if path.is_file() || path.extension().is_some() || path.components().count() > 1 {
        let file = ShapeFile::load(path, dimension).map_err(|error| {
            let message = error.to_string();
            let hint = if message.contains("does not tell its dimension") { " (--dimension N)" } else { "" };
            Failure::Input(format!("{message}{hint}"))
        })?;
        return visit_dimension(file.dimension, OfShape(Source::File(&file)))
            .unwrap_or_else(|| Err(no_such_dimension(file.dimension)));
    }
    let dimension = dimension_of_regular(name, dimension)?;
    visit_dimension(dimension, OfShape(Source::Regular(name))).unwrap_or_else(|| Err(no_such_dimension(dimension)))
}

/// The dimension of a regular polytope, from its name if that tells.
fn dimension_of_regular(name: &str, dimension: Option<usize>) -> Result<usize, Failure> {
    if let Some(dimension) = dimension {
        return Ok(dimension);
    }
    let known: Vec<usize> = DIMENSIONS.filter(|&dimension| Regular::from_name(dimension, name).is_ok()).collect();
    match known[..] {
        [dimension] => Ok(dimension),
        [] => Err(Failure::Input(format!(
            "--shape: there is no file \"{name}\" and no regular polytope of that name; give an OFF file, the shape of a \
             scene as .json, or a name such as tetrahedron, 24-cell, tesseract or 5-simplex"
        ))),
        _ => Err(Failure::Input(format!(
            "--shape: there is a \"{name}\" in {} dimensions; say which with --dimension N",
            known.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
        ))),
    }
}

enum Source<'a> {
    File(&'a ShapeFile),
    Regular(&'a str),
}

struct OfShape<'a>(Source<'a>);

impl DimensionVisitor for OfShape<'_> {
    type Output = Result<Body, Failure>;

    fn visit<const N: usize>(self) -> Self::Output
    where
        Dim<N>: EvenAlgebra,
    {
        let shape: Shape<N> = match self.0 {
            Source::File(file) => file.build::<N>()?,
            Source::Regular(name) => {
                let polytope =
                    Regular::from_name(N, name).and_then(|regular| regular.polytope(Size::Circumradius(1.0)));
                Shape::Polytope(polytope.map_err(|error| Failure::Input(format!("--shape: {error}")))?.into())
            }
        };
        let (top, _) = FreeTop::from_shape(&shape).map_err(|error| refused("--shape", &error))?;
        Ok(Body { moments: top.principal_moments().0.to_vec(), unit: "m²" })
    }
}
