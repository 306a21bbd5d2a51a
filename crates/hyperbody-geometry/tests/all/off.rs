//! OFF files: every form that programs write, round trips, and every way to break one.

use crate::common::Random;
use hyperbody_geometry::regular::{Size, names, polytope};
use hyperbody_geometry::{GeometryError, GeometryErrorKind, MassProperties, OffFile, off};
use hyperbody_math::Matrix;

const TETRAHEDRON: &str = "OFF\n4 4 6\n1 1 1\n1 -1 -1\n-1 1 -1\n-1 -1 1\n3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n";

#[test]
fn forms_that_programs_write_are_the_same_file() {
    let expected = off::parse(TETRAHEDRON).unwrap();
    assert_eq!((expected.dimension(), expected.vertex_count()), (3, 4));
    assert_eq!(expected.elements(2), [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]);
    let variants = [
        TETRAHEDRON.replace('\n', "\r\n"),
        TETRAHEDRON.replace('\n', " \t\n\n# comment 1 2 3\n"),
        // Everything on one line, or every number on its own.
        TETRAHEDRON.replace('\n', " "),
        TETRAHEDRON.replace(['\n', ' '], "\n"),
        TETRAHEDRON.replace("OFF\n", "off "),
        TETRAHEDRON.replace("OFF", "3OFF"),
        TETRAHEDRON.replace("OFF", "nOFF 3"),
        TETRAHEDRON.replace("OFF", "\u{feff}OFF # a tetrahedron"),
        // Edges second, unknown, or left out.
        TETRAHEDRON.replace("4 4 6", "4 6 4"),
        TETRAHEDRON.replace("4 4 6", "4 4 0"),
        TETRAHEDRON.replace("4 4 6", "4 4"),
        // Colours in every customary form.
        TETRAHEDRON.replace("3 0 1 2", "3 0 1 2 255 0 0"),
        TETRAHEDRON.replace("3 0 1 2", "3 0 1 2 0.5 0.25 1 1").replace("3 1 3 2", "3 1 3 2 17"),
    ];
    for text in variants {
        assert_eq!(off::parse(&text).unwrap_or_else(|e| panic!("{e}: {text}")), expected, "{text}");
    }
}

/// Normals, colours and places in pictures of vertices are passed over, on lines of their own or not.
#[test]
fn vertices_with_colours_and_normals_are_read() {
    let expected = off::parse(TETRAHEDRON).unwrap();
    let with = |header: &str, beside: &str| {
        let mut lines: Vec<String> = TETRAHEDRON.lines().map(str::to_owned).collect();
        lines[0] = header.to_owned();
        lines[2..6].iter_mut().for_each(|line| *line += beside);
        lines.join("\n") + "\n"
    };
    for (header, beside) in [
        ("COFF", " 255 0 0 255"),
        ("COFF", " 0.5 0.25 1"),
        ("COFF", " 17"),
        ("NOFF", " 0 0.6 -0.8"),
        ("STOFF", " 0.5 0.25"),
        ("CNOFF", " 0 0 1 0.1 0.2 0.3 1"),
        ("STCN3OFF", " 0 0 1 0.1 0.2 0.3 1 0.5 0.5"),
        ("Cnoff 3", " 255 0 0 255"),
        ("coff", " 255 0 0 255 # red"),
    ] {
        for text in [with(header, beside), with(header, beside).replace("3 0 1 2\n", "3 0 1 2 255 255 0\n")] {
            assert_eq!(off::parse(&text).unwrap_or_else(|e| panic!("{e}: {text}")), expected, "{text}");
        }
        // All on one line, where a colour may have three or four numbers.
        if !beside.contains('#') && beside != " 17" {
            let text = with(header, beside).replace('\n', " ");
            assert_eq!(off::parse(&text).unwrap_or_else(|e| panic!("{e}: {text}")), expected, "{text}");
        }
    }
    // Programs for polytopes write it so.
    for text in ["NOFF 3", "NOFF\n3", "noff\n3"].map(|header| TETRAHEDRON.replace("OFF", header)) {
        assert_eq!(off::parse(&text).as_ref(), Ok(&expected), "{text}");
    }
    assert!(survives(&with("STCNOFF", " 0 0 1 0.1 0.2 0.3 1 0.5 0.5")));
}

#[test]
fn vertices_only_mean_their_hull() {
    for counts in ["8 0 0", "8", "8 0", "8 0 12"] {
        let text = format!("OFF\n{counts}\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1");
        let cube = off::parse(&text).unwrap_or_else(|e| panic!("{e}: {counts}")).to_polytope::<3>().unwrap();
        assert_eq!(cube.face_lattice().face_counts(), [8, 12, 6], "{counts}");
    }
    let wrong = off::parse(TETRAHEDRON).unwrap().to_polytope::<4>().unwrap_err();
    assert!(wrong.to_string().contains("dimension 3, where 4"), "{wrong}");
}

