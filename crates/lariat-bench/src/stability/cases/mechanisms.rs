//! Arms of multibodies and impulse joints, limits, motors, CCD, locked axes, kinematic bodies.

use super::G;
use super::engine::rapier::prelude::*;
use super::stage::{Case, End, Play, case, damping, from, line, soft, to};
use crate::stability::Family::Mechanisms;
use crate::stability::outcome::Reading;
use lariat_ancf::{Section, Vector3};

/// How the links of an arm hold together.
#[derive(Clone, Copy, Debug)]
struct Arm {
    name: &'static str,
    multibody: bool,
    limits: bool,
}

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for arm in [
        Arm { name: "welded multibody", multibody: true, limits: false },
        Arm { name: "multibody at its limits", multibody: true, limits: true },
        Arm { name: "welded impulse joints", multibody: false, limits: false },
        Arm { name: "impulse joints at their limits", multibody: false, limits: true },
    ] {
        // three links of 1 kg and 0.5 m, hinged at the shoulder, the tip held up by a rope
        let hung = case(Mechanisms, format!("arm, {}", arm.name), 6.0, move |s| {
            let mut before = s.world.insert_body(RigidBodyBuilder::fixed());
            for k in 0..3 {
                let body = RigidBodyBuilder::dynamic().translation(to([0.25 + 0.5 * k as f64, 0.0, 0.0]));
                let body = body.can_sleep(false).angular_damping(1.0);
                let link = s.world.insert(body, ColliderBuilder::cuboid(0.2, 0.05, 0.05).mass(1.0)).0;
                let (at, end) = (to([if k == 0 { 0.0 } else { 0.25 }, 0.0, 0.0]), to([-0.25, 0.0, 0.0]));
                let joint: GenericJoint = if k > 0 && !arm.limits {
                    FixedJointBuilder::new().local_anchor1(at).local_anchor2(end).into()
                } else {
                    let hinge = RevoluteJointBuilder::new(Vector::Z).local_anchor1(at).local_anchor2(end);
                    if k > 0 { hinge.limits([-1.0, 0.0]).into() } else { hinge.into() }
                };
                if arm.multibody {
                    s.world.insert_multibody_joint(before, link, joint).ok_or("no such multibody")?;
                } else {
                    s.world.insert_impulse_joint(before, link, joint);
                }
                before = link;
            }
            let rope = line([1.5, 1.0, 0.0], [1.5, 0.0, 0.0], soft()).integrator(damping());
            s.rope(rope, End::Fixed, End::On(before, [0.25, 0.0, 0.0]))?;
            let mut begun = false;
            Ok(Play::idle()
                .acting(move |s| {
                    if !begun && s.time >= 4.0 {
                        begun = true;
                        s.restart_means();
                    }
                    Ok(())
                })
                .judging(move |s| {
                    let source = "moments about the shoulder: half of the weight";
                    vec![Reading::near("mean pull, N", s.mean_force(0).y, 1.5 * G, 0.005, source)]
                }))
        });
        // Rapier's position corrections lift the links a little
        cases.push(hung.energy(0.1, f64::INFINITY).budget(6.0));
    }
    let motor = case(Mechanisms, "a motor of 50 N pulls", 4.0, |s| {
        s.weightless();
        let rail = s.world.insert_body(RigidBodyBuilder::fixed());
        let slider = s.cube(2.0, 0.1, [0.0; 3]);
        let joint = PrismaticJointBuilder::new(Vector::X).motor_velocity(0.2, 1e4).motor_max_force(50.0);
        s.world.insert_impulse_joint(rail, slider, joint);
        let rope = line([0.0; 3], [-2.0, 0.0, 0.0], soft()).gravity(Vector3::zeros()).integrator(damping());
        s.rope(rope, End::On(slider, [0.0; 3]), End::Fixed)?;
        let mut begun = false;
        Ok(Play::idle()
            .acting(move |s| {
                // work of the motor in the step to come: at most its force at its speed
                s.put_in(50.0 * 0.2 * s.dt());
                if !begun && s.time >= 3.0 {
                    begun = true;
                    s.restart_means();
                }
                Ok(())
            })
            .judging(|s| {
                vec![Reading::near("mean pull, N", -s.mean_force(0).x, 50.0, 0.02, "the most force of the motor")]
            }))
    });
    cases.push(motor.energy(0.1, f64::INFINITY));
    let bullet = case(Mechanisms, "a CCD body at a thin wall", 0.5, |s| {
        s.weightless();
        let wall = RigidBodyBuilder::fixed().translation(to([1.0, 0.0, 0.0]));
        s.world.insert(wall, ColliderBuilder::cuboid(0.005, 1.0, 1.0));
        let body = RigidBodyBuilder::dynamic().linvel(to([30.0, 0.0, 0.0])).ccd_enabled(true);
        let (bullet, _) = s.world.insert(body, ColliderBuilder::ball(0.02).mass(0.1));
        let tail = line([0.0; 3], [0.0, -0.5, 0.0], Section::from_stiffness(1e4, 0.1, 0.01)?).elements(4);
        let tail = tail.gravity(Vector3::zeros()).velocity(Vector3::new(30.0, 0.0, 0.0));
        s.rope(tail, End::On(bullet, [0.0; 3]), End::Free)?;
        Ok(Play::idle().judging(move |s| {
            let gap = s.set.attachments().map(|(_, a)| a.gap()).fold(0.0, f64::max);
            vec![
                Reading::between(
                    "place of the body, m",
                    s.place(bullet).x,
                    (-30.0, 1.0),
                    "CCD: it does not pass the wall",
                ),
                Reading::at_most("gap at the end, m", gap, 1e-3, "the contract of an attachment"),
            ]
        }))
    });
    // the wall stops the body within a Rapier step of 1/120 s at most, the end follows in the next: 30 m/s
    cases.push(bullet.gap(30.0 / 120.0).energy(0.02, f64::INFINITY));
    let bead = case(Mechanisms, "a bead on a rail", 1.0, |s| {
        s.weightless();
        let body = RigidBodyBuilder::dynamic().linvel(to([1.0, 0.0, 0.0])).lock_rotations();
        let body = body.enabled_translations(true, false, false).can_sleep(false);
        let (bead, _) = s.world.insert(body, ColliderBuilder::ball(0.05).mass(1.0));
        s.rope(line([0.0, 1.0, 0.0], [0.0; 3], soft()).gravity(Vector3::zeros()), End::Fixed, End::On(bead, [0.0; 3]))?;
        Ok(Play::idle().judging(move |s| {
            let at = s.place(bead);
            let turned = from(s.world.bodies[bead].angvel()).norm();
            vec![
                Reading::at_most("off the rail, m", at.y.abs().max(at.z.abs()), 1e-6, "locked axes"),
                Reading::at_most("turning, rad/s", turned, 0.0, "locked axes"),
            ]
        }))
    });
    cases.push(bead.energy(0.01, 0.02));
    for by_position in [false, true] {
        let how = if by_position { "position" } else { "velocity" };
        let moved = case(Mechanisms, format!("a kinematic body moved by {how}"), 1.5, move |s| {
            let builder = if by_position {
                RigidBodyBuilder::kinematic_position_based()
            } else {
                RigidBodyBuilder::kinematic_velocity_based()
            };
            let arm = s.world.insert_body(builder);
            let load = s.ball(2.0, 0.05, [0.3, -1.0, 0.0]);
            s.rope(
                line([0.3, 0.0, 0.0], [0.3, -1.0, 0.0], soft()),
                End::On(arm, [0.3, 0.0, 0.0]),
                End::On(load, [0.0; 3]),
            )?;
            Ok(Play::idle()
                .acting(move |s| {
                    if by_position {
                        // rivals take several steps for a host's: where it is to be at the end of the first
                        let ahead = f64::from(s.world.integration_parameters.dt);
                        let t = s.time + ahead;
                        let pose = Pose::new(to([0.2 * t, 0.0, 0.1 * t]), to([0.0, 0.0, 2.0 * t]));
                        s.world.bodies[arm].set_next_kinematic_position(pose);
                    } else {
                        s.drive(arm, [0.2, 0.0, 0.1]);
                        s.world.bodies[arm].set_angvel(to([0.0, 0.0, 2.0]), true);
                    }
                    s.pause();
                    Ok(())
                })
                .judging(move |s| {
                    let anchor = from(*s.world.bodies[arm].position() * to([0.3, 0.0, 0.0]));
                    let end = s.cable(0).map_or(f64::NAN, |c| (c.node_position(0) - anchor).norm());
                    vec![Reading::at_most(
                        "end off its anchor, m",
                        end,
                        1e-6,
                        "the motion prescribed, single precision",
                    )]
                }))
        });
        cases.push(moved.energy(0.05, f64::INFINITY));
    }
    cases
}
