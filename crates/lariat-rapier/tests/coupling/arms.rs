//! Arms of several links that a rope holds: any joints, masses, damping, fidelity, host step.

use super::common::{cable, gap, soft};
use lariat_rapier::lariat_ancf::effect::Damping;
use lariat_rapier::lariat_ancf::{At, Fidelity};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

/// How the links of an arm are joined to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Elbow {
    Welded,
    /// Hinges that a limit keeps straight.
    Limited,
    /// Hinges with both limits at 0.
    Locked,
}

/// An arm of links of 0.5 m, hinged to the world at its shoulder, its tip held by a rope from above.
#[derive(Clone, Copy, Debug)]
struct Arm<'a> {
    multibody: bool,
    elbow: Elbow,
    masses: &'a [f64],
    /// Retardation times of the rope in s, axial and of bending.
    damping: Option<(f64, f64)>,
    fidelity: Fidelity,
    iterations: usize,
    rate: usize,
}

impl Arm<'_> {
    /// Returns the force of the rope by moments about the shoulder.
    fn force(&self) -> f64 {
        let moment = self.masses.iter().enumerate().map(|(k, m)| m * 9.81 * (0.25 + 0.5 * k as f64)).sum::<f64>();
        moment / (0.5 * self.masses.len() as f64)
    }

    /// Returns mean, lowest and highest force of the rope over two seconds after another five, and the gap.
    fn run(&self) -> [f64; 4] {
        let mut world = PhysicsWorld::new();
        world.integration_parameters.num_solver_iterations = self.iterations;
        world.integration_parameters.dt = 1.0 / self.rate as Real;
        let mut before = world.insert_body(RigidBodyBuilder::fixed());
        for (k, &mass) in self.masses.iter().enumerate() {
            let x = 0.25 + 0.5 * k as Real;
            let body = RigidBodyBuilder::dynamic().translation(Vector::new(x, 0.0, 0.0)).can_sleep(false);
            let collider = ColliderBuilder::cuboid(0.2, 0.05, 0.05).mass(mass as Real);
            let link = world.insert(body.angular_damping(1.0), collider).0;
            let (at, end) = (Vector::new(if k == 0 { 0.0 } else { 0.25 }, 0.0, 0.0), Vector::new(-0.25, 0.0, 0.0));
            let hinge = RevoluteJointBuilder::new(Vector::Z).local_anchor1(at).local_anchor2(end);
            let joint: GenericJoint = match self.elbow {
                Elbow::Welded if k > 0 => FixedJointBuilder::new().local_anchor1(at).local_anchor2(end).into(),
                Elbow::Limited if k > 0 => hinge.limits([-1.0, 0.0]).into(),
                Elbow::Locked if k > 0 => hinge.limits([0.0, 0.0]).into(),
                _ => hinge.into(),
            };
            if self.multibody {
                world.multibody_joints.insert(before, link, joint, true).unwrap();
            } else {
                world.insert_impulse_joint(before, link, joint);
            }
            before = link;
        }
        let mut set = CableSet::new();
        set.settings.fidelity = self.fidelity;
        let tip = 0.5 * self.masses.len() as f64;
        let mut rope = cable([tip, 1.0, 0.0], [tip, 0.0, 0.0], soft()).fix(At::Start);
        if let Some((axial, bending)) = self.damping {
            rope = rope.damping(Damping { axial, bending });
        }
        let rope = set.insert(rope.build().unwrap());
        let held = set.attach_here(&world, rope, At::End, before, AttachmentKind::Ball).unwrap();
        let (mut mean, mut low, mut high) = (0.0, f64::MAX, f64::MIN);
        for i in 0..7 * self.rate {
            if set.step(&mut world).is_err() {
                return [f64::NAN; 4];
            }
            let pull = set.attachment(held).unwrap().force().y;
            if i >= 5 * self.rate {
                (mean, low, high) = (mean + pull / (2 * self.rate) as f64, pull.min(low), pull.max(high));
            }
        }
        [mean, low, high, gap(&set)]
    }
}

/// A rope of any damping carries what moments about the shoulder say.
#[test]
fn a_damped_rope_carries_an_arm() {
    for elbow in [Elbow::Welded, Elbow::Limited, Elbow::Locked] {
        for multibody in [false, true] {
            for masses in [&[1.0, 1.0, 1.0][..], &[0.2, 3.0], &[2.0, 0.3, 0.7, 1.5]] {
                for damping in [None, Some((1e-3, 0.02)), Some((1e-2, 0.5)), Some((0.0, 0.5)), Some((0.05, 0.0))] {
                    for fidelity in [Fidelity::Game, Fidelity::Engineering] {
                        for (iterations, rate) in [(4, 60), (1, 60), (4, 30), (1, 240)] {
                            if fidelity == Fidelity::Engineering && (damping.is_none() || rate != 60) {
                                continue;
                            }
                            let arm = Arm { multibody, elbow, masses, damping, fidelity, iterations, rate };
                            let [mean, low, high, gap] = arm.run();
                            let f = arm.force();
                            println!(
                                "{:8.4} {:8.4} {:8.4} % {gap:.1e} {elbow:?} {} {} {damping:?} {fidelity:?} {iterations} {rate}",
                                100.0 * (mean / f - 1.0),
                                100.0 * (low / f - 1.0),
                                100.0 * (high / f - 1.0),
                                if multibody { "multibody" } else { "impulse" },
                                masses.len()
                            );
                        }
                    }
                }
            }
        }
    }
}
