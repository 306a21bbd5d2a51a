//! Shapes.

use super::cursor::{At, join, unknown_key};
use super::{Result, rotation};
use crate::error::SceneError;
use crate::model::{Factor, Part, PolytopeSpec, RotationSpec, ShapeSpec, Size};

/// The shapes that this version builds.
pub(crate) const SHAPES: [&str; 11] =
    ["ball", "box", "half_space", "capsule", "polytope", "rounded", "product", "pyramid", "star", "mesh", "compound"];

/// What shapes are called here that people know by other names.
const OTHER_NAMES: [(&str, &str); 17] = [
    ("sphere", "\"ball\""),
    ("hypersphere", "\"ball\""),
    ("disc", "\"ball\" in 2D"),
    ("cuboid", "\"box\""),
    ("cube", "\"box\""),
    ("tesseract", "\"box\""),
    ("plane", "\"half_space\""),
    ("cylinder", "\"product\" of a ball and a segment"),
    ("spherinder", "\"product\" of a ball and a segment"),
    ("cubinder", "\"product\" of a ball and a box"),
    ("duocylinder", "\"product\" of two balls"),
    ("prism", "\"product\" of a polytope and a segment"),
    ("duoprism", "\"product\" of two polygons"),
    ("cone", "\"pyramid\" over a ball"),
    ("union", "\"compound\""),
    ("hull", "\"polytope\" with \"vertices\""),
    ("torus", "a \"mesh\" from an OFF file, as curved bodies are convex"),
];

/// How a shape is made here that people call so.
pub(crate) fn made_as(name: &str) -> Option<&'static str> {
    let lower = name.to_lowercase();
    OTHER_NAMES.iter().find(|(other, _)| *other == lower).map(|(_, own)| *own)
}

pub(crate) fn shape(at: &At<'_>) -> Result<ShapeSpec> {
    let (key, inner) = at.variant("the kind of shape", &SHAPES)?;
    match key {
        "ball" => Ok(ShapeSpec::Ball { radius: inner.fields("a ball", &["radius"])?.required("radius")?.number()? }),
        "box" => {
            let fields = inner.fields("a box", &["half_extents"])?;
            Ok(ShapeSpec::Box { half_extents: fields.required("half_extents")?.numbers()? })
        }
        "half_space" => {
            let fields = inner.fields("a half-space", &["normal", "offset"])?;
            let offset = fields.or("offset", 0.0, At::number)?;
            Ok(ShapeSpec::HalfSpace { normal: fields.required("normal")?.numbers()?, offset })
        }
        "capsule" => {
            let fields = inner.fields("a capsule", &["half_length", "radius", "along"])?;
            Ok(ShapeSpec::Capsule {
                half_length: fields.required("half_length")?.number()?,
                radius: fields.required("radius")?.number()?,
                along: fields.required("along")?.text()?,
            })
        }
        "polytope" => Ok(ShapeSpec::Polytope(polytope(&inner)?)),
        "rounded" => {
            let fields = inner.fields("a rounded shape", &["shape", "radius"])?;
            let core = Box::new(shape(&fields.required("shape")?)?);
            Ok(ShapeSpec::Rounded { shape: core, radius: fields.required("radius")?.number()? })
        }
        "product" => {
            let fields = inner.fields("a product", &["factors"])?;
            let factors = fields.required("factors")?.list("a list of factors")?;
            Ok(ShapeSpec::Product { factors: factors.iter().map(factor).collect::<Result<_>>()? })
        }
        "pyramid" => {
            let fields = inner.fields("a pyramid", &["base", "height"])?;
            let base = Box::new(factor(&fields.required("base")?)?);
            Ok(ShapeSpec::Pyramid { base, height: fields.required("height")?.number()? })
        }
        "star" => {
            let fields = inner.fields("a star polytope", &["regular", "circumradius", "edge"])?;
            let name = fields.required("regular")?.text()?;
            let size = match (fields.optional("circumradius"), fields.optional("edge")) {
                (Some(radius), None) => Size::Circumradius(radius.number()?),
                (None, Some(edge)) => Size::Edge(edge.number()?),
                _ => {
                    let message = "needs one of \"circumradius\" and \"edge\" for its size";
                    return Err(SceneError::structure(&inner.path, message));
                }
            };
            Ok(ShapeSpec::Star { name, size })
        }
        "mesh" => Ok(ShapeSpec::Mesh { file: inner.fields("a mesh", &["file"])?.required("file")?.text()? }),
        "compound" => {
            let fields = inner.fields("a compound", &["parts"])?;
            let parts = fields.required("parts")?.list("a list of parts")?;
            Ok(ShapeSpec::Compound { parts: parts.iter().map(part).collect::<Result<_>>()? })
        }
        key => Err(match made_as(key) {
            Some(own) => {
                let message = format!("unknown key \"{key}\": it is {own} here (known: {})", SHAPES.join(", "));
                SceneError::structure(join(&at.path, key), message)
            }
            None => unknown_key(&at.path, key, &SHAPES),
        }),
    }
}

fn polytope(at: &At<'_>) -> Result<PolytopeSpec> {
    let fields = at.fields("a polytope", &["vertices", "regular", "circumradius", "edge", "file"])?;
    let size = match (fields.optional("circumradius"), fields.optional("edge")) {
        (Some(radius), None) => Some(Size::Circumradius(radius.number()?)),
        (None, Some(edge)) => Some(Size::Edge(edge.number()?)),
        (None, None) => None,
        (Some(_), Some(_)) => {
            return Err(SceneError::structure(&at.path, "has both \"circumradius\" and \"edge\"; give one of them"));
        }
    };
    match (fields.optional("vertices"), fields.optional("regular"), fields.optional("file"), size) {
        (Some(vertices), None, None, None) => Ok(PolytopeSpec::Vertices(vertices.rows()?)),
        (None, Some(name), None, Some(size)) => Ok(PolytopeSpec::Regular { name: name.text()?, size }),
        (None, Some(_), None, None) => {
            Err(SceneError::structure(&at.path, "is regular but has no size; add \"circumradius\" or \"edge\""))
        }
        (None, None, Some(file), None) => Ok(PolytopeSpec::File(file.text()?)),
        (_, None, _, Some(_)) => Err(SceneError::structure(
            &at.path,
            "has \"circumradius\" or \"edge\" without \"regular\"; vertices and files have the size that they have",
        )),
        _ => {
            let message =
                "needs exactly one of \"vertices\", \"regular\" (with \"circumradius\" or \"edge\") and \"file\"";
            Err(SceneError::structure(&at.path, message))
        }
    }
}

fn factor(at: &At<'_>) -> Result<Factor> {
    let fields = at.fields("a factor: an object with \"shape\" and \"axes\"", &["shape", "axes"])?;
    Ok(Factor { shape: shape(&fields.required("shape")?)?, axes: fields.required("axes")?.text()? })
}

fn part(at: &At<'_>) -> Result<Part> {
    let fields = at.fields("a part: an object with \"shape\"", &["shape", "position", "rotation"])?;
    Ok(Part {
        shape: shape(&fields.required("shape")?)?,
        position: fields.or("position", Vec::new(), At::coordinates)?,
        rotation: fields.or("rotation", RotationSpec::default(), rotation::rotation)?,
    })
}
