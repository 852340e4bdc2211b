//! Random worlds of bodies on joints of every kind, with ropes.
//!
//! A tree of one to four bodies of 1 g to 50 t hangs on a fixed or kinematic post by joints: fixed, revolute, spherical, prismatic, rope
//! and spring, impulse joints and multibodies, with motors and limits. One to three ropes tie bodies to each other and to the world.
//! Nothing collides. Fidelity game, host steps of 1/30 to 1/480 s.
//!
//! *Source.* Conservation of energy: with nothing driven, kinetic energy, potentials of gravity, ropes and springs never exceed their sum
//! at the start; and the cables' own account. Worlds that make energy without ropes, too, are Rapier's. Where they make it with ropes
//! alone, because Rapier's joints do not settle, a warning of the level `wrong` says so.

use super::common::{Random, cable, told};
use ::nalgebra::UnitQuaternion;
use lariat_rapier::convert::to_vector;
use lariat_rapier::lariat_ancf::{At, Damping, Fidelity, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Simulated time in s.
const DURATION: f64 = 1.0;
/// Largest energy made, as a share of the largest kinetic energy and change of potentials: that of the hard cases.
const MADE: f64 = 0.01;

/// The kind of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Fixed,
    Revolute,
    Spherical,
    Prismatic,
    Rope,
    Spring,
}

/// A spring: its bodies, rest length in m and stiffness in N/m.
type Spring = ([RigidBodyHandle; 2], f64, f64);

/// A world, and what is known of it.
struct Made {
    world: PhysicsWorld,
    set: CableSet,
    springs: Vec<Spring>,
    /// Whether a motor or a kinematic body does work.
    driven: bool,
    /// Whether a rope or a spring joins a link of a multibody.
    mixed: bool,
    /// Whether a multibody is on a kinematic body that moves.
    moving: bool,
    text: String,
}

/// What a run did.
#[derive(Debug, Default)]
struct Outcome {
    refused: Option<String>,
    not_finite: bool,
    /// Largest energy made over the largest kinetic energy and change of potentials.
    made: f64,
    told: Vec<String>,
    /// Most iterations of a host step.
    iterations: u64,
}

/// Returns a joint with its frames at the middle between two bodies, with motors and limits at random.
fn joint(r: &mut Random, kind: Kind, arm: Vector3<f64>, weight: f64, driven: &mut bool) -> GenericJoint {
    let half = to_vector(&(arm * 0.5));
    let axis = r.one(&[Vector::X, Vector::Y, Vector::Z]);
    let (limited, motor) = (r.between(0.0, 1.0) < 0.3, r.between(0.0, 1.0) < 0.25);
    let length = arm.norm();
    let mut joint: GenericJoint = match kind {
        Kind::Fixed => FixedJointBuilder::new().local_anchor1(half).local_anchor2(-half).into(),
        Kind::Revolute => {
            let joint = RevoluteJointBuilder::new(axis).local_anchor1(half).local_anchor2(-half);
            let joint = if limited { joint.limits([-0.4, 0.7]) } else { joint };
            let (speed, gain) = (r.between(-2.0, 2.0) as Real, (weight * length) as Real);
            if motor { joint.motor_velocity(speed, gain).motor_max_force(3.0 * gain).into() } else { joint.into() }
        }
        Kind::Spherical => SphericalJointBuilder::new().local_anchor1(half).local_anchor2(-half).into(),
        Kind::Prismatic => {
            let joint = PrismaticJointBuilder::new(axis).local_anchor1(half).local_anchor2(-half);
            let reach = (0.5 * length) as Real;
            let joint = if limited || !motor { joint.limits([-reach, reach]) } else { joint };
            let (to, gain) = ((r.between(-0.3, 0.3) * length) as Real, (weight / length) as Real);
            if motor { joint.motor_position(to, 20.0 * gain, 4.0 * gain).into() } else { joint.into() }
        }
        Kind::Rope => facing(RopeJointBuilder::new((length * r.between(1.0, 1.3)) as Real).into(), arm),
        Kind::Spring => unreachable!("made by its caller"),
    };
    *driven |= motor && matches!(kind, Kind::Revolute | Kind::Prismatic);
    joint.set_contacts_enabled(false);
    joint
}

/// Turns the first frame of a joint of coupled axes so that its x axis points along the arm: Rapier 0.36 pushes a body whose x is
/// negative in that frame to x = 0, by 3 m/s that no velocity knows of, with ropes and without.
fn facing(mut joint: GenericJoint, arm: Vector3<f64>) -> GenericJoint {
    let turn = UnitQuaternion::rotation_between(&Vector3::x(), &arm).unwrap_or_else(UnitQuaternion::identity);
    joint.local_frame1 = Pose::new(Vector::ZERO, to_vector(&turn.scaled_axis()));
    joint
}

