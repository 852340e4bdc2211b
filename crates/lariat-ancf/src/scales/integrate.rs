//! Of [`integrate`](crate::integrate).

/// Largest angular frequency in rad/s of a cable for which the reference fidelity is explicit.
/// Measured: of the scenes of `docs/accuracy`, the payload (3.4e4 rad/s) is cheaper with an
/// explicit method, the pendulum with 80 elements (8.7e4 rad/s) with an implicit one.
pub(crate) const MAX_EXPLICIT_FREQUENCY: f64 = 5e4;

/// Shortest step, as a share of the host step. Derived: ten retries, each with a quarter of the
/// step.
pub(crate) const MIN_STEP_SHARE: f64 = 1.0 / (1u64 << 20) as f64;

/// Newton's tolerance in m where no error is controlled. Unknown: below any error of a step, above
/// the rounding of coordinates up to 1e5 m.
pub(crate) const FIXED_STEP_NEWTON_TOLERANCE: f64 = 1e-10;

/// Relative rounding error of a host step given in single precision. Derived: half a unit in the
/// last place is 6e-8; 1/60 s is then longer than four steps of 1/240 s.
pub(crate) const SINGLE_PRECISION_ROUNDING: f64 = 1e-7;

/// Number of parts into which a step is divided that failed. Derived: implicit methods fail by
/// nonlinearity, which the square of a step has; a quarter has a sixteenth of it.
pub(crate) const PARTS: usize = 4;

/// Length of the retry of a failed step, as a share of the step. Derived.
pub(crate) const RETRY_SHARE: f64 = 1.0 / PARTS as f64;

/// Longest step after one at which Newton's iteration failed with an inexact tangent, as a share of
/// it. Unknown: the half is not tried again at once.
pub(crate) const MAX_SHARE_OF_FAILED: f64 = 0.5;

/// Tries per regular step of fixed length in a host step after which a failure ends it. Derived: of
/// two failures at the shortest step, 2 (10 + 76), for 1.2^76 = 4^10.
pub(crate) const TRIES: u64 = 172;

/// Growth of that bound with every accepted step. Unknown: it doubles in four steps.
pub(crate) const BOUND_GROWTH: f64 = 1.2;

/// Smallest error allowed to a step, as a share of the tolerance: after a jump of velocity errors
/// fall only in proportion to h. Unknown: a thousand such steps in a host step are not expected.
pub(crate) const MIN_ERROR_SHARE: f64 = 1.0 / 1024.0;

/// Coherence of errors from which they count as those of a slow motion. Unknown: of errors without
/// order it is near none.
pub(crate) const MIN_COHERENCE: f64 = 0.25;

/// Largest error of an incoherent step, as a share of the tolerance. Unknown: the other half is
/// left to those after it.
pub(crate) const MAX_SHARE_OF_ONE_STEP: f64 = 0.5;

/// Newton's tolerance, as a share of the error per unit step. Unknown: its errors are then hidden
/// by those of the step.
pub(crate) const NEWTON_TOLERANCE_SHARE: f64 = 0.1;

/// Error for which the next step is chosen, as a share of the allowed one. Measured, without a
/// test: one half costs less than 0.8, with fewer rejections.
pub(crate) const TARGET_ERROR_SHARE: f64 = 0.5;

/// Newton iterations before a stage fails. Unknown: it converges in two to four where a step is
/// resolved.
pub(crate) const MAX_ITERATIONS: usize = 12;

/// Largest change of a slope vector, or rotation of a body in rad, in one Newton iteration.
/// Unknown: a tangent says little beyond half a radian.
pub(crate) const MAX_ROTATION: f64 = 0.5;

/// A tangent is kept for the next iteration or stage while each increment is below this share of
/// the one before. Unknown: one factorisation costs as much as two further iterations.
pub(crate) const MAX_CHORD_CONTRACTION: f64 = 0.3;

/// Share of the impulses that may be unbalanced in a stage. Unknown: forces are then right to as
/// much.
pub(crate) const FORCE_TOLERANCE: f64 = 1e-3;

/// Number of iterations after which the balance of impulses is no longer asked for: a slack cable
/// has hardly any. Unknown: four are one more than a step needs.
pub(crate) const MAX_FOR_FORCES: usize = 4;

