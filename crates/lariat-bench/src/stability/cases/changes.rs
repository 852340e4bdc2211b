//! What users do to a running world: 5 kg on 2 m of soft rope, let go from horizontal, and after 0.3 s ...

use super::engine::rapier::prelude::*;
use super::stage::{Case, End, Fault, Play, Stage, case, line, soft, to};
use crate::stability::Family::Changes;
use crate::stability::host::Make;
use crate::stability::outcome::Reading;

type Do = fn(&mut Stage, RigidBodyHandle) -> Result<(), Fault>;

fn jump(s: &mut Stage, load: RigidBodyHandle, by: f64) -> Result<(), Fault> {
    let at = s.place(load);
    s.world.bodies[load].set_translation(to([at.x - by, at.y, at.z]), true);
    Ok(())
}

fn kind(s: &mut Stage, load: RigidBodyHandle, kind: RigidBodyType) {
    s.world.bodies[load].set_body_type(kind, true);
    s.world.bodies[load].set_linvel(Vector::ZERO, true);
    s.world.bodies[load].set_angvel(Vector::ZERO, true);
}

pub fn cases() -> Vec<Case> {
    let acts: [(&str, Do); 7] = [
        ("teleported by 0.1 m", |s, b| jump(s, b, 0.1)),
        ("teleported by 0.5 m", |s, b| jump(s, b, 0.5)),
        ("teleported by 5 m", |s, b| jump(s, b, 5.0)),
        ("removed", |s, b| {
            s.world.remove_body(b);
            Ok(())
        }),
        ("made fixed", |s, b| {
            kind(s, b, RigidBodyType::Fixed);
            Ok(())
        }),
        ("gravity flipped", |s, _| {
            s.world.gravity = -s.world.gravity;
            Ok(())
        }),
        ("made a hundred times as heavy", |s, b| {
            s.world.bodies[b].set_additional_mass(500.0, true);
            Ok(())
        }),
    ];
    let mut cases = Vec::new();
    for (name, act) in acts {
        let changed = case(Changes, name, 1.8, move |s| {
            let load = s.ball(5.0, 0.05, [2.0, 0.0, 0.0]);
            s.rope(line([0.0; 3], [2.0, 0.0, 0.0], soft()), End::Fixed, End::On(load, [0.0; 3]))?;
            let (mut acted, mut settled) = (false, false);
            Ok(Play::idle().acting(move |s| {
                if !acted && s.time >= 0.3 {
                    acted = true;
                    act(s, load)?;
                    // what an end travels to close a gap is work of the user; 5 m at 6.6 m/s on average take 0.76 s
                    s.pause();
                }
                if !settled && s.time >= 1.2 {
                    settled = true;
                    if s.world.bodies.get(load).is_some_and(|b| b.is_fixed()) {
                        kind(s, load, RigidBodyType::Dynamic);
                    }
                    s.rebase();
                }
                Ok(())
            }))
        });
        cases.push(changed.gap(1e-3).energy(0.02, f64::INFINITY).may_refuse());
    }
    let swing = |s: &mut Stage| -> Result<(), Fault> {
        let load = s.ball(5.0, 0.05, [2.0, 0.0, 0.0]);
        s.rope(line([0.0; 3], [2.0, 0.0, 0.0], soft()), End::Fixed, End::On(load, [0.0; 3]))?;
        Ok(())
    };
    let varied = case(Changes, "another step every time", 1.0, move |s| {
        swing(s)?;
        Ok(Play::idle().acting(|s| {
            let share = [1.0, 0.5, 0.06, 2.0, 0.25, 1.3][s.k % 6];
            s.world.integration_parameters.dt = (share * s.dt()) as Real;
            Ok(())
        }))
    });
    cases.push(varied.energy(0.01, 0.02).ours());
    let stopped = case(Changes, "steps of 0 s in between", 1.0, move |s| {
        swing(s)?;
        let mut seen: Option<Vec<f64>> = None;
        Ok(Play::idle().acting(move |s| {
            let still = s.k % 3 == 1;
            if let (Some(before), Some(c)) = (&seen, s.cable(0))
                && s.k % 3 == 2
                && before.as_slice() != c.positions()
            {
                return Err("a step of 0 s moved the cable".into());
            }
            seen = s.cable(0).map(|c| c.positions().to_vec());
            s.world.integration_parameters.dt = if still { 0.0 } else { s.dt() as Real };
            Ok(())
        }))
    });
    cases.push(stopped.energy(0.01, 0.02).ours());
    let long = case(Changes, "steps of 1 s", 1.0, move |s| {
        swing(s)?;
        Ok(Play::idle().acting(|s| {
            if s.k < 2 && s.make == Make::Lariat {
                s.world.integration_parameters.dt = if s.k == 0 { 1.0 } else { s.dt() as Real };
            }
            Ok(())
        }))
    });
    cases.push(long.energy(0.01, 0.05).ours().may_refuse());
    let stop = case(Changes, "let go at 0.3 s, caught again", 1.0, move |s| {
        let load = s.ball(5.0, 0.05, [2.0, 0.0, 0.0]);
        s.rope(line([0.0; 3], [2.0, 0.0, 0.0], soft()), End::Fixed, End::On(load, [0.0; 3]))?;
        Ok(Play::idle()
            .acting(move |s| {
                let (now, dt) = (s.time, s.dt());
                let at = |t: f64| (now - t).abs() < 0.5 * dt;
                if at(0.3) {
                    let held = s.held.pop().ok_or("nothing held")?;
                    s.set.detach(&mut s.world, held)?;
                    s.pause();
                } else if at(0.4) {
                    let super::stage::Strand::Cable(rope) = s.strands[0] else { return Err("no cable".into()) };
                    let end = lariat_ancf::At::End;
                    let held =
                        s.set.attach(&s.world, rope, end, load, Vector::ZERO, super::engine::AttachmentKind::Ball)?;
                    s.held.push(held);
                }
                if at(0.7) {
                    s.rebase();
                }
                Ok(())
            })
            .judging(|s| vec![Reading::at_most("gap at the end, m", s.trace.gap, 1e-3, "closed at 10 m/s")]))
    });
    cases.push(stop.energy(0.02, f64::INFINITY).ours());
    cases
}
