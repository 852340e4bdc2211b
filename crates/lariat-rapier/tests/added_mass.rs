//! Added mass that differs along the axes of a body: its mass by direction, Kirchhoff's momentum and energy, Munk's moment, bodies on cables and on joints.

use lariat_ancf::{At, Cable, Fidelity, Flow, Section, Surface, Vector3, Water};
use lariat_rapier::convert::{rotation, to_rotation, vector};
use lariat_rapier::water::{BodiesInWater, Immersed};
use lariat_rapier::{AttachmentKind, CableHandle, CableSet};
use nalgebra::{Matrix3, UnitQuaternion};
use rapier::math::Real;
use rapier::prelude::*;
use std::f64::consts::TAU;

const RHO: f64 = 1000.0;
const STEPS: [f64; 3] = [1.0 / 60.0, 1.0 / 240.0, 1.0 / 1000.0];

/// A world with one box in water.
struct Tank {
    world: PhysicsWorld,
    cables: CableSet,
    body: RigidBodyHandle,
    dt: f64,
    gravity: f64,
    mass: f64,
    added: Vector3<f64>,
}

impl Tank {
    /// A box of half sides in m with a density in kg/m^3 and coefficients of added mass, in water under a gravity in m/s^2.
    fn new(
        body: RigidBodyBuilder,
        (half, density): ([f64; 3], f64),
        (water, immersed, c): (Water, Immersed, [f64; 3]),
        (gravity, dt): (f64, f64),
    ) -> Self {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::new(0.0, -gravity as Real, 0.0);
        world.integration_parameters.dt = dt as Real;
        let [x, y, z] = half.map(|x| x as Real);
        let (body, _) = world.insert(body.can_sleep(false), ColliderBuilder::cuboid(x, y, z).density(density as Real));
        let mut water = BodiesInWater::new(water).unwrap();
        water.insert(&mut world, body, immersed.with_added_mass_along(c)).unwrap();
        let mut cables = CableSet::new();
        cables.set_water(water);
        let volume = 8.0 * half[0] * half[1] * half[2];
        let added = Vector3::from(c) * (RHO.min(density) * volume);
        Tank { world, cables, body, dt, gravity, mass: density * volume, added }
    }

    /// One that nothing but water acts on.
    fn free(body: RigidBodyBuilder, shape: ([f64; 3], f64), c: [f64; 3], dt: f64) -> Self {
        Tank::new(body, shape, (Water::new(RHO), Immersed::default(), c), (0.0, dt))
    }

    fn step(&mut self) {
        self.cables.step(&mut self.world).unwrap();
    }

    fn run(&mut self, seconds: f64) {
        (0..(seconds / self.dt).round() as usize).for_each(|_| self.step());
    }

    fn body(&self) -> &RigidBody {
        &self.world.bodies[self.body]
    }

    fn place(&self) -> Vector3<f64> {
        vector(self.body().translation())
    }

    fn velocity(&self) -> Vector3<f64> {
        vector(self.body().linvel())
    }

    fn attitude(&self) -> UnitQuaternion<f64> {
        rotation(*self.body().rotation())
    }

    /// Mass and added mass in world axes.
    fn masses(&self) -> Matrix3<f64> {
        let turn = self.attitude().to_rotation_matrix();
        turn * Matrix3::from_diagonal(&self.added.add_scalar(self.mass)) * turn.transpose()
    }

    fn momentum(&self) -> Vector3<f64> {
        self.masses() * self.velocity()
    }

    /// Kinetic energy of motion and of rotation, by the moments of inertia of a box.
    fn kinetic(&self, half: [f64; 3]) -> f64 {
        let square = Vector3::from(half).map(|x| x * x / 3.0 * self.mass);
        let moments = Vector3::new(square.y + square.z, square.z + square.x, square.x + square.y);
        let spin = self.attitude().inverse() * vector(self.body().angvel());
        0.5 * self.velocity().dot(&self.momentum()) + 0.5 * spin.dot(&moments.component_mul(&spin))
    }

    /// What the energy of the body and the account of the water add up to.
    fn account(&self, half: [f64; 3]) -> f64 {
        let water = self.cables.water().unwrap();
        let [work, lost] = [water.work(self.body), water.lost_in_substeps(self.body)].map(Option::unwrap);
        self.kinetic(half) + self.mass * self.gravity * self.place().y - work + lost
    }

