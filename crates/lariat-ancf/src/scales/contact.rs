//! Of [`contact`](crate::contact). Radii are those of the cable; a reach is the sum of the radii of
//! two that touch.

/// Gap in radii of the cable below which a sample is a contact. Unknown: what an iterate may bring
/// near.
pub(crate) const NEAR: f64 = 2.0;

/// Distance in radii or reaches within which points of a cable beside a held node, or of one cable,
/// do not touch, and from which on a feature has a contact: one that begins deep has an offset.
/// Unknown: two diameters.
pub(crate) const APART: f64 = 4.0;

/// Factor on the way that is expected in a step. Unknown: it may accelerate within the step.
pub(crate) const SWEEP: f64 = 1.5;

/// Largest number of solves for the impulses of impacts that give velocity, beside the first.
/// Unknown: it ends a loop.
pub(crate) const MAX_SOLVES: usize = 8;

/// Share of these impulses that the last solve may change. Unknown: as large as what a term may
/// miss of its forces.
pub(crate) const GIVEN: f64 = 1e-3;

/// Share of the friction by which it may miss the bound. Unknown: three times what a term may miss
/// of its forces.
pub(crate) const LAG: f64 = 3e-3;

/// Share of the normal stiffness that friction has. Unknown: softer ones creep before they slip,
/// harder ones take more iterations.
pub(crate) const TANGENTIAL: f64 = 0.1;

/// Depth of the quadratic start of the normal law as a share of the cable's radius: what is no
/// deeper only touches. Unknown: a fiftieth of the radius is below what a surface is known to.
pub(crate) const RAMP: f64 = 0.02;

/// Number of chords of an element where what was missed is looked for. Derived: that of the
/// intervals of its samples.
pub(crate) const CHORDS: usize = 4;

/// Chords of a line that are boxed together between two shapes. Unknown: boxes cost less than
/// chords.
pub(crate) const CHUNK: usize = 8;

/// Largest distances of samples in an element. Derived: five points of Lobatto's rule are at most
/// 0.327 of it apart.
pub(crate) const SPACINGS: f64 = 3.0;

/// A round surface is smooth for samples if its radius, with the cable's, is so many of their
/// spacings. Derived: between two samples it recedes by a sixteenth of the spacing.
pub(crate) const WIDE: f64 = 2.0;

/// Share of what the distance of a straight cable from the core of a round surface grows by, from
/// which on its closest point acts. Derived: half way between straight and lying on the surface.
pub(crate) const STRAIGHT_ACROSS: f64 = 0.5;

/// The same for one that acted in the last step. Unknown: half of that, so that it does not come
/// and go.
pub(crate) const STAYS_STRAIGHT: f64 = 0.25;

/// The same from which on samples beside it do not act. Unknown: half way to straight, so that they
/// are there before it ends.
pub(crate) const STRAIGHT_ALONE: f64 = 0.75;

/// Intervals in which the closest point of an element is looked for. Derived: twice those of its
/// samples.
pub(crate) const INTERVALS: usize = 8;

/// Largest number of steps towards where an element meets a feature. Unknown: it ends a loop.
pub(crate) const MEETINGS: usize = 32;

/// Least share of the step that each of them takes. Unknown: a thousandth of a way is below a
/// radius.
pub(crate) const LEAST_SHARE: f64 = 1e-3;

/// Steps of the golden section. Derived: to 0.618^32 = 2e-7 of an interval, as near as a minimum is
/// known by its values.
pub(crate) const SECTIONS: usize = 32;

/// Longest chord in radii. Unknown: a chord of a bend of two radii is off by a tenth of one.
pub(crate) const CHORD: f64 = 1.3;

/// Most chords of an element. Unknown: it bounds the cost of elements far longer than the cable is
/// thick.
pub(crate) const MOST_CHORDS: f64 = 512.0;

/// Weight e of the middle of a chord. Unknown: parallel chords touch in their middle; others are
/// moved by a thousandth.
pub(crate) const CENTRING: f64 = 1e-3;

/// Steps on the tangents of the curves. Derived: Newton's, from an error of a tenth, are at
/// rounding after three.
pub(crate) const REFINEMENTS: usize = 3;

/// Halvings of an interval with a root. Derived: to 1e-12 of it.
pub(crate) const HALVINGS: usize = 40;

/// Distance, as a share of the lengths of the chords, within which lines in a plane intersect.
/// Unknown: far above rounding, far below a radius.
pub(crate) const CROSSING_ROUNDING: f64 = 1e-6;

/// Weight e of the direction of y beside those of the tangents. Unknown: as that of the middle of a
/// chord.
pub(crate) const ROLLING: f64 = 1e-3;

/// Gap in reaches below which a pair is a contact: what an iterate may still bring near. Derived: a
/// reach is two radii, so it is [`NEAR`] for cables.
pub(crate) const NEAR_PAIR: f64 = 1.0;

/// Factor on the square of a distance that rounding does not reach. Derived: coordinates of 1 km
/// are rounded by 1e-13 m, 1e-10 of 1 mm.
pub(crate) const ROUNDED: f64 = 1.0 + 1e-9;

/// Way in reaches from which on the time of touch is looked for. Derived: by less, a centre line
/// does not pass the other's.
pub(crate) const FAST: f64 = 0.5;

/// Steps of the advancement. Derived: at the least advance, a reach and a quarter.
pub(crate) const ADVANCES: usize = 64;

/// Least of these in reaches. Derived: what is no deeper only touches.
pub(crate) const LEAST_ADVANCE: f64 = RAMP;

/// Largest cosine between the tangent of the first cable and the direction to the second one.
/// Unknown: at the closest points of two curves it is none.
pub(crate) const TILT: f64 = 0.2;

