//! What is told of contacts between cables that are not as they would be.

use crate::bench::{GRAVITY, rope, steps, up};
use crate::bodies::World;
use lariat_ancf::{At, Cable, Contact, PointLoad, Section, Vector3, Warning, Watch};

/// Radius of the ropes in m.
const RADIUS: f64 = 0.01;

fn touching(mut cable: Cable, friction: f64, restitution: f64) -> Cable {
    let contact = Contact::with_friction(friction).with_radius(RADIUS).with_cables().with_restitution(restitution);
    cable.set_contact(contact).unwrap();
    cable
}

/// Two bars that cross, a gap (m) apart, of which one flies towards the other.
fn bars(gap: f64, restitution: f64) -> World {
    let line = |at: Vector3<f64>, along: Vector3<f64>| [at - 0.1 * along, at + 0.1 * along];
    let below = rope(10.0, &line(Vector3::zeros(), Vector3::x()), 2);
    let above = rope(10.0, &line(up() * (2.0 * RADIUS + gap), Vector3::z()), 2).velocity(-up());
    let bars = [below, above].map(|bar| touching(bar.gravity(Vector3::zeros()).build().unwrap(), 0.0, restitution));
    World::new(bars.into(), vec![])
}

/// Cables with more restitution than they can have are warned of where they touch each other, both of
/// them; those that touch nothing, or have less, are not.
///
/// *Source.* The definition: impacts have at most 15/17.
#[test]
fn more_restitution_between_cables_than_there_is_is_told() {
    for (gap, restitution, told) in [(0.01, 0.95, true), (0.01, 0.8, false), (1.0, 0.95, false)] {
        let mut world = bars(gap, restitution);
        world.run(6, |_| {});
        for cable in &world.cables {
            let high = |w: &Warning| matches!(w, Warning::HighRestitution { restitution, .. } if *restitution == 0.95);
            assert_eq!(cable.warnings().iter().any(high), told, "{gap} m, {restitution}: {:?}", cable.warnings());
        }
    }
}

/// A rope that hangs over a stiff one, which is clamped, in half a turn, with forces (N) at its
/// ends.
fn hooked(friction: f64, forces: [f64; 2]) -> World {
    let section = Section::from_stiffness(1e6, 50.0, 0.1).unwrap();
    let beneath = rope(10.0, &[-0.3 * Vector3::x(), 0.3 * Vector3::x()], 12).section(section);
    let beneath = beneath.gravity(Vector3::zeros()).clamp(At::Start).clamp(At::End).build().unwrap();
    let at = |y: f64, z: f64| Vector3::new(0.0, y, z);
    let r = 2.0 * RADIUS;
    let arc = (1..12).map(|k| f64::from(k) * std::f64::consts::PI / 12.0).map(|a| at(r * a.sin(), -r * a.cos()));
    let line = [at(-0.5, -r), at(-0.25, -r), at(0.0, -r)].into_iter().chain(arc);
    let points: Vec<_> = line.chain([at(0.0, r), at(-0.25, r), at(-0.5, r)]).collect();
    let section = Section::from_stiffness(1e5, 1e-4, 0.02).unwrap();
    let over = rope(1e-4, &points, 60).section(section);
    let mut over = over.build().unwrap();
    let ends = [0.0, over.length()];
    for (at, force) in ends.into_iter().zip(forces) {
        over.add_load(PointLoad::force(at, -up() * force)).unwrap();
    }
    let mut world = World::new([beneath, over].map(|cable| touching(cable, friction, 0.0)).into(), vec![]);
    world.integrator = steps(240.0);
    world
}

/// A rope that is hooked over another one, with weights of which friction would hold the
/// difference, runs over it, since nothing holds the one beneath against turning, and that is told;
/// one that balances, or that has no friction, is not told of.
///
/// *Source.* Euler: a ratio of the tensions below exp(mu pi) holds on a rod; by the definition of
/// the warning it is told of no other.
#[test]
fn a_rope_that_runs_over_a_rope_is_told_of() {
    for (friction, share, told) in [(0.4, 1.2, true), (0.4, 1.0, false), (0.0, 1.2, false)] {
        let mut world = hooked(friction, [2.0, 2.0 * share]);
        let mut watches: Vec<Watch> = world.cables.iter().map(Watch::new).collect();
        world.run(12, |world| {
            for (watch, cable) in watches.iter_mut().zip(&world.cables) {
                watch.note(cable);
            }
        });
        let fell = -0.5 - world.cables[1].node_position(60).y;
        let warnings: Vec<Warning> =
            watches.iter().zip(&world.cables).flat_map(|(watch, cable)| watch.warnings(cable, None)).collect();
        let found = warnings.iter().find(|w| matches!(w, Warning::RunsOver { .. }));
        println!("mu {friction}, {share}: fell by {fell:.3} m, {found:?}");
        assert_eq!(found.is_some(), told, "mu {friction}, {share}: {warnings:?}");
        if let Some(Warning::RunsOver { run_m, .. }) = found {
            // it runs by half a turn before it is told of, and falls by as much
            assert!(*run_m > 0.0314 && *run_m < fell + 0.04, "{run_m} {fell}");
        }
    }
}

/// A rope that slides across another one under it, held straight, is not told of: friction acts.
///
/// *Source.* The definition of the warning.
#[test]
fn a_rope_that_slides_across_a_rope_is_not_told_of() {
    let line = |at: Vector3<f64>, along: Vector3<f64>| [at - 0.3 * along, at + 0.3 * along];
    let section = Section::from_stiffness(1e6, 50.0, 0.1).unwrap();
    let beneath = rope(10.0, &line(Vector3::zeros(), Vector3::x()), 12).section(section).gravity(Vector3::zeros());
    let beneath = beneath.clamp(At::Start).clamp(At::End).build().unwrap();
    let bar = rope(10.0, &line(up() * (2.0 * RADIUS), Vector3::z()), 12).section(section);
    let bar = bar.gravity(-GRAVITY * up()).velocity(0.5 * Vector3::z()).build().unwrap();
    let mut world = World::new([beneath, bar].map(|cable| touching(cable, 0.1, 0.0)).into(), vec![]);
    let mut watch = Watch::new(&world.cables[0]);
    world.run(15, |world| watch.note(&world.cables[0]));
    let warnings = watch.warnings(&world.cables[0], None);
    assert!(!warnings.iter().any(|w| matches!(w, Warning::RunsOver { .. })), "{warnings:?}");
}
