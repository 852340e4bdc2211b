//! Host steps from the time of frames.

use super::common::{cable_of, soft, world};
use lariat_bevy::{FixedClock, advance};

#[test]
fn frames_of_any_length_make_host_steps_of_one_length() {
    let mut world = world();
    let cable = world.spawn(soft([0.0; 3], [1.0, 0.0, 0.0])).id();
    let mut steps = 0;
    for _ in 0..144 {
        steps += advance(&mut world, 1.0 / 144.0);
        let fraction = world.resource::<FixedClock>().fraction();
        assert!((0.0..=1.0).contains(&fraction), "{fraction}");
    }
    assert_eq!(steps, 60);
    let time = cable_of(&world, cable).time();
    assert!((time - 1.0).abs() < 1e-5, "{time}");
}

#[test]
fn a_long_frame_is_truncated_and_an_invalid_time_counts_as_zero() {
    let mut world = world();
    assert_eq!(advance(&mut world, 10.0), 8);
    assert!(advance(&mut world, 0.0) <= 1);
    for invalid in [f64::NAN, f64::INFINITY, -1.0] {
        assert_eq!(advance(&mut world, invalid), 0);
    }
}
