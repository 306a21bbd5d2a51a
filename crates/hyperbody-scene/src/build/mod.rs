//! From a [`Scene`] to a world: everything that a scene's values have to satisfy is checked here, for scenes from files
//! as for those made by programs, and every complaint names its place as in a file.

mod joint;
mod product;
mod rotation;
mod shape;

use std::collections::BTreeMap;

use hyperbody::dynamics::POSITION_LIMIT;
use hyperbody::math::{Dim, EvenAlgebra, planes};
use hyperbody::prelude::{Bivector, BodyDef, BodyHandle, Groups, Material, Tuning, Vector, World, WorldDef};

use crate::error::{ErrorKind, SceneError, meant};
use crate::model::{Body, Scene};
pub use shape::MAX_VERTICES;
pub(crate) use shape::{MAX_SHAPE_FILE_BYTES, ShapeBuilder, read_beside};

pub(crate) type Result<T> = std::result::Result<T, SceneError>;

/// Most bodies of a scene.
pub const MAX_BODIES: usize = 100_000;

/// Most joints of a scene.
pub const MAX_JOINTS: usize = 100_000;

/// The world of a scene of `N` dimensions and the handles of its bodies in the order of the scene.
pub(crate) fn world<const N: usize>(scene: &Scene, threads: usize) -> Result<(World<N>, Vec<BodyHandle>)>
where
    Dim<N>: EvenAlgebra,
{
    at_most("bodies", scene.bodies.len(), MAX_BODIES)?;
    at_most("joints", scene.joints.len(), MAX_JOINTS)?;
    let def = WorldDef {
        gravity: vector_within(&scene.gravity, "gravity", Limit::GRAVITY)?,
        dt: scene.dt,
        substeps: scene.substeps,
        sleeping: scene.sleeping,
        threads,
        ..WorldDef::default()
    };
    let mut world = World::new(def).map_err(|error| SceneError::value("", error.to_string()))?;
    let materials = materials(scene)?;
    let mut shapes = ShapeBuilder::new(scene.beside());
    let names = names(scene)?;
    let mut handles = Vec::with_capacity(scene.bodies.len());
    for (index, body) in scene.bodies.iter().enumerate() {
        let path = format!("bodies[{index}]");
        let def = body_def(body, &path, &materials, &mut shapes)?;
        handles.push(world.add_body(def).map_err(|error| SceneError::value(&path, error.to_string()))?);
    }
    for (index, joint) in scene.joints.iter().enumerate() {
        let path = format!("joints[{index}]");
        let def = joint::joint(joint, &path, &names, &handles)?;
        world.add_joint(def).map_err(|error| SceneError::value(&path, error.to_string()))?;
    }
    Ok((world, handles))
}

/// The vector of a list with one number per axis.
pub(crate) fn vector<const N: usize>(numbers: &[f64], path: &str) -> Result<Vector<N>> {
    let vector = Vector::from_slice(numbers).ok_or_else(|| {
        let message = format!("has {}, expected {N}, one for each dimension", counted(numbers.len(), "number"));
        SceneError::value(path, message)
    })?;
    match numbers.iter().find(|number| !number.is_finite()) {
        Some(number) => Err(SceneError::value(path, format!("holds {number:?}; every number has to be finite"))),
        None => Ok(vector),
    }
}

/// The vector of a list that may be left out.
pub(crate) fn vector_or_zero<const N: usize>(numbers: &[f64], path: &str) -> Result<Vector<N>> {
    if numbers.is_empty() { Ok(Vector::ZERO) } else { vector(numbers, path) }
}

/// How large a number of a scene may be. Beyond, the engine would clamp it or give up the body, and the scene would not be
/// what its writer meant.
#[derive(Clone, Copy, Debug)]
struct Limit {
    largest: f64,
    unit: &'static str,
}

impl Limit {
    const PLACE: Self = Self { largest: POSITION_LIMIT, unit: "m" };
    const SPEED: Self = Self { largest: Tuning::DEFAULT.max_speed, unit: "m/s" };
    const SPIN: Self = Self { largest: Tuning::DEFAULT.max_spin, unit: "rad/s" };
    const GRAVITY: Self = Self { largest: 1e6, unit: "m/s²" };
    const GRAVITY_SCALE: Self = Self { largest: 1e6, unit: "times gravity" };

