//! Cables that touch rigid bodies, which they move in turn.

use crate::bench::{GRAVITY, MASS, RADIUS, deepest, energies, rope, steps, up, with};
use crate::common::Random;
use lariat_ancf::contact::{Ball, Cuboid, Cylinder, Mount, Obstacle, Surface};
use lariat_ancf::island::{Island, RigidBody};
use lariat_ancf::{At, Cable, Integrator, Section, Vector3};
use nalgebra::{Matrix3, UnitQuaternion};
use std::f64::consts::{FRAC_PI_2, PI};

/// Cables and the bodies that they touch.
pub struct World {
    pub cables: Vec<Cable>,
    pub bodies: Vec<RigidBody>,
    island: Island,
    pub integrator: Integrator,
    largest: f64,
}

impl World {
    pub fn new(cables: Vec<Cable>, bodies: Vec<RigidBody>) -> Self {
        World { cables, bodies, island: Island::default(), integrator: steps(240.0), largest: 1e-12 }
    }

    /// A host step of 1/60 s; returns by how much its energy grew.
    pub fn step(&mut self) -> f64 {
        self.part(1.0 / 60.0)
    }

    /// A host step of a length in s; returns by how much its energy grew.
    pub fn part(&mut self, dt: f64) -> f64 {
        let before = self.energy();
        let mut cables: Vec<&mut Cable> = self.cables.iter_mut().collect();
        self.island.step(&mut cables, &mut self.bodies, &[], self.integrator, dt).unwrap();
        self.energy() - before
    }

    /// Returns the largest growth of energy as a share of the largest energy of motion, strain and contacts.
    pub fn run(&mut self, hosts: usize, mut each: impl FnMut(&World)) -> f64 {
        let mut worst = 0.0f64;
        for _ in 0..hosts {
            worst = worst.max(self.step());
            each(self);
        }
        worst / self.largest
    }

    /// Energy of all, with the store of the method and the potential of the bodies' forces.
    fn energy(&mut self) -> f64 {
        let of_bodies = |b: &RigidBody| b.kinetic_energy() + b.energy_in_store();
        let held: f64 = self.cables.iter().map(|c| energies(c)[1]).chain(self.bodies.iter().map(of_bodies)).sum();
        self.largest = self.largest.max(held);
        let potential: f64 = self.bodies.iter().map(|b| -b.force.dot(&b.position)).sum();
        let bodies: f64 = self.bodies.iter().map(of_bodies).sum();
        self.cables.iter().map(|c| energies(c)[0]).sum::<f64>() + bodies + potential
    }

    pub fn momentum(&self) -> (Vector3<f64>, Vector3<f64>) {
        let cables = self.cables.iter().map(|c| (c.momentum().linear, c.momentum().angular));
        let zero = (Vector3::zeros(), Vector3::zeros());
        cables.chain(self.bodies.iter().map(RigidBody::momentum)).fold(zero, |a, b| (a.0 + b.0, a.1 + b.1))
    }
}

/// A surface on the first body, with its axes.
pub fn on_body(surface: impl Surface + 'static, friction: f64) -> Obstacle {
    let mount = Mount { body: 0, position: Vector3::zeros(), rotation: UnitQuaternion::identity() };
    Obstacle::new(1, surface, Vector3::zeros(), friction).on(mount)
}

fn ball(mass: f64, radius: f64, at: Vector3<f64>) -> RigidBody {
    RigidBody::new(mass, Matrix3::from_diagonal_element(0.4 * mass * radius * radius), at).unwrap()
}

pub fn cube(mass: f64, side: f64, at: Vector3<f64>) -> RigidBody {
    RigidBody::new(mass, Matrix3::from_diagonal_element(mass * side * side / 6.0), at).unwrap()
}

fn heavy(mut body: RigidBody) -> RigidBody {
    body.force = -GRAVITY * body.mass * up();
    body
}

