//! From a [`Scene`] to the text of a file that reads back as the same scene.

use hyperbody::prelude::Material;

use crate::json::Json;
use crate::model::{
    Angle, Body, BodyKind, Factor, Joint, JointKind, Part, PolytopeSpec, RotationSpec, Scene, ShapeSpec, Size,
};
use crate::read::{FORMAT, RULES, VERSION};

impl Scene {
    /// The scene as a file of the current version. What has its default value is left out, but for the world's own
    /// settings. Reading the text gives the same scene, to the bit.
    #[must_use]
    pub fn to_json(&self) -> String {
        let mut fields = vec![
            field("format", text(FORMAT)),
            field("version", Json::Number(f64::from(VERSION))),
            field("name", text(&self.name)),
        ];
        if !self.description.is_empty() {
            fields.push(field("description", text(&self.description)));
        }
        fields.push(field("dimension", Json::Number(self.dimension as f64)));
        fields.push(field("gravity", numbers(&self.gravity)));
        fields.push(field("dt", Json::Number(self.dt)));
        fields.push(field("substeps", Json::Number(f64::from(self.substeps))));
        fields.push(field("sleeping", Json::Bool(self.sleeping)));
        if !self.materials.is_empty() {
            let materials = self.materials.iter().map(|named| field(&named.name, material(&named.material)));
            fields.push(field("materials", Json::Object(materials.collect())));
        }
        fields.push(field("bodies", Json::List(self.bodies.iter().map(body).collect())));
        if !self.joints.is_empty() {
            fields.push(field("joints", Json::List(self.joints.iter().map(joint).collect())));
        }
        Json::Object(fields).to_text()
    }
}

fn field(key: &str, value: Json) -> (String, Json) {
    (key.to_owned(), value)
}

fn text(value: &str) -> Json {
    Json::Text(value.to_owned())
}

fn numbers(values: &[f64]) -> Json {
    Json::List(values.iter().copied().map(Json::Number).collect())
}

fn rows(values: &[Vec<f64>]) -> Json {
    Json::List(values.iter().map(|row| numbers(row)).collect())
}

/// An object with one key.
fn single(key: &str, value: Json) -> Json {
    Json::Object(vec![field(key, value)])
}

fn material(material: &Material) -> Json {
    let mut fields = vec![
        field("friction", Json::Number(material.friction)),
        field("restitution", Json::Number(material.restitution)),
        field("density", Json::Number(material.density)),
    ];
    let resistances =
        [("rolling_resistance", material.rolling_resistance), ("twisting_resistance", material.twisting_resistance)];
    for (key, value) in resistances.into_iter().filter(|(_, value)| value.to_bits() != 0) {
        fields.push(field(key, Json::Number(value)));
    }
    for (key, rule) in [("friction_rule", material.friction_rule), ("restitution_rule", material.restitution_rule)] {
        let name = rule.and_then(|rule| RULES.iter().find(|(_, other)| *other == rule));
        fields.extend(name.map(|(name, _)| field(key, text(name))));
    }
    Json::Object(fields)
}

