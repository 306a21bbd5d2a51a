//! Walking a JSON tree while knowing where one is, so that every complaint names its place.

use crate::error::{SceneError, nearest};
use crate::json::Json;

type Result<T> = std::result::Result<T, SceneError>;

/// A value and its path from the root, such as `bodies[3].shape`.
pub(crate) struct At<'a> {
    pub(crate) json: &'a Json,
    pub(crate) path: String,
}

/// The fields of an object whose keys are all known.
pub(crate) struct Fields<'a> {
    fields: &'a [(String, Json)],
    path: String,
}

impl<'a> At<'a> {
    pub(crate) fn root(json: &'a Json) -> Self {
        Self { json, path: String::new() }
    }

    fn expected(&self, what: &str) -> SceneError {
        SceneError::structure(self.path.clone(), format!("is {}, expected {what}", self.json.kind()))
    }

    pub(crate) fn number(&self) -> Result<f64> {
        match self.json {
            Json::Number(value) => Ok(*value),
            _ => Err(self.expected("a number")),
        }
    }

    /// A whole number that fits `u32`.
    pub(crate) fn count(&self) -> Result<u32> {
        let value = self.number()?;
        if value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value) {
            Ok(value as u32)
        } else {
            Err(SceneError::value(self.path.clone(), format!("is {value}, expected a whole number, 0 or more")))
        }
    }

    pub(crate) fn boolean(&self) -> Result<bool> {
        match self.json {
            Json::Bool(value) => Ok(*value),
            _ => Err(self.expected("true or false")),
        }
    }

    pub(crate) fn text(&self) -> Result<String> {
        match self.json {
            Json::Text(text) => Ok(text.clone()),
            _ => Err(self.expected("a string in quotes")),
        }
    }

    pub(crate) fn numbers(&self) -> Result<Vec<f64>> {
        self.list("a list of numbers")?.iter().map(At::number).collect()
    }

    /// One number per dimension; an empty list, which in a [`Scene`](crate::Scene) means "not given", is refused.
    pub(crate) fn coordinates(&self) -> Result<Vec<f64>> {
        let numbers = self.numbers()?;
        if numbers.is_empty() {
            return Err(SceneError::value(self.path.clone(), "is an empty list, expected one number per dimension"));
        }
        Ok(numbers)
    }

    pub(crate) fn rows(&self) -> Result<Vec<Vec<f64>>> {
        self.list("a list of lists of numbers")?.iter().map(At::numbers).collect()
    }

    pub(crate) fn list(&self, what: &str) -> Result<Vec<At<'a>>> {
        let Json::List(items) = self.json else {
            return Err(self.expected(what));
        };
        let place = |(index, json)| At { json, path: format!("{}[{index}]", self.path) };
        Ok(items.iter().enumerate().map(place).collect())
    }

    /// The fields of an object of free names, in the order of the document.
    pub(crate) fn entries(&self, what: &str) -> Result<Vec<(String, At<'a>)>> {
        let Json::Object(fields) = self.json else {
            return Err(self.expected(what));
        };
        Ok(fields.iter().map(|(key, json)| (key.clone(), At { json, path: join(&self.path, key) })).collect())
    }

    /// The fields of an object whose keys are all among `known`.
    pub(crate) fn fields(&self, what: &str, known: &[&str]) -> Result<Fields<'a>> {
        let Json::Object(fields) = self.json else {
            return Err(self.expected(what));
        };
        for (key, _) in fields {
            if !known.contains(&key.as_str()) {
                return Err(unknown_key(&self.path, key, known));
            }
        }
        Ok(Fields { fields, path: self.path.clone() })
    }

    /// The one key of an object that says of which sort it is, and what stands under it.
    pub(crate) fn variant(&self, what: &str, known: &[&str]) -> Result<(&'a str, At<'a>)> {
        let Json::Object(fields) = self.json else {
            return Err(self.expected(&format!("an object with one key: {what}")));
        };
        let [(key, json)] = fields.as_slice() else {
            let message = format!("has {} keys, expected exactly one of: {}", fields.len(), known.join(", "));
            return Err(SceneError::structure(self.path.clone(), message));
        };
        Ok((key, At { json, path: join(&self.path, key) }))
    }
}

impl<'a> Fields<'a> {
    pub(crate) fn path(&self) -> &str {
        &self.path
    }

    pub(crate) fn optional(&self, key: &str) -> Option<At<'a>> {
        let (_, json) = self.fields.iter().find(|(name, _)| name == key)?;
        Some(At { json, path: join(&self.path, key) })
    }

    pub(crate) fn required(&self, key: &str) -> Result<At<'a>> {
        self.optional(key)
            .ok_or_else(|| SceneError::structure(self.path.clone(), format!("has no \"{key}\", which it needs")))
    }

    /// The value of `key` read by `read`, or `default` where the key is absent.
    pub(crate) fn or<T>(&self, key: &str, default: T, read: impl FnOnce(&At<'a>) -> Result<T>) -> Result<T> {
        self.optional(key).map_or(Ok(default), |at| read(&at))
    }
}

/// A key that stands for nothing here; its place is its own, so that whoever shows the text can show the line.
pub(crate) fn unknown_key(path: &str, key: &str, known: &[&str]) -> SceneError {
    let near = nearest(key, known.iter().copied()).unwrap_or("nothing");
    let message = format!("unknown key \"{key}\"; the nearest known one is \"{near}\" (known: {})", known.join(", "));
    SceneError::structure(join(path, key), message)
}

/// The path of a key of the object at `path`.
pub(crate) fn join(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }
}
