//! What a page can do to a running scene.

use hyperbody::collision::ray::Ray;
use hyperbody::geometry::{Solid, Surface};
use hyperbody::math::{Bivector, Dim, EvenAlgebra, Matrix, Pose, Rotation, Vector, planes};
use hyperbody::prelude::{BodyHandle, BodyKind};
use hyperbody_scene::{Body, RotationSpec, Scene, ShapeSpec};
use serde_json::{Value, json};

use crate::cut::Drawn;
use crate::draw::Drawing;
use crate::hands::Hand;
use crate::message::{Format, Kind, Message, Plane, Refusal};
use crate::report::numbers;
use crate::running::Running;

type Outcome<T> = Result<T, Refusal>;

/// What a message has done.
#[derive(Debug, Default)]
pub(crate) struct Done {
    /// For messages that are answered.
    pub(crate) answer: Option<Value>,
    /// Whether the list of bodies is new.
    pub(crate) bodies_changed: bool,
    /// A file.
    pub(crate) bytes: Option<Vec<u8>>,
}

/// Bodies up to which a page may add some.
const MOST_BODIES: usize = 4000;

/// The same with those that were removed, which keep their numbers.
const MOST_ENTRIES: usize = 20_000;

impl Done {
    fn answer(answer: Value) -> Self {
        Self { answer: Some(answer), ..Self::default() }
    }

    fn new_bodies(answer: Value) -> Self {
        Self { answer: Some(answer), bodies_changed: true, ..Self::default() }
    }
}