/// Distance along both cables, in reaches, below which two contacts are one. Unknown: below half a
/// chord.
pub(crate) const ONE: f64 = 0.3;

/// Distance in reaches along both cables over which a contact hands on what it remembers, beside
/// the way of the step. Measured, without a test: a little less than the longest chord, for a
/// contact moves to the next one. Of those further away the normal is another: with 4, strands that
/// slid quickly over each other were taken to be on the other side, and in a knot one passed.
pub(crate) const HAND_ON: f64 = 0.8;

/// Deviation in radii of an iterate from that of the search, from which on it is made anew.
/// Unknown: closest points then are on other chords.
pub(crate) const DEVIATION: f64 = 0.5;

/// Cosine of the angle by which z may turn in a step. Unknown: 20 degrees.
pub(crate) const MAX_TURN: f64 = 0.94;

/// How deep its way may then go below where it touches, in reaches. Derived: by less, a centre line
/// does not pass the surface.
pub(crate) const MAX_DEPTH: f64 = 0.5;

/// Largest half angle in rad of a prescribed turn in a step of which friction sees the size.
/// Unknown: the Cayley map has no half turns; its tangent is finite below pi/2.
pub(crate) const MAX_HALF_TURN: f64 = 1.2;

/// Time in s in which a body's displacement by others comes to the cable, as a motion of the body,
/// and in which the offset of a cable closes. An engine's contact and the cable would pump energy
/// through each other if it came at once: each answers to what the other did a step before.
/// Unknown: some frames.
pub(crate) const CLOSING_TIME: f64 = 0.25;

/// Time in s in which the offset of an obstacle closes, if losses pay for it. Unknown: three
/// frames.
pub(crate) const OFFSET_TIME: f64 = 0.05;

/// Share of the energy lost in the last step that closing offsets may cost. Derived: below one, so
/// that closing makes no energy.
pub(crate) const PAID: f64 = 0.9;

/// Distance in radii by which others can lift a body off a cable in a step without ending the
/// contact. Unknown: five times the depth that only touches.
pub(crate) const LIFTED: f64 = 0.1;

/// Least D beside the curvature of the feature: beyond it the element follows the feature's
/// curvature, and every point is the closest. Unknown: the place of contact then moves 20 times as
/// fast as the feature.
pub(crate) const LEAST_DETERMINANT: f64 = 0.05;

/// Largest number of steps of the search. Unknown: it ends a loop.
pub(crate) const SLIDE_STEPS: usize = 24;

/// Share of the distance to which the search goes. Derived: rounding.
pub(crate) const SLIDE_ENOUGH: f64 = 1e-12;

/// Largest growth of the stiffness from one search to the next. Unknown: a shape at a tenth of the
/// stiffness is near.
pub(crate) const MOST_GROWTH: f64 = 10.0;

/// Smallest growth, below which the search has failed. Unknown: it ends a loop.
pub(crate) const LEAST_GROWTH: f64 = 1.1;

/// Size of an element in margins of the search from which on its parts are looked at. Measured: by
/// `contact --test search`; those of a short element cost no less than the whole.
pub(crate) const LONG: f64 = 4.0;

/// Largest number of halvings of a long element. Unknown: a 64th of it is looked at as a whole.
pub(crate) const TUBE_HALVINGS: u32 = 6;

/// Number of chords of a part of an element that is not halved. Unknown: comparing 64 chords costs
/// about what finding 8 balls does.
pub(crate) const FEW: usize = 8;

/// Least cosine between the tangents of a straight element and its direction, and between that and
/// one for several elements. Derived: points eight radii apart along such elements are six radii
/// apart in space, and are near below four.
pub(crate) const STRAIGHT: f64 = 0.95;

/// The same for a direction that is kept. Derived: 14 degrees, four less than the 18 of
/// [`STRAIGHT`], which an element then may turn before boxes are made anew.
pub(crate) const STAYS_ALONG: f64 = 0.97;

/// Steps for which boxes are kept of elements that go on as in this one. Unknown: a
/// wider box meets more others, and a narrower one is left sooner.
pub(crate) const KEPT_STEPS: f64 = 8.0;

/// Speed in m/s over which a contact with restitution fades that opens too fast, and the least that
/// it may open with. Derived: a bounce of 5 um, below which a cable of mm is taken to lie.
pub(crate) const SLOW: f64 = 0.01;

/// Share of the speed at which its store would throw a cable off, with which it comes up without
/// restitution. Measured: docs/decisions/restitution.md; of 0.05, 0.1 and 0.2 as much of the speed
/// of a fall is left, and with 0.2 thrown ropes stay deep.
pub(crate) const RISE: f64 = 0.1;

/// Largest product of the normals of two contacts that press a cable against each other. Derived:
/// they are more than 120 degrees apart, so that each bears half of the other's force, or more.
pub(crate) const AGAINST: f64 = -0.5;

/// Speed in m/s of approach from which on a touch is an impact. Measured: by `contact --test
/// strong_friction`; with [`SLOW`] what tension presses on a drum gives way in jerks of 20 %.
pub(crate) const IMPACT: f64 = 0.1;

/// Largest way, in depths of the touch, of a step that resolves it. Measured:
/// docs/decisions/restitution.md; from 2.2 to 3 alike.
pub(crate) const RESOLVED: f64 = 2.5;

/// Largest number of steps of the search for the depth of a force. Unknown: it ends a loop.
pub(crate) const DEPTHS: usize = 60;

/// Square of the cosine between the normal and the cable below which a sample lies on an obstacle.
/// Derived: it lies along it more than across.
pub(crate) const LIES: f64 = 0.5;

/// Share of the depth below which the secant of an energy is the mean of the forces at its ends.
/// Derived: the difference of the energies has 1e-10 of rounding there.
pub(crate) const SECANT: f64 = 1e-6;
