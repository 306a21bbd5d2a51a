//! What the lines of a file tell where its numbers fit no way of reading.
//!
//! A count that is one too high or low, or a header of another dimension, makes vertices of faces or faces of vertices; what
//! then fails is some innocent line further on, or the end of the file. People and programs write one vertex a line, so the first
//! line with another number of numbers than a vertex has is where the header and the file part.

use super::{Fault, Token};

/// The first line that does not fit the counts and the dimension of the header, if vertices stand one a line. `body` begins
/// with the counts.
pub(super) fn misfit(dimension: usize, body: &[Token<'_>]) -> Option<Fault> {
    let lines: Vec<&[Token<'_>]> = body.chunk_by(|a, b| a.line == b.line).collect();
    let (counts, lines) = lines.split_first()?;
    let vertex_count: usize = counts[0].text.parse().ok()?;
    let vertices = &lines[..vertex_count.min(lines.len())];
    let first = vertices.first()?.len();
    let alike = |width: usize| vertices.iter().take(2).all(|line| line.len() == width);
    if first != dimension {
        // A vertex a line, all of another dimension; numbers that stand in other ways tell nothing.
        return (vertex_count > 1 && alike(first) && (2..=MOST_NUMBERS).contains(&first))
            .then(|| wrong_dimension(dimension, first, &vertices[0][0]));
    }
    if let Some(number) = vertices.iter().position(|line| line.len() != dimension) {
        let line = vertices[number];
        let message = format!(
            "{} where vertex {number} with {dimension} was expected: is the count of vertices ({vertex_count}) or the dimension in the \
             header wrong?",
            numbers_on(line)
        );
        return Some(Fault { line: line[0].line, message, progress: 0 });
    }
    let next = lines.get(vertex_count)?;
    (next.len() == dimension && !may_be_face(next)).then(|| {
        let message = format!(
            "{}, like the vertices before it, where a face was expected: is the count of vertices ({vertex_count}) too low?",
            numbers_on(next)
        );
        Fault { line: next[0].line, message, progress: 0 }
    })
}

/// Most numbers of a vertex with all that may stand beside it: coordinates, normal, colour and place in a picture.
const MOST_NUMBERS: usize = 18;

fn wrong_dimension(dimension: usize, width: usize, token: &Token<'_>) -> Fault {
    let mut remedies = Vec::new();
    if (2..=6).contains(&width) {
        remedies.push(format!("{width}OFF for {width} dimensions"));
    }
    if width > dimension {
        remedies.push("COFF or NOFF for colours or normals beside the coordinates".to_owned());
    }
    let remedy = if remedies.is_empty() { String::new() } else { format!(" ({})", remedies.join(", ")) };
    let message = format!(
        "has {width} numbers where a vertex of {dimension} was expected, and so has the next line: is the dimension in the header \
         wrong?{remedy}"
    );
    Fault { line: token.line, message, progress: 0 }
}

fn numbers_on(line: &[Token<'_>]) -> String {
    format!("has {} number{}", line.len(), if line.len() == 1 { "" } else { "s" })
}

/// Whether a line begins with the size of a face.
fn may_be_face(line: &[Token<'_>]) -> bool {
    line[0].text.parse::<usize>().is_ok_and(|size| size >= 3)
}

/// What is missing in a file that lists more than its header counts: from four dimensions on each rank needs its count.
pub(super) fn missing_counts(dimension: usize, body: &[Token<'_>]) -> String {
    let Some(first) = body.first() else { return String::new() };
    let counts = body.iter().take_while(|token| token.line == first.line).count();
    if dimension < 4 || counts >= dimension {
        return String::new();
    }
    let ranks: Vec<String> = (counts.max(3)..dimension).map(|rank| format!("{rank}-faces")).collect();
    let cells = if ranks.first().is_some_and(|rank| rank == "3-faces") { " (cells)" } else { "" };
    format!(
        ": line {} has {counts} counts, and lacks that of the {}{cells}; counts may be missing only for ranks that the file does not list",
        first.line,
        ranks.join(" and ")
    )
}

/// What is wrong with an element that names a part twice. Polygons may pass through a vertex twice, as where a slit joins a hole to
/// the rim, but not stay there.
pub(super) fn named_twice(rank: usize, index: usize, element: &[u32]) -> Option<String> {
    if rank == 2 {
        let next = element.iter().skip(1).chain(element.first());
        let (twice, _) = element.iter().zip(next).find(|(a, b)| a == b)?;
        return Some(format!("face {index} names vertex {twice} twice, one after the other"));
    }
    let mut sorted = element.to_vec();
    sorted.sort_unstable();
    let twice = sorted.windows(2).find(|pair| pair[0] == pair[1])?[0];
    let (whole, part) = if rank == 3 {
        ("cell".to_owned(), "face".to_owned())
    } else {
        (format!("face of rank {rank}, number"), format!("face of rank {}, number", rank - 1))
    };
    Some(format!("{whole} {index} names {part} {twice} twice"))
}
