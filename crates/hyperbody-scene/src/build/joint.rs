//! Joints.

use std::collections::BTreeMap;

use hyperbody::math::{Dim, EvenAlgebra, planes};
use hyperbody::prelude::{BodyHandle, Freedom, JointDef, Motor, Pose, Spring};

use super::{Limit, Result, plane, quoted, rotation, vector_within};
use crate::error::{SceneError, meant};
use crate::model::{Joint, JointKind};

/// The definition of a scene's joint; `names` and `handles` are those of its bodies.
pub(super) fn joint<const N: usize>(
    joint: &Joint,
    path: &str,
    names: &BTreeMap<String, usize>,
    handles: &[BodyHandle],
) -> Result<JointDef<N>>
where
    Dim<N>: EvenAlgebra,
{
    let path = format!("{path}.{}", joint.key());
    if let Some(a) = &joint.a
        && *a == joint.b
    {
        return Err(SceneError::value(&path, format!("ties \"{a}\" to itself; a and b have to differ")));
    }
    let body = |name: &String, key: &str| Ok(handles[number_of(name, &format!("{path}.{key}"), names)?]);
    let a = joint.a.as_ref().map(|a| body(a, "a")).transpose()?;
    let b = body(&joint.b, "b")?;
    let frame = |anchor: &[f64], turn, side: &str| {
        let translation = vector_within::<N>(anchor, &format!("{path}.anchor_{side}"), Limit::PLACE)?;
        Ok(Pose::new(rotation::rotation(turn, &format!("{path}.rotation_{side}"))?, translation))
    };
    let frame_a = frame(&joint.anchor_a, &joint.rotation_a, "a")?;
    let frame_b = frame(&joint.anchor_b, &joint.rotation_b, "b")?;
    let mut def = of_kind(joint, &path, (a, b), (frame_a, frame_b))?;
    if let Some(cone) = &joint.cone {
        def = def.cone(axis(N, &cone.along, &format!("{path}.cone"))?, cone.angle.radians());
    }
    def.softness = joint.softness.map(|[hz, ratio]| (hz, ratio));
    def.break_force = joint.break_force.unwrap_or(f64::INFINITY);
    def.break_torque = joint.break_torque.unwrap_or(f64::INFINITY);
    def.collide |= joint.collide;
    Ok(def)
}

/// Which body has a name.
fn number_of(name: &str, path: &str, names: &BTreeMap<String, usize>) -> Result<usize> {
    names.get(name).copied().ok_or_else(|| {
        let hint = meant(name, names.keys().map(String::as_str)).map_or_else(
            || format!("there are {}", quoted(names.keys().map(String::as_str))),
            |near| format!("the nearest is \"{near}\""),
        );
        SceneError::value(path, format!("no body is called \"{name}\"; {hint}"))
    })
}

/// What its kind keeps, and what drives the rest.
fn of_kind<const N: usize>(
    joint: &Joint,
    path: &str,
    (a, b): (Option<BodyHandle>, BodyHandle),
    (frame_a, frame_b): (Pose<N>, Pose<N>),
) -> Result<JointDef<N>>
where
    Dim<N>: EvenAlgebra,
{
    let (from, to) = (frame_a.translation, frame_b.translation);
    Ok(match &joint.kind {
        JointKind::Ball => JointDef::ball(a, b, from, to),
        JointKind::Weld => JointDef::weld(a, b, frame_a, frame_b),
        JointKind::Hinge { plane: name } => {
            let (i, j) = plane::<N>(name, &format!("{path}.plane"))?;
            JointDef::hinge(a, b, frame_a, frame_b, (i, j)).plane(i, j, freedom(joint))
        }
        JointKind::Axle { keeps } => {
            let keeps = *keeps as usize;
            if keeps > N {
                let message = format!("is {keeps}; in {N} dimensions there are {N} axes to keep");
                return Err(SceneError::value(format!("{path}.keeps"), message));
            }
            JointDef::axle(a, b, frame_a, frame_b, keeps)
        }
        JointKind::Slider { along } => {
            let axis = axis(N, along, path)?;
            JointDef::slider(a, b, frame_a, frame_b, axis).axis(axis, freedom(joint))
        }
        JointKind::Distance { length } => JointDef::distance(a, b, from, to, *length),
        JointKind::Rope { length } => JointDef::rope(a, b, from, to, *length),
        JointKind::Gear { plane: name, teeth: [first, second] } => {
            let plane = plane::<N>(name, &format!("{path}.plane"))?;
            JointDef::gear(a, b, frame_a, frame_b, plane, (*first, *second))
        }
        JointKind::Rack { plane: name, radius } => {
            JointDef::rack(a, b, frame_a, frame_b, plane::<N>(name, &format!("{path}.plane"))?, *radius)
        }
        JointKind::Screw { plane: name, along, lead } => {
            let (i, j) = plane::<N>(name, &format!("{path}.plane"))?;
            let axis = axis(N, along, path)?;
            if axis == i || axis == j {
                let message = format!("is {along}, an axis of the plane {name}; a screw goes along one across it");
                return Err(SceneError::value(format!("{path}.along"), message));
            }
            JointDef::screw(a, b, frame_a, frame_b, (i, j), axis, *lead)
        }
        JointKind::Motor { plane: name } => {
            let (i, j) = plane::<N>(name, &format!("{path}.plane"))?;
            let free = JointDef::free(a, b).frames(frame_a, frame_b);
            free.plane(i, j, freedom(joint)).collide(true)
        }
    })
}

/// The axis of a name.
fn axis(dimension: usize, name: &str, path: &str) -> Result<usize> {
    let mut letters = name.chars();
    let axis = letters.next().filter(|_| letters.next().is_none()).and_then(|c| planes::axis_from_name(dimension, c));
    axis.ok_or_else(|| {
        let known: String = planes::AXIS_NAMES[..dimension].iter().collect();
        SceneError::value(format!("{path}.along"), format!("unknown axis \"{name}\"; the axes are {known}"))
    })
}

/// The drives of what is free.
fn freedom(joint: &Joint) -> Freedom {
    let mut freedom = Freedom::FREE;
    freedom.limits = joint.limits.map(|limits| {
        let [least, greatest] = limits.range.map(|value| if limits.degrees { value.to_radians() } else { value });
        (least, greatest)
    });
    freedom.motor = joint.motor.map(|motor| Motor { speed: motor.speed, max_force: motor.max_force });
    freedom.spring = joint.spring.map(|spring| Spring {
        target: spring.target,
        hz: spring.hz,
        damping_ratio: spring.damping_ratio,
        max_force: spring.max_force.unwrap_or(f64::INFINITY),
    });
    freedom
}
