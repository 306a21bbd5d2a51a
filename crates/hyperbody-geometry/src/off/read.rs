//! From text to [`OffFile`].
//!
//! Programs disagree about details that the header does not tell: whether the number of edges comes second or third
//! among the counts, whether counts may be left out, and whether numbers after a face on its line are its colour or the
//! next face; and of vertices with colours, how many numbers a colour has. So a file is read in each of these ways, the usual one first, until one uses up exactly what is there. If none
//! does, the error is that of the way that got farthest.

mod lines;

use super::OffFile;
use crate::error::GeometryErrorKind::BadMesh;
use crate::{GeometryError, Result};

#[derive(Clone, Copy)]
struct Token<'a> {
    text: &'a str,
    line: usize,
}

/// Why one way of reading failed.
struct Fault {
    line: usize,
    message: String,
    /// Tokens understood before it.
    progress: usize,
}

/// One way of reading what follows the header.
#[derive(Clone, Copy, PartialEq)]
struct Convention {
    /// How many counts there are.
    counts: usize,
    /// The number of edges is the second count instead of the third.
    edges_second: bool,
    /// What follows an element on its line is a colour.
    colours: bool,
    beside: Beside,
}

/// What follows the coordinates of a vertex and is passed over: its normal, colour and place in a picture.
#[derive(Clone, Copy, PartialEq)]
enum Beside {
    /// So many numbers.
    Numbers(usize),
    /// All numbers that are left on the line.
    RestOfLine,
}

/// What the first word of a file says.
struct Header {
    dimension: usize,
    /// The first token after it.
    body: usize,
    /// The likeliest first.
    beside: Vec<Beside>,
}

/// Reads a file in one of the OFF forms: see [`OffFile`].
///
/// # Errors
/// `BadMesh` with the line number and the reason.
pub fn parse(text: &str) -> Result<OffFile> {
    let tokens = tokens_of(text);
    let header = header(&tokens).map_err(explain)?;
    let (dimension, body) = (header.dimension, header.body);
    let mut farthest: Option<Fault> = None;
    for convention in conventions(&header, &tokens[body..]) {
        match (Reader { tokens: &tokens, next: body }).file(dimension, convention) {
            Ok(file) => return Ok(file),
            Err(fault) if farthest.as_ref().is_none_or(|best| fault.progress > best.progress) => farthest = Some(fault),
            Err(_) => {}
        }
    }
    let plain = header.beside == [Beside::Numbers(0)];
    if let Some(misfit) = lines::misfit(dimension, &tokens[body..]).filter(|_| plain) {
        return Err(explain(misfit));
    }
    Err(explain(farthest.unwrap_or_else(|| end_of_file(&tokens, "the counts of vertices and faces"))))
}

fn explain(fault: Fault) -> GeometryError {
    GeometryError::new(BadMesh, format!("OFF, line {}: {}", fault.line, fault.message))
}

fn end_of_file(tokens: &[Token<'_>], wanted: &str) -> Fault {
    let line = tokens.last().map_or(1, |token| token.line);
    Fault { line, message: format!("the file ends here, where {wanted} should follow"), progress: tokens.len() }
}

fn tokens_of(text: &str) -> Vec<Token<'_>> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut tokens = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let content = line.split('#').next().unwrap_or_default();
        tokens.extend(content.split_whitespace().map(|text| Token { text, line: index + 1 }));
    }
    tokens
}

