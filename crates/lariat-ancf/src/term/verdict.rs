//! What a term says of an iterate, and the one list of reasons.
//!
//! Every iteration after the first one of a step, and every division of a step, is counted with the
//! reason for it:
//!
//! ```text
//! newton_iterations = steps that were tried + sum of iterations_for
//! split_steps = sum of divisions_for
//! ```
//!
//! (of the discrete gradient, for each cable). A reason that is not in the list does not exist;
//! counters and files are generated from it.

use core::ops::AddAssign;
use serde::{Deserialize, Serialize};

/// What is to be done with an iterate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// It is a solution.
    Accept,
    /// Another iteration.
    Iterate(Reason),
    /// Shorter steps: no iteration makes it good.
    Divide(Reason),
}

impl Verdict {
    /// Returns the reason, if it is not accepted.
    pub fn reason(self) -> Option<Reason> {
        match self {
            Verdict::Accept => None,
            Verdict::Iterate(reason) | Verdict::Divide(reason) => Some(reason),
        }
    }
}

/// Generates all that is made by reason.
macro_rules! reasons {
    ($($(#[doc = $text:literal])* $name:ident $field:ident;)*) => {
        /// Why an iterate is not accepted.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Reason {
            $($(#[doc = $text])* $name,)*
        }

        /// Counts of iterations, or of divisions of steps, by the reason for them, under the
        /// [discrete gradient](crate::integrate::discrete_gradient).
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(default)]
        #[non_exhaustive]
        pub struct ReasonCounts {
            $($(#[doc = $text])* pub $field: u64,)*
        }

        impl ReasonCounts {
            /// Names of all reasons, in the order of the list.
            pub const KEYS: &[&str] = &[$(stringify!($field)),*];

            /// Name and count of every reason.
            pub fn by_key(&self) -> impl Iterator<Item = (&'static str, u64)> + use<> {
                [$((stringify!($field), self.$field)),*].into_iter()
            }

            /// Sum over all reasons.
            pub fn total(&self) -> u64 {
                0 $(+ self.$field)*
            }

            /// Counts since `earlier`; zero where they were reset since.
            pub fn since(&self, earlier: &Self) -> Self {
                ReasonCounts { $($field: self.$field.saturating_sub(earlier.$field),)* }
            }

            /// Counts one.
            pub(crate) fn count(&mut self, reason: Reason) {
                match reason {
                    $(Reason::$name => self.$field += 1,)*
                }
            }
        }

        impl AddAssign for ReasonCounts {
            fn add_assign(&mut self, other: Self) {
                $(self.$field += other.$field;)*
            }
        }
    };
}

reasons! {
    /// The residual makes energy beyond what the step loses.
    MakesEnergy makes_energy;
    /// Losses are too large for their sum to be known to the tolerance.
    Uncertain uncertain;
    /// The residual loses more energy than the step does by itself.
    LosesEnergy loses_energy;
    /// The residual makes energy that hides behind what damping, friction and impact take.
    HidesEnergy hides_energy;
    /// The residual leaves impulses unbalanced.
    Unbalanced unbalanced;
    /// The linear equations have no solution, or a number is not finite.
    NotSolved not_solved;
    /// The part of a step before had to be divided.
    LikeTheLast like_the_last;
    /// Contact forces are not those of the linear solve.
    ContactForces contact_forces;
    /// Bounds of friction were set anew by the normal forces of the step itself.
    FrictionBounds friction_bounds;
    /// Contacts were found late: with what the iterate entered.
    LateContacts late_contacts;
    /// Centre lines go through each other, or through thin parts of obstacles.
    PassesThrough passes_through;
    /// Contacts give back more than they took before.
    ContactsGive contacts_give;
    /// Motors, sheaves or drums have other forces than those of their laws.
    ReelLaws reel_laws;
    /// Friction stops a sheave that runs.
    SheaveStops sheave_stops;
    /// Momentum is lost where stock of a reel rides with a body that moves freely.
    StockMomentum stock_momentum;
    /// Momentum that the step takes cannot be restored without making energy.
    OwedMomentum owed_momentum;
}
