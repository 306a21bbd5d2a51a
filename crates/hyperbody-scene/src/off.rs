//! Polytopes from OFF files: what the geometry reads, checked for what a body can be.

use std::collections::BTreeMap;

use hyperbody::geometry::MassProperties;
use hyperbody::geometry::decompose::convex_cells;
use hyperbody::geometry::off::{OffFile, parse};
use hyperbody::geometry::regular::Size;
use hyperbody::geometry::star;
use hyperbody::geometry::tolerances::MAX_LENGTH;
use hyperbody::math::Vector;
use hyperbody::prelude::Polytope;

use crate::build::shape_error;
use crate::error::{ErrorKind, SceneError};
use crate::read::Result;

/// How much a surface may hold less than its hull, or more, and be the surface of the hull, in parts of its content.
const SAME_CONTENT: f64 = 1e-9;

/// The file's contents; `path` says where the file is named.
pub(crate) fn read(text: &str, path: &str) -> Result<OffFile> {
    parse(text).map_err(|error| shape_error(path, &error))
}

/// The convex polytope of a file.
///
/// # Errors
/// If the file breaks the rules of the format, is of another dimension, flat, or not convex: its hull would be another
/// body.
pub(crate) fn polytope<const N: usize>(text: &str, path: &str) -> Result<Polytope<N>> {
    let refuse = |error: hyperbody::prelude::GeometryError| shape_error(path, &error);
    let file = read(text, path)?;
    within_limits(&file, path)?;
    closed(&file, path)?;
    file.check_flat::<N>().map_err(refuse)?;
    let polytope = file.to_polytope::<N>().map_err(refuse)?;
    if let Some(facet) = facet_inside_the_hull(&file, &polytope) {
        let message = format!(
            "is not convex: facet {facet} of the file does not lie in the boundary of its hull; shapes that are not convex \
             are meshes, so use \"mesh\" in place of \"polytope\""
        );
        return Err(SceneError::new(ErrorKind::Unsupported, path, message));
    }
    if let Some((_, properties)) = surface_beside_the_hull(&file, &polytope).map_err(refuse)? {
        let message = format!(
            "is not convex: its surface bounds {:e} m^{N}, and its hull is another body; shapes that are not convex are meshes, so use \
             \"mesh\" in place of \"polytope\"",
            properties.mass
        );
        return Err(SceneError::new(ErrorKind::Unsupported, path, message));
    }
    Ok(polytope)
}

/// Numbers of vertices, edges, …, facets of a file that lists them, and the mass properties at unit density of what its surface
/// bounds; `None` if it is the surface of a convex polytope, or only vertices.
///
/// # Errors
/// If the file breaks the rules of the format, is of another dimension, or its surface is open or cannot be oriented.
pub(crate) fn mesh<const N: usize>(text: &str, path: &str) -> Result<Option<(Vec<usize>, MassProperties<N>)>> {
    let refuse = |error: hyperbody::prelude::GeometryError| shape_error(path, &error);
    let file = read(text, path)?;
    within_limits(&file, path)?;
    // What is wrong with the vertices themselves is told where the hull is wanted.
    let Ok(hull) = file.to_polytope::<N>() else { return Ok(None) };
    let other = if facet_inside_the_hull(&file, &hull).is_some() {
        Some(measured(&file).map_err(refuse)?)
    } else if is_closed(&file) {
        surface_beside_the_hull(&file, &hull).map_err(refuse)?
    } else {
        None
    };
    Ok(other.map(|(_, properties)| (counts::<N>(&file), properties)))
}

/// Simplices of a closed surface, and the mass properties at unit density of what it bounds.
type Measured<const N: usize> = (Vec<[u32; N]>, MassProperties<N>);

/// The surface that a file lists, as simplices.
fn measured<const N: usize>(file: &OffFile) -> hyperbody::geometry::Result<Measured<N>> {
    let surface = file.boundary::<N>()?;
    let properties = MassProperties::of_closed_boundary(&file.vertices::<N>().unwrap_or_default(), &surface)?;
    Ok((surface, properties))
}

