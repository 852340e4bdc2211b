//! A rope bridge over which people walk, run and jump: what it carries, and what it costs by counts.

use lariat_rapier::lariat_ancf::{At, Cable, Damping, Diagnostics, Fidelity, Level, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableHandle, CableSet};

const PLANK: f64 = 8.0; // kg
const WALKER: f64 = 80.0; // kg
const PACE: f64 = 1.4; // m/s

/// Planks on two ropes with two anchors each, 0.6 m from the next one, and capsules at one bank.
struct Bridge {
    world: PhysicsWorld,
    cables: CableSet,
    ropes: Vec<CableHandle>,
    ends: Vec<AttachmentHandle>,
    walkers: Vec<RigidBodyHandle>,
    span: f64,
}

impl Bridge {
    fn new(count: u32, walkers: u32) -> Self {
        let (span, length) = (0.6 * f64::from(count), 0.62 * f64::from(count));
        let (mut world, mut cables, mut ends) = (PhysicsWorld::new(), CableSet::new(), Vec::new());
        let bank = world.insert_body(RigidBodyBuilder::fixed());
        for x in [-0.5 * span - 1.5, 0.5 * span + 1.5] {
            let ground = ColliderBuilder::cuboid(1.4, 0.5, 1.5).translation(Vector::new(x as Real, -0.5, 0.0));
            world.insert_collider(ground, Some(bank));
        }
        let apart = InteractionGroups::new(Group::GROUP_1, !Group::GROUP_1, InteractionTestMode::And);
        let (mut planks, mut ropes) = (Vec::new(), Vec::new());
        for z in [-0.5, 0.5] {
            let rope = Cable::builder()
                .name(format!("rope at z = {z} m"))
                .points([Vector3::new(-0.5 * span, 0.0, z), Vector3::new(0.5 * span, 0.0, z)])
                .length(length)
                .section(Section::wire_rope(0.012).unwrap())
                .elements(2)
                .damping(Damping { axial: 0.005, bending: 0.05 })
                .fidelity(Fidelity::Game)
                .fix(At::Start)
                .fix(At::End)
                .build()
                .unwrap();
            let rope = cables.insert(rope);
            ropes.push(rope);
            for plank in 0..count {
                let at = length * f64::from(plank + 1) / f64::from(count + 1);
                if planks.len() < count as usize {
                    let middle = cables.get(rope).unwrap().sample(at).unwrap();
                    let (p, slope) = (middle.position, middle.slope.y.atan2(middle.slope.x));
                    let body = RigidBodyBuilder::dynamic()
                        .translation(Vector::new(p.x as Real, p.y as Real, 0.0))
                        .rotation(Vector::new(0.0, 0.0, slope as Real));
                    let shape = ColliderBuilder::cuboid(0.28, 0.02, 0.6).mass(PLANK as Real).collision_groups(apart);
                    planks.push(world.insert(body.can_sleep(false), shape).0);
                }
                for x in [-0.2, 0.2] {
                    let plank = planks[plank as usize];
                    cables.attach_here(&world, rope, at + x, plank, AttachmentKind::Ball).unwrap();
                }
            }
            for end in [At::Start, At::End] {
                ends.push(cables.attach_here(&world, rope, end, bank, AttachmentKind::Ball).unwrap());
            }
        }
        cables.equilibrium(&mut world).unwrap();
        let capsule = ColliderBuilder::capsule_y(0.6, 0.3).mass(WALKER as Real);
        let capsule = capsule.friction(0.0).friction_combine_rule(CoefficientCombineRule::Min);
        let walker = |number: u32| {
            let place = Vector::new((-0.5 * span - 1.0 - 0.8 * f64::from(number)) as Real, 0.92, 0.0);
            let body = RigidBodyBuilder::dynamic().translation(place).lock_rotations().can_sleep(false);
            world.insert(body, capsule.clone()).0
        };
        let walkers = (0..walkers).map(walker).collect();
        Bridge { world, cables, ropes, ends, walkers, span }
    }

    /// Lets all go on at a pace in m/s, and jump with a speed in m/s if they stand.
    fn step(&mut self, pace: f64, jump: Option<f64>) {
        for walker in &self.walkers {
            let body = &mut self.world.bodies[*walker];
            let fall = body.linvel().y;
            let up = jump.filter(|_| fall.abs() < 0.5).map_or(fall, |speed| speed as Real);
            body.set_linvel(Vector::new(pace as Real, up, 0.0), true);
        }
        self.cables.step(&mut self.world).unwrap();
    }

    /// Places of all in m.
    fn places(&self) -> impl Iterator<Item = f64> {
        self.walkers.iter().map(|walker| f64::from(self.world.bodies[*walker].translation().x))
    }

    /// Weight in N of all that the ends carry.
    fn weight(&self, planks: u32) -> f64 {
        let rope = |rope: &CableHandle| {
            let rope = self.cables.get(*rope).unwrap();
            rope.length() * rope.elements()[0].section.mass_per_length
        };
        let ropes: f64 = self.ropes.iter().map(rope).sum();
        (f64::from(planks) * PLANK + self.walkers.len() as f64 * WALKER + ropes) * 9.81
    }

