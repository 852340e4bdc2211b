//! Of [`cable`](crate::cable): descriptions, shapes, loads that break.

/// Largest number of elements of a cable. Setting: the range of
/// [`CableBuilder::elements`](crate::CableBuilder::elements).
pub(crate) const MAX_ELEMENTS: usize = 1_000_000;

/// Similarity (0 to 1) below which a name is not proposed. Unknown: a slip of the pen is above it,
/// another word below.
pub(crate) const LEAST_SIMILARITY: f64 = 0.8;

/// Number of times for which the wave of a break runs through a part while that recoils. Derived:
/// the period of a part of which one end is held, after which its tension is back.
pub(crate) const WAVE_PASSES: f64 = 4.0;

/// Ways in lengths of a part that recoils at the speed of its energy. Derived: it flies past the
/// end that is held, until it is taut on the other side.
pub(crate) const WAYS_OF_RECOIL: f64 = 2.0;

/// Depth between samples as a multiple of that at the deepest of them. Unknown: parabolas through
/// two samples and a summit.
pub(crate) const BETWEEN: f64 = 2.0;

/// Largest ratio of the lengths of neighbours in a graded mesh. Unknown: waves of four elements are
/// then longer than two of the next.
pub(crate) const MOST_GROWTH: f64 = 2.0;

/// Distance over the length of a cable within which a point is at a node. Derived: beyond rounding.
pub(crate) const AT_NODE: f64 = 1e-9;

/// Cosine of the angle between normals that point to one side. Derived: those of an edge of 120
/// degrees; a sharp edge has others.
pub(crate) const SAME_SIDE: f64 = 0.5;

/// Points of an element that are looked at for an overlap, without its last node. Derived: twice
/// the intervals of the samples of contact.
pub(crate) const OVERLAP_POINTS: usize = 8;

/// Energy over EA L below which a shape stays as drawn. Derived: that of a strain of 1.4e-3, which
/// cables have in use.
pub(crate) const STAYS: f64 = 1e-6;

/// Energy over EA L at which the iteration ends. Measured: random polylines end below 1e-7 (tests,
/// corners.rs).
pub(crate) const ENOUGH: f64 = 1e-8;

/// Largest number of iterations of an unstrained shape. Unknown: it ends a loop.
pub(crate) const MOST_ITERATIONS: usize = 200;

/// First damping as a share of the mean diagonal, and its largest. Derived: at first as stiff as
/// the shape; at last no step is above rounding.
pub(crate) const DAMPING: [f64; 2] = [1.0, 1e12];

/// Factor of the damping after a step; its inverse cubed after one that failed. Unknown: as trust
/// regions have it.
pub(crate) const EASE: f64 = 0.5;

/// Share by which a slack cable is longer than drawn. Derived: beyond rounding.
pub(crate) const SLACK: f64 = 1e-9;

/// Largest turn in rad of a clamp between two searches for equilibrium. Derived: as much as statics
/// turn a slope in one iteration.
pub(crate) const LARGEST_TURN: f64 = 0.3;

/// Angle in rad up to which a slope has the direction of its clamp. Derived: beyond rounding.
pub(crate) const SAME_DIRECTION: f64 = 1e-9;

/// Bend of a straight strut over its length. Derived: the rounding of single precision, in which
/// hosts have positions.
pub(crate) const BEND: f64 = f32::EPSILON as f64;

/// Share of that bend below which a cable counts as straight. Derived: it grows from there as well.
pub(crate) const UNBENT: f64 = 0.1;

/// Half waves of that bend. Unknown: which of them grows fastest depends on the load.
pub(crate) const WAVES: usize = 8;

/// Share of the Euler load that is left to a span whose angle is that of another one. Derived:
/// below the three quarters that the other one leaves it.
pub(crate) const COUPLED: f64 = 0.5;

/// Strain by which an element of a strut is compressed. Derived: beyond rounding.
pub(crate) const COMPRESSED: f64 = 1e-9;

/// Factor by which a strut that was bent is compressed more when it is bent again. Derived: what is
/// left of the bend grows by itself beyond the load of its supports; a step of a load is seen.
pub(crate) const BENT_AGAIN: f64 = 1.25;

/// Share of the duration of a prescribed motion by which a time is after its end. Derived: beyond
/// rounding, so that a motion that follows begins with the velocity at the end.
pub(crate) const AFTER: f64 = 1e-9;

/// Largest nominal diameter in m of a rope or chain by name. Derived: beyond 0.36 m the cubic of
/// the breaking load of chain falls.
pub(crate) const LARGEST_ROPE: f64 = 0.35;

/// Share by which tension or sag may miss what a length was asked for. Derived: statics find shapes
/// to about that.
pub(crate) const SPAN_WITHIN: f64 = 1e-8;

/// Longest slack, in drawn lengths, in which a tension is sought. Derived: a rope five times as
/// long as its span bends within a thirtieth of its length, where meshes of tens of elements end.
pub(crate) const SPAN_SLACKEST: f64 = 4.0;

/// Rounds of the search for that length. Derived: bisection of a factor 2 down to rounding.
pub(crate) const SPAN_ROUNDS: usize = 50;

/// Divisor of `w L angle` in the largest error of the tension of a cable that leaves what it lies
/// on within an element. Measured: 13 and more of a chain at 100 offsets, by where in the element
/// it leaves (`tests/contact/statics.rs`).
pub(crate) const TOUCHDOWN_ERROR: f64 = 12.0;

/// Load over its limit above which it is asked when within an integration step it came there.
/// Setting: by so much more than its strength a cable pulls before it breaks.
pub(crate) const OVERSHOOT: f64 = 1.05;