fn body(body: &Body) -> Json {
    let mut fields = Vec::new();
    let mut add = |key: &str, value: Option<Json>| fields.extend(value.map(|value| field(key, value)));
    let vector = |values: &[f64]| (!values.is_empty()).then(|| numbers(values));
    let unless = |default: f64, value: f64| (value.to_bits() != default.to_bits()).then_some(Json::Number(value));
    add("name", body.name.as_deref().map(text));
    add("kind", kind(body.kind));
    add("shape", Some(shape(&body.shape)));
    add("position", vector(&body.position));
    add("rotation", rotation(&body.rotation));
    add("velocity", vector(&body.velocity));
    let rates = body.angular_velocity.iter().map(|(plane, rate)| field(plane, Json::Number(*rate)));
    add("angular_velocity", (!body.angular_velocity.is_empty()).then(|| Json::Object(rates.collect())));
    add("mass", body.mass.map(Json::Number));
    add("density", body.density.map(Json::Number));
    add("material", body.material.as_deref().map(text));
    add("gravity_scale", unless(1.0, body.gravity_scale));
    add("linear_damping", unless(0.0, body.linear_damping));
    add("angular_damping", unless(0.0, body.angular_damping));
    add("can_sleep", (!body.can_sleep).then_some(Json::Bool(false)));
    add("surface_velocity", vector(&body.surface_velocity));
    let groups = |groups: &Option<Vec<u32>>| {
        let list = groups.as_ref()?.iter().map(|&group| Json::Number(f64::from(group)));
        Some(Json::List(list.collect()))
    };
    add("groups", groups(&body.groups));
    add("meets", groups(&body.meets));
    add("sensor", body.sensor.then_some(Json::Bool(true)));
    add("one_way", vector(&body.one_way));
    add("colour", body.colour.map(|colour| numbers(&colour)));
    Json::Object(fields)
}

fn kind(kind: BodyKind) -> Option<Json> {
    match kind {
        BodyKind::Dynamic => None,
        BodyKind::Static => Some(text("static")),
        BodyKind::Kinematic => Some(text("kinematic")),
    }
}

/// A shape as a file holds it.
pub(crate) fn shape(shape: &ShapeSpec) -> Json {
    let inner = match shape {
        ShapeSpec::Ball { radius } => vec![field("radius", Json::Number(*radius))],
        ShapeSpec::Box { half_extents } => vec![field("half_extents", numbers(half_extents))],
        ShapeSpec::HalfSpace { normal, offset } => {
            vec![field("normal", numbers(normal)), field("offset", Json::Number(*offset))]
        }
        ShapeSpec::Capsule { half_length, radius, along } => vec![
            field("half_length", Json::Number(*half_length)),
            field("radius", Json::Number(*radius)),
            field("along", text(along)),
        ],
        ShapeSpec::Polytope(polytope) => match polytope {
            PolytopeSpec::Vertices(vertices) => vec![field("vertices", rows(vertices))],
            PolytopeSpec::Regular { name, size } => regular(name, size),
            PolytopeSpec::File(file) => vec![field("file", text(file))],
        },
        ShapeSpec::Rounded { shape: core, radius } => {
            vec![field("shape", self::shape(core)), field("radius", Json::Number(*radius))]
        }
        ShapeSpec::Star { name, size } => regular(name, size),
        ShapeSpec::Pyramid { base, height } => {
            vec![field("base", factor(base)), field("height", Json::Number(*height))]
        }
        ShapeSpec::Mesh { file } => vec![field("file", text(file))],
        ShapeSpec::Product { factors } => {
            vec![field("factors", Json::List(factors.iter().map(factor).collect()))]
        }
        ShapeSpec::Compound { parts } => vec![field("parts", Json::List(parts.iter().map(part).collect()))],
    };
    single(shape.key(), Json::Object(inner))
}

fn regular(name: &str, size: &Size) -> Vec<(String, Json)> {
    let size = match size {
        Size::Circumradius(radius) => field("circumradius", Json::Number(*radius)),
        Size::Edge(edge) => field("edge", Json::Number(*edge)),
    };
    vec![field("regular", text(name)), size]
}

fn factor(factor: &Factor) -> Json {
    Json::Object(vec![field("shape", shape(&factor.shape)), field("axes", text(&factor.axes))])
}

fn part(part: &Part) -> Json {
    let mut fields = vec![field("shape", shape(&part.shape))];
    if !part.position.is_empty() {
        fields.push(field("position", numbers(&part.position)));
    }
    fields.extend(rotation(&part.rotation).map(|rotation| field("rotation", rotation)));
    Json::Object(fields)
}

fn angle(angle: Angle) -> (String, Json) {
    match angle {
        Angle::Degrees(angle) => field("angle_deg", Json::Number(angle)),
        Angle::Radians(angle) => field("angle", Json::Number(angle)),
    }
}

