//! Effects: components that act on a cable while they are there.

use super::common::{bits, cable_of, pin, soft, steps, world};
use bevy_ecs::prelude::*;
use lariat_bevy::event::CableFailed;
use lariat_bevy::lariat_ancf::{self, Error, PointLoad, RestPiece, Vector3};
use lariat_bevy::{
    At, Attachment, AxialLaw, Bending, Buoyancy, Cable, Damping, Diagnostics, Drag, GravityScale, LineLoads,
    PointLoads, RestShape, Rope, RopeMaterial, Rule, Section, SpawnRope, Torsion,
};

/// Runs host steps and returns the counters of all cables in them.
fn counted(world: &mut World, count: usize) -> lariat_bevy::lariat_ancf::Diagnostics {
    world.resource_mut::<Diagnostics>().reset();
    steps(world, count);
    world.resource::<Diagnostics>().cables
}

#[test]
fn absent_effects_are_never_evaluated() {
    let mut world = world();
    let cable = world.spawn(soft([0.0; 3], [2.0, 0.0, 0.0])).id();
    world.spawn(pin(cable));
    let done = counted(&mut world, 10);
    assert!(done.element_evaluations() > 0);
    let effects = [
        done.bending_evaluations,
        done.effects.damping,
        done.effects.drag,
        done.effects.rest_shape,
        done.load_evaluations,
    ];
    assert_eq!(effects, [0; 5]);
}

#[test]
fn effects_act_from_the_step_after_insertion_to_the_step_after_removal() {
    let mut world = world();
    let cable = world.spawn(soft([0.0; 3], [2.0, 0.0, 0.0])).id();
    world.spawn(pin(cable));
    steps(&mut world, 3);
    world.entity_mut(cable).insert((Bending, Damping::time(1e-3), Drag::air()));
    let rest = vec![RestPiece { from: 0.0, stretch: 1.0001, curvature: 0.1 }];
    world.entity_mut(cable).insert((RestShape::from(rest), PointLoads(vec![PointLoad::force(2.0, Vector3::x())])));
    let on = counted(&mut world, 5);
    assert!(on.bending_evaluations > 0 && on.effects.damping > 0 && on.effects.drag > 0);
    assert!(on.effects.rest_shape > 0 && on.load_evaluations > 0);
    world.entity_mut(cable).remove::<(Bending, Damping, Drag, RestShape, PointLoads)>();
    let off = counted(&mut world, 5);
    assert_eq!((off.bending_evaluations, off.effects.damping, off.effects.drag), (0, 0, 0));
    assert_eq!((off.effects.rest_shape, off.load_evaluations), (0, 0));
    assert!(off.element_evaluations() > 0);
}

/// A free cable falls with the acceleration of its remaining weight.
///
/// *Source.* a = g, g/2, 0, and (rho_c - rho_w) g/(rho_c + C_a rho_w) with added mass (motion
/// across a straight cable).
#[test]
fn gravity_scale_buoyancy_and_line_loads_change_the_weight_of_a_free_cable() {
    let fall = |bundle: fn(&mut EntityWorldMut)| {
        let mut world = world();
        let mut cable = world.spawn(soft([0.0; 3], [2.0, 0.0, 0.0]));
        bundle(&mut cable);
        let cable = cable.id();
        steps(&mut world, 30);
        -cable_of(&world, cable).sample(1.0).unwrap().velocity.y / 0.5
    };
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-5 * 9.81, "{a} {b}");
    near(fall(|_| {}), 9.81);
    near(
        fall(|e| {
            e.insert(GravityScale::new(0.5));
        }),
        4.905,
    );
    near(
        fall(|e| {
            e.insert(Buoyancy::water());
        }),
        9.81 * 3000.0 / 5000.0,
    );
    let weight = std::f64::consts::FRAC_PI_4 * 1e-4 * 4000.0 * 9.81;
    let carried = LineLoads::uniform(Vector3::y() * weight);
    let mut world = world();
    let cable = world.spawn((soft([0.0; 3], [2.0, 0.0, 0.0]), carried)).id();
    steps(&mut world, 30);
    assert!(cable_of(&world, cable).sample(1.0).unwrap().velocity.norm() < 1e-8);
}

