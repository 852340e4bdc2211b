//! Whips and spinning cables: free ends faster than 100 m/s, up to 1000 rad/s.

use super::prelude::*;

/// Sections of a whip of 2 m, thick at the handle and thin at the tip, by arc length in m.
fn taper() -> [(f64, Section); 4] {
    let piece = |s: f64, d: f64| (s, Section::round(d, 2e8, 1100.0).expect("a section"));
    [piece(0.0, 0.012), piece(0.5, 0.008), piece(1.0, 0.005), piece(1.5, 0.003)]
}

/// Returns the speed of the end of the cable in m/s, 0 for Rapier's own ropes.
fn tip_speed(w: &TestWorld) -> f64 {
    let speed = |v: &[f64]| Vector3::from_column_slice(&v[v.len() - 6..v.len() - 3]).norm();
    w.cable(0).map_or(0.0, |c| speed(c.velocities()))
}

/// Returns the angular velocity in rad/s at which Rapier rotates a body whose angular velocity is
/// set to `spin`.
///
/// Rapier rotates by at most pi/4 in a step, with a linearised rotation in each substep, which is 2
/// atan(x/2) instead of x (`MAX_ROTATION` and `integrate_linearized` in rapier3d 0.36).
fn actual_spin(w: &TestWorld, spin: f64) -> f64 {
    let step = w.dt() / f64::from(w.set.settings.rapier_steps);
    let substeps = w.host.iterations as f64;
    let half = (spin * step).min(std::f64::consts::FRAC_PI_4) / (2.0 * substeps);
    2.0 * half.atan() * substeps / step
}

