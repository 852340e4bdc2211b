//! Of equilibria.

/// Largest change of a slope vector, or rotation of a body in rad, in one iteration. Unknown:
/// statics begin further from their solution than steps do, which take 0.5.
pub(crate) const MAX_SLOPE_CHANGE: f64 = 0.3;

/// Largest number of iterations of one attempt, with those of its steps, as a multiple of its
/// number of steps. Unknown: it bounds the cost.
pub(crate) const MAX_ITERATIONS_OF_ATTEMPT: usize = 2;

/// Largest number of iterations of all attempts together, as such a multiple. Unknown: it bounds
/// the cost.
pub(crate) const MAX_ATTEMPTS: usize = 5;

/// Largest number of steps of dynamic relaxation. Unknown: it bounds the cost.
pub(crate) const RELAXATION_STEPS: usize = 400;

/// Largest number of halvings of a failed step. Unknown: it bounds the cost.
pub(crate) const RELAXATION_HALVINGS: usize = 4;

/// Kelvin-Voigt time in s in a relaxation by a host. Derived: vibrations of 1 to 10 Hz are damped
/// by 0.16 to 1.6 of the critical, slower ones it stops at their peaks.
pub(crate) const RELAXATION_DAMPING: f64 = 0.05;

/// Peak of the kinetic energy at rest, as a share of its largest peak. Derived: displacements are
/// 1e-5 of the first, from which the iteration converges.
pub(crate) const REST_SHARE: f64 = 1e-10;

/// Cosine of the angle between slope and chord below which the slope points backwards. Unknown: a
/// right angle, with what a mesh may be off.
pub(crate) const BACKWARD_COSINE: f64 = -0.05;

/// Stretch at a clamp below which its tangent is reversed. Unknown: far from a stretch in use,
/// which is near one.
pub(crate) const REVERSED_STRETCH: f64 = -0.1;

/// EI/(EA l^2) above which an element is thick. Derived: a round element is then 25 diameters long.
pub(crate) const THICK: f64 = 1e-4;

/// Shortest slope after a fold is straightened. Unknown: one that is no longer has no direction to
/// grow in.
pub(crate) const MIN_SLOPE: f64 = 0.1;

/// First increment, as a share of the loads. Unknown: doubled where it converges, three times.
pub(crate) const FIRST_INCREMENT: f64 = 0.125;

/// Smallest increment. Unknown: seven halvings of the first.
pub(crate) const MIN_INCREMENT: f64 = 1.0 / 1024.0;

/// Largest number of Newton iterations of one increment. Unknown: slopes turn by 0.3 in each at
/// most.
pub(crate) const MAX_ITERATIONS_OF_INCREMENT: usize = 16;

/// Number of iterations up to which an increment is doubled. Unknown: about half of those that it
/// has.
pub(crate) const FEW_ITERATIONS: usize = 9;

/// Change of slopes below which an increment within the ramp has converged. Derived: the square of
/// it is the error that is left.
pub(crate) const INTERMEDIATE_CHANGE: f64 = 1e-4;

/// Change of slopes that is rounding. Derived: some hundred units in the last place.
pub(crate) const RAMP_ROUNDING: f64 = 1e-13;

/// Change of slopes below which increments that do not fall are rounding. Unknown: above what a
/// matrix of condition 1e10 leaves.
pub(crate) const STAGNATION: f64 = 1e-6;

/// Residual, as a share of the loads, below which a shape carries a part of them. Unknown: forces
/// are then right to as much.
pub(crate) const CARRIED_RESIDUAL: f64 = 1e-4;

/// Largest number of Newton iterations, of a polish and of one step of an island. Derived: as many
/// as a stage of a step has.
pub(crate) const MAX_ITERATIONS: usize = 12;

/// Number of times that increments have to stop to fall. Unknown: one may rise by chance.
pub(crate) const MAX_STAGNATIONS: usize = 3;

/// Change of slopes below which no further increment is needed. Derived: the next one is its
/// square.
pub(crate) const CONVERGED: f64 = 1e-12;

