//! Of [`study`](crate::study).

/// Elements of the first run. Unknown: fewer show no order.
pub(crate) const FIRST: usize = 4;

/// Largest number of elements of the first run, where coarser ones fail. Unknown: two doublings.
pub(crate) const LAST_FIRST: usize = 16;

/// Largest number of elements. Setting: [`Study::limit`](crate::study::Study::limit).
pub(crate) const LIMIT: usize = 160;

/// Ratio of element lengths below which a mesh is not refined. Unknown: nearer meshes show no
/// order.
pub(crate) const REFINED: f64 = 1.2;

/// A difference of this share of the longest cable is another branch. Unknown: meshes of one shape
/// differ by less.
pub(crate) const BRANCH: f64 = 0.1;

/// Ratio of element lengths over which meshes must not come closer before that is said of all finer
/// ones. Measured: a whip whose meshes of 12, 18 and 27 elements do not, and whose next one does
/// (error_target.rs of lariat-scene).
pub(crate) const AGREED: usize = 2;

/// Order that is assumed where distances show none. Unknown: between that of waves and that of
/// smooth equilibria.
pub(crate) const ASSUMED: f64 = 2.5;

/// Least and largest order. Derived: the largest is that of cubic elements.
pub(crate) const ORDERS: [f64; 2] = [0.25, 4.0];

/// Share of the allowed error that the next but one mesh is meant to have. Unknown: a miss by two
/// thirds costs no further run.
pub(crate) const AIM: f64 = 0.6;

/// Least growth of the number of elements, and the factor of a distance in a claim that belongs to
/// it. Unknown: nearer meshes show no order.
pub(crate) const LEAST: f64 = 1.5;

/// Order of the largest error of waves with kinks. Derived: `q/(q + 1)`, q = 2, in a scheme of the
/// second order whose waves of short length lag behind.
pub(crate) const KINKS: f64 = 2.0 / 3.0;

/// Largest ratio of the error of an equilibrium to the mesh indicator. Measured: 3.6 in eleven
/// cases of 2 to 40 elements (tests, mesh_indicator.rs).
pub(crate) const INDICATED: f64 = 4.0;

/// Largest order that is believed of equilibria that are smooth between their ends. Unknown: most
/// have more.
pub(crate) const SMOOTH: f64 = 2.0;

/// Factor of a distance in a claim at the first order. Derived: of a series of distances that fall
/// so.
pub(crate) const FACTOR: f64 = 1.0 / (LEAST - 1.0);

/// Points of a cable at equal distances. Derived: more than the elements of the first runs have
/// nodes.
pub(crate) const RECORDED: usize = 33;

/// Indicator of the mesh over the longest cable that is rounding. Derived: that to which statics
/// are solved.
pub(crate) const INDICATOR_ROUNDING: f64 = 1e-9;

/// Ratio of the first two tolerances. Measured: at 8 and the same steps claims are down to 0.4 of
/// the error ([`study`](crate::study) names the runs).
pub(crate) const LOOSER: f64 = 8.0;

/// Ratio of steps below which the host step limits those of both tolerances. Unknown: nearer runs
/// show no order.
pub(crate) const SATURATED: f64 = 1.25;

/// Ratio of the mean step to the equal steps that judge it. Derived: a run with up to 1.25 steps
/// per step of the host is judged by one with two, not three.
pub(crate) const SHORTER: f64 = 1.6;

/// Share of the error that is asked for which the error in time may have, and at which it aims.
/// Unknown: the mesh has the rest.
pub(crate) const SHARE: [f64; 2] = [0.4, 0.3];

/// Share of a distance below which the next one must be, if runs come closer. Derived: at the least
/// order, a tolerance of an eighth has 0.6 of the distance.
pub(crate) const CLOSER: f64 = 0.6;

/// Most rounds. Unknown: it bounds the cost.
pub(crate) const ROUNDS: usize = 5;

/// Least tolerance over the longest cable. Derived: below it steps are rounding errors.
pub(crate) const TIGHTEST: f64 = 1e-12;

/// Least number of distances between runs in ever shorter steps that a coupled study takes.
/// Derived: two show an order, and a third that it is no chance.
pub(crate) const AT_LEAST: usize = 3;

/// Least number of distances between its meshes. Derived: one shows no order.
pub(crate) const MESHES: usize = 2;

/// Least order that its distances must show. Unknown: below it an error is more than 2.4 times the
/// last distance, which two distances do not tell.
pub(crate) const HALF: f64 = 0.5;

/// Share of the error that is asked for below which distances are small. Derived: at the least
/// order the error is 5.3 times that, a twentieth.
pub(crate) const SMALL: f64 = 0.01;

/// Ratio of the errors of two runs at the second order, that of the discrete gradient. Derived:
/// steps are halved.
pub(crate) const SECOND: f64 = 4.0;

/// Most halvings of the host step. Unknown: it bounds the cost, at 64 times the first run.
pub(crate) const MOST_HALVINGS: u32 = 6;

/// Largest value of a cable over that of all, which its errors are shares of at least. Unknown:
/// what a cable carries that hangs slack beside others is rounding.
pub(crate) const LEAST_LARGEST: f64 = 1e-6;

/// Largest error of positions over the length of a cable that an error of what it carries counts
/// as. Unknown: steps of a larger one follow no motion.
pub(crate) const MOST_LENGTH: f64 = 1e-3;

/// By how much the order of two distances between tensions or moments of equilibria may be too
/// high. Unknown: half of what parts the order of one that is smooth from that of one with kinks.
pub(crate) const SURE: f64 = 0.5;
