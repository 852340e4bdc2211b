//! Of reels, sheaves and drums.

/// Least length of the element at the eye, as a share of its full length. Derived: a split leaves
/// 0.6 at least, so that no merge follows it.
pub(crate) const LEAST: f64 = 0.4;

/// Length above which the element at the eye is split, as a share of its full length. Derived: a
/// merge leaves 1.4 at most, so that no split follows it.
pub(crate) const MOST: f64 = 1.6;

/// Rate in m/s below which the time in which an element passes the eye is not asked for. Unknown:
/// no winch is meant to creep.
pub(crate) const PASSING_RATE: f64 = 1e-3;

/// Largest number of splits in a part of a host step. Unknown: it ends a loop; a part feeds 0.15 of
/// an element.
pub(crate) const MOST_SPLITS: usize = 100;

/// Share of the work of the pull over an element that a change of the mesh may add. Derived: that
/// to which the account of a reel is kept.
pub(crate) const SHARE: f64 = 1e-3;

/// Largest number of steps in which energy is taken back. Unknown: what is left then is taken from
/// velocities.
pub(crate) const STEPS: usize = 60;

/// Number of halvings to find the length of the last step. Derived: to 2.4e-4 of it, below the
/// share of the work that is left open.
pub(crate) const HALVINGS: usize = 12;

/// Least share of the excess that a step has to take. Unknown: slower ones would not end.
pub(crate) const PROGRESS: f64 = 1e-3;

/// Least principal inertia of a rigid rotation, as a share of their sum. Derived: the square of a
/// sag of 1e-3 of the length; about its axis a straighter cable would be spun up to any rate.
pub(crate) const LEAST_INERTIA: f64 = 1e-6;

/// Largest number of times that what velocities gain is taken, too. Unknown: each leaves a small
/// part of the one before.
pub(crate) const ROUNDS: usize = 6;

/// Largest length of material that passes the eye in a part of a host step, as a share of an
/// element. Derived: below the 0.2 between a merge or split and the length that it leaves.
pub(crate) const PASSING: f64 = 0.15;

/// Largest number of parts. Setting: rates beyond are refused by name.
pub(crate) const MOST_PARTS: f64 = 1e5;

/// Largest number of parts of a host step for what the last acceleration of an unknown rate would
/// make of it. Derived: that of the shortest steps of error control; after a break it is that of a
/// wave over a much shorter step.
pub(crate) const MOST_PARTS_OF_WAVE: f64 = 64.0;

/// Rate in m/s below which a reel stands. Derived: in a century it feeds 3 mm.
pub(crate) const STANDING_RATE: f64 = 1e-12;

/// Largest distance in m between the two ends at a sheave, besides its diameter. Derived: that of
/// an attachment and what it is attached to.
pub(crate) const GAP: f64 = 1e-3;

/// Share of the sum of all impulses that may be unbalanced where stock rides with a body. Derived:
/// that of the energy law, for momentum.
pub(crate) const DRIFT_TOLERANCE: f64 = 1e-9;

/// Least and largest length of an element at the end of an iterate, as a multiple of that at the
/// beginning. Derived: beyond the 0.15 that may pass in a step, and far from no length.
pub(crate) const REACH: [f64; 2] = [0.5, 1.5];

/// Share of a host step that is all of it. Derived: but for rounding.
pub(crate) const ALL: f64 = 1.0 - super::SAME;

/// Most sweeps over several reels and sheaves. Unknown: it ends a loop; two converge in some ten.
pub(crate) const SWEEPS: usize = 1000;

/// Change of an acceleration in m/s^2 that ends the sweeps. Unknown: far below any that is felt.
pub(crate) const SMALL: f64 = 1e-12;

/// Deceleration in m/s^2 with which a cable stops before its end reaches a sheave or the drum that
/// it is on. Unknown: ten times that of gravity; at 5 m/s it takes 0.13 m.
pub(crate) const STOP: f64 = 100.0;

/// Deceleration in m/s^2 with which a reel that slips comes to the end of its stock. Derived: a
/// rigid stop, above any rate over any step that a host takes, so that the stretch of the rope
/// alone brakes what hangs on it.
pub(crate) const RIGID: f64 = 1e9;

/// Distance in m from the length that a reel is to come to at which it is there. Derived: the
/// rounding of a length.
pub(crate) const ARRIVED: f64 = 1e-12;

/// Share of the lengths that a table of rates asks for by which those that its acceleration gives
/// may differ without a warning. Unknown: as much as a balance may lose.
pub(crate) const SHORTFALL: f64 = 1e-2;

/// Largest share of an element that passes an eye in a step of an island. Derived: what is left is
/// no shorter than what passes.
pub(crate) const LARGEST_SHARE: f64 = 0.5;

/// Share of an element for which steps of an island are planned. Derived: a rate that nothing
/// drives may then grow by half within one.
pub(crate) const PLANNED_SHARE: f64 = LARGEST_SHARE / 1.5;
