//! Lengths that are asked for: by a table of rates, as a length, and by a stock.

use super::common::{G, rope};
use super::laws::Hoist;
use super::random::Random;
use lariat_ancf::{
    At, Cable, EquilibriumFailure, Error, Feed, Integrator, Method, Reel, Section, StepControl, Vector3, Warning,
};

fn game() -> Integrator {
    Integrator { method: Method::DiscreteGradient, control: StepControl::Substeps(1) }
}

/// A load that falls on a free spool falls freely to the end of its stock, and is stopped there by the stretch of its rope: no further
/// than its energy stretches it, and no force is on it before.
///
/// *Source.* Free fall, the rope of a fiftieth of the load's mass apart. The stretch of a spring: `k x^2/2 = m v^2/2 + m g x`, with half again for
/// the waves of the rope and what the load falls in a step.
#[test]
fn a_free_spool_runs_free_to_the_end_of_its_stock() {
    let mut random = Random::new(11);
    for _ in 0..16 {
        let mut between = |low, high| random.between(low, high);
        let (mass, stock, dt) = (between(2.0, 40.0), between(1.5, 3.5), 1.0 / between(240.0, 960.0));
        let density = 0.02 * mass / stock;
        let reel = Reel { stock: Some(stock), feed: Feed::Bag, ..Reel::free_spool() };
        let mut hoist = Hoist::new(mass, density, dt, reel);
        let mut largest = 0.0f64;
        let (mut longest, mut lowest, mut speed, mut time) = (0.0f64, 0.0f64, 0.0, 0.0);
        for _ in 0..(1.5 / dt) as usize {
            hoist.step();
            time += dt;
            let reel = hoist.cable.reel(At::End).unwrap();
            assert!(reel.length_out <= stock + 1e-9, "{reel:?}");
            (longest, lowest) = (longest.max(reel.length_out), lowest.max(hoist.below()));
            if longest < stock - 1e-6 && reel.length_out + 3.0 * dt * reel.rate < stock {
                largest = largest.max(reel.force.abs());
                speed = reel.rate;
                let fallen = 0.5 * G * time * time;
                let off = (reel.length_out - 1.0 - fallen).abs();
                assert!(
                    off < 0.03 * fallen + 3e-3,
                    "{mass} kg, {time:.3} s: {:.4} m of {:.4}",
                    reel.length_out,
                    1.0 + fallen
                );
            }
        }
        let k = 1.0e5 / stock;
        let stretch = (mass * G + (mass * mass * G * G + k * mass * speed * speed).sqrt()) / k;
        println!(
            "{mass:.1} kg, {stock:.2} m, 1/{:.0} s: {largest:.1e} N, {:.4} m beyond, {stretch:.4}",
            1.0 / dt,
            lowest - stock
        );
        assert!(largest < 0.03 * mass * G, "{mass} kg is braked by {largest} N");
        assert!((longest - stock).abs() < 1e-9, "{longest} m of {stock}");
        assert!(lowest - stock < 1.5 * stretch, "{} m beyond the stock, {stretch} of stretch", lowest - stock);
    }
}

/// A reel comes to a length that is asked for and stops there, from any rate and at any step, prescribed or with a motor, within its rate
/// and acceleration, and comes back where it was too fast.
///
/// *Source.* The length that is asked for; the acceleration, which is the change of the rate over each host step.
#[test]
fn a_reel_comes_to_the_length_that_is_asked_for() {
    let mut random = Random::new(5);
    for trial in 0..40 {
        let mut between = |low, high| random.between(low, high);
        let (acceleration, most, dt) = (between(0.7, 8.0), between(0.3, 2.0), 1.0 / between(60.0, 400.0));
        let mut cable = rope(1.5, 6, game());
        let max_force = (trial % 2 == 0).then_some(1e4);
        cable.add_reel(At::End, Reel { acceleration, max_force, ..Reel::default() }).unwrap();
        for _ in 0..3 {
            // from any motion
            cable.set_reel_rate(At::End, between(-0.8, 0.8)).unwrap();
            for _ in 0..(between(0.0, 0.3) / dt) as usize {
                cable.step(dt).unwrap();
            }
            let asked = between(0.8, 2.5);
            cable.set_reel_length(At::End, asked, most).unwrap();
            let mut before = cable.reel(At::End).unwrap().rate;
            let started = before.abs();
            for _ in 0..(8.0 / dt) as usize {
                cable.step(dt).unwrap();
                let rate = cable.reel(At::End).unwrap().rate;
                let change = (rate - before).abs();
                assert!(change <= acceleration * dt * (1.0 + 1e-9), "{change} m/s in a step of {dt}");
                assert!(rate.abs() <= most.max(started) + 1e-9);
                before = rate;
                if rate == 0.0 && (cable.length() - asked).abs() < 1e-9 {
                    break;
                }
            }
            let missed = (cable.length() - asked).abs();
            println!(
                "{acceleration:.2} m/s^2, {most:.2} m/s, 1/{:.0} s, motor {}: {missed:.1e} m",
                1.0 / dt,
                trial % 2 == 0
            );
            assert!(missed < 1e-9 && before.abs() < 1e-9, "{missed:e} m, {before:e} m/s");
        }
    }
}

