//! Hard cases remain numerically stable: the cases are those of `lariat stability`, in
//! `crates/lariat-bench/src/stability/cases`.
//!
//! `cargo test` runs every family quickly; with the environment variable `LARIAT_LONG_TESTS=1` it
//! also runs the slowest cases and more random scenes.

mod check;
mod families;
mod faults;
mod misses;
mod random;
