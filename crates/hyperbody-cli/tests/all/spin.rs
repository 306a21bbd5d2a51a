//! `hyperbody spin`: what it reports, draws, writes and refuses.

use std::path::PathBuf;

use crate::common::{file, hyperbody, json_of, keys};
use resvg::tiny_skia::Pixmap;
use resvg::usvg::{Options, Tree};
use serde_json::Value;

const TOP: [&str; 3] = ["spin", "--moments", "4,3,2,1"];

fn with<'a>(first: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
    [first, more].concat()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// A file for one test that is not there yet.
fn fresh(name: &str) -> PathBuf {
    let path = file(name, "");
    std::fs::remove_file(&path).expect("just made");
    path
}

fn text_of(path: &std::path::Path) -> &str {
    path.to_str().expect("the folder for temporary files has a UTF-8 name")
}

#[test]
fn a_run_reports_every_promised_key() {
    let report = json_of(&with(&TOP, &["--spin", "xz=1,xy=0.01", "--seconds", "5", "--json"]));
    for key in [
        "times",
        "angular_velocity",
        "energy",
        "angular_momentum",
        "max_relative_drift",
        "final_rotation",
        "stability",
        "flips",
        "period",
        "equations",
        "final_rotor",
    ] {
        assert!(report.get(key).is_some(), "key {key} is missing from {:?}", keys(&report));
    }
    let samples = report["times"].as_array().expect("a list").len();
    assert!(samples > 1000);
    assert_eq!(keys(&report["angular_velocity"]), ["xw", "xy", "xz", "yw", "yz", "zw"]);
    for plane in ["xy", "zw"] {
        assert_eq!(report["angular_velocity"][plane].as_array().expect("a series").len(), samples);
        assert_eq!(report["angular_momentum"][plane].as_array().expect("a series").len(), samples);
    }
    assert_eq!(report["energy"].as_array().expect("a series").len(), samples);
    for key in ["energy", "angular_momentum_sq", "angular_momentum", "pfaffian", "manakov"] {
        assert!(number(&report["max_relative_drift"][key]) < 1e-11, "{key}: {}", report["max_relative_drift"]);
    }
    assert_eq!(report["final_rotor"].as_array().expect("a list").len(), 8);
    assert!(report["stability"]["why"].as_str().is_some_and(|why| why.contains("J_y = 3")));
    // The Pfaffian is a matter of four dimensions.
    let flat = json_of(&["spin", "--moments", "3,2,1", "--spin", "xz=1", "--seconds", "1", "--json"]);
    assert!(flat["max_relative_drift"].get("pfaffian").is_none());
}

#[test]
fn the_three_pairs_of_planes_have_their_verdicts() {
    for (spin, stable) in [
        ("xy=1,zw=0.3", Value::Bool(true)),
        ("xy=0.2,zw=-1", Value::Bool(true)),
        ("xz=1,yw=0.3", Value::Bool(false)),
        ("xz=0.1,yw=1", Value::Bool(false)),
        ("xw=1,yz=0.9586", Value::Bool(false)),
        ("xw=1,yz=-0.9588", Value::Bool(true)),
        ("xw=1,yz=1.7", Value::Bool(true)),
        ("xz=1,yw=1", Value::Null),
    ] {
        let found = json_of(&with(&TOP, &["--spin", spin, "--seconds", "1", "--json"]));
        assert_eq!(found["stability"]["stable"], stable, "{spin}: {}", found["stability"]);
        let [rate, measured] = ["growth_rate", "measured_growth_rate"].map(|key| number(&found["stability"][key]));
        assert_eq!(rate > 0.0, stable == Value::Bool(false), "{spin}");
        if rate > 1e-2 {
            assert!((measured / rate - 1.0).abs() < 2e-3, "{spin}: measured {measured}, exact {rate}");
        }
    }
}

