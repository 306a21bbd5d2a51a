//! Joints as they are drawn: a mark at each anchor, a thin rod from it to the body that it belongs to, and one between anchors
//! that a joint holds at a distance.
//!
//! Where the anchor lies apart from the body, the rod leads to its surface. Where it lies on or in a convex body that moves,
//! the rod leads to its middle: a section hides that, and of what lies off the slice it shows how it hangs. An anchor stays
//! where it is in the frame of its body, so this is found once, by a ray from the anchor to the centre of mass; a frame only
//! moves points. What ties no places together, a gear or a motor, is not drawn.

use hyperbody::collision::ray::{Ray, cast};
use hyperbody::geometry::Solid;
use hyperbody::math::{Dim, EvenAlgebra, Pose, Vector};
use hyperbody::prelude::{BodyKind, JointDef, JointHandle};

use crate::cut::Drawn;
use crate::drawable::signed_off;
use crate::frame::Buffers;
use crate::history::Moment;
use crate::running::Running;
use crate::view::{View, seen};

/// Points nearer to each other than this share of the smaller body's radius are one.
const SAME_POINT: f64 = 0.02;

/// A joint of the world, as far as it stays the same.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DrawnJoint<const N: usize> {
    handle: JointHandle,
    a: Side<N>,
    b: Side<N>,
    /// Points nearer to each other than this are one, m.
    same: f64,
}

/// What one body of a joint has of it.
#[derive(Clone, Copy, Debug)]
struct Side<const N: usize> {
    /// Number of the body; `None`: the world.
    body: Option<u32>,
    /// In the frame of the body, m.
    anchor: Vector<N>,
    /// Where the rod from the anchor ends, in the frame of the body, if it has one.
    foot: Option<Vector<N>>,
}

impl<const N: usize> Running<N>
where
    Dim<N>: EvenAlgebra,
    Solid<N>: Drawn<N>,
{
    /// The joints of the world as it is; to be called when it is new. Joints that go later are left out when drawn.
    pub(crate) fn joints_to_draw(&self) -> Vec<DrawnJoint<N>> {
        let joints = self.world.joints().filter(|(_, joint)| holds_places(joint.def()));
        let drawn = joints.filter_map(|(handle, joint)| {
            let def = joint.def();
            let (a, b) = (def.a.and_then(|a| self.id_of(a)), self.id_of(def.b)?);
            let radii = [a, Some(b)].into_iter().flatten().map(|id| self.entries[id as usize].radius);
            let same = SAME_POINT * radii.filter(|&radius| radius > 0.0).fold(f64::INFINITY, f64::min);
            Some(DrawnJoint {
                handle,
                a: self.side(a, def.frame_a.translation, same),
                b: self.side(Some(b), def.frame_b.translation, same),
                same,
            })
        });
        drawn.collect()
    }

    fn side(&self, body: Option<u32>, anchor: Vector<N>, same: f64) -> Side<N> {
        let entry = body.map(|id| &self.entries[id as usize]);
        // A half-space has no middle that a rod could lead to.
        let entry = entry.filter(|entry| entry.drawable.half_space().is_none());
        let foot = entry.and_then(|entry| {
            let (centre, body) = (entry.centre_in_body, self.world.body(entry.handle?)?);
            let met = cast(&Ray::between(anchor, centre), body.shape(), &Pose::IDENTITY)?.point;
            let hangs = entry.spec.kind == BodyKind::Dynamic && body.shape().pieces().len() == 1;
            let ends = [Some(met), hangs.then_some(centre)].into_iter().flatten();
            ends.into_iter().find(|end| end.distance(anchor) > same)
        });
        Side { body, anchor, foot }
    }

    /// Adds the joints to the arrays of a frame.
    pub(crate) fn draw_joints(&self, moment: &Moment<N>, buffers: &mut Buffers) {
        for joint in &self.joints {
            if self.world.joint(joint.handle).is_none() {
                continue;
            }
            let (Some(a), Some(b)) = (joint.a.in_world(moment), joint.b.in_world(moment)) else { continue };
            for (anchor, foot) in [a, b] {
                if let Some(foot) = foot {
                    rod(&self.view, anchor, foot, &mut buffers.joint_rods);
                }
            }
            let (from, to) = (a.0, b.0);
            push(&self.view, to, &mut buffers.joint_marks);
            if from.distance(to) > joint.same {
                push(&self.view, from, &mut buffers.joint_marks);
                rod(&self.view, from, to, &mut buffers.joint_rods);
            }
        }
    }
}

impl<const N: usize> Side<N> {
    /// The anchor and the foot of its rod; `None` where the body is not there.
    fn in_world(&self, moment: &Moment<N>) -> Option<(Vector<N>, Option<Vector<N>>)> {
        let Some(id) = self.body else { return Some((self.anchor, None)) };
        let at = moment.bodies.binary_search_by_key(&id, |state| state.id).ok()?;
        let pose = moment.bodies[at].pose;
        Some((pose.transform_point(self.anchor), self.foot.map(|foot| pose.transform_point(foot))))
    }
}

/// Whether a joint ties places together.
fn holds_places<const N: usize>(def: &JointDef<N>) -> bool {
    def.distance.is_some() || def.axes.iter().any(|axis| axis.locked)
}

fn rod<const N: usize>(view: &View<N>, from: Vector<N>, to: Vector<N>, rods: &mut Vec<f32>) {
    push(view, from, rods);
    push(view, to, rods);
}

/// Adds a point: where it is drawn, and how far off the slice it lies.
fn push<const N: usize>(view: &View<N>, point: Vector<N>, list: &mut Vec<f32>) {
    let coordinates = view.coordinates(point);
    list.extend(seen(coordinates, view.drawn).0.map(|c| c as f32));
    list.push(signed_off(coordinates, view.drawn) as f32);
}
