//! What ties bodies together: one kind of joint, of which the usual ones are instances.
//!
//! # What a joint is
//!
//! A joint holds two *frames*, one fixed to each of its bodies (or one to the world): an anchor point and N axes. How the
//! second frame lies in the first is a translation of N numbers and a rotation, N(N−1)/2 planes. Every axis and every
//! plane is *free* or *locked*, and a free one may have limits, a motor and a spring ([`Freedom`]). Beside these there is
//! one more quantity, the distance of the two anchors, with a least and a greatest value.
//!
//! There is no axis to turn about in N dimensions; a plane turns, and what it leaves in place is the (N−2)-dimensional
//! space orthogonal to it. So joints are named by what they keep:
//!
//! | joint | keeps | translations left | turns left |
//! |---|---|---|---|
//! | [`JointDef::ball`] | a point | 0 | N(N−1)/2 |
//! | [`JointDef::hinge`] | an (N−2)-dimensional space, point by point: turns in one plane | 0 | 1 |
//! | [`JointDef::axle`] | a k-dimensional space, point by point | 0 | (N−k)(N−k−1)/2 |
//! | [`JointDef::weld`] | everything | 0 | 0 |
//! | [`JointDef::slider`] | all directions and a line | 1 | 0 |
//! | [`JointDef::distance`], [`JointDef::rope`] | the distance of two points, or its upper bound | N − 1 (N) | N(N−1)/2 |
//! | [`JointDef::mouse`], [`JointDef::grip`] | nothing: springs of limited force draw a point, or a frame, to a target | N | N(N−1)/2 |
//! | [`JointDef::lock`] | any axes and planes of a single body: without axis w and its planes a body of 4D moves as in 3D | the others | the others |
//! | [`JointDef::free`] | nothing, until axes and planes are locked one by one | those not locked | those not locked |
//! | [`JointDef::gear`], [`JointDef::rack`] | what rolls on each other: one number of both bodies ([`Coupling`]) | together N + N(N−1)/2 − 1 | |
//! | [`JointDef::screw`] | a line and a plane: goes along as it turns | together 1 | |
//!
//! A hinge is the axle of k = N−2, the ball that of k = 0, the weld that of k = N−1 or N. In 2D the hinge *is* the ball; in
//! 3D an axle keeps a line and is the hinge; from 4D on there are axles between: one that keeps a line in 4D leaves
//! the three turns of the space across it.
//!
//! | free motions (translations + turns) | 2D | 3D | 4D | 5D | 6D |
//! |---|---|---|---|---|---|
//! | no joint | 2 + 1 | 3 + 3 | 4 + 6 | 5 + 10 | 6 + 15 |
//! | ball | 0 + 1 | 0 + 3 | 0 + 6 | 0 + 10 | 0 + 15 |
//! | hinge | 0 + 1 | 0 + 1 | 0 + 1 | 0 + 1 | 0 + 1 |
//! | axle that keeps a line | 0 + 0 | 0 + 1 | 0 + 3 | 0 + 6 | 0 + 10 |
//! | axle that keeps a plane | 0 + 0 | 0 + 0 | 0 + 1 | 0 + 3 | 0 + 6 |
//! | weld | 0 + 0 | 0 + 0 | 0 + 0 | 0 + 0 | 0 + 0 |
//! | slider | 1 + 0 | 1 + 0 | 1 + 0 | 1 + 0 | 1 + 0 |
//! | distance | 1 + 1 | 2 + 3 | 3 + 6 | 4 + 10 | 5 + 15 |
//! | slack rope, mouse, grip | 2 + 1 | 3 + 3 | 4 + 6 | 5 + 10 | 6 + 15 |
//! | lock of an axis and its planes | 1 + 0 | 2 + 1 | 3 + 3 | 4 + 6 | 5 + 10 |
//!
//! | free motions, together | 2D | 3D | 4D | 5D | 6D |
//! |---|---|---|---|---|---|
//! | gear | 2 | 5 | 9 | 14 | 20 |
//! | rack | 2 | 5 | 9 | 14 | 20 |
//! | screw | none | 1 | 1 | 1 | 1 |
//!
//! The numbers are those of a test that computes the rank of each joint's rows (`solver/joints`).
//!
//! # Which planes can be free together
//!
//! A turn in xy followed by one in xz, and both back, is a turn in yz: motions within a set of free planes stay within it
//! only if the set is closed in this way. So the axes fall into groups, the planes within a group are free, and all planes
//! between groups are locked: the group of rotations is SO(n₁) × SO(n₂) × … Other choices are refused with the plane that
//! is missing. An *angle*, which limits and springs need, exists in a group of two axes; motors, which ask for a
//! speed alone, go in every free plane.
//!
//! What does not generalise from 3D: the twist of a ball joint. A group of three or more axes has no angles that could be limited one by
//! one. Its swing does: the angle between an axis of the one frame and the same of the other, [`JointDef::cone`], is one number in
//! every dimension.

mod access;
mod coupling;
mod def;
mod freedom;
mod rows;

pub use access::JointRef;
pub use coupling::Coupling;
pub use def::JointDef;
pub use freedom::{Freedom, Motor, Spring};
pub(crate) use rows::{Bound, Coordinate, Joint, Role, RowSpec, WORLD};
