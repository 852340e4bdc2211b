//! What a body is made from: Rapier's builder, or after a load the body that it would have built.

use lariat_rapier::rapier::dynamics::{RigidBody, RigidBodyBuilder};
use lariat_rapier::rapier::math::Vector;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The description of a rigid body. It is saved as the body that it makes, since Rapier saves
/// bodies and no builders of them.
#[derive(Clone, Debug)]
pub(crate) enum Rigid {
    /// By Rapier's builder.
    Described(RigidBodyBuilder),
    /// By a body that was never in a world.
    Built(Box<RigidBody>),
}

impl Rigid {
    /// Returns the body.
    pub fn build(&self) -> RigidBody {
        match self {
            Rigid::Described(builder) => builder.build(),
            Rigid::Built(body) => (**body).clone(),
        }
    }

    /// Sets the position in m.
    pub fn at(self, position: Vector) -> Self {
        match self {
            Rigid::Described(builder) => Rigid::Described(builder.translation(position)),
            Rigid::Built(mut body) => {
                body.set_translation(position, false);
                Rigid::Built(body)
            }
        }
    }

    /// Sets the initial velocity in m/s.
    pub fn velocity(self, velocity: Vector) -> Self {
        match self {
            Rigid::Described(builder) => Rigid::Described(builder.linvel(velocity)),
            Rigid::Built(mut body) => {
                body.set_linvel(velocity, false);
                Rigid::Built(body)
            }
        }
    }
}

impl Serialize for Rigid {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.build().serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Rigid {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        RigidBody::deserialize(deserializer).map(|body| Rigid::Built(Box::new(body)))
    }
}