/// Largest spurious energy in any interval of time, as a share of the largest kinetic and strain
/// energy so far. Setting: the check is documented with it (tests, energy_check.rs).
pub(crate) const MAX_ENERGY_SHARE: f64 = 0.01;

/// Largest spurious energy that is left in an accepted step where the error is controlled.
/// Derived: half of the share, so that two of them are within it.
pub(crate) const MAX_LEFT_SHARE: f64 = 0.5 * MAX_ENERGY_SHARE;

/// Shortest step, as a share of the first of the host step, that is tried for less spurious energy.
/// Derived: five retries, each with a quarter of the step.
pub(crate) const MIN_CHECKED_SHARE: f64 = 1.0 / 1024.0;

/// Coefficient a of the one-leg formula of the [discrete
/// gradient](crate::integrate::discrete_gradient) in games, and the largest. Derived: modes that a
/// step does not resolve fall
/// to a third in every step, and slow ones have the damping ratio a (h omega)^3/2.
pub(crate) const ALPHA: f64 = 1.0 / 16.0;

/// The same where the error is controlled, and in adaptive steps longer than 1/240 s. Measured:
/// thrown ropes take 1.6 times the iterations that they take with that of games, and 26 times
/// without any; slow motions lose a sixteenth.
pub(crate) const LITTLE_DISSIPATION: f64 = 1.0 / 256.0;

/// Largest number of steps that a tolerance of the discrete gradient asks for in a host step.
/// Unknown: steps that are taken although they are too long keep the energy law.
pub(crate) const MOST_STEPS: f64 = 64.0;

/// Number of steps of a first host step under a tolerance, about which nothing is known. Unknown:
/// the error of the second step is known.
pub(crate) const FIRST_STEPS: f64 = 8.0;

/// Shortest step in s under a tolerance once a limit to the work is spent. Derived: that of games,
/// which a host step can afford.
pub(crate) const STEP_BEYOND_LIMIT: f64 = 1.0 / 240.0;

/// Least and largest ratio of a step to the one before under a tolerance. Unknown: an estimate says
/// little about steps beyond.
pub(crate) const RATIOS_OF_STEPS: [f64; 2] = [0.2, 2.0];

/// Largest ratio of the retry of a step to it under a tolerance. Unknown: one that is hardly
/// shorter fails again.
pub(crate) const LARGEST_RETRY: f64 = 0.8;

/// Error of the midpoint rule as a share of h^3 v''. Derived: a twelfth.
pub(crate) const OF_MIDPOINT: f64 = 1.0 / 12.0;

/// Share of the impulses that may be unbalanced in a step under a tolerance. Unknown: what the
/// iteration leaves is then below the estimate.
pub(crate) const FORCE_TOLERANCE_UNDER_CONTROL: f64 = 1e-3;

/// Share of the impulses that the last iterate may leave unbalanced: of each body, of all of a
/// smooth step, and of a nonsmooth one whose velocities are rescaled. Measured: with 1 in place of
/// a tenth 4 of 200 ropes that a hook draws taut read up to 15 kN for 6.
pub(crate) const LARGEST_IMBALANCE: f64 = 0.1;

/// Share of the impulses of a step that may be unbalanced. Measured: the energy law alone lets
/// errors of tension pass where the motion turns fast: on a rotor, 0.13 rad per step, 20 N of 63.
pub(crate) const FORCE_TOLERANCE_OF_STEP: f64 = 0.01;

/// Share of the imbalance that an iteration with the factors of an earlier one may leave; if it
/// leaves more the next has a new tangent. Unknown: a factorisation costs some iterations.
pub(crate) const MAX_LEFT: f64 = 0.1;

/// Rounding error of the energy law as a share of its terms. Derived: that of a sum over some
/// hundred elements.
pub(crate) const LAW_ROUNDING: f64 = 1e-13;

/// Largest number of Newton iterations of a step. Unknown: what needs more is divided.
pub(crate) const MAX_ITERATIONS_OF_STEP: usize = 8;

/// Largest number of Newton iterations where terms have laws of their own to meet. Unknown: bounds
/// of friction are renewed in these.
pub(crate) const MAX_ITERATIONS_OF_LAWS: usize = 20;

/// Energy by which a nonsmooth step may miss in any case, as a share of the weight times 1 mm.
/// Unknown: the weight at a nanometre.
pub(crate) const CLOSURE_OF_WEIGHT: f64 = 1e-6;