    fn check(self, value: f64, path: &str) -> Result<()> {
        if value.abs() <= self.largest {
            return Ok(());
        }
        let (largest, unit) = (self.largest, self.unit);
        let largest = if largest < 1e6 { largest.to_string() } else { format!("{largest:e}") };
        Err(SceneError::value(path, format!("is {value:?}; it has to lie within ±{largest} {unit}")))
    }
}

/// The vector of a list that may be left out, every number within a limit.
fn vector_within<const N: usize>(numbers: &[f64], path: &str, limit: Limit) -> Result<Vector<N>> {
    let vector = vector_or_zero(numbers, path)?;
    numbers.iter().enumerate().try_for_each(|(axis, number)| limit.check(*number, &format!("{path}[{axis}]")))?;
    Ok(vector)
}

/// The axes of a plane name.
pub(crate) fn plane<const N: usize>(name: &str, path: &str) -> Result<(usize, usize)> {
    planes::from_name(N, name).ok_or_else(|| {
        let known: Vec<String> = planes::all(N).map(|(i, j)| planes::name(i, j)).collect();
        SceneError::value(path, format!("unknown plane \"{name}\"; in {N} dimensions there are {}", known.join(", ")))
    })
}

/// Names in quotes, the first few of many.
fn quoted<'a>(names: impl Iterator<Item = &'a str>) -> String {
    const SHOWN: usize = 8;
    let mut names: Vec<String> = names.map(|name| format!("\"{name}\"")).collect();
    let more = names.len().saturating_sub(SHOWN);
    names.truncate(SHOWN);
    let list = names.join(", ");
    if more > 0 { format!("{list} and {more} more") } else { list }
}

/// "1 number", "2 numbers".
pub(crate) fn counted(count: usize, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}

fn at_most(path: &str, count: usize, limit: usize) -> Result<()> {
    if count > limit {
        return Err(SceneError::value(path, format!("has {count} entries; a scene holds at most {limit}")));
    }
    Ok(())
}

/// The index of every body by its name; those without one are "body N".
fn names(scene: &Scene) -> Result<BTreeMap<String, usize>> {
    let mut indices = BTreeMap::new();
    for (index, name) in scene.body_names().into_iter().enumerate() {
        if name.trim().is_empty() || name.chars().any(char::is_control) {
            let message = format!("{name:?} is no name: names have visible letters and no control characters");
            return Err(SceneError::value(format!("bodies[{index}].name"), message));
        }
        if let Some(first) = indices.get(&name) {
            let message = format!("\"{name}\" is already the name of bodies[{first}]; names have to differ");
            return Err(SceneError::value(format!("bodies[{index}].name"), message));
        }
        indices.insert(name, index);
    }
    Ok(indices)
}

pub(crate) fn materials(scene: &Scene) -> Result<BTreeMap<&str, Material>> {
    let mut materials = BTreeMap::from([("default", Material::default())]);
    let mut seen = BTreeMap::new();
    for (index, named) in scene.materials.iter().enumerate() {
        let path = format!("materials.{}", named.name);
        if seen.insert(named.name.as_str(), index).is_some() {
            return Err(SceneError::value(path, "stands twice; names have to differ"));
        }
        let Material { friction, restitution, density, .. } = named.material;
        let refuse = |key: &str, value: f64, expected: &str| {
            Err(SceneError::value(format!("{path}.{key}"), format!("is {value:?}, expected {expected}")))
        };
        if !(friction >= 0.0 && friction.is_finite()) {
            return refuse("friction", friction, "a finite number, 0 or more");
        }
        if !(0.0..=1.0).contains(&restitution) {
            return refuse("restitution", restitution, "a number from 0 (no bounce) to 1 (no loss)");
        }
        if !(density > 0.0 && density.is_finite()) {
            return refuse("density", density, "a finite number above 0");
        }
        let resistances = [
            ("rolling_resistance", named.material.rolling_resistance),
            ("twisting_resistance", named.material.twisting_resistance),
        ];
        for (key, value) in resistances {
            if !(value >= 0.0 && value.is_finite()) {
                return refuse(key, value, "a finite number of metres, 0 or more");
            }
        }
        materials.insert(&named.name, named.material);
    }
    Ok(materials)
}

