//! The built-in scenes: they build, run, say what to see, and give the same bits on any number of threads.

use std::collections::BTreeSet;

use hyperbody_scene::{AnyWorld, BUILT_IN, DIMENSIONS, Scene, built_in};

/// Enough for everything that starts near its floor to have met it.
const STEPS: usize = 40;

fn state_after(scene: &Scene, threads: usize, steps: usize) -> (u64, Vec<f64>) {
    let mut world = AnyWorld::new(scene, threads).unwrap_or_else(|error| panic!("{}: {error}", scene.name));
    for _ in 0..steps {
        world.step();
    }
    let coordinates =
        world.body_states().into_iter().flat_map(|body| [body.position, body.velocity].concat()).collect();
    assert_eq!(world.quarantined(), Vec::<&str>::new(), "{}", scene.name);
    (world.state_hash(), coordinates)
}

#[test]
fn every_scene_runs_and_threads_do_not_change_a_bit() {
    for built_in in &BUILT_IN {
        let scene = built_in.scene();
        let (hash, coordinates) = state_after(&scene, 1, STEPS);
        assert!(coordinates.iter().all(|value| value.is_finite()), "{} left the numbers", scene.name);
        assert_eq!(state_after(&scene, 1, STEPS).0, hash, "{}: a second run differs", scene.name);
        assert_eq!(state_after(&scene, 2, STEPS).0, hash, "{}: two threads differ from one", scene.name);
        assert_ne!(
            state_after(&scene, 1, STEPS - 1).0,
            hash,
            "{}: nothing moves, or the hash sees nothing",
            scene.name
        );
    }
}

#[test]
fn there_are_scenes_of_every_dimension_and_each_says_what_to_see() {
    let mut names = BTreeSet::new();
    let mut dimensions = BTreeSet::new();
    for built_in in &BUILT_IN {
        let scene = built_in.scene();
        assert!(names.insert(scene.name.clone()), "{} is there twice", scene.name);
        let suffix = format!("{}d", scene.dimension);
        assert!(scene.name.ends_with(&suffix), "{} does not end in its dimension, {suffix}", scene.name);
        assert!(scene.description.len() > 30 && scene.description.ends_with('.'), "{}", scene.description);
        dimensions.insert(scene.dimension);
    }
    assert!(names.len() >= 14 && dimensions.iter().copied().eq(DIMENSIONS), "{names:?} {dimensions:?}");
}

#[test]
fn an_unknown_name_gets_the_nearest() {
    assert_eq!(built_in("stack4").unwrap_err(), "stack4d");
    assert_eq!(built_in("Domino").unwrap_err(), "dominoes3d");
}

#[test]
fn a_snapshot_is_good_for_worlds_of_its_dimension_only() {
    let world = |name: &str| AnyWorld::new(&built_in(name).unwrap(), 1).unwrap();
    let (mut stack, mut cradle) = (world("stack4d"), world("cradle2d"));
    stack.step();
    let snapshot = stack.snapshot();
    let before = cradle.state_hash();
    let refused = cradle.restore(&snapshot).unwrap_err().to_string();
    assert!(refused.contains("of the snapshot is 4, of this world 2"), "{refused}");
    assert_eq!(cradle.state_hash(), before);
    let mut other = world("stack4d");
    other.restore(&snapshot).unwrap();
    assert_eq!((other.state_hash(), other.step_count()), (stack.state_hash(), 1));
}