/// The word that a file begins with, as Geomview defines it: `[ST][C][N][n or the dimension]OFF`, for places in a picture, colours and
/// normals of vertices. Programs for polytopes write NOFF for nOFF too, which shows in a line with the dimension alone.
fn header(tokens: &[Token<'_>]) -> std::result::Result<Header, Fault> {
    let first = tokens.first().ok_or_else(|| end_of_file(tokens, "the word OFF, 4OFF or nOFF"))?;
    let wrong = |token: &Token<'_>, message: String| Err(Fault { line: token.line, message, progress: 0 });
    let word = first.text.to_ascii_uppercase();
    let Some(prefix) = word.strip_suffix("OFF") else {
        let message =
            format!("\"{}\": the file must begin with OFF (3D), 4OFF, or nOFF with n = 2 to 6", cut(first.text));
        return wrong(first, message);
    };
    if let Some(token) = tokens.get(1).filter(|token| token.text.eq_ignore_ascii_case("BINARY")) {
        return wrong(token, "the file is a binary one: save it as text, which programs also call ASCII".to_owned());
    }
    let (prefix, texture) = prefix.strip_prefix("ST").map_or((prefix, false), |rest| (rest, true));
    let (prefix, colours) = prefix.strip_prefix('C').map_or((prefix, false), |rest| (rest, true));
    let is_dimension = |token: &Token<'_>| matches!(token.text.parse(), Ok(2..=6_usize));
    let alone = tokens.get(2).is_none_or(|third| tokens[1].line != third.line);
    let named_so = first.text.contains('n') && prefix == "N" || alone && tokens.get(1).is_some_and(is_dimension);
    let (prefix, normals) = match prefix.strip_prefix('N') {
        Some(rest) if !(rest.is_empty() && named_so) => (rest, true),
        _ => (prefix, false),
    };
    let (digits, token, body) = match prefix {
        "" => ("3", first, 1),
        "N" => {
            let second = tokens.get(1).ok_or_else(|| end_of_file(tokens, "the dimension"))?;
            (second.text, second, 2)
        }
        digits => (digits, first, 1),
    };
    let Ok(dimension @ 2..=6) = digits.parse() else {
        let message = format!("\"{}\": the dimension before OFF must be 2 to 6", cut(token.text));
        return wrong(token, message);
    };
    let others = if normals { dimension } else { 0 } + if texture { 2 } else { 0 };
    let beside = match (colours, others) {
        (false, 0) => vec![Beside::Numbers(0)],
        (false, _) => vec![Beside::RestOfLine, Beside::Numbers(others)],
        (true, _) => vec![Beside::RestOfLine, Beside::Numbers(others + 4), Beside::Numbers(others + 3)],
    };
    Ok(Header { dimension, body, beside })
}

/// The ways to read a file whose first line of counts begins `body`, the likeliest first.
fn conventions(header: &Header, body: &[Token<'_>]) -> Vec<Convention> {
    let dimension = header.dimension;
    let most = dimension.max(3);
    let on_line = body.iter().take(most).take_while(|token| token.line == body[0].line).count();
    let mut list: Vec<Convention> = Vec::new();
    for &beside in &header.beside {
        for counts in [on_line, dimension, most] {
            for (edges_second, colours) in [(false, true), (false, false), (true, true), (true, false)] {
                let convention = Convention { counts, edges_second, colours, beside };
                if counts > 0 && !list.contains(&convention) {
                    list.push(convention);
                }
            }
        }
    }
    list
}

struct Reader<'a> {
    tokens: &'a [Token<'a>],
    next: usize,
}

impl<'a> Reader<'a> {
    fn file(mut self, dimension: usize, convention: Convention) -> std::result::Result<OffFile, Fault> {
        let body = self.next;
        let mut counts = Vec::new();
        for _ in 0..convention.counts {
            let count = self.integer("a number of elements")?;
            counts.push((count, self.tokens[self.next - 1]));
        }
        let (vertex_count, token) = counts[0];
        self.check_room(vertex_count, dimension, "vertices", &token)?;
        let mut vertices = Vec::with_capacity(vertex_count * dimension);
        for vertex in 0..vertex_count {
            for _ in 0..dimension {
                vertices.push(self.coordinate(vertex)?);
            }
            match convention.beside {
                Beside::RestOfLine => self.skip_line(),
                Beside::Numbers(count) => {
                    for _ in 0..count {
                        self.coordinate(vertex)?;
                    }
                }
            }
        }
        // The number of edges is neither needed nor reliable. The others are those of ranks 2, 3, …
        let edges = if convention.edges_second { 1 } else { 2 };
        let mut elements: Vec<Vec<Vec<u32>>> = Vec::new();
        let mut lines: Vec<Vec<u32>> = Vec::new();
        for (position, (count, token)) in counts.into_iter().enumerate().skip(1) {
            if position != edges {
                let below = elements.last().map_or(vertex_count, Vec::len);
                self.check_room(count, 1, "faces", &token)?;
                let (rank, begin) = self.rank(elements.len() + 2, count, below, convention.colours)?;
                elements.push(rank);
                lines.push(begin);
            }
        }
        while elements.last().is_some_and(Vec::is_empty) {
            elements.pop();
        }
        match self.tokens.get(self.next) {
            None => Ok(OffFile { dimension, vertices, elements, lines }),
            // Everything that the counts announce was there: no other way of reading gets farther.
            Some(token) => Err(Fault {
                line: token.line,
                message: format!(
                    "there is more in the file than its counts of vertices and faces say{}",
                    lines::missing_counts(dimension, &self.tokens[body..])
                ),
                progress: self.tokens.len(),
            }),
        }
    }

