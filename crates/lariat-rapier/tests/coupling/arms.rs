//! Arms of several links that a rope holds: any joints, masses, damping, fidelity, host step.

use super::common::{cable, gap, is_left_out_in_double, soft};
use lariat_rapier::lariat_ancf::effect::Damping;
use lariat_rapier::lariat_ancf::{At, Fidelity};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

/// How the links of an arm are joined to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Elbow {
    Welded,
    /// Hinges that a limit keeps straight.
    Limited,
    /// Hinges with both limits at 0.
    Locked,
    /// Hinges that turn by this angle in rad to either side.
    Loose(Real),
}

/// Adds links of 0.5 m along x, hinged to the world at the origin and joined to each other. The last one is the tip.
pub fn add_links(world: &mut PhysicsWorld, masses: &[f64], elbow: Elbow, multibody: bool) -> Vec<RigidBodyHandle> {
    let root = world.insert_body(RigidBodyBuilder::fixed());
    join_links(world, masses, 0.25, elbow, multibody, Some(root))
}

/// Adds links of twice `half` (m) along x from the origin, joined to each other, and hinged to `root` if there is one.
pub fn join_links(
    world: &mut PhysicsWorld,
    masses: &[f64],
    half: f64,
    elbow: Elbow,
    multibody: bool,
    root: Option<RigidBodyHandle>,
) -> Vec<RigidBodyHandle> {
    let half = half as Real;
    let mut links = Vec::new();
    let mut before = root;
    for (k, &mass) in masses.iter().enumerate() {
        let x = half + 2.0 * half * k as Real;
        let body = RigidBodyBuilder::dynamic().translation(Vector::new(x, 0.0, 0.0)).can_sleep(false);
        let collider = ColliderBuilder::cuboid(0.8 * half, 0.05, 0.05).mass(mass as Real);
        let link = world.insert(body.angular_damping(1.0), collider).0;
        links.push(link);
        let Some(body) = before.replace(link) else { continue };
        let (at, end) = (Vector::new(if k == 0 { 0.0 } else { half }, 0.0, 0.0), Vector::new(-half, 0.0, 0.0));
        let hinge = RevoluteJointBuilder::new(Vector::Z).local_anchor1(at).local_anchor2(end);
        let joint: GenericJoint = match elbow {
            Elbow::Welded if k > 0 => FixedJointBuilder::new().local_anchor1(at).local_anchor2(end).into(),
            Elbow::Limited if k > 0 => hinge.limits([-1.0, 0.0]).into(),
            Elbow::Locked if k > 0 => hinge.limits([0.0, 0.0]).into(),
            Elbow::Loose(angle) if k > 0 => hinge.limits([-angle, angle]).into(),
            _ => hinge.into(),
        };
        if multibody {
            world.multibody_joints.insert(body, link, joint, true).unwrap();
        } else {
            world.insert_impulse_joint(body, link, joint);
        }
    }
    links
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
    /// Whether another rope holds the end of the first link.
    two_ropes: bool,
    /// Whether a fixed ball is half a millimetre below the second link.
    near: bool,
}

impl Arm<'_> {
    /// Returns the moment of the weights about the shoulder.
    fn moment(&self) -> f64 {
        self.masses.iter().enumerate().map(|(k, m)| m * 9.81 * (0.25 + 0.5 * k as f64)).sum()
    }

    /// Returns by how much mean, lowest and highest moment of the ropes over two seconds after another three deviate from that of the
    /// weights, as shares of it; `None` if a step was refused.
    fn run(&self) -> Option<[f64; 3]> {
        let mut world = PhysicsWorld::new();
        world.integration_parameters.num_solver_iterations = self.iterations;
        world.integration_parameters.dt = 1.0 / self.rate as Real;
        let links = add_links(&mut world, self.masses, self.elbow, self.multibody);
        if self.near {
            let ball = ColliderBuilder::ball(0.1).translation(Vector::new(0.75, -0.1505, 0.0));
            world.insert_collider(ball, None);
        }
        let mut set = CableSet::new();
        set.settings.fidelity = self.fidelity;
        let mut add_rope = |world: &PhysicsWorld, link: usize| {
            let x = 0.5 * (link + 1) as f64;
            let mut rope = cable([x, 1.0, 0.0], [x, 0.0, 0.0], soft()).fix(At::Start);
            if let Some((axial, bending)) = self.damping {
                rope = rope.damping(Damping { axial, bending });
            }
            let rope = set.insert(rope.build().unwrap());
            (x, set.attach_here(world, rope, At::End, links[link], AttachmentKind::Ball).unwrap())
        };
        let mut ropes = vec![add_rope(&world, links.len() - 1)];
        if self.two_ropes {
            ropes.push(add_rope(&world, 0));
        }
        let (mut mean, mut low, mut high) = (0.0, f64::MAX, f64::MIN);
        for i in 0..5 * self.rate {
            if set.step(&mut world).is_err() {
                return None;
            }
            let pull = |&(x, held): &(f64, _)| x * set.attachment(held).unwrap().force().y;
            let moment = ropes.iter().map(pull).sum::<f64>() / self.moment() - 1.0;
            if i >= 3 * self.rate {
                (mean, low, high) = (mean + moment / (2 * self.rate) as f64, moment.min(low), moment.max(high));
            }
        }
        assert!(gap(&set) < 1e-4, "{self:?}: gap {:.1e}", gap(&set));
        Some([mean, low, high])
    }

    /// Asserts that the mean moment is within 1 % of the weights', and that it ripples by no more than `ripple` (1).
    fn check(&self, ripple: f64) {
        let found = self.run();
        println!("{found:.4?} {self:?}");
        let [mean, low, high] = found.unwrap();
        assert!(mean.abs() < 1e-2 && low > -ripple && high < ripple, "{mean:.4}, {low:.4} to {high:.4}: {self:?}");
    }
}

