//! Editing a cable between steps: cutting it, breaking it, placing a node, changing its rule.

mod breaking;
mod cut;
mod redefine;
mod refine;