/// Balls of any mass that fall on a rope held at both ends, in its middle or beside it, turning, with friction and without: no energy is made in
/// any host step, and the ball does not pass.
///
/// *Source.* The energy law of the whole.
#[test]
fn a_body_on_a_rope_makes_no_energy() {
    for (mass, friction, aside, spin) in [
        (0.05, 0.0, 0.0, 0.0),
        (1.0, 0.3, 0.2, 5.0),
        (50.0, 0.0, 0.0, 0.0),
        (500.0, 0.3, 0.1, 0.0),
        (0.05, 0.6, 0.3, 40.0),
        (7.0, 1.0, -0.4, -15.0),
    ] {
        let cable = rope(0.1, &[Vector3::new(-1.0, 0.0, 0.0), Vector3::new(1.0, 0.0, 0.0)], 20);
        let cable = cable.fix(At::Start).fix(At::End).build().unwrap();
        let cable = with(cable, vec![on_body(Ball { radius: 0.1 }, friction)]);
        let mut body = heavy(ball(mass, 0.1, Vector3::new(aside, 0.3, 0.0)));
        body.angular_velocity = Vector3::new(0.0, 0.3, 1.0) * spin;
        let mut world = World::new(vec![cable], vec![body]);
        let (mut below, mut touched) = (false, false);
        let made = world.run(90, |world| {
            touched |= world.cables[0].contacts().next().is_some();
            let nearest = (0..41)
                .map(|i| world.cables[0].sample(0.05 * f64::from(i)).unwrap().position - world.bodies[0].position)
                .map(|y| y.norm())
                .fold(f64::INFINITY, f64::min);
            below |= nearest < 0.1 + 0.8 * RADIUS;
        });
        let d = world.cables[0].diagnostics();
        println!(
            "{mass} kg, mu {friction}: made {made:.1e}, {:.1} sweeps/host, split {}, rescaled {}, y {:.3}, deepest now {:.1e}",
            d.newton_iterations as f64 / 90.0,
            d.split_steps,
            d.rescaled_steps,
            world.bodies[0].position.y,
            deepest(&world.cables[0])
        );
        assert!(made < 1e-8 && touched && !below, "{mass}: {made:e} {touched} {below}");
    }
}

/// A body that hits a free rope exchanges momentum and angular momentum with it; momentum is kept to rounding. Of the angular momentum the
/// numerical dissipation of the method takes a share in an impact, which vanishes with the step.
///
/// *Source.* Conservation of momentum and of angular momentum.
#[test]
fn a_body_and_a_free_rope_keep_their_momenta() {
    for (seed, mass) in [(1u64, 0.05), (2, 1.0), (3, 50.0), (4, 500.0), (5, 0.3), (6, 8.0)] {
        let mut random = Random::new(seed);
        let mut vector = |size: f64| Vector3::new(random.next(), random.next(), random.next()) * size;
        let cable = rope(0.1, &[Vector3::new(-1.0, 0.0, 0.0), Vector3::new(1.0, 0.0, 0.0)], 20);
        let cable = cable.gravity(Vector3::zeros()).build().unwrap();
        let cable = with(cable, vec![on_body(Cuboid { half_extents: Vector3::new(0.1, 0.06, 0.2) }, 0.4)]);
        let mut body = cube(mass, 0.2, Vector3::new(0.2, 0.35, 0.0) + vector(0.05));
        body.inertia = Matrix3::from_diagonal(&(Vector3::new(0.043, 0.05, 0.013) * (mass / 3.0)));
        body.rotation = UnitQuaternion::new(vector(1.0));
        body.velocity = Vector3::new(0.0, -4.0, 0.0) + vector(0.5);
        body.angular_velocity = vector(4.0);
        let run = |rate: f64| {
            let mut world = World::new(vec![cable.clone()], vec![body.clone()]);
            world.integrator = steps(rate);
            let (p0, l0) = world.momentum();
            let mut touched = 0;
            let made = world.run(30, |world| touched += usize::from(world.cables[0].contacts().next().is_some()));
            let (p1, l1) = world.momentum();
            let (dp, dl) = ((p1 - p0).norm() / p0.norm(), (l1 - l0).norm() / l0.norm());
            println!(
                "{mass} kg, 1/{rate} s: momentum {dp:.1e}, angular {dl:.1e}, made {made:.1e}, touched in {touched}"
            );
            assert!(touched > 0 && dp < 1e-10 && made < 1e-8, "{mass} {touched} {dp:e} {made:e}");
            dl
        };
        let [coarse, _, fine] = [240.0, 960.0, 3840.0].map(run);
        assert!(coarse < 5e-3 && fine < 1e-5, "{mass}: {coarse:e} {fine:e}");
    }
}

