//! The accumulator: sums of all components with the same leading indices. The last two indices
//! determine the place of a component.

use super::arithmetic::{Arithmetic, Value};
use super::found::Found;
use super::shape::{Place, Shape};

/// A dense array of sums, one for each place, with bit sets of the filled places.
pub(super) struct Accumulator<'a, A: Sync, Sum> {
    arithmetic: &'a A,
    shape: Shape<'a>,
    /// The sums of all places. The sum of a place that is not filled is empty.
    sums: Vec<Sum>,
    /// A bit for each row. It is set if a place in the row is filled.
    rows: Vec<u64>,
    /// A bit for each place. It is set if the place is filled.
    filled: Vec<u64>,
    /// For a place that is the image of another place: the index of the other component among those
    /// with the same leading indices.
    images: Vec<u32>,
}

impl<'a, A: Sync, Sum: Clone + Default> Accumulator<'a, A, Sum> {
    pub fn new(arithmetic: &'a A, shape: Shape<'a>) -> Self {
        let places = shape.rows() * shape.columns();
        Accumulator {
            arithmetic,
            shape,
            sums: vec![Sum::default(); places],
            rows: vec![0; shape.rows().div_ceil(64)],
            filled: vec![0; places / 64],
            images: vec![0; if shape.mirrors() { places } else { 0 }],
        }
    }

    #[inline(always)]
    pub fn add_product<S: Value>(
        &mut self,
        place: Place,
        a: &A::Value,
        b: &A::Value,
        negative: bool,
    ) where
        A: Arithmetic<S, Sum = Sum>,
    {
        self.fill(place);
        self.arithmetic.add_product(&mut self.sums[place as usize], a, b, negative);
    }

    #[inline(always)]
    fn fill(&mut self, place: Place) {
        let row = place as usize / self.shape.columns();
        self.rows[row / 64] |= 1 << (row % 64);
        self.filled[place as usize / 64] |= 1 << (place % 64);
    }

    /// Moves the components to the end of the results, in the order of their indices. The parameter
    /// `key` is the key of the leading indices.
    pub fn collect<S: Value>(&mut self, key: u64, found: &mut Found<S>)
    where
        A: Arithmetic<S, Sum = Sum>,
    {
        let shape = self.shape;
        let (columns, mirrors) = (shape.columns(), shape.mirrors());
        let key = if shape.rank > 1 { key * shape.n * shape.n } else { key };
        let start = found.len();
        for word in 0..self.rows.len() {
            // reads the word again in every pass, because an image may fill a later row
            while let Some(bit) = take_bit(&mut self.rows[word]) {
                let row = 64 * word + bit;
                let key = key + row as u64 * shape.n;
                for word in row * columns / 64..(row + 1) * columns / 64 {
                    let mut filled = std::mem::take(&mut self.filled[word]);
                    while let Some(bit) = take_bit(&mut filled) {
                        let place = 64 * word + bit;
                        let column = place % columns;
                        let key = key + column as u64;
                        if mirrors && row > column {
                            let image = start + self.images[place] as usize;
                            found.push(key, -found.value(image).clone());
                            continue;
                        }
                        // takes the sum out of its place, because a sum of products owns its values
                        let sum = std::mem::take(&mut self.sums[place]);
                        let Some(value) = self.arithmetic.finish(&sum) else { continue };
                        if mirrors {
                            let image = shape.image(place as Place);
                            self.images[image as usize] = (found.len() - start) as u32;
                            self.fill(image);
                        }
                        found.push(key, value);
                    }
                }
            }
        }
    }
}

/// Clears the lowest set bit of a word. Returns its position; `None` if no bit is set.
#[inline(always)]
fn take_bit(word: &mut u64) -> Option<usize> {
    let bit = word.trailing_zeros();
    *word &= word.wrapping_sub(1);
    (bit < 64).then_some(bit as usize)
}
