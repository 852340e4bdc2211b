//! Of readings of a run, and what they are worth a warning for.

/// Share of the energy of a run above which energy that it makes is warned of. Derived: a million
/// steps at their tolerance make as much.
pub(crate) const MADE: f64 = 1e-3;

/// Share of the energy of a run above which energy that integration takes is warned of. Unknown:
/// methods damp what a step does not resolve.
pub(crate) const LOST: f64 = 1e-2;

/// Share of the pull at a point above which the force of a shock is warned of. Derived: the root of
/// [`LOST`], for its wave has the square of the share of the energy.
pub(crate) const SHOCK: f64 = 0.1;

/// Strain of all cables that is the least energy to compare with, where nothing has weight and all
/// is at rest. Unknown: a tenth of [`LEAST_STRAIN`](super::LEAST_STRAIN), so that a run is judged
/// by less than its steps are.
pub(crate) const LEAST_STRAIN_OF_RUN: f64 = 1e-6;

/// Largest estimate of an error of position without a warning, as a share of the length. Measured:
/// on 30 scenes, what exceeds it or [`MOTION`] was off by 0.2 to 11 % of the length, what does not
/// by less than 0.25 % (tests, mesh_indicator.rs).
pub(crate) const ERROR: f64 = 2e-3;

/// Largest estimate of the error of a displacement without a warning, as a share of the largest
/// displacement. Measured: with [`ERROR`].
pub(crate) const MOTION: f64 = 0.1;

/// Errors of a displacement below this share of the length are those of integrators and statics.
/// Unknown: both are asked for less.
pub(crate) const ROUNDING: f64 = 1e-5;

/// Largest angle in rad between the end slopes of an element that no node judges. Unknown: a circle
/// of 31 elements has it.
pub(crate) const TURN: f64 = 0.2;

/// Largest tension over EA. Derived: elongations by Green's law are 6.6 % below Hooke's there.
pub(crate) const STRAIN: f64 = 0.05;

/// Strain below which no rope of a known make breaks, so that its make is not asked for. Derived:
/// that of a wire rope, which breaks first, at 0.356 * 1.77e9/4.6e10 = 0.0137.
pub(crate) const BREAKING: f64 = 0.01;

/// Young's modulus in Pa of a stiff solid. Derived: solids that are elastic to a strain of 0.05 are
/// rubbers, plastics and their fibres, of less than 1e10 Pa; metals, glass and the fibres of the
/// strongest ropes break or flow before.
pub(crate) const STIFF: f64 = 1e10;

/// Share by which elongations by Green's law may be below those by Hooke's. Setting: what users are
/// told; 1.5 times the strain, so from 1.35 % on.
pub(crate) const ELONGATION: f64 = 0.02;

/// Rounds of Newton's iteration for that elongation. Derived: it doubles its digits, from one on.
pub(crate) const STRAIN_ROUNDS: usize = 5;

/// Largest length of a cable over that of its points. Derived: a slack of 50 m that was meant in
/// percent makes 50 times the span.
pub(crate) const SLACK: f64 = 3.0;

/// Largest time in s of damping, axial and in bending. Derived: those of ropes are below 0.1 s, and
/// one in percent of critical is above it.
pub(crate) const SLOWEST_STRAIN: f64 = 1.0;

/// Angle in rad between normals of a mesh about which a cable bends. Derived: ten degrees, more
/// than one facet of a pulley of 36 sides; ground is flatter where a cable lies.
pub(crate) const FACET_TURN: f64 = 0.175;

/// Way along itself, in radii of contact, after which a cable that slides over facets is told.
/// Derived: one edge takes some radii.
pub(crate) const SLID: f64 = 10.0;

/// Largest rate of a reel over the speed of transverse waves. Derived: the square of it, 9 %, is
/// what the moving rope adds to its tension.
pub(crate) const REEL: f64 = 0.3;

/// Largest rate over the speed of transverse waves that is told. Derived: without tension it is
/// infinite, which no file of numbers holds.
pub(crate) const LARGEST_RATIO: f64 = 1e3;