    /// A cable without weight from a fixed point to the middle of the body.
    fn hang(&mut self, from: Vector3<f64>, length: f64, ea: f64, fidelity: Option<Fidelity>) -> CableHandle {
        let mut line = Cable::builder()
            .points([from, self.place()])
            .length(length)
            .section(Section::from_stiffness(ea, 0.0, 1e-4).unwrap())
            .elements(2)
            .gravity(Vector3::zeros())
            .fix(At::Start);
        if let Some(fidelity) = fidelity {
            line = line.fidelity(fidelity);
        }
        let line = self.cables.insert(line.build().unwrap());
        self.cables.attach(&self.world, line, At::End, self.body, Vector::ZERO, AttachmentKind::Ball).unwrap();
        line
    }
}

fn turned(x: f64, y: f64, z: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_scaled_axis(Vector3::new(x, y, z))
}

fn at(attitude: &UnitQuaternion<f64>) -> RigidBodyBuilder {
    let axis = attitude.scaled_axis();
    RigidBodyBuilder::dynamic().rotation(Vector::new(axis.x as Real, axis.y as Real, axis.z as Real))
}

/// *Source.* Newton's law by axis, v = F t/(m + a_i), and with the attitude kept v = (m + a)^-1 F t of any direction.
#[test]
fn a_neutral_body_has_the_mass_of_the_direction_in_which_it_is_pulled() {
    let (shape, c) = (([0.35, 0.15, 0.55], RHO), [0.15, 1.3, 0.55]);
    for dt in STEPS {
        for pull in [[230.0, 0.0, 0.0], [0.0, -310.0, 0.0], [0.0, 0.0, 170.0], [120.0, 260.0, -190.0]] {
            let askew = pull.iter().all(|x| *x != 0.0);
            let attitude = if askew { turned(0.5, -0.3, 0.8) } else { UnitQuaternion::identity() };
            let start = at(&attitude).lock_rotations();
            let mut tank = Tank::new(start, shape, (Water::new(RHO), Immersed::default(), c), (9.81, dt));
            let force = Vector3::from(pull);
            let body = &mut tank.world.bodies[tank.body];
            body.add_force(Vector::new(pull[0] as Real, pull[1] as Real, pull[2] as Real), true);
            tank.run(1.2);
            let expected = tank.masses().try_inverse().unwrap() * force * 1.2;
            let off = (tank.velocity() - expected).norm() / expected.norm();
            println!("{dt}: {pull:?} {:?}, off by {off:e}", tank.velocity());
            // Rapier rounds the velocity in each step
            let rounding = 0.5 * f64::from(Real::EPSILON) * 1.2 / dt;
            assert!(off < 1e-5 + rounding, "{dt} {pull:?} {off:e}");
        }
    }
}

/// *Source.* Kirchhoff's equations without forces keep v.(m + a) v/2 + W.I W/2 and (m + a) v.
#[test]
fn a_body_on_its_own_keeps_its_momentum_and_energy() {
    let half = [0.25, 0.1, 0.4];
    let mut drifts = Vec::new();
    for dt in STEPS {
        let start = at(&turned(0.2, 0.4, -0.1)).linvel(Vector::new(0.7, 0.3, -0.5)).angvel(Vector::new(0.3, -0.2, 0.4));
        let mut tank = Tank::free(start, (half, 1400.0), [0.3, 1.7, 0.1], dt);
        let (momentum, energy) = (tank.momentum(), tank.kinetic(half));
        let [mut off, mut drift] = [0.0f64; 2];
        for _ in 0..(8.0 / dt) as usize {
            tank.step();
            off = off.max((tank.momentum() - momentum).norm() / momentum.norm());
            drift = drift.max((tank.kinetic(half) / energy - 1.0).abs());
        }
        let end = tank.kinetic(half) / energy - 1.0;
        println!("{dt}: momentum off by {off:e}, energy by {drift:e}, at the end {end:e}");
        drifts.push((off, drift));
    }
    assert!(drifts.iter().all(|(off, _)| *off < 1e-5), "{drifts:?}");
    // Rapier rounds velocities in each step
    let rounding = 8.0 / STEPS[2] * f64::from(Real::EPSILON);
    assert!(drifts[0].1 < 1e-2 && drifts[1].1 < 0.3 * drifts[0].1, "{drifts:?}");
    assert!(drifts[2].1 < 0.3 * drifts[1].1 + rounding, "{drifts:?}");
}