/// Speed of the tip of a clamped beam by that of its clamp, which jumps: 1.566 of the first mode of
/// a cantilever (Blevins, Formulas for Natural Frequency and Mode Shape, table 8-1), undamped.
const SWING: f64 = 1.566;

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    // the handle moves by 1 m within 0.1 s and stops: a loop runs out to the tip
    let crack = case(Family::Whip, "crack of a tapered whip", 0.3, |w| {
        let handle = w.winch([0.0; 3]);
        let sections = taper();
        let mut whip = straight([0.0; 3], [0.0, -2.0, 0.0], sections[0].1).elements(24);
        for (from, section) in &sections[1..] {
            whip = whip.section_from(*from, *section);
        }
        w.rope(whip, End::On(handle, [0.0; 3]), End::Free)?;
        let fastest = std::rc::Rc::new(std::cell::Cell::new(0.0f64));
        let seen = fastest.clone();
        Ok(Script::new()
            .before_step(move |w| {
                // 1 m in 0.1 s, smoothly: 15 m/s at most
                let path = |t: f64| (10.0 * t).clamp(0.0, 1.0).powi(2) * (3.0 - 2.0 * (10.0 * t).clamp(0.0, 1.0));
                let speed = (path(w.time + w.dt()) - path(w.time)) / w.dt();
                w.set_velocity(handle, [speed, 0.0, 0.0]);
                if w.time < 0.1 - 1e-9 {
                    w.suspend_checks();
                } else if w.time < 0.1 + w.dt() {
                    w.restart_balance();
                }
                seen.set(seen.get().max(tip_speed(w)));
                Ok(())
            })
            .checks(move |w| {
                // read after host steps: long ones may miss the crack
                let least = if w.host.rate >= 240 { 30.0 } else { 15.0 };
                vec![Check::between("tip speed, m/s", fastest.get(), (least, 1e3), "at least twice that of the handle")]
            }))
    });
    // 1/240 s damps the highest modes that the crack excites
    cases.push(crack.energy(0.02, 0.03).budget(40));
    // a thread without bending stiffness is folded back on itself; one leg is held, the other runs
    // into the fold at 40 m/s: the fold moves at half that speed, and all energy ends up in the
    // rest of the leg
    let fold = case(Family::Whip, "a fold runs out to a free end", 0.06, |w| {
        w.remove_gravity();
        let points = [[0.0, 0.0], [1.0, 0.0], [1.02, 0.02], [1.0, 0.04], [0.0, 0.04]];
        let thread = Cable::builder()
            .fidelity(Fidelity::Engineering)
            .points(points.map(|[x, y]| Vector3::new(x, y, 0.0)))
            .section(Section::from_stiffness(1e5, 0.0, 0.05)?)
            .elements(60)
            .gravity(Vector3::zeros());
        w.rope(thread, End::Fixed, End::Free)?;
        let thread = w.cable_mut(0)?;
        let q = thread.positions().to_vec();
        let mut v = vec![0.0; q.len()];
        for (v, q) in v.chunks_exact_mut(6).zip(q.chunks_exact(6)) {
            v[0] = 40.0 * (q[1] / 0.04).clamp(0.0, 1.0);
        }
        thread.set_coordinates(&q, &v)?;
        let fastest = std::rc::Rc::new(std::cell::Cell::new(0.0f64));
        let seen = fastest.clone();
        Ok(Script::new()
            .before_step(move |w| {
                seen.set(seen.get().max(tip_speed(w)));
                Ok(())
            })
            .checks(move |w| {
                if w.host.rate < 1000 {
                    // the crack lasts a millisecond and falls between two longer host steps
                    return Vec::new();
                }
                let source = "energy in a leg of length l: 40 m/s sqrt(1 m/l) (Calkin & March 1989)";
                vec![Check::between("tip speed, m/s", fastest.get(), (100.0, 1e3), source)]
            }))
    });
    cases.push(fold.budget(60).lariat_only());
    // spinning freely about its start, which is held: the tip at 0.2 m moves at 20 and 200 m/s
    for spin in [100.0, 1000.0] {
        let free = case(Family::Whip, format!("spinning at {spin} rad/s"), 0.1, move |w| {
            w.remove_gravity();
            let rope = straight([0.0; 3], [0.2, 0.0, 0.0], steel_wire()).elements(4);
            let rope = rope.angular_velocity(Vector3::z() * spin).gravity(Vector3::zeros());
            w.rope(rope, End::Fixed, End::Free)?;
            let before = w.set.momentum(&w.physics).map(|m| m.angular.z).unwrap_or(f64::NAN);
            Ok(Script::new().checks(move |w| {
                let after = w.set.momentum(&w.physics).map(|m| m.angular.z).unwrap_or(f64::NAN);
                vec![Check::near("angular momentum", after, before, 1e-3, "no moment at a ball joint")]
            }))
        });
        cases.push(free.energy(1e-3, 0.01));
    }
    // a drum is spun up to 1000 rad/s within half a second; a cable is clamped to its rim
    for top in [100.0, 1000.0] {
        let spun = case(Family::Whip, format!("spun up to {top} rad/s"), 0.6, move |w| {
            w.remove_gravity();
            let drum = w.winch([0.0; 3]);
            let rope = straight([0.02, 0.0, 0.0], [0.12, 0.0, 0.0], steel_wire()).elements(4).gravity(Vector3::zeros());
            w.rope(rope, End::ClampedOn(drum, [0.02, 0.0, 0.0]), End::Free)?;
            Ok(Script::new()
                .before_step(move |w| {
                    let spin = top * (2.0 * (w.time + 0.5 * w.dt())).min(1.0);
                    w.suspend_checks();
                    w.physics.bodies[drum].set_angvel(to_rapier([0.0, 0.0, spin]), true);
                    Ok(())
                })
                .checks(move |w| {
                    let Some(cable) = w.cable(0) else { return Vec::new() };
                    let (spin, jump) = (actual_spin(w, top), actual_spin(w, 2.0 * top * w.dt()));
                    let body = &w.physics.bodies[drum];
                    let rigid = from_rapier(*body.position() * to_rapier([0.12, 0.0, 0.0]));
                    let off = (cable.node_position(4) - rigid).norm();
                    let source = "rigid rotation of the drum, and the vibration after a jump of its velocity";
                    vec![
                        Check::near("tip speed, m/s", tip_speed(w), spin * 0.12, 0.15 + SWING * jump / spin, source),
                        Check::at_most("tip off its place, m", off, 0.15 * 0.12, source),
                    ]
                }))
        });
        // the drum rotates by up to 33 rad in a host step: an error is an answer if it is more than
        // half a revolution in a Rapier step
        let spun = spun.energy_not_checked("the work of a drum on a clamp is known only approximately");
        let spun = spun.may_fail();
        cases.push(if top > 100.0 { spun.long() } else { spun });
    }
    cases
}
