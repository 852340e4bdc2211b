//! Reels of cables in a fluid, and under forces per length.

use super::common::{G, implicit, rope};
use super::laws::{Hoist, reference};
use lariat_ancf::{
    At, Buoyancy, Cable, Damping, Drag, Effects, Feed, Flow, Integrator, LineLoad, Method, PointLoad, Reel, Section,
    StepControl, Vector3,
};

/// Effects of water that flows by `current` (m/s) on a rope of 2 cm; its displacement is 0.1 kg/m.
fn water(rope: &Cable, current: Vector3<f64>, along: f64) -> Effects {
    let drag = Drag { diameter: Some(0.02), ..Drag::new(1000.0, 1.2, along, Flow::uniform(current)) };
    let buoyancy = Buoyancy { area: Some(1e-4), ..Buoyancy::new(1000.0, 0.0) };
    Effects { drag: Some(drag), buoyancy: Some(buoyancy), ..rope.effects().clone() }
}

/// A rope with a load runs off a free spool into water, at rest or in a current along it, and under a force per length, as fast as its
/// equation says, from a drum, a coil and a bag; and the account of energy closes.
///
/// *Source.* Inextensible rope of length u in water: what `a_free_spool_follows_its_equation` says, with the weight `(rho - rho_f A) g + f`
/// per length and the drag `1/2 rho_f d C_t u (u' + c)^2` against a current c towards the eye. Integrated by the Runge-Kutta method.
#[test]
fn a_free_spool_in_water_follows_its_equation() {
    for (feed, mass, density, brake, current, line, along) in [
        (Feed::Drum, 1.0, 0.4, 0.0, 0.0, 0.0, 0.5),
        (Feed::Drum, 3.0, 0.2, 5.0, 0.5, 0.0, 0.2),
        (Feed::Drum, 0.5, 0.6, 0.0, -0.4, 4.0, 0.8),
        (Feed::Coil, 1.0, 0.4, 0.0, 0.0, 2.0, 0.3),
        (Feed::Bag, 2.0, 0.3, 3.0, 0.7, 0.0, 0.5),
    ] {
        let (stock, inertia, dt) = (6.0, if feed == Feed::Drum { 0.6 } else { 0.0 }, 1.0 / 480.0);
        let reel = Reel { feed, stock: Some(stock), inertia, acceleration: 1e4, ..Reel::brake(brake) };
        let mut hoist = Hoist::new(mass, density, dt, reel);
        let mut effects = water(&hoist.cable, Vector3::new(0.0, current, 0.0), along);
        effects.line_loads = Some(LineLoad::uniform(Vector3::new(0.0, -line, 0.0)).into());
        hoist.cable.set_effects(effects).unwrap();
        let (start, time) = (hoist.account(), 1.2);
        (0..(time / dt).round() as usize).for_each(|_| hoist.step());
        let out = |u: f64| mass + density * u;
        let pull = |u: f64, v: f64| {
            let speed = v + current;
            let drag = 0.5 * 1000.0 * 0.02 * along * u * speed * speed.abs();
            (mass + (density - 0.1) * u) * G + line * u - brake - drag
        };
        let (u, v) = reference(1.0, time, |u, v| match feed {
            Feed::Coil => (pull(u, v) - density * v * v) / out(u),
            Feed::Bag => (pull(u, v) - 0.5 * density * v * v) / out(u),
            _ => pull(u, v) / (out(u) + inertia + density * (stock - u)),
        });
        let reel = hoist.cable.reel(At::End).unwrap();
        let missing = hoist.account() - start;
        let lost = -hoist.cable.effect_work().drag;
        println!(
            "{feed:?} {mass} kg: {:.2e} of the rate {v:.3} m/s, {:.2e} of the length, {missing:.1e} J of {lost:.1} J",
            reel.rate / v - 1.0,
            reel.length_out / u - 1.0
        );
        assert!((reel.rate / v - 1.0).abs() < 0.01 && (reel.length_out / u - 1.0).abs() < 0.01, "{u} {v} {reel:?}");
    }
}