/// Makes the world of a seed; `ropes` or without.
fn make(seed: u64, ropes: bool) -> Made {
    let mut r = Random::new(seed ^ 0x05ee_d0f3_01d5);
    let mut world = PhysicsWorld::new();
    let rate = r.one(&[30.0, 60.0, 120.0, 240.0, 480.0]);
    world.integration_parameters.dt = (1.0 / rate) as Real;
    let base = r.log(1e-3, 5e4);
    let mut driven = r.between(0.0, 1.0) < 0.2;
    let (multibodies, mut mixed) = (r.between(0.0, 1.0) < 0.4, false);
    let moving = driven && multibodies;
    let post = match driven {
        true => RigidBodyBuilder::kinematic_velocity_based().linvel(Vector::new(0.2, 0.0, 0.1)).angvel(Vector::Z * 0.3),
        false => RigidBodyBuilder::fixed(),
    };
    let mut bodies = vec![world.insert_body(post)];
    let (mut places, mut masses) = (vec![Vector3::zeros()], vec![base]);
    let (mut springs, mut text) = (Vec::new(), format!("{rate}/s, driven post {driven}:"));
    for _ in 0..r.one(&[1, 2, 3, 4]) {
        let parent = r.one(&(0..bodies.len()).collect::<Vec<_>>());
        let mass = (base * r.log(0.05, 20.0)).clamp(1e-3, 5e4);
        let half = 0.5 * (mass / 500.0).cbrt();
        let reach = (1.5 + r.between(0.0, 3.0)) * 2.0 * half.max(0.5 * (base / 500.0).cbrt());
        let direction = Vector3::new(r.between(-1.0, 1.0), r.between(-1.0, 0.3), r.between(-1.0, 1.0));
        let arm = direction.try_normalize(1e-3).unwrap_or(Vector3::x()) * reach;
        let place = places[parent] + arm;
        let collider = ColliderBuilder::cuboid(half as Real, half as Real, half as Real).mass(mass as Real);
        let collider = collider.collision_groups(InteractionGroups::none());
        let body = RigidBodyBuilder::dynamic().translation(to_vector(&place)).can_sleep(false);
        let body = world.insert(body, collider).0;
        let kinds = [Kind::Fixed, Kind::Revolute, Kind::Spherical, Kind::Prismatic, Kind::Rope, Kind::Spring];
        let kind = r.one(&kinds);
        let weight = mass * 9.81;
        let multibody = multibodies && !matches!(kind, Kind::Rope | Kind::Spring);
        mixed |= multibodies && !multibody;
        if kind == Kind::Spring {
            let (rest, stiffness) = (reach * r.between(0.8, 1.1), weight / reach * r.log(5.0, 200.0));
            let damping = r.one(&[0.0, 0.05]) * 2.0 * (stiffness * mass).sqrt();
            let spring = SpringJointBuilder::new(rest as Real, stiffness as Real, damping as Real);
            let spring = spring.spring_model(MotorModel::ForceBased).contacts_enabled(false);
            world.insert_impulse_joint(bodies[parent], body, facing(spring.into(), arm));
            springs.push(([bodies[parent], body], rest, stiffness));
        } else {
            let joint = joint(&mut r, kind, arm, weight, &mut driven);
            if !multibody || world.multibody_joints.insert(bodies[parent], body, joint, true).is_none() {
                world.insert_impulse_joint(bodies[parent], body, joint);
            }
        }
        text += &format!(" {mass:.3} kg {kind:?}{} on {parent},", if multibody { " multibody" } else { "" });
        bodies.push(body);
        places.push(place);
        masses.push(mass);
    }
    let mut set = CableSet::new();
    set.settings.fidelity = Fidelity::Game;
    for _ in 0..r.one(&[1, 2, 3]) {
        let one = r.one(&(1..bodies.len()).collect::<Vec<_>>());
        let other = r.one(&(0..bodies.len()).collect::<Vec<_>>());
        // to another body, or to a point of the world above
        let height = Vector3::new(r.between(-1.0, 1.0), r.between(0.5, 2.0), r.between(-1.0, 1.0));
        let reach = (masses[one] / 500.0).cbrt();
        let end = if other == one { places[one] + height * (3.0 * reach) } else { places[other] };
        let distance = (end - places[one]).norm();
        let weight = masses[one] * 9.81;
        let stiffness = weight / r.log(1e-4, 3e-2);
        let of_rope = masses[one] * r.log(1e-3, 0.2);
        let slack = r.one(&[1.0, 1.05, 1.3]);
        let length = distance * slack;
        let section =
            Section::from_stiffness(stiffness, stiffness * distance.powi(2) * r.log(1e-8, 1e-6), of_rope / length);
        let wave = (stiffness * length / of_rope).sqrt();
        let time = r.one(&[0.0, 0.02, 0.1]) * 2.0 * length / (std::f64::consts::PI * wave);
        let elements = r.one(&[4, 6, 10]);
        text += &format!(" rope {one}-{other} EA {stiffness:.3e} N, {of_rope:.3e} kg, {length:.3} m,");
        if !ropes {
            continue;
        }
        let rope = cable(places[one], end, section.unwrap()).length(length).elements(elements);
        let rope = if time > 0.0 { rope.damping(Damping { axial: time, bending: time }) } else { rope };
        let rope = set.insert(rope.build().unwrap());
        set.attach_here(&world, rope, At::Start, bodies[one], AttachmentKind::Ball).unwrap();
        if other == one {
            set.get_mut(rope).unwrap().fix(At::End).unwrap();
        } else {
            set.attach_here(&world, rope, At::End, bodies[other], AttachmentKind::Ball).unwrap();
        }
    }
    Made { world, set, springs, driven, mixed, moving, text }
}

