//! Structure theory against stored invariants, in random bases, beside other summands, multiplied out.

mod invariants;
mod witnesses;
