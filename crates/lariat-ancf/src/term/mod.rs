//! Terms: what acts in a step of the [discrete gradient](crate::integrate::discrete_gradient), by
//! what the step knows of it.
//!
//! A step knows neither contacts nor reels. It knows *terms*, each of which gives its entries to
//! the energy law and a verdict about every iterate; the general tests (safeguard.rs) are about the
//! sum of all. How to add one: docs/contributing.md.
//!
//! | file | what it holds |
//! |---|---|
//! | [`step_term`] | the trait of a term, and lists of terms |
//! | [`account`] | the accounts of the energy law, and an entry |
//! | [`balance`] | the energy law of one step: the sum of all entries |
//! | [`energy_law`] | that of all steps, by name |
//! | [`verdict`] | accept, iterate or divide, with the reason; the list of reasons, and counts by it |

pub(crate) mod account;
pub(crate) mod balance;
pub(crate) mod energy_law;
pub(crate) mod step_term;
pub(crate) mod verdict;

pub(crate) use account::Account;
pub(crate) use balance::Balance;
pub use energy_law::EnergyLaw;
pub(crate) use step_term::{Settled, Stage, StepStart, StepTerm};
pub use verdict::ReasonCounts;
pub(crate) use verdict::{Reason, Verdict};
