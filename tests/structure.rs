//! Structure theory against stored invariants, in random bases, beside other summands, multiplied out.

mod families;
mod invariants;
mod names;
mod witnesses;
