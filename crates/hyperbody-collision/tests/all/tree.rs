//! The dynamic tree against a plain list, over random histories.

use crate::common::Random;
use hyperbody_collision::DynamicTree;
use hyperbody_geometry::Aabb;
use hyperbody_math::Vector;

fn random_box<const N: usize>(random: &mut Random) -> Aabb<N> {
    // Some flat, some coincident with the grid, some large.
    let size = random.log_range(1e-2, 2.0);
    let half = Vector::from_fn(|_| if random.below(8) == 0 { 0.0 } else { random.range(0.0, size) });
    let centre = if random.below(4) == 0 {
        Vector::from_fn(|_| random.below(5) as f64)
    } else {
        Vector::from_fn(|_| random.range(0.0, 5.0))
    };
    Aabb::from_centre(centre, half)
}

fn overlaps<const N: usize>(tree: &DynamicTree<N>, aabb: &Aabb<N>, stack: &mut Vec<u32>) -> Vec<u32> {
    let mut found = Vec::new();
    tree.for_each_overlap(aabb, stack, |user| {
        found.push(user);
        true
    });
    found
}

fn history_matches_a_list<const N: usize>() {
    let mut random = Random(N as u64);
    let mut tree = DynamicTree::<N>::new();
    // (proxy, user, box) of every box in the tree.
    let mut list: Vec<(u32, u32, Aabb<N>)> = Vec::new();
    let mut stack = Vec::new();
    for round in 0..3000_u32 {
        match random.below(10) {
            0..=3 => {
                let aabb = random_box(&mut random);
                list.push((tree.insert(aabb, round), round, aabb));
            }
            4..=6 if !list.is_empty() => {
                let place = random.below(list.len());
                let (proxy, _, aabb) = &mut list[place];
                *aabb = random_box(&mut random);
                tree.update(*proxy, *aabb);
            }
            7 | 8 if !list.is_empty() => {
                let (proxy, ..) = list.swap_remove(random.below(list.len()));
                tree.remove(proxy);
                // Removing what is gone must change nothing.
                tree.remove(proxy);
            }
            _ if round % 97 == 0 => tree.rebuild(),
            _ => {
                if tree.should_rebuild() {
                    tree.rebuild();
                }
            }
        }
        tree.validate().expect("the tree keeps its rules after every operation");
        assert_eq!(tree.len(), list.len());
        if round % 5 == 0 {
            let query = random_box(&mut random);
            let mut found = overlaps(&tree, &query, &mut stack);
            found.sort_unstable();
            let mut expected: Vec<u32> =
                list.iter().filter(|(_, _, aabb)| aabb.overlaps(&query)).map(|&(_, user, _)| user).collect();
            expected.sort_unstable();
            assert_eq!(found, expected, "round {round}: the tree must report what a plain list reports");
        }
    }
    for (proxy, user, aabb) in &list {
        assert_eq!((tree.user(*proxy), tree.aabb(*proxy)), (*user, aabb));
    }
}

#[test]
fn matches_a_list() {
    for_every_dimension!(history_matches_a_list);
}

fn query_cost_is_logarithmic<const N: usize>() {
    let side = [0, 0, 64, 16, 8, 5, 4][N];
    let mut tree = DynamicTree::<N>::new();
    let mut cells = Vec::new();
    for index in 0..side_power(side, N) {
        let centre = Vector::from_fn(|axis| (index / side_power(side, axis) % side) as f64);
        cells.push(centre);
        tree.insert(Aabb::from_centre(centre, Vector::splat(0.4)), index as u32);
    }
    let incremental = tree.quality();
    tree.rebuild();
    tree.validate().expect("a rebuilt tree keeps the rules");
    let rebuilt = tree.quality();
    // Greedy insertion in the worst order, row by row, must stay within twice the rebuild, and neither may degenerate.
    assert!(incremental < 2.0 * rebuilt, "N = {N}: inserted {incremental}, rebuilt {rebuilt}");
    assert!(tree.height() <= 4 * (usize::BITS - cells.len().leading_zeros()), "height {}", tree.height());
}

fn side_power(side: usize, exponent: usize) -> usize {
    side.pow(exponent as u32)
}

#[test]
fn a_grid_makes_a_good_tree() {
    for_every_dimension!(query_cost_is_logarithmic);
}

fn order_depends_on_operations_alone<const N: usize>() {
    let run = || {
        let mut random = Random(7);
        let mut tree = DynamicTree::<N>::new();
        let mut proxies = Vec::new();
        for user in 0..200 {
            proxies.push(tree.insert(random_box(&mut random), user));
        }
        for round in 0..200 {
            let proxy = proxies[random.below(200)];
            tree.update(proxy, random_box(&mut random));
            if round % 50 == 0 {
                tree.rebuild();
            }
        }
        overlaps(&tree, &Aabb::from_centre(Vector::splat(2.5), Vector::splat(2.0)), &mut Vec::new())
    };
    assert_eq!(run(), run());
}

#[test]
fn repeats_itself() {
    for_every_dimension!(order_depends_on_operations_alone);
}

fn stops_when_told<const N: usize>() {
    let mut tree = DynamicTree::<N>::new();
    let unit = Aabb::from_centre(Vector::ZERO, Vector::splat(1.0));
    // A hundred coincident boxes: the worst case for any heuristic.
    for user in 0..100 {
        tree.insert(unit, user);
    }
    tree.validate().expect("coincident boxes are ordinary");
    assert!(tree.height() < 30, "coincident boxes must not make a list, height {}", tree.height());
    let mut calls = 0;
    tree.for_each_overlap(&unit, &mut Vec::new(), |_| {
        calls += 1;
        calls < 3
    });
    assert_eq!(calls, 3);
    tree.rebuild();
    tree.validate().expect("coincident boxes are ordinary");
}

#[test]
fn coincident_boxes_and_early_stop() {
    for_every_dimension!(stops_when_told);
}