/// Share of the velocities relative to rigid motion that rescaling may take. Derived: that of a
/// hundredth of their energy, which the balance of a step may miss in any case, 1 - 0.99^(1/2).
pub(crate) const SHARE_OF_A_HUNDREDTH_OF_THE_ENERGY: f64 = 0.005_012_562_893_380_045;

/// What it may take in the last division. Derived: that of half of their energy, 1 - 2^(-1/2).
pub(crate) const SHARE_OF_HALF_THE_ENERGY: f64 = 0.292_893_218_813_452_5;

/// Largest number of divisions of divisions. Unknown: 1/240 s is then divided down to 1 us.
pub(crate) const MAX_DEPTH: usize = 6;

/// Number of iterations that take the whole increment. Unknown: smooth steps need no more.
pub(crate) const WHOLE_INCREMENTS: usize = 4;

/// Share of the imbalance that an iteration leaves where it swings. Derived: Newton's iteration
/// leaves less wherever it converges.
pub(crate) const SWINGING: f64 = 0.5;

/// Share of the increment that is taken then. Derived: what swings between two sides has its
/// solution between them.
pub(crate) const HALF: f64 = 0.5;

/// Share of the energy of the residual by which what is left may differ from that of a linear
/// force. Unknown: below it the next iteration converges by itself.
pub(crate) const LINEAR: f64 = 0.1;

/// Share of the motion by which the momenta may be off after a step in games. Setting: the law is
/// documented with it, 1e-4 (docs/coupling.md); steps owe nearly all of it at once.
pub(crate) const MOMENTUM_TOLERANCE_OF_STEP: f64 = 1e-5;

/// The same under a tolerance. Setting: likewise, 5e-7.
pub(crate) const MOMENTUM_TOLERANCE_UNDER_CONTROL: f64 = 1e-7;

/// Largest number of divisions of divisions for what is found at the end of a step. Unknown: what
/// is missing there falls with the square of the step, to 4^-6 of it.
pub(crate) const MAX_DEPTH_OF_ENDS: usize = 3;

/// The time in s to which adaptive numbers of steps belong. Setting: a frame of most games.
pub(crate) const FRAME: f64 = 1.0 / 60.0;

/// Number of steps in it that a game takes whatever happens. Setting:
/// [`StepControl::Adaptive`](crate::StepControl::Adaptive).
pub(crate) const USUAL_IN_FRAME: f64 = 4.0;

/// Largest number of steps in it. Setting: likewise.
pub(crate) const MOST_IN_FRAME: f64 = 8.0;

/// Estimated error in that time, as a share of the size, from which on the steps of games are
/// halved. Derived: a rope that turns about its end by x in a step of 1/240 s errs by 4 (1/12 +
/// 1/16) x^3 of its length, and loses pi x^3/16 of its angular momentum in a turn, which is 1e-3
/// here.
pub(crate) const COARSE: f64 = 3e-3;

/// Largest size in m of which errors are a share. Setting: the unit of the tolerance.
pub(crate) const LARGEST_SIZE: f64 = 1.0;

/// Tolerance of [`Integrator::ADAPTIVE`](crate::Integrator::ADAPTIVE), as a share of the size in
/// [`FRAME`]. Measured: with it the pendulum and the payload of `docs/accuracy` err as in steps of
/// 1/240 s, and ropes that swing by 3 degrees take 1.7 steps in place of 4 (tests,
/// adaptive_steps.rs; docs/decisions/integration.md).
pub(crate) const ADAPTIVE_TOLERANCE: f64 = 1e-4;

/// Time in s for which a number of steps that has risen does not fall. Measured: an undamped
/// pendulum then loses less than half of what it loses without, 3.7e-3 in ten minutes at most
/// (tests, long_pendulum.rs); it has its largest error once in about a second.
pub(crate) const CALM_TIME: f64 = 0.5;

/// Evaluations of an element that one task of a thread pool takes at least. Measured: 0.1 us each
/// (docs/accuracy, watching: 2 us for 20), so 100 us, ten times what it takes to wake a thread.
#[cfg(feature = "parallel")]
pub(crate) const EVALUATIONS_OF_TASK: f64 = 1000.0;
