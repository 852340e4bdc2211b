//! The plugin in an app.

use super::common::{cable_of, soft};
use bevy_app::{App, Update};
use bevy_ecs::prelude::*;
use bevy_ecs::reflect::AppTypeRegistry;
use bevy_reflect::TypeRegistry;
use bevy_time::{Fixed, Time, TimePlugin, TimeUpdateStrategy};
use core::any::TypeId;
use core::time::Duration;
use lariat_bevy::event::CableFailed;
use lariat_bevy::rapier::prelude::ColliderBuilder;
use lariat_bevy::{
    Bending, Body, BodyPose, Cable, CableStep, CableSystems, LariatPlugin, PointLoads, RapierStep, Rule,
};

#[derive(Resource, Default)]
struct Order(Vec<&'static str>);

fn note(name: &'static str) -> impl Fn(ResMut<Order>) {
    move |mut order: ResMut<Order>| order.0.push(name)
}

/// Systems between the stages run where the documentation says.
#[test]
fn user_systems_run_between_the_stages() {
    let mut app = App::new();
    app.add_plugins(LariatPlugin::in_schedule(Update)).init_resource::<Order>();
    app.add_systems(CableStep, note("before").before(CableSystems::Prepare));
    app.add_systems(CableStep, note("after").after(CableSystems::Publish));
    app.add_systems(RapierStep, note("predicted").after(CableSystems::Predict).before(CableSystems::Engine));
    app.add_systems(RapierStep, note("stepped").after(CableSystems::Engine).before(CableSystems::Reconcile));
    let cable = app.world_mut().spawn((soft([0.0; 3], [1.0, 0.0, 0.0]), Bending)).id();
    app.update();
    assert_eq!(app.world().resource::<Order>().0, ["before", "predicted", "stepped", "after"]);
    let time = cable_of(app.world(), cable).time();
    assert!((time - 1.0 / 60.0).abs() < 1e-7);
}

/// In `FixedUpdate` a second of the app is a second of the bodies, whatever its fixed step is.
///
/// *Source.* Free fall of a second: 4.905 m, and half a step more by Rapier's semi-implicit steps of at most the host step.
#[test]
fn a_second_of_an_app_is_one_of_its_bodies() {
    for rate in [30.0, 60.0, 64.0, 120.0] {
        let mut app = App::new();
        app.add_plugins((TimePlugin, LariatPlugin::default()));
        app.insert_resource(Time::<Fixed>::from_hz(rate));
        app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs_f64(1.0 / rate)));
        let ball = Body::dynamic().with(ColliderBuilder::ball(0.1).mass(1.0));
        let ball = app.world_mut().spawn(ball).id();
        // the first update starts the clock
        (0..=rate as usize).for_each(|_| app.update());
        let fallen = -app.world().get::<BodyPose>(ball).unwrap().position.y;
        assert!((4.9..=4.905 * (1.0 + 1.1 / rate)).contains(&fallen), "{rate} Hz: {fallen} m");
    }
}

#[test]
fn messages_of_an_app_are_dropped_after_two_frames() {
    let mut app = App::new();
    app.add_plugins(LariatPlugin::in_schedule(Update));
    app.world_mut().spawn(Cable::steel_rope(-1.0));
    assert_eq!(app.world().resource::<Messages<CableFailed>>().len(), 1);
    for _ in 0..3 {
        app.update();
    }
    assert_eq!(app.world().resource::<Messages<CableFailed>>().len(), 0);
}

#[test]
fn all_effects_are_in_the_type_registry() {
    let mut app = App::new();
    app.init_resource::<AppTypeRegistry>();
    app.add_plugins(LariatPlugin::default());
    let registry = app.world().resource::<AppTypeRegistry>().read();
    let registry: &TypeRegistry = &registry;
    let is_component = |id: TypeId| registry.get_type_data::<ReflectComponent>(id).is_some();
    assert!([TypeId::of::<Rule>(), TypeId::of::<Bending>(), TypeId::of::<PointLoads>()].into_iter().all(is_component));
    macro_rules! check {
        ($({ field: $field:ident, type: $type:ident, $($entry:tt)* })*) => {
            $(assert!(is_component(TypeId::of::<lariat_bevy::$type>()), stringify!($type));)*
        };
    }
    lariat_bevy::lariat_ancf::for_each_effect!(check);
}
