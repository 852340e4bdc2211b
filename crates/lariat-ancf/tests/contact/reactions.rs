//! Forces on what holds a cable that touches something near it.

use crate::bench::{GRAVITY, RADIUS, up};
use lariat_ancf::contact::{HalfSpace, Obstacle};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{At, Cable, Contact, Motion, Section, Vector3};

/// A rope of 1 kg/m from a pin at a height in radii to a floor, and what bears its weight in N.
fn pinned(elements: usize, height: f64) -> (Cable, Vector3<f64>) {
    let ends = [up() * (height * RADIUS), Vector3::new(1.0, RADIUS, 0.0)];
    let mut cable = Cable::builder()
        .points(ends)
        .section(Section::from_stiffness(2e5, 5e-3, 1.0).unwrap())
        .elements(elements)
        .gravity(up() * -GRAVITY)
        .integrator(crate::bench::steps(240.0))
        .fix(At::Start)
        .build()
        .unwrap();
    cable.set_contact(Contact::with_friction(0.4).with_radius(RADIUS)).unwrap();
    cable.set_obstacles([Obstacle::new(1, HalfSpace { normal: up() }, Vector3::zeros(), 0.5)]).unwrap();
    let weight = up() * (GRAVITY * cable.length());
    (cable, weight)
}

/// What holds a cable and what it touches do not bear of its weight, as a share of it.
fn unborne(cable: &mut Cable, weight: &Vector3<f64>) -> Vector3<f64> {
    let floor: Vector3<f64> = cable.contacts().map(|touch| touch.normal_force * touch.normal + touch.friction).sum();
    let held: Vector3<f64> = cable.reactions().unwrap().iter().map(|reaction| reaction.force).sum();
    assert!((held + cable.pull(0).0).norm() < 1e-9 * weight.norm(), "{held} and {}", cable.pull(0).0);
    (held + floor - weight) / weight.norm()
}

/// What holds a cable at rest and what it touches bear its weight together, after statics, in motion, and drawn along: on coarse meshes the floor
/// begins within the first element.
///
/// *Source.* Balance of forces.
#[test]
fn the_support_and_the_floor_bear_the_weight() {
    for (elements, height) in [(4, 1.0), (20, 1.0), (4, 3.0), (16, 8.0)] {
        let (mut cable, weight) = pinned(elements, height);
        cable.equilibrium().unwrap();
        let mut errors = [unborne(&mut cable, &weight).norm(), 0.0, 0.0];
        (0..240).for_each(|_| cable.step(1.0 / 240.0).unwrap());
        errors[1] = unborne(&mut cable, &weight).norm();
        let drawn = Motion::uniform(cable.time(), cable.node_position(0), Vector3::x() * -0.2);
        cable.set_motion(0, drawn).unwrap();
        (0..480).for_each(|_| cable.step(1.0 / 240.0).unwrap());
        // the end of the hanging part swings and slips: on the mean over a time, with the change of momentum
        let (before, mut sum) = (cable.momentum().linear, Vector3::zeros());
        for _ in 0..960 {
            cable.step(1.0 / 240.0).unwrap();
            sum += unborne(&mut cable, &weight) / 960.0;
        }
        errors[2] = (sum - (cable.momentum().linear - before) / (4.0 * weight.norm())).norm();
        println!("{elements} elements, {height} radii: {errors:?}");
        assert!(errors[0] < 1e-9 && errors[1] < 1e-9 && errors[2] < 2e-3, "{errors:?}");
    }
}
