//! Bodies wedged behind posts, pulled by a winch through a rope with 5 kN, then released at once.

use super::prelude::*;
use crate::stability::host::CableModel;
use std::cell::Cell;
use std::rc::Rc;

/// Tension in N.
const PULL: f64 = 5e3;

/// Adds two posts at x and a body behind them.
fn wedge(w: &mut TestWorld, mass: f64, x: f64) -> (RigidBodyHandle, [RigidBodyHandle; 2]) {
    w.remove_gravity();
    let posts = [-0.35, 0.35].map(|y| w.post([x + 0.25, y, 0.0], [0.1, 0.3, 1.0]));
    (w.cube(mass, 0.1, [x, 0.0, 0.0]), posts)
}

/// Winds rope 0 up to the tension `pull` (N) until the time `stop` (s): a proportional controller
/// of 5 /s on the missing stretch.
fn wind(w: &mut TestWorld, winch: RigidBodyHandle, pull: f64, compliance: f64, stop: f64) {
    let speed = if w.model != CableModel::Lariat {
        // Rapier's own ropes do not tell their tension: about the same displacement at the same
        // rate
        if w.time < 1.0 { 0.05 } else { 0.0 }
    } else {
        (5.0 * (pull - w.tension(0, 1.0)) * compliance).clamp(-0.05, 0.05)
    };
    let speed = if w.time < 0.5 * stop && speed > 0.0 { speed.max(0.02) } else { speed };
    let speed = if w.time < stop { speed } else { 0.0 };
    w.set_velocity(winch, [speed, 0.0, 0.0]);
}

fn rope(w: &mut TestWorld, section: Section, from: f64, to: f64, ends: (End, End)) -> Result<usize, Fault> {
    let rope =
        straight([from, 0.0, 0.0], [to, 0.0, 0.0], section).integrator(l_stable_integrator()).gravity(Vector3::zeros());
    w.rope(rope, ends.0, ends.1)
}

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, section) in [("polymer rope", polymer_rope()), ("steel wire", steel_wire())] {
        for release in [false, true] {
            let what = if release { "released at once" } else { "holds 5 kN" };
            let jam = case(Family::Jam, format!("1 kg wedged, {name}, {what}"), 4.0, move |w| {
                let (load, posts) = wedge(w, 1.0, -2.1);
                let winch = w.winch([0.0; 3]);
                rope(w, section, 0.0, -2.0, (End::On(winch, [0.0; 3]), End::On(load, [0.1, 0.0, 0.0])))?;
                // of the rope, and of Rapier's contacts: 15 mm for 5 kN on 1 kg
                let compliance = 2.0 / section.axial_stiffness + 3e-6;
                let mut removed = false;
                let stopped = Rc::new(Cell::new(f64::NAN));
                let seen = stopped.clone();
                Ok(Script::new()
                    .before_step(move |w| {
                        wind(w, winch, PULL, compliance, 3.5);
                        if !removed {
                            w.suspend_energy_check();
                        }
                        if !removed && w.time >= 3.5 {
                            removed = true;
                            seen.set(w.force(1).norm());
                            w.monitor.restart_forces();
                            if release {
                                posts.into_iter().for_each(|p| drop(w.physics.remove_body(p)));
                            }
                            w.restart_balance();
                        }
                        Ok(())
                    })
                    .checks(move |w| {
                        if release {
                            // the rope stored P^2 L/2 EA, all of which may accelerate 1 kg
                            let stored = PULL * PULL * 2.0 / (2.0 * section.axial_stiffness);
                            let most = 1.1 * (2.0 * stored / 1.0f64).sqrt() + 1.0;
                            let speed = w.velocity(load).norm();
                            return vec![Check::at_most(
                                "speed after the release, m/s",
                                speed,
                                most,
                                "energy stored in the rope",
                            )];
                        }
                        let mean = w.monitor.mean_force(1).norm();
                        // the controller is the less accurate the longer the steps
                        vec![
                            Check::near("force held, N", mean, stopped.get(), 0.02, "force when the winch stopped"),
                            Check::near("force held, N", mean, PULL, 0.1, "set point of the winch"),
                        ]
                    }))
            });
            // the integrator damps what vibrates; a release may let all stored energy vibrate
            let lost = if release { 1.0 } else { 0.2 };
            cases.push(jam.energy(0.1, lost).budget(30));
        }
    }
    let two = case(Family::Jam, "two bodies, one jammed, 1 kN", 4.0, |w| {
        let section = polymer_rope();
        let (far, _) = wedge(w, 1.0, -4.3);
        let near = w.cube(1.0, 0.1, [-2.1, 0.0, 0.0]);
        let winch = w.winch([0.0; 3]);
        rope(w, section, 0.0, -2.0, (End::On(winch, [0.0; 3]), End::On(near, [0.1, 0.0, 0.0])))?;
        rope(w, section, -2.2, -4.2, (End::On(near, [-0.1, 0.0, 0.0]), End::On(far, [0.1, 0.0, 0.0])))?;
        let mut begun = false;
        Ok(Script::new()
            .before_step(move |w| {
                wind(w, winch, 1e3, 4.0 / section.axial_stiffness + 3e-6, 3.5);
                if !begun {
                    w.suspend_energy_check();
                }
                if !begun && w.time >= 3.5 {
                    begun = true;
                    w.monitor.restart_forces();
                    w.restart_balance();
                }
                Ok(())
            })
            .checks(|w| {
                let source = "force when the winch stopped";
                vec![
                    Check::near("force on the nearer body, N", w.monitor.mean_force(1).norm(), 1e3, 0.02, source),
                    Check::near("force on the farther body, N", w.monitor.mean_force(3).norm(), 1e3, 0.02, source),
                ]
            }))
    });
    cases.push(two.energy(0.1, 0.01).budget(30));
    cases
}