#[test]
fn an_invalid_effect_fails_by_name_and_the_cable_keeps_its_previous_effects() {
    let mut world = world();
    let cable = world.spawn(soft([0.0; 3], [2.0, 0.0, 0.0])).id();
    world.spawn(pin(cable));
    steps(&mut world, 2);
    world.entity_mut(cable).insert(Damping::time(f64::NAN));
    steps(&mut world, 1);
    let failures: Vec<CableFailed> = world.resource_mut::<Messages<CableFailed>>().drain().collect();
    assert_eq!(failures.len(), 1);
    let error = &failures[0].error;
    let names_damping =
        matches!(error, Error::InvalidValue { what, value, .. } if what.contains("damping") && value.is_nan());
    assert!(failures[0].entity == cable && names_damping, "{error}");
    let time = cable_of(&world, cable).time();
    assert!((time - 3.0 / 60.0).abs() < 1e-6, "{time}");
}

#[test]
fn components_marked_as_changed_without_a_change_leave_every_bit_alone() {
    let run = |touch: bool| {
        let mut world = world();
        let cable = soft([0.0; 3], [2.0, 0.0, 0.0]);
        let cable = world.spawn((cable, Rule::ST2, Bending, Damping::critical_fraction(0.1), Drag::air())).id();
        world.spawn(pin(cable));
        for _ in 0..20 {
            steps(&mut world, 1);
            if touch {
                world.get_mut::<Drag>(cable).unwrap().set_changed();
                world.get_mut::<Damping>(cable).unwrap().set_changed();
            }
        }
        bits(&world, cable)
    };
    assert!(run(false) == run(true));
}

/// The reference fidelity is explicit on a soft cable, and damping needs an implicit integrator.
#[test]
fn damping_on_an_explicit_cable_changes_the_integrator_and_its_removal_restores_it() {
    let mut world = world();
    let cable = soft([0.0; 3], [2.0, 0.0, 0.0]).elements(4).fidelity(lariat_bevy::lariat_ancf::Fidelity::Reference);
    let cable = world.spawn((cable, Bending)).id();
    world.spawn(pin(cable));
    let integrator = |world: &World| cable_of(world, cable).integrator();
    steps(&mut world, 2);
    let explicit = integrator(&world);
    world.entity_mut(cable).insert(Damping::time(1e-4));
    steps(&mut world, 2);
    assert_ne!(integrator(&world), explicit);
    world.entity_mut(cable).remove::<Damping>();
    steps(&mut world, 2);
    assert_eq!(integrator(&world), explicit);
    assert_eq!(world.resource::<Messages<CableFailed>>().len(), 0);
    assert_eq!(world.resource::<Diagnostics>().failed_steps, 0);
}

/// Damping of a cable without bending stiffness acts on its axial strain alone, whether [`Bending`]
/// was never there or was removed; inserted again, it is damped again.
#[test]
fn a_cable_without_bending_stiffness_is_damped_along_its_axis_alone() {
    let mut world = world();
    let damped = |damping: Damping| (soft([0.0; 3], [2.0, 0.0, 0.0]), damping);
    let limp = [Damping::time(0.01), Damping::critical_fraction(0.3)].map(|d| world.spawn(damped(d)).id());
    let stiff = world.spawn((damped(Damping::time(0.01)), Bending)).id();
    for cable in [limp[0], limp[1], stiff] {
        world.spawn(pin(cable));
    }
    let times = |world: &World, cable: Entity| {
        let damping = cable_of(world, cable).effects().damping.unwrap();
        (damping.axial > 0.0, damping.bending > 0.0)
    };
    steps(&mut world, 10);
    assert_eq!(limp.map(|cable| times(&world, cable)), [(true, false); 2]);
    assert_eq!(times(&world, stiff), (true, true));
    world.entity_mut(stiff).remove::<Bending>();
    steps(&mut world, 10);
    assert_eq!(times(&world, stiff), (true, false));
    assert!(cable_of(&world, stiff).rule().bending == lariat_bevy::lariat_ancf::BendingRule::None);
    world.entity_mut(stiff).insert(Bending);
    steps(&mut world, 10);
    assert_eq!(times(&world, stiff), (true, true));
    let failures: Vec<CableFailed> = world.resource_mut::<Messages<CableFailed>>().drain().collect();
    assert!(failures.is_empty(), "{failures:?}");
    // a time that is not a number stays an error
    let wrong = world.spawn(damped(Damping::time(f64::NAN))).id();
    assert!(world.resource::<lariat_bevy::Cables>().get(wrong).is_err());
}