/// A table whose rows are shorter than the acceleration takes is told, with the length that is asked for and the one that comes out; one
/// whose rates are reached is not.
///
/// *Source.* The length after the run; the integral of the table.
#[test]
fn a_table_that_the_acceleration_does_not_give_is_told() {
    for (rows, acceleration) in [
        (vec![[0.0, 5.0], [1.0, 0.0]], 2.0),
        (vec![[0.0, 5.0], [1.0, 0.0]], 1e3),
        (vec![[0.0, 1.0], [2.0, 0.0]], 2.0),
        (vec![[0.2, 0.9], [0.4, -0.3], [0.9, 0.1], [2.0, 0.0]], 1.5),
        (vec![[0.0, 0.5], [0.5, 1.0], [1.0, 0.5], [1.5, 0.0]], 1.1),
    ] {
        let mut cable = rope(1.0, 4, game());
        let reel = Reel { rate: rows.clone(), acceleration, ..Reel::default() };
        cable.add_reel(At::End, reel).unwrap();
        cable.set_watched(true);
        (0..2000).for_each(|_| cable.step(1.0 / 400.0).unwrap());
        let asked: f64 = rows.windows(2).map(|rows| rows[0][1] * (rows[1][0] - rows[0][0])).sum();
        let out = cable.length() - 1.0;
        let told = cable.warnings().into_iter().find_map(|warning| match warning {
            Warning::SlowReel { asked_m, given_m, .. } => Some([asked_m, given_m]),
            _ => None,
        });
        println!("{rows:?}, {acceleration} m/s^2: {asked} m asked, {out} m out, {told:?}");
        match told {
            Some([said, given]) => {
                assert!((said - asked).abs() < 1e-12 && (given - out).abs() < 1e-2 * asked.abs().max(1.0));
                assert!((asked - out).abs() > 1e-3);
            }
            None => assert!((asked - out).abs() < 0.01 * asked.abs() + 3e-3, "{asked} m asked, {out} m out, untold"),
        }
    }
}

/// Statics refuse a reel that holds less than its cable pulls, and find the shape where it holds, at the end of its stock too.
///
/// *Source.* The weight of the rope, 0.4 kg/m of 1 m: 3.924 N, in a rope that pulls T f less its strain energy per length.
#[test]
fn a_reel_that_slips_has_no_equilibrium() {
    let hung = |reel: Reel| {
        let mut cable: Cable = Cable::builder()
            .points([Vector3::new(0.0, -1.0, 0.0), Vector3::zeros()])
            .section(Section::from_stiffness(1.0e4, 0.02, 0.4).unwrap())
            .elements(4)
            .integrator(game())
            .fix(At::End)
            .build()
            .unwrap();
        cable.add_reel(At::End, reel).unwrap();
        cable.equilibrium().map(|_| cable.reel(At::End).unwrap().force)
    };
    let weight = 0.4 * G;
    for largest in [0.0, 1.0, 0.999 * weight] {
        match hung(Reel::brake(largest)) {
            Err(Error::NoEquilibrium { failure: EquilibriumFailure::Slips { pull, largest: told }, .. }) => {
                assert!((pull / weight - 1.0).abs() < 1e-3 && told == largest, "{pull} N");
            }
            outcome => panic!("a brake of {largest} N holds {weight} N: {outcome:?}"),
        }
    }
    for reel in [Reel::brake(1.01 * weight), Reel::default(), Reel { stock: Some(1.0), ..Reel::free_spool() }] {
        let force = hung(reel.clone()).unwrap();
        assert!((force / weight - 1.0).abs() < 1e-3, "{reel:?}: {force} N");
    }
}
