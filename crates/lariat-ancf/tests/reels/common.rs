//! What the tests share.

use lariat_ancf::{At, Cable, Integrator, Method, Section, StepControl, Vector3};

pub const G: f64 = 9.81;

/// Returns a rope that hangs from its last node, the eye, in the plane or not: EA 1e4 N, EI 0.02 N m^2, 0.4 kg/m.
pub fn rope(length: f64, elements: usize, integrator: Integrator) -> Cable {
    let mut cable = Cable::builder()
        .points([Vector3::new(0.0, -length, 0.0), Vector3::zeros()])
        .section(Section::from_stiffness(1.0e4, 0.02, 0.4).unwrap())
        .elements(elements)
        .integrator(integrator)
        .fix(At::End)
        .build()
        .unwrap();
    cable.equilibrium().unwrap();
    cable
}

/// Implicit integrators, fine enough to resolve the motion.
pub fn implicit() -> Vec<Integrator> {
    let fine = |method| Integrator { method, control: StepControl::MaxStep(1.0 / 960.0) };
    vec![
        Integrator::tolerance(Method::Esdirk4, 1e-7).unwrap(),
        Integrator::tolerance(Method::TrBdf2, 1e-6).unwrap(),
        fine(Method::DiscreteGradient),
    ]
}

/// Returns the energy of a cable less the work of its reel and what remeshing added, in J.
pub fn account(cable: &mut Cable) -> f64 {
    let reel = cable.reel(At::End).unwrap();
    cable.energy().total() - reel.work - reel.remeshed
}