fn round_trip<const N: usize>() {
    for name in names(N) {
        let original = polytope::<N>(name, Size::Edge(1.0 / 3.0)).unwrap();
        let file = OffFile::from_polytope(&original);
        let text = file.to_string();
        let again = off::parse(&text).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(again, file, "{name}");
        assert_eq!(again.to_string(), text, "{name}");
        let hull = again.to_polytope::<N>().unwrap();
        assert_eq!(hull.vertices(), original.vertices(), "{name}");
        assert_eq!(hull.facets().len(), original.facets().len(), "{name}");
        for face in file.elements(2) {
            for (k, &a) in face.iter().enumerate() {
                let b = face[(k + 1) % face.len()];
                assert!(original.neighbours_of_vertex(a as usize).contains(&b), "{name}: {face:?} is no cycle");
            }
        }
    }
}

#[test]
fn files_survive_writing_and_reading() {
    round_trip::<2>();
    round_trip::<3>();
    round_trip::<4>();
    round_trip::<5>();
    round_trip::<6>();
}

/// Coordinates with six digits break flat facets up, unless the file's own facets are listened to.
#[test]
fn files_with_few_digits_keep_their_facets() {
    for name in ["24-cell", "120-cell", "600-cell"] {
        let exact = polytope::<4>(name, Size::Circumradius(1.0)).unwrap();
        let mut text = String::new();
        for line in OffFile::from_polytope(&exact).to_string().lines() {
            let words: Vec<String> = line
                .split(' ')
                .map(|word| match word.parse::<f64>() {
                    Ok(value) if word.contains('.') => format!("{value:.6}"),
                    _ => word.to_string(),
                })
                .collect();
            text += &(words.join(" ") + "\n");
        }
        let rounded = off::parse(&text).unwrap().to_polytope::<4>().unwrap();
        assert_eq!(rounded.face_lattice().face_counts(), exact.face_lattice().face_counts(), "{name}");
    }
}

#[test]
fn errors_give_the_line_and_the_reason() {
    let cases = [
        ("", 1, "ends here"),
        ("# nothing\n", 1, "ends here"),
        ("PLY\n", 1, "must begin with OFF"),
        ("COFF\n1 0 0\n", 2, "announced"),
        ("XOFF\n1 0 0\n", 1, "2 to 6"),
        ("OFF BINARY\n4 4 6\n", 1, "save it as text"),
        ("COFF\n1 0 0\n0 0 red 0 0 0\n", 3, "\"red\" is no coordinate"),
        ("7OFF\n1 0 0\n", 1, "2 to 6"),
        ("nOFF\n", 1, "the dimension"),
        ("OFF\n", 1, "ends here"),
        ("OFF\n4 -4 6\n", 2, "whole number"),
        ("OFF\n18446744073709551615 4 6\n0 0 0\n", 2, "announced"),
        ("OFF\n99999999999999999999999999 4 6\n", 2, "whole number"),
        ("OFF\n4 4 6\n1 1 1\n1 -1 x\n", 2, "announced"),
        (&TETRAHEDRON.replace("-1 1 -1", "-1 1 NaN"), 5, "finite"),
        (&TETRAHEDRON.replace("-1 1 -1", "-1 1e999 -1"), 5, "finite"),
        (&TETRAHEDRON.replace("3 0 3 1", "3 0 4 1"), 8, "counted from 0"),
        (&TETRAHEDRON.replace("3 0 3 1", "2 0 3"), 8, "at least 3"),
        (&TETRAHEDRON.replace("3 1 3 2", "3 1 3"), 10, "ends"),
        (&(TETRAHEDRON.to_string() + "3 1 2 3\n"), 11, "more in the file"),
    ];
    for (text, line, reason) in cases {
        let error = off::parse(text).unwrap_err();
        assert_eq!(error.kind(), GeometryErrorKind::BadMesh);
        let message = error.to_string();
        assert!(message.contains(&format!("line {line}:")) && message.contains(reason), "{text:?}: {message}");
    }
}

