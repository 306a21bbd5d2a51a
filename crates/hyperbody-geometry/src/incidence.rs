//! Who touches whom, from the vertex lists of facets alone.
//!
//! In a polytope every face is the intersection of the facets that hold it. So the smallest face around some vertices
//! consists of the vertices that lie in all their common facets, and no coordinate is needed to find it.

use crate::polytope::Facet;

/// For each of `count` elements the ascending indices of the lists that hold it.
pub(crate) fn transposed(lists: &[&[u32]], count: usize) -> Vec<Vec<u32>> {
    let mut result = vec![Vec::new(); count];
    for (index, list) in lists.iter().enumerate() {
        for &element in *list {
            result[element as usize].push(index as u32);
        }
    }
    result
}

/// The elements of two ascending lists that are in both.
pub(crate) fn intersection(a: &[u32], b: &[u32]) -> Vec<u32> {
    let mut result = Vec::with_capacity(a.len().min(b.len()));
    let (mut i, mut j) = (0, 0);
    while i < a.len() && j < b.len() {
        match a[i].cmp(&b[j]) {
            std::cmp::Ordering::Less => i += 1,
            std::cmp::Ordering::Greater => j += 1,
            std::cmp::Ordering::Equal => {
                result.push(a[i]);
                i += 1;
                j += 1;
            }
        }
    }
    result
}

/// The elements that are in every list of `lists` named by `chosen`; empty if none is named.
pub(crate) fn common(chosen: &[u32], lists: &[&[u32]]) -> Vec<u32> {
    let Some(&shortest) = chosen.iter().min_by_key(|&&c| lists[c as usize].len()) else {
        return Vec::new();
    };
    let mut result = lists[shortest as usize].to_vec();
    for &c in chosen {
        if result.len() <= 1 {
            break;
        }
        result.retain(|element| lists[c as usize].binary_search(element).is_ok());
    }
    result
}

/// The vertices joined to each vertex by an edge, ascending: those pairs whose common facets have no third vertex in
/// common.
pub(crate) fn vertex_neighbours<const N: usize>(facets: &[Facet<N>], vertex_facets: &[Vec<u32>]) -> Vec<Vec<u32>> {
    let lists: Vec<&[u32]> = facets.iter().map(|facet| facet.vertices.as_slice()).collect();
    let mut result = vec![Vec::new(); vertex_facets.len()];
    for vertex in 0..vertex_facets.len() as u32 {
        let mut simplicial: Vec<u32> = Vec::new();
        let mut candidates: Vec<u32> = Vec::new();
        for &facet in &vertex_facets[vertex as usize] {
            let list = lists[facet as usize];
            // Any two vertices of a simplex are joined.
            let found = if list.len() == N { &mut simplicial } else { &mut candidates };
            found.extend(list.iter().filter(|&&other| other > vertex));
        }
        for list in [&mut simplicial, &mut candidates] {
            list.sort_unstable();
            list.dedup();
        }
        candidates.retain(|other| simplicial.binary_search(other).is_err());
        for other in candidates {
            let shared = intersection(&vertex_facets[vertex as usize], &vertex_facets[other as usize]);
            if shared.len() + 1 >= N && common(&shared, &lists).len() == 2 {
                simplicial.push(other);
            }
        }
        for other in simplicial {
            result[vertex as usize].push(other);
            result[other as usize].push(vertex);
        }
    }
    for list in &mut result {
        list.sort_unstable();
    }
    result
}

/// Checks that the facets close up: every two neighbours share a face of their own, with at least N−1 vertices, and
/// no two pairs share the same one.
pub(crate) fn check_ridges<const N: usize>(facets: &[Facet<N>], vertex_count: usize) -> Result<(), &'static str> {
    let lists: Vec<&[u32]> = facets.iter().map(|facet| facet.vertices.as_slice()).collect();
    let vertex_facets = transposed(&lists, vertex_count);
    if vertex_facets.iter().any(|facets| facets.len() < N) {
        return Err("a vertex with too few facets");
    }
    let facet_lists: Vec<&[u32]> = vertex_facets.iter().map(Vec::as_slice).collect();
    let mut ridges = Vec::new();
    for (index, facet) in facets.iter().enumerate() {
        for &neighbour in facet.neighbours.iter().filter(|&&n| n as usize > index) {
            let ridge = intersection(&facet.vertices, lists[neighbour as usize]);
            if ridge.len() + 1 < N {
                return Err("a ridge with too few vertices");
            }
            let simplicial = facet.vertices.len() == N && lists[neighbour as usize].len() == N;
            if !simplicial && common(&ridge, &facet_lists).len() != 2 {
                return Err("a ridge of more than two facets");
            }
            ridges.push(ridge);
        }
    }
    ridges.sort_unstable();
    if ridges.windows(2).any(|pair| pair[0] == pair[1]) {
        return Err("a ridge of more than two facets");
    }
    Ok(())
}