impl Made {
    /// Returns kinetic energy, and potentials of gravity, strain and springs, in J.
    fn energy(&self) -> [f64; 2] {
        let energy = self.set.energy(&self.world).unwrap();
        let at = |body: RigidBodyHandle| lariat_rapier::convert::vector(self.world.bodies[body].translation());
        let of = |([a, b], rest, stiffness): &Spring| 0.5 * stiffness * ((at(*a) - at(*b)).norm() - rest).powi(2);
        let springs: f64 = self.springs.iter().map(of).sum();
        let kinetic = energy.cables.kinetic + energy.bodies_kinetic;
        [kinetic, energy.total() - kinetic + springs]
    }

    /// Returns the iterations of all cables so far.
    fn iterations(&self) -> u64 {
        self.set.iter().map(|(_, cable)| cable.diagnostics().newton_iterations).sum()
    }

    fn run(&mut self) -> Outcome {
        let mut outcome = Outcome::default();
        let [kinetic, potential] = self.energy();
        let start = kinetic + potential;
        let (mut most, mut scale) = (0.0f64, 1e-9 * potential.abs());
        let dt = f64::from(self.world.integration_parameters.dt);
        for _ in 0..(DURATION / dt).round() as usize {
            let before = self.iterations();
            if let Err(error) = self.set.step(&mut self.world) {
                outcome.refused = Some(error.to_string());
                break;
            }
            outcome.iterations = outcome.iterations.max(self.iterations().saturating_sub(before));
            let [kinetic, now] = self.energy();
            if !(kinetic + now).is_finite() {
                outcome.not_finite = true;
                break;
            }
            most = most.max(kinetic + now - start);
            scale = scale.max(kinetic).max((now - potential).abs());
        }
        outcome.made = if scale > 0.0 { most / scale } else { 0.0 };
        let handles: Vec<CableHandle> = self.set.iter().map(|(handle, _)| handle).collect();
        if !handles.is_empty() {
            outcome.told = told(&self.set, &self.world);
        }
        outcome
    }
}

/// Runs worlds, and returns what is wrong with them, and the most iterations of a host step.
fn run(seeds: std::ops::Range<u64>) -> (Vec<String>, u64) {
    let (mut wrong, mut warned, mut most, mut refused, mut of_rapier) = (Vec::new(), Vec::new(), 0, 0, 0);
    for seed in seeds {
        let mut made = make(seed, true);
        let outcome = match catch_unwind(AssertUnwindSafe(|| made.run())) {
            Ok(outcome) => outcome,
            Err(panic) => {
                let text = panic.downcast_ref::<String>().cloned().unwrap_or_default();
                wrong.push(format!("{seed}: panic {text}: {}", made.text));
                continue;
            }
        };
        most = most.max(outcome.iterations);
        let mut faults = Vec::new();
        // what Rapier does not solve as one system, as the error says: multibodies that impulse joints
        // hold, too, or that a moving kinematic body carries
        let known = |text: &&String| (made.mixed || made.moving) && text.contains("use impulse joints");
        refused += u32::from(outcome.refused.as_ref().is_some_and(|text| known(&text)));
        faults.extend(outcome.refused.as_ref().filter(|text| !known(text)).map(|text| format!("refused: {text}")));
        faults.extend(outcome.not_finite.then(|| "not finite".to_string()));
        if outcome.told.iter().any(|name| name.contains("EnergyMade")) {
            faults.push("by its own account, energy is made".to_string());
        }
        if !made.driven && outcome.made > MADE {
            let alone = make(seed, false).run();
            let serious = outcome.told.iter().any(|name| name.starts_with("wrong"));
            if alone.made > MADE {
                of_rapier += 1;
            } else if serious {
                warned.push(format!("{seed}: {:.3}", outcome.made));
            } else {
                faults.push(format!("energy made {:.4}, without ropes {:.4}", outcome.made, alone.made));
            }
        }
        println!("{seed}: made {:.1e}, {} iterations, {:?} {faults:?}", outcome.made, outcome.iterations, outcome.told);
        if !faults.is_empty() {
            wrong.push(format!("{seed}: {}: {} told {:?}", faults.join("; "), made.text, outcome.told));
        }
    }
    println!("{refused} worlds whose multibodies impulse joints or moving bodies hold are refused, with this reason");
    println!("{of_rapier} worlds make energy without ropes, too; with ropes alone, and warned of: {warned:?}");
    (wrong, most)
}

