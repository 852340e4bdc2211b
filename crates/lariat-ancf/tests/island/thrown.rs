//! Slack ropes in fast motion at the steps of games, and under impulses: no spurious energy.

use super::bench::{Scene, cube};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::{Impedance, RigidBody};
use lariat_ancf::{At, Cable, Fidelity, Section, Vector3};

/// A load falls and swings on a slack, stiff rope, fidelity game in host steps of 1/120 s. The
/// energy never exceeds that of the start by more than 2 % of the largest kinetic and strain
/// energy.
///
/// *Source.* Conservation of energy. The steps are far too long for these ropes: energy may be
/// lost, not created.
#[test]
fn slack_stiff_ropes_create_no_energy_at_the_steps_of_games() {
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
        let (mut created, mut largest) = (0.0f64, 0.0f64);
        for _ in 0..60 {
            scene.run(1.0 / 120.0, 1);
            let own = scene.cables[0].energy();
            largest = largest.max(own.kinetic + own.axial + own.bending + scene.bodies[0].kinetic_energy());
            created = created.max(scene.energy() - start);
        }
        assert!(created < 0.02 * largest, "EA {stiffness} N, {mass} kg: {created:.2e} of {largest:.2e} J");
    }
}

/// After an impulse across the end of a stiff rope, large enough to displace it by an element's
/// length within a step, the momentum of the rope is the impulse, and its strain energy is at most
/// the work of the impulse.
///
/// *Source.* Conservation of momentum; of a linear response, dU <= U + p.C p.
#[test]
fn an_impulse_gives_a_rope_its_momentum_and_no_more_than_its_work() {
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
    let given = impulse.dot(&(impedance.compliance(0, 0) * impulse));
    impedance.apply_impulses(&mut rope, &[impulse]);
    let energy = rope.energy();
    assert!((rope.momentum().linear + impulse).norm() < 1e-9, "{:?}", rope.momentum().linear);
    assert!(energy.axial <= given, "{} J of {given} J", energy.axial);
    assert!(energy.kinetic > 0.1 * given && energy.kinetic <= given, "{} J of {given} J", energy.kinetic);
}

/// After an impulse on a stiff rope that is compressed by a fifth, whose linearised response is
/// unbounded and is computed with a reduced stiffness, the momentum of the rope is the impulse.
///
/// *Source.* Conservation of momentum.
#[test]
fn an_impulse_gives_a_compressed_rope_its_momentum() {
    let section = Section::from_stiffness(3e6, 0.0, 0.5).unwrap();
    let mut rope = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0)])
        .elements(5)
        .section(section)
        .gravity(Vector3::zeros())
        .build()
        .unwrap();
    let compressed: Vec<f64> = rope.positions().iter().map(|x| 0.8 * x).collect();
    let still = vec![0.0; compressed.len()];
    rope.set_coordinates(&compressed, &still).unwrap();
    let (node, impulse) = (rope.attach(At::End).unwrap(), Vector3::new(-0.1, 0.2, 0.0));
    let mut impedance = Impedance::default();
    impedance.update(&mut rope, &[node], 1.0 / 120.0).unwrap();
    impedance.apply_impulses(&mut rope, &[impulse]);
    assert!((rope.momentum().linear + impulse).norm() < 1e-9, "{:?}", rope.momentum().linear);
}

/// After an impulse at one end of a rope that is attached at both, in any direction, the other end is where it was if it is held; where both
/// are free, it moves.
///
/// *Source.* A held node does not move.
#[test]
fn an_impulse_leaves_a_held_end_where_it_is() {
    let section = Section::from_stiffness(3e6, 0.5, 0.5).unwrap();
    for (impulse, h) in [(Vector3::new(0.3, 2.0, 0.0), 1.0 / 120.0), (Vector3::new(-5.0, 0.0, 1.0), 1.0 / 60.0)] {
        for held in [true, false] {
            let mut rope = Cable::builder()
                .points([Vector3::zeros(), Vector3::new(4.0, 0.0, 0.0)])
                .elements(5)
                .section(section)
                .gravity(Vector3::zeros())
                .build()
                .unwrap();
            let (starts, end) = ([rope.attach(At::Start).unwrap()], rope.attach(At::End).unwrap());
            let mut impedance = Impedance::default();
            impedance.update_beside(&mut rope, &[end], if held { &starts } else { &[] }, h).unwrap();
            impedance.apply_impulses(&mut rope, &[impulse]);
            let moved = (rope.positions()[..3].iter().chain(&rope.velocities()[..3])).any(|x| *x != 0.0);
            assert_eq!(moved, !held, "{impulse:?}");
            assert!(rope.velocities().iter().any(|v| v.abs() > 1e-3));
        }
    }
}