/// A rope with weights over a drum that turns freely, with friction: it hardly slips, and the drum takes the difference of the tensions by the
/// lever of the centre line.
///
/// *Source.* Atwood's machine, `(T1 - T2)(R + r) = I alpha`: what weights and rope lose in height is the energy of the motion v of weights, rope
/// and drum, `1/2 (m + I/(R + r)^2) v^2`.
#[test]
fn a_rope_turns_a_free_drum() {
    let (r, length, piece) = (0.1, 2.0, 0.1);
    for (inertia, mass) in [(0.01, 2.0), (0.05, 5.0), (0.2, 5.0)] {
        let lever = r + RADIUS;
        let around = |a: f64| Vector3::new(-lever * a.cos(), lever * a.sin(), 0.0);
        let mut points = vec![around(0.0) - length * up()];
        points.extend((0..=24).map(|i| around(PI * f64::from(i) / 24.0)));
        points.push(around(PI) - length * up());
        let total = 2.0 * length + PI * lever;
        let section = |mass: f64| Section::from_stiffness(1e6, 1e-3, mass).unwrap();
        let cable = rope(1e-3, &points, 120)
            .length(total)
            .section(section(mass / piece))
            .section_from(piece, section(MASS))
            .section_from(total - piece, section(1.5 * mass / piece));
        let rotation = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2);
        let mount = Mount { body: 0, position: Vector3::zeros(), rotation };
        let drum = Obstacle::new(1, Cylinder { half_height: 0.2, radius: r }, Vector3::zeros(), 0.5).on(mount);
        let cable = with(cable.build().unwrap(), vec![drum]);
        // in whole elements
        let (mut masses, mut rope_mass) = ([0.0; 2], 0.0);
        for (e, element) in cable.elements().iter().enumerate() {
            let own = element.section.mass_per_length * element.length;
            if element.section.mass_per_length > MASS {
                masses[2 * e / cable.elements().len()] += own;
            } else {
                rope_mass += own;
            }
        }
        let mut body = RigidBody::new(3.0, Matrix3::from_diagonal_element(inertia), Vector3::zeros()).unwrap();
        body.free = [false, false, false, false, false, true];
        let mut world = World::new(vec![cable], vec![body]);
        let last = world.cables[0].nodes() - 1;
        let from = world.cables[0].node_position(last).y;
        let made = world.run(30, |_| {});
        let inertial = masses[0] + masses[1] + rope_mass + inertia / (lever * lever);
        let state = |world: &World| {
            let (w, d) = (world.bodies[0].angular_velocity.z, from - world.cables[0].node_position(last).y);
            let v = -w * lever;
            (0.5 * inertial * v * v, (masses[1] - masses[0]) * GRAVITY * d + MASS * GRAVITY * d * d)
        };
        let (k0, p0) = state(&world);
        let mut slip = 0.0f64;
        let more = world.run(24, |world| {
            let speed = -world.cables[0].velocities()[6 * last + 1];
            slip = slip.max((speed / (-world.bodies[0].angular_velocity.z * lever) - 1.0).abs());
        });
        let (k1, p1) = state(&world);
        let off = (k1 - k0) / (p1 - p0) - 1.0;
        println!(
            "I {inertia}, {masses:?} kg: {:.3} % off, speeds by {:.2} %; made {made:.1e} {more:.1e}",
            100.0 * off,
            100.0 * slip
        );
        assert!(off.abs() < 0.02 && slip < 0.05, "{off} {slip}");
        assert!(made < 1e-8 && more < 1e-8, "{made:e} {more:e}");
    }
}

