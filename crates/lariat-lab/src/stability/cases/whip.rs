//! Whips and spins: free ends beyond 100 m/s, spins up to 1000 rad/s.

use super::stage::{Case, End, Play, case, line, wire};
use crate::stability::Family::Whip;
use crate::stability::outcome::Reading;
use lariat_ancf::{Section, Vector3};

/// A whip of 2 m, thick at the handle, thin at the tip.
fn taper() -> [(f64, Section); 4] {
    let piece = |s: f64, d: f64| (s, Section::round(d, 2e8, 1100.0).expect("a section"));
    [piece(0.0, 0.012), piece(0.5, 0.008), piece(1.0, 0.005), piece(1.5, 0.003)]
}

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    // the handle moves by 1 m within 0.1 s and stops: a loop runs out to the tip
    let crack = case(Whip, "crack of a tapered whip", 0.3, |s| {
        let handle = s.winch([0.0; 3]);
        let sections = taper();
        let mut whip = line([0.0; 3], [0.0, -2.0, 0.0], sections[0].1).elements(24);
        for (from, section) in &sections[1..] {
            whip = whip.section_from(*from, *section);
        }
        s.rope(whip, End::On(handle, [0.0; 3]), End::Free)?;
        let fastest = std::rc::Rc::new(std::cell::Cell::new(0.0f64));
        let seen = fastest.clone();
        Ok(Play::idle()
            .acting(move |s| {
                // 1 m in 0.1 s and to a stop: 15 m/s at most
                let way = |t: f64| (10.0 * t).clamp(0.0, 1.0).powi(2) * (3.0 - 2.0 * (10.0 * t).clamp(0.0, 1.0));
                let speed = (way(s.time + s.dt()) - way(s.time)) / s.dt();
                s.drive(handle, [speed, 0.0, 0.0]);
                if s.time < 0.1 - 1e-9 {
                    s.pause();
                } else if s.time < 0.1 + s.dt() {
                    s.rebase();
                }
                if let Some(c) = s.cable(0) {
                    let v = c.velocities();
                    let tip = Vector3::from_column_slice(&v[v.len() - 6..v.len() - 3]).norm();
                    seen.set(seen.get().max(tip));
                }
                Ok(())
            })
            .judging(move |s| {
                // sampled at host steps: the coarse ones may miss the crack
                let least = if s.host.rate >= 240 { 30.0 } else { 15.0 };
                vec![Reading::between("tip speed, m/s", fastest.get(), (least, 1e3), "twice the handle's, at least")]
            }))
    });
    cases.push(crack.energy(0.02, f64::INFINITY).budget(8.0));
    // spinning freely about its start, which is held: the tip of 0.2 m at 20 and 200 m/s
    for spin in [100.0, 1000.0] {
        let free = case(Whip, format!("spinning at {spin} rad/s"), 0.1, move |s| {
            s.weightless();
            let rope = line([0.0; 3], [0.2, 0.0, 0.0], wire()).elements(4);
            let rope = rope.angular_velocity(Vector3::z() * spin).gravity(Vector3::zeros());
            s.rope(rope, End::Fixed, End::Free)?;
            let before = s.set.momentum(&s.world).map(|m| m.angular.z).unwrap_or(f64::NAN);
            Ok(Play::idle().judging(move |s| {
                let after = s.set.momentum(&s.world).map(|m| m.angular.z).unwrap_or(f64::NAN);
                vec![Reading::near("angular momentum", after, before, 1e-3, "no moment at a ball joint")]
            }))
        });
        cases.push(free.energy(1e-3, 0.01));
    }
    // a drum turned up to 1000 rad/s within half a second, a lash clamped to its rim
    for top in [100.0, 1000.0] {
        let spun = case(Whip, format!("spun up to {top} rad/s"), 0.6, move |s| {
            s.weightless();
            let drum = s.winch([0.0; 3]);
            let rope = line([0.02, 0.0, 0.0], [0.12, 0.0, 0.0], wire()).elements(4).gravity(Vector3::zeros());
            s.rope(rope, End::ClampedOn(drum, [0.02, 0.0, 0.0]), End::Free)?;
            Ok(Play::idle()
                .acting(move |s| {
                    let spin = top * (2.0 * (s.time + 0.5 * s.dt())).min(1.0);
                    // what a drum does to a clamp is only approximately accounted
                    s.pause();
                    s.world.bodies[drum].set_angvel(super::stage::to([0.0, 0.0, spin]), true);
                    Ok(())
                })
                .judging(move |s| {
                    let Some(c) = s.cable(0) else { return Vec::new() };
                    let v = c.velocities();
                    let tip = Vector3::from_column_slice(&v[v.len() - 6..v.len() - 3]).norm();
                    vec![Reading::near("tip speed, m/s", tip, top * 0.12, 0.15, "rigid rotation of the drum")]
                }))
        });
        // a host step holds up to 33 rad: a body that turns by more than half a turn in a Rapier step may be refused
        cases.push(spun.energy(0.05, f64::INFINITY).may_refuse());
    }
    cases
}
