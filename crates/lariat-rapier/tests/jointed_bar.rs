//! The energy of a bar that hangs on a joint and on a rope that snaps taut.

use lariat_rapier::lariat_ancf::coupling::Coupling;
use lariat_rapier::lariat_ancf::{At, Cable, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

/// A bar of 2 m and 5 kg on a ball joint, its tip on a rope from above.
#[derive(Clone, Copy, Debug)]
struct Bar {
    multibody: bool,
    axial_stiffness: f64,
    /// Length of the rope over the distance of its ends.
    slack: f64,
    /// Host steps per second.
    rate: usize,
}

impl Bar {
    /// Returns by how much (J) the energy, with what the method stores, was at most above the lowest before, in 4 s; and the largest
    /// magnitude of the work of gaps that Rapier's joints opened.
    fn run(&self) -> (f64, f64) {
        let mut world = PhysicsWorld::new();
        world.integration_parameters.dt = 1.0 / self.rate as Real;
        let ground = world.insert_body(RigidBodyBuilder::fixed());
        let body = RigidBodyBuilder::dynamic().translation(Vector::new(1.0, 0.0, 0.0)).can_sleep(false);
        let bar = world.insert(body, ColliderBuilder::cuboid(1.0, 0.03, 0.03).mass(5.0)).0;
        let joint = SphericalJointBuilder::new().local_anchor2(Vector::new(-1.0, 0.0, 0.0)).contacts_enabled(false);
        if self.multibody {
            let joint = world.multibody_joints.insert(ground, bar, joint, true).unwrap();
            world.multibody_joints.get_mut(joint).unwrap().0.damping_mut().fill(0.0);
        } else {
            world.insert_impulse_joint(ground, bar, joint);
        }
        let mut set = CableSet::new();
        let (top, tip) = (Vector3::new(1.7, 1.5, 0.3), Vector3::new(2.0, 0.0, 0.0));
        let section = Section::from_stiffness(self.axial_stiffness, 1.0, 0.1).unwrap();
        let rope = Cable::builder().points([top, tip]).length((tip - top).norm() * self.slack);
        let rope = set.insert(rope.section(section).elements(6).fix(At::Start).build().unwrap());
        let held = set.attach_here(&world, rope, At::End, bar, AttachmentKind::Ball).unwrap();
        let (mut lowest, mut above, mut of_gaps) = (f64::INFINITY, 0.0f64, 0.0f64);
        for _ in 0..4 * self.rate {
            set.step(&mut world).unwrap();
            let energy = set.energy(&world).unwrap().total() + set.get(rope).unwrap().energy_in_store();
            lowest = lowest.min(energy);
            above = above.max(energy - lowest);
            of_gaps = of_gaps.max(set.attachment(held).unwrap().residual().abs());
        }
        (above, of_gaps)
    }
}

/// A soft or a steel rope, taut or slack by 5 and 20 %, that stops a falling bar and lets it bounce and swing, on an impulse joint or as a
/// multibody: neither the snaps, which no step resolves, nor Rapier's joints make energy. What the rope's strain energy gains the bar
/// loses.
///
/// Reference: conservation of energy. Bound: 1e-3 of the 49 J that the bar may fall through, for single precision.
#[test]
fn a_bar_on_a_joint_and_a_rope_makes_no_energy() {
    for multibody in [false, true] {
        for axial_stiffness in [1e4, 1.6e7] {
            for (slack, rate) in [(1.0, 60), (1.05, 60), (1.2, 60), (1.0, 240)] {
                let bar = Bar { multibody, axial_stiffness, slack, rate };
                let (above, of_gaps) = bar.run();
                println!("{above:.1e} J, of gaps {of_gaps:.1e} J: {bar:?}");
                assert!(above < 0.049 && of_gaps < 0.049, "{above:.1e} J, of gaps {of_gaps:.1e} J: {bar:?}");
            }
        }
    }
}
