//! Structure theory against stored invariants, in random bases, beside other summands, multiplied out.

mod certificates;
mod decomposition;
mod families;
mod forms;
mod gap;
mod gong;
pub mod invariants;
mod names;
mod orthogonal_forms;
mod root_systems;
mod trials;
mod witnesses;
