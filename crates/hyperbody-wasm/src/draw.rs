//! The picture of a moment: every body cut by the slice, with ghosts, wireframes and extents.
//!
//! A section is kept as long as neither its body nor the slice moves, so that a pile at rest costs a copy.

use hyperbody::geometry::Solid;
use hyperbody::math::{Dim, EvenAlgebra, Pose, Vector};

use crate::cut::{Cutter, Drawn};
use crate::drawable::{Drawable, signed_off};
use crate::frame::Buffers;
use crate::history::BodyMoment;
use crate::mesh::Mesh;
use crate::running::Running;
use crate::view::{View, seen};

/// What was drawn of a body, and for which pose and slice.
#[derive(Clone, Debug, Default)]
pub(crate) struct Drawing<const N: usize> {
    section: Kept<N>,
    ghost: Kept<N>,
}

#[derive(Clone, Debug, Default)]
struct Kept<const N: usize> {
    made_for: Option<(Pose<N>, View<N>)>,
    mesh: Mesh,
}

impl<const N: usize> Kept<N>
where
    Solid<N>: Drawn<N>,
{
    fn mesh(
        &mut self,
        drawable: &Drawable<N>,
        pose: &Pose<N>,
        view: &View<N>,
        cutter: &mut Cutter,
        fine: bool,
    ) -> &Mesh {
        if self.made_for != Some((*pose, *view)) {
            self.mesh.clear();
            drawable.draw(pose, view, cutter, fine, &mut self.mesh);
            self.made_for = Some((*pose, *view));
        }
        &self.mesh
    }
}

impl<const N: usize> Running<N>
where
    Dim<N>: EvenAlgebra,
    Solid<N>: Drawn<N>,
{
    /// Fills the arrays of a frame with the moment that is shown.
    pub(crate) fn draw(&mut self, buffers: &mut Buffers) {
        buffers.clear();
        let moment = match self.history.shown() {
            Some(moment) => moment.clone(),
            None => self.moment(),
        };
        for state in &moment.bodies {
            self.draw_body(state, buffers);
            if state.asleep {
                buffers.asleep.push(state.id);
            }
        }
        self.draw_joints(&moment, buffers);
    }

    fn draw_body(&mut self, state: &BodyMoment<N>, buffers: &mut Buffers) {
        let (view, ghosts, wires, fine) = (self.view, self.ghosts, self.wires, self.fine);
        let Some(entry) = self.entries.get_mut(state.id as usize) else { return };
        let body_from_slice = state.pose.relative(&view.pose);
        if let Some((normal, offset)) = entry.drawable.half_space() {
            half_space(state.id, normal, offset, &body_from_slice, view.drawn, buffers);
            return;
        }
        let centre_in_body = entry.centre_in_body;
        let centre = state.pose.transform_point(centre_in_body);
        let coordinates = view.coordinates(centre);
        buffers.centres.push(state.id as f32);
        buffers.centres.extend(seen(coordinates, view.drawn).0.map(|c| c as f32));
        buffers.strip.push(state.id as f32);
        let mut gap = Vector::<N>::ZERO;
        for axis in view.drawn..N {
            let [low, high] = entry.drawable.extent(&body_from_slice, axis);
            buffers.centres.push(coordinates[axis] as f32);
            buffers.strip.extend([low as f32, high as f32]);
            gap[axis] = if low > 0.0 {
                low
            } else if high < 0.0 {
                high
            } else {
                0.0
            };
        }
        let drawable = &entry.drawable;
        let mut is_cut = false;
        if gap == Vector::ZERO {
            let mesh = entry.drawing.section.mesh(drawable, &state.pose, &view, &mut self.cutter, fine);
            is_cut = mesh.corner_count() > 0;
            add_section(state.id, mesh, buffers);
        }
        let distance =
            if gap == Vector::ZERO { signed_off(coordinates, view.drawn) } else { signed_off(gap, view.drawn) };
        if !is_cut && distance != 0.0 && view.drawn < N && ghosts.is_some_and(|reach| distance.abs() <= reach) {
            // The shape of a ghost depends on how the body is turned and where it is across the slice alone.
            let through = view.through(centre);
            let mesh = entry.drawing.ghost.mesh(drawable, &state.pose, &through, &mut self.cutter, fine);
            if mesh.corner_count() > 0 {
                let first = buffers.ghost_positions.len() / 3;
                buffers.ghost_positions.extend_from_slice(&mesh.positions);
                buffers.ghost_normals.extend_from_slice(&mesh.normals);
                buffers.ghost_ranges.extend([state.id, first as u32, mesh.corner_count() as u32]);
                buffers.ghost_distances.push(distance as f32);
            }
        }
        if wires {
            let first = buffers.wire_off.len();
            drawable.add_wires(&state.pose, &view, &mut buffers.wire_positions, &mut buffers.wire_off);
            let count = buffers.wire_off.len() - first;
            buffers.wire_ranges.extend([state.id, first as u32, count as u32]);
        }
    }
}

fn add_section(id: u32, mesh: &Mesh, buffers: &mut Buffers) {
    if mesh.corner_count() > 0 {
        let first = buffers.surface_cells.len();
        buffers.surface_positions.extend_from_slice(&mesh.positions);
        buffers.surface_normals.extend_from_slice(&mesh.normals);
        buffers.surface_cells.extend_from_slice(&mesh.cells);
        buffers.surface_ranges.extend([id, first as u32, mesh.corner_count() as u32]);
    }
    if !mesh.edges.is_empty() {
        let first = buffers.edge_positions.len() / 3;
        buffers.edge_positions.extend_from_slice(&mesh.edges);
        buffers.edge_ranges.extend([id, first as u32, (mesh.edges.len() / 3) as u32]);
    }
}

/// The section of a half-space, unless the slice lies along its boundary.
fn half_space<const N: usize>(
    id: u32,
    normal: Vector<N>,
    offset: f64,
    body_from_slice: &Pose<N>,
    drawn: usize,
    buffers: &mut Buffers,
) {
    let within = seen(body_from_slice.rotation.inverse_rotate(normal), drawn);
    let length = within.norm();
    if length > 1e-6 {
        let rest = offset - normal.dot(body_from_slice.translation);
        buffers.half_spaces.push(id as f32);
        buffers.half_spaces.extend((within / length).0.map(|c| c as f32));
        buffers.half_spaces.push((rest / length) as f32);
    }
}
