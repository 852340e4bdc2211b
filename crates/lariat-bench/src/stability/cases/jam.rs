//! Bodies wedged behind posts, pulled at by a winch through a rope to 5 kN; then let go at once.

use super::engine::rapier::prelude::*;
use super::stage::{Case, End, Fault, Play, Stage, case, damping, line, soft, wire};
use crate::stability::Family::Jam;
use crate::stability::outcome::Reading;
use lariat_ancf::{Section, Vector3};

const PULL: f64 = 5e3;

/// Posts at x, a body behind them, a winch at the origin.
fn wedge(s: &mut Stage, mass: f64, x: f64) -> (RigidBodyHandle, [RigidBodyHandle; 2]) {
    s.weightless();
    let posts = [-0.35, 0.35].map(|y| s.post([x + 0.25, y, 0.0], [0.1, 0.3, 1.0]));
    (s.cube(mass, 0.1, [x, 0.0, 0.0]), posts)
}

/// Winds until rope 0 carries `pull`, until `stop` (s); the rate makes up 5 times a second what is missing.
fn wind(s: &mut Stage, winch: RigidBodyHandle, pull: f64, compliance: f64, stop: f64) {
    let speed = if s.make != crate::stability::host::Make::Lariat {
        // no tension can be read of the rivals': the same way at the same rate
        if s.time < 1.0 { 0.05 } else { 0.0 }
    } else {
        (5.0 * (pull - s.tension(0, 1.0)) * compliance).clamp(-0.05, 0.05)
    };
    let speed = if s.time < 0.5 * stop && speed > 0.0 { speed.max(0.02) } else { speed };
    let speed = if s.time < stop { speed } else { 0.0 };
    s.drive(winch, [speed, 0.0, 0.0]);
}

fn rope(s: &mut Stage, section: Section, from: f64, to: f64, ends: (End, End)) -> Result<usize, Fault> {
    let rope = line([from, 0.0, 0.0], [to, 0.0, 0.0], section).integrator(damping()).gravity(Vector3::zeros());
    s.rope(rope, ends.0, ends.1)
}

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, section) in [("soft rope", soft()), ("steel wire", wire())] {
        for release in [false, true] {
            let what = if release { "let go at once" } else { "holds 5 kN" };
            let jam = case(Jam, format!("1 kg wedged, {name}, {what}"), 4.0, move |s| {
                let (load, posts) = wedge(s, 1.0, -2.1);
                let winch = s.winch([0.0; 3]);
                rope(s, section, 0.0, -2.0, (End::On(winch, [0.0; 3]), End::On(load, [0.1, 0.0, 0.0])))?;
                // the rope's, and that of Rapier's contacts: 15 mm for 5 kN on 1 kg
                let compliance = 2.0 / section.axial_stiffness + 3e-6;
                let mut removed = false;
                let stopped = std::rc::Rc::new(std::cell::Cell::new(f64::NAN));
                let seen = stopped.clone();
                Ok(Play::idle()
                    .acting(move |s| {
                        wind(s, winch, PULL, compliance, 3.5);
                        if !removed {
                            s.trace_without_energy();
                        }
                        if !removed && s.time >= 3.5 {
                            removed = true;
                            seen.set(s.force(1).norm());
                            s.restart_means();
                            if release {
                                posts.into_iter().for_each(|p| drop(s.world.remove_body(p)));
                            }
                            s.rebase();
                        }
                        Ok(())
                    })
                    .judging(move |s| {
                        if release {
                            // all it stored is P^2 L/2 EA, and it moves 1 kg at most so fast
                            let stored = PULL * PULL * 2.0 / (2.0 * section.axial_stiffness);
                            let most = 1.1 * (2.0 * stored / 1.0f64).sqrt() + 1.0;
                            let speed = super::stage::from(s.world.bodies[load].linvel()).norm();
                            return vec![Reading::at_most(
                                "speed let go, m/s",
                                speed,
                                most,
                                "energy stored in the rope",
                            )];
                        }
                        let mean = s.mean_force(1).norm();
                        // the winch is no perfect governor, least at coarse steps
                        vec![
                            Reading::near("pull held, N", mean, stopped.get(), 0.02, "what the winch was stopped at"),
                            Reading::near("pull held, N", mean, PULL, 0.1, "what the winch was set to"),
                        ]
                    }))
            });
            cases.push(jam.gap(1e-3).energy(0.1, f64::INFINITY).budget(6.0));
        }
    }
    let two = case(Jam, "two bodies, one jammed, 1 kN", 4.0, |s| {
        let section = soft();
        let (far, _) = wedge(s, 1.0, -4.3);
        let near = s.cube(1.0, 0.1, [-2.1, 0.0, 0.0]);
        let winch = s.winch([0.0; 3]);
        rope(s, section, 0.0, -2.0, (End::On(winch, [0.0; 3]), End::On(near, [0.1, 0.0, 0.0])))?;
        rope(s, section, -2.2, -4.2, (End::On(near, [-0.1, 0.0, 0.0]), End::On(far, [0.1, 0.0, 0.0])))?;
        let mut begun = false;
        Ok(Play::idle()
            .acting(move |s| {
                wind(s, winch, 1e3, 4.0 / section.axial_stiffness + 3e-6, 3.5);
                if !begun {
                    s.trace_without_energy();
                }
                if !begun && s.time >= 3.5 {
                    begun = true;
                    s.restart_means();
                    s.rebase();
                }
                Ok(())
            })
            .judging(|s| {
                let source = "what the winch was stopped at";
                vec![
                    Reading::near("pull on the near, N", s.mean_force(1).norm(), 1e3, 0.02, source),
                    Reading::near("pull on the far, N", s.mean_force(3).norm(), 1e3, 0.02, source),
                ]
            }))
    });
    cases.push(two.energy(0.1, f64::INFINITY).budget(6.0));
    cases
}
