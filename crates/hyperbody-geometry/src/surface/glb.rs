//! Surfaces as binary glTF 2.0 (Khronos Group, 2017; ISO/IEC 12113).
//!
//! The JSON of such a file is one fixed document with a dozen numbers in it, written here by hand: a crate for all of glTF
//! would bring more code than this file has lines.

use super::Surface;
use super::text::unit_normal;

/// One corner: position and normal as f32, colour as four bytes.
const STRIDE: usize = 28;

impl Surface {
    /// A binary glTF file: one mesh of triangles with flat normals, and a colour for each source.
    #[must_use]
    pub fn to_glb(&self) -> Vec<u8> {
        let mut vertices: Vec<u8> = Vec::new();
        let (mut lower, mut upper) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for (triangle, source) in self.triangles() {
            let corners = triangle.map(|corner| self.single(corner));
            let [a, b, c] = corners;
            if a == b || b == c || c == a {
                continue;
            }
            // What single precision makes a line of still keeps its neighbours together.
            let mut normal = unit_normal(&corners);
            if normal == [0.0; 3] {
                normal = [0.0, 0.0, 1.0];
            }
            for corner in corners {
                for (axis, number) in corner.into_iter().enumerate() {
                    (lower[axis], upper[axis]) = (lower[axis].min(number), upper[axis].max(number));
                }
                for number in corner.into_iter().chain(normal) {
                    vertices.extend_from_slice(&number.to_le_bytes());
                }
                vertices.extend_from_slice(&colour(source));
            }
        }
        let json = document(vertices.len(), lower, upper);
        assemble(json, vertices)
    }
}

/// The description of `bytes` bytes of corners.
fn document(bytes: usize, lower: [f32; 3], upper: [f32; 3]) -> String {
    let asset = r#""asset":{"version":"2.0","generator":"hyperbody"}"#;
    let count = bytes / STRIDE;
    if count == 0 {
        return format!("{{{asset},\"scene\":0,\"scenes\":[{{}}]}}");
    }
    let list = |numbers: [f32; 3]| numbers.map(|n| n.to_string()).join(",");
    let accessor = |offset: usize, kind: &str, rest: String| {
        format!("{{\"bufferView\":0,\"byteOffset\":{offset},\"count\":{count},{kind}{rest}}}")
    };
    let float = r#""componentType":5126,"type":"VEC3""#;
    let byte = r#""componentType":5121,"normalized":true,"type":"VEC4""#;
    let accessors = [
        accessor(0, float, format!(",\"min\":[{}],\"max\":[{}]", list(lower), list(upper))),
        accessor(12, float, String::new()),
        accessor(24, byte, String::new()),
    ];
    format!(
        "{{{asset},\"scene\":0,\"scenes\":[{{\"nodes\":[0]}}],\"nodes\":[{{\"mesh\":0,\"name\":\"section\"}}],\
         \"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0,\"NORMAL\":1,\"COLOR_0\":2}},\"material\":0}}]}}],\
         \"materials\":[{{\"pbrMetallicRoughness\":{{\"metallicFactor\":0,\"roughnessFactor\":0.6}}}}],\
         \"accessors\":[{}],\"bufferViews\":[{{\"buffer\":0,\"byteLength\":{bytes},\"byteStride\":{STRIDE},\"target\":34962}}],\
         \"buffers\":[{{\"byteLength\":{bytes}}}]}}",
        accessors.join(",")
    )
}

/// Header and chunks, each of a length that is a multiple of four.
fn assemble(json: String, binary: Vec<u8>) -> Vec<u8> {
    let mut json = json.into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut chunks = Vec::new();
    for (kind, content) in [(b"JSON", json), (b"BIN\0", binary)] {
        if !content.is_empty() {
            chunks.extend_from_slice(&(content.len() as u32).to_le_bytes());
            chunks.extend_from_slice(kind);
            chunks.extend_from_slice(&content);
        }
    }
    let mut file = b"glTF".to_vec();
    file.extend_from_slice(&2_u32.to_le_bytes());
    file.extend_from_slice(&(chunks.len() as u32 + 12).to_le_bytes());
    file.extend_from_slice(&chunks);
    file
}

/// A colour for each source: hues that go around by the golden ratio, so that any few that follow each other differ.
fn colour(source: u32) -> [u8; 4] {
    let turn = (f64::from(source) * 0.618_033_988_749_895).fract() * 6.0;
    // A tent for each channel, two sixths of the circle apart.
    let channel = |centre: f64| {
        let away = (turn - centre).abs();
        let tent = (2.0 - away.min(6.0 - away)).clamp(0.0, 1.0);
        (255.0 * (0.35 + 0.6 * tent)) as u8
    };
    [channel(0.0), channel(2.0), channel(4.0), 255]
}
