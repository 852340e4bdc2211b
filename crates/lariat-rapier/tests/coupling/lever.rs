//! Hinged bodies that swing with loads on ropes: a lever, against its equations of motion, and booms, as multibodies and on impulse joints.

use super::common::{cable, gap, is_left_out_in_double};
use lariat_rapier::lariat_ancf::{At, Fidelity, Section, Warning};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};
use nalgebra::{Matrix3, Vector2, Vector3, Vector6};

/// A lever about its middle, and a load on a rope of 1 m at each end.
#[derive(Clone, Copy, Debug)]
struct Lever {
    /// Half its length in m, and its mass in kg.
    half: f64,
    mass: f64,
    loads: [f64; 2],
    multibody: bool,
    fidelity: Fidelity,
    iterations: usize,
    rate: usize,
}

/// Half of the height and of the depth of the lever in m.
const THICKNESS: f64 = 0.03;
const GRAVITY: f64 = 9.81;
const END: f64 = 0.8;

impl Lever {
    /// Returns the time derivative of the angles of lever and ropes, and their rates: ropes are rods without mass.
    fn derivative(&self, x: &Vector6<f64>) -> Vector6<f64> {
        let (lever, along) = (Vector2::new(x[0].cos(), x[0].sin()), Vector2::new(-x[0].sin(), x[0].cos()));
        let inertia = self.mass * (self.half * self.half + THICKNESS * THICKNESS) / 3.0;
        let mut matrix = Matrix3::from_diagonal(&Vector3::new(inertia, 0.0, 0.0));
        // Rapier's own damping of a joint of a multibody about an axis, in N m s
        let damping = if self.multibody { 0.1 } else { 0.0 };
        let mut force = Vector3::new(-damping * x[3], 0.0, 0.0);
        for (i, side) in [1.0, -1.0].into_iter().enumerate() {
            let (angle, rate, m) = (x[1 + i], x[4 + i], self.loads[i]);
            let swing = Vector2::new(angle.cos(), angle.sin());
            // acceleration of the load without those of the angles, less gravity
            let rest = lever * (-side * self.half * x[3] * x[3])
                + Vector2::new(-angle.sin(), angle.cos()) * (rate * rate)
                + Vector2::new(0.0, GRAVITY);
            let moved = [along * (side * self.half), swing];
            for (row, k) in [(0, 0), (1 + i, 1)] {
                force[row] -= m * moved[k].dot(&rest);
                matrix[(row, 0)] += m * moved[k].dot(&moved[0]);
                matrix[(row, 1 + i)] += m * moved[k].dot(&moved[1]);
            }
        }
        let rates = matrix.lu().solve(&force).unwrap();
        Vector6::new(x[3], x[4], x[5], rates[0], rates[1], rates[2])
    }

