//! Malformed input: each is refused with its place, its witness and the right status.

mod case;
mod charts;
mod definitions;
mod encodings;
mod expressions;
mod forces;
mod huge;
mod names;
mod options;
mod outputs;
mod problems;
mod stored;