/// The surface in a file all of whose facets lie in those of the hull, if it bounds another body all the same: one that covers the
/// hull twice, or one of many shallow dents. `None` if it is the surface of the hull, or the file lists none.
fn surface_beside_the_hull<const N: usize>(
    file: &OffFile,
    hull: &Polytope<N>,
) -> hyperbody::geometry::Result<Option<Measured<N>>> {
    if file.elements(N.max(3) - 1).is_empty() {
        return Ok(None);
    }
    let measured = measured::<N>(file)?;
    let content = MassProperties::of_polytope(hull).mass;
    // Facets of the hull that are off by rounding enclose that much more or less.
    let middle = hull.vertex_mean();
    let heights = hull.facets().iter().map(|facet| facet.offset - facet.normal.dot(middle));
    let inradius = heights.fold(f64::INFINITY, f64::min);
    let rounding = file.convexity_tolerance().max(coarseness(hull)) * N as f64 / inradius;
    let same = (measured.1.mass / content - 1.0).abs() <= SAME_CONTENT.max(rounding);
    Ok((!same).then_some(measured))
}

/// How far corners of the hull lie off the facets that hold them: where coordinates have few digits, facets are made of corners that are
/// not in one plane.
fn coarseness<const N: usize>(hull: &Polytope<N>) -> f64 {
    let off = |facet: &hyperbody::geometry::polytope::Facet<N>| {
        let corners = facet.vertices.iter().map(|&v| hull.vertices()[v as usize]);
        corners.map(|corner| (facet.normal.dot(corner) - facet.offset).abs()).fold(0.0, f64::max)
    };
    hull.facets().iter().map(off).fold(0.0, f64::max)
}

/// The surface of a star polytope of `N` dimensions.
fn star_surface<const N: usize>(name: &str, size: Size, path: &str) -> Result<OffFile> {
    let refuse = |error: hyperbody::prelude::GeometryError| shape_error(path, &error);
    let file = star::surface(&star::symbol(name).map_err(refuse)?, size).map_err(refuse)?;
    if file.dimension() == N {
        return Ok(file);
    }
    let message = format!("\"{name}\" has {} dimensions, where {N} are wanted", file.dimension());
    Err(SceneError::new(ErrorKind::Shape, path, message))
}

/// Numbers of vertices, edges, …, facets of a star polytope, and the mass properties of its surface, winding numbers counted.
///
/// # Errors
/// If the name stands for no star polytope of `N` dimensions, or the size is no length.
pub(crate) fn star_mass<const N: usize>(name: &str, size: Size, path: &str) -> Result<(Vec<usize>, MassProperties<N>)> {
    let refuse = |error: hyperbody::prelude::GeometryError| shape_error(path, &error);
    let file = star_surface::<N>(name, size, path)?;
    let surface = file.boundary::<N>().map_err(refuse)?;
    let points = file.vertices::<N>().unwrap_or_default();
    let properties = MassProperties::of_closed_boundary(&points, &surface).map_err(refuse)?;
    Ok((counts::<N>(&file), properties))
}

fn counts<const N: usize>(file: &OffFile) -> Vec<usize> {
    let mut counts = vec![file.vertex_count(), file.edge_count()];
    counts.extend((2..N).map(|rank| file.elements(rank).len()));
    counts
}

/// Convex cells of the union of what the surface of a star polytope winds around.
///
/// # Errors
/// As [`star_mass`], and if it takes more than [`MAX_STAR_CELLS`].
pub(crate) fn star_cells<const N: usize>(name: &str, size: Size, path: &str) -> Result<Vec<Polytope<N>>> {
    let refuse = |error: hyperbody::prelude::GeometryError| shape_error(path, &error);
    star_surface::<N>(name, size, path)?;
    star::cells(&star::symbol(name).map_err(refuse)?, size, MAX_STAR_CELLS).map_err(refuse)
}

/// Most convex cells of a star polytope: the grand 600-cell takes 50,400, and none more.
pub(crate) const MAX_STAR_CELLS: usize = 1 << 16;

