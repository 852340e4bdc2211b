//! Time integrators, one file each, over one trait.
//!
//! A method implements [`OneStep`]: one step of any length on any [`Dynamics`]. [`step_control`]
//! chooses the steps: it lands exactly on the host's time, estimates the error where the method
//! can, rejects failed steps and retries shorter ones, and stops with the last good state in place
//! if the shortest step fails.
//!
//! | file | contents | order |
//! |---|---|---|
//! | [`midpoint`] | implicit midpoint rule | 2 |
//! | [`trapezoid`] | trapezoidal rule | 2 |
//! | [`generalised_alpha`] | generalised-alpha(rho) | 2 |
//! | [`tr_bdf2`] | TR-BDF2 | 2 |
//! | [`esdirk3`], [`esdirk4`] | L-stable singly diagonally implicit Runge-Kutta | 3, 4 |
//! | [`dirk`] | the step of a diagonally implicit Runge-Kutta method, given by its tableau | |
//! | [`discrete_gradient`] | guarded discrete gradient: the energy law holds at any step | 2 |
//! | [`verlet`], [`rkn`] | symplectic explicit methods | 2, 4, 6 |
//! | [`explicit`] | the step of a symplectic explicit method, given by its weights | |
//! | [`Method`], [`Integrator`], [`Fidelity`] | by name, with a step control, as presets | |
//! | [`step_control`] | the choice of steps | |
//! | [`energy_check`] | the check of every implicit step for spurious energy | |
//! | [`error_budget`] | the error that the steps of a host step may make | |
//! | [`ErrorNorm`] | which errors a tolerance bounds | |
//!
//! # Adding a method
//!
//! Implement [`OneStep`] in a crate of your own; its page has an example of an explicit method. An
//! implicit method calls [`Dynamics::solve_stage`] once per stage, as `tests/own_integrator.rs`
//! does. A diagonally implicit Runge-Kutta method needs no code: write its
//! [`Tableau`](dirk::Tableau), which implements the trait. Step with
//! [`Cable::step_with`](crate::Cable::step_with).
//!
//! A method of this crate is a file here and a variant of [`Method`]: the compiler then asks for
//! its implementation, name and properties in `method.rs`, and [`Method::ALL`] puts it into every
//! test of integrators.

pub mod dirk;
pub mod discrete_gradient;
mod dynamics;
pub mod energy_check;
pub mod error_budget;
mod error_norm;
pub mod esdirk3;
pub mod esdirk4;
pub mod explicit;
mod fidelity;
pub mod generalised_alpha;
mod integrator;
mod method;
pub mod midpoint;
pub(crate) mod newton;
mod one_step;
pub mod rkn;
pub mod step_control;
pub mod tr_bdf2;
pub mod trapezoid;
pub mod verlet;
mod work_limit;

pub use crate::state::{Differences, Memory, State};
pub use crate::term::EnergyLaw;
pub use dynamics::{Dynamics, Stage};
pub use error_norm::ErrorNorm;
pub use fidelity::Fidelity;
pub use integrator::{Integrator, IntegratorRef, StepControl};
pub use method::{Method, Properties};
pub(crate) use one_step::add_scaled;
pub use one_step::{OneStep, Scratch, StepRequest};

pub use work_limit::WorkLimit;
