//! From simplices to facets: simplices in one hyperplane become one facet, and points that are not vertices drop out.

use hyperbody_math::Vector;

use super::kernel::Kernel;
use super::plane::Hyperplane;
use super::quickhull::{Failure, Simplex};
use crate::incidence;
use crate::order;
use crate::polytope::{Facet, Polytope};

/// A facet before its numbering is final.
struct Group<const N: usize> {
    plane: Hyperplane<N>,
    /// Ascending indices of points.
    vertices: Vec<u32>,
    /// Ascending indices of groups.
    neighbours: Vec<u32>,
}

/// The polytope bounded by `simplices`, in the frame and scale of `points`; its vertices ascend in their index among
/// the points, and its facets in their vertex lists. Returns the vertices' indices beside it.
pub(super) fn polytope_from_simplices<const N: usize, K: Kernel<N>>(
    kernel: &K,
    points: &[Vector<N>],
    simplices: &[Simplex<K::Plane, N>],
    tolerance: f64,
) -> Result<(Polytope<N>, Vec<u32>), Failure> {
    let group_of = groups_of_coplanar(kernel, simplices);
    let mut groups = collect_groups(kernel, points, simplices, &group_of);
    let used = keep_extreme(&mut groups, points.len())?;
    let vertices: Vec<Vector<N>> = used.iter().map(|&v| points[v as usize]).collect();
    check_distances(points, &vertices, &groups, tolerance)?;
    let facets = in_canonical_order(groups);
    incidence::check_ridges(&facets, vertices.len()).map_err(Failure::Inconsistent)?;
    let simplicial = facets.iter().all(|facet| facet.vertices.len() == N);
    let polytope = Polytope::from_parts(vertices, facets);
    // Simplices that close up are a sphere; what merging has made of them needs a look at all faces.
    if !simplicial && !polytope.face_lattice().is_consistent() {
        return Err(Failure::Inconsistent("faces that do not close up"));
    }
    Ok((polytope, used))
}

/// The number of the group of each simplex. Neighbours join where a hyperplane of one holds the other's far vertex.
fn groups_of_coplanar<const N: usize, K: Kernel<N>>(kernel: &K, simplices: &[Simplex<K::Plane, N>]) -> Vec<u32> {
    let holds_far = |of: &Simplex<K::Plane, N>, from: &Simplex<K::Plane, N>| {
        of.vertices.iter().find(|v| !from.vertices.contains(v)).is_none_or(|&far| kernel.holds(&from.plane, far))
    };
    let mut group_of = vec![u32::MAX; simplices.len()];
    let mut count = 0;
    let mut stack = Vec::new();
    for seed in 0..simplices.len() {
        if group_of[seed] != u32::MAX {
            continue;
        }
        group_of[seed] = count;
        stack.push(seed);
        while let Some(current) = stack.pop() {
            let simplex = &simplices[current];
            let normal = K::hyperplane(&simplex.plane).normal;
            for neighbour in simplex.neighbours.map(|n| n as usize) {
                let other = &simplices[neighbour];
                let coplanar = group_of[neighbour] == u32::MAX
                    && normal.dot(K::hyperplane(&other.plane).normal) > 0.0
                    && (holds_far(other, simplex) || holds_far(simplex, other));
                if coplanar {
                    group_of[neighbour] = count;
                    stack.push(neighbour);
                }
            }
        }
        count += 1;
    }
    group_of
}

fn collect_groups<const N: usize, K: Kernel<N>>(
    kernel: &K,
    points: &[Vector<N>],
    simplices: &[Simplex<K::Plane, N>],
    group_of: &[u32],
) -> Vec<Group<N>> {
    let count = group_of.iter().max().map_or(0, |&last| last as usize + 1);
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); count];
    for (simplex, &group) in group_of.iter().enumerate() {
        members[group as usize].push(simplex);
    }
    let collect = |(group, members): (usize, &Vec<usize>)| {
        let mut vertices: Vec<u32> = members.iter().flat_map(|&s| simplices[s].vertices).collect();
        let mut neighbours: Vec<u32> = members
            .iter()
            .flat_map(|&s| simplices[s].neighbours.map(|n| group_of[n as usize]))
            .filter(|&other| other as usize != group)
            .collect();
        for list in [&mut vertices, &mut neighbours] {
            list.sort_unstable();
            list.dedup();
        }
        let planes: Vec<&K::Plane> = members.iter().map(|&s| &simplices[s].plane).collect();
        let mut widest = (0, f64::NEG_INFINITY);
        if members.len() > 1 {
            for (position, &member) in members.iter().enumerate() {
                let width = smallest_height(points, &simplices[member].vertices);
                if width > widest.1 {
                    widest = (position, width);
                }
            }
        }
        Group { plane: kernel.facet_plane(&planes, widest.0, &vertices), vertices, neighbours }
    };
    members.iter().enumerate().map(collect).collect()
}

