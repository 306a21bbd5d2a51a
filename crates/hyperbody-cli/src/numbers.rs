//! Numbers on the command line: each within its range, and a message that gives the range in words.

use std::ops::RangeInclusive;

/// Places and lengths that pictures show, m: beyond, not even millimetres are told apart for long.
pub(crate) const LARGEST_PLACE: f64 = 1e6;

/// Turns, degrees: a hundred whole ones.
pub(crate) const LARGEST_TURN: f64 = 36_000.0;

/// Seconds: thirty years.
pub(crate) const LARGEST_TIME: f64 = 1e9;

/// A parser of whole numbers of a range.
pub(crate) fn whole<T>(range: RangeInclusive<i64>) -> impl Fn(&str) -> Result<T, String> + Clone
where
    T: TryFrom<i64>,
{
    move |text: &str| {
        let value = text.trim().parse::<i64>().ok().filter(|value| range.contains(value));
        value.and_then(|value| T::try_from(value).ok()).ok_or_else(|| {
            format!("{} is not a whole number from {} to {}", shortened(text), range.start(), range.end())
        })
    }
}

/// A number of a range, in a unit.
pub(crate) fn within(text: &str, range: RangeInclusive<f64>, unit: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if range.contains(&value) => Ok(value),
        Ok(_) => Err(format!("{} is not a number from {} to {}{unit}", shortened(text), range.start(), range.end())),
        Err(_) => Err(format!("\"{}\" is not a number", shortened(text))),
    }
}

/// A coordinate or a length, m.
pub(crate) fn place(text: &str) -> Result<f64, String> {
    within(text, -LARGEST_PLACE..=LARGEST_PLACE, " m")
}

/// An angle by which something is turned, degrees.
pub(crate) fn turn(text: &str) -> Result<f64, String> {
    within(text, -LARGEST_TURN..=LARGEST_TURN, "°")
}

/// Seconds: 0 or more.
pub(crate) fn seconds(text: &str) -> Result<f64, String> {
    within(text, 0.0..=LARGEST_TIME, " s")
}

/// Most letters of a text that a message repeats.
const MOST_LETTERS: usize = 60;

/// A text for a message, cut if it is long.
pub(crate) fn shortened(text: &str) -> String {
    match text.char_indices().nth(MOST_LETTERS) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_beyond_their_range_are_told_the_range() {
        let rate = whole::<u16>(1..=60);
        assert_eq!((rate("1"), rate(" 60 ")), (Ok(1), Ok(60)));
        for text in ["33.3", "0", "-5", "61", "1e3", "many", "99999999999999999999999"] {
            assert_eq!(rate(text), Err(format!("{text} is not a whole number from 1 to 60")));
        }
        assert_eq!(place("-1e6"), Ok(-1e6));
        assert_eq!(place("1e300"), Err("1e300 is not a number from -1000000 to 1000000 m".to_owned()));
        assert_eq!(turn("nan"), Err("nan is not a number from -36000 to 36000°".to_owned()));
        assert_eq!(seconds("-1"), Err("-1 is not a number from 0 to 1000000000 s".to_owned()));
        assert_eq!(seconds("soon"), Err("\"soon\" is not a number".to_owned()));
        assert!(place(&"9".repeat(5000)).unwrap_err().len() < 150, "long numbers are cut");
    }
}