    /// What the ends carry in N.
    fn lift(&self) -> f64 {
        -self.ends.iter().map(|end| self.cables.attachment(*end).unwrap().force().y).sum::<f64>()
    }

    fn counts(&self) -> Diagnostics {
        *self.cables.get(self.ropes[0]).unwrap().diagnostics()
    }
}

/// While the walker is on the middle of the bridge its ends carry the weight of all, and each host
/// step takes a bounded number of iterations. Prints the mean and the slowest 1 % of host steps.
///
/// *Source.* Statics.
#[test]
fn the_ends_carry_the_walker() {
    let mut bridge = Bridge::new(20, 1);
    let weight = bridge.weight(20);
    let (mut lift, mut walked, mut costs) = (0.0, 0, Vec::new());
    let start = bridge.counts();
    for _ in 0..570 {
        let (clock, before) = (std::time::Instant::now(), bridge.counts());
        bridge.step(PACE, None);
        let after = bridge.counts();
        costs.push((
            clock.elapsed().as_secs_f64() * 1e3,
            after.newton_iterations - before.newton_iterations,
            after.host_steps - before.host_steps,
        ));
        if bridge.places().all(|place| place.abs() < 0.25 * bridge.span) {
            lift += bridge.lift();
            walked += 1;
        }
    }
    let total = bridge.counts();
    println!(
        "iterations {}, factorisations {}, indefinite {}, solves {}, steps {}, Rapier steps {}",
        total.newton_iterations - start.newton_iterations,
        total.factorisations - start.factorisations,
        total.indefinite_factorisations - start.indefinite_factorisations,
        total.solves - start.solves,
        total.steps - start.steps,
        total.host_steps - start.host_steps,
    );
    let mean = costs.iter().map(|cost| cost.0).sum::<f64>() / costs.len() as f64;
    let most = |of: fn(&(f64, u64, u64)) -> u64| costs.iter().map(of).max().unwrap_or(0);
    let (iterations, rapier_steps) = (most(|cost| cost.1), most(|cost| cost.2));
    costs.sort_by(|a, b| a.0.total_cmp(&b.0));
    println!(
        "mean {mean:.2} ms, slowest 1 % {:.2} ms, at most {iterations} iterations in {rapier_steps} Rapier steps",
        costs[costs.len() - 6].0
    );
    let lift = lift / f64::from(walked);
    let place = bridge.places().fold(f64::INFINITY, f64::min);
    println!("the ends carry {lift:.0} N of {weight:.0} N; the walker is at {place:.2} m");
    assert!((lift / weight - 1.0).abs() < 0.05, "{lift} N of {weight} N");
    assert!(place > 0.5 * bridge.span, "{place} m");
}

/// Who runs, jumps, or walks as one of three comes to the other bank of a bridge of 8 to 20 planks, which carries the weight of all on the mean but for
/// what momentum changes in that time, and tells nothing that is wrong.
///
/// *Source.* Statics.
#[test]
fn runners_jumpers_and_three_at_once_cross() {
    let long = std::env::var_os("LARIAT_LONG_TESTS").is_some();
    let cases = [(12, 1, 4.0, None), (8, 2, 2.5, Some(2.0)), (12, 1, 1.4, Some(3.0)), (20, 3, 1.4, None)];
    for (planks, walkers, pace, jump) in cases.into_iter().take(if long { 4 } else { 2 }) {
        let mut bridge = Bridge::new(planks, walkers);
        let weight = bridge.weight(planks);
        let hosts = (60.0 * (bridge.span + 2.0 + 0.8 * f64::from(walkers)) / pace) as usize;
        let (mut lift, mut count, mut most, mut slowest, mut iterations) = (0.0, 0, 0.0f64, 0.0f64, 0);
        for host in 0..hosts {
            let (clock, before) = (std::time::Instant::now(), bridge.counts().newton_iterations);
            bridge.step(pace, jump.filter(|_| host % 45 == 0));
            slowest = slowest.max(clock.elapsed().as_secs_f64() * 1e3);
            iterations = iterations.max(bridge.counts().newton_iterations - before);
            if bridge.places().all(|place| place.abs() < 0.4 * bridge.span) {
                (lift, count) = (lift + bridge.lift(), count + 1);
                most = most.max(bridge.lift());
            }
        }
        let lift = lift / f64::from(count.max(1));
        let place = bridge.places().fold(f64::INFINITY, f64::min);
        println!(
            "{planks} planks, {walkers} at {pace} m/s, jumps {jump:?}: {lift:.0} N of {weight:.0} N, at most {most:.0} N, at {place:.2} m; slowest {slowest:.1} ms, {iterations} iterations"
        );
        assert!(place > 0.5 * bridge.span, "{place} m");
        assert!((lift / weight - 1.0).abs() < 0.2, "{lift} N of {weight} N");
        let told = bridge.cables.warnings(&bridge.world);
        assert!(told.iter().all(|warning| warning.level() != Level::Wrong), "{told:?}");
    }
}