/// Time in s over which the ways of bodies are compared: a swing.
const PATH: f64 = 0.5;
/// Share of its way by which a body that a rope holds may be off, and by which references may differ that say so.
const OFF: [f64; 2] = [0.1, 0.01];

/// Runs a world in steps that are `finer` times shorter, and returns where the bodies of its ropes are at each of its own host steps, and what is told.
/// What is refused is told, by its error.
fn paths(seed: u64, ropes: bool, finer: u32) -> (Vec<Vec<Vector3<f64>>>, Vec<String>, String) {
    let Made { mut world, mut set, text, .. } = make(seed, ropes);
    let held = make(seed, true);
    let bodies: Vec<_> = held
        .set
        .attachments()
        .filter_map(|(_, a)| Some(a.body()).filter(|b| held.world.bodies[*b].is_dynamic()))
        .collect();
    let steps = (PATH / f64::from(world.integration_parameters.dt)).round() as u32;
    world.integration_parameters.dt /= finer as Real;
    let (mut places, mut told_of) = (Vec::new(), Vec::new());
    for step in 0..steps * finer {
        if let Err(error) = set.step(&mut world) {
            told_of.push(format!("wrong {error}"));
            break;
        }
        if (step + 1) % finer == 0 {
            places.push(bodies.iter().map(|body| super::common::place(&world, *body)).collect());
        }
    }
    if ropes {
        told_of.extend(told(&set, &world));
    }
    (places, told_of, text)
}

/// Returns the largest distance of two runs as a share of the way of the second.
fn off(one: &[Vec<Vector3<f64>>], other: &[Vec<Vector3<f64>>]) -> f64 {
    let bodies = other.first().map_or(0, Vec::len);
    let of = |body: usize| {
        let way = |a: &Vec<Vector3<f64>>| (a[body] - other[0][body]).norm();
        let way = other.iter().map(way).fold(0.0, f64::max);
        let distance = one.iter().zip(other).map(|(a, b)| (a[body] - b[body]).norm()).fold(0.0, f64::max);
        distance / way.max(1e-3)
    };
    (0..bodies).map(of).fold(0.0, f64::max)
}

/// Bodies on joints and ropes are within a tenth of their way of the same world in steps of a sixteenth, or it is told.
///
/// Where steps of an eighth and of a sixteenth do not agree nothing is known, and where Rapier is off without ropes, too, it is not theirs: another
/// world is looked at.
#[test]
fn worlds_on_joints_move_as_in_fine_steps_or_tell() {
    // known: of ropes that snap taut, which most are, energy lost is told as coarse
    super::common::judge(0..20, 0.5, |seed| {
        for other in 0..20 {
            let seed = seed + 1_000_000 * other;
            let fine = [8, 16].map(|finer| paths(seed, true, finer).0);
            let alone = || off(&paths(seed, false, 1).0, &paths(seed, false, 16).0);
            if off(&fine[0], &fine[1]) > OFF[1] || fine[0].len() != fine[1].len() || alone() > OFF[0] {
                continue;
            }
            let (found, told, text) = paths(seed, true, 1);
            let error = off(&found, &fine[1]);
            return (
                error > OFF[0] || !error.is_finite(),
                told.clone(),
                format!("{seed}: {error:.3}, told {told:?}: {text}"),
            );
        }
        panic!("{seed}: no world of twenty is determined");
    });
}

fn judge_worlds(seeds: std::ops::Range<u64>) {
    let asked = std::env::var("LARIAT_SEEDS").ok();
    let asked = asked.as_deref().and_then(|range| range.split_once(".."));
    let range = asked.and_then(|(from, to)| Some(from.parse().ok()?..to.parse().ok()?)).unwrap_or(seeds);
    let count = range.end - range.start;
    let (wrong, most) = run(range);
    println!("{} of {count} worlds are wrong; at most {most} iterations in a host step", wrong.len());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn worlds_on_joints_make_no_energy() {
    judge_worlds(0..20);
}

#[test]
#[ignore = "200 worlds take minutes"]
fn many_worlds_on_joints_make_no_energy() {
    judge_worlds(1000..1200);
}