/// A rope of any damping carries what moments about the shoulder say: links of equal and of different masses that are welded, held
/// straight by a limit, or by two limits that meet; by impulse joints or as a multibody.
///
/// Reference: statics. Newton's iteration of the error-controlled methods once stopped 2 to 4 % beside it, steadily.
#[test]
fn a_damped_rope_carries_an_arm() {
    if is_left_out_in_double() {
        return;
    }
    let settings = [(4, 60), (1, 60), (4, 30), (1, 240)];
    let dampings = [None, Some((1e-3, 0.02)), Some((1e-2, 0.5)), Some((0.0, 0.5)), Some((0.05, 0.0))];
    let mut case = 0;
    for elbow in [Elbow::Welded, Elbow::Limited, Elbow::Locked] {
        for (multibody, damping) in [false, true].into_iter().flat_map(|m| dampings.map(|d| (m, d))) {
            for masses in [&[1.0, 1.0, 1.0][..], &[0.2, 3.0], &[2.0, 0.3, 0.7, 1.5]] {
                let arm = |fidelity, (iterations, rate)| {
                    let (two_ropes, near) = (false, false);
                    Arm { multibody, elbow, masses, damping, fidelity, iterations, rate, two_ropes, near }.check(0.05);
                };
                case += 1;
                arm(Fidelity::Game, settings[case % 4]);
                // without axial damping it rings
                if damping.is_some_and(|(axial, _)| axial > 0.0) && masses.len() != 2 {
                    arm(Fidelity::Engineering, settings[case % 2]);
                }
            }
        }
    }
}

/// Arms of twelve links, and arms on two ropes.
///
/// Reference: statics: the moment of all ropes is that of the weights, however they share it.
#[test]
fn long_arms_and_two_ropes() {
    if is_left_out_in_double() {
        return;
    }
    for (elbow, multibody) in [Elbow::Welded, Elbow::Locked].into_iter().flat_map(|e| [(e, false), (e, true)]) {
        let cases =
            [(&[0.5; 12][..], false), (&[1.0; 3], true), (&[0.3, 2.0], true), (&[2.0, 0.2, 0.2, 5.0, 1.0], true)];
        for ((masses, two_ropes), (iterations, rate)) in cases.into_iter().zip([(4, 60), (4, 60), (1, 30), (2, 120)]) {
            let (damping, fidelity, near) = (Some((5e-3, 0.05)), Fidelity::Game, false);
            let arm = Arm { multibody, elbow, masses, damping, fidelity, iterations, rate, two_ropes, near };
            arm.check(if two_ropes { 2e-3 } else { 0.02 });
            if two_ropes && multibody {
                Arm { fidelity: Fidelity::Engineering, ..arm }.check(2e-3);
            }
        }
    }
}

/// Two ropes on an arm of impulse joints that is near another body, without touching it: its loads are then not predicted, and the
/// ropes ripple.
#[test]
fn two_ropes_on_an_arm_near_a_body() {
    for (multibody, ripple) in [(true, 2e-3), (false, 0.1)] {
        let (damping, fidelity, elbow) = (Some((5e-3, 0.05)), Fidelity::Game, Elbow::Welded);
        let (masses, iterations, rate) = (&[1.0; 3][..], 4, 60);
        let arm = Arm { multibody, elbow, masses, damping, fidelity, iterations, rate, two_ropes: true, near: true };
        let [mean, low, high] = arm.run().unwrap();
        println!("{mean:.4} {low:.4} {high:.4} multibody {multibody}");
        assert!(
            mean.abs() < ripple && low > -ripple && high < ripple,
            "{mean:.4}, {low:.4} to {high:.4}, multibody {multibody}"
        );
    }
}
