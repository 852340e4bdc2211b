//! Editing a cable between steps: cutting it, placing a node, changing its rule.

mod cut;
mod redefine;
mod refine;
