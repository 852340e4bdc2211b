//! What strains do to the length of an element at an eye, with every effect that acts on strains.

use super::some;
use crate::effect::EffectWork;
use crate::effect::acts::ForceInput;
use crate::element::side::Side;
use crate::element::variable_length::Extent;
use crate::one_leg::OneLeg;
use crate::system::CableStep;
use crate::{At, AxialLaw, Cable, Effects, Integrator, Method, Reel, RestPiece, RestShape, Section, StepControl};
use nalgebra::Vector3;

/// Effects that change the energy of strains.
fn effects() -> Vec<Effects> {
    let rows = vec![[-0.02, 0.0], [0.03, 100.0], [0.2, 900.0], [0.5, 2e3]];
    let both = RestPiece { from: 0.0, stretch: 1.02, curvature: 15.0 };
    let law = |law| Effects { axial_law: Some(law), ..Effects::default() };
    vec![
        Effects::default(),
        Effects { rest_shape: Some(RestShape::stretched(0.97)), ..Effects::default() },
        Effects { rest_shape: Some(RestShape::curved(2.0)), ..Effects::default() },
        Effects { rest_shape: Some(RestShape::curved(0.05)), ..Effects::default() },
        Effects { rest_shape: Some(RestShape { pieces: vec![both] }), ..Effects::default() },
        law(AxialLaw::Hooke),
        law(AxialLaw::Rope),
        law(AxialLaw::Curve(rows)),
    ]
}

/// A cable without inertia that is worth the name, with a reel at each end.
fn cable(effects: Effects) -> Cable {
    let integrator = Integrator { method: Method::DiscreteGradient, control: StepControl::Substeps(1) };
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(Section::from_stiffness(1e4, 0.02, 1e-40).unwrap())
        .elements(4)
        .gravity(Vector3::zeros())
        .effects(effects)
        .integrator(integrator)
        .build()
        .unwrap();
    for at in [At::Start, At::End] {
        cable.add_reel(at, Reel::default()).unwrap();
    }
    cable
}

/// Any coordinates of five nodes near the straight cable, kinked and stretched.
fn any(seed: usize) -> Vec<f64> {
    let along = |i: usize| [0.5 * (i / 6) as f64, 0.0, 0.0, 1.0, 0.0, 0.0][i % 6];
    (0..30).map(|i| along(i) + 0.15 * some(31 * seed + i)).collect()
}

/// Over a step of the discrete gradient, whatever it is, the strain energy of a cable whose lengths
/// change at both ends changes by the work on nodes and lengths.
///
/// *Source.* `D U = f . D q + Y D l`: conservation of energy.
#[test]
fn work_on_nodes_and_lengths_is_the_change_of_strain_energy() {
    for (kind, effects) in effects().into_iter().enumerate() {
        let mut cable = cable(effects);
        for seed in 0..20 {
            let (start, end, h) = (any(seed), any(seed + 100), 0.01);
            for feed in &mut cable.system.feeds.list {
                let k = feed.side as usize;
                let [l0, l1] = [seed, seed + 9].map(|s| 0.5 + 0.2 * some(s + k));
                feed.extent = Extent { length: l0, rate: (l1 - l0) / h, acceleration: 0.0 };
            }
            cable.snapshot.state.q.clone_from(&start);
            cable.with_workspace(|cable| {
                let energy = |cable: &mut Cable, time: f64, q: &[f64]| {
                    let Cable { model, system, .. } = cable;
                    system.set_feeds(model, time);
                    let (axial, bending) = system.forces.strain_energy(q);
                    axial + bending
                };
                let time = cable.time();
                let [before, after] = [(time, &start), (time + h, &end)].map(|(t, q)| energy(cable, t, q));
                let CableStep { mut equations, state, buffers: b } = cable.step_parts();
                b.recall(state, h, OneLeg::new(0.0));
                for i in 0..30 {
                    (b.change[i], b.velocity_change[i]) = (end[i] - start[i], 0.0);
                }
                equations.step_residual(state, b, false, &mut EffectWork::default());
                let mut work: f64 = -(0..30).map(|i| b.rhs[i] / h * b.change[i]).sum::<f64>();
                let mut moved = work.abs();
                for feed in equations.system.feeds.list.clone() {
                    let (_, [l0, l1]) = feed.over(state.time, h);
                    let own = (l1 - l0) * equations.on_length_of_step(&feed, state, b).force;
                    (work, moved) = (work + own, moved + own.abs());
                }
                let missing = (after - before - work).abs();
                assert!(missing < 1e-11 * (moved + before + after), "{kind} {seed}: {missing:e} J of {moved} J");
            });
        }
    }
}