fn rotation(rotation: &RotationSpec) -> Option<Json> {
    match rotation {
        RotationSpec::Turns(turns) if turns.is_empty() => None,
        RotationSpec::Turns(turns) => {
            let turns =
                turns.iter().map(|turn| Json::Object(vec![field("plane", text(&turn.plane)), angle(turn.angle)]));
            Some(Json::List(turns.collect()))
        }
        RotationSpec::Rotor(rotor) => Some(single("rotor", numbers(rotor))),
        RotationSpec::Matrix(matrix) => Some(single("matrix", rows(matrix))),
    }
}

fn joint(joint: &Joint) -> Json {
    let mut fields = Vec::new();
    let mut add = |key: &str, value: Option<Json>| fields.extend(value.map(|value| field(key, value)));
    let vector = |values: &[f64]| (!values.is_empty()).then(|| numbers(values));
    match &joint.kind {
        JointKind::Ball | JointKind::Weld => {}
        JointKind::Hinge { plane } | JointKind::Motor { plane } => add("plane", Some(text(plane))),
        JointKind::Axle { keeps } => add("keeps", Some(Json::Number(f64::from(*keeps)))),
        JointKind::Slider { along } => add("along", Some(text(along))),
        JointKind::Distance { length } | JointKind::Rope { length } => add("length", Some(Json::Number(*length))),
        JointKind::Gear { plane, teeth } => {
            add("plane", Some(text(plane)));
            add("teeth", Some(numbers(&teeth.map(f64::from))));
        }
        JointKind::Rack { plane, radius } => {
            add("plane", Some(text(plane)));
            add("radius", Some(Json::Number(*radius)));
        }
        JointKind::Screw { plane, along, lead } => {
            add("plane", Some(text(plane)));
            add("along", Some(text(along)));
            add("lead", Some(Json::Number(*lead)));
        }
    }
    add("a", joint.a.as_deref().map(text));
    add("b", Some(text(&joint.b)));
    add("anchor_a", vector(&joint.anchor_a));
    add("anchor_b", vector(&joint.anchor_b));
    add("rotation_a", rotation(&joint.rotation_a));
    add("rotation_b", rotation(&joint.rotation_b));
    if let Some(limits) = &joint.limits {
        add(if limits.degrees { "limits_deg" } else { "limits" }, Some(numbers(&limits.range)));
    }
    if let Some(cone) = &joint.cone {
        add("cone", Some(Json::Object(vec![field("along", text(&cone.along)), angle(cone.angle)])));
    }
    if let Some(motor) = &joint.motor {
        let drive = [("speed", motor.speed), ("max_force", motor.max_force)];
        if matches!(joint.kind, JointKind::Motor { .. }) {
            drive.into_iter().for_each(|(key, value)| add(key, Some(Json::Number(value))));
        } else {
            add("motor", Some(Json::Object(drive.map(|(key, value)| field(key, Json::Number(value))).to_vec())));
        }
    }
    if let Some(spring) = &joint.spring {
        let given = [
            ("target", Some(spring.target)),
            ("hz", Some(spring.hz)),
            ("damping_ratio", Some(spring.damping_ratio)),
            ("max_force", spring.max_force),
        ];
        let given = given.into_iter().filter_map(|(key, value)| Some(field(key, Json::Number(value?))));
        add("spring", Some(Json::Object(given.collect())));
    }
    add("hz", joint.softness.map(|[hz, _]| Json::Number(hz)));
    add("damping_ratio", joint.softness.map(|[_, ratio]| Json::Number(ratio)));
    add("break_force", joint.break_force.map(Json::Number));
    add("break_torque", joint.break_torque.map(Json::Number));
    add("collide", joint.collide.then_some(Json::Bool(true)));
    single(joint.key(), Json::Object(fields))
}
