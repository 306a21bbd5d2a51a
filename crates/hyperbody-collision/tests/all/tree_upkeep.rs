//! The tree over time: queries take nothing from the heap, a tree that has decayed is rebuilt, and what is near or in the
//! way of a box is found.

use crate::common::Random;
use hyperbody_collision::{DynamicTree, Ray, RayStack};
use hyperbody_geometry::Aabb;
use hyperbody_math::Vector;

fn random_box<const N: usize>(random: &mut Random, reach: f64) -> Aabb<N> {
    Aabb::from_centre(random.vector(reach), random.vector::<N>(0.5).abs())
}

fn forest<const N: usize>(random: &mut Random, count: u32) -> (DynamicTree<N>, Vec<Aabb<N>>) {
    let mut tree = DynamicTree::new();
    let boxes: Vec<Aabb<N>> = (0..count).map(|_| random_box(random, 5.0)).collect();
    for (user, aabb) in boxes.iter().enumerate() {
        tree.insert(*aabb, user as u32);
    }
    (tree, boxes)
}

fn queries_allocate_nothing<const N: usize>() {
    let (tree, _) = forest::<N>(&mut Random(1), 500);
    let (mut stack, mut rays) = (Vec::new(), RayStack::default());
    let mut ask = || {
        let mut random = Random(2);
        let mut seen = 0_u32;
        for _ in 0..200 {
            let aabb = random_box::<N>(&mut random, 5.0);
            tree.for_each_overlap(&aabb, &mut stack, |_| {
                seen += 1;
                true
            });
            let ray = Ray::between(random.vector::<N>(6.0), random.vector::<N>(6.0));
            let mut count = |_, reach| {
                seen += 1;
                Some(reach)
            };
            tree.cast_ray(&ray, &mut rays, &mut count);
            tree.cast_box(&ray, Vector::splat(0.3), &mut rays, &mut count);
            tree.visit_near(&aabb, 1.0, &mut rays, &mut count);
        }
        seen
    };
    // The first time the working memory grows.
    let first = ask();
    let mut second = 0;
    let taken = allocation_counter::measure(|| second = ask());
    assert!(first > 20 && first == second, "{N}D: {first} and {second} boxes seen");
    assert_eq!(taken.count_total, 0, "{N}D: {taken:?}");
    let counted = allocation_counter::measure(|| drop(std::hint::black_box(vec![1_u8])));
    assert_eq!(counted.count_total, 1, "the counter must count");
}

#[test]
fn queries_take_nothing_from_the_heap() {
    for_every_dimension!(queries_allocate_nothing);
}

fn decay_is_noticed<const N: usize>() {
    let mut random = Random(3 + N as u64);
    let (mut tree, _) = forest::<N>(&mut random, 40);
    tree.rebuild();
    let mut fresh = tree.quality();
    assert!(!tree.should_rebuild(), "a fresh tree is good");
    let mut proxies: Vec<u32> = Vec::new();
    let (mut rebuilt, mut kept) = (0, 0);
    for round in 0..40 {
        // The tree grows and everything in it wanders; asked after enough changes, it says what its quality says.
        for user in 0..20 {
            proxies.push(tree.insert(random_box(&mut random, 5.0), 100 + user));
        }
        for _ in 0..2 * tree.len() {
            let proxy = proxies[random.below(proxies.len())];
            tree.update(proxy, random_box(&mut random, 5.0));
        }
        let decayed = tree.quality() > 1.3 * fresh;
        assert_eq!(tree.should_rebuild(), decayed, "{N}D, round {round}: {} against {fresh}", tree.quality());
        assert!(!tree.should_rebuild(), "asking again at once looks at nothing");
        if decayed {
            let before = tree.quality();
            tree.rebuild();
            tree.validate().expect("a rebuilt tree keeps its rules");
            fresh = tree.quality();
            assert!(fresh < 1.05 * before, "{N}D, round {round}: {before} became {fresh}");
            rebuilt += 1;
        } else {
            kept += 1;
        }
    }
    assert!(rebuilt > 2 && kept > 5, "{N}D: {rebuilt} rebuilds, {kept} rounds without");
}

#[test]
fn a_decayed_tree_is_rebuilt() {
    for_every_dimension!(decay_is_noticed);
}

fn near_and_swept<const N: usize>() {
    let mut random = Random(5 + N as u64);
    let (tree, boxes) = forest::<N>(&mut random, 200);
    let mut stack = RayStack::default();
    for _ in 0..100 {
        let probe = random_box::<N>(&mut random, 6.0);
        let reach = random.range(0.0, 2.0);
        let distance = |aabb: &Aabb<N>| {
            let apart: Vector<N> =
                Vector::from_fn(|i| (probe.lower[i] - aabb.upper[i]).max(aabb.lower[i] - probe.upper[i]).max(0.0));
            apart.norm()
        };
        let expected: Vec<u32> = (0..200).filter(|&user| distance(&boxes[user as usize]) <= reach).collect();
        let mut found = Vec::new();
        tree.visit_near(&probe, reach, &mut stack, |user, reach| {
            found.push(user);
            Some(reach)
        });
        found.sort_unstable();
        assert_eq!(found, expected);
        // With a reach that shrinks to the nearest, nothing nearer is missed.
        let mut nearest = f64::INFINITY;
        tree.visit_near(&probe, f64::INFINITY, &mut stack, |user, _| {
            nearest = nearest.min(distance(&boxes[user as usize]));
            Some(nearest)
        });
        assert_eq!(nearest, boxes.iter().map(distance).fold(f64::INFINITY, f64::min));
        // A box on its way: sampled on it, it meets nothing that was not reported.
        let half = random.vector::<N>(0.4).abs();
        let ray = Ray::between(random.vector::<N>(6.0), random.vector::<N>(6.0)).up_to(1.0);
        let mut met = vec![false; 200];
        tree.cast_box(&ray, half, &mut stack, |user, reach| {
            met[user as usize] = true;
            Some(reach)
        });
        for sample in 0..=50 {
            let here = Aabb::from_centre(ray.at(f64::from(sample) / 50.0), half * (1.0 - 1e-12));
            assert!(boxes.iter().zip(&met).all(|(aabb, met)| *met || !aabb.overlaps(&here)));
        }
        assert!(met.iter().any(|met| !met), "not everything is in the way");
    }
}

#[test]
fn boxes_near_and_in_the_way_are_found() {
    for_every_dimension!(near_and_swept);
}
