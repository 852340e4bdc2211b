//! What the attachments of a run warn about.

use super::Physics;
use crate::scene::Scene;
use crate::warning::Warning;
use lariat_rapier::OpenGap;

impl Physics {
    /// Returns a warning for each attachment whose two sides are apart.
    pub fn open_gaps(&self, scene: &Scene) -> Vec<Warning> {
        let attachments = self.attachments.iter().zip(&scene.attachments);
        let open = attachments.filter_map(|(handle, attachment)| {
            let OpenGap { gap, time, closed, .. } = self.cables.open_gap((*handle)?).ok()??;
            let cable = scene.cables[attachment.cable].name.clone();
            Some(Warning::OpenGap { attachment: attachment.name.clone(), cable, time_s: time, gap_m: gap, closed })
        });
        open.collect()
    }

    /// Returns a warning for each attachment to a body on joints that did not move as predicted.
    pub fn unsettled(&self, scene: &Scene) -> Vec<Warning> {
        let attachments = self.attachments.iter().zip(&scene.attachments);
        let unsettled = attachments.filter_map(|(handle, attachment)| {
            let how = self.cables.unsettled((*handle)?).ok()??;
            let (time_s, steps, force, gap_m, foreseen) = (how.time, how.steps, how.force, how.gap, how.foreseen);
            let cable = scene.cables[attachment.cable].name.clone();
            Some(Warning::Unsettled {
                attachment: attachment.name.clone(),
                cable,
                time_s,
                steps,
                force,
                gap_m,
                foreseen,
            })
        });
        unsettled.collect()
    }
}