/// Largest force that the rounding of what holds a cable may make, as a share of its largest
/// tension. Unknown: tensions are then right to as much.
pub(crate) const NOISE: f64 = 0.01;

/// Largest part of its length by which the ends of a straight cable are nearer than that. Derived:
/// a sag of 0.6 % of the span.
pub(crate) const STRAIGHT: f64 = 1e-4;

/// Largest number of elements that is advised. Derived: the largest that a cable can have.
pub(crate) const MOST: f64 = 1e6;

/// Largest depth of a contact as a share of the radius. Unknown: a surface is then off by as much.
pub(crate) const DEPTH: f64 = 0.2;

/// Largest angle in rad by which an element turns that touches. Unknown: nine elements around a
/// drum.
pub(crate) const CONTACT_TURN: f64 = core::f64::consts::TAU / 9.0;

/// Share of its tension by which a touchdown within an element may be off. Unknown: as that of
/// lengths.
pub(crate) const TOUCHDOWN: f64 = 2e-3;

/// Largest force by which an attachment pries, as a share of the largest tension or the weight.
/// Setting: what users are told.
pub(crate) const PRIED: f64 = 0.05;

/// Radii beside the piece that an attachment holds in which it pries if it touches. Derived: it
/// comes down again as far on the other side as it is pulled down on this one, several times as
/// far if it is stiff; what bends it so much touches at once.
pub(crate) const PRIED_BESIDE: f64 = 16.0;

/// The angle that is advised. Unknown: twelve elements around a drum.
pub(crate) const ADVISED: f64 = core::f64::consts::TAU / 12.0;

/// Length in diameters that runs over a cable beneath without slipping. Derived: half a turn of it.
pub(crate) const RUN: f64 = 0.5 * core::f64::consts::PI;

/// Length in diameters by which a contact of cables is followed in a host step. Unknown: of what
/// runs faster, the first steps are slower.
pub(crate) const FOLLOWED: f64 = 4.0;

/// For how long in s they may be larger. Unknown: an impact is over before.
pub(crate) const DURATION: f64 = 0.1;

/// Least length over thickness. Derived: the deflection of a Timoshenko cantilever is 0.8 % above
/// Euler's there, 3 % at 5.
pub(crate) const SLENDERNESS: f64 = 10.0;

/// Least Young's modulus in Pa. Derived: that of the softest technical elastomers.
pub(crate) const SOFTEST: f64 = 1e5;

/// Least speed of waves along a cable whose material is given, in m/s. Derived: below the 10 m/s of
/// the softest elastomers, above a thousandth of steel's.
pub(crate) const SLOWEST: f64 = 6.0;

/// Least density in kg/m^3. Derived: that of the lightest foams.
pub(crate) const LIGHTEST: f64 = 10.0;

/// Largest speed of waves along a cable whose material is given, in m/s. Derived: none is faster in
/// any solid ([`sizes`](crate::warning) names the paper).
pub(crate) const FASTEST: f64 = 3.6e4;

/// Depth in m in an obstacle, beyond the radius of contact, from which a cable is told to start in
/// it. Setting: what is drawn by hand is off by less.
pub(crate) const INSIDE: f64 = 1e-3;

/// Speed in m/s above which no current is. Derived: the fastest tidal streams have 10.
pub(crate) const FASTEST_CURRENT: f64 = 12.0;

/// Speed in m/s above which no wind is. Derived: the fastest gust that was measured had 113.
pub(crate) const FASTEST_WIND: f64 = 120.0;

/// Least density in kg/m^3 of a liquid of which drag is computed. Derived: between that of gases,
/// 10, and that of the lightest, liquid hydrogen aside, 400.
pub(crate) const LEAST_LIQUID: f64 = 100.0;

/// Strain above which only rubber stretches. Derived: undrawn fibres break below it.
pub(crate) const MOST_STRETCH: f64 = 0.5;

/// Largest diameter of contact in m. Derived: the thickest pipelines with their coating.
pub(crate) const MOST_WIDE: f64 = 1.5;

