//! Arrows between the crates only point up the list of ARCHITECTURE.md:
//! math ← geometry ← collision ← dynamics ← hyperbody ← scene ← render ← cli, wasm.

use std::process::Command;

use serde_json::Value;

/// From the lowest tier to the highest; a crate may use crates of lower tiers only.
const TIERS: [&[&str]; 8] = [
    &["hyperbody-math"],
    &["hyperbody-geometry"],
    &["hyperbody-collision"],
    &["hyperbody-dynamics"],
    &["hyperbody"],
    &["hyperbody-scene"],
    &["hyperbody-render"],
    &["hyperbody-cli", "hyperbody-wasm"],
];

/// What each crate of the workspace depends on inside the workspace: (crate, dependency, whether for tests only).
fn arrows() -> (Vec<String>, Vec<(String, String, bool)>) {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--no-deps", "--offline", "--format-version", "1"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo runs, for it started this test");
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("cargo metadata prints JSON");
    let packages = metadata["packages"].as_array().expect("a list of packages");
    let name_of = |value: &Value| value["name"].as_str().expect("a name").to_owned();
    let names: Vec<String> = packages.iter().map(name_of).collect();
    let mut arrows = Vec::new();
    for package in packages {
        for dependency in package["dependencies"].as_array().expect("a list of dependencies") {
            if names.contains(&name_of(dependency)) {
                arrows.push((name_of(package), name_of(dependency), dependency["kind"] == "dev"));
            }
        }
    }
    (names, arrows)
}

fn tier(name: &str) -> Option<usize> {
    TIERS.iter().position(|crates| crates.contains(&name))
}

#[test]
fn every_crate_has_a_tier() {
    let (names, _) = arrows();
    for name in names.iter().filter(|name| !name.starts_with("xtask")) {
        assert!(tier(name).is_some(), "{name} stands in no tier: add it here and to ARCHITECTURE.md");
    }
    assert!(names.len() > 6, "cargo metadata lists the workspace, got {names:?}");
}

#[test]
fn crates_use_lower_tiers_only() {
    let (_, arrows) = arrows();
    assert!(arrows.len() > 8, "the workspace has more arrows than {arrows:?}");
    for (user, used, for_tests) in &arrows {
        let (Some(user_tier), Some(used_tier)) = (tier(user), tier(used)) else {
            panic!("{user} uses {used}, but xtask stands outside of the tiers");
        };
        let points_down = used_tier < user_tier;
        assert!(
            points_down || *for_tests && used_tier <= user_tier,
            "{user} must not use {used}, which is no lower: move the shared part down"
        );
    }
}