/// *Source.* Lamb 1932, §124: about the way along the axis of the largest mass a body swings with w^2 = P^2 (1/M_s - 1/M_l)/I; along the other
/// its angle grows by exp of as much. Nothing of it depends on a uniform current that takes all along.
#[test]
fn a_body_swings_about_its_broad_side_and_turns_over_from_its_slender_one() {
    let (half, density, angle) = ([0.2, 0.2, 0.7], 1100.0, 0.01);
    let (speed, c) = (1.3, [1.0, 1.0, 0.2]);
    for current in [0.0, 0.8] {
        for dt in STEPS {
            let along = |axis: Vector, attitude: &UnitQuaternion<f64>, current: f64| {
                let flow = Flow::uniform(Vector3::new(0.0, current, 0.0));
                let start = at(attitude).linvel(axis * speed as Real + Vector::Y * current as Real);
                Tank::new(start, (half, density), (Water::new(RHO).with_flow(flow), Immersed::default(), c), (0.0, dt))
            };
            // broadside, askew about y
            let mut tank = along(Vector::X, &turned(0.0, angle, 0.0), current);
            let inertia = tank.mass / 3.0 * (half[0] * half[0] + half[2] * half[2]);
            let [small, large] = [tank.mass + tank.added.z, tank.mass + tank.added.x];
            let relative = |tank: &Tank| tank.velocity() - Vector3::y() * current;
            let momentum = tank.masses() * relative(&tank);
            let rate = momentum.norm() * ((1.0 / small - 1.0 / large) / inertia).sqrt();
            let of = |tank: &Tank| {
                let own = tank.attitude().inverse() * momentum;
                own.z.atan2(own.x)
            };
            let (mut before, mut crossings, mut time) = (of(&tank), Vec::new(), 0.0);
            while crossings.len() < 9 {
                tank.step();
                time += dt;
                let now = of(&tank);
                if before * now <= 0.0 && now != 0.0 {
                    crossings.push(time - dt * now / (now - before));
                }
                before = now;
                assert!(now.abs() < 1.2 * angle, "{now}");
            }
            let found = 0.5 * TAU * 8.0 / (crossings[8] - crossings[0]);
            println!("{current} {dt}: {found} rad/s of {rate}, {:e}", found / rate - 1.0);
            assert!((found / rate - 1.0).abs() < 2e-3 + (rate * dt).powi(2) / 6.0, "{dt} {found} {rate}");
            // end on
            let mut tank = along(Vector::Z, &turned(0.0, 0.1 * angle, 0.0), current);
            let momentum = tank.masses() * relative(&tank);
            let rate = momentum.norm() * ((1.0 / small - 1.0 / large) / inertia).sqrt();
            let of = |tank: &Tank| {
                let own = tank.attitude().inverse() * momentum;
                own.x.atan2(own.z).abs()
            };
            let start = of(&tank);
            tank.run(3.0 / rate);
            let steps = (3.0 / rate / dt).round() * dt;
            let grown = of(&tank) / start / (rate * steps).cosh();
            println!("   grows by {grown} of what it should");
            assert!((grown - 1.0).abs() < 2e-2 + rate * dt, "{dt} {grown}");
            let mut most = 0.0f64;
            for _ in 0..(12.0 / dt / rate) as usize {
                tank.step();
                most = most.max(of(&tank));
            }
            assert!(most > 0.5 * TAU * 0.9, "{most}");
        }
    }
}

