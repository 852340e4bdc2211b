//! Arms of multibodies and impulse joints, limits, motors, CCD, locked axes, kinematic bodies.

use super::prelude::*;

/// The joints of an arm.
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
        let hung = case(Family::Mechanisms, format!("arm, {}", arm.name), 6.0, move |w| {
            let mut before = w.physics.insert_body(RigidBodyBuilder::fixed());
            for k in 0..3 {
                let body = RigidBodyBuilder::dynamic().translation(to_rapier([0.25 + 0.5 * k as f64, 0.0, 0.0]));
                let body = body.can_sleep(false).angular_damping(1.0);
                let link = w.physics.insert(body, ColliderBuilder::cuboid(0.2, 0.05, 0.05).mass(1.0)).0;
                let (at, end) = (to_rapier([if k == 0 { 0.0 } else { 0.25 }, 0.0, 0.0]), to_rapier([-0.25, 0.0, 0.0]));
                let joint: GenericJoint = if k > 0 && !arm.limits {
                    FixedJointBuilder::new().local_anchor1(at).local_anchor2(end).into()
                } else {
                    let hinge = RevoluteJointBuilder::new(Vector::Z).local_anchor1(at).local_anchor2(end);
                    if k > 0 { hinge.limits([-1.0, 0.0]).into() } else { hinge.into() }
                };
                if arm.multibody {
                    w.physics.insert_multibody_joint(before, link, joint).ok_or("no such multibody")?;
                } else {
                    w.physics.insert_impulse_joint(before, link, joint);
                }
                before = link;
            }
            let rope = straight([1.5, 1.0, 0.0], [1.5, 0.0, 0.0], polymer_rope()).integrator(l_stable_integrator());
            w.rope(rope, End::Fixed, End::On(before, [0.25, 0.0, 0.0]))?;
            let mut begun = false;
            Ok(Script::new()
                .before_step(move |w| {
                    if !begun && w.time >= 4.0 {
                        begun = true;
                        w.monitor.restart_forces();
                    }
                    Ok(())
                })
                .checks(move |w| {
                    let source = "moments about the shoulder: half of the weight";
                    vec![Check::near("mean pull, N", w.monitor.mean_force(0).y, 1.5 * G, 0.005, source)]
                }))
        });
        // Rapier's position corrections lift the links a little, and its angular damping, which the
        // balance leaves out, takes 4 %
        cases.push(hung.energy(0.1, 0.1).budget(30));
    }
    let motor = case(Family::Mechanisms, "a motor of 50 N pulls", 4.0, |w| {
        w.remove_gravity();
        let rail = w.physics.insert_body(RigidBodyBuilder::fixed());
        let slider = w.cube(2.0, 0.1, [0.0; 3]);
        let joint = PrismaticJointBuilder::new(Vector::X).motor_velocity(0.2, 1e4).motor_max_force(50.0);
        w.physics.insert_impulse_joint(rail, slider, joint);
        let rope = straight([0.0; 3], [-2.0, 0.0, 0.0], polymer_rope())
            .gravity(Vector3::zeros())
            .integrator(l_stable_integrator());
        w.rope(rope, End::On(slider, [0.0; 3]), End::Fixed)?;
        // far below its target velocity, the motor always pushes with its largest force
        w.count_work_of(slider, Vector3::x() * 50.0);
        let mut begun = false;
        Ok(Script::new()
            .before_step(move |w| {
                if !begun && w.time >= 3.0 {
                    begun = true;
                    w.monitor.restart_forces();
                }
                Ok(())
            })
            .checks(|w| {
                vec![Check::near("mean force, N", -w.monitor.mean_force(0).x, 50.0, 0.02, "largest force of the motor")]
            }))
    });
    // the integrator damps the vibration of the slider
    cases.push(motor.energy(0.1, 1.0));
    let bullet = case(Family::Mechanisms, "a CCD body at a thin wall", 0.5, |w| {
        w.remove_gravity();
        let wall = RigidBodyBuilder::fixed().translation(to_rapier([1.0, 0.0, 0.0]));
        w.physics.insert(wall, ColliderBuilder::cuboid(0.005, 1.0, 1.0));
        let body = RigidBodyBuilder::dynamic().linvel(to_rapier([30.0, 0.0, 0.0])).ccd_enabled(true);
        let (bullet, _) = w.physics.insert(body, ColliderBuilder::ball(0.02).mass(0.1));
        let tail = straight([0.0; 3], [0.0, -0.5, 0.0], Section::from_stiffness(1e4, 0.1, 0.01)?).elements(4);
        let tail = tail.gravity(Vector3::zeros()).velocity(Vector3::new(30.0, 0.0, 0.0));
        w.rope(tail, End::On(bullet, [0.0; 3]), End::Free)?;
        Ok(Script::new().checks(move |w| {
            let gap = w.set.attachments().map(|(_, a)| a.gap()).fold(0.0, f64::max);
            vec![
                Check::between(
                    "position of the body, m",
                    w.position(bullet).x,
                    (-30.0, 1.0),
                    "CCD: it does not pass the wall",
                ),
                Check::at_most("gap at the end, m", gap, 1e-3, "the contract of an attachment"),
            ]
        }))
    });
    // the wall stops the body from 30 m/s, and the end of its cable follows within the Rapier step; by 1 m in a host step of 1/30 s it folds
    // elements of 0.125 m, which are left a gap. Contacts take all of the body's kinetic energy, and folding that of the cable
    cases.push(bullet.gap(0.03).energy(0.02, 1.0));
    let bead = case(Family::Mechanisms, "a bead on a rail", 1.0, |w| {
        w.remove_gravity();
        let body = RigidBodyBuilder::dynamic().linvel(to_rapier([1.0, 0.0, 0.0])).lock_rotations();
        let body = body.enabled_translations(true, false, false).can_sleep(false);
        let (bead, _) = w.physics.insert(body, ColliderBuilder::ball(0.05).mass(1.0));
        w.rope(
            straight([0.0, 1.0, 0.0], [0.0; 3], polymer_rope()).gravity(Vector3::zeros()),
            End::Fixed,
            End::On(bead, [0.0; 3]),
        )?;
        Ok(Script::new().checks(move |w| {
            let at = w.position(bead);
            let turned = from_rapier(w.physics.bodies[bead].angvel()).norm();
            vec![
                Check::at_most("off the rail, m", at.y.abs().max(at.z.abs()), 1e-6, "locked axes"),
                Check::at_most("spin, rad/s", turned, 0.0, "locked axes"),
            ]
        }))
    });
    cases.push(bead);
    for by_position in [false, true] {
        let how = if by_position { "position" } else { "velocity" };
        let moved = case(Family::Mechanisms, format!("a kinematic body moved by {how}"), 1.5, move |w| {
            let builder = if by_position {
                RigidBodyBuilder::kinematic_position_based()
            } else {
                RigidBodyBuilder::kinematic_velocity_based()
            };
            let arm = w.physics.insert_body(builder);
            let load = w.ball(2.0, 0.05, [0.3, -1.0, 0.0]);
            w.rope(
                straight([0.3, 0.0, 0.0], [0.3, -1.0, 0.0], polymer_rope()),
                End::On(arm, [0.3, 0.0, 0.0]),
                End::On(load, [0.0; 3]),
            )?;
            Ok(Script::new()
                .before_step(move |w| {
                    if by_position {
                        // Rapier's own ropes take several steps for one of the host: the target is
                        // the end of the first
                        let ahead = f64::from(w.physics.integration_parameters.dt);
                        let t = w.time + ahead;
                        let pose = Pose::new(to_rapier([0.2 * t, 0.0, 0.1 * t]), to_rapier([0.0, 0.0, 2.0 * t]));
                        w.physics.bodies[arm].set_next_kinematic_position(pose);
                    } else {
                        w.set_velocity(arm, [0.2, 0.0, 0.1]);
                        w.physics.bodies[arm].set_angvel(to_rapier([0.0, 0.0, 2.0]), true);
                    }
                    w.suspend_checks();
                    Ok(())
                })
                .checks(move |w| {
                    let anchor = from_rapier(*w.physics.bodies[arm].position() * to_rapier([0.3, 0.0, 0.0]));
                    let end = w.cable(0).map_or(f64::NAN, |c| (c.node_position(0) - anchor).norm());
                    vec![Check::at_most("end off its anchor, m", end, 1e-6, "the prescribed motion, single precision")]
                }))
        });
        cases.push(moved.energy_not_checked(
            "the work of a kinematic body is known only from the forces at the ends of Rapier's steps",
        ));
    }
    cases
}
