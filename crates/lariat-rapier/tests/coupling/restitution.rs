//! Restitution of contacts of cables with colliders.

use lariat_rapier::lariat_ancf::{Cable, Contact, Section, Vector3};
use lariat_rapier::rapier::dynamics::CoefficientCombineRule;
use lariat_rapier::rapier::math::Vector as RVector;
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{CableHandle, CableSet, ContactRules};

const RADIUS: f64 = 5e-3;
const MASS: f64 = 0.4 * 0.14;

/// A stiff bar of 0.4 m that flies along -y, 0.1 m above the plane y = 0, with its own coefficient of restitution; without gravity.
fn bar(cables: &mut CableSet, speed: f64, restitution: f64) -> CableHandle {
    let line = [Vector3::new(-0.2, 0.1 + RADIUS, 0.0), Vector3::new(0.2, 0.1 + RADIUS, 0.0)];
    let bar = Cable::builder()
        .points(line)
        .section(Section::from_stiffness(1e6, 1e3, 0.14).unwrap())
        .elements(2)
        .gravity(Vector3::zeros())
        .velocity(Vector3::new(0.0, -speed, 0.0))
        .build()
        .unwrap();
    let handle = cables.insert(bar);
    let contact = Contact::with_friction(0.3).with_radius(RADIUS).with_restitution(restitution);
    cables.set_contact(handle, contact).unwrap();
    handle
}

/// The speed of the centre of mass along y.
fn speed(cables: &CableSet, bar: CableHandle) -> f64 {
    cables.get(bar).unwrap().momentum().linear.y / MASS
}

/// Restitution is combined by the stronger rule of cable and collider.
///
/// *Source.* `CoefficientCombineRule`, Newton's law of restitution.
#[test]
fn restitution_is_combined_as_rapier_combines_it() {
    for (rule, exact) in [
        (CoefficientCombineRule::Average, 0.5),
        (CoefficientCombineRule::Min, 0.2),
        (CoefficientCombineRule::Multiply, 0.16),
        (CoefficientCombineRule::Max, 0.8),
    ] {
        for host in [1.0 / 30.0, 1.0 / 60.0, 1.0 / 144.0] {
            let mut world = PhysicsWorld::new();
            world.integration_parameters.dt = host as Real;
            world.gravity = RVector::ZERO;
            world.insert_collider(ColliderBuilder::new(SharedShape::halfspace(RVector::Y)).restitution(0.8), None);
            let mut cables = CableSet::new();
            let bar = bar(&mut cables, 1.7, 0.2);
            let rules = ContactRules { restitution_combine_rule: rule, ..ContactRules::default() };
            cables.set_contact_rules(bar, rules).unwrap();
            for _ in 0..(0.2 / host) as usize {
                cables.step(&mut world).unwrap();
            }
            let left = speed(&cables, bar) / 1.7;
            println!("{rule:?}, {host:.4} s: {left:.4} for {exact}");
            assert!((left - exact).abs() < 0.02, "{rule:?}: {left} {exact}");
        }
    }
}

/// A bar that flies against a free body, or one that moves by itself, parts from it with e times the speed with which they met; what a free body gains the bar loses.
///
/// *Source.* Newton's law of restitution, conservation of momentum; rapier's velocities are single precision.
#[test]
fn a_bar_bounces_off_bodies() {
    for (mass, restitution, rising) in [(0.02, 0.6, 0.0), (0.5, 0.8, 0.4), (20.0, 0.3, 0.0), (f64::INFINITY, 0.7, 0.5)]
    {
        for host in [1.0 / 60.0, 1.0 / 100.0] {
            let mut world = PhysicsWorld::new();
            world.integration_parameters.dt = host as Real;
            world.gravity = RVector::ZERO;
            let body = if mass.is_finite() {
                RigidBodyBuilder::dynamic()
            } else {
                RigidBodyBuilder::kinematic_velocity_based()
            };
            let body = body.translation(RVector::new(0.0, -0.15, 0.0)).linvel(RVector::new(0.0, rising as Real, 0.0));
            let shape = ColliderBuilder::cuboid(0.3, 0.1, 0.1)
                .restitution(restitution as Real)
                .restitution_combine_rule(CoefficientCombineRule::Max);
            let shape = if mass.is_finite() { shape.mass(mass as Real) } else { shape };
            let (body, _) = world.insert(body, shape);
            let mut cables = CableSet::new();
            let bar = bar(&mut cables, 2.0, 0.0);
            for _ in 0..(0.2 / host) as usize {
                cables.step(&mut world).unwrap();
            }
            let (own, other) = (speed(&cables, bar), f64::from(world.bodies[body].linvel().y));
            let part = (own - other) / (2.0 + rising);
            println!("{mass} kg, {host:.4} s: part with {part:.4} for {restitution}");
            assert!((part - restitution).abs() < 0.02, "{mass} kg: {part}");
            if mass.is_finite() {
                let lost = MASS * (own + 2.0) + mass * (other - rising);
                assert!(lost.abs() < 1e-6 * (mass + MASS), "{mass} kg: {lost:e} N s");
            }
        }
    }
}
