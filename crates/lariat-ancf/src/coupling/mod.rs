//! Traits of a [`Cable`](crate::Cable) for those who couple it to an engine, or need its matrices.
//! No user of ropes needs them: lariat-rapier does what they are for.
//!
//! ```
//! use lariat_ancf::coupling::Coupling;
//! use lariat_ancf::{At, Cable, Section, Vector3};
//!
//! let points = [Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)];
//! let mut cable = Cable::builder().points(points).section(Section::round(0.01, 1e8, 4000.0)?).build()?;
//! let node = cable.attach(At::End)?;
//! assert_eq!(node + 1, cable.nodes());
//! # Ok::<(), lariat_ancf::Error>(())
//! ```

mod engine;
mod linearisation;

pub use crate::state::SegmentTwist;
#[cfg(feature = "parallel")]
pub use crate::step::{cost_of_step, jobs_of_task};
pub use engine::Coupling;
pub use linearisation::{Linearisation, TwistBorder};