/// Newton iterations that make a step that raised the energy an implicit one. Unknown: it bounds
/// the cost.
pub(crate) const IMPLICIT_ITERATIONS: usize = 6;

/// Growth of the residual above which a step that lowered the energy is made an implicit one too.
/// Unknown: a step into a stiff direction raises it.
pub(crate) const MAX_RESIDUAL_GROWTH: f64 = 4.0;

/// Residual, as a share of the loads, at which an indefinite matrix is taken for that of a saddle.
/// Derived: at [`CARRIED_RESIDUAL`] a shape carries the loads.
pub(crate) const NEAR_SADDLE: f64 = 1e-4;

/// Number of shapes of small residual that may be improved without success before the shape is
/// taken for an indifferent one. Unknown: it bounds the cost.
pub(crate) const MAX_FAILED_POLISHES: usize = 3;

/// Number of saddles that are left. Unknown: it bounds the cost.
pub(crate) const MAX_SADDLES: usize = 3;

/// Smallest mu after a failed step, as a share of its first value. Unknown: the step then is
/// explicit.
pub(crate) const MIN_MU: f64 = 1e-6;

/// Largest mu, as a share of its first value. Unknown: beyond it the step is Newton's but for
/// rounding.
pub(crate) const MAX_MU: f64 = 1e15;

/// Factor on the step after a success. Unknown: it doubles in three steps.
pub(crate) const FLOW_GROWTH: f64 = 1.3;

/// Factor on the step after a failure. Derived: that of a failed step in motion.
pub(crate) const FLOW_REDUCTION: f64 = 0.25;

/// Change of a slope in a step below which the cable is at rest. Unknown: what is left is done by
/// Newton's iteration.
pub(crate) const FLOW_AT_REST: f64 = 1e-7;

/// Successive failures after which the search ends. Derived: the step is 1e-7 of the first then.
pub(crate) const MAX_FAILURES: usize = 12;

/// Inverse iterations. Unknown: mu is within a factor of 4 of the lowest lambda, so they converge
/// fast.
pub(crate) const INVERSE_ITERATIONS: usize = 40;

/// Share of every mode in the start. Unknown: so that none is missing.
pub(crate) const SMALL_SHARE: f64 = 1e-6;

/// Largest change of a slope by which the shape is displaced. Unknown: enough to leave a saddle,
/// without another shape.
pub(crate) const DISPLACEMENT: f64 = 0.02;

/// Largest lambda of a saddle, as a share of the first mu. Unknown: above rounding.
pub(crate) const NEGATIVE: f64 = -1e-6;

/// Growth of mu of a saddle, and of c2 after a step. Unknown: that of a factor of four in the
/// stiffness that it is compared with.
pub(crate) const GROWTH: f64 = 4.0;

/// Change of a span, as a share of its unstretched length, above which it is laid out anew.
/// Unknown: Newton's iteration follows less.
pub(crate) const MAX_SPAN_CHANGE: f64 = 0.1;

/// Smallest distance of the ends of a span, as a share of its length, for an arc. Unknown: an arc
/// of less is nearly a whole circle.
pub(crate) const MIN_OPENING: f64 = 0.05;

/// Reduction of c2 after a rejected step. Unknown: three times as short a step, for c2 is the
/// square.
pub(crate) const REDUCTION: f64 = 0.1;

/// Largest c2, as a multiple of the first. Unknown: the step is Newton's then.
pub(crate) const MAX_C2: f64 = 1e8;

/// Smallest c2, as a multiple of the first. Unknown: the search has failed then.
pub(crate) const MIN_C2: f64 = 1e-16;

/// c2 of the test of stability, as a multiple of the first. Unknown: far above any stiffness that
/// counts.
pub(crate) const STABILITY_C2: f64 = 1e6;

/// Increment of an island that is converged, as a share of the length. Derived: some hundred units
/// in the last place.
pub(crate) const ISLAND_CONVERGED: f64 = 1e-13;