#[test]
fn the_wing_nut_has_its_exact_period() {
    let report = json_of(&[
        "spin",
        "--inertia",
        "xy=3.2,xz=2.5,yz=1.7",
        "--spin",
        "xy=0.02,zx=1,yz=0.02",
        "--seconds",
        "500",
        "--dt",
        "0.02",
        "--method",
        "splitting6",
        "--json",
    ]);
    let (exact, measured) = (number(&report["period"]["exact"]), number(&report["period"]["measured"]));
    // Moments of inertia pass through second moments, and close to the separatrix the period is sensitive to both.
    assert!((exact / 66.400_635_814_269_78 - 1.0).abs() < 1e-12, "{exact}");
    assert!((measured / exact - 1.0).abs() < 1e-8, "{measured}");
    let flips: Vec<f64> = report["flips"]["times"].as_array().expect("a list").iter().map(number).collect();
    assert_eq!(flips.len(), 15);
    for pair in flips.windows(2) {
        assert!(((pair[1] - pair[0]) / (0.5 * exact) - 1.0).abs() < 1e-7, "a flip every half period: {flips:?}");
    }
    assert!(number(&report["closed_form"]["final_error"]) < 1e-9);
}

#[test]
fn attitudes_and_equations_are_those_of_the_motion() {
    let quarter = std::f64::consts::FRAC_PI_2.to_string();
    let ball = json_of(&["spin", "--moments", "1,1,1,1", "--spin", "xw=1", "--seconds", &quarter, "--json"]);
    // x has turned to where w was; the rotor is that of half the angle, in the order 1, xy, xz, xw, ….
    for (place, expected) in [((0, 3), -1.0), ((3, 0), 1.0), ((1, 1), 1.0), ((0, 0), 0.0)] {
        let (row, column) = place;
        assert!((number(&ball["final_rotation"][row][column]) - expected).abs() < 1e-12, "entry {place:?}");
    }
    let half = std::f64::consts::FRAC_1_SQRT_2;
    assert!((number(&ball["final_rotor"][0]) - half).abs() < 1e-12);
    assert!((number(&ball["final_rotor"][3]).abs() - half).abs() < 1e-12);
    let report = json_of(&with(&TOP, &["--spin", "xy=1,xz=0.5", "--seconds", "1", "--json"]));
    let equations = report["equations"].as_array().expect("a list");
    assert_eq!(equations.len(), 6);
    assert_eq!(equations[0]["never_driven_by"], serde_json::json!(["zw"]));
    assert_eq!(equations[0]["drives"].as_array().expect("a list").len(), 2);
    // dω_yz/dt = r_yz ω_xy ω_xz with r_yz = (3 − 2)/(3 + 2); yx and zx turn the same way round.
    let yz = &equations[3];
    assert_eq!(yz["plane"], "yz");
    assert!((number(&yz["rate"]) - 0.2 * 0.5).abs() < 1e-15, "{yz}");
}

#[test]
fn methods_are_compared_and_steps_controlled() {
    let arguments =
        ["--spin", "xz=1", "--disturb", "0.01", "--seconds", "20", "--compare", "midpoint,gyroscopic", "--json"];
    let report = json_of(&with(&TOP, &arguments));
    let compared = report["compared"].as_array().expect("a list");
    let drift = |index: usize| number(&compared[index]["max_relative_drift"]["energy"]);
    assert!(drift(0) < 1e-13 && drift(1) > 1e-6, "midpoint {}, gyroscopic {}", drift(0), drift(1));
    let arguments = ["--spin", "xz=1,xy=0.5", "--seconds", "5", "--dt", "0.5", "--method", "splitting2"];
    let loose = json_of(&with(&TOP, &with(&arguments, &["--json"])));
    let tight = json_of(&with(&TOP, &with(&arguments, &["--tolerance", "1e-8", "--json"])));
    let error = |report: &Value| number(&report["max_relative_drift"]["energy"]);
    assert!(number(&tight["most_parts"]) > 100.0 && error(&tight) < 1e-3 * error(&loose));
}

