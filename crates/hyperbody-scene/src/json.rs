//! A JSON document as a tree that keeps the order of keys, for reading with good messages and for writing readable files.
//!
//! `serde_json::Value` would do but for three things: it forgets the order of keys, it lets the last of two equal keys
//! win silently, and its printer puts every number of a matrix on a line of its own.

use std::cell::Cell;
use std::collections::BTreeSet;
use std::fmt::{self, Write};

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};

use crate::error::{ErrorKind, SceneError};

/// Largest number of values in one document: some hundred thousand bodies, in memory about 200 MB.
const MAX_VALUES: usize = 5_000_000;

/// Widest line that [`Json::to_text`] writes before it breaks a list or object.
const LINE_WIDTH: usize = 120;

/// A JSON value. Keys of an object are in the order of the document and differ from each other.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Json {
    Null,
    Bool(bool),
    Number(f64),
    Text(String),
    List(Vec<Json>),
    Object(Vec<(String, Json)>),
}

impl Json {
    /// Reads a whole document.
    pub(crate) fn parse(text: &str) -> Result<Self, SceneError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let count = Cell::new(0);
        let mut deserializer = serde_json::Deserializer::from_str(text);
        let tree = JsonSeed { count: &count }.deserialize(&mut deserializer);
        tree.and_then(|tree| deserializer.end().map(|()| tree)).map_err(|error| syntax_error(text, &error))
    }

    /// What kind of value this is, as a phrase for messages.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::Null => "null",
            Self::Bool(_) => "true or false",
            Self::Number(_) => "a number",
            Self::Text(_) => "a string",
            Self::List(_) => "a list",
            Self::Object(_) => "an object",
        }
    }

    /// The document as text with a line end after it; what fits on a line stays on one.
    pub(crate) fn to_text(&self) -> String {
        let mut text = String::new();
        self.write(&mut text, 0, 0);
        text.push('\n');
        text
    }

    fn write(&self, out: &mut String, depth: usize, column: usize) {
        let inline = self.inline();
        if column + inline.len() < LINE_WIDTH || !matches!(self, Self::List(_) | Self::Object(_)) {
            out.push_str(&inline);
            return;
        }
        let indent = "  ".repeat(depth + 1);
        let (open, close) = if matches!(self, Self::List(_)) { ('[', ']') } else { ('{', '}') };
        out.push(open);
        let mut separator = "\n";
        let mut item = |key: Option<&str>, value: &Self| {
            out.push_str(separator);
            out.push_str(&indent);
            let label = key.map_or_else(String::new, |key| format!("{}: ", quoted(key)));
            out.push_str(&label);
            value.write(out, depth + 1, indent.len() + label.len());
            separator = ",\n";
        };
        match self {
            Self::List(items) => items.iter().for_each(|value| item(None, value)),
            Self::Object(fields) => fields.iter().for_each(|(key, value)| item(Some(key), value)),
            _ => {}
        }
        out.push('\n');
        out.push_str(&"  ".repeat(depth));
        out.push(close);
    }

    fn inline(&self) -> String {
        match self {
            Self::Null => "null".to_owned(),
            Self::Bool(value) => value.to_string(),
            Self::Number(value) => number_text(*value),
            Self::Text(text) => quoted(text),
            Self::List(items) => {
                let items: Vec<String> = items.iter().map(Self::inline).collect();
                format!("[{}]", items.join(", "))
            }
            Self::Object(fields) => {
                let fields: Vec<String> =
                    fields.iter().map(|(key, value)| format!("{}: {}", quoted(key), value.inline())).collect();
                format!("{{{}}}", fields.join(", "))
            }
        }
    }
}

