//! An arm of three links, a multibody of Rapier, held level by a tether at its tip, without and with a motor that takes half of the moment.
//! `cargo run --release --example tether_multibody`
//!
//! # References
//!
//! Moments about the shoulder: the arm (3 kg, 1.5 m) has the moment m g L/2 = 22.07 N m, the tether T L, the motor M, so
//! `T = (m g L/2 - M)/L`: 14.715 N without the motor, 7.358 N with half of the moment.

use lariat_rapier::lariat_ancf::{At, Cable, Integrator, Section, StepControl, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let weight = 3.0 * 9.81 * 0.75; // N m about the shoulder
    for motor in [0.0, 0.5 * weight] {
        let mut world = PhysicsWorld::new();
        let mut before = world.insert_body(RigidBodyBuilder::fixed());
        for k in 0..3 {
            let body = RigidBodyBuilder::dynamic().translation(Vector::new(0.25 + 0.5 * k as Real, 0.0, 0.0));
            let body = body.can_sleep(false).angular_damping(1.0);
            let (link, _) = world.insert(body, ColliderBuilder::cuboid(0.2, 0.05, 0.05).mass(1.0));
            let end = Vector::new(-0.25, 0.0, 0.0);
            let joint: GenericJoint = match k {
                0 => RevoluteJointBuilder::new(Vector::Z).local_anchor2(end).into(),
                _ => FixedJointBuilder::new().local_anchor1(-end).local_anchor2(end).into(),
            };
            world.multibody_joints.insert(before, link, joint, true).ok_or("no joint")?;
            if k == 0 {
                world.bodies[link].add_torque(Vector::new(0.0, 0.0, motor as Real), true); // the motor at the shoulder
            }
            before = link;
        }
        let mut cables = CableSet::new();
        let tether = cables.insert(
            Cable::builder()
                .points([Vector3::new(1.5, 1.0, 0.0), Vector3::new(1.5, 0.0, 0.0)])
                .section(Section::square(0.01, 1.0e9, 1.0)?) // m, Pa, kg/m^3: almost without weight
                .integrator(Integrator {
                    method: "generalised-alpha-0".parse()?,
                    control: StepControl::MaxStep(1.0 / 480.0),
                })
                .fix(At::Start)
                .build()?,
        );
        let tip = cables.attach(&world, tether, At::End, before, Vector::new(0.25, 0.0, 0.0), AttachmentKind::Ball)?;
        for _ in 0..600 {
            cables.step(&mut world)?; // 10 s
        }
        let (pull, gap) = (cables.attachment(tip)?.force().y, cables.attachment(tip)?.gap());
        let expected = (weight - motor) / 1.5;
        println!("motor {motor:6.3} N m: force of the tether {pull:.3} N, by statics {expected:.3} N, gap {gap:.0e} m");
        if (pull / expected - 1.0).abs() > 2e-3 || gap > 1e-3 {
            return Err("the moments do not balance".into());
        }
    }
    Ok(())
}
