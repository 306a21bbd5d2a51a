//! Surfaces as OFF, OBJ and STL.

use std::fmt::Write as _;

use super::Surface;

impl Surface {
    /// An OFF file of three dimensions, with all polygons as they are.
    #[must_use]
    pub fn to_off(&self) -> String {
        // Every polygon side is shared by two polygons.
        let mut text = format!("OFF\n{} {} {}\n", self.vertices.len(), self.polygons.len(), self.corners.len() / 2);
        for v in &self.vertices {
            let _ = writeln!(text, "{} {} {}", v[0], v[1], v[2]);
        }
        for (corners, _) in self.polygons() {
            let _ = write!(text, "{}", corners.len());
            for corner in corners {
                let _ = write!(text, " {corner}");
            }
            text.push('\n');
        }
        text
    }

    /// A Wavefront OBJ file with all polygons as they are, those of each source in a group `cell_K`.
    #[must_use]
    pub fn to_obj(&self) -> String {
        let mut text = String::from("# A section, one group for each cell of the body that it cuts\n");
        for v in &self.vertices {
            let _ = writeln!(text, "v {} {} {}", v[0], v[1], v[2]);
        }
        let mut last = None;
        for (corners, source) in self.polygons() {
            if last != Some(source) {
                let _ = writeln!(text, "g cell_{source}");
                last = Some(source);
            }
            text.push('f');
            for corner in corners {
                let _ = write!(text, " {}", corner + 1);
            }
            text.push('\n');
        }
        text
    }

    /// A binary STL file: triangles with single-precision corners. Triangles that have no area at that precision are left out,
    /// which closes the gap between their neighbours.
    #[must_use]
    pub fn to_stl(&self) -> Vec<u8> {
        // Eighty bytes that must not begin with "solid", by which readers tell text from binary.
        let mut bytes = b"binary STL, lengths in metres".to_vec();
        bytes.resize(80, b' ');
        let mut count = 0_u32;
        bytes.extend_from_slice(&count.to_le_bytes());
        for (triangle, _) in self.triangles() {
            let corners = triangle.map(|corner| self.single(corner));
            let [a, b, c] = corners;
            if a == b || b == c || c == a {
                continue;
            }
            let normal = unit_normal(&corners);
            for number in normal.into_iter().chain(corners.into_iter().flatten()) {
                bytes.extend_from_slice(&number.to_le_bytes());
            }
            bytes.extend_from_slice(&[0, 0]);
            count += 1;
        }
        bytes[80..84].copy_from_slice(&count.to_le_bytes());
        bytes
    }

    /// A vertex in single precision; −0 is 0, so that equal corners have equal bytes.
    pub(super) fn single(&self, corner: u32) -> [f32; 3] {
        self.vertices[corner as usize].0.map(|c| c as f32 + 0.0)
    }
}

/// The right-handed unit normal of a triangle; zero if it has no area.
pub(super) fn unit_normal([a, b, c]: &[[f32; 3]; 3]) -> [f32; 3] {
    let edge = |to: &[f32; 3]| -> [f64; 3] { std::array::from_fn(|i| f64::from(to[i]) - f64::from(a[i])) };
    let (u, v) = (edge(b), edge(c));
    let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    hyperbody_math::Vector(normal).normalize_or_zero().0.map(|c| c as f32)
}
