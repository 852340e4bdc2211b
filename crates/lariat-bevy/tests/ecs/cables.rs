//! Descriptions of cables, and reading cables.

use super::common::{cable_of, cube, height, pin, soft, steps, world};
use approx::assert_relative_eq;
use bevy_ecs::prelude::*;
use lariat_bevy::event::CableFailed;
use lariat_bevy::lariat_ancf::{self, Section};
use lariat_bevy::{At, Attachment, AttachmentReading, Bending, Cable, Cables, Damping, Error, Interpolate, curve};

#[test]
fn a_cable_is_built_when_it_is_spawned() {
    let mut world = world();
    let cable = world.spawn((soft([0.0; 3], [2.0, 0.0, 0.0]).elements(4), Name::new("guy"), Bending)).id();
    let cable = cable_of(&world, cable);
    assert_eq!((cable.positions().len(), cable.velocities().len()), (30, 30));
    assert_eq!(cable.name(), "guy");
    assert_relative_eq!(cable.sample(1.0).unwrap().position.x, 1.0, epsilon = 1e-12);
}

#[test]
fn an_impossible_description_fails_with_its_reason_and_leaves_other_cables_alone() {
    let mut world = world();
    #[derive(Resource, Default)]
    struct Failures(Vec<CableFailed>);
    world.init_resource::<Failures>();
    world.add_observer(|event: On<CableFailed>, mut failures: ResMut<Failures>| failures.0.push(event.event().clone()));
    let bad = world.spawn(Cable::steel_rope(-0.012).between([0.0; 3], [1.0, 0.0, 0.0])).id();
    let shapeless = world.spawn(Cable::steel_rope(0.012)).id();
    let effect = world.spawn((soft([0.0; 3], [1.0, 0.0, 0.0]), Damping::time(-1.0))).id();
    let good = world.spawn(soft([0.0; 3], [1.0, 0.0, 0.0])).id();
    let hold = world.spawn(pin(bad)).id();
    world.spawn(pin(good));
    steps(&mut world, 3);
    let reason = |entity: Entity| match world.resource::<Cables>().get(entity) {
        Err(Error::NotBuilt { entity: of, reason }) if of == entity => reason,
        other => panic!("{other:?}"),
    };
    assert!(matches!(reason(bad), lariat_ancf::Error::InvalidValue { value: -0.012, .. }), "{}", reason(bad));
    assert!(matches!(reason(shapeless), lariat_ancf::Error::TooFewPoints { count: 0, .. }), "{}", reason(shapeless));
    assert!(matches!(reason(effect), lariat_ancf::Error::InvalidValue { value: -1.0, .. }), "{}", reason(effect));
    assert_eq!(world.resource::<Cables>().handle(hold), Err(Error::NotACable(hold)));
    let failed: Vec<Entity> = world.resource::<Failures>().0.iter().map(|event| event.entity).collect();
    assert_eq!(failed, [bad, shapeless, effect]);
    assert_eq!(world.get::<AttachmentReading>(hold).unwrap().force.norm(), 0.0);
    assert!(cable_of(&world, good).time() > 0.0);
}

/// A 12 mm wire rope: 0.59 kg/m, a metallic area of 66.2 mm^2.
///
/// *Source.* EN 12385-4, class 6x36WS-IWRC, nominal diameter 12: 58.9 kg/100 m.
#[test]
fn a_wire_rope_has_the_mass_of_the_standard() {
    let rope = Section::wire_rope(0.012).unwrap();
    assert_relative_eq!(rope.mass_per_length, 0.589, max_relative = 1e-3);
    assert_relative_eq!(rope.axial_stiffness, 66.24e-6 * 1.0e11, max_relative = 1e-3);
}

/// A crate of 50 kg on a steel rope hangs by its weight, and the rope is as much longer as Hooke
/// says.
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
    assert!(reading.gap.norm() < 1e-6, "{}", reading.gap);
    // the rope's own weight hangs on the top besides: 0.147 kg/m
    let rope_weight = 4.09e3 * 0.006f64.powi(2) * 2.0 * 9.81;
    let top = world.get::<AttachmentReading>(top).unwrap().force.y;
    assert_relative_eq!(top, -(weight + rope_weight), max_relative = 2e-3);
    let stretch = (weight + 0.5 * rope_weight) * 2.0 / (1e11 * 0.46 * 0.006f64.powi(2));
    assert_relative_eq!(-2.1 - height(&world, load), stretch, max_relative = 2e-2);
    let tension = cable_of(&world, rope).sample(2.0).unwrap().tension;
    assert_relative_eq!(tension, weight, max_relative = 1e-2);
}

#[test]
fn a_hanging_cable_starts_at_rest() {
    let mut world = world();
    let cable = soft([0.0; 3], [2.0, 0.0, 0.0]).length(2.5).hanging();
    let cable = world.spawn((cable, Bending)).id();
    world.spawn(pin(cable));
    world.spawn(Attachment::ball(cable, At::End).to_world());
    let sag = |world: &World| cable_of(world, cable).sample(1.25).unwrap().position.y;
    let before = sag(&world);
    assert!(before < -0.6, "{before}");
    steps(&mut world, 60);
    assert!((sag(&world) - before).abs() < 1e-5, "{} {before}", sag(&world));
}

/// A length by tension or sag is the same with either, is that by which effects take their shares, and hangs at rest as it says.
///
/// *Source.* Of the parabola, T = w l^2/(8 sag) to (8/3)(sag/l)^2, here 1e-3, and to the strain, 5e-3.
#[test]
fn a_length_is_given_by_tension_or_sag() {
    let (span, weight) = (20.0, core::f64::consts::FRAC_PI_4 * 1e-4 * 4000.0 * 9.81);
    let sag = 0.4;
    let mut world = world();
    let spawn = |world: &mut World, cable: Cable| {
        let rope = world.spawn((cable.elements(20).hanging(), Damping::critical_fraction(0.2))).id();
        world.spawn(pin(rope));
        world.spawn(Attachment::ball(rope, At::End).to_world());
        rope
    };
    let line = || soft([0.0; 3], [span, 0.0, 0.0]);
    let hung = spawn(&mut world, line().sag(sag));
    let (length, tension) = (cable_of(&world, hung).length(), cable_of(&world, hung).sample(10.0).unwrap().tension);
    assert_relative_eq!(tension, weight * span * span / (8.0 * sag), max_relative = 7e-3);
    let ropes = [spawn(&mut world, line().pretension(tension)), hung];
    let fixed = world.spawn((line().elements(20).length(length), Damping::critical_fraction(0.2))).id();
    assert_eq!(cable_of(&world, fixed).effects(), cable_of(&world, ropes[1]).effects());
    assert_relative_eq!(cable_of(&world, ropes[0]).length(), length, max_relative = 2e-5);
    steps(&mut world, 60);
    for rope in ropes {
        let middle = cable_of(&world, rope).sample(0.5 * length).unwrap();
        assert_relative_eq!(-middle.position.y, sag, max_relative = 2e-3);
        assert_relative_eq!(middle.tension, tension, max_relative = 5e-3);
    }
}

#[test]
fn a_curve_passes_through_the_nodes_and_interpolates_between_two_steps() {
    let mut world = world();
    let cable = world.spawn((soft([0.0; 3], [2.0, 0.0, 0.0]).elements(4), Interpolate::default())).id();
    steps(&mut world, 5);
    let before = curve(cable_of(&world, cable), 8);
    steps(&mut world, 1);
    let (cable, interpolate) = (cable_of(&world, cable), world.get::<Interpolate>(cable).unwrap());
    let after = curve(cable, 8);
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