/// *Source.* A pendulum in water, T = 2 pi sqrt((m + a_x) l/((rho_b - rho) V g)); heave on a cable, w^2 = k/(m + a_y), k = EA (3 s^2 - 1)/2 l of its
/// stretch s under the weight in water, EA (s^2 - 1) s/2.
#[test]
fn a_body_on_a_cable_swings_and_heaves_with_the_mass_of_its_way() {
    let (half, density, c, g) = ([0.12, 0.2, 0.09], 2600.0, [1.9, 0.4, 1.1], 9.81);
    let volume = 8.0 * half[0] * half[1] * half[2];
    let weight = (density - RHO) * volume * g;
    let period = |tank: &mut Tank, of: fn(&Tank) -> f64, middle: f64| {
        let (mut before, mut time, mut crossings) = (of(tank) - middle, 0.0, Vec::new());
        while crossings.len() < 7 {
            tank.step();
            time += tank.dt;
            let now = of(tank) - middle;
            if before * now <= 0.0 && now != 0.0 {
                crossings.push(time - tank.dt * now / (now - before));
            }
            before = now;
        }
        (crossings[6] - crossings[0]) / 3.0
    };
    for fidelity in [Fidelity::Engineering, Fidelity::Game] {
        for dt in STEPS {
            let water = || (Water::new(RHO), Immersed::default(), c);
            let (length, swing) = (2.3, 0.02f64);
            let place = Vector::new((length * swing.sin()) as Real, -(length * swing.cos()) as Real, 0.0);
            let start = RigidBodyBuilder::dynamic().translation(place).lock_rotations();
            let mut tank = Tank::new(start, (half, density), water(), (g, dt));
            tank.hang(Vector3::zeros(), length, 1e6, Some(fidelity));
            let expected = TAU * ((tank.mass + tank.added.x) * length / weight).sqrt();
            let found = period(&mut tank, |tank| tank.place().x, 0.0);
            println!("{fidelity:?} {dt}: swings in {found} s of {expected}, {:e}", found / expected - 1.0);
            assert!((found / expected - 1.0).abs() < if dt > 0.01 { 2e-2 } else { 1e-2 }, "{found} {expected}");

            let (length, ea) = (1.7, 1.4e4);
            let (mut low, mut high) = (1.0f64, 2.0);
            for _ in 0..60 {
                let s = 0.5 * (low + high);
                if 0.5 * ea * (s * s - 1.0) * s < weight { low = s } else { high = s }
            }
            let stiffness = 0.5 * ea * (3.0 * low * low - 1.0) / length;
            let place = Vector::new(0.0, -(length * low + 0.01) as Real, 0.0);
            let start = RigidBodyBuilder::dynamic().translation(place).lock_rotations();
            let mut tank = Tank::new(start, (half, density), water(), (g, dt));
            tank.hang(Vector3::zeros(), length, ea, Some(fidelity));
            let expected = TAU * ((tank.mass + tank.added.y) / stiffness).sqrt();
            let found = period(&mut tank, |tank| tank.place().y, -length * low);
            println!("   heaves in {found} s of {expected}, {:e}", found / expected - 1.0);
            let coarse = (TAU * dt / expected).powi(2);
            assert!((found / expected - 1.0).abs() < 1e-2 + coarse / 6.0, "{found} {expected}");
        }
    }
}

/// A body with 20 times its mass in added mass on a steel rope, given a blow: on its own, on a slider, and beside a wall that Rapier looks at in each step. It
/// has no more energy than at the beginning, and goes no lower than its rope lets it. Beside a wall it may have more for the one step in which the rope snaps
/// taut: the rope has some energy that all of the mass still has where something else may touch it, too (the force is felt late).
///
/// *Source.* The work-energy theorem: weight in water and rope have potentials, the rest takes.
#[test]
fn a_large_added_mass_on_a_steel_rope_makes_no_energy() {
    let (half, density, g, dt) = ([0.2, 0.1, 0.2], 1200.0, 9.81, 1.0 / 60.0);
    for held in ["free", "slider", "wall"] {
        for c in [[0.0, 24.0, 0.0], [24.0, 0.0, 24.0]] {
            let start = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -3.0, 0.0));
            let water = (Water::new(RHO), Immersed::default(), c);
            let mut tank = Tank::new(start, (half, density), water, (g, dt));
            let rope = tank.hang(Vector3::zeros(), 3.0, 1e7, None);
            let sideways = if held == "slider" { 0.0 } else { 0.3 };
            match held {
                "slider" => {
                    let rail = tank.world.insert_body(RigidBodyBuilder::fixed());
                    let slider = PrismaticJointBuilder::new(Vector::Y).local_anchor1(Vector::new(0.0, -3.0, 0.0));
                    tank.world.insert_impulse_joint(rail, tank.body, slider);
                }
                "wall" => {
                    let wall = RigidBodyBuilder::fixed().translation(Vector::new(0.0, -3.0, 0.2 + 0.1 + 1e-3));
                    tank.world.insert(wall, ColliderBuilder::cuboid(3.0, 3.0, 0.1).friction(0.0));
                }
                _ => {}
            }
            tank.run(1.0);
            let blow = Vector::new(sideways, 0.4, 0.0);
            tank.world.bodies[tank.body].set_linvel(blow, true);
            let volume = 8.0 * half[0] * half[1] * half[2];
            let weight = (density - RHO) * volume * g;
            let energy = |tank: &Tank| {
                let cable = tank.cables.get(rope).unwrap().energy().total();
                tank.kinetic(half) + weight * (tank.place().y + 3.0) + cable
            };
            let given = energy(&tank);
            let [mut most, mut late, mut lowest, mut before] = [0.0f64; 4];
            for step in 0..600 {
                tank.step();
                let now = energy(&tank) / given;
                most = most.max(if held == "wall" { now.min(before) } else { now });
                before = now;
                lowest = lowest.min(tank.place().y);
                if step > 540 {
                    late = late.max(now);
                }
            }
            println!("{held} {c:?}: {given} J, most {most}, at last {late}, lowest {lowest}");
            assert!(most < 1.0 + 5e-3 && lowest > -3.01, "{held} {c:?}: {most} {lowest}");
            assert!(late < 0.95, "{held} {c:?}: {late}");
        }
    }
}