/// Largest diameter of contact over the length of a cable. Derived: twice that of a stubby one.
pub(crate) const WIDE_SHARE: f64 = 0.2;

/// Largest radius of contact over the diameter of the section. Derived: more than any sheath.
pub(crate) const SHEATH: f64 = 10.0;

/// Largest gravity in m/s^2. Derived: between what centrifuges of geotechnics have, 100 to 200 g,
/// and that of the earth in mm/s^2.
pub(crate) const STRONGEST_GRAVITY: f64 = 3000.0;

/// Largest tolerance of positions over the length. Setting: a tenth is no control of errors.
pub(crate) const LARGE_TOLERANCE: f64 = 0.1;

/// Largest coefficient of friction. Derived: above that of racing tyres, 1.7.
pub(crate) const MOST_FRICTION: f64 = 2.0;

/// Strain above which only rubber breaks. Derived: undrawn fibres, and climbing ropes, break below.
pub(crate) const STRETCHY: f64 = 1.0;

/// Largest speed of waves in rubber in m/s. Derived: of the stiffest, 4e7 Pa and 1000 kg/m^3.
pub(crate) const RUBBER: f64 = 200.0;

/// Largest secant over EA of a curve whose strains are in percent. Derived: between a fifth of
/// rubber, and a hundredth.
pub(crate) const SOFTEST_CURVE: f64 = 0.03;

/// Breaks of one cable and its parts, one after another. Setting: a part that breaks and a part of
/// it that does are of loads that were there.
pub(crate) const BREAKS: u32 = 3;

/// Largest thickness in m. Derived: above 1.42 m, the thickest pipelines.
pub(crate) const THICKEST: f64 = 1.5;

/// Largest torque times the length of an element over EI. Measured: the error of Greenhill's
/// critical torque is 0.2 % at 1.1 to 1.6, and 3 % at 2.3 to 3.3.
pub(crate) const TWIST: f64 = 1.5;

/// Length of an element over `sqrt(EI/T)` below which what bends at its end is resolved. Derived:
/// the moment is then 3 % too large (tests, end_reading.rs).
pub(crate) const LAYER: f64 = 3.0;

/// Length between two points that are held or loaded over `sqrt(EI/T)` from which on each bends by
/// itself. Derived: the moment at a load between clamps has the factor tanh(5/2) = 0.987.
pub(crate) const ROOM: f64 = 5.0;

/// Largest error of a moment at a clamp or a load as a share of it. Setting: what users are told.
pub(crate) const MOMENT: f64 = 0.1;

/// Bending strain at a clamp or a load over the axial strain below which nobody asks for the
/// moment. Unknown: a tenth.
pub(crate) const BENDS: f64 = 0.1;

/// Moment at a node where a limp cable turns, over its force, the length of the elements beside it,
/// and half the angle. Derived: k of the least `k theta^2 = int e^2 ds` by continuous functions e
/// that are quadratic on each element and theta at the node, `k = 1/8 - 1/(576 (1/8 + k))`.
pub(crate) const CORNER: f64 = 0.117_85;

/// Distance of a node from where it should be over that of the lines of the forces beside it.
/// Measured: 1 under a given tension, 0.66 where the tension is that of the load alone (tests,
/// end_reading.rs).
pub(crate) const SMEARED: f64 = 2.0 / 3.0;

/// Length of the elements at a clamp or a load over `sqrt(EI/T)` that is advised. Derived: the
/// moment is then 0.8 % too large (tests, end_reading.rs).
pub(crate) const FINEST: f64 = 2.0;

/// Ratio of the lengths of neighbours in a mesh that is advised. Unknown: between 1 and
/// [`MOST_GROWTH`](super::cable::MOST_GROWTH).
pub(crate) const GROWTH: f64 = 1.5;

/// Share of a moment about the tangent above which it is told that this does nothing. Unknown: a
/// tenth of what is asked for.
pub(crate) const ALONG: f64 = 0.1;