    /// The elements of one rank, each a list of elements of the rank below (for rank 2: of vertices), and the lines they begin on.
    fn rank(
        &mut self,
        rank: usize,
        count: usize,
        below: usize,
        colours: bool,
    ) -> std::result::Result<(Vec<Vec<u32>>, Vec<u32>), Fault> {
        let part = if rank == 2 { "vertices" } else { "faces of the rank below" };
        let (mut elements, mut lines) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for index in 0..count {
            let size = self.integer("the size of a face")?;
            let token = self.tokens[self.next - 1];
            if size < rank + 1 {
                let part = if size == 1 {
                    part.replacen("vertices", "vertex", 1).replacen("faces", "face", 1)
                } else {
                    part.to_owned()
                };
                let message = format!("face {index} of rank {rank} has {size} {part}: it needs at least {}", rank + 1);
                return Err(self.fault(&token, message));
            }
            self.check_room(size, 1, part, &token)?;
            let mut element = Vec::with_capacity(size);
            for _ in 0..size {
                let part_index = self.integer("an index")?;
                let token = self.tokens[self.next - 1];
                if part_index >= below {
                    let message = format!(
                        "face {index} of rank {rank} names number {part_index} of the {part}, but there are {below}, \
                         counted from 0"
                    );
                    return Err(self.fault(&token, message));
                }
                element.push(part_index as u32);
            }
            if let Some(message) = lines::named_twice(rank, index, &element) {
                // As clear as can be, whatever other ways of reading make of it.
                return Err(Fault { line: token.line, message, progress: self.tokens.len() });
            }
            elements.push(element);
            lines.push(token.line as u32);
            if colours {
                self.skip_line();
            }
        }
        Ok((elements, lines))
    }

    /// Passes over the numbers that are left on the line of the last token.
    fn skip_line(&mut self) {
        let line = self.tokens[self.next - 1].line;
        while self.tokens.get(self.next).is_some_and(|token| token.line == line && token.text.parse::<f64>().is_ok()) {
            self.next += 1;
        }
    }

    /// Refuses counts that the rest of the file cannot hold, before anything is allocated for them.
    fn check_room(
        &self,
        count: usize,
        tokens_each: usize,
        what: &str,
        token: &Token<'_>,
    ) -> std::result::Result<(), Fault> {
        let left = self.tokens.len() - self.next;
        if count > u32::MAX as usize || count.saturating_mul(tokens_each) > left {
            let message = format!("{count} {what} are announced, but the file ends after {left} more words");
            return Err(self.fault(token, message));
        }
        Ok(())
    }

    fn take(&mut self, wanted: &str) -> std::result::Result<Token<'a>, Fault> {
        let token = self.tokens.get(self.next).copied().ok_or_else(|| end_of_file(self.tokens, wanted))?;
        self.next += 1;
        Ok(token)
    }

    fn integer(&mut self, wanted: &str) -> std::result::Result<usize, Fault> {
        let token = self.take(wanted)?;
        token.text.parse().map_err(|_| {
            self.fault(&token, format!("\"{}\" stands where {wanted} should be, a whole number", cut(token.text)))
        })
    }

    fn coordinate(&mut self, vertex: usize) -> std::result::Result<f64, Fault> {
        let token = self.take("a coordinate")?;
        match token.text.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => {
                let message =
                    format!("\"{}\" is no coordinate of vertex {vertex}: it must be a finite number", cut(token.text));
                Err(self.fault(&token, message))
            }
        }
    }

    fn fault(&self, token: &Token<'_>, message: String) -> Fault {
        Fault { line: token.line, message, progress: self.next }
    }
}

/// The start of a word that may be as long as the file.
fn cut(text: &str) -> String {
    let mut short: String = text.chars().take(24).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    short
}