/// A damped rope swings in space in a current, under a force per length, while reels pay it out and take it in at either end: whatever the
/// method, the energy changes by the work of the reel and of all effects, and all methods agree about the motion.
///
/// *Source.* Conservation of energy; the methods have nothing in common but the forces.
#[test]
fn the_account_of_a_rope_in_a_current_closes() {
    for start in [false, true] {
        let mut ends: Vec<Vector3<f64>> = Vec::new();
        for integrator in implicit() {
            let mut cable = if start { reversed(integrator) } else { rope(1.5, 8, integrator) };
            let at = if start { At::Start } else { At::End };
            let mut effects = water(&cable, Vector3::new(0.3, 0.1, -0.4), 0.05);
            effects.damping = Some(Damping { axial: 2e-3, bending: 2e-3 });
            effects.line_loads = Some(LineLoad::uniform(Vector3::new(0.5, -3.0, 0.2)).into());
            cable.set_effects(effects).unwrap();
            // without a jump of the axial force, whose waves each method damps as it does
            cable.equilibrium().unwrap();
            let mut v = cable.velocities().to_vec();
            for node in 0..cable.nodes() {
                v[6 * node] = 0.6 * cable.node_position(node).y;
                v[6 * node + 3] = if start { -0.6 } else { 0.6 };
            }
            let q = cable.positions().to_vec();
            cable.set_coordinates(&q, &v).unwrap();
            cable.add_reel(at, Reel { acceleration: 4.0, ..Reel::default() }).unwrap();
            let total = |cable: &Cable| {
                let reel = cable.reel(at).unwrap();
                let law = cable.energy_law();
                cable.energy().total() - reel.work - reel.remeshed - cable.effect_work().total() + law.numerical
            };
            let before = total(&cable);
            let mut worst = 0.0f64;
            for step in 0..180 {
                let t = f64::from(step) / 120.0;
                cable.set_reel_rate(at, (3.0 * t).sin()).unwrap();
                cable.step(1.0 / 120.0).unwrap();
                worst = worst.max((total(&cable) - before).abs());
            }
            let (reel, work) = (cable.reel(at).unwrap(), *cable.effect_work());
            let free = cable.node_position(if start { cable.nodes() - 1 } else { 0 });
            println!("{:?}: {worst:.1e} J, {free:?}, {work:?}, {:.3} J", integrator.method, reel.work);
            assert!(reel.splits > 2 && reel.merges > 0, "{reel:?}");
            let moved = work.drag.abs() + work.line_loads.abs() + reel.work.abs();
            // the law of the discrete gradient is exact but for what flows; the others know work by two points of a step
            let allowed = if integrator.method == Method::DiscreteGradient { 1e-5 } else { 1e-3 };
            assert!(worst < allowed * moved, "{:?}: {worst:e} J of {moved} J", integrator.method);
            ends.push(free);
        }
        for end in &ends {
            assert!((end - ends[0]).norm() < 1e-5, "{ends:?}");
        }
    }
}

/// Returns the rope with its eye at the start.
fn reversed(integrator: Integrator) -> Cable {
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(0.0, -1.5, 0.0)])
        .section(Section::from_stiffness(1.0e4, 0.02, 0.4).unwrap())
        .elements(8)
        .integrator(integrator)
        .fix(At::Start)
        .build()
        .unwrap();
    cable.equilibrium().unwrap();
    cable
}

/// Two hundred splits and merges at 2 m/s of a rope of EA 1e6 N that swings in space under a load, damped and dragged, in host steps of 1/30 s: every
/// implicit method gets through, and changes of the mesh add less than 0.1 J.
///
/// *Source.* In each of twelve seconds 1.9 m pass, 18 elements.
#[test]
fn two_hundred_splits_and_merges_in_long_host_steps() {
    let fine = |method| Integrator { method, control: StepControl::MaxStep(1.0 / 240.0) };
    for integrator in [
        Integrator::tolerance(Method::Esdirk4, 1e-4).unwrap(),
        Integrator::tolerance(Method::TrBdf2, 1e-4).unwrap(),
        fine(Method::GeneralisedAlpha { rho: 0.6 }),
        fine(Method::DiscreteGradient),
    ] {
        let mut cable = Cable::builder()
            .points([Vector3::new(1.2, -1.2, 0.9), Vector3::zeros()])
            .section(Section::from_stiffness(1e6, 0.5, 0.5).unwrap())
            .elements(19)
            .damping(Damping { axial: 2e-3, bending: 2e-3 })
            .integrator(integrator)
            .fix(At::End)
            .load(PointLoad::force(0.0, [0.0, -100.0, 0.0]))
            .build()
            .unwrap();
        let air = Flow::uniform(Vector3::new(0.5, 0.0, 1.0));
        cable.set_drag(Drag { diameter: Some(0.01), ..Drag::new(1.2, 1.2, 0.02, air) }).unwrap();
        let rate = (0..12).map(|i| [f64::from(i), if i % 2 == 0 { 2.0 } else { -2.0 }]).collect();
        cable.add_reel(At::End, Reel { rate, acceleration: 20.0, ..Reel::default() }).unwrap();
        (0..360).for_each(|_| cable.step(1.0 / 30.0).unwrap());
        let reel = cable.reel(At::End).unwrap();
        println!("{:?}: {reel:?}", integrator.method);
        assert!(reel.splits + reel.merges > 200 && reel.remeshed.abs() < 0.1, "{reel:?}");
    }
}
