//! The scenes of assets/scenes with bodies.

use super::results::{Results, asset};

/// Positions of the box at 0.5 s and 1 s, the gap of the attachment, conservation of energy, and the balance of momentum.
///
/// *Source.* A run with small steps of an independent monolithic code, error below 2e-5 m; the law of momentum.
#[test]
fn the_payload_pendulum_agrees_with_the_independent_code() {
    let results = Results::of("run", &asset("payload_pendulum"), &[]).done();
    let rows = results.rows("crate");
    for (time, x, y) in [(0.5, 1.70292, -1.21801), (1.0, -0.82138, -1.91419)] {
        let row = rows.iter().find(|row| row[0] == time).unwrap();
        let off = (row[1] - x).hypot(row[2] - y);
        assert!(off < 6e-3 && row[3] == 0.0, "{off:.1e} m at {time} s");
    }
    let summary = results.summary();
    assert!(summary.max_gap_m < 1e-6, "{} m", summary.max_gap_m);
    // the cable weighs 0.8 kg and hangs at height 0 at first, the box at -0.1 m
    let start = -50.0 * 9.81 * 0.1;
    assert!((summary.energy_start_j.unwrap() - start).abs() < 1e-4);
    for row in results.rows("energy") {
        assert!((row[7] - start).abs() < 0.1, "energy {} J at {} s", row[7], row[0]);
        assert!((row[1..5].iter().sum::<f64>() - row[7]).abs() < 1e-9);
    }
    // the impulse of support and gravity is the change of momentum; trapezoid sum over the first, smooth 0.25 s
    let (pin, momentum) = (results.rows("pin"), results.rows("momentum"));
    let mut impulse = [0.0, 0.0];
    for k in 1..=15 {
        let h = pin[k][0] - pin[k - 1][0];
        for i in 0..2 {
            impulse[i] -= 0.5 * h * (pin[k][1 + i] + pin[k - 1][1 + i]);
        }
        impulse[1] -= 50.8 * 9.81 * h;
    }
    for i in 0..2 {
        let off = impulse[i] - momentum[15][1 + i];
        assert!(off.abs() < 5e-2, "{impulse:?} and {:?}", &momentum[15][1..3]);
    }
}

/// Force and work at the hook are the changes of momentum and energy of the box.
///
/// *Source.* The laws of momentum and of energy for the box alone, from the probe of its motion.
#[test]
fn force_and_work_at_the_hook_balance_the_motion_of_the_box() {
    let results = Results::of("run", &asset("payload_pendulum"), &[]).done();
    let (boxes, hook, energy) = (results.rows("crate"), results.rows("hook"), results.rows("energy"));
    let mut impulse = [0.0, 0.0];
    for k in 1..boxes.len() {
        let h = boxes[k][0] - boxes[k - 1][0];
        for i in 0..2 {
            impulse[i] += 0.5 * h * (hook[k][1 + i] + hook[k - 1][1 + i]);
            let gravity = [0.0, -9.81 * 50.0 * boxes[k][0]][i];
            // later the force oscillates between samples, and their sum is less accurate
            if boxes[k][0] < 0.25 {
                let off = impulse[i] + gravity - 50.0 * boxes[k][8 + i];
                assert!(off.abs() < 5e-2, "{off} N s at {} s", boxes[k][0]);
            }
        }
        let row = &boxes[k];
        let speed = row[8].powi(2) + row[9].powi(2);
        // a cube of side 0.2 m: m (0.2^2 + 0.2^2)/12
        let kinetic = 0.5 * 50.0 * speed + 0.5 * 50.0 * 0.08 / 12.0 * row[13].powi(2);
        let gain = kinetic + 9.81 * 50.0 * (row[2] + 0.1);
        // Rapier's single precision leaves 2e-2 J of the kinetic energy's 1000 J
        assert!((energy[k][6] - gain).abs() < 5e-2, "{} J of {gain} at {} s", energy[k][6], row[0]);
    }
    let most = energy.iter().map(|row| row[6].abs()).fold(0.0, f64::max);
    assert!(most > 1.0, "the cable did work: {most} J");
}

/// Without external forces momentum and angular momentum are constant, and the energy but for numerical dissipation.
///
/// *Source.* Conservation laws; the angular momentum at the start is that of rigid bodies, `w (sum of m r^2 + I)`.
#[test]
fn the_dumbbell_keeps_its_momenta() {
    let results = Results::of("run", &asset("dumbbell"), &[]).done();
    let rows = results.rows("momentum");
    // about the centre of mass at -0.36/8.72 m: balls (with 2/5 m r^2 of their own), and the cable as a rod of 1.8 m
    let centre = -0.36 / 8.72;
    let inertia: f64 =
        [(2.0, -1.5), (6.0, 0.5)].iter().map(|(m, x)| m * ((x - centre) * (x - centre) + 0.4 * 0.01)).sum();
    let rod = 0.72 * (1.8 * 1.8 / 12.0 + (-0.5 - centre) * (-0.5 - centre));
    let expected = 5.0 * (inertia + rod);
    for row in &rows {
        assert!(row[1].hypot(row[2]) < 1e-4, "momentum {:?} kg m/s at {} s", &row[1..4], row[0]);
        assert!((row[6] / expected - 1.0).abs() < 2e-3, "{} of {expected} kg m^2/s at {} s", row[6], row[0]);
    }
    let energy = |row: &[f64]| row[7];
    let (first, last) = (energy(&results.rows("energy")[0]), energy(&results.last("energy")));
    assert!(
        (first / (0.5 * 5.0 * expected) - 1.0).abs() < 1e-6 && (last / first - 1.0).abs() < 1e-3,
        "{first} {last} J"
    );
    assert!(results.summary().max_gap_m < 1e-6);
}

/// Before the lift the box is at rest; in the end the rope carries it, at the height given by winch, slack and stretch.
///
/// *Source.* 10 kg x 9.81 m/s^2 = 98.10 N; EA = 1e5 N.
#[test]
fn the_hoist_carries_the_weight_of_its_box() {
    let results = Results::of("run", &asset("hoist"), &[]).done();
    let late = |probe: &str| -> Vec<f64> {
        results.rows(probe).iter().filter(|row| row[0] > 12.0).map(|row| row[2]).collect()
    };
    let (hook, drum) = (late("hook"), late("drum"));
    assert!(hook.len() > 100 && hook.iter().all(|n| (n / 98.10 - 1.0).abs() < 1e-3), "{hook:?}");
    // the drum carries the rope too, 1.91 m of 0.4 kg/m
    let all = -9.81 * (10.0 + 1.91 * 0.4);
    assert!(drum.iter().all(|n| (n / all - 1.0).abs() < 1e-3), "{drum:?}");
    let rows = results.rows("box");
    assert!(rows.iter().filter(|row| row[0] < 1.0).all(|row| (row[2] - 0.1).abs() < 1e-3));
    let stretch = 1.91 * 9.81 * (10.0 + 0.5 * 1.91 * 0.4) / 1e5;
    let lift = results.last("box")[2] - 0.1;
    assert!((lift - (0.51 - 0.01 - stretch)).abs() < 1e-4, "{lift} m");
    assert!(results.summary().max_gap_m < 1e-5);
}
