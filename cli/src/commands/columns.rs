//! The columns of input rows, as named by a header.

use affinor_documents::input::InputError;

/// The numbers that an input row must contain, a name for them, and the names of their columns.
pub struct Expected {
    pub numbers: usize,
    pub what: String,
    /// Lists of column names, in the order of the numbers. A header may use any of these lists;
    /// messages show the first one.
    names: Vec<Vec<String>>,
    /// The numbers of rows and columns of a vector or a matrix whose entries may be named by one
    /// letter and numbers: `x1`, `x2`, or `g11`, `g12`. Otherwise `None`.
    shape: Option<(usize, usize)>,
    /// The position of each number in rows without a header, if the numbers are not in order.
    pub unnamed: Option<Vec<usize>>,
}

impl Expected {
    /// A vector. A header may name its columns by one letter and numbers from 1.
    pub fn vector(numbers: usize, what: impl Into<String>) -> Self {
        let names = vec![(1..=numbers).map(|at| format!("x{at}")).collect()];
        Expected { numbers, what: what.into(), names, shape: Some((1, numbers)), unnamed: None }
    }

    /// A matrix in row-major order. A header may name its columns by one letter and the numbers of
    /// row and column.
    pub fn matrix((rows, columns): (usize, usize), what: impl Into<String>) -> Self {
        let between = if rows.max(columns) < 10 { "" } else { "_" };
        let name = |at: usize| format!("g{}{between}{}", at / columns + 1, at % columns + 1);
        let names = vec![(0..rows * columns).map(name).collect()];
        let shape = Some((rows, columns));
        Expected { numbers: rows * columns, what: what.into(), names, shape, unnamed: None }
    }

    /// Expects numbers whose columns have exactly these names.
    pub fn named(names: &[&str], what: impl Into<String>) -> Self {
        let expected = Expected {
            numbers: names.len(),
            what: what.into(),
            names: vec![],
            shape: None,
            unnamed: None,
        };
        expected.or(names)
    }

    /// Adds another list of names, which a header may use instead.
    #[must_use]
    pub fn or<S: AsRef<str>>(mut self, names: &[S]) -> Self {
        let names: Vec<String> = names.iter().map(|name| name.as_ref().to_string()).collect();
        if names.len() == self.numbers {
            self.names.push(names);
        }
        self
    }

    /// Sets the position of each number in rows without a header.
    #[must_use]
    pub fn without_head<const N: usize>(mut self, order: [usize; N]) -> Self {
        self.unnamed = Some(order.to_vec());
        self
    }

    /// The position of each number in the rows, determined by the names in a header.
    ///
    /// # Errors
    /// An error if the header has other names.
    pub fn order(&self, place: &str, head: &[&str]) -> Result<Vec<usize>, InputError> {
        let lower = |name: &str| name.trim().trim_matches('"').trim().to_lowercase();
        let head: Vec<String> = head.iter().map(|name| lower(name)).collect();
        let position = |name: &String| head.iter().position(|other| *other == lower(name));
        let chosen = self.names.iter().find_map(|names| names.iter().map(position).collect());
        let order = chosen.or_else(|| self.numbered(&head));
        order.filter(|_| head.len() == self.numbers).ok_or_else(|| {
            const SHOWN: usize = 12;
            let list = |names: &[String]| {
                let more = if names.len() > SHOWN { ", ..." } else { "" };
                names[..names.len().min(SHOWN)].join(", ") + more
            };
            let choices: Vec<String> = self.names.iter().map(|names| list(names)).collect();
            let named = list(&head).escape_debug().to_string();
            let message = format!("{place}: the columns {named} are not {}", self.what);
            let help = format!(
                "name the columns {}, in any order, or omit the header",
                choices.join("; or ")
            );
            InputError::usage(message).help(help)
        })
    }

    /// The position of each number, if the names in the header are one letter with numbers.
    fn numbered(&self, head: &[String]) -> Option<Vec<usize>> {
        let (rows, columns) = self.shape?;
        let numbers = |c: char| c.is_ascii_digit() || c == '_';
        let stem = head.first()?.trim_end_matches(numbers);
        let mut order = vec![None; self.numbers];
        for (position, name) in head.iter().enumerate() {
            let behind = name.strip_prefix(stem)?.trim_start_matches([' ', '_']);
            let (row, column): (usize, usize) = match behind.split_once('_') {
                _ if rows == 1 => (1, behind.parse().ok()?),
                Some((row, column)) => (row.parse().ok()?, column.parse().ok()?),
                None if behind.len() == 2 && behind.is_ascii() => {
                    (behind[..1].parse().ok()?, behind[1..].parse().ok()?)
                }
                None => return None,
            };
            if !((1..=rows).contains(&row) && (1..=columns).contains(&column)) {
                return None;
            }
            order[(row - 1) * columns + column - 1] = Some(position);
        }
        order.into_iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Expected;

    /// A header with permuted columns is accepted. The test permutes by taking every `step`-th
    /// column, where `step` is coprime to the number of columns.
    #[test]
    fn permuted_heads_are_put_in_order() {
        let quaternion =
            Expected::named(&["w", "x", "y", "z"], "a quaternion").or(&["qw", "qx", "qy", "qz"]);
        let matrix = Expected::matrix((3, 3), "a matrix");
        let large = Expected::matrix((2, 11), "a matrix");
        let vector = Expected::vector(12, "a vector");
        for expected in [quaternion, matrix, large, vector] {
            for names in &expected.names {
                let n = names.len();
                for step in
                    (1..n).filter(|step| (1..=n).all(|k| k == 1 || step % k != 0 || n % k != 0))
                {
                    let head: Vec<String> =
                        (0..n).map(|at| names[(at * step + 1) % n].to_uppercase()).collect();
                    let borrowed: Vec<&str> = head.iter().map(String::as_str).collect();
                    let order = expected.order("head", &borrowed).unwrap_or_default();
                    let read: Vec<String> =
                        order.iter().map(|at| head[*at].to_lowercase()).collect();
                    assert_eq!(&read, names, "{head:?}");
                }
            }
        }
    }

    #[test]
    fn other_names_are_refused() {
        let quaternion = Expected::named(&["w", "x", "y", "z"], "a quaternion");
        for head in [
            &["q0", "q1", "q2", "q3"][..],
            &["w", "x", "y"],
            &["w", "x", "y", "y"],
            &["t", "w", "x", "y", "z"],
        ] {
            assert!(quaternion.order("head", head).is_err(), "{head:?}");
        }
        for head in [["x1", "x2", "x2"], ["x0", "x1", "x2"], ["x1", "y2", "x3"]] {
            assert!(Expected::vector(3, "a vector").order("head", &head).is_err(), "{head:?}");
        }
    }
}