/// The smallest of the distances of the simplex's points from the flat through those before them: what limits the
/// accuracy of its normal.
fn smallest_height<const N: usize>(points: &[Vector<N>], vertices: &[u32; N]) -> f64 {
    let base = points[vertices[0] as usize];
    let mut basis: Vec<Vector<N>> = Vec::with_capacity(N);
    let mut smallest = f64::INFINITY;
    for &vertex in &vertices[1..] {
        let mut residual = points[vertex as usize] - base;
        for &direction in &basis {
            residual -= direction * direction.dot(residual);
        }
        smallest = smallest.min(residual.norm());
        basis.push(residual.normalize_or_zero());
    }
    smallest
}

/// Drops points that are not vertices, renumbers the rest from zero, and returns the old indices in ascending order.
///
/// A point inside a face lies in the facets through that face; so do the face's vertices, each of which has more.
fn keep_extreme<const N: usize>(groups: &mut [Group<N>], point_count: usize) -> Result<Vec<u32>, Failure> {
    let lists: Vec<&[u32]> = groups.iter().map(|group| group.vertices.as_slice()).collect();
    let facets_of = incidence::transposed(&lists, point_count);
    let mut number = vec![u32::MAX; point_count];
    let mut used = Vec::new();
    for point in 0..point_count {
        let facets = &facets_of[point];
        if facets.len() < N {
            continue;
        }
        let shared = incidence::common(facets, &lists);
        // Others in all the same facets: either the point is inside their hull, or they are its doubles.
        let extreme = shared.iter().all(|&other| {
            other as usize == point || (facets_of[other as usize].len() == facets.len() && other as usize > point)
        });
        if extreme {
            number[point] = used.len() as u32;
            used.push(point as u32);
        }
    }
    for group in groups {
        group.vertices.retain_mut(|vertex| {
            *vertex = number[*vertex as usize];
            *vertex != u32::MAX
        });
        if group.vertices.len() < N || group.neighbours.len() < N {
            return Err(Failure::Inconsistent("a facet with too few vertices"));
        }
    }
    Ok(used)
}

/// Every point has to lie inside every facet, and the facets' own vertices in their hyperplanes.
fn check_distances<const N: usize>(
    points: &[Vector<N>],
    vertices: &[Vector<N>],
    groups: &[Group<N>],
    tolerance: f64,
) -> Result<(), Failure> {
    /// Distances to compute at most for points that are no vertices; beyond that, convexity at every ridge is proof
    /// enough for a closed surface.
    const MAX_DISTANCES: usize = 200_000_000;
    let allowed = 4.0 * tolerance;
    let all = if points.len().saturating_mul(groups.len()) <= MAX_DISTANCES { points } else { &[] };
    for group in groups {
        let own = group.vertices.iter();
        let near = group.neighbours.iter().flat_map(|&n| groups[n as usize].vertices.iter());
        if own.clone().any(|&v| group.plane.distance(vertices[v as usize]).abs() > allowed) {
            return Err(Failure::Inconsistent("a facet that is not flat"));
        }
        if near.chain(own).any(|&v| group.plane.distance(vertices[v as usize]) > allowed)
            || all.iter().any(|&p| group.plane.distance(p) > allowed)
        {
            return Err(Failure::Inconsistent("a point outside of a facet"));
        }
    }
    Ok(())
}

fn in_canonical_order<const N: usize>(groups: Vec<Group<N>>) -> Vec<Facet<N>> {
    let order = order::of_lists(&groups.iter().map(|group| &group.vertices[..]).collect::<Vec<_>>());
    let mut number = vec![0; groups.len()];
    for (new, &old) in order.iter().enumerate() {
        number[old] = new as u32;
    }
    let mut groups: Vec<Option<Group<N>>> = groups.into_iter().map(Some).collect();
    let facets = order.iter().filter_map(|&old| {
        groups[old].take().map(|group| {
            let mut neighbours: Vec<u32> = group.neighbours.iter().map(|&n| number[n as usize]).collect();
            neighbours.sort_unstable();
            Facet { normal: group.plane.normal, offset: group.plane.offset, vertices: group.vertices, neighbours }
        })
    });
    facets.collect()
}
