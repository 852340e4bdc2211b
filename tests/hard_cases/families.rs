//! Each family of hard cases, each case on one of its hosts, the first one with all effects too.
//!
//! # References
//! The bounds and their sources are stated in the cases: conservation laws, statics, analytic
//! solutions.

use super::check::check;
use lariat_bench::stability::family::Family;

macro_rules! families {
    ($($name:ident: $family:ident;)*) => { $(
        #[test]
        fn $name() {
            check(Family::$family);
        }
    )* };
}

families! {
    loads_of_any_mass_hang_and_swing: MassRatio;
    cables_of_any_stiffness_swing: Stiffness;
    slack_ropes_become_taut_with_the_force_of_a_spring: Snatch;
    whips_crack_and_spinning_cables_keep_their_momentum: Whip;
    compressed_cables_buckle: Compression;
    collapsed_elements_recover_or_end_in_an_error: Collapse;
    ropes_without_bending_stiffness_rest_and_become_taut: ZeroBending;
    wedged_bodies_are_held_and_released: Jam;
    changes_by_a_user_are_absorbed: Changes;
    long_runs_neither_drift_nor_gain_energy: Long;
    tiny_huge_and_distant_cables_are_accurate: Scale;
    many_cables_and_bodies_keep_energy_and_momentum: Many;
    mechanisms_pull_with_the_right_force: Mechanisms;
    random_scenes_keep_energy_and_momentum: Random;
}