/// Convex cells of what the surface in a file bounds; the hull for files with vertices only.
///
/// # Errors
/// If the file breaks the rules of the format, is of another dimension, flat, or its surface is open, crosses itself or cannot
/// be oriented.
pub(crate) fn cells<const N: usize>(text: &str, path: &str) -> Result<Vec<Polytope<N>>> {
    let refuse = |error: hyperbody::prelude::GeometryError| shape_error(path, &error);
    let file = read(text, path)?;
    within_limits(&file, path)?;
    closed(&file, path)?;
    file.check_flat::<N>().map_err(refuse)?;
    let hull = file.to_polytope::<N>().map_err(refuse)?;
    let points = file.vertices::<N>().unwrap_or_default();
    if facet_inside_the_hull(&file, &hull).is_some() {
        return convex_cells(&points, &file.boundary::<N>().map_err(refuse)?).map_err(refuse);
    }
    match surface_beside_the_hull(&file, &hull).map_err(refuse)? {
        Some((surface, _)) => convex_cells(&points, &surface).map_err(refuse),
        None => Ok(vec![hull]),
    }
}

/// Refuses a surface with a gap, or with facets that branch: what it bounds is not said.
fn closed(file: &OffFile, path: &str) -> Result<()> {
    let Some((ridge, facets)) = unpaired_ridge(file) else { return Ok(()) };
    let repeated = file.repeated_vertices();
    let (what, remedy) = if repeated > 0 {
        let merge = "faces meet only in vertices of the same number, so merge them";
        ("is open", format!("{repeated} vertices stand where another one does: {merge}"))
    } else if facets == 1 {
        let add = "add the facets that are missing, or list the vertices alone to get their hull";
        ("is open", add.to_owned())
    } else {
        (
            "branches",
            "look for facets that stand twice, and give bodies that share a ridge vertices of their own".to_owned(),
        )
    };
    let message = format!("the surface {what}: {ridge} bounds {facets} facets, and has to bound two; {remedy}");
    Err(SceneError::new(ErrorKind::Shape, path, message.replace(" 1 facets", " only one facet")))
}

/// Refuses vertices farther out than a shape can be, before anything is computed of them.
fn within_limits(file: &OffFile, path: &str) -> Result<()> {
    let mut coordinates = file.coordinates().iter().enumerate();
    let Some((index, value)) = coordinates.find(|(_, c)| c.abs() > MAX_LENGTH) else { return Ok(()) };
    let message = format!(
        "vertex {} has a coordinate of {value:e}: the limit is {MAX_LENGTH:e} m; scale the file down",
        index / file.dimension()
    );
    Err(SceneError::new(ErrorKind::Shape, path, message))
}

/// The number of the first listed facet that is none of the hull's and does not lie within one either, to what the digits of the
/// coordinates leave open. A closed surface without one is the surface of the hull.
///
/// Facets of a convex surface are sought around one of their vertices, so that 100,000 of them take no time to speak of.
fn facet_inside_the_hull<const N: usize>(file: &OffFile, polytope: &Polytope<N>) -> Option<usize> {
    let vertices = file.vertices::<N>()?;
    let tolerance = file.convexity_tolerance();
    // Vertices of hulls are points that they were made of, to the bit.
    let bits = |point: Vector<N>| point.0.map(|c| (c + 0.0).to_bits());
    let corners: BTreeMap<[u64; N], u32> =
        polytope.vertices().iter().zip(0..).map(|(&corner, number)| (bits(corner), number)).collect();
    // The hull may have been made with a tolerance that its own facets exceed, as far as that gives the facets of the file.
    let is_of_hull = |facet: &[u32], number: usize| {
        let own = facet.iter().map(|&vertex| corners.get(&bits(*vertices.get(vertex as usize)?)).copied());
        let Some(mut own) = own.collect::<Option<Vec<u32>>>() else { return false };
        own.sort_unstable();
        own == polytope.facets()[number].vertices
    };
    let holds = |facet: &[u32], number: usize| {
        let hull = &polytope.facets()[number];
        facet.iter().all(|&vertex| {
            vertices.get(vertex as usize).is_some_and(|&v| (hull.normal.dot(v) - hull.offset).abs() <= tolerance)
        })
    };
    file.facet_vertices().iter().position(|facet| {
        let mut own = facet.iter().filter_map(|&vertex| corners.get(&bits(*vertices.get(vertex as usize)?)));
        let around = own.next().map_or(&[][..], |&corner| polytope.facets_of_vertex(corner as usize));
        let beside = around.iter().map(|&number| number as usize);
        !beside.clone().any(|number| holds(facet, number) || is_of_hull(facet, number))
            && !(0..polytope.facets().len()).any(|number| holds(facet, number))
    })
}

