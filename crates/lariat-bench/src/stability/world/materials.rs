//! Sections, integrators and effects that cases share.

use lariat_ancf::{
    Buoyancy, Cable, CableBuilder, Damping, Drag, Effects, Fidelity, Flow, GravityScale, Integrator, LineLoad,
    RestShape, Section, StepControl, Torsion, Vector3,
};

/// E = 1e9 Pa, 4000 kg/m^3, square of 1 cm: EA = 1e5 N, 0.4 kg/m.
pub fn polymer_rope() -> Section {
    Section::square(0.01, 1e9, 4000.0).expect("a section")
}

/// Steel wire, round, 3 mm: EA = 1.41e6 N, 0.055 kg/m.
pub fn steel_wire() -> Section {
    Section::round(0.003, 2e11, 7850.0).expect("a section")
}

/// Generalised-alpha of spectral radius 0 with steps of 1/480 s: damps the vibrations that the step
/// does not resolve.
pub fn l_stable_integrator() -> Integrator {
    Integrator { method: "generalised-alpha-0".parse().expect("a method"), control: StepControl::MaxStep(1.0 / 480.0) }
}

/// Begins a cable along a straight line.
pub fn straight(a: [f64; 3], b: [f64; 3], section: Section) -> CableBuilder {
    Cable::builder().points([Vector3::from(a), Vector3::from(b)]).section(section).fidelity(Fidelity::Engineering)
}

/// All effects, mild: damping, drag in a cross wind of 1.1 m/s, buoyancy in air, a rest curvature
/// of 0.05 /m, a line load of 5 % of the weight, gravity times 0.9. Of [`torsion`] see there.
pub fn all_effects(weight_per_length: f64) -> Effects {
    let mut drag = Drag::new(1.2, 1.2, 0.02, Flow::uniform(Vector3::new(0.5, 0.0, 1.0)));
    drag.diameter = Some(0.01);
    let mut buoyancy = Buoyancy::new(1.2, 1.0);
    buoyancy.area = Some(1e-4);
    Effects {
        damping: Some(Damping { axial: 1e-4, bending: 1e-3 }),
        drag: Some(drag),
        buoyancy: Some(buoyancy),
        rest_shape: Some(RestShape::curved(0.05)),
        line_loads: Some(LineLoad::uniform(Vector3::new(0.0, 0.0, 0.05 * weight_per_length)).into()),
        gravity_scale: Some(GravityScale(0.9)),
        axial_law: None,
        contact: None,
        torsion: None,
    }
}

/// Torsion of a solid round section of a bending stiffness (N m^2) and a Poisson number of 0.3, twisted by a quarter
/// of a turn: for cables that two clamps hold.
pub fn torsion(bending_stiffness: f64) -> Option<Torsion> {
    let torsion = Torsion::round(bending_stiffness, 0.3).ok().filter(|torsion| torsion.stiffness > 0.0)?;
    Some(Torsion { initial_twist: 0.25, damping: 0.01, ..torsion })
}