pub(crate) fn body_def<const N: usize>(
    body: &Body,
    path: &str,
    materials: &BTreeMap<&str, Material>,
    shapes: &mut ShapeBuilder<'_, N>,
) -> Result<BodyDef<N>>
where
    Dim<N>: EvenAlgebra,
{
    let mut material = match &body.material {
        None => materials["default"],
        Some(name) => *materials.get(name.as_str()).ok_or_else(|| {
            let hint = meant(name, materials.keys().copied()).map_or_else(
                || format!("there are {}", quoted(materials.keys().copied())),
                |near| format!("the nearest is \"{near}\""),
            );
            let message = format!("no material is called \"{name}\"; {hint}");
            SceneError::value(format!("{path}.material"), message)
        })?,
    };
    material.density = body.density.unwrap_or(material.density);
    Limit::GRAVITY_SCALE.check(body.gravity_scale, &format!("{path}.gravity_scale"))?;
    let mut def = BodyDef::new(shapes.shape(&body.shape, &format!("{path}.shape"))?)
        .kind(body.kind)
        .position(vector_within(&body.position, &format!("{path}.position"), Limit::PLACE)?)
        .rotation(rotation::rotation(&body.rotation, &format!("{path}.rotation"))?)
        .velocity(vector_within(&body.velocity, &format!("{path}.velocity"), Limit::SPEED)?)
        .angular_velocity(angular_velocity(&body.angular_velocity, &format!("{path}.angular_velocity"))?)
        .material(material)
        .gravity_scale(body.gravity_scale)
        .linear_damping(body.linear_damping)
        .angular_damping(body.angular_damping)
        .can_sleep(body.can_sleep)
        .surface_velocity(vector_within::<N>(
            &body.surface_velocity,
            &format!("{path}.surface_velocity"),
            Limit::SPEED,
        )?);
    def.groups = Groups::new(
        bits(body.groups.as_deref(), &format!("{path}.groups"))?,
        bits(body.meets.as_deref(), &format!("{path}.meets"))?,
    );
    def.sensor = body.sensor;
    if !body.one_way.is_empty() {
        let place = format!("{path}.one_way");
        let side = vector::<N>(&body.one_way, &place)?;
        if side.try_normalize().is_none() {
            let message = "is zero; it has to point to the side that holds".to_owned();
            return Err(SceneError::value(place, message));
        }
        def.one_way = Some(side);
    }
    def.mass = body.mass;
    if let Some(colour) = body.colour
        && !colour.iter().all(|part| (0.0..=1.0).contains(part))
    {
        let message = format!("is {colour:?}, expected red, green and blue from 0 to 1");
        return Err(SceneError::value(format!("{path}.colour"), message));
    }
    Ok(def)
}

/// Groups as one bit each; all where the list is left out.
fn bits(groups: Option<&[u32]>, path: &str) -> Result<u32> {
    let Some(groups) = groups else { return Ok(u32::MAX) };
    groups.iter().enumerate().try_fold(0, |bits, (index, &group)| {
        let bit = 1_u32.checked_shl(group).ok_or_else(|| {
            SceneError::value(format!("{path}[{index}]"), format!("is {group}; groups are numbered from 0 to 31"))
        })?;
        Ok(bits | bit)
    })
}

fn angular_velocity<const N: usize>(rates: &[(String, f64)], path: &str) -> Result<Bivector<N>> {
    let mut sum = Bivector::ZERO;
    let mut given = Vec::new();
    for (name, rate) in rates {
        let place = format!("{path}.{name}");
        let (i, j) = plane::<N>(name, &place)?;
        Limit::SPIN.check(*rate, &place)?;
        let sorted = (i.min(j), i.max(j));
        if given.contains(&sorted) {
            let message = format!("the plane {} is given twice; give it once", planes::name(sorted.0, sorted.1));
            return Err(SceneError::value(place, message));
        }
        given.push(sorted);
        sum.set(i, j, *rate);
    }
    Ok(sum)
}

/// What the geometry refuses, at its place in the scene.
pub(crate) fn shape_error(path: &str, error: &hyperbody::geometry::GeometryError) -> SceneError {
    SceneError::new(ErrorKind::Shape, path, error.to_string())
}