/// Whether every ridge of the file bounds exactly two facets. Files that list no facets mean a hull, which is closed.
pub(crate) fn is_closed(file: &OffFile) -> bool {
    unpaired_ridge(file).is_none()
}

/// The first ridge that does not bound exactly two facets, in words, and how many it bounds.
fn unpaired_ridge(file: &OffFile) -> Option<(String, usize)> {
    let facet_rank = file.dimension() - 1;
    let mut facets_at: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    for facet in file.elements(facet_rank) {
        for (position, &part) in facet.iter().enumerate() {
            // In 3D a facet is a cycle of vertices and its ridges are their pairs; from 4D up ridges have numbers.
            let ridge = if facet_rank == 2 {
                let next = facet[(position + 1) % facet.len()];
                (part.min(next), part.max(next))
            } else {
                (part, part)
            };
            *facets_at.entry(ridge).or_default() += 1;
        }
    }
    let (&(a, b), &count) = facets_at.iter().find(|(_, count)| **count != 2)?;
    let ridge = if facet_rank == 2 {
        format!("the edge from vertex {a} to {b}")
    } else {
        format!("face {a} of rank {}", facet_rank - 1)
    };
    Some((ridge, count))
}

#[cfg(test)]
mod tests {
    use super::*;

    const OPEN_TETRAHEDRON: &str = "OFF\n4 3 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 2 3\n";

    #[test]
    fn an_open_surface_is_told_from_a_closed_one() {
        assert!(!is_closed(&parse(OPEN_TETRAHEDRON).unwrap()));
        let error = polytope::<3>(OPEN_TETRAHEDRON, "x").unwrap_err().to_string();
        assert!(
            error.starts_with("x: the surface is open: the edge from vertex 1 to 2 bounds only one facet"),
            "{error}"
        );
        let twice = OPEN_TETRAHEDRON.replace("4 3 6", "4 5 6") + "3 1 2 3\n3 1 2 3\n";
        let error = polytope::<3>(&twice, "x").unwrap_err().to_string();
        assert!(error.starts_with("x: the surface branches: the edge from vertex 1 to 2 bounds 3 facets"), "{error}");
        let far = OPEN_TETRAHEDRON.replace("0 0 1\n", "0 0 1e300\n");
        let error = polytope::<3>(&far, "x").unwrap_err().to_string();
        assert!(error.starts_with("x: vertex 3 has a coordinate of 1e300: the limit is 1e6 m"), "{error}");
        assert!(cells::<3>(OPEN_TETRAHEDRON, "x").is_err());
        let closed = OPEN_TETRAHEDRON.replace("4 3 6", "4 4 6") + "3 1 2 3\n";
        assert!(is_closed(&parse(&closed).unwrap()));
        let cube = hyperbody::geometry::regular::Regular::Cube;
        let tesseract = cube.polytope::<4>(hyperbody::geometry::regular::Size::Edge(1.0)).unwrap();
        let file = OffFile::from_polytope(&tesseract);
        assert!(is_closed(&file));
        let read = polytope::<4>(&file.to_string(), "").unwrap();
        assert_eq!(read.facets().len(), 8);
    }

