//! Fast ropes and thin walls.

use crate::bench::{RADIUS, energies, rope, run, with};
use crate::common::Random;
use lariat_ancf::Vector3;
use lariat_ancf::contact::{Cuboid, Obstacle, RigidMotion};

/// A rope at 10 to 200 m/s, flat or tilted, does not pass a wall of 1 mm, and a wall that is as fast does not pass the rope.
///
/// *Source.* Geometry: no node ends behind the wall. Energy: the law.
#[test]
fn a_fast_rope_does_not_pass_a_thin_wall() {
    for speed in [10.0, 50.0, 200.0] {
        for tilt in [0.0, 0.3] {
            for wall_moves in [false, true] {
                let from = Vector3::new(-0.5, 0.6, 0.0);
                let cable = rope(0.1, &[from, from + Vector3::new(1.0, tilt, 0.0)], 10);
                let velocity = Vector3::new(0.0, -speed, 0.0);
                let cable = if wall_moves { cable } else { cable.velocity(velocity) };
                let motion = RigidMotion {
                    velocity: if wall_moves { -velocity } else { Vector3::zeros() },
                    ..RigidMotion::default()
                };
                let wall = Cuboid { half_extents: Vector3::new(5.0, 5e-4, 5.0) };
                let wall = Obstacle::new(7, wall, Vector3::zeros(), 0.3).moving(motion);
                let mut cable = with(cable.build().unwrap(), vec![wall]);
                let start = energies(&cable)[1];
                let mut lowest = f64::INFINITY;
                let made = run(&mut cable, 30, |cable| {
                    let face = motion.velocity.y * cable.time();
                    for node in 0..cable.nodes() {
                        lowest = lowest.min(cable.node_position(node).y - face);
                    }
                });
                println!(
                    "{speed} m/s, tilt {tilt}, {wall_moves}: lowest {lowest:.2e} m, made {made:.1e} (start {start:.0} J), {:.0} sweeps/host, {} split",
                    cable.diagnostics().newton_iterations as f64 / 30.0,
                    cable.diagnostics().split_steps
                );
                assert!(lowest > -RADIUS, "{speed} m/s, {tilt}: {lowest}");
                assert!(made < 1e-8, "{speed} m/s: {made:e}");
            }
        }
    }
}

/// A rope thrown at a box, its edges and corners, from any side and at any speed, is never behind its faces, and gains no energy.
///
/// *Source.* Geometry: no node is in the box by more than a radius.
#[test]
fn a_thrown_rope_does_not_enter_a_box() {
    let mut random = Random::new(23);
    let mut deepest = 0.0f64;
    for i in 0..120 {
        let speed = [3.0, 12.0, 40.0, 120.0][i % 4];
        let (middle, along) = (random.vector() * 0.3, random.vector().normalize() * 0.6);
        let from = (random.vector() + Vector3::y()).normalize();
        let start = middle + from * 1.5;
        let cable = rope(0.05, &[start - along, start + along], 12).velocity(-from * speed).build().unwrap();
        let half = Vector3::new(0.3, 0.2, 0.25);
        let block = Obstacle::new(5, Cuboid { half_extents: half }, Vector3::zeros(), 0.3);
        let mut cable = with(cable, vec![block]);
        let hosts = (60.0 * 3.0 / speed).ceil() as usize + 20;
        let mut inside = 0.0f64;
        let made = run(&mut cable, hosts, |cable| {
            for node in 0..cable.nodes() {
                let x = cable.node_position(node);
                inside = inside.max((half - x.abs()).min());
            }
        });
        deepest = deepest.max(inside);
        assert!(inside < RADIUS, "{i}, {speed} m/s: {inside:.2e} m");
        assert!(made < 1e-8, "{i}, {speed} m/s: {made:e}");
    }
    println!("a node at most {deepest:.1e} m in the box");
}