/// *Source.* What is in equilibrium stays: on its cable in a current that turns it, and on a slider with one.
#[test]
fn a_body_that_statics_found_stays_there() {
    for (slides, c) in [(false, [0.5; 3]), (false, [0.2, 1.6, 0.5]), (true, [0.2, 1.6, 0.5])] {
        let current = if slides { 0.0 } else { 0.6 };
        let water = Water::new(RHO).with_flow(Flow::uniform(Vector3::new(current, 0.0, 0.0)));
        let mut start = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -3.0, 0.0));
        if slides {
            start = start.lock_rotations();
        }
        let immersed = Immersed::with_drag_area([0.05, 0.2, 0.1]);
        let mut tank = Tank::new(start, ([0.3, 0.05, 0.2], 2100.0), (water, immersed, c), (9.81, 1.0 / 60.0));
        if slides {
            let rail = tank.world.insert_body(RigidBodyBuilder::fixed());
            tank.world.insert_impulse_joint(rail, tank.body, PrismaticJointBuilder::new(Vector::Y));
        }
        let line = tank.cables.insert(
            Cable::builder()
                .points([Vector3::zeros(), Vector3::new(0.0, -2.95, 0.0)])
                .section(Section::from_stiffness(1e5, 0.0, 1e-3).unwrap())
                .elements(4)
                .gravity(Vector3::zeros())
                .fix(At::Start)
                .build()
                .unwrap(),
        );
        let anchor = Vector::new(0.0, 0.05, 0.0);
        tank.cables.attach(&tank.world, line, At::End, tank.body, anchor, AttachmentKind::Ball).unwrap();
        let found = tank.cables.equilibrium(&mut tank.world).unwrap();
        let place = tank.place();
        let mut moved = 0.0f64;
        for _ in 0..120 {
            tank.step();
            moved = moved.max((tank.place() - place).norm());
        }
        println!(
            "{slides} {c:?}: stable {}, {place}, {:?}, moves by {moved:e}",
            found.is_stable(),
            tank.body().rotation()
        );
        assert!(moved < 2e-6, "{slides} {moved:e}");
    }
}