/// Increment below which increments of an island may stop to fall, as a share of the length.
/// Unknown: as large as the displacement at rest.
pub(crate) const ISLAND_STAGNATION: f64 = 1e-8;

/// Displacement of a step at the end, as a share of the length. Unknown: below what is asked of
/// equilibria.
pub(crate) const AT_REST: f64 = 1e-8;

/// Shares of the depth in which cables are that loads have in the first, softened law of contact.
/// Derived: loads act over a radius R, and not all of the length L, so that they have up to L/R
/// times the depth of their mean; a law in which that is more than what they press on is thick lets
/// them through.
pub(crate) const SOFTNESS: [f64; 4] = [1.0, 1e-1, 1e-2, 1e-3];

/// Largest force with which an obstacle may hold a cable along itself without friction, as a share
/// of the tension. Measured: 2e-3 on a rounded edge of 33 rope radii with 40 elements, 0.86 on a
/// sharp one (`a_rope_stays_on_the_side_on_which_it_was_drawn`).
pub(crate) const SNAG: f64 = 0.05;

/// Displacement that leaves a saddle, as a share of the length. Unknown: enough to leave it,
/// without another shape.
pub(crate) const SHAKE: f64 = 1e-3;

/// Largest number of times that a saddle is left. Derived: as for a cable.
pub(crate) const MAX_SHAKES: usize = 3;

/// Stiffness of a joint in statics, as a multiple of the largest one of an element, and of all
/// loads over the length. Unknown: the error of its multiplier falls by at least as much in each
/// search.
pub(crate) const JOINT_STIFFNESS: f64 = 10.0;

/// Change of a multiplier of a joint over its stiffness, as a share of the length or in rad, below
/// which it stays. Derived: a hundredth of [`AT_REST`].
pub(crate) const JOINT_STAYS: f64 = 1e-10;

/// Largest number of times that material runs over sheaves. Unknown: it bounds the cost.
pub(crate) const MAX_PASSES: usize = 60;

/// Largest length that runs over a sheave at a time, as a share of its shorter cable. Unknown: the
/// search follows from one shape to the next.
pub(crate) const MOST_PASSED: f64 = 0.1;

/// Difference of the pulls at a sheave, as a multiple of the largest residual of an equilibrium.
/// Unknown: each pull is as good as that.
pub(crate) const PULLS: f64 = 10.0;

/// Levers of bodies below this share of the longest cable are none. Derived: single precision, in
/// which Rapier has the positions of bodies and their anchors.
pub(crate) const LEVER_ROUNDING: f64 = f32::EPSILON as f64;

/// First share of what drives a shape. Unknown: doubled where it converges, twice.
pub(crate) const FIRST_SHARE: f64 = 0.25;

/// Smallest change of it. Unknown: six halvings of the first.
pub(crate) const LEAST_SHARE: f64 = 1.0 / 256.0;

/// Most products of the matrix of statics in a flow with a vector, in one iteration. Unknown: it
/// bounds the cost.
pub(crate) const MOST_PRODUCTS: usize = 40;

/// Residual of its equations, as a share of the right side, that is small. Unknown: an iteration
/// then gains as many digits.
pub(crate) const PRODUCTS_CONVERGED: f64 = 1e-4;

/// Displacement by which a product is taken, as a share of the length. Derived: between the square
/// root of rounding, 1e-8, and what bends a stiff element.
pub(crate) const PRODUCT_DISPLACEMENT: f64 = 1e-7;

/// Tension in an element at rest, as a multiple of what pulls, beyond which it strains itself.
/// Measured: at bends within a thousandth of an element one Gauss point carries up to five times
/// the load; elements that are folded hold more than two hundred times as much. Two turns at a
/// coefficient of friction of 0.25 are 23 times.
pub(crate) const SELF_STRESS: f64 = 30.0;

/// Least strain that is judged so. Derived: less displaces points by rounding of a drawing.
pub(crate) const SELF_STRAIN: f64 = 1e-5;