impl<const N: usize> Running<N>
where
    Dim<N>: EvenAlgebra,
    Solid<N>: Drawn<N>,
{
    /// Obeys a message that does not change the scene as a whole.
    pub(crate) fn handle(&mut self, message: Message) -> Outcome<Done> {
        match message {
            Message::Undo {} => return self.undo(),
            Message::Pick { origin, direction } => {
                return Ok(Done::answer(self.cast(&origin, &direction)?.map_or(Value::Null, |hit| hit.told())));
            }
            Message::Grab { hand, body, point, origin, direction } => {
                let ray = origin.as_deref().zip(direction.as_deref());
                return self.grab(hand, body.zip(point), ray);
            }
            Message::Spawn { shape, position, velocity, name, kind } => {
                return self.spawn(&shape, &position, velocity.as_deref(), name, kind);
            }
            Message::Remove { body } => return self.remove(body),
            Message::Freeze { body, on } => return self.freeze(body, on),
            Message::Turn { body, plane, angle } => return self.turn(body, &plane, angle),
            Message::Export { format } => return self.export(format),
            Message::SceneText {} => return Ok(Done::answer(json!({ "text": self.scene_now().to_json() }))),
            Message::Hash {} => {
                let hash = format!("{:016x}", self.world.state_hash());
                return Ok(Done::answer(json!({ "hash": hash, "step": self.step_count() })));
            }
            Message::Slice { origin, axes, off } => {
                self.view = self.view.moved(&origin, &axes, off.as_deref()).unwrap_or(self.view);
            }
            Message::Ghosts { on, reach } => self.ghosts = on.then_some(reach),
            Message::Wires { on } => self.wires = on,
            Message::Scrub { seconds_back } => {
                self.hands.clear();
                self.history.show(seconds_back, self.world.dt());
            }
            Message::ResumeHere {} => {
                if let Some(moment) = self.history.forget_later() {
                    self.restore(&moment)?;
                    return Ok(Done { bodies_changed: true, ..Done::default() });
                }
            }
            Message::Gravity { vector } => self.world.set_gravity(self.vector(&vector, "gravity")?)?,
            Message::MoveHand { hand, point, rotation, planes } => {
                let turn = planes.map(|planes| turn_of(&planes));
                self.move_hand(hand, &point, rotation.as_deref(), turn)?;
            }
            Message::Release { hand } => self.release(hand),
            Message::Select { body } => self.selected = body,
            Message::Load { .. } | Message::LoadBuiltin { .. } | Message::Reset {} => {}
        }
        Ok(Done::default())
    }

    fn undo(&mut self) -> Outcome<Done> {
        self.history.show(0.0, self.world.dt());
        let Some((change, moment)) = self.history.undo() else {
            return Ok(Done::answer(json!({ "undone": null })));
        };
        // What a hand has taken since then, it would only pull back.
        self.hands.retain(|held| held.since < moment.step);
        self.restore(&moment)?;
        Ok(Done::new_bodies(json!({ "undone": change })))
    }

    /// Notes the present before a change of it. Refused while the past is shown.
    fn before(&mut self, change: &'static str) -> Outcome<()> {
        if self.history.shown().is_some() {
            let why = "an earlier moment is shown; go on from it, or back to now, to change something";
            return Err(Refusal::about("past", why));
        }
        let moment = self.moment();
        self.history.before(change, moment);
        Ok(())
    }

    fn vector(&self, list: &[f64], what: &str) -> Outcome<Vector<N>> {
        let vector = Vector::from_slice(list).filter(|vector| vector.is_finite());
        vector.ok_or_else(|| Refusal::new(format!("{what} is {list:?}; it needs {N} finite numbers")))
    }

    fn handle_of(&self, id: u32) -> Outcome<BodyHandle> {
        let handle = self.entries.get(id as usize).and_then(|entry| entry.handle);
        handle.ok_or_else(|| Refusal::about("gone", format!("there is no body {id}; it may have been removed")))
    }

    fn cast(&self, origin: &[f64], direction: &[f64]) -> Outcome<Option<Hit<N>>> {
        let drawn = self.view.drawn;
        let is_fine = |list: &[f64]| list.len() >= drawn && list.iter().all(|c| c.is_finite());
        if !is_fine(origin) || !is_fine(direction) {
            return Err(Refusal::new(format!("a ray needs an origin and a direction of {drawn} finite numbers each")));
        }
        if self.history.shown().is_some() {
            return Ok(None);
        }
        let ray = Ray::new(self.view.to_world(origin), self.view.direction_to_world(direction));
        let hit = self.world.ray_cast(&ray);
        Ok(hit.and_then(|hit| {
            Some(Hit { body: self.id_of(hit.body)?, point: hit.hit.point, distance: hit.hit.fraction })
        }))
    }

    fn grab(&mut self, hand: u32, at: Option<(u32, Vec<f64>)>, ray: Option<(&[f64], &[f64])>) -> Outcome<Done> {
        let hit = match (at, ray) {
            (Some((body, point)), _) => Some(Hit { body, point: self.vector(&point, "point")?, distance: 0.0 }),
            (None, Some((origin, direction))) => self.cast(origin, direction)?,
            (None, None) => {
                return Err(Refusal::new("a grab names a body and a point, or the origin and direction of a ray"));
            }
        };
        let Some(hit) = hit else { return Ok(Done::answer(Value::Null)) };
        let handle = self.handle_of(hit.body)?;
        let kind = self.world.body(handle).map(|body| body.kind());
        if kind != Some(BodyKind::Dynamic) {
            let entry = &self.entries[hit.body as usize];
            let (code, why) =
                if entry.frozen { ("frozen", "it is frozen") } else { ("immovable", "it is not dynamic") };
            return Err(Refusal::about(code, format!("{} cannot be moved: {why}", entry.name)));
        }
        self.release(hand);
        self.before("grab")?;
        self.hands.push(Hand::grab(&self.world, hand, (hit.body, handle), hit.point, self.step_count()));
        Ok(Done::answer(hit.told()))
    }

    fn move_hand(
        &mut self,
        hand: u32,
        point: &[f64],
        rows: Option<&[Vec<f64>]>,
        turn: Option<Rotation<N>>,
    ) -> Outcome<()> {
        let point = self.vector(point, "point")?;
        let attitude = rows.and_then(rotation_of);
        let Some(held) = self.hands.iter_mut().find(|held| held.hand == hand) else { return Ok(()) };
        held.go(&self.world, point, attitude, turn);
        Ok(())
    }

    /// Lets go; the body keeps its motion.
    fn release(&mut self, hand: u32) {
        self.hands.retain(|held| held.hand != hand);
    }

    fn spawn(
        &mut self,
        shape: &Value,
        position: &[f64],
        velocity: Option<&[f64]>,
        name: Option<String>,
        kind: Option<Kind>,
    ) -> Outcome<Done> {
        let alive = self.entries.iter().filter(|entry| entry.handle.is_some()).count();
        if alive >= MOST_BODIES || self.entries.len() >= MOST_ENTRIES {
            let why =
                format!("the scene holds {alive} bodies, after {} in all; remove some or reset it", self.entries.len());
            return Err(Refusal::about("full", why));
        }
        let mut body = Body::new(ShapeSpec::from_json(&shape.to_string())?).at(position);
        if let Some(velocity) = velocity {
            body = body.moving(velocity);
        }
        body.kind = match kind.unwrap_or(Kind::Dynamic) {
            Kind::Dynamic => BodyKind::Dynamic,
            Kind::Static => BodyKind::Static,
            Kind::Kinematic => BodyKind::Kinematic,
        };
        let def = self.scene.definition::<N>(&body, "body")?;
        self.before("spawn")?;
        let handle = self.world.add_body(def)?;
        let wanted = name.unwrap_or_else(|| body.shape.key().to_owned());
        let name = self.free_name(&wanted);
        let id = self.add_entry(body, name, handle);
        Ok(Done::new_bodies(json!({ "body": id })))
    }

    /// The name, with a number if it is taken.
    fn free_name(&self, wanted: &str) -> String {
        let is_taken = |name: &str| self.entries.iter().any(|entry| entry.name == name);
        if !is_taken(wanted) {
            return wanted.to_owned();
        }
        let number = |name: &str| name.strip_prefix(wanted)?.strip_prefix(' ')?.parse::<u32>().ok();
        let last = self.entries.iter().filter_map(|entry| number(&entry.name)).max().unwrap_or(1);
        format!("{wanted} {}", u64::from(last) + 1)
    }

    fn remove(&mut self, id: u32) -> Outcome<Done> {
        let handle = self.handle_of(id)?;
        self.before("remove")?;
        self.hands.retain(|held| held.body != id);
        self.world.remove_body(handle)?;
        let entry = &mut self.entries[id as usize];
        entry.handle = None;
        // What was drawn of it is large, and drawn anew if it comes back.
        entry.drawing = Drawing::default();
        if self.selected == Some(id) {
            self.selected = None;
        }
        Ok(Done::new_bodies(json!({})))
    }

    fn freeze(&mut self, id: u32, on: bool) -> Outcome<Done> {
        self.handle_of(id)?;
        let entry = &self.entries[id as usize];
        if entry.spec.kind != BodyKind::Dynamic {
            let why = format!("{} does not move by itself, there is nothing to freeze", entry.name);
            return Err(Refusal::about("immovable", why));
        }
        self.before("freeze")?;
        let mut moment = self.moment();
        for state in moment.bodies.iter_mut().filter(|state| state.id == id) {
            state.frozen = on;
            state.velocity = Vector::ZERO;
            state.angular_velocity = Bivector::ZERO;
        }
        self.restore(&moment)?;
        Ok(Done::answer(json!({})))
    }

    fn turn(&mut self, id: u32, plane: &Plane, angle: f64) -> Outcome<Done> {
        let handle = self.handle_of(id)?;
        if !angle.is_finite() {
            return Err(Refusal::new(format!("the angle is {angle}; it has to be finite")));
        }
        let turn = match plane {
            Plane::Name(name) => {
                let (i, j) = planes::from_name(N, name).ok_or_else(|| {
                    let known: Vec<String> = planes::all(N).map(|(i, j)| planes::name(i, j)).collect();
                    Refusal::new(format!("there is no plane \"{name}\"; there are {}", known.join(", ")))
                })?;
                Rotation::in_plane(i, j, angle)
            }
            Plane::Directions([from, to]) => {
                let from = self.vector(from, "the first direction")?.normalize_or_zero();
                let to = self.vector(to, "the second direction")?;
                let Some(across) = (to - from * to.dot(from)).try_normalize() else {
                    return Err(Refusal::new("the two directions of a plane are parallel, or zero"));
                };
                // The wedge of two orthonormal directions turns the first towards the second.
                Rotation::exp(&(Bivector::wedge(from, across) * angle))
            }
        };
        self.before("turn")?;
        if let Some(mut body) = self.world.body_mut(handle) {
            let (pose, centre) = (body.as_ref().pose(), body.as_ref().centre_of_mass());
            let place = centre + turn.rotate(pose.translation - centre);
            body.set_pose(Pose::new(turn * pose.rotation, place))?;
        }
        Ok(Done::answer(json!({})))
    }

    fn export(&mut self, format: Format) -> Outcome<Done> {
        if self.view.drawn != 3 {
            return Err(Refusal::about("flat", "a slice of two dimensions is flat; files of solids need three"));
        }
        let moment = self.history.shown().cloned().unwrap_or_else(|| self.moment());
        let mut surface = Surface::new();
        for state in &moment.bodies {
            let entry = &self.entries[state.id as usize];
            let accuracy = (1e-3 * entry.radius, state.id);
            if entry.drawable.half_space().is_none() {
                entry.drawable.export(&state.pose, &self.view, &mut self.cutter, accuracy, &mut surface);
            }
        }
        if surface.is_empty() {
            return Err(Refusal::about("nothing", "the slice cuts nothing; move it to a body"));
        }
        let bytes = match format {
            Format::Stl => surface.to_stl(),
            Format::Glb => surface.to_glb(),
        };
        Ok(Done { answer: Some(json!({})), bytes: Some(bytes), ..Done::default() })
    }

    /// The scene as it stands now.
    fn scene_now(&self) -> Scene {
        let mut scene = self.scene.clone();
        scene.gravity = self.world.gravity().iter().collect();
        let alive: Vec<usize> = (0..self.entries.len()).filter(|&id| self.entries[id].handle.is_some()).collect();
        scene.bodies = alive.iter().filter_map(|&id| self.body_now(id)).collect();
        scene.joints.retain(|joint| self.joint_has_bodies(joint, &alive));
        scene
    }

    fn body_now(&self, id: usize) -> Option<Body> {
        let entry = self.entries.get(id)?;
        let body = self.world.body(entry.handle?)?;
        let mut spec = entry.spec_now();
        let rotation = body.rotation();
        spec.position = body.position().iter().collect();
        let is_turned = rotation != Rotation::IDENTITY;
        let rows = || (0..N).map(|row| rotation.matrix().row(row).iter().collect()).collect();
        spec.rotation = if is_turned { RotationSpec::Matrix(rows()) } else { RotationSpec::default() };
        if spec.kind == BodyKind::Static {
            spec.velocity.clear();
            spec.angular_velocity.clear();
        } else {
            spec.velocity = body.velocity().iter().collect();
            let spin = body.angular_velocity();
            let spins = planes::all(N).map(|(i, j)| (planes::name(i, j), spin.get(i, j)));
            spec.angular_velocity = spins.filter(|(_, rate)| *rate != 0.0).collect();
        }
        Some(spec)
    }
}

/// What a ray met.
#[derive(Clone, Copy, Debug)]
struct Hit<const N: usize> {
    body: u32,
    point: Vector<N>,
    distance: f64,
}

impl<const N: usize> Hit<N> {
    fn told(&self) -> Value {
        json!({ "body": self.body, "point": numbers(self.point), "distance": self.distance })
    }
}

/// The turn by angles in planes; planes that are not there do nothing.
fn turn_of<const N: usize>(angles: &std::collections::BTreeMap<String, f64>) -> Rotation<N> {
    let mut sum = Bivector::ZERO;
    for (name, angle) in angles {
        if let Some((i, j)) = planes::from_name(N, name)
            && angle.is_finite()
        {
            sum += Bivector::plane(i, j, *angle);
        }
    }
    Rotation::exp(&sum)
}

fn rotation_of<const N: usize>(rows: &[Vec<f64>]) -> Option<Rotation<N>> {
    let rows: Vec<Vector<N>> = rows.iter().map(|row| Vector::from_slice(row)).collect::<Option<_>>()?;
    if rows.len() != N {
        return None;
    }
    Rotation::nearest(&Matrix::from_fn(|i, j| rows[i][j]))
}
