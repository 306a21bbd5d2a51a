//! What is where in a world: rays, points, boxes and shapes against its bodies.
//!
//! | question | single | in batches |
//! |---|---|---|
//! | what does a ray meet first? | [`Queries::ray_cast`] | [`Queries::ray_casts`] |
//! | everything on its way; anything at all? | [`Queries::ray_cast_all`], [`Queries::ray_meets_any`] | |
//! | what does a moving, turning shape meet first? | [`Queries::shape_cast`] | [`Queries::shape_casts`] |
//! | which bodies hold a point? | [`Queries::bodies_at`] | [`Queries::bodies_at_each`] |
//! | which bodies meet a box, or a shape? | [`Queries::bodies_in`], [`Queries::bodies_touching`] | [`Queries::bodies_touching_each`] |
//! | which body is nearest to a point? | [`Queries::nearest_to_point`] | [`Queries::nearest_to_points`] |
//! | which is nearest to a shape, or within a distance? | [`Queries::nearest_to_shape`], [`Queries::bodies_near`] | |
//!
//! The same questions about single shapes, without a world, are in [`hyperbody_collision::query`]. A [`QueryFilter`] says
//! which bodies count. Batches run on the threads of the world and give the same answers for every number of them.
//!
//! The tree of the broad phase holds each body with a margin and follows it at the start of each step, so that between
//! steps a body that was struck, or moved by hand, may stand outside of its box. [`World::queries`] looks at every body
//! once and notes these few; it costs about as much as a dozen rays per hundred bodies. Make it once after a step and ask
//! it as often as needed, from as many threads as needed. Nothing of the simulation changes by being looked at.
//!
//! Everything is solid and closed; sleeping, static and quarantined bodies and sensors count like others, unless a filter
//! leaves them out. Coordinates of what is asked go up to ±1e30 m ([`FARTHEST`](hyperbody_collision::limits::FARTHEST));
//! what is beyond, or not finite, and negative reaches meet nothing.

use std::sync::OnceLock;

mod cast;
mod filter;
mod near;
mod rays;

pub use cast::BodyShapeHit;
pub use filter::QueryFilter;
pub use near::{BodyProjection, BodySeparation};
pub use rays::BodyHit;

use hyperbody_collision::ray::Ray;
use hyperbody_collision::{RayStack, RayTree, Scratch};
use hyperbody_geometry::Core;
use hyperbody_geometry::shape::Piece;
use hyperbody_math::Pose;
use rayon::prelude::*;

use crate::world::Collider;
use crate::{BodyHandle, World};

/// A world to be asked. It holds the world still for as long as it lives.
pub struct Queries<'w, const N: usize> {
    world: &'w World<N>,
    /// By the slot of the collider.
    world_from_collider: Vec<Pose<N>>,
    /// Radius of the ball about the origin of its frame that holds the collider; infinite for half-spaces.
    reaches: Vec<f64>,
    /// The tree as rays walk it, with boxes as tight as they come cheaply; made when the first ray asks.
    rays: OnceLock<RayTree<N>>,
    /// For a single question, for which making it would not pay.
    single: bool,
    /// Colliders that the tree does not hold where they are: half-spaces, and those out of their boxes. Ascending.
    apart: Vec<u32>,
    /// The same, by slot.
    is_apart: Vec<bool>,
}

/// Working memory of single queries, to be kept so that nothing is allocated once it has grown. Its contents never
/// influence a result.
#[derive(Clone, Debug, Default)]
pub struct QueryScratch<const N: usize> {
    pub(super) rays: RayStack,
    pub(super) nodes: Vec<u32>,
    pub(super) pair: Scratch<N>,
}

/// Questions of a batch that one task answers: enough to hide what it costs to start a task.
const QUESTIONS_PER_TASK: usize = 64;

