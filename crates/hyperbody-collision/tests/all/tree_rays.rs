//! Rays through the dynamic tree against a plain list of boxes.

use crate::common::Random;
use hyperbody_collision::{DynamicTree, Ray, RayStack};
use hyperbody_geometry::Aabb;
use hyperbody_math::Vector;

/// Where a ray enters a box, by the intervals of all axes; flat boxes and rays along the faces included.
fn entry<const N: usize>(ray: &Ray<N>, aabb: &Aabb<N>) -> Option<f64> {
    let (mut enter, mut exit) = (0.0_f64, ray.max_fraction);
    for i in 0..N {
        let (o, d) = (ray.origin[i], ray.direction[i]);
        if d == 0.0 {
            if o < aabb.lower[i] || o > aabb.upper[i] {
                return None;
            }
        } else {
            let (a, b) = ((aabb.lower[i] - o) / d, (aabb.upper[i] - o) / d);
            enter = enter.max(a.min(b));
            exit = exit.min(a.max(b));
        }
    }
    (enter <= exit).then_some(enter)
}

fn rays_match_a_list<const N: usize>() {
    let mut random = Random(300 + N as u64);
    let mut tree = DynamicTree::<N>::new();
    let mut stack = RayStack::default();
    let across = if N < 5 { 6 } else { 3 };
    // On a grid, so that rays along the axes run in faces; every fourth box is flat.
    let boxes: Vec<Aabb<N>> = (0..300)
        .map(|index| {
            let half = if index % 4 == 0 { Vector::unit(index % N) * 0.5 } else { Vector::splat(0.5) };
            Aabb::from_centre(Vector::from_fn(|_| random.below(across) as f64), half)
        })
        .collect();
    for (user, aabb) in boxes.iter().enumerate() {
        tree.insert(*aabb, user as u32);
    }
    let picture = tree.for_rays(|_, aabb| *aabb);
    let mut met_in_all = 0;
    for round in 0..2000 {
        let ray = if round % 3 == 0 {
            let origin = Vector::from_fn(|_| random.below(2 * across) as f64 * 0.5);
            Ray::new(origin, Vector::unit(random.below(N)) * if random.below(2) == 0 { 1.0 } else { -1.0 })
        } else {
            Ray::between(random.vector::<N>(8.0), Vector::from_fn(|_| random.range(0.0, across as f64))).up_to(1.5)
        };
        let expected: Vec<u32> = (0..300).filter(|&user| entry(&ray, &boxes[user as usize]).is_some()).collect();
        let mut met = Vec::new();
        tree.cast_ray(&ray, &mut stack, |user, reach| {
            met.push(user);
            Some(reach)
        });
        met.sort_unstable();
        let mut in_picture = Vec::new();
        picture.cast_ray(&ray, &mut stack, |user, reach| {
            in_picture.push(user);
            Some(reach)
        });
        in_picture.sort_unstable();
        assert_eq!(in_picture, met, "{ray:?}");
        // Rounding may let in a box that the ray only grazes, and must not keep out one that it meets.
        let missing: Vec<&u32> = expected.iter().filter(|user| met.binary_search(user).is_err()).collect();
        assert!(missing.is_empty(), "{ray:?} meets {missing:?}");
        for user in met.iter().filter(|user| expected.binary_search(user).is_err()) {
            let grown = boxes[*user as usize].grown(1e-12);
            assert!(entry(&ray, &grown).is_some(), "{ray:?} is nowhere near box {user}");
        }
        met_in_all += expected.len();

        // The nearest box, with the reach shrinking: the same as of the list.
        let mut first: Option<(f64, u32)> = None;
        tree.cast_ray(&ray, &mut stack, |user, reach| {
            let Some(here) = entry(&ray, &boxes[user as usize]) else { return Some(reach) };
            if first.is_none_or(|best| (here, user) < best) {
                first = Some((here, user));
            }
            first.map(|best| best.0)
        });
        let nearest = expected.iter().filter_map(|&user| Some((entry(&ray, &boxes[user as usize])?, user)));
        let nearest = nearest.reduce(|best, next| if next < best { next } else { best });
        assert_eq!(first, nearest, "{ray:?}");

        let mut calls = 0;
        tree.cast_ray(&ray, &mut stack, |_, _| {
            calls += 1;
            None
        });
        assert_eq!(calls, usize::from(!met.is_empty()), "None ends the search");
    }
    assert!(met_in_all > 2000, "{met_in_all} boxes met in {N}D");
    for bad in [Ray::new([f64::NAN; N], [1.0; N]), Ray::new([0.0; N], [0.0; N])] {
        tree.cast_ray(&bad, &mut stack, |_, _| panic!("{bad:?} is no ray"));
    }
}

/// None and one are trees too.
fn small_pictures<const N: usize>() {
    let mut tree = DynamicTree::<N>::new();
    let mut stack = RayStack::default();
    let mut met = |tree: &DynamicTree<N>, ray: Ray<N>| {
        let mut count = 0;
        tree.for_rays(|_, aabb| *aabb).cast_ray(&ray, &mut stack, |user, reach| {
            count += 1 + user;
            Some(reach)
        });
        count
    };
    let (at, past) =
        (Ray::new(Vector::splat(-3.0), Vector::splat(1.0)), Ray::new(Vector::splat(-3.0), Vector::unit(0)));
    assert_eq!(met(&tree, at), 0);
    tree.insert(Aabb::from_centre(Vector::ZERO, Vector::splat(1.0)), 6);
    assert_eq!((met(&tree, at), met(&tree, past)), (7, 0));
}

#[test]
fn pictures_of_no_box_and_of_one() {
    for_every_dimension!(small_pictures);
}

#[test]
fn rays_meet_the_boxes_of_a_list() {
    for_every_dimension!(rays_match_a_list);
}
