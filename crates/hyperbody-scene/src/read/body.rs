//! Bodies.

use super::cursor::At;
use super::{Result, rotation, shape};
use crate::error::{SceneError, nearest};
use crate::model::{Body, BodyKind};

pub(super) const BODY_KEYS: [&str; 20] = [
    "name",
    "kind",
    "shape",
    "position",
    "rotation",
    "velocity",
    "angular_velocity",
    "mass",
    "density",
    "material",
    "gravity_scale",
    "linear_damping",
    "angular_damping",
    "can_sleep",
    "surface_velocity",
    "groups",
    "meets",
    "sensor",
    "one_way",
    "colour",
];

pub(super) fn body(at: &At<'_>) -> Result<Body> {
    let fields = at.fields("a body: an object with \"shape\" and more", &BODY_KEYS)?;
    let mut body = Body::new(shape(&fields.required("shape")?)?);
    body.name = fields.or("name", None, |at| at.text().map(Some))?;
    body.kind = fields.or("kind", BodyKind::Dynamic, kind)?;
    body.position = fields.or("position", Vec::new(), At::coordinates)?;
    body.rotation = fields.or("rotation", body.rotation, rotation::rotation)?;
    body.velocity = fields.or("velocity", Vec::new(), At::coordinates)?;
    body.angular_velocity = fields.or("angular_velocity", Vec::new(), |at| {
        let rates = at.entries("an object of planes, such as {\"xy\": 0.1}")?;
        rates.into_iter().map(|(plane, at)| Ok((plane, at.number()?))).collect()
    })?;
    body.mass = fields.or("mass", None, |at| at.number().map(Some))?;
    body.density = fields.or("density", None, |at| at.number().map(Some))?;
    body.material = fields.or("material", None, |at| at.text().map(Some))?;
    body.gravity_scale = fields.or("gravity_scale", body.gravity_scale, At::number)?;
    body.linear_damping = fields.or("linear_damping", body.linear_damping, At::number)?;
    body.angular_damping = fields.or("angular_damping", body.angular_damping, At::number)?;
    body.can_sleep = fields.or("can_sleep", body.can_sleep, At::boolean)?;
    body.surface_velocity = fields.or("surface_velocity", Vec::new(), At::coordinates)?;
    body.groups = fields.or("groups", None, |at| groups(at).map(Some))?;
    body.meets = fields.or("meets", None, |at| groups(at).map(Some))?;
    body.sensor = fields.or("sensor", body.sensor, At::boolean)?;
    body.one_way = fields.or("one_way", Vec::new(), At::coordinates)?;
    body.colour = fields.or("colour", None, |at| colour(at).map(Some))?;
    Ok(body)
}

fn kind(at: &At<'_>) -> Result<BodyKind> {
    let text = at.text()?;
    match text.as_str() {
        "dynamic" => Ok(BodyKind::Dynamic),
        "static" => Ok(BodyKind::Static),
        "kinematic" => Ok(BodyKind::Kinematic),
        _ => {
            let near = nearest(&text, ["dynamic", "static", "kinematic"]).unwrap_or("dynamic");
            let message = format!("is \"{text}\", expected dynamic, static or kinematic; the nearest is \"{near}\"");
            Err(SceneError::value(&at.path, message))
        }
    }
}

fn groups(at: &At<'_>) -> Result<Vec<u32>> {
    at.list("a list of groups, such as [0, 3]")?.iter().map(At::count).collect()
}

fn colour(at: &At<'_>) -> Result<[f64; 3]> {
    let numbers = at.numbers()?;
    <[f64; 3]>::try_from(numbers.as_slice()).map_err(|_| {
        let message = format!("has {} numbers, expected 3: red, green, blue in 0..=1", numbers.len());
        SceneError::value(&at.path, message)
    })
}
