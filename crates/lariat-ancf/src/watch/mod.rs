//! The worst readings of a cable over a run, as plain data. [`warning`](crate::warning) takes and
//! judges them.

mod account;
mod balance;
mod contact;
mod layers;
mod passage;
mod steps;

pub(crate) use account::{CableAccount, Last};
pub use account::{CableTerms, IslandChange};
pub use balance::{EnergyBalance, Sizes, Verdict};
pub(crate) use contact::{Contacts, Excess, Sticking};
pub(crate) use layers::{CoarseKink, CoarseMoment, Layers};
pub use passage::{Passage, Through};
pub(crate) use steps::{Estimate, Steps};

use serde::{Deserialize, Serialize};

/// The worst readings of a cable so far.
///
/// ```
/// use lariat_ancf::{At, Cable, Section, Vector3, Warning, Watch};
///
/// let mut cable = Cable::builder()
///     .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
///     .section(Section::square(0.01, 1.0e8, 4000.0)?)
///     .fix(At::Start)
///     .elements(3)
///     .build()?;
/// let mut watch = Watch::new(&cable);
/// for _ in 0..100 {
///     cable.step(0.01)?;
///     watch.note(&cable);
/// }
/// let warnings = watch.warnings(&cable, None);
/// assert!(matches!(&warnings[..], [Warning::CoarseMesh { elements: 3, enough, .. }] if *enough > 6));
/// # Ok::<(), lariat_ancf::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Watch {
    /// Whether it is not read how coarse mesh and steps are.
    #[serde(default)]
    pub(crate) leaves_coarse: bool,
    /// Positions that displacements are counted from; `None` if they are a guess of the shape.
    pub(crate) start: Option<Vec<f64>>,
    /// Estimate of the error of position in m.
    pub(crate) position: f64,
    /// Estimate of the error of the displacement in m: the less of those of the shape and of its
    /// change.
    pub(crate) motion: f64,
    /// Largest displacement in m.
    pub(crate) displacement: f64,
    /// Angle in rad between the end slopes of an element.
    pub(crate) turn: f64,
    /// Largest tension over EA, the tension in N, EA in N, and its time in s.
    pub(crate) tension: [f64; 4],
    /// Largest rate of a reel over the speed of transverse waves, and its time in s.
    pub(crate) reel: (f64, f64),
    /// Whether a reel pays out faster than them a cable that has no direction at its eye.
    #[serde(default)]
    pub(crate) undirected: bool,
    /// How often transverse waves crossed the cable since a reel has been as fast.
    #[serde(default)]
    pub(crate) crossings: f64,
    /// Largest |M| l/EI of an element.
    #[serde(default)]
    pub(crate) twist: f64,
    /// Torque in N m of the segment that is nearest to loops, and how many half waves fit in.
    #[serde(default)]
    pub(crate) kink: (f64, f64),
    /// Least tension in N of that segment then.
    #[serde(default)]
    pub(crate) kink_tension: f64,
    /// Arc length in m of the moment with the largest part about the tangent, that part in N m, and
    /// its time in s.
    #[serde(default)]
    pub(crate) along: [f64; 3],
    /// Largest force in N that the rounding of what holds it made, and its time in s.
    #[serde(default)]
    pub(crate) noise: (f64, f64),
    pub(crate) steps: Steps,
    /// The energy, of a cable that notes its own steps and of the first of an island.
    #[serde(default)]
    pub(crate) account: CableAccount,
    #[serde(default)]
    pub(crate) contacts: Contacts,
    #[serde(default)]
    pub(crate) layers: Layers,
    /// Time of the last note in s.
    pub(crate) noted: Option<f64>,
    /// Laws that were counted, and told of, by bit.
    pub(crate) counted: u64,
    pub(crate) told: u64,
}

impl Watch {
    /// Leaves the coming step out of the energy balance, because a program changes the state before
    /// it.
    pub(crate) fn interrupt(&mut self) {
        self.account.interrupt();
    }
}
