//! Structure theory against stored invariants, in random bases, beside other summands, multiplied out.

mod certificates;
mod decomposition;
mod families;
mod forms;
mod gap;
mod gong;
mod invariant_parameters;
pub mod invariants;
mod names;
mod orthogonal_forms;
mod rational_basis;
mod root_systems;
mod trials;
mod witnesses;
