//! The vector instructions change the time of a run and nothing else.

use fearless_simd::Level;
use lariat_ancf::coupling::Linearisation;
use lariat_ancf::{
    At, Cable, Damping, Drag, Effects, Flow, Integrator, Method, RestPiece, RestShape, Rule, Section, StepControl,
    Vector3,
};

/// Every level of this processor; the first is the one that a cable chooses.
fn levels() -> Vec<(&'static str, Level)> {
    let best = Level::new();
    #[allow(unused_mut)]
    let mut levels = vec![("best", best), ("baseline", Level::baseline())];
    #[cfg(target_arch = "x86_64")]
    {
        levels.extend(best.as_avx512().map(|t| ("avx512", Level::Avx512(t))));
        levels.extend(best.as_avx2().map(|t| ("avx2", Level::Avx2(t))));
        levels.extend(best.as_sse4_2().map(|t| ("sse4.2", Level::Sse4_2(t))));
        levels.extend(best.as_sse2().map(|t| ("sse2", Level::Sse2(t))));
    }
    #[cfg(target_arch = "aarch64")]
    levels.extend(best.as_neon().map(|t| ("neon", Level::Neon(t))));
    levels
}

/// 21 elements: the last group of lanes is padded. It starts slack and turning out of plane, so that every component matters.
fn cable(rule: &str, clamped: bool) -> Cable {
    let points = [Vector3::zeros(), Vector3::new(1.8, 0.2, 0.7)];
    let builder = Cable::builder().points(points).section(Section::square(0.01, 1e8, 4000.0).unwrap());
    let builder = builder.length(2.0).elements(21).angular_velocity(Vector3::new(0.0, 1.0, 0.0));
    let builder = builder.rule(rule.parse::<Rule>().unwrap());
    let builder = if clamped { builder.clamp(At::Start) } else { builder.fix(At::Start) };
    builder.build().unwrap()
}

/// Positions and velocities, to the bit.
fn bits(cable: &Cable) -> Vec<u64> {
    cable.positions().iter().chain(cable.velocities()).map(|x| x.to_bits()).collect()
}

fn assert_same_run(cable: &Cable, what: &str) {
    let mut reference: Option<(Vec<u64>, u64)> = None;
    for (name, level) in levels() {
        let mut cable = cable.clone();
        cable.set_simd_level(level).unwrap();
        for _ in 0..50 {
            cable.step(0.01).unwrap();
        }
        let run = (bits(&cable), cable.diagnostics().newton_iterations);
        match &reference {
            None => reference = Some(run),
            Some(best) => assert!(*best == run, "{what}: {name} differs from the chosen level"),
        }
    }
}

#[test]
fn effects_are_bitwise_the_same_at_every_simd_level() {
    let wind = Flow::power_law(Vector3::new(1.0, 0.2, 0.3), Vector3::y(), 1.0, 0.14, 10.0);
    for rule in ["projected-3", "ST2"] {
        let mut cable = cable(rule, false);
        let effects = Effects {
            damping: Some(Damping { axial: 1e-3, bending: 1e-2 }),
            drag: Some(Drag { diameter: Some(0.02), ..Drag::new(100.0, 1.2, 0.1, wind.clone()) }),
            rest_shape: Some(RestShape { pieces: vec![RestPiece { from: 0.5, stretch: 0.999, curvature: 0.1 }] }),
            ..Effects::default()
        };
        cable.set_effects(effects).unwrap();
        assert_same_run(&cable, rule);
    }
}

#[test]
fn a_run_is_bitwise_the_same_at_every_simd_level() {
    for rule in ["projected-3", "G5-3", "ST2", "L2T2", "G5-none"] {
        assert_same_run(&cable(rule, false), rule);
    }
    assert_same_run(&cable("projected-3", true), "clamped");
    for (method, control) in [(Method::Rkn4, StepControl::Stable(0.9)), (Method::TrBdf2, StepControl::Substeps(20))] {
        let mut cable = cable("projected-3", false);
        cable.set_integrator(Integrator { method, control }).unwrap();
        assert_same_run(&cable, &method.to_string());
    }
}
