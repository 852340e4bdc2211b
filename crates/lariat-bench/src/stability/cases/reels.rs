//! Reels and drums: fast, to the least length, by every implicit integrator, cut, with slack rope.

use super::super::engine::Drum;
use super::prelude::*;
use crate::stability::host::Host;
use lariat_ancf::{Reel, ReelReading};

/// Why energies are not compared: tests of the mechanics compare them with the work of reels.
const WORK: &str = "the reel does work";

/// Returns whether less than half of an element passes in a step of the fastest reels here: longer ones are refused by that name.
fn is_short(host: &Host) -> bool {
    host.rate >= 60 && (!host.effects || host.iterations == 4)
}

/// Takes away what a cable with a reel does not carry of the effects of a host: rest curvature and added mass.
fn carry(w: &mut TestWorld, rope: usize) -> Result<(), Fault> {
    let cable = w.cable_mut(rope)?;
    let mut effects = cable.effects().clone();
    effects.rest_shape = None;
    effects.buoyancy.iter_mut().for_each(|buoyancy| buoyancy.added_mass = 0.0);
    Ok(cable.set_effects(effects)?)
}

/// Returns integrators that carry a reel beside that of the other cases, at the steps of games or to a tolerance.
fn implicit() -> [(&'static str, Integrator); 3] {
    let steps = |method| Integrator { method, control: StepControl::MaxStep(1.0 / 240.0) };
    let tolerant = |method| Integrator { method, control: StepControl::Tolerance(1e-4) };
    [
        ("ESDIRK4", tolerant(Method::Esdirk4)),
        ("TR-BDF2", tolerant(Method::TrBdf2)),
        ("generalised-alpha", steps(Method::GeneralisedAlpha { rho: 0.5 })),
    ]
}

/// Returns what the reel at the end of a rope does.
fn reel(w: &TestWorld, rope: usize) -> Option<ReelReading> {
    w.cable(rope)?.reel(At::End)
}

/// Hangs a rope with a reel at the world's origin, and a load of a mass in kg on it, at a point in m.
fn hang(
    w: &mut TestWorld,
    (mass, at): (f64, [f64; 3]),
    elements: usize,
    wound: Reel,
) -> Result<RigidBodyHandle, Fault> {
    let load = w.ball(mass, 0.05, at);
    let rope = straight(at, [0.0; 3], Section::from_stiffness(1e6, 0.5, 0.5)?).elements(elements);
    let rope = rope.damping(Damping { axial: 2e-3, bending: 2e-3 });
    let rope = w.rope(rope, End::On(load, [0.0; 3]), End::Fixed)?;
    carry(w, rope)?;
    w.cable_mut(rope)?.add_reel(At::End, wound)?;
    Ok(load)
}

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    // 3 m out and 2.5 m in: the load falls behind the rope, and snatches
    let fast = case(Family::Reels, "5 m/s out and in", 1.8, |w| {
        let rate = vec![[0.1, 5.0], [0.7, -5.0], [1.3, 0.0]];
        hang(w, (20.0, [0.0, -4.0, 0.0]), 8, Reel { rate, acceleration: 50.0, ..Reel::default() })?;
        Ok(Script::new().checks(|w| {
            let out = reel(w, 0).map_or(f64::NAN, |reel| reel.length_out);
            let source = "4 m + 3 m - 2.5 m, rates that are linear by 50 m/s^2; rows may fall within a host step";
            vec![Check::near("length out, m", out, 4.5, 2e-3, source)]
        }))
    });
    cases.push(fast);
    let least = case(Family::Reels, "to the least length with 5 kN", 5.0, |w| {
        let wound = Reel { rate: vec![[0.2, -1.0]], acceleration: 4.0, ..Reel::default() };
        hang(w, (510.0, [0.0, -3.0, 0.0]), 6, wound)?;
        Ok(Script::new().checks(|w| {
            let reel = reel(w, 0);
            let value = |of: fn(&ReelReading) -> f64| reel.as_ref().map_or(f64::NAN, of);
            vec![
                Check::near("length out, m", value(|r| r.length_out), 0.2, 0.01, "0.4 of an element"),
                Check::between("rate, m/s", value(|r| r.rate), (-1e-3, 1e-3), "a stop"),
                Check::near("tension, N", value(|r| r.tension), 510.0 * G, 0.1, "m g, and what still oscillates"),
            ]
        }))
    });
    cases.push(least);
    for (name, integrator) in implicit() {
        let case = case(Family::Reels, format!("to the least length with 5 kN and out, {name}"), 3.4, move |w| {
            // slower than the load falls: the rope stays taut
            let rate = vec![[0.1, -2.5], [1.7, 1.0], [3.0, 0.0]];
            hang(w, (510.0, [0.05, -2.99, 0.03]), 6, Reel { rate, acceleration: 8.0, ..Reel::default() })?;
            w.cable_mut(0)?.set_integrator(integrator)?;
            Ok(Script::new().checks(|w| {
                let reel = reel(w, 0);
                let value = |of: fn(&ReelReading) -> f64| reel.as_ref().map_or(f64::NAN, of);
                let source = "0.4 of an element, and 1.3 s at 1 m/s; rows may fall within a host step";
                vec![
                    Check::between("length out, m", value(|r| r.length_out), (1.47, 1.53), source),
                    Check::between("rate, m/s", value(|r| r.rate), (-1e-9, 1e-9), "the table"),
                ]
            }))
        });
        cases.push(case.on(|host| is_short(host) && host.iterations == 4).budget(100));
    }
    let cut = case(Family::Reels, "cut while it swings and is taken in", 1.4, |w| {
        let wound = Reel { rate: vec![[0.2, -0.5]], acceleration: 4.0, ..Reel::default() };
        let load = hang(w, (5.0, [1.2, -1.2, 0.9]), 8, wound)?;
        let mut done = false;
        Ok(Script::new()
            .before_step(move |w| {
                if !done && w.time >= 0.6 {
                    done = true;
                    let rope = w.cable_handle(0)?;
                    w.set.cut(rope, 0.7)?;
                }
                Ok(())
            })
            .checks(move |w| {
                let length = w.cable(0).map_or(f64::NAN, Cable::length);
                vec![
                    Check::near("length of the part, m", length, 0.7, 1e-6, "cut there"),
                    Check::at_most("height, m", w.position(load).y, -3.0, "free fall from -1.7 m for 0.8 s"),
                ]
            }))
    });
    cases.push(cut);
    let remeshed = case(Family::Reels, "two hundred splits and merges", 12.0, |w| {
        let rate = (0..12).map(|i| [f64::from(i), if i % 2 == 0 { 2.0 } else { -2.0 }]).collect();
        hang(w, (10.0, [1.2, -1.2, 0.9]), 19, Reel { rate, acceleration: 20.0, ..Reel::default() })?;
        w.cable_mut(0)?.set_integrator(Integrator {
            method: Method::DiscreteGradient,
            control: StepControl::MaxStep(1.0 / 240.0),
        })?;
        Ok(Script::new().checks(|w| {
            let count = reel(w, 0).map_or(f64::NAN, |reel| (reel.splits + reel.merges) as f64);
            vec![Check::between("splits and merges", count, (190.0, 260.0), "1.9 m in 0.1 m, twelve times")]
        }))
    });
    cases.push(remeshed.budget(100).long().on(is_short));
    // a load falls 0.3 m until its rope is taut, while a drum of 0.4 kg over R^2 takes the rope in
    let slack = case(Family::Reels, "a light drum takes in slack rope", 1.0, |w| {
        let load = w.ball(5.0, 0.05, [0.0, -2.0, 0.0]);
        let rope =
            straight([0.0, -2.0, 0.0], [0.0; 3], polymer_rope()).length(2.3).elements(6).fidelity(Fidelity::Game);
        let rope = w.rope(rope, End::On(load, [0.0; 3]), End::Fixed)?;
        let own = MassProperties::new(Vector::ZERO, 4.0, Vector::splat(0.016));
        let axes = LockedAxes::TRANSLATION_LOCKED | LockedAxes::ROTATION_LOCKED_X | LockedAxes::ROTATION_LOCKED_Y;
        let wheel = RigidBodyBuilder::dynamic().additional_mass_properties(own).locked_axes(axes);
        let wheel = w.physics.insert_body(wheel.translation(to_rapier([0.2, 0.5, 0.0])).linear_damping(0.0));
        w.physics.bodies[wheel].set_angvel(Vector::Z * -1.0, true);
        carry(w, rope)?;
        let rope = w.cable_handle(rope)?;
        let drum = Drum { body: wheel, axis: Vector::Z, radius: 0.2 };
        w.set.add_drum(&w.physics.bodies, (rope, At::End), drum, Reel { stock: Some(9.0), ..Reel::default() })?;
        Ok(Script::new().checks(move |w| {
            let Some(reel) = reel(w, 0) else { return Vec::new() };
            let spin = f64::from(w.physics.bodies[wheel].angvel().z) * 0.2;
            vec![
                Check::near("spin times radius, m/s", spin, reel.rate, 0.02, "the rate of the reel"),
                Check::near("speed of the load, m/s", -w.velocity(load).y, reel.rate, 0.1, "a taut rope"),
            ]
        }))
    });
    cases.push(slack.on(is_short));
    cases.into_iter().map(|case| case.energy_not_checked(WORK).lariat_only()).collect()
}
