//! Malformed input: each case is an error with its location, its witness and the right exit status.

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
mod urdf;
