//! Changes that a user makes to a running world: 5 kg on 2 m of rope, released from horizontal, and
//! changed after 0.3 s.

use super::super::engine::{AttachmentKind, Gap};
use super::prelude::*;
use crate::stability::host::CableModel;

type Change = fn(&mut TestWorld, RigidBodyHandle) -> Result<(), Fault>;

fn teleport(w: &mut TestWorld, load: RigidBodyHandle, by: f64) -> Result<(), Fault> {
    let at = w.position(load);
    w.physics.bodies[load].set_translation(to_rapier([at.x - by, at.y, at.z]), true);
    Ok(())
}

fn change_type(w: &mut TestWorld, load: RigidBodyHandle, kind: RigidBodyType) {
    w.physics.bodies[load].set_body_type(kind, true);
    w.physics.bodies[load].set_linvel(Vector::ZERO, true);
    w.physics.bodies[load].set_angvel(Vector::ZERO, true);
}

pub fn cases() -> Vec<Case> {
    // name, change, and whether only the long tests run it
    let changes: [(&str, Change, bool); 7] = [
        ("teleported by 0.1 m", |w, b| teleport(w, b, 0.1), false),
        ("teleported by 0.5 m", |w, b| teleport(w, b, 0.5), false),
        ("teleported by 5 m", |w, b| teleport(w, b, 5.0), true),
        (
            "removed",
            |w, b| {
                w.physics.remove_body(b);
                Ok(())
            },
            false,
        ),
        (
            "made fixed",
            |w, b| {
                change_type(w, b, RigidBodyType::Fixed);
                Ok(())
            },
            false,
        ),
        (
            "gravity flipped",
            |w, _| {
                w.physics.gravity = -w.physics.gravity;
                Ok(())
            },
            false,
        ),
        (
            "made a hundred times as heavy",
            |w, b| {
                w.physics.bodies[b].set_additional_mass(500.0, true);
                Ok(())
            },
            false,
        ),
    ];
    let mut cases = Vec::new();
    for (name, change, long) in changes {
        let changed = case(Family::Changes, name, 1.8, move |w| {
            let load = w.ball(5.0, 0.05, [2.0, 0.0, 0.0]);
            w.rope(straight([0.0; 3], [2.0, 0.0, 0.0], polymer_rope()), End::Fixed, End::On(load, [0.0; 3]))?;
            let (mut done, mut settled) = (false, false);
            Ok(Script::new().before_step(move |w| {
                if !done && w.time >= 0.3 {
                    done = true;
                    change(w, load)?;
                    // closing the gap is work of the user; 5 m at 6.6 m/s on average take 0.76 s
                    w.suspend_checks();
                }
                if !settled && w.time >= 1.2 {
                    settled = true;
                    if w.physics.bodies.get(load).is_some_and(|b| b.is_fixed()) {
                        change_type(w, load, RigidBodyType::Dynamic);
                    }
                    w.restart_balance();
                }
                Ok(())
            }))
        });
        let changed = changed.energy(0.02, 0.01).may_fail();
        cases.push(if long { changed.long() } else { changed });
    }
    let swing = |w: &mut TestWorld| -> Result<(), Fault> {
        let load = w.ball(5.0, 0.05, [2.0, 0.0, 0.0]);
        w.rope(straight([0.0; 3], [2.0, 0.0, 0.0], polymer_rope()), End::Fixed, End::On(load, [0.0; 3]))?;
        Ok(())
    };
    let varied = case(Family::Changes, "a different step every time", 1.0, move |w| {
        swing(w)?;
        Ok(Script::new().before_step(|w| {
            let share = [1.0, 0.5, 0.06, 2.0, 0.25, 1.3][w.steps_done % 6];
            w.physics.integration_parameters.dt = (share * w.dt()) as Real;
            Ok(())
        }))
    });
    cases.push(varied.lariat_only());
    let stopped = case(Family::Changes, "steps of 0 s in between", 1.0, move |w| {
        swing(w)?;
        let mut seen: Option<Vec<f64>> = None;
        Ok(Script::new().before_step(move |w| {
            let still = w.steps_done % 3 == 1;
            if let (Some(before), Some(c)) = (&seen, w.cable(0))
                && w.steps_done % 3 == 2
                && before.as_slice() != c.positions()
            {
                return Err("a step of 0 s moved the cable".into());
            }
            seen = w.cable(0).map(|c| c.positions().to_vec());
            w.physics.integration_parameters.dt = if still { 0.0 } else { w.dt() as Real };
            Ok(())
        }))
    });
    cases.push(stopped.lariat_only());
    let long = case(Family::Changes, "steps of 1 s", 1.0, move |w| {
        swing(w)?;
        Ok(Script::new().before_step(|w| {
            if w.steps_done < 2 && w.model == CableModel::Lariat {
                w.physics.integration_parameters.dt = if w.steps_done == 0 { 1.0 } else { w.dt() as Real };
            }
            Ok(())
        }))
    });
    cases.push(long.lariat_only().may_fail());
    let stop = case(Family::Changes, "detached at 0.3 s, attached again at 0.4 s", 1.0, move |w| {
        let load = w.ball(5.0, 0.05, [2.0, 0.0, 0.0]);
        w.rope(straight([0.0; 3], [2.0, 0.0, 0.0], polymer_rope()), End::Fixed, End::On(load, [0.0; 3]))?;
        Ok(Script::new()
            .before_step(move |w| {
                let (now, dt) = (w.time, w.dt());
                let at = |t: f64| (now - t).abs() < 0.5 * dt;
                if at(0.3) {
                    let attachment = w.attachments.pop().ok_or("no attachment")?;
                    w.set.detach(&mut w.physics, attachment)?;
                    w.suspend_checks();
                } else if at(0.4) {
                    let rope = w.cable_handle(0)?;
                    let ball = AttachmentKind::Ball.with_gap(Gap::Close);
                    w.attachments.push(w.set.attach(&w.physics, rope, At::End, load, Vector::ZERO, ball)?);
                }
                if at(0.7) {
                    w.restart_balance();
                }
                Ok(())
            })
            .checks(|w| vec![Check::at_most("gap at the end, m", w.monitor.gap, 1e-3, "a gap closes at 10 m/s")]))
    });
    cases.push(stop.energy(0.02, 0.01).lariat_only());
    cases
}
