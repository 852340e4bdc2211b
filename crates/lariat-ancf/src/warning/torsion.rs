//! What is told of the twist of a cable.
//!
//! # Equation
//!
//! A straight rod under the torque M and the tension T goes into a helix, and that into a loop,
//! where the waves that both leave it fit in:
//!
//! ```text
//! int k ds > pi        k^2 = M^2/(4 EI^2) - T/EI, where that is positive
//! ```
//!
//! With uniform M and T that is Greenhill's `M^2/(4 EI^2) - T/EI > (pi/L)^2`; of a long one `|M| >
//! 2 sqrt(T EI)`. A loop of a cable that does not touch itself is pulled through itself: its shape
//! is then none that a cable takes.
//!
//! # Validity
//!
//! The ends of a rod of Greenhill turn freely; of one that is clamped k L is 4.49 without tension,
//! and goes to pi as that grows. A slack cable that is bent loops at less than a straight one. T is
//! the tension where it is positive, for what is compressed buckles without torque.
//!
//! # References
//!
//! Greenhill, Proc. Inst. Mech. Eng. 34 (1883) 182; Coyne, IEEE J. Oceanic Eng. 15 (1990) 72 (loops
//! of cables under low tension); van der Heijden & Thompson, Nonlinear Dynamics 21 (2000) 71.

use super::Warning;
use super::advised::more;
use crate::cable::Cable;
use crate::scales::SAME;
use crate::scales::watch::{ALONG, TWIST};
use crate::watch::Watch;

impl Watch {
    /// Reads the twist of a cable, and the moments about its tangents.
    pub(super) fn note_torsion(&mut self, cable: &Cable) {
        if let Some([arc_length, part, _]) = cable.moment_along(ALONG)
            && part > self.along[1]
        {
            self.along = [arc_length, part, cable.time()];
        }
        if cable.effects().torsion.is_none() {
            return;
        }
        self.twist = self.twist.max(cable.largest_twist());
        if !touches_itself(cable) {
            let [torque, tension, share] = cable.kinks();
            if share > self.kink.1 {
                (self.kink, self.kink_tension) = ((torque, share), tension);
            }
        }
    }

    pub(super) fn twist(&self, cable: &Cable, _: Option<f64>) -> Option<Warning> {
        let (slips, elements, name) =
            (cable.diagnostics().twist_slips, cable.elements().len(), || cable.name().to_string());
        if cable.has_idle_torsion() {
            return Some(Warning::IdleTorsion { cable: name() });
        }
        if slips > 0 {
            return Some(Warning::TwistSlips { cable: name(), slips });
        }
        (self.twist > TWIST).then(|| {
            let enough = more(elements, (self.twist / (0.5 * TWIST)).powi(4));
            Warning::CoarseTwist { cable: name(), ratio: self.twist, elements, enough }
        })
    }

    pub(super) fn kinks(&self, cable: &Cable, _: Option<f64>) -> Option<Warning> {
        let ((torque_nm, share), tension_n) = (self.kink, self.kink_tension);
        let cable = || cable.name().to_string();
        (share > 1.0).then(|| Warning::KinksThroughItself { cable: cable(), torque_nm, tension_n, share })
    }

    pub(super) fn moment_along(&self, cable: &Cable, _: Option<f64>) -> Option<Warning> {
        let [at_m, part_nm, time_s] = self.along;
        let name = || cable.name().to_string();
        (part_nm > 0.0).then(|| Warning::MomentAlong { cable: name(), at_m, part_nm, time_s })
    }
}

fn touches_itself(cable: &Cable) -> bool {
    cable.effects().contact.as_ref().is_some_and(|contact| contact.itself)
}

/// Whether torsion is stiffer than bending.
pub(super) fn stiff_torsion(cable: &Cable) -> Option<Warning> {
    let ratio = cable.largest_stiffness_ratio();
    (ratio > 1.0 + SAME).then(|| Warning::StiffTorsion { cable: cable.name().to_string(), ratio })
}
