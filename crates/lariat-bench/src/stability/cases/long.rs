//! An hour of a pendulum, ten minutes of a hoist: no drift, no gain of energy, sleep and waking.

use super::prelude::*;
use crate::stability::host::Host;
use lariat_ancf::CableBuilder;
use std::cell::Cell;
use std::rc::Rc;

/// Returns whether a host is one that games use: 1/60 s, 4 iterations, either precision.
fn usual(host: &Host) -> bool {
    host.rate == 60 && host.iterations == 4
}

/// Adds 10 kg on a damped rope of 2 m below a winch, at its unstretched length.
fn hoist(w: &mut TestWorld, sleeps: bool) -> Result<(RigidBodyHandle, RigidBodyHandle), Fault> {
    let load = w.cube(10.0, 0.1, [0.0, -2.1, 0.0]);
    if sleeps {
        w.physics.bodies[load].activation_mut().normalized_linear_threshold =
            RigidBodyActivation::default_normalized_linear_threshold();
        w.physics.bodies[load].activation_mut().angular_threshold = RigidBodyActivation::default_angular_threshold();
    }
    let winch = w.winch([0.0; 3]);
    let rope = straight([0.0; 3], [0.0, -2.0, 0.0], polymer_rope()).damping(Damping::from_ratio(0.1, 70.0)?);
    let rope = if sleeps { rope } else { rope.fidelity(Fidelity::Game) };
    w.rope(rope, End::On(winch, [0.0; 3]), End::On(load, [0.0, 0.1, 0.0]))?;
    Ok((load, winch))
}

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let hour = case(Family::Long, "an hour of a damped pendulum", 3600.0, |w| {
        let load = w.ball(5.0, 0.05, [1.0, -1.732_050_8, 0.0]);
        let rope = straight([0.0; 3], [1.0, -1.732_050_8, 0.0], polymer_rope()).fidelity(Fidelity::Game);
        w.rope(rope.damping(Damping { axial: 1e-3, bending: 5.0 }), End::Fixed, End::On(load, [0.0; 3]))?;
        Ok(Script::new().checks(move |w| {
            let at = w.position(load);
            let rest = -2.0 * green_stretch(G * (5.0 + 0.4) / 1e5);
            let speed = w.velocity(load).norm();
            vec![
                Check::near("height at the end, m", at.y, rest, 0.05, "statics"),
                Check::at_most("speed at the end, m/s", speed, 3.3, "not faster than at the first pass"),
            ]
        }))
    });
    cases.push(hour.on(|host| usual(host) && !host.effects).budget(300).lariat_only().energy(1e-3, 0.01).long());
    let undamped = |name: &str, with: fn(CableBuilder) -> CableBuilder| {
        let swings = case(Family::Long, name, 600.0, move |w| {
            let load = w.ball(5.0, 0.05, [1.0, -1.732_050_8, 0.0]);
            let rope = with(straight([0.0; 3], [1.0, -1.732_050_8, 0.0], polymer_rope()).elements(6));
            w.rope(rope, End::Fixed, End::On(load, [0.0; 3]))?;
            Ok(Script::new())
        });
        swings.on(usual).budget(150).lariat_only()
    };
    // generalised-alpha 0.5 at 1/240 s damps a swing of 2.8 s a little
    let game = undamped("ten minutes of an undamped pendulum", |rope| rope.fidelity(Fidelity::Game));
    cases.push(game.energy(1e-3, 0.25));
    // the implicit midpoint rule is symplectic: its energy oscillates and does not drift (Hairer,
    // Lubich & Wanner 2006, IX.8)
    let midpoint = undamped("ten minutes of an undamped pendulum, midpoint", |rope| {
        rope.integrator(Integrator { method: Method::Midpoint, control: StepControl::MaxStep(1.0 / 240.0) })
    });
    cases.push(midpoint.energy(2e-3, 2e-3));
    let awake = case(Family::Long, "ten minutes of a resting hoist, awake", 600.0, |w| {
        let (load, _) = hoist(w, false)?;
        let mut before = None;
        let seen = Rc::new(Cell::new(f64::NAN));
        let first = seen.clone();
        Ok(Script::new()
            .before_step(move |w| {
                if before.is_none() && w.time >= 60.0 {
                    before = Some(());
                    first.set(w.position(load).y);
                }
                Ok(())
            })
            .checks(move |w| {
                let drift = (w.position(load).y - seen.get()).abs();
                let speed = w.velocity(load).norm();
                vec![
                    Check::at_most("drift in 9 minutes, m", drift, 1e-5, "it rests"),
                    Check::at_most("speed at the end, m/s", speed, 1e-4, "it rests"),
                ]
            }))
    });
    cases.push(awake.on(usual).budget(150).energy(1e-3, 0.01).lariat_only().long());
    let asleep = case(Family::Long, "ten minutes of a sleeping hoist, then woken", 600.0, |w| {
        let (load, winch) = hoist(w, true)?;
        let mut at = None;
        Ok(Script::new()
            .before_step(move |w| {
                if at.is_none() && w.time >= 60.0 {
                    let asleep = w.physics.bodies[load].is_sleeping();
                    // with effects the line load makes the hoist swing: 0.2 N on 98 N, 4 mm at 2.2
                    // rad/s, faster than a body that may sleep, and air hardly damps it
                    if !asleep && !w.host.effects {
                        return Err("not asleep after a minute".into());
                    }
                    at = asleep.then(|| w.position(load));
                }
                if w.time >= 598.0 {
                    if let Some(at) = at
                        && at != w.position(load)
                        && w.time < 598.0 + 0.5 * w.dt()
                    {
                        return Err("a sleeping load moved".into());
                    }
                    w.set_velocity(winch, [0.0, 0.1, 0.0]);
                    w.suspend_energy_check();
                }
                Ok(())
            })
            .checks(move |w| {
                let awake = if w.physics.bodies[load].is_sleeping() { 0.0 } else { 1.0 };
                vec![
                    Check::between("awake", awake, (1.0, 1.0), "the winch moves"),
                    Check::near("height, m", w.position(load).y, -1.902, 0.01, "the winch's path, Green's law"),
                ]
            }))
    });
    cases.push(asleep.on(usual).budget(150).lariat_only());
    cases
}
