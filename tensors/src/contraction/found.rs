//! The list of the components of a result.

/// The components of a result: a list of keys in ascending order, and a list of values.
pub(super) struct Found<S> {
    keys: Vec<u64>,
    values: Vec<S>,
}

impl<S> Default for Found<S> {
    fn default() -> Self {
        Found { keys: vec![], values: vec![] }
    }
}

impl<S> Found<S> {
    pub fn len(&self) -> usize {
        self.keys.len()
    }

    pub fn value(&self, at: usize) -> &S {
        &self.values[at]
    }

    #[inline(always)]
    pub fn push(&mut self, key: u64, value: S) {
        self.keys.push(key);
        self.values.push(value);
    }

    /// Appends other components. Their keys must be larger.
    pub fn append(&mut self, next: &mut Self) {
        self.keys.append(&mut next.keys);
        self.values.append(&mut next.values);
    }

    /// Reserves memory for the whole result. It does so if the lists may be too short for the
    /// components in the fraction `next` of the index combinations. The need is estimated from the
    /// components in the fraction `done`. Unused reserved memory costs nothing, but growing lists
    /// are copied several times.
    pub fn expect_more(&mut self, done: f64, next: f64) {
        let (length, room) = (self.len() as f64, self.keys.capacity() - self.len());
        if done > 0.0 && (room as f64) < 1.5 * length * (next - done) / done {
            let more = (length * (1.25 / done - 1.0).max(0.25)) as usize;
            let more = more.min(self.len().max(MOST));
            // ignores failures, because the lists then grow as needed
            let _ = self.keys.try_reserve_exact(more);
            let _ = self.values.try_reserve_exact(more);
        }
    }

    /// Returns the keys and the values.
    pub fn into_lists(self) -> (Vec<u64>, Vec<S>) {
        let Found { mut keys, mut values } = self;
        keys.shrink_to_fit();
        values.shrink_to_fit();
        (keys, values)
    }
}

/// The largest number of components for which memory is first reserved, even if more are expected.
const MOST: usize = 1 << 24;

#[cfg(test)]
mod tests {
    use super::*;

    /// Reservations do not change the components. After the first piece, lists of results that grow
    /// at a constant rate move at most once.
    #[test]
    fn expectations_change_no_components() {
        for (pieces, length) in [(1, 5), (7, 0), (7, 3), (248, 40), (100, 700)] {
            let (mut found, mut moves) = (Found::default(), 0);
            for piece in 0..pieces {
                let before = found.keys.as_ptr();
                for at in 0..length {
                    found.push(piece * length + at, at as f64);
                }
                let [done, next] = [1, 2].map(|more| (piece + more) as f64 / pieces as f64);
                found.expect_more(done, next.min(1.0));
                moves += usize::from(piece > 0 && before != found.keys.as_ptr());
            }
            assert!(moves <= 1, "{moves} moves of {pieces} pieces");
            let (keys, values) = found.into_lists();
            assert!(keys.into_iter().eq(0..pieces * length));
            assert!(
                values
                    .iter()
                    .enumerate()
                    .all(|(at, value)| *value == (at % length.max(1) as usize) as f64)
            );
        }
    }
}
