//! Which bodies a query sees.

use crate::body::Body;
use crate::{BodyHandle, BodyKind, Groups};

/// What a body has to be for a query to see it: all that is set at once. The default, [`QueryFilter::ALL`], sees every body,
/// whatever its groups, and sensors, too.
///
/// ```
/// use hyperbody_dynamics::{BodyDef, Groups, QueryFilter, QueryScratch, World, WorldDef};
/// use hyperbody_geometry::Shape;
///
/// const GLASS: u32 = 1 << 3;
/// let mut world = World::<4>::new(WorldDef::default())?;
/// let pane = BodyDef::fixed(Shape::cuboid([0.01, 1.0, 1.0, 1.0])?).groups(Groups::new(GLASS, u32::MAX));
/// let pane = world.add_body(pane)?;
/// let seen = |filter: QueryFilter<'_>| {
///     let mut bodies = Vec::new();
///     world.queries().bodies_at([0.0; 4], &mut QueryScratch::default(), &filter, &mut bodies);
///     bodies
/// };
/// assert_eq!(seen(QueryFilter::ALL), [pane]);
/// assert_eq!(seen(QueryFilter::new().groups(Groups::new(u32::MAX, !GLASS))), []);
/// assert_eq!(seen(QueryFilter::new().only_dynamic()), []);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy)]
pub struct QueryFilter<'f> {
    /// `None` does not ask for groups at all.
    groups: Option<Groups>,
    exclude: Option<BodyHandle>,
    skip_sensors: bool,
    skip_dynamic: bool,
    skip_kinematic: bool,
    skip_fixed: bool,
    predicate: Option<&'f (dyn Fn(BodyHandle) -> bool + Sync)>,
}

impl<'f> QueryFilter<'f> {
    /// Sees every body: of every kind, in any groups or in none, sensors included.
    pub const ALL: QueryFilter<'static> = QueryFilter {
        groups: None,
        exclude: None,
        skip_sensors: false,
        skip_dynamic: false,
        skip_kinematic: false,
        skip_fixed: false,
        predicate: None,
    };

    /// Sees every body, to be narrowed down.
    #[must_use]
    pub const fn new() -> Self {
        QueryFilter::ALL
    }

    /// Only bodies that one with these groups would meet; see [`Groups::meets`]. With [`Groups::ALL`] that is every body
    /// that is in a group and meets one: not those with [`Groups::NONE`].
    #[must_use]
    pub const fn groups(mut self, groups: Groups) -> Self {
        self.groups = Some(groups);
        self
    }

    /// No sensors, which neither push nor are pushed.
    #[must_use]
    pub const fn without_sensors(mut self) -> Self {
        self.skip_sensors = true;
        self
    }

    /// Not this body: the one that asks, say.
    #[must_use]
    pub const fn excluding(mut self, body: BodyHandle) -> Self {
        self.exclude = Some(body);
        self
    }

    /// No bodies moved by forces.
    #[must_use]
    pub const fn without_dynamic(mut self) -> Self {
        self.skip_dynamic = true;
        self
    }

    /// No bodies that are led.
    #[must_use]
    pub const fn without_kinematic(mut self) -> Self {
        self.skip_kinematic = true;
        self
    }

    /// No static bodies.
    #[must_use]
    pub const fn without_fixed(mut self) -> Self {
        self.skip_fixed = true;
        self
    }

    /// Only bodies moved by forces.
    #[must_use]
    pub const fn only_dynamic(self) -> Self {
        self.without_kinematic().without_fixed()
    }

    /// Only static bodies.
    #[must_use]
    pub const fn only_fixed(self) -> Self {
        self.without_kinematic().without_dynamic()
    }

    /// Only bodies for which `predicate` holds. It is asked last, for few bodies, in no particular order and, in batches,
    /// by several threads.
    #[must_use]
    pub const fn satisfying(mut self, predicate: &'f (dyn Fn(BodyHandle) -> bool + Sync)) -> Self {
        self.predicate = Some(predicate);
        self
    }

    /// Whether a query sees a body.
    #[inline]
    pub(crate) fn lets_through<const N: usize>(&self, handle: BodyHandle, body: &Body<N>) -> bool {
        let skipped = match body.kind {
            BodyKind::Dynamic => self.skip_dynamic,
            BodyKind::Kinematic => self.skip_kinematic,
            BodyKind::Static => self.skip_fixed,
        };
        let seen = !(skipped || self.skip_sensors && body.sensor)
            && self.groups.is_none_or(|groups| groups.meets(body.groups));
        seen && self.exclude != Some(handle) && self.predicate.is_none_or(|predicate| predicate(handle))
    }
}

impl Default for QueryFilter<'_> {
    fn default() -> Self {
        QueryFilter::ALL
    }
}

impl std::fmt::Debug for QueryFilter<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("QueryFilter")
            .field("groups", &self.groups)
            .field("skip_sensors", &self.skip_sensors)
            .field("exclude", &self.exclude)
            .field("skip_dynamic", &self.skip_dynamic)
            .field("skip_kinematic", &self.skip_kinematic)
            .field("skip_fixed", &self.skip_fixed)
            .field("predicate", &self.predicate.is_some())
            .finish()
    }
}
