//! Hard cases: scenes at which cable simulations become unstable, run on many hosts and checked
//! against physics.
//!
//! | module | what it holds |
//! |---|---|
//! | `world` | worlds with cables of Lariat or ropes of Rapier, on which cases are run and measured |
//! | `cases` | the cases, a file per family |
//! | [`family`] | the families of cases |
//! | [`host`] | how a case is run: host step, solver iterations, precision, effects |
//! | [`job`] | the runs of a family, and their execution |
//! | [`outcome`] | how a run ended |
//! | [`misses`] | runs that are known to miss a bound, which the tests compare with |
//! | [`recipe`] | parameters of random scenes |
//! | [`page`] | the results as a page and as CSV |
//!
//! `world` and `cases` are compiled twice, over rapier3d and rapier3d-f64 (`single` and `double` of
//! this crate). The tests and `lariat stability` run the same cases.

pub mod family;
pub mod host;
pub mod job;
pub mod misses;
pub mod outcome;
pub mod page;
pub mod recipe;