/// A body on a slider and an elastic cable feels the cable late by a step times M/m_s - 1, which damps it: of first order in the step.
///
/// *Source.* M x'' = -k (x + (M/m_s - 1) h x'), of damping ratio w h (M/m_s - 1)/2, w^2 = k/M.
#[test]
fn a_body_that_is_held_feels_its_cable_late_by_a_share_of_the_step() {
    let (half, density, c, g) = ([0.12, 0.2, 0.09], 2600.0, [0.3, 1.9, 0.8], 9.81);
    let weight = (density - RHO) * 8.0 * half[0] * half[1] * half[2] * g;
    for dt in [1.0 / 120.0, 1.0 / 240.0, 1.0 / 480.0] {
        // a cable that stretches by a thousandth: k = EA/l
        let (length, ea) = (2.0, 1e3 * weight);
        let rest = -length * (1.0 + 1e-3) - 0.5e-3;
        let start = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, rest as Real, 0.0)).lock_rotations();
        let mut tank = Tank::new(start, (half, density), (Water::new(RHO), Immersed::default(), c), (g, dt));
        let rail = tank.world.insert_body(RigidBodyBuilder::fixed());
        tank.world.insert_impulse_joint(rail, tank.body, PrismaticJointBuilder::new(Vector::Y));
        tank.cables.settings.max_rapier_steps = 1;
        tank.hang(Vector3::zeros(), length, ea, None);
        let [all, least] = [tank.mass + tank.added.y, tank.mass + tank.added.min()];
        let rate = (ea / length / all).sqrt();
        let expected = 0.5 * rate * dt * (all / least - 1.0);
        let (mut heights, mut last) = (Vec::new(), [0.0; 3]);
        while heights.len() < 4 {
            tank.step();
            last = [last[1], last[2], tank.place().y];
            let [a, b, c] = last;
            if a != 0.0 && ((b > a && b >= c) || (b < a && b <= c)) {
                heights.push(b + (c - a) * (c - a) / (8.0 * (2.0 * b - a - c)));
            }
        }
        let [one, two] = [heights[1] - heights[0], heights[3] - heights[2]].map(f64::abs);
        let found = (one / two).ln() / TAU;
        println!("{dt}: {found} of {expected}, {heights:?}");
        assert!((found / expected - 1.0).abs() < 0.2, "{found} {expected}");
    }
}

/// *Source.* The work-energy theorem, in a current, at a surface, with drag: an order in the step.
#[test]
fn the_energy_of_a_body_with_mass_by_axes_and_the_work_of_water_balance() {
    let half = [0.2, 0.15, 0.5];
    let flow = || Flow::uniform(Vector3::new(0.4, 0.0, -0.2));
    let sea = || Water::new(RHO).with_surface(Surface::at(0.0, Vector3::new(0.0, -9.81, 0.0)));
    let drag = Immersed { spin_drag: Vector3::repeat(0.01), ..Immersed::with_drag_area([0.05, 0.15, 0.03]) };
    for (what, water, immersed, density, tied) in [
        ("pool", Water::new(RHO), Immersed::default(), 1000.0, false),
        ("current", Water::new(RHO).with_flow(flow()), drag, 1080.0, false),
        ("sea", sea(), drag, 700.0, false),
        ("rope", Water::new(RHO).with_flow(flow()), drag, 1080.0, true),
    ] {
        let mut errors = Vec::new();
        for dt in STEPS {
            let start =
                at(&turned(0.3, 0.2, 0.5)).linvel(Vector::new(0.9, 0.1, 0.4)).angvel(Vector::new(0.0, 0.2, 0.1));
            let start = start.translation(Vector::new(0.0, -0.05, 0.0));
            let set = (water.clone(), immersed, [0.2, 1.4, 0.8]);
            let mut tank = Tank::new(start, (half, density), set, (9.81, dt));
            let line = tied.then(|| tank.hang(Vector3::new(0.0, 2.0, 0.0), 2.0, 2e4, Some(Fidelity::Engineering)));
            let cable = |tank: &Tank| {
                let Some(line) = line else { return 0.0 };
                let line = tank.cables.get(line).unwrap();
                line.energy().total() - line.effect_work().total()
            };
            let (start, held) = (tank.account(half) + cable(&tank), tank.kinetic(half));
            let mut off = 0.0f64;
            for _ in 0..(4.0 / dt) as usize {
                tank.step();
                off = off.max((tank.account(half) + cable(&tank) - start).abs() / held);
            }
            println!("{what} {dt}: off by {off:e} of the kinetic energy of {held} J");
            errors.push(off);
        }
        assert!(errors[0] < 2e-2 && errors[1] < 6e-3 && errors[2] < 2e-3, "{what} {errors:?}");
    }
}