#[test]
fn bodies_come_from_shapes() {
    let brick = file("spin/brick.json", r#"{"box": {"half_extents": [1, 4, 2, 3]}}"#);
    let report = json_of(&["spin", "--shape", text_of(&brick), "--spin", "xy=1", "--seconds", "1", "--json"]);
    let moments: Vec<f64> = report["moments"].as_array().expect("a list").iter().map(number).collect();
    for (moment, half) in moments.iter().zip([4.0, 3.0, 2.0, 1.0]) {
        assert!((moment - half * half / 3.0).abs() < 1e-12, "{moments:?}");
    }
    assert_eq!(report["moments_unit"], "m²");
    let cell = json_of(&["spin", "--shape", "24-cell", "--spin", "xy=1,zw=0.4", "--seconds", "1", "--json"]);
    assert_eq!(cell["dimension"], 4);
    assert!((number(&cell["moments"][0]) - 13.0 / 120.0).abs() < 1e-14);
    assert_eq!(cell["stability"]["stable"], true);
    let cube = json_of(&["spin", "--shape", "cube", "--dimension", "5", "--spin", "xv=1", "--seconds", "1", "--json"]);
    assert_eq!(cube["dimension"], 5);
    let off = "OFF\n4 4 6\n0 0 0\n3 0 0\n0 2 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    let wedge = file("spin/wedge.off", off);
    let report = json_of(&["spin", "--shape", text_of(&wedge), "--spin", "xz=1", "--seconds", "1", "--json"]);
    assert_eq!(report["stability"]["stable"], false, "three different moments: {}", report["moments"]);
}

#[test]
fn pictures_can_be_read_and_have_the_same_bytes_every_time() {
    let run = ["--spin", "xz=1", "--disturb", "0.01", "--seconds", "40"];
    for (name, more) in
        [("run", &["--samples", "300"][..]), ("compared", &["--compare", "midpoint", "--show", "drift"][..])]
    {
        let mut bytes = Vec::new();
        for extension in ["svg", "svg", "png", "png"] {
            let path = fresh(&format!("spin/{name}.{extension}"));
            let plot = with(&["--plot", text_of(&path)], more);
            assert!(hyperbody(&with(&with(&TOP, &run), &plot)).status.success());
            bytes.push(std::fs::read(&path).expect("the picture"));
        }
        assert_eq!(bytes[0], bytes[1]);
        assert_eq!(bytes[2], bytes[3]);
        let svg = std::str::from_utf8(&bytes[0]).expect("UTF-8");
        let tree = Tree::from_str(svg, &Options::default()).expect("a well-formed SVG");
        assert!(svg.contains("time (s)") && svg.contains("relative drift"), "titles and units");
        assert!(svg.contains("xz = 1 rad/s, 0.01 rad/s in every other plane"), "what was run");
        let pixels = Pixmap::decode_png(&bytes[2]).expect("a PNG");
        assert_eq!((pixels.width(), pixels.height()), (tree.size().width() as u32, tree.size().height() as u32));
        let inked = pixels.pixels().iter().filter(|pixel| pixel.red() < 128).count();
        assert!(inked > 10_000, "{name}: only {inked} dark pixels: where is the text?");
    }
    let beside: Vec<_> =
        std::fs::read_dir(file("spin/x", "").parent().expect("a folder")).expect("the folder").collect();
    let left = beside.iter().flatten().filter(|entry| entry.file_name().to_string_lossy().ends_with(".part"));
    assert_eq!(left.count(), 0, "files written aside are renamed");
}

#[test]
fn tables_hold_every_time_of_the_run() {
    let path = fresh("spin/run.csv");
    let arguments = ["--spin", "xz=1,xy=0.1", "--seconds", "2", "--samples", "48", "--csv", text_of(&path), "--json"];
    let report = json_of(&with(&TOP, &arguments));
    let text = std::fs::read_to_string(&path).expect("the table");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 1 + report["times"].as_array().expect("a list").len());
    // t, ω, H, |L|², Pf, f, L, M, R.
    assert_eq!(rows[0].len(), 1 + 6 + 1 + 1 + 1 + 4 + 6 + 6 + 16);
    let column = |name: &str| rows[0].iter().position(|heading| *heading == name).expect("a heading");
    let last = &rows[rows.len() - 1];
    let value = |name: &str| last[column(name)].parse::<f64>().expect("a number");
    assert_eq!(value("R_wx"), number(&report["final_rotation"][3][0]));
    assert_eq!(value("t"), 2.0);
    assert!(rows.iter().all(|row| row.len() == rows[0].len()));
}

