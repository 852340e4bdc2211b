//! The force strategy of the fidelity `game`.

use lariat_ancf::{At, Cable, CableBuilder, Fidelity, Rule, Section, Vector3};

fn rod(stiffness: f64) -> CableBuilder {
    Cable::builder()
        .points([Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0)])
        .section(Section::from_stiffness(1e6, stiffness, 0.3).unwrap())
        .clamp(At::Start)
}

/// A rod of which only the fidelity `game` is said has the rule `projected-T1`, and sags as an Euler-Bernoulli beam does; a rule that is written stays, and
/// an integrator or another fidelity brings the default rule.
///
/// *Source.* The droop of a cantilever under its weight, w L^4/(8 EI), to second order in the slope: the deflection is a hundredth of the length.
#[test]
fn a_rod_in_game_bends_as_a_beam_by_the_linear_rule() {
    for stiffness in [40.0, 90.0, 400.0] {
        let mut rod = rod(stiffness).fidelity(Fidelity::Game).build().unwrap();
        assert_eq!(rod.rule().to_string(), "projected-T1");
        rod.equilibrium().unwrap();
        let droop = -rod.sample(1.0).unwrap().position.y;
        let beam = 0.3 * 9.80665 / (8.0 * stiffness);
        println!("EI {stiffness}: {droop:.6} m, beam {beam:.6} m");
        assert!((droop / beam - 1.0).abs() < 2e-3, "{stiffness}: {droop} for {beam}");
    }
    let written = rod(1.0).rule(Rule::default()).fidelity(Fidelity::Game).build().unwrap();
    assert_eq!(written.rule(), Rule::default());
    let chosen = rod(1.0).integrator(written.integrator()).build().unwrap();
    assert_eq!(chosen.rule(), Rule::default());
    assert_eq!(rod(1.0).fidelity(Fidelity::Reference).build().unwrap().rule(), Rule::default());
    assert_eq!(rod(1.0).build().unwrap().rule(), Rule::default());
}

/// Cables that are thrown fold and kink; by the rule of `game` they take no more iterations and divide no more steps than by the default rule, and end as near to the motion of a fine
/// mesh in short steps.
///
/// *Source.* The reference is the default rule with four times the elements and a sixteenth of the step.
#[test]
fn thrown_cables_cost_no_more_by_the_rule_of_game_and_end_as_near() {
    let ends = |cable: &Cable| cable.sample(0.5 * cable.length()).unwrap().position;
    let (mut iterations, mut splits, mut errors) = ([0; 2], [0; 2], [Vec::new(), Vec::new()]);
    for i in 0..40 {
        let x = f64::from(i);
        let thrown = || {
            let kink = Vector3::new(0.5, 0.4 * (1.9 * x).sin(), 0.3 * (0.7 * x).cos());
            Cable::builder()
                .points([Vector3::zeros(), kink, Vector3::new(1.2, 0.1, 0.2 * (2.3 * x).sin())])
                .section(Section::from_stiffness(1e3 * 10f64.powf(x % 4.0), 10f64.powf(-4.0 + x % 3.0), 0.1).unwrap())
                .velocity(Vector3::new((3.1 * x).sin(), (1.7 * x).cos(), (0.3 * x).sin()) * 4.0)
                .angular_velocity(Vector3::new((1.1 * x).cos(), (2.9 * x).sin(), 1.0) * 8.0)
                .fix(At::Start)
        };
        let run = |builder: CableBuilder| {
            let mut cable = builder.build().unwrap();
            (0..18).for_each(|_| cable.step(1.0 / 60.0).unwrap());
            cable
        };
        let game = Fidelity::Game.integrator(f64::INFINITY);
        let fine = lariat_ancf::StepControl::MaxStep(1.0 / 3840.0);
        let fine = thrown().elements(40).integrator(lariat_ancf::Integrator { control: fine, ..game });
        let reference = ends(&run(fine));
        for (k, builder) in [thrown().rule(Rule::default()), thrown()].into_iter().enumerate() {
            let cable = run(builder.elements(10).fidelity(Fidelity::Game));
            iterations[k] += cable.diagnostics().newton_iterations;
            splits[k] += cable.diagnostics().split_steps;
            errors[k].push((ends(&cable) - reference).norm());
        }
    }
    let medians = errors.map(|mut errors| {
        errors.sort_by(f64::total_cmp);
        errors[errors.len() / 2]
    });
    println!("{iterations:?} iterations, {splits:?} divided steps, median errors {medians:?} m");
    assert!(iterations[1] <= iterations[0] && splits[1] <= splits[0], "{iterations:?}, {splits:?}");
    assert!(medians[1] < 1.25 * medians[0], "{medians:?}");
}
