//! Describing, building and reading cables.

use super::bench::{cube, height, pin, soft, steps, world};
use approx::assert_relative_eq;
use bevy_ecs::prelude::*;
use lariat_bevy::event::CableFailed;
use lariat_bevy::lariat_ancf::Section;
use lariat_bevy::{At, Attachment, AttachmentReading, Bending, Cable, Damping, Error, Interpolate};

#[test]
fn a_cable_is_built_where_it_is_spawned() {
    let mut world = world();
    let cable = world.spawn((soft([0.0; 3], [2.0, 0.0, 0.0]).elements(4), Name::new("guy"), Bending));
    let cable = cable.get::<Cable>().unwrap();
    assert_eq!((cable.positions().len(), cable.velocities().len()), (30, 30));
    assert_eq!(cable.core().unwrap().name(), "guy");
    assert_relative_eq!(cable.sample(1.0).unwrap().position.x, 1.0, epsilon = 1e-12);
    assert!(matches!(cable.sample(3.0), Err(Error::Cable(_))));
}

#[test]
fn a_description_that_makes_no_sense_says_why_and_harms_nothing() {
    let mut world = world();
    #[derive(Resource, Default)]
    struct Told(Vec<CableFailed>);
    world.init_resource::<Told>();
    world.add_observer(|event: On<CableFailed>, mut told: ResMut<Told>| told.0.push(event.event().clone()));
    let bad = world.spawn(Cable::steel_rope(-0.012).between([0.0; 3], [1.0, 0.0, 0.0])).id();
    let shapeless = world.spawn(Cable::steel_rope(0.012)).id();
    let effect = world.spawn((soft([0.0; 3], [1.0, 0.0, 0.0]), Damping::time(-1.0))).id();
    let good = world.spawn(soft([0.0; 3], [1.0, 0.0, 0.0])).id();
    let hold = world.spawn(pin(bad)).id();
    world.spawn(pin(good));
    steps(&mut world, 3);
    let failure = world.get::<Cable>(bad).unwrap().failure().unwrap().to_string();
    assert!(failure.contains("-0.012"), "{failure}");
    assert!(world.get::<Cable>(shapeless).unwrap().failure().unwrap().to_string().contains("2 points"));
    assert!(world.get::<Cable>(bad).unwrap().positions().is_empty());
    let told: Vec<Entity> = world.resource::<Told>().0.iter().map(|event| event.entity).collect();
    assert_eq!(told, [bad, shapeless, effect]);
    assert_eq!(world.get::<AttachmentReading>(hold).unwrap().force.norm(), 0.0);
    assert!(world.get::<Cable>(good).unwrap().core().unwrap().time() > 0.0);
}

/// A 12 mm wire rope: 0.59 kg/m, a metallic area of 66.2 mm^2.
///
/// *Source.* EN 12385-4, class 6x36WS-IWRC, nominal diameter 12: 58.9 kg/100 m.
#[test]
fn a_wire_rope_weighs_what_the_standard_says() {
    let rope = Section::wire_rope(0.012).unwrap();
    assert_relative_eq!(rope.mass_per_length, 0.589, max_relative = 1e-3);
    assert_relative_eq!(rope.axial_stiffness, 66.24e-6 * 1.0e11, max_relative = 1e-3);
}

/// A crate of 50 kg on a steel rope hangs by its weight, and the rope is as much longer as Hooke says.
///
/// *Source.* N = m g; N L/EA.
#[test]
fn a_crate_hangs_by_its_weight() {
    let mut world = world();
    let load = world.spawn(cube(0.1, 50.0, [0.0, -2.1, 0.0])).id();
    let rope = Cable::steel_rope(0.006).between([0.0; 3], [0.0, -2.0, 0.0]);
    let rope = world.spawn((rope, Bending, Damping::critical_fraction(0.2))).id();
    let top = world.spawn(pin(rope)).id();
    let hook = world.spawn(Attachment::ball(rope, At::End).to(load).at([0.0, 0.1, 0.0])).id();
    steps(&mut world, 480);
    let weight = 50.0 * 9.81;
    let reading = *world.get::<AttachmentReading>(hook).unwrap();
    assert_relative_eq!(reading.force.y, weight, max_relative = 1e-3);
    assert!(reading.gap < 1e-6, "{}", reading.gap);
    // the rope's own weight hangs on the top besides: 0.147 kg/m
    let rope_weight = 4.09e3 * 0.006f64.powi(2) * 2.0 * 9.81;
    let top = world.get::<AttachmentReading>(top).unwrap().force.y;
    assert_relative_eq!(top, -(weight + rope_weight), max_relative = 2e-3);
    let stretch = (weight + 0.5 * rope_weight) * 2.0 / (1e11 * 0.46 * 0.006f64.powi(2));
    assert_relative_eq!(-2.1 - height(&world, load), stretch, max_relative = 2e-2);
    let tension = world.get::<Cable>(rope).unwrap().sample(2.0).unwrap().tension;
    assert_relative_eq!(tension, weight, max_relative = 1e-2);
}

#[test]
fn a_hanging_cable_starts_at_rest() {
    let mut world = world();
    let cable = soft([0.0; 3], [2.0, 0.0, 0.0]).length(2.5).hanging();
    let cable = world.spawn((cable, Bending)).id();
    world.spawn(pin(cable));
    world.spawn(Attachment::ball(cable, At::End).to_world());
    let sag = |world: &World| world.get::<Cable>(cable).unwrap().sample(1.25).unwrap().position.y;
    let before = sag(&world);
    assert!(before < -0.6, "{before}");
    steps(&mut world, 60);
    assert!((sag(&world) - before).abs() < 1e-5, "{} {before}", sag(&world));
}

#[test]
fn a_curve_passes_through_the_nodes_and_lies_between_two_steps() {
    let mut world = world();
    let cable = world.spawn((soft([0.0; 3], [2.0, 0.0, 0.0]).elements(4), Interpolate::default())).id();
    steps(&mut world, 5);
    let before = world.get::<Cable>(cable).unwrap().curve(8);
    steps(&mut world, 1);
    let (cable, interpolate) = (world.get::<Cable>(cable).unwrap(), world.get::<Interpolate>(cable).unwrap());
    let after = cable.curve(8);
    assert_eq!(after.len(), 33);
    for (i, node) in cable.positions().chunks(6).enumerate() {
        assert_eq!(after[8 * i].as_slice(), &node[..3]);
    }
    let close = |a: &[lariat_bevy::lariat_ancf::Vector3<f64>], b: &[lariat_bevy::lariat_ancf::Vector3<f64>]| {
        a.iter().zip(b).all(|(a, b)| (a - b).norm() < 1e-14)
    };
    assert!(close(&interpolate.curve(cable, 0.0, 8), &before));
    assert!(close(&interpolate.curve(cable, 1.0, 8), &after));
    let half = interpolate.curve(cable, 0.5, 8);
    assert!(half.iter().zip(before.iter().zip(&after)).all(|(h, (a, b))| (h - 0.5 * (a + b)).norm() < 1e-14));
}
