//! An hour of a pendulum, ten minutes of a hoist: no drift, no heating, sleep and waking.

use super::G;
use super::engine::rapier::prelude::*;
use super::stage::{Case, End, Fault, Play, Stage, case, line, soft};
use crate::stability::Family::Long;
use crate::stability::host::Host;
use crate::stability::outcome::Reading;
use lariat_ancf::{CableBuilder, Damping, Fidelity, Integrator, Method, StepControl};

/// Long runs are for hosts that games use: 1/60 s, 4 iterations, both precisions.
fn usual(host: &Host) -> bool {
    host.rate == 60 && host.iterations == 4
}

/// 10 kg on a damped rope of 2 m under a winch, hung in at its natural length.
fn hoist(s: &mut Stage, sleeps: bool) -> Result<(RigidBodyHandle, RigidBodyHandle), Fault> {
    let load = s.cube(10.0, 0.1, [0.0, -2.1, 0.0]);
    if sleeps {
        s.world.bodies[load].activation_mut().normalized_linear_threshold =
            RigidBodyActivation::default_normalized_linear_threshold();
        s.world.bodies[load].activation_mut().angular_threshold = RigidBodyActivation::default_angular_threshold();
    }
    let winch = s.winch([0.0; 3]);
    let rope = line([0.0; 3], [0.0, -2.0, 0.0], soft()).damping(Damping::from_ratio(0.1, 70.0)?);
    let rope = if sleeps { rope } else { rope.fidelity(Fidelity::Game) };
    s.rope(rope, End::On(winch, [0.0; 3]), End::On(load, [0.0, 0.1, 0.0]))?;
    Ok((load, winch))
}

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let hour = case(Long, "an hour of a damped pendulum", 3600.0, |s| {
        let load = s.ball(5.0, 0.05, [1.0, -1.732_050_8, 0.0]);
        let rope = line([0.0; 3], [1.0, -1.732_050_8, 0.0], soft()).fidelity(Fidelity::Game);
        s.rope(rope.damping(Damping { axial: 1e-3, bending: 5.0 }), End::Fixed, End::On(load, [0.0; 3]))?;
        Ok(Play::idle().judging(move |s| {
            let at = s.place(load);
            let rest = -2.0 * super::green_stretch(G * (5.0 + 0.4) / 1e5);
            let speed = super::stage::from(s.world.bodies[load].linvel()).norm();
            vec![
                Reading::near("height at the end, m", at.y, rest, 0.05, "statics: it can only come lower"),
                Reading::at_most("speed at the end, m/s", speed, 3.3, "never faster than at the start's first pass"),
            ]
        }))
    });
    cases.push(hour.on(|host| usual(host) && !host.effects).budget(60.0).ours().energy(1e-3, f64::INFINITY));
    let undamped = |name: &str, with: fn(CableBuilder) -> CableBuilder| {
        let swings = case(Long, name, 600.0, move |s| {
            let load = s.ball(5.0, 0.05, [1.0, -1.732_050_8, 0.0]);
            let rope = with(line([0.0; 3], [1.0, -1.732_050_8, 0.0], soft()).elements(6));
            s.rope(rope, End::Fixed, End::On(load, [0.0; 3]))?;
            Ok(Play::idle())
        });
        swings.on(usual).budget(30.0).ours()
    };
    // generalised-alpha 0.5 at 1/240 s: its own damping of a swing of 2.8 s
    let game = undamped("ten minutes of an undamped pendulum", |rope| rope.fidelity(Fidelity::Game));
    cases.push(game.energy(1e-3, 0.25));
    // the implicit midpoint rule is symplectic: its energy wavers and does not drift (Hairer, Lubich & Wanner 2006, IX.8)
    let midpoint = undamped("ten minutes of an undamped pendulum, midpoint", |rope| {
        rope.integrator(Integrator { method: Method::Midpoint, control: StepControl::MaxStep(1.0 / 240.0) })
    });
    cases.push(midpoint.energy(2e-3, 2e-3));
    let awake = case(Long, "ten minutes of a resting hoist, awake", 600.0, |s| {
        let (load, _) = hoist(s, false)?;
        let mut before = None;
        let seen = std::rc::Rc::new(std::cell::Cell::new(f64::NAN));
        let first = seen.clone();
        Ok(Play::idle()
            .acting(move |s| {
                if before.is_none() && s.time >= 60.0 {
                    before = Some(());
                    first.set(s.place(load).y);
                }
                Ok(())
            })
            .judging(move |s| {
                let drift = (s.place(load).y - seen.get()).abs();
                let speed = super::stage::from(s.world.bodies[load].linvel()).norm();
                vec![
                    Reading::at_most("drift in 9 minutes, m", drift, 1e-5, "it rests"),
                    Reading::at_most("speed at the end, m/s", speed, 1e-4, "it rests"),
                ]
            }))
    });
    cases.push(awake.on(usual).budget(30.0).energy(1e-3, f64::INFINITY).ours());
    let asleep = case(Long, "ten minutes of a sleeping hoist, then woken", 600.0, |s| {
        let (load, winch) = hoist(s, true)?;
        let mut at = None;
        Ok(Play::idle()
            .acting(move |s| {
                if at.is_none() && s.time >= 60.0 {
                    let asleep = s.world.bodies[load].is_sleeping();
                    // the line load of the effects sets the hoist swinging: 0.2 N on 98 N, 4 mm at 2.2 rad/s, above the speed of sleep,
                    // and in air it swings on
                    if !asleep && !s.host.effects {
                        return Err("not asleep after a minute".into());
                    }
                    at = asleep.then(|| s.place(load));
                }
                if s.time >= 598.0 {
                    if let Some(at) = at
                        && at != s.place(load)
                        && s.time < 598.0 + 0.5 * s.dt()
                    {
                        return Err("a sleeping load moved".into());
                    }
                    s.drive(winch, [0.0, 0.1, 0.0]);
                    s.trace_without_energy();
                }
                Ok(())
            })
            .judging(move |s| {
                let awake = if s.world.bodies[load].is_sleeping() { 0.0 } else { 1.0 };
                vec![
                    Reading::between("awake", awake, (1.0, 1.0), "the winch moves"),
                    Reading::near("height, m", s.place(load).y, -1.902, 0.01, "the winch's path, Green's law"),
                ]
            }))
    });
    cases.push(asleep.on(usual).budget(30.0).energy(0.01, f64::INFINITY).ours());
    cases
}