#[test]
fn maps_show_the_exact_boundary() {
    let (png, csv) = (fresh("spin/map.png"), fresh("spin/map.csv"));
    let files = ["--plot", text_of(&png), "--csv", text_of(&csv)];
    let map = json_of(&with(&TOP, &with(&["--map", "xw,yz", "--cells", "31", "--json"], &files)));
    assert_eq!(map["disagreements"], 0);
    let threshold = number(&map["threshold"]);
    assert!((threshold - 0.958_702_311_072_570_3).abs() < 1e-14);
    let boundary = map["boundary"].as_array().expect("a list");
    assert!(boundary.len() > 20);
    for end in boundary.iter().flat_map(|segment| segment.as_array().expect("two ends")) {
        let (a, b) = (number(&end[0]), number(&end[1]));
        // Segments next to a = b = 0, where nothing turns, aside.
        assert!((b.abs() - threshold * a.abs()).abs() < 1e-9 || a.abs().max(b.abs()) < 0.11, "({a}, {b})");
    }
    assert_eq!(map["inner_and_outer"], serde_json::json!(["yz", "xw"]));
    assert_eq!(map["stable"][0][0], Value::Null, "isoclinic");
    assert!(Pixmap::decode_png(&std::fs::read(&png).expect("the picture")).is_ok());
    assert_eq!(std::fs::read_to_string(&csv).expect("the table").lines().count(), 1 + 31 * 31);
    // J_y and J_z between, above and below J_x = 4 and J_w = 1, at a spin in xw alone: stable unless one lies between.
    let moments =
        json_of(&with(&TOP, &["--map", "y,z", "--spin", "xw=1", "--range", "0.5,5", "--cells", "10", "--json"]));
    let values: Vec<f64> = moments["x"]["values"].as_array().expect("a list").iter().map(number).collect();
    for (row, z) in values.iter().enumerate() {
        for (column, y) in values.iter().enumerate() {
            let between = |moment: &f64| (1.0..=4.0).contains(moment);
            if [y, z].iter().all(|moment| **moment != 1.0 && **moment != 4.0) {
                assert_eq!(moments["stable"][row][column], !(between(y) || between(z)), "J_y = {y}, J_z = {z}");
            }
        }
    }
    // In 5D the idle axis between x and v decides, and no threshold is left.
    let idle = json_of(&["spin", "--moments", "5,4,3,2,1", "--map", "xv,yw", "--cells", "5", "--json"]);
    assert_eq!(idle["threshold"], Value::Null);
    let ring = json_of(&with(&TOP, &["--map", "xz,yw", "--cells", "11", "--json"]));
    assert_eq!((&ring["threshold"], &ring["boundary"]), (&Value::Null, &serde_json::json!([])), "unstable throughout");
}

/// Exit status 2, nothing on standard output, and one line that gives the reason.
fn check_refused(cases: Vec<(Vec<&str>, &str)>) {
    for (arguments, reason) in cases {
        let output = hyperbody(&arguments);
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(output.stdout.is_empty(), "{arguments:?}");
        assert!(message.starts_with("error: ") && message.contains(reason), "{arguments:?}: {message}");
        assert_eq!(message.lines().count(), 1, "{arguments:?}: {message}");
    }
}