/// A cube of 50 kg that falls 0.5 m on a net of four crossing ropes is caught, and never deeper in a rope than 10 % of its radius.
///
/// *Source.* The energy law; the depth is that of the contacts at every host step. Caught is what two bounces take, 1.5 s: in the third landing the cube of 20 kg
/// rolls over the ropes and off them, at 1/120, 1/240 and 1/480 s.
#[test]
fn four_ropes_catch_a_cube() {
    for (mass, friction, rate) in [(50.0, 0.3, 240.0), (50.0, 0.0, 240.0), (20.0, 0.5, 120.0), (80.0, 0.3, 480.0)] {
        let line = |from: Vector3<f64>, to: Vector3<f64>| {
            let cable = rope(0.1, &[from, to], 20).fix(At::Start).fix(At::End).build().unwrap();
            with(cable, vec![on_body(Cuboid { half_extents: Vector3::repeat(0.25) }, friction)])
        };
        let at = |x: f64, z: f64| Vector3::new(x, 0.0, z);
        let mut cables = Vec::new();
        for offset in [-0.15, 0.15] {
            cables.push(line(at(-1.0, offset), at(1.0, offset)));
            cables.push(line(at(offset, -1.0), at(offset, 1.0)));
        }
        let body = heavy(cube(mass, 0.5, Vector3::new(0.01, 0.25 + 0.5 + RADIUS, 0.02)));
        let mut world = World::new(cables, vec![body]);
        world.integrator = steps(rate);
        let (mut deep, mut lowest, mut hosts) = (0.0f64, f64::INFINITY, 0);
        let made = world.run(120, |world| {
            deep = world.cables.iter().map(deepest).fold(deep, f64::max);
            hosts += 1;
            if hosts <= 90 {
                lowest = lowest.min(world.bodies[0].position.y);
            }
        });
        let body = &world.bodies[0];
        let d = world.cables[0].diagnostics();
        println!(
            "{mass} kg, mu {friction}, 1/{rate} s: deepest {:.2} % of r, lowest {lowest:.3}, now {:.3} m at {:.1e} m/s, made {made:.1e}, {:.1} sweeps/host, {} split",
            100.0 * deep / RADIUS,
            body.position.y,
            body.velocity.norm(),
            d.newton_iterations as f64 / 120.0,
            d.split_steps
        );
        assert!(deep < 0.1 * RADIUS && lowest > 0.0 && made < 1e-8, "{deep} {lowest} {made:e}");
    }
}

/// A body that flies at a slow rope faster than it is thick in a step is stopped by it, or takes it along.
///
/// *Source.* It cannot pass: the rope is never on the other side.
#[test]
fn a_fast_body_does_not_pass_a_slow_rope() {
    for (speed, radius, mass) in [(10.0, 0.05, 0.5), (60.0, 0.1, 0.1), (200.0, 0.2, 0.02), (200.0, 0.1, 5.0)] {
        for aside in [0.0, 0.013] {
            let cable = rope(0.1, &[Vector3::new(-1.0, 0.0, 0.0), Vector3::new(1.0, 0.0, 0.0)], 20);
            let cable = cable.gravity(Vector3::zeros()).build().unwrap();
            let cable = with(cable, vec![on_body(Ball { radius }, 0.3)]);
            let mut body = ball(mass, radius, Vector3::new(aside, 0.37, 0.0));
            body.velocity = -speed * up();
            let mut world = World::new(vec![cable], vec![body]);
            let hosts = (0.75 / speed * 60.0).ceil() as usize;
            let made = world.run(hosts, |_| {});
            let middle = world.cables[0].sample(1.0 + aside).unwrap().position;
            let ahead = world.bodies[0].position.y - middle.y;
            println!("{speed} m/s, {mass} kg: ahead by {ahead:.3} m of {radius}, made {made:.1e}");
            assert!(ahead > radius && made < 1e-8, "{speed} {mass}: {ahead} {made:e}");
        }
    }
}
