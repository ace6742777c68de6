//! Structure theory against stored invariants, in random bases, beside other summands, multiplied out.

mod families;
mod gap;
mod invariants;
mod names;
mod witnesses;
