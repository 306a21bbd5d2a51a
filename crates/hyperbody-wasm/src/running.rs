//! A scene that runs: its world, what is drawn of each body, hands, and the past.

use std::sync::Arc;

use hyperbody::geometry::Solid;
use hyperbody::math::{Dim, EvenAlgebra, Pose, Vector};
use hyperbody::prelude::{BodyHandle, BodyKind, Polytope, Shape, World};
use hyperbody_scene::{Body, Joint, Scene, SceneError};

use crate::cut::{Cutter, Drawn};
use crate::draw::Drawing;
use crate::drawable::Drawable;
use crate::hands::Hand;
use crate::history::{BodyMoment, History, Moment};
use crate::impacts::Impacts;
use crate::joints::DrawnJoint;
use crate::view::View;

/// A body of the scene. Bodies that were removed keep their place, so that numbers stay and undo brings them back.
pub(crate) struct Entry<const N: usize> {
    /// As the scene says it, under the name that it has here.
    pub(crate) spec: Body,
    pub(crate) name: String,
    /// `None`: not in the world.
    pub(crate) handle: Option<BodyHandle>,
    pub(crate) drawable: Arc<Drawable<N>>,
    pub(crate) colour_index: u32,
    pub(crate) mass: f64,
    /// About the centre of mass, m.
    pub(crate) radius: f64,
    pub(crate) centre_in_body: Vector<N>,
    /// Held where it is: static for the time being.
    pub(crate) frozen: bool,
    pub(crate) drawing: Drawing<N>,
}

impl<const N: usize> Entry<N> {
    /// The body as it takes part now.
    pub(crate) fn spec_now(&self) -> Body {
        let mut spec = self.spec.clone();
        if self.frozen {
            spec.kind = BodyKind::Static;
        }
        spec
    }
}

/// A scene of `N` dimensions that runs.
pub(crate) struct Running<const N: usize> {
    /// As it was loaded, for its settings and its materials.
    pub(crate) scene: Scene,
    pub(crate) world: World<N>,
    pub(crate) entries: Vec<Entry<N>>,
    /// What the steps of the world lack to those since the scene's start, modulo 2⁶⁴.
    pub(crate) first_step: u64,
    pub(crate) view: View<N>,
    pub(crate) ghosts: Option<f64>,
    pub(crate) wires: bool,
    pub(crate) selected: Option<u32>,
    pub(crate) hands: Vec<Hand<N>>,
    pub(crate) history: History<N>,
    pub(crate) impacts: Impacts<N>,
    pub(crate) cutter: Cutter,
    /// What is drawn of the joints of the world.
    pub(crate) joints: Vec<DrawnJoint<N>>,
    /// Shapes that several bodies have.
    shapes: Vec<(Shape<N>, Arc<Drawable<N>>)>,
    /// Whether balls are drawn finely: there are few.
    pub(crate) fine: bool,
}

/// More round bodies than this are drawn with fewer triangles each.
const FEW: usize = 40;