/// Torsion acts while its component is there: a quarter of a turn of 1 m between clamps has the
/// torque GJ times the twist, a changed component counts from the next step on, and without it there
/// is none.
///
/// *Source.* M = GJ Phi/L; the turns of the motor.
#[test]
fn torsion_is_a_component() {
    let mut world = world();
    let own = |turns: f64| lariat_ancf::Torsion { initial_twist: turns, ..lariat_ancf::Torsion::new(0.02) };
    let cable = world.spawn((soft([0.0; 3], [0.0, -1.0, 0.0]), Bending, Torsion(own(0.25)))).id();
    world.spawn(Attachment::clamp(cable, At::Start).to_world());
    world.spawn(Attachment::clamp(cable, At::End).to_world());
    steps(&mut world, 2);
    let torque = |world: &World| cable_of(world, cable).torsion().first().map(|reading| reading.torque);
    let exact = 0.02 * 0.5 * core::f64::consts::PI;
    assert!((torque(&world).unwrap() / exact - 1.0).abs() < 1e-6, "{:?} of {exact}", torque(&world));
    // a motor that has turned the end on by half a turn, to three quarters in all
    let until = cable_of(&world, cable).time() + 0.25;
    let motor = lariat_ancf::EndSpin::Motor { rate: 2.0, from: until - 0.25, until };
    world.entity_mut(cable).insert(Torsion(lariat_ancf::Torsion { end: motor, ..own(0.25) }));
    steps(&mut world, 60);
    assert!((torque(&world).unwrap() / exact - 3.0).abs() < 1e-6, "{:?} of {}", torque(&world), 3.0 * exact);
    world.entity_mut(cable).remove::<Torsion>();
    steps(&mut world, 1);
    assert_eq!(torque(&world), None);
}

/// Ropes and chains by name, and what `spawn_rope` spawns, have the law of a rope, and keep it when other components come and go; a
/// component of one's own takes its place.
///
/// *Source.* The contract of `Section::of` and `Rope::new`.
#[test]
fn ropes_cannot_push() {
    let mut world = world();
    let law = |world: &World, cable| cable_of(world, cable).effects().axial_law.clone();
    let rope = Some(lariat_ancf::AxialLaw::Rope);
    let of = |section: Section| Cable::new(section).between([0.0; 3], [2.0, 0.0, 0.0]);
    let (nylon, solid) = (RopeMaterial::Nylon.section(0.01).unwrap(), Section::round(0.01, 1e9, 1000.0).unwrap());
    let named = world.spawn(of(nylon)).id();
    let steel = world.spawn(Cable::steel_rope(0.01).between([0.0; 3], [2.0, 0.0, 0.0])).id();
    let plain = world.spawn(of(solid)).id();
    let [usual, stiff] = [Rope::named(RopeMaterial::Nylon, 0.01), Rope::new(solid)]
        .map(|rope| world.spawn_rope([0.0; 3], [2.0, 0.0, 0.0], rope).0);
    for cable in [named, steel, usual, stiff] {
        assert_eq!(law(&world, cable), rope);
        world.entity_mut(cable).insert((Bending, Drag::air()));
        steps(&mut world, 2);
        assert_eq!(law(&world, cable), rope);
        world.entity_mut(cable).remove::<Drag>();
        steps(&mut world, 2);
        assert_eq!(law(&world, cable), rope);
    }
    assert_eq!(law(&world, plain), None);
    world.entity_mut(named).insert(AxialLaw(lariat_ancf::AxialLaw::Hooke));
    steps(&mut world, 1);
    assert_eq!(law(&world, named), Some(lariat_ancf::AxialLaw::Hooke));
}
