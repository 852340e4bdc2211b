//! A clutch whose largest force is lowered while it holds a load.

use super::common::G;
use super::laws::Hoist;
use lariat_ancf::{At, Error, Reel};

/// A clutch that holds a load and is weakened at once lets it fall as its force says, whatever the load, the step and the force: to 0.2 %, and to 2 % where the rope is
/// stretched by more than 1 %, on which the load vibrates. From the end of the first step on, its pull is never above the force.
///
/// *Source.* See [`Hoist::fall`].
#[test]
fn a_weakened_clutch_lets_its_load_fall_as_its_force_says() {
    let stiffness = 1.0e5;
    for mass in [0.5, 1.0, 3.0, 8.0, 14.0, 20.0, 50.0, 150.0, 500.0] {
        for dt in [1.0 / 30.0, 1.0 / 60.0, 1.0 / 120.0, 1.0 / 240.0] {
            for share in [0.1, 0.3, 0.8, 0.95] {
                let strong =
                    Reel { max_force: Some(2.0 * (mass + 0.15) * G), acceleration: 0.3, ..Reel::with_rate(-0.3) };
                let strain = mass * G / stiffness;
                let mut hoist = Hoist::stretched(strain, stiffness, mass, 0.15, dt, strong.clone());
                (0..(1.0 / dt) as usize).for_each(|_| hoist.step());
                let limit = share * (mass + 0.15 * hoist.cable.length()) * G;
                hoist.cable.set_reel(At::End, Reel { max_force: Some(limit), ..strong }).unwrap();
                let case = format!("{mass} kg, {dt} s, {share}");
                match hoist.fall(limit) {
                    Ok([fell, expected]) => {
                        let bound = if strain < 0.01 { 2e-3 } else { 2e-2 };
                        assert!((fell / expected - 1.0).abs() < bound, "{case}: {fell} m/s of {expected} m/s");
                        assert!(hoist.most < 1.02 * limit, "{case}: {} N of {limit} N", hoist.most);
                    }
                    // it falls by more than half of an element in a step
                    Err(error) => {
                        assert!(matches!(error, Error::FastReel { .. }) && dt > 0.03 && share < 0.5, "{case}: {error}");
                    }
                }
            }
        }
    }
}
