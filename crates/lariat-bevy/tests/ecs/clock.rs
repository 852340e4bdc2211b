//! Host steps from a frame's time.

use super::bench::{soft, world};
use lariat_bevy::{Cable, FixedClock, advance};

#[test]
fn frames_of_any_length_make_steps_of_one() {
    let mut world = world();
    let cable = world.spawn(soft([0.0; 3], [1.0, 0.0, 0.0])).id();
    let mut steps = 0;
    for _ in 0..144 {
        steps += advance(&mut world, 1.0 / 144.0);
        let fraction = world.resource::<FixedClock>().fraction();
        assert!((0.0..=1.0).contains(&fraction), "{fraction}");
    }
    assert_eq!(steps, 60);
    let time = world.get::<Cable>(cable).unwrap().core().unwrap().time();
    assert!((time - 1.0).abs() < 1e-5, "{time}");
}

#[test]
fn a_long_frame_is_cut_short_and_nonsense_is_no_time() {
    let mut world = world();
    assert_eq!(advance(&mut world, 10.0), 8);
    assert!(advance(&mut world, 0.0) <= 1);
    for nonsense in [f64::NAN, f64::INFINITY, -1.0] {
        assert_eq!(advance(&mut world, nonsense), 0);
    }
}