impl<const N: usize> Running<N>
where
    Dim<N>: EvenAlgebra,
    Solid<N>: Drawn<N>,
{
    pub(crate) fn new(scene: Scene) -> Result<Self, SceneError> {
        let (world, handles) = scene.world::<N>(1)?;
        let names = scene.body_names();
        let mut running = Self {
            fine: scene.bodies.len() <= FEW,
            world,
            entries: Vec::with_capacity(handles.len()),
            first_step: 0,
            view: View::home(),
            ghosts: None,
            wires: false,
            selected: None,
            hands: Vec::new(),
            history: History::default(),
            impacts: Impacts::default(),
            cutter: Cutter::new(),
            joints: Vec::new(),
            shapes: Vec::new(),
            scene,
        };
        for ((body, name), handle) in running.scene.bodies.clone().into_iter().zip(names).zip(handles) {
            running.add_entry(body, name, handle);
        }
        running.joints = running.joints_to_draw();
        running.record();
        Ok(running)
    }

    /// Notes a body that is in the world, and returns its number.
    pub(crate) fn add_entry(&mut self, mut spec: Body, name: String, handle: BodyHandle) -> u32 {
        spec.name = Some(name.clone());
        let (drawable, mass, radius, centre_in_body) = match self.world.body(handle) {
            Some(body) => {
                let (shape, mass) = (body.shape().clone(), body.mass());
                let centre = body.pose().inverse_transform_point(body.centre_of_mass());
                let radius = reach(&shape, centre);
                (self.drawable(&shape), mass, radius, centre)
            }
            None => (Arc::new(Drawable::new(&Shape::Ball { radius: 1.0 }, &mut self.cutter)), 0.0, 0.0, Vector::ZERO),
        };
        let colour_index = self.entries.iter().filter(|entry| entry.drawable.half_space().is_none()).count() as u32;
        self.entries.push(Entry {
            spec,
            name,
            handle: Some(handle),
            drawable,
            colour_index,
            mass,
            radius,
            centre_in_body,
            frozen: false,
            drawing: Drawing::default(),
        });
        self.entries.len() as u32 - 1
    }

    /// What is drawn of a shape, shared by bodies of the same one.
    fn drawable(&mut self, shape: &Shape<N>) -> Arc<Drawable<N>> {
        if let Some((_, known)) = self.shapes.iter().rev().find(|(other, _)| is_same(shape, other)) {
            return Arc::clone(known);
        }
        let drawable = Arc::new(Drawable::new(shape, &mut self.cutter));
        self.shapes.push((shape.clone(), Arc::clone(&drawable)));
        drawable
    }

    /// One step of the world; nothing while an earlier moment is shown.
    pub(crate) fn step(&mut self) {
        if self.history.shown().is_some() {
            return;
        }
        for hand in &self.hands {
            hand.pull(&mut self.world);
        }
        self.world.step();
        self.impacts.look(&self.world);
        self.record();
    }

    fn record(&mut self) {
        let spare = self.history.spare(self.entries.len(), self.world.dt());
        let moment = self.filled(spare);
        self.history.record(moment);
    }

    /// Steps since the scene's start.
    pub(crate) fn step_count(&self) -> u64 {
        // Going on from the past may have begun to count below zero.
        self.first_step.wrapping_add(self.world.step_count())
    }

    /// The present.
    pub(crate) fn moment(&self) -> Moment<N> {
        self.filled(Moment::default())
    }

    fn filled(&self, mut moment: Moment<N>) -> Moment<N> {
        moment.step = self.step_count();
        moment.energy = self.world.energy();
        for (id, entry) in self.entries.iter().enumerate() {
            let Some(body) = entry.handle.and_then(|handle| self.world.body(handle)) else { continue };
            moment.bodies.push(BodyMoment {
                id: id as u32,
                pose: body.pose(),
                velocity: body.velocity(),
                angular_velocity: body.angular_velocity(),
                angular_momentum: body.angular_momentum(),
                kinetic: body.kinetic_energy(),
                asleep: body.is_sleeping(),
                frozen: entry.frozen,
            });
        }
        moment
    }

    /// Makes a moment the present: puts every body where it was. What has been removed since then comes back, what has been
    /// added goes. Hands let go of what is gone or does not move.
    pub(crate) fn restore(&mut self, moment: &Moment<N>) -> Result<(), SceneError> {
        let moves = |id: u32| moment.bodies.iter().any(|body| body.id == id && !body.frozen);
        self.hands.retain(|hand| moves(hand.body));
        let now = self.entries.iter().enumerate().filter(|(_, entry)| entry.handle.is_some());
        let now = now.map(|(id, entry)| (id as u32, entry.frozen));
        if !now.eq(moment.bodies.iter().map(|body| (body.id, body.frozen))) {
            self.rebuild(moment)?;
        }
        moment.bodies.iter().for_each(|state| self.put(state));
        self.first_step = moment.step.wrapping_sub(self.world.step_count());
        Ok(())
    }

    fn put(&mut self, state: &BodyMoment<N>) {
        let handle = self.entries.get(state.id as usize).and_then(|entry| entry.handle);
        let Some(mut body) = handle.and_then(|handle| self.world.body_mut(handle)) else { return };
        // What stands where it stood is left alone. Refusals are those of static bodies, which have no velocity.
        if body.as_ref().pose() != state.pose {
            let _ = body.set_pose(state.pose);
        }
        let _ = body.set_velocity(state.velocity);
        let _ = body.set_angular_velocity(state.angular_velocity);
    }

    /// A new world of the bodies of a moment.
    fn rebuild(&mut self, moment: &Moment<N>) -> Result<(), SceneError> {
        let mut scene = self.scene.clone();
        let wanted: Vec<usize> = moment.bodies.iter().map(|body| body.id as usize).collect();
        for state in &moment.bodies {
            self.entries[state.id as usize].frozen = state.frozen;
        }
        scene.bodies = wanted.iter().map(|&id| self.entries[id].spec_now()).collect();
        // A joint between bodies that nothing moves has nothing to do, and worlds refuse it.
        let moves =
            |name: &str| scene.bodies.iter().any(|b| b.name.as_deref() == Some(name) && b.kind == BodyKind::Dynamic);
        let joints = std::mem::take(&mut scene.joints).into_iter();
        let of_these = joints.filter(|joint| self.joint_has_bodies(joint, &wanted));
        scene.joints =
            of_these.filter(|joint| joint.body_names().0.is_some_and(moves) || moves(joint.body_names().1)).collect();
        scene.gravity = self.world.gravity().iter().collect();
        let (world, handles) = scene.world::<N>(1)?;
        self.world = world;
        self.impacts = Impacts::default();
        for entry in &mut self.entries {
            entry.handle = None;
        }
        for (&id, handle) in wanted.iter().zip(handles) {
            self.entries[id].handle = Some(handle);
            for hand in self.hands.iter_mut().filter(|hand| hand.body as usize == id) {
                hand.handle = handle;
            }
        }
        self.joints = self.joints_to_draw();
        Ok(())
    }

    /// Whether the bodies of a joint are among these.
    pub(crate) fn joint_has_bodies(&self, joint: &Joint, ids: &[usize]) -> bool {
        let is_there = |name: &str| ids.iter().any(|&id| self.entries[id].name == name);
        let (a, b) = joint.body_names();
        a.is_none_or(is_there) && is_there(b)
    }

    /// The number of a body of the world.
    pub(crate) fn id_of(&self, handle: BodyHandle) -> Option<u32> {
        self.entries.iter().position(|entry| entry.handle == Some(handle)).map(|id| id as u32)
    }

    /// Middle and radius of what can move; of all that ends, if nothing can.
    pub(crate) fn extent(&self) -> (Vector<N>, f64) {
        let places = |moving: bool| -> Vec<(Vector<N>, f64)> {
            let bodies =
                self.entries.iter().filter(|entry| entry.drawable.half_space().is_none()).filter_map(|entry| {
                    let body = self.world.body(entry.handle?)?;
                    (!moving || body.kind() == BodyKind::Dynamic).then(|| (body.centre_of_mass(), entry.radius))
                });
            bodies.collect()
        };
        let mut places_of_all = places(true);
        if places_of_all.is_empty() {
            places_of_all = places(false);
        }
        let Some(&(first, _)) = places_of_all.first() else { return (Vector::ZERO, 1.0) };
        let corners = places_of_all.iter().fold((first, first), |(low, high), (p, _)| (low.min(*p), high.max(*p)));
        let middle = (corners.0 + corners.1) * 0.5;
        let extent = places_of_all.iter().map(|(place, radius)| place.distance(middle) + radius).fold(0.0, f64::max);
        (middle, extent.max(1e-3))
    }
}

