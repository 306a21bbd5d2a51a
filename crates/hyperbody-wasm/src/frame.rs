//! The arrays of a frame, in the order in which the worker reads them.

/// Everything that is drawn. Kept from frame to frame, so that nothing is allocated once it has grown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Buffers {
    /// Triangles of all sections.
    pub surface_positions: Vec<f32>,
    /// See [`crate::Mesh`].
    pub surface_normals: Vec<f32>,
    /// See [`crate::Mesh`].
    pub surface_cells: Vec<u16>,
    /// Body, first corner, number of corners.
    pub surface_ranges: Vec<u32>,
    /// Ends of crisp edges.
    pub edge_positions: Vec<f32>,
    /// Body, first end, number of ends.
    pub edge_ranges: Vec<u32>,
    /// Triangles of ghosts.
    pub ghost_positions: Vec<f32>,
    /// Their normals.
    pub ghost_normals: Vec<f32>,
    /// Body, first corner, number of corners.
    pub ghost_ranges: Vec<u32>,
    /// Signed distance of each ghost's body from the slice, m.
    pub ghost_distances: Vec<f32>,
    /// Ends of the segments of wireframes.
    pub wire_positions: Vec<f32>,
    /// How far off the slice each end is, m.
    pub wire_off: Vec<f32>,
    /// Body, first end, number of ends.
    pub wire_ranges: Vec<u32>,
    /// Rods of joints: both ends of each, slice coordinates (three numbers) and how far off the slice it is, m.
    pub joint_rods: Vec<f32>,
    /// Anchors of joints, four numbers each, like the ends of rods.
    pub joint_marks: Vec<f32>,
    /// Body, normal in slice coordinates (three numbers), offset.
    pub half_spaces: Vec<f32>,
    /// Body, then lowest and highest along each off direction.
    pub strip: Vec<f32>,
    /// Body, slice coordinates (three numbers), off coordinates.
    pub centres: Vec<f32>,
    /// Bodies that sleep.
    pub asleep: Vec<u32>,
}

impl Buffers {
    pub(crate) fn clear(&mut self) {
        let Self {
            surface_positions,
            surface_normals,
            surface_cells,
            surface_ranges,
            edge_positions,
            edge_ranges,
            ghost_positions,
            ghost_normals,
            ghost_ranges,
            ghost_distances,
            wire_positions,
            wire_off,
            wire_ranges,
            joint_rods,
            joint_marks,
            half_spaces,
            strip,
            centres,
            asleep,
        } = self;
        let floats = [
            surface_positions,
            surface_normals,
            edge_positions,
            ghost_positions,
            ghost_normals,
            ghost_distances,
            wire_positions,
            wire_off,
            joint_rods,
            joint_marks,
            half_spaces,
            strip,
            centres,
        ];
        floats.into_iter().for_each(Vec::clear);
        [surface_ranges, edge_ranges, ghost_ranges, wire_ranges, asleep].into_iter().for_each(Vec::clear);
        surface_cells.clear();
    }

    /// Address and length of each array in the memory of the program, in the order of the fields: what a worker reads
    /// them by, without a copy in between.
    #[must_use]
    pub fn layout(&self) -> Vec<usize> {
        let float = |list: &Vec<f32>| [list.as_ptr() as usize, list.len()];
        let whole = |list: &Vec<u32>| [list.as_ptr() as usize, list.len()];
        [
            float(&self.surface_positions),
            float(&self.surface_normals),
            [self.surface_cells.as_ptr() as usize, self.surface_cells.len()],
            whole(&self.surface_ranges),
            float(&self.edge_positions),
            whole(&self.edge_ranges),
            float(&self.ghost_positions),
            float(&self.ghost_normals),
            whole(&self.ghost_ranges),
            float(&self.ghost_distances),
            float(&self.wire_positions),
            float(&self.wire_off),
            whole(&self.wire_ranges),
            float(&self.joint_rods),
            float(&self.joint_marks),
            float(&self.half_spaces),
            float(&self.strip),
            float(&self.centres),
            whole(&self.asleep),
        ]
        .concat()
    }
}
