//! Slack ropes that are thrown about at the steps of games, and struck: what makes no energy.

use super::bench::{Scene, cube};
use lariat_ancf::island::{Impedance, RigidBody};
use lariat_ancf::{At, Cable, Fidelity, Section, Vector3};

/// A load falls and swings on a slack, stiff rope: fidelity game in host steps of 1/120 s. At no time is there more energy than at the
/// start, but for 2 % of the largest kinetic and strain energy.
///
/// *Source.* Conservation of energy. The steps are far too long for these ropes: they may lose, not make.
#[test]
fn slack_stiff_ropes_make_no_energy_at_the_steps_of_games() {
    for (stiffness, slack, mass) in
        [(1e5, 1.1, 5.0), (1e6, 1.25, 5.0), (1e6, 1.17, 0.1), (4e6, 1.13, 10.0), (8e6, 1.12, 0.05)]
    {
        let section = Section::from_stiffness(stiffness, 0.03, 0.06).unwrap();
        let end = Vector3::new(0.8, 0.0, 0.0);
        let rope = Cable::builder().points([Vector3::zeros(), end]).length(0.8 * slack).elements(3).section(section);
        let rope = rope.fix(At::Start).fidelity(Fidelity::Game).build().unwrap();
        let integrator = rope.integrator();
        let mut body = RigidBody::new(mass, cube(mass, 0.1), end).unwrap();
        body.force = Vector3::new(0.0, -9.81 * mass, 0.0);
        body.velocity = Vector3::new(-2.0, 1.0, 3.0);
        let mut scene = Scene::new(vec![rope], vec![body], integrator).pin(0, At::End, 0, Vector3::zeros());
        let start = scene.energy();
        let (mut made, mut largest) = (0.0f64, 0.0f64);
        for _ in 0..60 {
            scene.run(1.0 / 120.0, 1);
            let own = scene.cables[0].energy();
            largest = largest.max(own.kinetic + own.axial + own.bending + scene.bodies[0].kinetic_energy());
            made = made.max(scene.energy() - start);
        }
        assert!(made < 0.02 * largest, "EA {stiffness} N, {mass} kg: {made:.2e} of {largest:.2e} J");
    }
}

/// A stiff rope struck across its end, hard enough to throw it an element's length aside within a step: all of the impulse is
/// momentum of the rope, and its strain energy is not more than the impulse can have done.
///
/// *Source.* Conservation of momentum; of a linear answer, dU <= U + p.C p.
#[test]
fn a_struck_rope_has_the_momentum_and_not_more_energy_than_the_impulse_gave() {
    let section = Section::from_stiffness(3e6, 0.0, 0.5).unwrap();
    let mut rope = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0)])
        .elements(5)
        .section(section)
        .gravity(Vector3::zeros())
        .build()
        .unwrap();
    let (node, impulse) = (rope.attach(At::End).unwrap(), Vector3::new(0.3, 2.0, 0.0));
    let mut impedance = Impedance::default();
    impedance.update(&mut rope, &[node], 1.0 / 120.0).unwrap();
    let given = impulse.dot(&(impedance.compliance() * impulse));
    impedance.apply_impulses(&mut rope, &[impulse]);
    let energy = rope.energy();
    assert!((rope.momentum().linear + impulse).norm() < 1e-9, "{:?}", rope.momentum().linear);
    assert!(energy.axial <= given, "{} J of {given} J", energy.axial);
    assert!(energy.kinetic > 0.1 * given && energy.kinetic <= given, "{} J of {given} J", energy.kinetic);
}

/// A stiff rope pressed together by a fifth, then struck: linearised, it answers with any velocity, so it is taken for softer, and still all
/// of the impulse is momentum of the rope.
///
/// *Source.* Conservation of momentum.
#[test]
fn a_struck_rope_under_compression_has_the_momentum() {
    let section = Section::from_stiffness(3e6, 0.0, 0.5).unwrap();
    let mut rope = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0)])
        .elements(5)
        .section(section)
        .gravity(Vector3::zeros())
        .build()
        .unwrap();
    let pressed: Vec<f64> = rope.positions().iter().map(|x| 0.8 * x).collect();
    let still = vec![0.0; pressed.len()];
    rope.set_coordinates(&pressed, &still).unwrap();
    let (node, impulse) = (rope.attach(At::End).unwrap(), Vector3::new(-0.1, 0.2, 0.0));
    let mut impedance = Impedance::default();
    impedance.update(&mut rope, &[node], 1.0 / 120.0).unwrap();
    impedance.apply_impulses(&mut rope, &[impulse]);
    assert!((rope.momentum().linear + impulse).norm() < 1e-9, "{:?}", rope.momentum().linear);
}