/// The force of strains on a length is the derivative of their energy by it, at coordinates that
/// stay.
///
/// *Source.* Central differences.
#[test]
fn force_of_strains_on_a_length_is_the_derivative_of_their_energy() {
    for (kind, effects) in effects().into_iter().enumerate() {
        let mut cable = cable(effects);
        let at = |seed: usize| (any(seed), vec![0.0; 30]);
        for (seed, side) in (0..20).flat_map(|seed| Side::BOTH.map(|side| (seed, side))) {
            let (all, v) = at(seed);
            let [q, v] = [&all, &v].map(|x| side.gather(x));
            let (l, d) = (0.5 + 0.2 * some(seed), 1e-5);
            let set = |cable: &mut Cable, length: f64| {
                let extent = Extent { length, ..Extent::default() };
                cable.system.feeds.list[side as usize].extent = extent;
                cable.system.set_feeds(&cable.model, 0.0);
                extent
            };
            let extent = set(&mut cable, l);
            let feed = cable.system.feeds.list[side as usize];
            let [own, damping] = cable.system.strain_length_force(&cable.model, &feed, &extent, [&q, &v]);
            let mut energy = |l: f64| {
                set(&mut cable, l);
                let (axial, bending) = cable.system.forces.strain_energy(&all);
                axial + bending
            };
            let expected = (energy(l + d) - energy(l - d)) / (2.0 * d);
            assert!(
                (own - expected).abs() < 1e-6 * (energy(l) / l + expected.abs()),
                "{kind} {seed}: {own} {expected}"
            );
            assert!(damping.abs() < 1e-9 * (1.0 + own.abs()), "{damping}");
        }
    }
}

/// The tension that goes with a pull is that of the stretch whose tension times stretch less energy
/// per length is the pull.
///
/// *Source.* The force that strains exert on the length of a straight element of uniform stretch,
/// and the tension that is read in it.
#[test]
fn tension_of_a_pull_is_that_of_the_law() {
    for (kind, effects) in effects().into_iter().enumerate() {
        let cable = cable(effects);
        let (feed, l, zero) = (cable.system.feeds.list[1], 0.5, [0.0; 12]);
        for stretch in [0.9, 0.99, 1.0, 1.004, 1.06, 1.3, 1.6] {
            let q: Vec<f64> =
                (0..30).map(|i| stretch * [0.5 * (i / 6) as f64, 0.0, 0.0, 1.0, 0.0, 0.0][i % 6]).collect();
            let extent = Extent { length: l, ..Extent::default() };
            let [own, _] =
                cable.system.strain_length_force(&cable.model, &feed, &extent, [&feed.side.gather(&q), &zero]);
            let tension = {
                let mut force = vec![0.0; 30];
                let at = ForceInput { time: 0.0, q: &q, v: &[], dv_dq: 0.0, scale: 1.0 };
                let mut system = cable.system.clone();
                system.forces.add(system.level, [at; 2], &mut force, None, &mut Default::default());
                -force[24]
            };
            // a natural curvature is bent straight: its energy per length is no part of the axial
            // law
            let straight = cable.system.forces.strain_energy(&q).1 / (4.0 * l);
            let read = 1e4 * cable.system.tension_of_pull(3, (straight - own) / 1e4);
            // a rope that is slack has the same pull at any stretch
            assert!((read - tension).abs() < 1e-8 * (1.0 + tension.abs()), "{kind} {stretch}: {read} N, {tension} N");
        }
    }
}
