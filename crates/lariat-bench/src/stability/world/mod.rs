//! Worlds with cables of one model, on which cases are run and measured.
//!
//! | module | what it holds |
//! |---|---|
//! | [`test_world`] | a world with its cables, and how bodies and ropes are added |
//! | [`case`] | a case: how it is built, what happens, what must hold |
//! | [`monitor`] | the extremes and the energy balance that a run is checked by |
//! | [`measure`] | reads a world into its monitor after each step |
//! | [`run`] | runs a case on a host |
//! | [`materials`] | sections, integrators and effects that cases share |

pub mod case;
pub mod materials;
pub mod measure;
pub mod monitor;
pub mod run;
pub mod test_world;

use super::{convert, engine, peers};