/// Largest distance of a point of a shape from a point of its frame, m; 0 for half-spaces.
fn reach<const N: usize>(shape: &Shape<N>, centre: Vector<N>) -> f64 {
    use hyperbody::geometry::shape::Piece;
    let of_piece = |(pose, piece): &(Pose<N>, Piece<N>)| match piece {
        Piece::Convex(convex) => pose.translation.distance(centre) + convex.bounding_radius(),
        Piece::HalfSpace { .. } => 0.0,
    };
    shape.pieces().iter().map(of_piece).fold(0.0, f64::max)
}

/// Whether two shapes are known to be the same.
fn is_same<const N: usize>(a: &Shape<N>, b: &Shape<N>) -> bool {
    let same = |a: &Arc<Polytope<N>>, b: &Arc<Polytope<N>>| Arc::ptr_eq(a, b);
    match (a, b) {
        (Shape::Ball { radius: a }, Shape::Ball { radius: b }) => a == b,
        (Shape::Box { half_extents: a }, Shape::Box { half_extents: b }) => a == b,
        (Shape::Polytope(a), Shape::Polytope(b)) => same(a, b),
        (
            Shape::Capsule { half_length: l, radius: r, along: a },
            Shape::Capsule { half_length: m, radius: s, along: b },
        ) => (l, r, a) == (m, s, b),
        _ => false,
    }
}