#[test]
fn bodies_that_cannot_be_are_refused_with_the_reason() {
    check_refused(vec![
        (vec!["spin", "--moments", "4,-3,2,1", "--spin", "xz=1"], "axis y is -3"),
        (vec!["spin", "--moments", "4,nan,2,1", "--spin", "xz=1"], "finite"),
        (vec!["spin", "--moments", "4,three", "--spin", "xy=1"], "\"three\" is not a number"),
        (vec!["spin", "--moments", "1,1,1,1,1,1,1", "--spin", "xy=1"], "2 to 6"),
        (vec!["spin", "--moments", "4,-inf,2,1", "--spin", "xz=1"], "axis y is -inf"),
        (vec!["spin", "--moments", "0,0,1", "--spin", "xy=1"], "at most one second moment may be zero"),
        (vec!["spin", "--moments", "1,1,1", "--spin", "xy=1e200"], "1e200 rad/s"),
        (vec!["spin", "--moments", "4", "--spin", "xy=1"], "2 to 6"),
        (vec!["spin", "--inertia", "xy=1,xz=1,yz=2.5", "--spin", "xy=1"], "triangle inequality"),
        (vec!["spin", "--inertia", "xy=1,xz=1", "--spin", "xy=1"], "one for each plane"),
        (vec!["spin", "--inertia", "xy=1,xz=1,xw=1,yz=1,yw=1,zw=3", "--spin", "xy=1"], "second moments instead"),
        (vec!["spin", "--inertia", "xy=1,xz=1,xz=1", "--spin", "xy=1"], "twice"),
        (vec!["spin", "--shape", "not-there.off", "--spin", "xy=1"], "not-there.off"),
        (vec!["spin", "--shape", "tesserakt", "--spin", "xy=1"], "no regular polytope of that name"),
        (vec!["spin", "--shape", "cube", "--spin", "xy=1"], "--dimension"),
    ]);
}

#[test]
fn spins_runs_maps_and_files_that_make_no_sense_are_refused_with_the_reason() {
    let here = fresh("spin/nowhere/x.svg");
    let no_folder = here.with_file_name("not-there").join("x.svg");
    let spin = ["--spin", "xz=1"];
    check_refused(vec![
        (with(&TOP, &["--spin", "xv=1"]), "xy xz xw yz yw zw"),
        (with(&TOP, &["--spin", "xy"]), "plane=rate"),
        (with(&TOP, &["--spin", "xy=inf"]), "finite"),
        (with(&TOP, &with(&spin, &["--seconds", "0"])), "duration is 0"),
        (with(&TOP, &with(&spin, &["--dt", "-1"])), "step is -1"),
        (with(&TOP, &with(&spin, &["--dt", "1e-300"])), "at most"),
        (with(&TOP, &with(&spin, &["--disturb", "2"])), "from 0 to 1"),
        (with(&TOP, &with(&spin, &["--seconds", "nan"])), "duration is NaN"),
        (with(&TOP, &with(&spin, &["--seconds", "1e300"])), "1e300 s"),
        (with(&TOP, &with(&spin, &["--tolerance", "0"])), "--tolerance"),
        (with(&TOP, &with(&spin, &["--compare", "rk4"])), "--compare: there is no method"),
        (with(&TOP, &with(&spin, &["--dimension", "4"])), "--dimension"),
        (with(&TOP, &with(&spin, &["--method", "rk4"])), "splitting2"),
        (with(&TOP, &["--spin", "xz=1,xy=1,zw=1", "--method", "exact"]), "no closed form"),
        (with(&TOP, &with(&spin, &["--plot", "picture.gif"])), ".svg or .png"),
        (with(&TOP, &with(&spin, &["--csv", "table.txt"])), ".csv"),
        (with(&TOP, &with(&spin, &["--plot", text_of(&no_folder)])), "there is no folder"),
        (with(&TOP, &["--map", "xy,xz"]), "planes xy and xz must have four different axes"),
        (with(&TOP, &["--map", "x,x", "--spin", "xw=1"]), "axes x and x"),
        (with(&TOP, &["--map", "x,y", "--spin", "xw=0"]), "does not turn"),
        (with(&TOP, &["--map", "xy"]), "two planes"),
        (with(&TOP, &["--map", "xy,zw", "--spin", "xy=1"]), "leave --spin out"),
        (with(&TOP, &["--map", "y,z"]), "steady spin"),
        (with(&TOP, &["--map", "y,z", "--spin", "xy=1,xz=1"]), "share an axis"),
        (with(&TOP, &["--map", "xw,yz", "--range", "1,1"]), "in order"),
        (with(&TOP, &["--map", "xw,yz", "--range", "1"]), "FROM,TO"),
        (with(&TOP, &["--map", "y,z", "--spin", "xw=1", "--range", "-1,1"]), "not negative"),
        (vec!["spin", "--moments", "2,1", "--spin", "xy=1", "--plot", "x.svg", "--show", "path"], "two dimensions"),
    ]);
    // What clap refuses it explains in lines of its own.
    for arguments in
        [with(&TOP, &[]), vec!["spin", "--spin", "xy=1"], with(&TOP, &["--map", "xw,yz", "--seconds", "3"])]
    {
        assert_eq!(hyperbody(&arguments).status.code(), Some(2), "{arguments:?}");
    }
}