    /// Returns where the loads are at the end, by the classical Runge-Kutta method.
    fn expected(&self) -> [Vector2<f64>; 2] {
        let (h, mut x) = (1e-4, Vector6::zeros());
        for _ in 0..(END / h).round() as usize {
            let k1 = self.derivative(&x);
            let k2 = self.derivative(&(x + k1 * (0.5 * h)));
            let k3 = self.derivative(&(x + k2 * (0.5 * h)));
            let k4 = self.derivative(&(x + k3 * h));
            x += (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (h / 6.0);
        }
        [(1.0, x[1]), (-1.0, x[2])].map(|(side, angle)| {
            Vector2::new(x[0].cos(), x[0].sin()) * (side * self.half) + Vector2::new(angle.sin(), -angle.cos())
        })
    }

    /// Returns where the loads are at the end, and the largest gap.
    fn run(&self) -> ([Vector2<f64>; 2], f64) {
        let mut world = PhysicsWorld::new();
        world.integration_parameters.num_solver_iterations = self.iterations;
        world.integration_parameters.dt = 1.0 / self.rate as Real;
        let ground = world.insert_body(RigidBodyBuilder::fixed());
        let shape = ColliderBuilder::cuboid(self.half as Real, THICKNESS as Real, THICKNESS as Real);
        let lever = world.insert(RigidBodyBuilder::dynamic().can_sleep(false), shape.mass(self.mass as Real)).0;
        let hinge = RevoluteJointBuilder::new(Vector::Z);
        if self.multibody {
            world.multibody_joints.insert(ground, lever, hinge, true).unwrap();
        } else {
            world.insert_impulse_joint(ground, lever, hinge);
        }
        let mut set = CableSet::new();
        set.settings.fidelity = self.fidelity;
        let section = Section::from_stiffness(1e6, 1e-3, 0.01).unwrap();
        let loads = [1.0, -1.0].into_iter().zip(self.loads).map(|(side, mass)| {
            let x = side * self.half;
            let at = Vector::new(x as Real, -1.0, 0.0);
            let body = RigidBodyBuilder::dynamic().translation(at).can_sleep(false);
            let load = world.insert(body, ColliderBuilder::ball(0.02).mass(mass as Real)).0;
            let rope = set.insert(cable([x, 0.0, 0.0], [x, -1.0, 0.0], section).elements(6).build().unwrap());
            set.attach_here(&world, rope, At::Start, lever, AttachmentKind::Ball).unwrap();
            set.attach_here(&world, rope, At::End, load, AttachmentKind::Ball).unwrap();
            load
        });
        let loads: Vec<_> = loads.collect();
        let mut widest = 0.0f64;
        for _ in 0..(END * self.rate as f64).round() as usize {
            set.step(&mut world).unwrap();
            widest = widest.max(gap(&set));
        }
        let at = |load: RigidBodyHandle| {
            let x = world.bodies[load].translation();
            Vector2::new(f64::from(x.x), f64::from(x.y))
        };
        ([at(loads[0]), at(loads[1])], widest)
    }
}

/// Two loads on a lever move as its equations say: of any masses, by an impulse joint or as a multibody, at 30 to 240 Hz, with one and four
/// solver iterations.
///
/// Reference: the equations of lever and two rods by Runge-Kutta. Ropes that a tenth of a millimetre stretches, and of 0.01 kg, move
/// otherwise by less than 1 %. The gaps are those of a load that is within the lever's bounding box; elsewhere they are rounding errors.
#[test]
fn a_lever_with_two_loads_moves_by_its_equations() {
    let mut wrong = Vec::new();
    for (half, mass, loads) in [(0.5, 2.0, [3.0, 2.0]), (0.3, 0.5, [1.0, 1.4]), (0.8, 10.0, [20.0, 14.0])] {
        for (multibody, fidelity) in [
            (false, Fidelity::Game),
            (true, Fidelity::Game),
            (false, Fidelity::Engineering),
            (true, Fidelity::Engineering),
        ] {
            for (iterations, rate) in [(4, 30), (4, 60), (1, 60), (4, 240)] {
                let lever = Lever { half, mass, loads, multibody, fidelity, iterations, rate };
                let (expected, (found, gap)) = (lever.expected(), lever.run());
                let error = (0..2).map(|i| (found[i] - expected[i]).norm()).fold(0.0, f64::max);
                let start = [half, -half].map(|x| Vector2::new(x, -1.0));
                let way = (0..2).map(|i| (expected[i] - start[i]).norm()).fold(0.0, f64::max);
                println!("{:.4} of {way:.2} m, gap {gap:.1e}: {lever:?}", error / way);
                if error > 0.01 * way || gap > 1e-4 {
                    wrong.push(format!("{:.4} of {way:.2} m, gap {gap:.1e}: {lever:?}", error / way));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A boom of links of 0.6 m that hinges join, level, with a load on a line at its tip.
#[derive(Clone, Copy, Debug)]
struct Boom<'a> {
    links: &'a [f64],
    load: f64,
    fidelity: Fidelity,
    rate: usize,
    /// Time in s.
    end: f64,
}

impl Boom<'_> {
    /// Lets it fall, and returns the path of the load, the largest gap, and whether something is told of steps or energy. Joints of the multibody have no damping, as impulse joints.
    fn fall(&self, multibody: bool) -> (Vec<Vector2<f64>>, f64, bool) {
        let mut world = PhysicsWorld::new();
        world.integration_parameters.dt = 1.0 / self.rate as Real;
        let mut before = world.insert_body(RigidBodyBuilder::fixed());
        for (k, &mass) in self.links.iter().enumerate() {
            let body = RigidBodyBuilder::dynamic().translation(Vector::new(0.3 + 0.6 * k as Real, 0.0, 0.0));
            let shape = ColliderBuilder::cuboid(0.28, 0.03, 0.03).mass(mass as Real);
            let link = world.insert(body.can_sleep(false), shape).0;
            let at = Vector::new(if k == 0 { 0.0 } else { 0.3 }, 0.0, 0.0);
            let hinge =
                RevoluteJointBuilder::new(Vector::Z).local_anchor1(at).local_anchor2(Vector::new(-0.3, 0.0, 0.0));
            let hinge = hinge.contacts_enabled(false);
            if multibody {
                let joint = world.multibody_joints.insert(before, link, hinge, true).unwrap();
                world.multibody_joints.get_mut(joint).unwrap().0.damping_mut().fill(0.0);
            } else {
                world.insert_impulse_joint(before, link, hinge);
            }
            before = link;
        }
        let x = 0.6 * self.links.len() as f64;
        let at = RigidBodyBuilder::dynamic().translation(Vector::new(x as Real, -1.0, 0.0));
        let load = world.insert(at.can_sleep(false), ColliderBuilder::ball(0.02).mass(self.load as Real)).0;
        let mut set = CableSet::new();
        set.settings.fidelity = self.fidelity;
        let section = Section::from_stiffness(1e6, 1e-3, 0.01).unwrap();
        let line = set.insert(cable([x, 0.0, 0.0], [x, -1.0, 0.0], section).elements(6).build().unwrap());
        set.attach_here(&world, line, At::Start, before, AttachmentKind::Ball).unwrap();
        set.attach_here(&world, line, At::End, load, AttachmentKind::Ball).unwrap();
        let (mut path, mut widest) = (Vec::new(), 0.0f64);
        for _ in 0..(self.end * self.rate as f64).round() as usize {
            set.step(&mut world).unwrap();
            let x = world.bodies[load].translation();
            path.push(Vector2::new(f64::from(x.x), f64::from(x.y)));
            widest = widest.max(gap(&set));
        }
        let of_steps = |w: &Warning| matches!(w, Warning::EnergyLost { .. } | Warning::LongSteps { .. });
        (path, widest, set.get(line).unwrap().warnings().iter().any(of_steps))
    }
}

/// A boom of one to three links that falls freely with a load, its line slack at first, moves the same as a multibody and on impulse
/// joints, and no further from its line; or it tells that the steps are too long for its line.
///
/// Reference: each other; and a lever's equations above. Bound: lines that tighten within a step. Where fidelity game does not resolve the vibration of a
/// line that snaps taut, a load that is 1e-4 heavier moves otherwise by a tenth of its way, and the loss of energy is told; fidelity engineering resolves it.
#[test]
fn a_falling_boom_moves_the_same_as_a_multibody_and_on_impulse_joints() {
    if is_left_out_in_double() {
        return;
    }
    let mut wrong = Vec::new();
    for (links, load) in [
        (&[3.0][..], 2.0),
        (&[30.0], 5.0),
        (&[1.0], 8.0),
        (&[2.0, 1.0], 1.0),
        (&[1.0, 3.0], 2.0),
        (&[2.0, 2.0, 2.0], 3.0),
    ] {
        for (fidelity, rate) in [(Fidelity::Game, 60), (Fidelity::Game, 120), (Fidelity::Engineering, 60)] {
            let boom = Boom { links, load, fidelity, rate, end: 0.5 };
            let [(one, gap_one, told_one), (two, gap_two, told_two)] =
                [false, true].map(|multibody| boom.fall(multibody));
            let apart = one.iter().zip(&two).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
            let way = (one[one.len() - 1] - one[0]).norm();
            println!("{:.4} of {way:.2} m, gaps {gap_one:.1e}, {gap_two:.1e}: {boom:?}", apart / way);
            let told = (told_one || told_two) && fidelity == Fidelity::Game;
            if (apart > 0.05 * way || gap_two > gap_one.max(1e-4)) && !told {
                wrong.push(format!("{:.4} of {way:.2} m, gaps {gap_one:.1e}, {gap_two:.1e}: {boom:?}", apart / way));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
