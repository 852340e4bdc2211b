//! The tests of added mass of lariat-rapier with rapier3d-f64: the same file.

extern crate lariat_rapier_f64 as lariat_rapier;

#[path = "../../lariat-rapier/tests/added_mass.rs"]
mod added_mass;