/// *Source.* m v = (m + a_i) v_i' along each axis of the body (von Karman 1929, by direction); what leaves the water keeps its velocity, and has its own mass.
#[test]
fn a_body_comes_into_the_water_with_its_momentum_by_axis() {
    let (half, density, c) = ([0.1, 0.2, 0.15], 2300.0, [0.9, 0.3, 2.1]);
    for dt in STEPS {
        let sea = Water::new(RHO).with_surface(Surface::at(0.0, Vector3::new(0.0, -9.81, 0.0)));
        let start = RigidBodyBuilder::dynamic()
            .translation(Vector::new(0.0, 0.8, 0.0))
            .linvel(Vector::new(2.0, -1.0, -3.0))
            .lock_rotations();
        let mut tank = Tank::new(start, (half, density), (sea, Immersed::default(), c), (9.81, dt));
        let of = |tank: &Tank| tank.cables.water().unwrap().added_mass_along(tank.body);
        let mut before = tank.velocity();
        tank.step();
        assert_eq!(of(&tank), Vector3::zeros());
        assert!((f64::from(tank.body().mass()) / tank.mass - 1.0).abs() < 1e-6);
        while of(&tank) == Vector3::zeros() {
            before = tank.velocity();
            tank.step();
        }
        let expected = (before * tank.mass).component_div(&tank.added.add_scalar(tank.mass));
        let off = tank.velocity() - expected;
        println!("{dt}: {before:?} to {:?}, off by {off:?}", tank.velocity());
        assert!(off.x.abs().max(off.z.abs()) < 2e-6 && off.y.abs() < 9.81 * dt, "{off:?}");
        assert!((of(&tank) - tank.added).norm() < 1e-5 * tank.added.norm());
        assert!((f64::from(tank.body().mass()) / (tank.mass + tank.added.min()) - 1.0).abs() < 1e-6);
        let Tank { mut world, mut cables, body, mass, .. } = tank;
        assert!(cables.water_mut().unwrap().remove(&mut world, body));
        assert!((f64::from(world.bodies[body].mass()) / mass - 1.0).abs() < 1e-6);
    }
}

/// *Source.* Three equal numbers are one; a program that turns a body or sets its velocity has it as it says; a copy goes on as the original.
#[test]
fn equal_axes_are_one_number_and_a_program_may_set_a_body() {
    let sea = || Water::new(RHO).with_surface(Surface::at(0.0, Vector3::new(0.0, -9.81, 0.0)));
    let run = |immersed: Immersed| {
        let mut world = PhysicsWorld::new();
        let start = RigidBodyBuilder::dynamic().rotation(Vector::new(0.3, 0.0, 0.5)).linvel(Vector::new(1.0, 0.0, 0.0));
        let (body, _) = world.insert(start, ColliderBuilder::cuboid(0.3, 0.1, 0.2).density(600.0));
        let mut water = BodiesInWater::new(sea()).unwrap();
        water.insert(&mut world, body, immersed).unwrap();
        let mut cables = CableSet::new();
        cables.set_water(water);
        (0..300).for_each(|_| cables.step(&mut world).unwrap());
        (*world.bodies[body].position(), world.bodies[body].linvel())
    };
    let dragged = Immersed::with_drag_area([0.1, 0.2, 0.1]);
    assert_eq!(run(dragged.with_added_mass(0.7)), run(dragged.with_added_mass_along([0.7; 3])));

    let mut tank = Tank::free(RigidBodyBuilder::dynamic(), ([0.2, 0.1, 0.3], 900.0), [0.1, 2.0, 0.7], 1.0 / 120.0);
    tank.run(0.5);
    let body = &mut tank.world.bodies[tank.body];
    body.set_rotation(to_rotation(&turned(0.7, 0.1, -0.4)), true);
    body.set_linvel(Vector::new(0.4, -0.3, 0.2), true);
    let momentum = tank.momentum();
    tank.step();
    assert!((tank.momentum() - momentum).norm() < 1e-4 * momentum.norm(), "{} {momentum}", tank.momentum());
    let saved = bincode::serialize(&(&tank.world, &tank.cables)).unwrap();
    let (world, cables): (PhysicsWorld, CableSet) = bincode::deserialize(&saved).unwrap();
    let Tank { body, dt, gravity, mass, added, .. } = tank;
    let mut copy = Tank { world, cables, body, dt, gravity, mass, added };
    tank.run(2.0);
    copy.run(2.0);
    assert_eq!(tank.body().position(), copy.body().position());
}
