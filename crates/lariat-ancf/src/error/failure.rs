//! The reasons that errors carry: why a time step or a static solution failed, what an effect
//! needs, and what is wrong with a pin.

use std::fmt;
use thiserror::Error as ThisError;

/// Why a time step failed, at the shortest step that was tried.
#[derive(Clone, Debug, PartialEq, ThisError)]
#[non_exhaustive]
pub enum StepFailure {
    /// Newton's iteration did not converge.
    #[error("Newton did not converge in {iterations} iterations, last increment {increment:.3e} m")]
    NotConverged {
        /// Iterations done.
        iterations: usize,
        /// Size of the last increment in m.
        increment: f64,
    },
    /// A force, a tangent or a position became infinite or not a number.
    #[error("{what} is not finite at node {node}")]
    NotFinite {
        /// The quantity.
        what: &'static str,
        /// The first node where it was seen.
        node: usize,
    },
    /// The estimated error stayed above the tolerance.
    #[error("estimated error {estimate:.3e} m above the allowed {allowed:.3e} m")]
    ErrorTooLarge {
        /// Estimated position error of the step in m.
        estimate: f64,
        /// Allowed error of the step in m.
        allowed: f64,
    },
    /// An explicit step beyond the stability limit of the cable.
    #[error(
        "explicit step {step:.3e} s is beyond the stability limit {limit:.3e} s: use more substeps, or an implicit method"
    )]
    Unstable {
        /// Requested step in s.
        step: f64,
        /// Longest stable step in s.
        limit: f64,
    },
    /// Fixed steps so short that a host step would take more than a million of them.
    #[error("step {step:.3e} s is shorter than a millionth of the host's step, {least:.3e} s")]
    TooShort {
        /// Requested step in s.
        step: f64,
        /// Shortest step in s.
        least: f64,
    },
    /// A step that makes energy however it is divided.
    #[error("the step makes {energy:.3e} J, of {scale:.3e} J in the system, however it is divided")]
    EnergyMade {
        /// Energy made in J.
        energy: f64,
        /// Energy of the system in J.
        scale: f64,
    },
    /// Steps of fixed length that fail again and again, however they are divided.
    #[error(
        "the method cannot take steps of {step:.3e} s here: divided, they fail again and again ({cause}): use shorter ones, a tolerance, or a method \
         that damps (tr-bdf2, generalised-alpha-0, discrete-gradient)"
    )]
    Divided {
        /// Length of the steps in s.
        step: f64,
        /// Why the last one failed.
        cause: Box<StepFailure>,
    },
    /// The [limit](crate::integrate::WorkLimit) of its work was reached.
    #[error("the limit of its work was reached")]
    WorkLimit,
    /// A method that the system cannot take.
    #[error("the system has no discrete gradients: use another method")]
    NoDiscreteGradient,
    /// A step that fails beside an obstacle that was moved by its pose alone.
    #[error(
        "{cause}; before this step obstacle {key} was put {distance:.2e} m from where its motion led, as one at rest: one that moves needs its velocity \
         (`Obstacle::moving`), with which contact meets it in time"
    )]
    PosedObstacle {
        /// Key of the obstacle.
        key: u64,
        /// By how far it was moved in m.
        distance: f64,
        /// Why the step failed.
        cause: Box<StepFailure>,
    },
    /// The matrix of the step is singular.
    #[error("singular step matrix: {0}")]
    Singular(#[from] crate::linalg::SingularMatrix),
}

