//! Joints.

use super::cursor::{At, Fields, unknown_key};
use super::{Result, rotation};
use crate::error::SceneError;
use crate::model::{Joint, JointCone, JointKind, JointLimits, JointMotor, JointSpring};

/// Kinds of joints.
pub(super) const JOINTS: [&str; 11] =
    ["ball", "hinge", "axle", "weld", "slider", "distance", "rope", "gear", "rack", "screw", "motor"];

/// Keys of every joint.
pub(super) const COMMON_KEYS: [&str; 11] = [
    "a",
    "b",
    "anchor_a",
    "anchor_b",
    "rotation_a",
    "rotation_b",
    "hz",
    "damping_ratio",
    "break_force",
    "break_torque",
    "collide",
];

/// Keys of joints with one free motion.
pub(super) const DRIVE_KEYS: [&str; 4] = ["limits", "limits_deg", "motor", "spring"];

pub(super) fn joint(at: &At<'_>) -> Result<Joint> {
    let (key, inner) = at.variant("the kind of joint", &JOINTS)?;
    let own: &[&str] = match key {
        "ball" => &["cone"],
        "weld" => &[],
        "hinge" | "motor" => &["plane"],
        "axle" => &["keeps", "cone"],
        "slider" => &["along"],
        "distance" | "rope" => &["length"],
        "gear" => &["plane", "teeth"],
        "rack" => &["plane", "radius"],
        "screw" => &["plane", "along", "lead"],
        key => return Err(unknown_key(&at.path, key, &JOINTS)),
    };
    let mut known = [own, &COMMON_KEYS].concat();
    match key {
        "hinge" | "slider" => known.extend(DRIVE_KEYS),
        "motor" => known.extend(["speed", "max_force"]),
        _ => {}
    }
    let fields = inner.fields(&format!("a {key} joint"), &known)?;
    let kind = match key {
        "ball" => JointKind::Ball,
        "weld" => JointKind::Weld,
        "hinge" => JointKind::Hinge { plane: fields.required("plane")?.text()? },
        "motor" => JointKind::Motor { plane: fields.required("plane")?.text()? },
        "axle" => JointKind::Axle { keeps: fields.required("keeps")?.count()? },
        "slider" => JointKind::Slider { along: fields.required("along")?.text()? },
        "gear" => {
            JointKind::Gear { plane: fields.required("plane")?.text()?, teeth: teeth(&fields.required("teeth")?)? }
        }
        "rack" => {
            JointKind::Rack { plane: fields.required("plane")?.text()?, radius: fields.required("radius")?.number()? }
        }
        "screw" => JointKind::Screw {
            plane: fields.required("plane")?.text()?,
            along: fields.required("along")?.text()?,
            lead: fields.required("lead")?.number()?,
        },
        "distance" => JointKind::Distance { length: fields.required("length")?.number()? },
        _ => JointKind::Rope { length: fields.required("length")?.number()? },
    };
    let mut joint = Joint::with_world(kind, fields.required("b")?.text()?);
    joint.a = fields.or("a", None, |at| at.text().map(Some))?;
    joint.anchor_a = fields.or("anchor_a", Vec::new(), At::coordinates)?;
    joint.anchor_b = fields.or("anchor_b", Vec::new(), At::coordinates)?;
    joint.rotation_a = fields.or("rotation_a", joint.rotation_a, rotation::rotation)?;
    joint.rotation_b = fields.or("rotation_b", joint.rotation_b, rotation::rotation)?;
    joint.softness = softness(&fields)?;
    joint.break_force = fields.or("break_force", None, |at| at.number().map(Some))?;
    joint.break_torque = fields.or("break_torque", None, |at| at.number().map(Some))?;
    joint.collide = fields.or("collide", false, At::boolean)?;
    joint.limits = limits(&fields)?;
    joint.motor = match key {
        "motor" => Some(JointMotor {
            speed: fields.required("speed")?.number()?,
            max_force: fields.required("max_force")?.number()?,
        }),
        _ => fields.or("motor", None, |at| motor(at).map(Some))?,
    };
    joint.cone = fields.or("cone", None, |at| cone(at).map(Some))?;
    joint.spring = fields.or("spring", None, |at| spring(at).map(Some))?;
    Ok(joint)
}

fn teeth(at: &At<'_>) -> Result<[i32; 2]> {
    let numbers = at.numbers()?;
    let whole = |value: f64| {
        let in_range = value.fract() == 0.0 && value.abs() <= f64::from(i32::MAX);
        #[expect(clippy::cast_possible_truncation, reason = "a whole number in range")]
        in_range.then_some(value as i32)
    };
    match numbers[..] {
        [a, b] => whole(a).zip(whole(b)).map(|(a, b)| [a, b]),
        _ => None,
    }
    .ok_or_else(|| SceneError::value(&at.path, "has to be two whole numbers such as [12, 30]"))
}

fn softness(fields: &Fields<'_>) -> Result<Option<[f64; 2]>> {
    match (fields.optional("hz"), fields.optional("damping_ratio")) {
        (None, None) => Ok(None),
        (Some(hz), Some(ratio)) => Ok(Some([hz.number()?, ratio.number()?])),
        _ => Err(SceneError::structure(fields.path(), "needs both \"hz\" and \"damping_ratio\", or neither")),
    }
}

fn limits(fields: &Fields<'_>) -> Result<Option<JointLimits>> {
    let (at, degrees) = match (fields.optional("limits"), fields.optional("limits_deg")) {
        (None, None) => return Ok(None),
        (Some(at), None) => (at, false),
        (None, Some(at)) => (at, true),
        _ => return Err(SceneError::structure(fields.path(), "needs one of \"limits\" and \"limits_deg\", not both")),
    };
    let numbers = at.numbers()?;
    let range = <[f64; 2]>::try_from(numbers.as_slice()).map_err(|_| {
        SceneError::value(&at.path, format!("has {} numbers, expected 2: least and greatest", numbers.len()))
    })?;
    Ok(Some(JointLimits { range, degrees }))
}

fn cone(at: &At<'_>) -> Result<JointCone> {
    let fields = at.fields("a cone such as {\"along\": \"y\", \"angle_deg\": 40}", &["along", "angle_deg", "angle"])?;
    Ok(JointCone { along: fields.required("along")?.text()?, angle: rotation::angle(&fields)? })
}

fn motor(at: &At<'_>) -> Result<JointMotor> {
    let fields = at.fields("a motor such as {\"speed\": 2, \"max_force\": 10}", &["speed", "max_force"])?;
    Ok(JointMotor { speed: fields.required("speed")?.number()?, max_force: fields.required("max_force")?.number()? })
}

fn spring(at: &At<'_>) -> Result<JointSpring> {
    let keys = ["target", "hz", "damping_ratio", "max_force"];
    let fields = at.fields("a spring such as {\"target\": 0, \"hz\": 2, \"damping_ratio\": 1}", &keys)?;
    Ok(JointSpring {
        target: fields.or("target", 0.0, At::number)?,
        hz: fields.required("hz")?.number()?,
        damping_ratio: fields.required("damping_ratio")?.number()?,
        max_force: fields.or("max_force", None, |at| at.number().map(Some))?,
    })
}
