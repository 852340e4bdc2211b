//! Steel: the stiffest thing that a scene will ask for, at the host's frame rate.

mod common;

use lariat_ancf::{At, Cable, Integrator, Method, Section, StepControl, Vector3};

/// 2 m of steel wire, E = 2.1e11 Pa, 7850 kg/m^3, round 10 mm, pinned and released from horizontal.
fn wire(integrator: Integrator) -> Cable {
    Cable::builder()
        .name("steel")
        .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(Section::round(0.01, 2.1e11, 7850.0).unwrap())
        .elements(20)
        .fix(At::Start)
        .integrator(integrator)
        .build()
        .unwrap()
}

/// Five seconds at host steps of 1/60 and 1/240 s: finite, no energy created, and no spurious tension at the pin.
///
/// *Source.* Energy conservation: it starts with zero, and 12.1 J of potential energy swing (0.6165 kg/m, 2 m, 1 m
/// down). Tension: a rigid rod pulls 2.5 times its weight, 30.2 N, at the bottom; 60 N allows the waves of bending.
/// Explicit methods would need 2e6 steps; generalised-alpha with rho >= 0.5 survives with kilonewtons.
fn five_seconds(method: Method, control: StepControl) {
    for rate in [60, 240] {
        let mut cable = wire(Integrator { method, control });
        let swing = 0.01f64.powi(2) * std::f64::consts::FRAC_PI_4 * 7850.0 * 2.0 * 9.81;
        let (mut highest, mut lowest, mut tension) = (f64::MIN, f64::MAX, 0.0f64);
        for _ in 0..5 * rate {
            cable.step(1.0 / f64::from(rate)).unwrap_or_else(|e| panic!("{method} at 1/{rate}: {e}"));
            assert!(cable.positions().iter().chain(cable.velocities()).all(|x| x.is_finite()));
            let energy = cable.energy().total();
            (highest, lowest) = (highest.max(energy), lowest.min(energy));
            tension = tension.max(cable.reactions().unwrap()[0].force.norm());
        }
        let d = cable.diagnostics();
        println!(
            "{method} {control:?} at 1/{rate}: energy {:+.1e} to {:+.1e} of the swing, \
             largest pin force {tension:.2} N, {} steps, {} rejected",
            highest / swing,
            lowest / swing,
            d.steps,
            d.rejected_steps
        );
        assert!(highest < 1e-3 * swing, "{method} at 1/{rate}: energy rises by {highest} J of {swing} J");
        assert!(tension < 60.0, "{method} at 1/{rate}: {tension} N at the pin");
    }
}

/// The default integrator; see [`five_seconds`].
///
/// *Source.* As there.
#[test]
fn default_integrator_swings_steel_for_five_seconds() {
    let Integrator { method, control } = Integrator::default();
    five_seconds(method, control);
}

/// Error-controlled TR-BDF2 at a game's tolerance; see [`five_seconds`].
///
/// *Source.* As there.
#[test]
fn tr_bdf2_swings_steel_for_five_seconds() {
    five_seconds(Method::TrBdf2, StepControl::Tolerance(1e-4));
}

/// Generalised-alpha with full damping of the unresolved, one fixed step per 1/240 s; see [`five_seconds`].
///
/// *Source.* As there.
#[test]
fn generalised_alpha_0_swings_steel_for_five_seconds() {
    let method = Method::GeneralisedAlpha { rho: 0.0 };
    five_seconds(method, StepControl::MaxStep(1.0 / 240.0));
}