/// Why no static equilibrium was found.
#[derive(Clone, Debug, PartialEq, ThisError)]
#[non_exhaustive]
pub enum EquilibriumFailure {
    /// No support can take the resultant of the loads.
    #[error(
        "no support and no attachment holds the cable in place: hold it; one that only lies on what it touches comes to rest in a run"
    )]
    NotHeld,
    /// Every shape that was found has a folded element, which no cable has.
    #[error("no shape was found without folds: element {element} is folded on itself")]
    Folded {
        /// The first folded element.
        element: usize,
    },
    /// The shape that was found runs through something that the cable can touch: through a sharp
    /// edge or something thin, which the samples of contact do not see, or something that it was in
    /// before.
    #[error(
        "the cable would run through obstacle {obstacle}, {depth:.1e} m deep at {arc_length:.4} m: statics compute contact at samples, which do not see \
         sharp edges and thin things between them: use more elements, or begin beside it"
    )]
    Touches {
        /// Key of the obstacle.
        obstacle: u64,
        /// Arc length in m.
        arc_length: f64,
        /// Depth in m.
        depth: f64,
    },
    /// It bends about a sharp edge, which the samples of contact hold along the cable, where
    /// nothing without friction could.
    #[error(
        "the cable bends about a sharp edge of obstacle {obstacle} at {arc_length:.4} m, which would hold {force:.3e} N along it without friction: statics compute \
         contact at samples, which do not slide over sharp edges: round the edge, or begin as drawn and let it come to rest"
    )]
    Snags {
        /// Key of the obstacle.
        obstacle: u64,
        /// Arc length in m.
        arc_length: f64,
        /// The force in N.
        force: f64,
    },
    /// A reel would slip in the shape that was found: its brake, clutch or free spool holds less
    /// than the cable pulls.
    #[error(
        "the cable pulls {pull:.3e} N at its reel, which holds {largest:.3e} N at most and slips: nothing rests there; give it a larger `Reel::max_force`, \
         or begin without equilibrium"
    )]
    Slips {
        /// Pull at the eye in N, positive outwards.
        pull: f64,
        /// Largest force of the reel in N.
        largest: f64,
    },
    /// A cable runs over a sheave that its parts pull unequally, until all of it is on one side.
    #[error(
        "the cable runs over a sheave: its parts pull {:.3e} N and {:.3e} N there, which holds a difference of {largest:.3e} N at most; \
         give it friction, loads that balance, or begin without equilibrium", pulls[0], pulls[1]
    )]
    Unbalanced {
        /// Pulls in N of the parts before and after the sheave.
        pulls: [f64; 2],
        /// Largest difference in N that the friction of the sheave holds.
        largest: f64,
    },
    /// The iteration did not converge.
    #[error("the iteration did not converge")]
    NotConverged,
    /// A force or a matrix of the iteration, or a step of the dynamic relaxation, failed.
    #[error(transparent)]
    Step(#[from] StepFailure),
}

impl EquilibriumFailure {
    /// Returns whether it tells of a shape that was found, or that there is none: no other search
    /// helps.
    pub(crate) fn is_final(&self) -> bool {
        use EquilibriumFailure::{NotHeld, Slips, Snags, Touches, Unbalanced};
        matches!(self, NotHeld | Touches { .. } | Snags { .. } | Slips { .. } | Unbalanced { .. })
    }
}

/// What an effect needs of a cable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Requirement {
    /// A bending rule other than [`BendingRule::None`](crate::BendingRule::None).
    BendingRule,
    /// A diameter, of the section or of the drag.
    Diameter,
    /// A displaced area, of the section or of the buoyancy.
    DisplacedArea,
    /// Drag.
    Drag,
    /// An axial rule that has the whole strain that is linear in the element: projected, exact,
    /// mean, or five Gauss points and more.
    WholeAxialRule,
    /// A rest stretch of 1: a law has its own strain without force.
    RestStretch,
    /// A radius, of the contact or by the diameter of the section.
    Radius,
}

impl fmt::Display for Requirement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Requirement::BendingRule => "a bending rule, and the cable has none",
            Requirement::Diameter => "a diameter: of the section, or of the drag",
            Requirement::DisplacedArea => "a displaced area: of the section, or of the buoyancy",
            Requirement::WholeAxialRule => "the axial rule `projected`, `exact`, `mean`, or five Gauss points and more",
            Requirement::RestStretch => "a rest stretch of 1: let the curve begin at another strain",
            Requirement::Radius => "a radius: of the contact, or by the diameter of the section",
            Requirement::Drag => "drag, and the cable has none",
        })
    }
}

/// What is wrong with a pin of an [`island`](crate::island).
#[derive(Clone, Copy, Debug, PartialEq, Eq, ThisError)]
#[non_exhaustive]
pub enum PinProblem {
    /// The node has a pin and is not [attached](crate::coupling::Coupling::attach).
    #[error("is pinned but not attached")]
    NotAttached,
    /// One of node and pin holds the tangent and the other does not.
    #[error("and its pin do not agree on whether the tangent is clamped")]
    ClampMismatch,
    /// The node has two pins.
    #[error("has two pins")]
    Duplicate,
    /// The node is [attached](crate::coupling::Coupling::attach) and has no pin.
    #[error("is attached but has no pin")]
    Missing,
}
