//! `hyperbody spin`: what its report holds back, warns of and bounds.

use crate::common::{hyperbody, json_of};
use serde_json::Value;

const TOP: [&str; 3] = ["spin", "--moments", "4,3,2,1"];

fn with<'a>(first: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
    [first, more].concat()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn printed(arguments: &[&str]) -> String {
    let output = hyperbody(arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("UTF-8")
}

#[test]
fn steps_too_long_for_the_spin_are_warned_of_and_yield_no_flips() {
    let fast = with(&TOP, &["--spin", "xz=1e3,xy=1", "--seconds", "5"]);
    let text = printed(&fast);
    assert!(text.contains("warning") && text.contains("would do"), "{text}");
    assert!(!text.contains("flips  ") && !text.contains("between flips"), "{text}");
    let report = json_of(&with(&fast, &["--json"]));
    assert!(
        report["warning"].as_str().is_some_and(|warning| warning.contains("too far for splitting4")),
        "{}",
        report["warning"]
    );
    assert_eq!(report["flips"]["times"], serde_json::json!([]));
    assert_eq!(report["period"]["measured"], Value::Null);
    let fine = json_of(&with(&TOP, &["--spin", "xz=1e3,xy=1", "--seconds", "0.1", "--dt", "5e-5", "--json"]));
    assert_eq!(fine["warning"], Value::Null);
}

#[test]
fn irregular_flips_have_no_period() {
    let arguments = with(&TOP, &["--spin", "xw=1", "--disturb", "0.001", "--seconds", "300"]);
    let text = printed(&arguments);
    assert!(text.contains("between flips") && text.contains("irregular: from "), "{text}");
    assert!(!text.contains("between every other flip"), "{text}");
    let report = json_of(&with(&arguments, &["--json"]));
    assert_eq!(report["period"]["measured"], Value::Null);
    assert!(number(&report["flips"]["irregularity"]) > 0.1);
}

#[test]
fn measured_growth_is_a_bound_where_nothing_grows() {
    for (moments, spin, sentence) in [
        ("4,3,2,1", "xy=1", "does not grow (below 0.00"),
        ("8,4,2,1", "yz=1,xw=0.999", "does not grow (below 0.00"),
        ("4,3,2,1", "xw=1,yz=1", "none that is exponential (below 0.0"),
        ("8,4,2,1", "xw=1,yz=0.5", "0.38729"),
    ] {
        let arguments = ["spin", "--moments", moments, "--spin", spin, "--seconds", "1"];
        let text = printed(&arguments);
        let line = text.lines().find(|line| line.contains("measured growth")).expect("a line about growth");
        assert!(line.contains(sentence), "{line}");
        let found = json_of(&with(&arguments, &["--json"]));
        let (rate, bound) = (&found["stability"]["measured_growth_rate"], &found["stability"]["measured_growth_below"]);
        if sentence.starts_with('0') {
            assert!(number(rate) > 0.3 && bound.is_null());
        } else {
            assert!(number(rate) == 0.0 && (1e-4..2e-2).contains(&number(bound)), "{rate} {bound}");
        }
    }
}

#[test]
fn a_map_of_moments_in_proportion_has_its_boundary_at_equal_rates() {
    let map = json_of(&["spin", "--moments", "8,4,2,1", "--map", "xw,yz", "--cells", "31", "--json"]);
    assert_eq!((&map["disagreements"], number(&map["threshold"])), (&serde_json::json!(0), 1.0));
    let boundary = map["boundary"].as_array().expect("a list");
    assert!(boundary.len() > 50);
    for end in boundary.iter().flat_map(|segment| segment.as_array().expect("two ends")) {
        let (a, b) = (number(&end[0]), number(&end[1]));
        assert!((b.abs() - a.abs()).abs() < 1e-8, "({a}, {b})");
    }
    for (row, cells) in map["stable"].as_array().expect("rows").iter().enumerate() {
        for (column, cell) in cells.as_array().expect("cells").iter().enumerate() {
            let (a, b) = (column.abs_diff(15), row.abs_diff(15));
            let expected = if a == b { Value::Null } else { Value::Bool(b > a) };
            assert_eq!(cell, &expected, "column {column}, row {row}");
        }
    }
}