impl<const N: usize> World<N> {
    /// The world as it is now, to be asked. See [`Queries`].
    #[must_use]
    pub fn queries(&self) -> Queries<'_, N> {
        let mut queries = Queries {
            world: self,
            world_from_collider: Vec::with_capacity(self.colliders.len()),
            reaches: Vec::with_capacity(self.colliders.len()),
            rays: OnceLock::new(),
            single: false,
            apart: Vec::new(),
            is_apart: Vec::with_capacity(self.colliders.len()),
        };
        for (slot, collider) in self.colliders.iter().enumerate() {
            let (pose, apart) = match collider {
                Some(collider) => self.place(collider),
                None => (Pose::IDENTITY, false),
            };
            if apart {
                queries.apart.push(slot as u32);
            }
            queries.world_from_collider.push(pose);
            queries.is_apart.push(apart);
            let bounded = collider.as_ref().filter(|collider| collider.proxy.is_some());
            queries.reaches.push(bounded.map_or(f64::INFINITY, |collider| collider.reach));
        }
        queries
    }

    /// Where a collider is, and whether the tree does not know.
    fn place(&self, collider: &Collider<N>) -> (Pose<N>, bool) {
        let Some(body) = self.bodies.at(collider.body) else { return (collider.world_from_collider, true) };
        let pose = body.world_from_body() * collider.body_from_collider;
        let known = pose == collider.world_from_collider;
        match &collider.piece {
            Piece::Convex(convex) if collider.proxy.is_some() => {
                (pose, !known && !collider.fat_aabb.contains(&convex.aabb(&pose)))
            }
            _ => (pose, true),
        }
    }

    /// The first body that a ray meets: [`Queries::ray_cast`] for a single ray, with [`QueryFilter::ALL`], which sees sensors,
    /// too.
    #[must_use]
    pub fn ray_cast(&self, ray: &Ray<N>) -> Option<BodyHit<N>> {
        let mut queries = self.queries();
        queries.single = true;
        queries.ray_cast(ray, &mut QueryScratch::default(), &QueryFilter::ALL)
    }
}

impl<const N: usize> Queries<'_, N> {
    /// The tree as rays walk it.
    fn ray_tree(&self) -> &RayTree<N> {
        self.rays.get_or_init(|| {
            self.world.tree.for_rays(|slot, fat| match &self.world.colliders[slot as usize] {
                Some(Collider { piece: Piece::Convex(convex), .. })
                    if !(self.is_apart[slot as usize] || matches!(convex.core, Core::Polytope(_))) =>
                {
                    convex.aabb(&self.world_from_collider[slot as usize])
                }
                _ => *fat,
            })
        })
    }

    /// A collider that the filter lets through, with its pose and its body.
    #[inline]
    fn candidate(&self, slot: u32, filter: &QueryFilter<'_>) -> Option<(&Collider<N>, &Pose<N>, BodyHandle)> {
        let collider = self.world.colliders[slot as usize].as_ref()?;
        let body = self.world.bodies.at(collider.body)?;
        let handle = self.world.bodies.handle_at(collider.body)?;
        filter.lets_through(handle, body).then(|| (collider, &self.world_from_collider[slot as usize], handle))
    }

    /// Which part of its body's shape a collider is.
    fn part(&self, slot: u32) -> u32 {
        let siblings = self.world.colliders[slot as usize]
            .as_ref()
            .and_then(|collider| self.world.bodies.at(collider.body))
            .map_or(&[][..], |body| &body.colliders);
        siblings.iter().position(|&other| other == slot).unwrap_or(0) as u32
    }

    /// Answers many questions on the threads of the world, in their order.
    fn batch<Q: Sync, A: Send>(
        &self,
        questions: &[Q],
        out: &mut Vec<A>,
        answer: impl Fn(&Q, &mut QueryScratch<N>) -> A + Sync,
    ) {
        out.clear();
        let task = |questions: &[Q]| {
            let mut scratch = QueryScratch::default();
            questions.iter().map(|question| answer(question, &mut scratch)).collect::<Vec<A>>()
        };
        match &self.world.pool {
            Some(pool) if questions.len() > QUESTIONS_PER_TASK => {
                let parts: Vec<Vec<A>> = pool.install(|| questions.par_chunks(QUESTIONS_PER_TASK).map(task).collect());
                out.extend(parts.into_iter().flatten());
            }
            _ => out.extend(task(questions)),
        }
    }
}