/// The shortest text that reads back as the same number; whole numbers without ".0". JSON has no word for what is not
/// finite, and scenes hold no such numbers, so those become null.
fn number_text(value: f64) -> String {
    let magnitude = value.abs();
    if !value.is_finite() {
        "null".to_owned()
    } else if magnitude == 0.0 || (1e-5..1e16).contains(&magnitude) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for character in text.chars() {
        match character {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            c if c.is_control() => write!(out, "\\u{:04x}", u32::from(c)).expect("writing to a String cannot fail"),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// The parser's complaint in this crate's words.
fn syntax_error(text: &str, error: &serde_json::Error) -> SceneError {
    let (line, column) = (error.line(), error.column());
    let place = format!("line {line}, column {column}");
    let full = error.to_string();
    let said = full.strip_suffix(&format!(" at line {line} column {column}")).unwrap_or(&full);
    let rest = text.lines().nth(line.saturating_sub(1)).and_then(|line| line.get(column.saturating_sub(1)..));
    let rest = rest.unwrap_or("").trim_start_matches('-');
    let message = if error.is_eof() {
        format!("not JSON: {said}; the file looks cut off")
    } else if ["NaN", "nan", "Inf", "inf"].iter().any(|word| rest.starts_with(word)) {
        "not JSON: there is no NaN or Infinity in JSON; every number has to be finite".to_owned()
    } else if said.contains("number out of range") {
        "a number is out of range; numbers go up to about 1.8e308".to_owned()
    } else if said.contains("recursion limit") {
        "nested deeper than 128 levels; no scene needs that".to_owned()
    } else if said == "key must be a string" {
        "not JSON: a key has to be a string in double quotes".to_owned()
    } else if said.starts_with("key \"") || said.starts_with("more than") {
        said.to_owned()
    } else {
        format!("not JSON: {said}")
    };
    SceneError::new(ErrorKind::Syntax, place, message)
}

/// Builds a [`Json`] and counts its values, so that a small file cannot claim much memory.
#[derive(Clone, Copy)]
struct JsonSeed<'a> {
    count: &'a Cell<usize>,
}

impl<'de> DeserializeSeed<'de> for JsonSeed<'_> {
    type Value = Json;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Json, D::Error> {
        self.count.set(self.count.get() + 1);
        if self.count.get() > MAX_VALUES {
            return Err(D::Error::custom(format!("more than {MAX_VALUES} values; split the scene")));
        }
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for JsonSeed<'_> {
    type Value = Json;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E: Error>(self) -> Result<Json, E> {
        Ok(Json::Null)
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<Json, E> {
        Ok(Json::Bool(value))
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Json, E> {
        Ok(Json::Number(value))
    }

    // Integers beyond 2^53 round to the nearest number that a simulation can hold.
    fn visit_u64<E: Error>(self, value: u64) -> Result<Json, E> {
        Ok(Json::Number(value as f64))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Json, E> {
        Ok(Json::Number(value as f64))
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Json, E> {
        Ok(Json::Text(value.to_owned()))
    }

    fn visit_string<E: Error>(self, value: String) -> Result<Json, E> {
        Ok(Json::Text(value))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Json, A::Error> {
        let mut list = Vec::new();
        while let Some(item) = items.next_element_seed(self)? {
            list.push(item);
        }
        Ok(Json::List(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Json, A::Error> {
        let mut fields = Vec::new();
        let mut keys = BTreeSet::new();
        while let Some(key) = entries.next_key::<String>()? {
            if !keys.insert(key.clone()) {
                return Err(A::Error::custom(format!("key \"{key}\" stands twice in one object; keep one of the two")));
            }
            fields.push((key, entries.next_value_seed(self)?));
        }
        Ok(Json::Object(fields))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_reads_back_as_the_same_tree() {
        let numbers = [0.0, -0.0, 1.0, -9.81, 1.0 / 60.0, 1e-7, 5e-324, f64::MAX, 1e300, 123_456_789.125, 0.1 + 0.2];
        let tree = Json::Object(vec![
            ("numbers".to_owned(), Json::List(numbers.map(Json::Number).to_vec())),
            ("text \"quoted\"\n\u{1}é".to_owned(), Json::Text("back\\slash\t".to_owned())),
            ("empty".to_owned(), Json::List(vec![Json::List(vec![]), Json::Object(vec![]), Json::Null])),
            ("long".to_owned(), Json::List(vec![Json::Bool(true); 60])),
        ]);
        let text = tree.to_text();
        assert_eq!(Json::parse(&text).unwrap(), tree, "{text}");
        for (number, read) in numbers.iter().zip(match Json::parse(&text).unwrap() {
            Json::Object(fields) => match &fields[0].1 {
                Json::List(items) => items.clone(),
                other => panic!("{other:?}"),
            },
            other => panic!("{other:?}"),
        }) {
            let Json::Number(read) = read else { panic!("{read:?}") };
            assert_eq!(number.to_bits(), read.to_bits(), "{number} changed its bits");
        }
    }

    #[test]
    fn short_lists_stay_on_one_line() {
        let row = Json::List(vec![Json::Number(1.0), Json::Number(0.5)]);
        let tree = Json::Object(vec![("rows".to_owned(), Json::List(vec![row; 20]))]);
        assert!(tree.to_text().contains("\n    [1, 0.5],\n"), "{}", tree.to_text());
    }

    #[test]
    fn syntax_errors_say_where_and_what() {
        for (text, place, fragment) in [
            ("{\"a\": 1,\n \"a\": 2}", "line 2", "\"a\" stands twice"),
            ("{\"a\": [1, 2", "line 1, column 11", "cut off"),
            ("", "line 1, column 0", "cut off"),
            ("[1, NaN]", "line 1", "no NaN"),
            ("[1, -Infinity]", "line 1", "no NaN"),
            ("[1e999]", "line 1", "out of range"),
            ("[1,]", "line 1", "trailing comma"),
            ("[1] 2", "line 1", "trailing characters"),
        ] {
            let message = Json::parse(text).unwrap_err().to_string();
            assert!(message.contains(place) && message.contains(fragment), "{text:?} gave: {message}");
        }
        let deep = "[".repeat(100_000);
        assert!(Json::parse(&deep).unwrap_err().to_string().contains("128 levels"));
    }
}
