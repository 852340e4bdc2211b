//! Cable mechanics after the absolute nodal coordinate formulation (ANCF): elements, integrators,
//! statics.
//!
//! The crate knows no physics engine, no ECS and no files. All numbers are `f64` in SI units.
//!
//! ```
//! use lariat_ancf::{At, Cable, Section, Vector3};
//!
//! // the falling pendulum of Bulin & Hajzman: 2 m, 1 cm square, released from horizontal
//! let mut cable = Cable::builder()
//!     .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
//!     .section(Section::square(0.01, 1.0e8, 4000.0)?)
//!     .elements(10)
//!     .fix(At::Start)
//!     .build()?;
//! for _ in 0..30 {
//!     cable.step(1.0 / 60.0)?;
//! }
//! let tip = cable.sample(2.0)?.position;
//! assert!((tip - Vector3::new(1.3108, -1.2034, 0.0)).norm() < 3e-3, "{tip}");
//! # Ok::<(), lariat_ancf::Error>(())
//! ```
//!
//! What a user of ropes calls is listed at the root. The modules hold the parts:
//!
//! | module | what it holds |
//! |---|---|
//! | [`cable`] | description, state, builder, sampling, energies, edits |
//! | [`contact`] | what a cable can touch: obstacles, their shapes and motions |
//! | [`effect`] | one file per effect: damping, drag, buoyancy, rest shape ..., and forces per length and potentials of your own |
//! | [`integrate`] | one file per time integrator, over one trait, which other crates can implement |
//! | `statics` | static equilibrium: [`Cable::equilibrium`] |
//! | [`warning`] | what a cable says about its own mesh, steps, law and sizes |
//! | [`study`] | runs to a given error: mesh and tolerance chosen, and the error proven |
//! | [`coupling`] | what couplings to engines need of a cable, and its matrices |
//! | [`smooth`] | curves through rows of time and value, of paths and motors |
//! | [`island`] | cables and rigid bodies pinned together, as one system, for couplings to physics engines |
//!
//! Public for tests and benchmarks of the numerics, and for the matrices that [`Cable`] returns; no
//! rope needs them, and they may change in any release: [`element`] (one element as a function of
//! six Gram numbers), [`axial`] and [`bending`] (one file per rule of the elastic forces),
//! [`linalg`] (the block-tridiagonal solver).

mod at;

pub mod cable;
pub mod contact;
pub mod coupling;
mod diagnostics;
mod dual;
mod edit;
pub mod effect;
pub mod element;
mod error;
pub mod integrate;
pub mod island;
pub mod linalg;
mod load;
mod material;
mod model;
mod obstacle;
mod one_leg;
mod point;
mod quadrature;
mod real;
mod reel;
mod rows;
mod rule;
mod scales;
pub mod seal;
mod section;
mod simd;
pub mod smooth;
mod state;
mod statics;
mod step;
mod strength;
pub mod study;
mod support;
mod system;
mod term;
pub mod warning;
mod watch;
pub mod water;

pub use at::At;
pub use cable::TorsionReading;
pub use cable::builder::CableBuilder;
pub use cable::energy::{Energy, Momentum};
pub use cable::mesh::{MeshIndicator, MotionIndicator};
pub use cable::reactions::Reaction;
pub use cable::sample::Sample;
pub use cable::{Cable, ReelReading, SharpBend, Snapshot};
pub use diagnostics::Diagnostics;
pub use effect::{
    AxialLaw, Buoyancy, CablePoint, Contact, Damping, Drag, EffectCounts, EffectWork, Effects, EndSpin, Flow,
    ForceDensity, ForceDerivatives, GravityScale, LineLoad, LineLoads, Potential, RestPiece, RestShape, RopeKind,
    Torsion, Water,
};
pub use element::{axial, bending};
pub use error::{EquilibriumFailure, Error, PinProblem, Requirement, StepFailure};
pub use integrate::{ErrorNorm, Fidelity, Integrator, Method, StepControl};
pub use load::PointLoad;
pub use material::RopeMaterial;
pub use model::STANDARD_GRAVITY;
/// The vector type of the public interface (nalgebra's).
pub use nalgebra::Vector3;
pub use point::Point;
pub use real::Real;
pub use reel::{Feed, Reel};
pub use rule::{AxialRule, BendingRule, Rule};
pub use section::{Element, Make, Section, Shape};
pub use statics::{EquilibriumOptions, EquilibriumReport};
pub use step::{FleetError, step_all};
pub use strength::{Break, BreakCause, Load, Strength};
pub use support::{Motion, SlopeSupport, Support};
pub use system::jacobian::Jacobians;
pub use term::ReasonCounts;
pub use warning::{Level, Warning, Watch};
pub use water::{Sea, SeaPoint, Surface, Wave};
