//! The tests of lariat-rapier with rapier3d-f64: the same files.

extern crate lariat_rapier_f64 as lariat_rapier;

#[path = "../../lariat-rapier/tests/coupling/main.rs"]
mod coupling;