    /// A sphere of 20,000 triangles: each against each facet of the hull were 4·10⁸ looks.
    #[test]
    fn many_facets_are_told_to_be_convex_in_no_time() {
        let rings = 100;
        let mut vertices = String::from("0 0 1\n0 0 -1\n");
        let mut faces = String::new();
        for ring in 1..rings {
            for step in 0..rings {
                // No two triangles are level, so that the hull keeps them all.
                let (theta, phi) = (ring as f64 / rings as f64, (step as f64 + 0.5 * ring as f64) / rings as f64);
                let (sin, cos) = (std::f64::consts::PI * theta).sin_cos();
                let (y, x) = (2.0 * std::f64::consts::PI * phi).sin_cos();
                vertices += &format!("{} {} {cos}\n", sin * x, sin * y);
                let at = |ring: usize, step: usize| 2 + (ring - 1) * rings + step % rings;
                if ring == 1 {
                    faces += &format!("3 0 {} {}\n", at(1, step), at(1, step + 1));
                }
                if ring + 1 == rings {
                    faces += &format!("3 1 {} {}\n", at(ring, step + 1), at(ring, step));
                } else {
                    faces += &format!("3 {} {} {}\n", at(ring, step), at(ring + 1, step), at(ring, step + 1));
                    faces += &format!("3 {} {} {}\n", at(ring, step + 1), at(ring + 1, step), at(ring + 1, step + 1));
                }
            }
        }
        let count = (rings - 1) * rings;
        let text = format!("OFF\n{} {} 0\n{vertices}{faces}", count + 2, 2 * count);
        let start = std::time::Instant::now();
        assert!(mesh::<3>(&text, "").unwrap().is_none(), "the sphere is convex");
        let file = parse(&text).unwrap();
        let hull = file.to_polytope::<3>().unwrap();
        println!("a hull of {} facets, read and compared in {:.1?}", hull.facets().len(), start.elapsed());
        let start = std::time::Instant::now();
        assert_eq!(facet_inside_the_hull(&file, &hull), None);
        // About 10 ms; all against all took seconds.
        assert!(start.elapsed().as_secs_f64() < 1.0, "{:?}", start.elapsed());
    }

    /// A tetrahedron of size 1 with a dent, and an arrow head, at the origin and far from it.
    #[test]
    fn dents_are_seen_wherever_the_body_stands_and_in_the_plane() {
        for far in [0.0, 1000.0] {
            let corners = [[0.6, -0.3, 0.0], [-0.3, -0.3, 0.5], [-0.3, -0.3, -0.5], [0.0, 0.6, 0.0], [0.0; 3]];
            let lines = corners.map(|c| format!("{} {} {}\n", c[0] + far, c[1] + far, c[2] + far)).concat();
            let dented = format!("OFF\n5 6 9\n{lines}3 0 1 3\n3 1 2 3\n3 2 0 3\n3 0 4 1\n3 1 4 2\n3 2 4 0\n");
            let (counts, properties) = mesh::<3>(&dented, "").unwrap().expect("it is not convex");
            assert_eq!(counts, [5, 9, 6]);
            // Base 0.45 and height 0.9 without the dent's height 0.3.
            assert!((properties.mass / 0.09 - 1.0).abs() < 1e-6, "{}", properties.mass);
            let arrow = [[0.6, -0.4], [0.0, 0.7], [-0.6, -0.4], [0.0, -0.1]];
            let lines = arrow.map(|c| format!("{} {}\n", c[0] + far, c[1] + far)).concat();
            let (counts, properties) =
                mesh::<2>(&format!("2OFF\n4 1 4\n{lines}4 0 1 2 3\n"), "").unwrap().expect("nor this");
            assert_eq!(counts, [4, 4]);
            assert!((properties.mass / 0.48 - 1.0).abs() < 1e-9, "{}", properties.mass);
        }
    }

    #[test]
    fn a_dented_surface_is_refused_as_a_body_and_weighed_as_a_mesh() {
        // A square pyramid whose apex is pushed in through the base plane of a second one: an arrow head.
        let dented = "OFF\n5 6 9\n1 0 0\n-0.5 0.9 0\n-0.5 -0.9 0\n0 0 1\n0 0 0.3\n\
                      3 0 1 3\n3 1 2 3\n3 2 0 3\n3 0 4 1\n3 1 4 2\n3 2 4 0\n";
        let error = polytope::<3>(dented, "bodies[0]").unwrap_err();
        assert!(error.to_string().contains("bodies[0]: is not convex: facet 3"), "{error}");
        let (counts, properties) = mesh::<3>(dented, "").unwrap().unwrap();
        assert_eq!(counts, [5, 9, 6]);
        let cells = cells::<3>(dented, "").unwrap();
        let content: f64 = cells.iter().map(|cell| MassProperties::of_polytope(cell).mass).sum();
        assert!(
            cells.len() <= 3 && (content / properties.mass - 1.0).abs() < 1e-12,
            "{} cells of {content}",
            cells.len()
        );
        // A pyramid of height 1 without one of height 0.3 over the same triangle.
        assert!((properties.mass - 0.7 * 1.35 / 3.0).abs() < 1e-14, "{}", properties.mass);
        assert!(mesh::<3>(&dented.replace("0 0 0.3", "0 0 -0.3"), "").unwrap().is_none());
    }
}