#[test]
fn what_is_out_of_proportion_is_refused_by_the_option_that_mends_it() {
    let spin = ["--spin", "xz=1"];
    let fast = ["--spin", "xz=300,xy=200", "--method", "midpoint", "--dt", "0.1", "--seconds", "1"];
    check_refused(vec![
        (with(&TOP, &fast), "error: --dt: the midpoint equation"),
        (with(&TOP, &["--spin", "xz=1,xy=1", "--seconds", "1", "--tolerance", "1e-30"]), "error: --tolerance: after"),
        (with(&TOP, &["--map", "y,z", "--spin", "xw=1", "--range", "-1,1"]), "error: --range: the second moment"),
        (vec!["spin", "--moments", "4,3,-2,1", "--spin", "xy=1"], "axis z is -2; it is ∫ρ z² dV"),
        (vec!["spin", "--moments", "3,2,1", "--map", "xy,xz"], "take four dimensions, and this body has 3"),
        (vec!["spin", "--moments", "3,2,1", "--map", "xw,yz"], "take four dimensions, and this body has 3"),
        (
            with(&TOP, &with(&spin, &["--dt", "100"])),
            "error: --dt: a step of 100 s is longer than the whole run of 60 s",
        ),
        (with(&TOP, &with(&spin, &["--compare", "midpoint,midpoint"])), "error: --compare: midpoint is named twice"),
        (with(&TOP, &with(&spin, &["--compare", "splitting4"])), "what the run itself takes"),
    ]);
}

/// A folder that takes no files is found before the work begins.
#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_takes_no_files_is_refused() {
    for (option, path) in [("--plot", "/proc/picture.svg"), ("--csv", "/proc/table.csv")] {
        let output = hyperbody(&with(&TOP, &["--spin", "xz=1", "--seconds", "1e9", option, path]));
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains(path) && message.contains("cannot be written"), "{message}");
    }
}

#[test]
fn the_report_for_people_says_what_matters() {
    let output = hyperbody(&with(&TOP, &["--spin", "xz=1", "--disturb", "0.001", "--seconds", "100"]));
    let text = String::from_utf8_lossy(&output.stdout);
    for words in ["unstable", "0.169031", "J_y = 3", "measured growth", "driven by", "flips", "splitting4", "Manakov"] {
        assert!(text.contains(words), "{words:?} is missing from\n{text}");
    }
}
