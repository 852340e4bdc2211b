//! What a cable can touch: obstacles, their shapes, and how they move. It knows no cable and no law
//! of [contact](crate::contact).

mod description;
mod patch;
mod rigid_motion;
mod shapes;
mod surface;
mod trace;

pub(crate) use description::Obstacles;
pub use description::{LARGEST_RESTITUTION, Obstacle};
pub use patch::Patch;
pub(crate) use rigid_motion::Pose;
pub use rigid_motion::{Mount, RigidMotion};
pub use shapes::{Ball, Capsule, Cuboid, Cylinder, HalfSpace};
pub use surface::{Feature, FeatureShape, Nearest, Surface};
pub(crate) use trace::trace;
