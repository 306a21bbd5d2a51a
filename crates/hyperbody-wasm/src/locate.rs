//! Where in a JSON text the value stands that a path such as `bodies[3].shape.box` names.

/// Line and column, from 1, of the value with this path; of the deepest value on the way that is there. `None` for a path or
/// a text that cannot be followed at all.
pub(crate) fn locate(text: &str, path: &str) -> Option<(usize, usize)> {
    if let Some(rest) = path.strip_prefix("line ") {
        let (line, column) = rest.split_once(", column ")?;
        return Some((line.parse().ok()?, column.parse().ok()?));
    }
    let mut scanner = Scanner { bytes: text.as_bytes(), at: 0 };
    scanner.space();
    let mut found = scanner.at;
    for step in steps(path) {
        let inside = match step {
            Step::Key(key) => scanner.enter_key(key),
            Step::Index(index) => scanner.enter_item(index),
        };
        if inside.is_none() {
            break;
        }
        found = scanner.at;
    }
    let before = text.get(..found)?;
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().map_or(0, |last| last.chars().count()) + 1;
    Some((line, column))
}

enum Step<'a> {
    Key(&'a str),
    Index(usize),
}

fn steps(path: &str) -> Vec<Step<'_>> {
    let mut steps = Vec::new();
    for part in path.split('.') {
        let (key, indices) = part.split_at(part.find('[').unwrap_or(part.len()));
        if !key.is_empty() {
            steps.push(Step::Key(key));
        }
        let numbers = indices.split(['[', ']']).filter_map(|number| number.parse().ok());
        steps.extend(numbers.map(Step::Index));
    }
    steps
}

struct Scanner<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Scanner<'_> {
    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    fn space(&mut self) {
        while self.peek().is_some_and(|byte| byte.is_ascii_whitespace()) {
            self.at += 1;
        }
    }

    fn take(&mut self, byte: u8) -> Option<()> {
        self.space();
        (self.peek()? == byte).then(|| self.at += 1)
    }

    /// Goes over a string and returns what stands between its quotes.
    fn string(&mut self) -> Option<&[u8]> {
        self.take(b'"')?;
        let start = self.at;
        while self.peek()? != b'"' {
            self.at += if self.peek()? == b'\\' { 2 } else { 1 };
        }
        self.at += 1;
        self.bytes.get(start..self.at - 1)
    }

    /// Goes over a value of any sort.
    fn value(&mut self) -> Option<()> {
        self.space();
        let mut depth = 0_usize;
        loop {
            match self.peek()? {
                b'"' => {
                    self.string()?;
                }
                b'{' | b'[' => {
                    depth += 1;
                    self.at += 1;
                }
                b'}' | b']' => {
                    depth = depth.checked_sub(1)?;
                    self.at += 1;
                }
                b',' if depth == 0 => return Some(()),
                _ => self.at += 1,
            }
            if depth == 0 {
                self.space();
                if matches!(self.peek(), None | Some(b',' | b'}' | b']')) {
                    return Some(());
                }
            }
        }
    }

    fn enter_key(&mut self, key: &str) -> Option<()> {
        self.take(b'{')?;
        loop {
            let is_wanted = self.string()? == key.as_bytes();
            self.take(b':')?;
            self.space();
            if is_wanted {
                return Some(());
            }
            self.value()?;
            self.take(b',')?;
            self.space();
        }
    }

    fn enter_item(&mut self, index: usize) -> Option<()> {
        self.take(b'[')?;
        for _ in 0..index {
            self.value()?;
            self.take(b',')?;
        }
        self.space();
        Some(())
    }
}
