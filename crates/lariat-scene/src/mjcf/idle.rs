//! Actuators and tendons: those that do nothing while their control is zero are left out with a warning, others refused.

use super::tree::Element;
use super::{Importer, Note};
use crate::error::Error;

impl Importer {
    /// Judges the actuators: MuJoCo starts with all controls at zero.
    pub(super) fn actuator(&mut self, element: &Element) -> Result<(), Error> {
        let idle = match element.name.as_str() {
            "motor" | "adhesion" | "damper" => true,
            "cylinder" => element.list("bias")?.is_none_or(|bias| bias.iter().all(|x| *x == 0.0)),
            "general" => element.attribute("biastype").is_none_or(|bias| bias == "none"),
            _ => false,
        };
        let passive = ["armature", "damping"].into_iter().find(|key| {
            element.attribute(key).is_some_and(|value| value.split_whitespace().any(|word| word.parse() != Ok(0.0)))
        });
        if let Some(key) = passive {
            return Err(element.wrong(format!("{key}: acts on its joint without a control, too")));
        }
        if !idle {
            return Err(
                element.wrong("acts with its control at zero, too: give the scene a load, a motion or a reel instead")
            );
        }
        self.notes.push(Note::at(element, "is left out: its control is zero until a program sets it"));
        Ok(())
    }

    pub(super) fn tendon(&mut self, element: &Element) {
        self.notes.push(Note::at(element, "is left out: it has no stiffness, damping, friction or limit"));
    }
}
