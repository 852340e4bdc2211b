//! Whips and spins: free ends beyond 100 m/s, spins up to 1000 rad/s.

use super::stage::{Case, End, Play, Stage, case, line, wire};
use crate::stability::Family::Whip;
use crate::stability::outcome::Reading;
use lariat_ancf::{Cable, Section, Vector3};

/// A whip of 2 m, thick at the handle, thin at the tip.
fn taper() -> [(f64, Section); 4] {
    let piece = |s: f64, d: f64| (s, Section::round(d, 2e8, 1100.0).expect("a section"));
    [piece(0.0, 0.012), piece(0.5, 0.008), piece(1.0, 0.005), piece(1.5, 0.003)]
}

/// Speed of the end of the cable in m/s; 0 of a rival's.
fn tip_speed(s: &Stage) -> f64 {
    let speed = |v: &[f64]| Vector3::from_column_slice(&v[v.len() - 6..v.len() - 3]).norm();
    s.cable(0).map_or(0.0, |c| speed(c.velocities()))
}

/// Angular velocity in rad/s at which Rapier turns a body whose angular velocity is set to `spin`: at most by pi/4 in a step, by a linearised
/// rotation in each substep, which is 2 atan(x/2) instead of x (`MAX_ROTATION` and `integrate_linearized` in rapier3d 0.36).
fn turned(s: &Stage, spin: f64) -> f64 {
    let step = s.dt() / f64::from(s.set.settings.rapier_steps);
    let substeps = s.host.iterations as f64;
    let half = (spin * step).min(std::f64::consts::FRAC_PI_4) / (2.0 * substeps);
    2.0 * half.atan() * substeps / step
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
                seen.set(seen.get().max(tip_speed(s)));
                Ok(())
            })
            .judging(move |s| {
                // sampled at host steps: the coarse ones may miss the crack
                let least = if s.host.rate >= 240 { 30.0 } else { 15.0 };
                vec![Reading::between("tip speed, m/s", fastest.get(), (least, 1e3), "twice the handle's, at least")]
            }))
    });
    cases.push(crack.energy(0.02, f64::INFINITY).budget(8.0));
    // a limp thread folded back on itself, one leg held, the other running into the fold at 40 m/s: the fold runs on at half that, and all the
    // energy ends up in what is left of the leg
    let fold = case(Whip, "a fold runs out to a free end", 0.06, |s| {
        s.weightless();
        let points = [[0.0, 0.0], [1.0, 0.0], [1.02, 0.02], [1.0, 0.04], [0.0, 0.04]];
        let thread = Cable::builder()
            .points(points.map(|[x, y]| Vector3::new(x, y, 0.0)))
            .section(Section::from_stiffness(1e5, 0.0, 0.05)?)
            .elements(60)
            .gravity(Vector3::zeros());
        s.rope(thread, End::Fixed, End::Free)?;
        let thread = s.cable_mut(0)?;
        let q = thread.positions().to_vec();
        let mut v = vec![0.0; q.len()];
        for (v, q) in v.chunks_exact_mut(6).zip(q.chunks_exact(6)) {
            v[0] = 40.0 * (q[1] / 0.04).clamp(0.0, 1.0);
        }
        thread.set_coordinates(&q, &v)?;
        let fastest = std::rc::Rc::new(std::cell::Cell::new(0.0f64));
        let seen = fastest.clone();
        Ok(Play::idle()
            .acting(move |s| {
                seen.set(seen.get().max(tip_speed(s)));
                Ok(())
            })
            .judging(move |s| {
                if s.host.rate < 1000 {
                    // the crack lasts a millisecond and falls between two host steps
                    return Vec::new();
                }
                let source = "energy in a leg of length l: 40 m/s sqrt(1 m/l) (Calkin & March 1989)";
                vec![Reading::between("tip speed, m/s", fastest.get(), (100.0, 1e3), source)]
            }))
    });
    cases.push(fold.energy(0.01, f64::INFINITY).budget(8.0).ours());
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
                    if s.cable(0).is_none() {
                        return Vec::new();
                    }
                    vec![Reading::near(
                        "tip speed, m/s",
                        tip_speed(s),
                        turned(s, top) * 0.12,
                        0.15,
                        "rigid rotation of the drum",
                    )]
                }))
        });
        // a host step holds up to 33 rad: a body that turns by more than half a turn in a Rapier step may be refused
        cases.push(spun.energy(0.05, f64::INFINITY).may_refuse());
    }
    cases
}
