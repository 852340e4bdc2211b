//! Cables with torsion, in statics and in motion, and with all else that a cable has.

mod course;
mod methods;
mod motion;
mod others;
mod plectoneme;
mod reels;
mod statics;
mod stranded;

use lariat_ancf::{At, Cable, CableBuilder, Effects, Integrator, Method, Section, StepControl, Torsion, Vector3};

/// A straight rod of 1 m without weight, clamped at both ends.
fn rod(torsion: Torsion) -> CableBuilder {
    Cable::builder()
        .points([Vector3::zeros(), Vector3::x()])
        .section(Section::from_stiffness(1e4, 0.03, 0.1).unwrap())
        .elements(8)
        .gravity(Vector3::zeros())
        .effects(Effects { torsion: Some(torsion), ..Effects::default() })
        .integrator(Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 240.0) })
        .clamp(At::Start)
        .clamp(At::End)
}