/// A count or a dimension in the header that is wrong shows on the first line that does not fit it, and the message says so.
#[test]
fn wrong_headers_are_told_from_wrong_lines() {
    let cell = OffFile::from_polytope(&polytope::<4>("5-cell", Size::Edge(1.0)).unwrap()).to_string();
    let cases = [
        (TETRAHEDRON.replace("4 4 6", "5 4 6"), 7, "has 4 numbers where vertex 4 with 3 was expected"),
        (TETRAHEDRON.replace("4 4 6", "3 4 6").replace("-1 -1 1", "0 1 1"), 6, "is the count of vertices (3) too low?"),
        (TETRAHEDRON.replace("OFF", "4OFF"), 3, "has 3 numbers where a vertex of 4 was expected"),
        (TETRAHEDRON.replace("OFF", "4OFF"), 3, "3OFF for 3 dimensions"),
        (cell.replace("4OFF", "OFF"), 4, "has 4 numbers where a vertex of 3 was expected"),
        (cell.replace("5 10 10 5", "5 10 10"), 19, "line 3 has 3 counts, and lacks that of the 3-faces (cells)"),
        (TETRAHEDRON.replace("3 1 3 2", "1 1"), 10, "has 1 vertex: it needs"),
        (TETRAHEDRON.replace("3 1 3 2", "4 1 3 3 2"), 10, "face 3 names vertex 3 twice"),
        (TETRAHEDRON.replace("3 1 3 2", "4 1 3 2 1"), 10, "face 3 names vertex 1 twice"),
        (cell.replacen("\n4 ", "\n5 0 ", 1), 19, "cell 0 names face 0 twice"),
    ];
    for (text, line, reason) in cases {
        let message = off::parse(&text).unwrap_err().to_string();
        assert!(message.contains(&format!("OFF, line {line}: ")) && message.contains(reason), "{text}: {message}");
    }
    // A slit from the rim to a hole passes twice through its ends, and is read.
    let slit = "2OFF\n7 1\n0 0\n4 0\n0 4\n1 1\n2 1\n1 2\n9 9\n8 0 1 2 0 3 5 4 3\n";
    assert_eq!(off::parse(slit).unwrap().elements(2)[0].len(), 8);
}

/// Changes made to each file.
const MUTATIONS: usize = 10_000;

/// Bodies of these files: what is read may be no body, and that is told as clearly.
fn build<const N: usize>(file: &OffFile) {
    let told = |error: &GeometryError| assert!(error.to_string().len() > 20, "{error}");
    let _ = file.to_polytope::<N>().inspect_err(told);
    if let Ok(surface) = file.boundary::<N>().inspect_err(told) {
        let points = file.vertices::<N>().unwrap();
        let _ = MassProperties::of_closed_boundary(&points, &surface).inspect_err(told);
    }
}

/// A file read, written and read again; whether there is a file.
fn survives(text: &str) -> bool {
    match off::parse(text) {
        Ok(file) => {
            assert_eq!(off::parse(&file.to_string()).as_ref(), Ok(&file), "{text}");
            match file.dimension() {
                2 => build::<2>(&file),
                3 => build::<3>(&file),
                4 => build::<4>(&file),
                5 => build::<5>(&file),
                _ => build::<6>(&file),
            }
            true
        }
        Err(error) => {
            assert!(error.to_string().starts_with("OFF, line "), "{error}");
            false
        }
    }
}

fn mutated(text: &str, random: &mut Random) -> String {
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..=random.below(4) {
        let at = random.below(bytes.len());
        match random.below(4) {
            0 => bytes[at] = b"0123456789-+.eE#nOF \n"[random.below(21)],
            1 => drop(bytes.remove(at)),
            2 => bytes.insert(at, b"0123456789-+.eE#nOF \n"[random.below(21)]),
            _ => bytes[at] = random.bits() as u8,
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Success or a clear error, for every prefix and for random changes; what is read survives writing, and can be made a body or not.
#[test]
fn broken_files_never_panic() {
    let mut random = Random(7);
    let cell = OffFile::from_polytope(&polytope::<4>("16-cell", Size::Circumradius(1.0)).unwrap()).to_string();
    let simplex = OffFile::from_polytope(&polytope::<5>("5-simplex", Size::Edge(0.1)).unwrap()).to_string();
    for (what, text) in [("a tetrahedron", TETRAHEDRON), ("a 16-cell", &cell), ("a simplex of 5D", &simplex)] {
        let prefixes = (0..text.len()).filter(|&end| text.is_char_boundary(end));
        let lengths: Vec<bool> = prefixes.map(|end| survives(&text[..end])).collect();
        let changes: Vec<bool> = (0..MUTATIONS).map(|_| survives(&mutated(text, &mut random))).collect();
        let read = |all: &[bool]| all.iter().filter(|&&read| read).count();
        let (of_lengths, of_changes) = (read(&lengths), read(&changes));
        println!(
            "{what}: {} prefixes, {of_lengths} of them read; {} mutations, {of_changes} of them read; the others told why",
            lengths.len(),
            changes.len()
        );
        assert!(of_changes > 0 && of_changes < changes.len(), "both ends are to be seen");
    }
}

/// Programs take the order of the vertices for the orientation of a face: outward, counterclockwise.
#[test]
fn written_faces_look_outward() {
    for name in names(3) {
        let solid = polytope::<3>(name, Size::Circumradius(1.0)).unwrap();
        let file = OffFile::from_polytope(&solid);
        let points = file.vertices::<3>().unwrap();
        let mut volume = 0.0;
        for face in file.elements(2) {
            for pair in face[1..].windows(2) {
                let [a, b, c] = [face[0], pair[0], pair[1]].map(|v| points[v as usize]);
                volume += Matrix::from_columns([a, b, c]).determinant() / 6.0;
            }
        }
        let expected = MassProperties::of_polytope(&solid).mass;
        assert!((volume / expected - 1.0).abs() < 1e-12, "{name}: {volume} for {expected}");
    }
}
