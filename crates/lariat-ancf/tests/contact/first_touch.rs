//! Friction in the step in which a cable first touches.

use crate::bench::{GRAVITY, RADIUS, run, steps, up, with};
use lariat_ancf::contact::{HalfSpace, Obstacle};
use lariat_ancf::{Cable, Contact, Damping, Section, Vector3};

/// A rope of 2 m on a floor whose normal is the y axis, or `height` above it, in steps of 1/`rate` s.
fn flat(mass: f64, friction: f64, (height, velocity, gravity): (f64, Vector3<f64>, Vector3<f64>), rate: f64) -> Cable {
    let cable = Cable::builder()
        .points([up() * (RADIUS + height), Vector3::new(2.0, RADIUS + height, 0.0)])
        .section(Section::from_stiffness(1e6, 0.1, mass).unwrap())
        .elements(20)
        .damping(Damping { axial: 1e-3, bending: 1e-3 })
        .gravity(gravity)
        .velocity(velocity)
        .integrator(steps(rate))
        .build()
        .unwrap();
    let floor = Obstacle::new(1, HalfSpace { normal: up() }, Vector3::zeros(), friction);
    let mut cable = with(cable, vec![floor]);
    cable.set_contact(Contact::with_friction(friction).with_radius(RADIUS)).unwrap();
    cable
}

/// A rope that is put on an incline below the angle of friction stays where it is from the first step on: it slides less than 1 um.
///
/// *Source.* Coulomb's law. The spring of friction gives way by `g sin a m/k_t`, some nm.
#[test]
fn a_rope_put_on_an_incline_below_the_friction_angle_does_not_slide() {
    let mut worst = 0.0f64;
    for (friction, mass) in [(0.1, 0.14), (0.3, 0.014), (0.3, 0.14), (0.3, 1.4), (0.8, 0.14), (1.5, 0.14)] {
        for below in [0.2, 0.5, 2.0] {
            for rate in [60.0, 120.0, 240.0] {
                let angle = f64::atan(friction) - f64::to_radians(below);
                let gravity = GRAVITY * Vector3::new(angle.sin(), -angle.cos(), 0.0);
                let mut cable = flat(mass, friction, (0.0, Vector3::zeros(), gravity), rate);
                let start = cable.node_position(10);
                run(&mut cable, 120, |_| {});
                let made = cable.energy_law().made / (mass * 2.0 * GRAVITY * 1e-3);
                let slid = (cable.node_position(10) - start).x.abs();
                worst = worst.max(slid);
                println!(
                    "mu {friction}, {mass} kg/m, {below} degrees below, 1/{rate} s: {slid:.2e} m, made {made:.0e}"
                );
                assert!(made < 1e-8, "{made:e}");
            }
        }
    }
    assert!(worst < 1e-6, "{worst:e} m");
}

/// A rope that falls flat on a floor while it moves along it loses the speed mu v in the impact, v the speed with which it falls, and then mu g per second.
///
/// *Source.* Coulomb's law for impulses, impact without restitution: all normal impulse up to the time t is m (v + g t).
#[test]
fn an_impact_takes_its_share_of_the_speed_along_the_floor() {
    for (friction, fall) in [(0.2, 1.0), (0.5, 1.0), (0.2, 3.0)] {
        for rate in [60.0, 240.0] {
            let along = 3.0;
            let velocity = Vector3::new(0.6 * along, -fall, 0.8 * along);
            let gravity = -GRAVITY * up();
            let mut cable = flat(0.14, friction, (0.02, velocity, gravity), rate);
            let made = run(&mut cable, 24, |_| {});
            let m = cable.momentum().linear / 0.28;
            let exact = along - friction * (fall + GRAVITY * 0.4 + m.y);
            let speed = m.x.hypot(m.z);
            let d = cable.diagnostics();
            println!(
                "mu {friction}, {fall} m/s, 1/{rate} s: {speed:.4} m/s for {exact:.4}, made {made:.0e}, {} sweeps, {} lagging",
                d.newton_iterations, d.lagging_steps
            );
            assert!(made < 1e-8, "{made:e}");
            assert!((speed - exact).abs() < 0.01 * friction * fall, "{speed} for {exact}");
        }
    }
}
