//! The tuned numbers of this crate: thresholds, tolerances and factors, each with the reason of its
//! value.
//!
//! | a reason | says |
//! |---|---|
//! | *Derived* | that the value follows from what it names |
//! | *Measured* | where it was measured, and what other values do |
//! | *Setting* | that it is the default of something that a user chooses |
//! | *Unknown* | what it does; why it has this value and no other was not recorded |
//!
//! Coefficients of the equations at the head of a file are no tuned numbers, and stand beside them.

/// Share of a time by which sums and quotients of Rapier's time steps may be off. Unknown: about
/// eight units in the last place of single precision, in which Rapier keeps its steps.
pub(crate) const TIME_ROUNDING: f64 = 1e-6;

/// Units in the last place by which a place or velocity of Rapier's may be off, where it is
/// compared with that of a cable. Unknown: with four solver iterations, Rapier's default,
/// [`rounding`](crate::body::pose::rounding) has as many.
pub(crate) const HOST_ROUNDING: f64 = 4.0;

/// Of [`body`](crate::body).
pub(crate) mod body {
    /// Largest rotation of a body in a Rapier step, in rad, unless it is allowed to rotate faster.
    /// Derived: Rapier's own.
    pub(crate) const MAX_ROTATION_PER_STEP: f64 = core::f64::consts::FRAC_PI_4;

    /// Share of the angular velocity of a kinematic body from which it is told that Rapier turns it
    /// otherwise. Setting: half of the error that is promised to be told.
    pub(crate) const LOST_SPIN: f64 = 0.05;

    /// Half of the rotation in a substep, in rad, up to which angular velocities are corrected for
    /// Rapier's linearised rotation. Unknown: its tangent, which corrects it, is finite below pi/2.
    pub(crate) const MAX_HALF_ROTATION: f64 = 1.2;

    /// Speed in m/s, and rad/s, up to which a body is led back from where single precision rounded
    /// it. Derived: a quarter of that to which Rapier limits bodies, 400 m/s; the rounding of a
    /// place within 100 km in a step of 1e-4 s is 70 m/s. One that is not led back lies still until
    /// its way is as long as the rounding.
    pub(crate) const LEADING_SPEED: f64 = 100.0;

    /// Mass of a ledger in kg. Derived: an impulse of 1e3 N s moves it at 1e-6 m/s.
    pub(crate) const LEDGER_MASS: f64 = 1e9;

    /// Share of that mass from which a body is a ledger. Unknown: a body of a user that is as heavy
    /// is taken for one.
    pub(crate) const LEDGER_SHARE: f64 = 0.5;

    /// Target in m/s or rad/s of a motor that exerts a force or moment alone. Derived: far above
    /// any velocity, so that it hardly depends on that of the body.
    pub(crate) const FORCE_TARGET: f64 = 1e6;

    /// Damping in N s/m or N m s below which there is no motor. Derived: Rapier takes one whose
    /// product with a substep is below 1e-20 for a rigid one; this is the bound for a substep of
    /// 1e-6 s.
    pub(crate) const MIN_MOTOR_DAMPING: f64 = 1e-14;

    /// Steps at the present velocities in which two bodies may meet. Derived: the next one, and the
    /// one after it, since the reaction of a body that chatters is expected again, and Rapier's
    /// list of pairs may be one step old.
    pub(crate) const STEPS_AHEAD: f64 = 2.0;

    /// Distances at which Rapier makes contacts, within which two bodies may touch. Unknown: why
    /// more than one.
    pub(crate) const PREDICTION_DISTANCES: f64 = 2.0;

    /// Time in s over which steps of a body on joints are counted. Derived: blows, a start with a
    /// jolt and a joint that comes to its limit do not last so long.
    pub(crate) const SETTLE_WINDOW: f64 = 0.5;

    /// Share of the impulses on a body from which a deviation counts, and share of the impulses of
    /// cables from which what is read of them is wrong. Measured: random chains (tests, chains.rs),
    /// below 1e-2 where the force is right, as [`unsettled`](crate::body::unsettled) says.
    pub(crate) const SETTLE_SHARE: f64 = 0.05;

    /// Share of steps that deviate from which a body is unsettled. Measured: random chains (tests,
    /// chains.rs), one in ten where the force is right.
    pub(crate) const SETTLE_STEPS: f64 = 0.25;

    /// Share of the way of a body from which a gap of its joints is told. Setting: the error of
    /// position that is promised to be told.
    pub(crate) const JOINT_WAY: f64 = 0.1;

    /// Share of the arm of a joint from which its gap is told of a body at rest. Setting: that of
    /// the length of a cable from which its positions are warned of.
    pub(crate) const JOINT_GAP: f64 = 2e-3;

    /// Time in s and Rapier steps for which a gap must last. Derived: a blow opens a joint for a
    /// step or two, until Rapier has corrected its position.
    pub(crate) const JOINT_TIME: f64 = 0.05;

    /// Rapier steps for which a gap must last. Derived: as above.
    pub(crate) const JOINT_STEPS: u32 = 3;

    /// Speed in m/s below which a deviation is rounding. Unknown: what Rapier's rounding gives to
    /// bodies at rest is to be below it.
    pub(crate) const SETTLE_SPEED: f64 = 1e-4;

    /// Share of the speed below which a deviation is rounding. Unknown: some thousand units in the
    /// last place of single precision.
    pub(crate) const SETTLE_SPEED_SHARE: f64 = 1e-4;
}

/// Of [`mechanism`](crate::mechanism).
pub(crate) mod mechanism {
    /// Share by which the diagonal of G M^-1 G^T is raised. Unknown: it keeps the matrix regular
    /// where joints lock the same motion twice.
    pub(crate) const REGULARISATION: f64 = 1e-12;

    /// Share of the mass of a mechanism below which a body of it may be a light link. Derived: of
    /// one that is not, nine tenths of an error are gone after two substeps.
    pub(crate) const LIGHT_LINK: f64 = 0.1;

    /// The same where the forces of the joints themselves are asked for. Unknown: what does not
    /// agree of joints that lock the same motion twice is not to count.
    pub(crate) const REGULARISATION_OF_OPENING: f64 = 1e-6;

    /// z below which the implicit share of damping is a series. Derived: the next term, z^3/720,
    /// and the rounding of the difference of two inverses are both about 1e-12 there.
    pub(crate) const SERIES: f64 = 1e-3;

    /// e: share of its own mobility that a body keeps along what its joints hold. Unknown: it keeps
    /// the matrix regular; steady loads do not move bodies by it (test
    /// rigid_chains_on_damped_ropes_are_exact).
    pub(crate) const JOINT_COMPLIANCE: f64 = 1e-4;

    /// c of a mechanism that touches nothing. Measured: an arm that is struck open; 0.01 works as
    /// well, and with 1e-3 one of six runs failed ([`group`](crate::mechanism)).
    pub(crate) const ISOLATED_COMPLIANCE: f64 = 0.1;

    /// Largest number of bodies of a chain of impulse joints; those beyond count as free. Unknown:
    /// it bounds the cost of a dense matrix of six rows for each.
    pub(crate) const MAX_BODIES: usize = 24;

    /// Distance in m or rad within which a joint is at a limit. Measured: an arm on a soft rope
    /// ([`limits`](crate::mechanism)) carries its weight to 0.1 N of 14.7, and with 1e-4 down to
    /// 12.5 N.
    pub(crate) const LIMIT_DISTANCE: f64 = 1e-3;

    /// Rate in m/s or rad/s at which a joint leaves a limit. Measured: with the distance; at a rate
    /// of 1 the same arm chatters between 5 and 24 N.
    pub(crate) const OPENING_RATE: f64 = 0.1;
}

/// Of [`contents`](crate::contents).
pub(crate) mod contents {
    /// Largest distance in m of a point from what it is attached or tied to. Setting:
    /// [`Gap::Refuse`](crate::Gap::Refuse).
    pub(crate) const ATTACHMENT_GAP: f64 = 1e-3;

    /// Largest gap of an attachment without a warning, as a share of the length of the cable.
    /// Derived: the error of positions from which a mesh is told to be coarse.
    pub(crate) const OPEN_GAP: f64 = 2e-3;
}

/// Of [`edit`](crate::edit).
pub(crate) mod edit {
    /// Share of the length of a cable that was cut, by which what is behind its new end still is at
    /// it. Derived: far above the rounding of `f64`, far below an element.
    pub(crate) const AT_CUT: f64 = 1e-9;
}

/// Of [`contact`](crate::contact). Radii are those of the cable.
pub(crate) mod contact {
    /// Number of elements of a cable in a box. Unknown: fewer boxes to look up against boxes that
    /// fit.
    pub(crate) const CHUNK: usize = 8;

    /// Radii by which the boxes of the beginning of a step are grown. Derived: features are looked
    /// for from four on, and two are left for what a cable and its ends do beyond their velocities.
    pub(crate) const MARGIN: f64 = 6.0;

    /// Radii by which the boxes of the whole step are grown. Derived: contacts of cables are looked
    /// for within two.
    pub(crate) const REACH: f64 = 2.0;

    /// Factor on the way of a cable in a step. Unknown: it may accelerate within the step; for
    /// cables among each other what it missed is found after the step.
    pub(crate) const SWEEP: f64 = 2.0;

    /// Radii of a cable beside an attachment that do not touch the body. Unknown: as many as those
    /// from which features are looked for.
    pub(crate) const HELD: f64 = 4.0;

    /// Radii within which a node is in a collider that the cable cannot touch. Unknown: at one
    /// radius it would touch the surface.
    pub(crate) const IGNORED: f64 = 0.5;

    /// Sine of the angle between two triangles below which they are one face. Unknown: far above
    /// the rounding of their vertices.
    pub(crate) const FLAT: f64 = 1e-3;
}

/// Of [`step`](crate::step).
pub(crate) mod step {
    /// Smallest number of Rapier steps in a host step. Setting:
    /// [`Settings::rapier_steps`](crate::Settings::rapier_steps).
    pub(crate) const RAPIER_STEPS: u32 = 1;

    /// Largest number of Rapier steps in a host step. Setting:
    /// [`Settings::max_rapier_steps`](crate::Settings::max_rapier_steps).
    pub(crate) const MAX_RAPIER_STEPS: u32 = 32;

    /// Length in s of the piece of a host step for which that number holds; a longer host step has
    /// as many for each. Derived: a host step of seconds is then stepped as finely as one of 30 Hz,
    /// the coarsest that the other numbers were measured with.
    pub(crate) const LONGEST_PIECE: f64 = 1.0 / 30.0;

    /// Time in s over which a deviation of a body counts that a shorter Rapier step made: what
    /// single precision rounds would else read as a force of 1/h, and of the place of a body as one
    /// of 1/h^2. Derived: the finest Rapier step of a host step of 1/60 s, 32 of them:
    /// with 1/960 s a cube of 1 kg that a steel bar jams, which needs those, holds its tension no
    /// more to 0.2 % (tests, contact.rs).
    pub(crate) const SHORTEST_REACTION: f64 = 1.0 / 1920.0;

    /// Speed in m/s below which cables and bodies may sleep. Setting:
    /// [`Settings::sleep_speed`](crate::Settings::sleep_speed).
    pub(crate) const SLEEP_SPEED: f64 = 2e-3;

    /// Relative change of the force at an attachment that is allowed while a body falls asleep.
    /// Unknown: loads fall asleep and slow ones do not (tests, sleep.rs).
    pub(crate) const STEADY_FORCE_CHANGE: f64 = 2e-3;

    /// Rate in rad/s of the twist of a cable below which it may sleep: Rapier's own limit, half a
    /// radian per second, is far from the rest of a load that turns on its rope. Derived:
    /// [`STEADY_FORCE_CHANGE`] of the torque of a radian in the half second in which a body falls
    /// asleep.
    pub(crate) const SLEEP_SPIN: f64 = 4e-3;

    /// Share of a Rapier step that is left at least where it is divided at a break. Measured: of a
    /// crate that snaps a rope in a 24th of a Rapier step the load is a tenth above the strength in
    /// a 240th (`tests/coupling/ropes.rs`); 1/64 left 10.2 %.
    pub(crate) const SHORTEST_REST: f64 = 1.0 / 1024.0;

    /// Longest step in s of the integrator that takes over when a budget is spent. Unknown: the
    /// bound of the work counts with it (test no_host_step_exceeds_its_budget).
    pub(crate) const CHEAPEST_STEP: f64 = 1.0 / 240.0;

    /// Length in s of a frame, for which the budget of games is. Derived: 60 frames per second.
    pub(crate) const FRAME: f64 = 1.0 / 60.0;

    /// Newton iterations of an island in a frame of a game. Measured: of 5400 host steps in random
    /// worlds (tests, seeds) none takes more than 53, and half of them 4.
    pub(crate) const ITERATIONS_OF_GAMES: f64 = 2000.0;

    /// Largest h w of a body on its cables. Measured: jams of 1 kg under 1 and 5 kN
    /// ([`substepping`](crate::step::substepping)); 0.9 fails where two bodies hang on each other.
    pub(crate) const MAX_PHASE: f64 = 0.6;

    /// Rapier steps in a host step of a body that joints hold, whose reactions are estimated from
    /// step to step. Measured: with one, arms that close at a limit or are near a body blow up
    /// (tests, arms.rs, joints.rs).
    pub(crate) const JOINTED_STEPS: f64 = 4.0;

    /// Largest share of its velocity that a body on impulse joints loses per radian. Measured: a
    /// bar on a hinge keeps its spin (tests, substepping.rs); in four Rapier steps at any speed it
    /// lost 10 % at 3 rad/s.
    pub(crate) const MAX_LOSS: f64 = 5e-3;

    /// Share of the energy of a body with added mass by axes that what Munk's moment lacks in a
    /// step may have. Setting: that which a run may make.
    pub(crate) const MAX_OWED: f64 = 0.01;

    /// Largest error in rad of the attitude at which a mechanism is predicted. Measured: random
    /// booms follow their fine runs (tests, seeds/booms.rs); that other values were tried is not
    /// recorded.
    pub(crate) const MAX_TURN_ERROR: f64 = 0.01;

    /// Share of a cable's slack by which its chord may grow. Derived: 1 - 2^(-2/3), at which its
    /// stiffness doubles.
    pub(crate) const SLACK_SHARE: f64 = 0.37;

    /// Share of the length of an element by which a collision may displace its end in a Rapier
    /// step. Derived: by more it would fold the element.
    pub(crate) const DEVIATION_SHARE: f64 = 0.5;

    /// Largest change of velocity of a body that collides, per speed of the collision. Derived: an
    /// elastic rebound from what does not move.
    pub(crate) const MAX_REBOUND: f64 = 2.0;

    /// Share of the force at an attachment from which a reaction estimate counts. Unknown: what is
    /// smaller is taken for none.
    pub(crate) const MIN_REACTION: f64 = 0.1;

    /// Share of the observed reaction that the estimate takes in a step. Unknown: it smooths over
    /// three steps or so.
    pub(crate) const REACTION_GAIN: f64 = 0.3;

    /// Share of the body's own mobility in B. Unknown: with all of it a motor is soft for a light
    /// body, with none it is as hard as the cable.
    pub(crate) const MOBILITY_SHARE: f64 = 0.1;

    /// Mass in kg given to a junction, which has none. Unknown: it makes the matrix finite.
    pub(crate) const JUNCTION_MASS: f64 = 1e-6;

    /// Longest step in s of an integrator that controls the error of cables, which does not see
    /// that of the bodies. Measured: two balls on a cable lose 3e-5 of their angular momentum in 10
    /// s if only the cable chooses the step, and 4e-7 with this bound (`lariat coupling`).
    pub(crate) const MAX_CONTROLLED_STEP: f64 = 1.0 / 240.0;

    /// Largest number of parts in which a Rapier step is integrated under error control. Unknown:
    /// it bounds the work of a long step.
    pub(crate) const MAX_PARTS: f64 = 1024.0;

    /// Least Kelvin-Voigt time, in Rapier steps, of cables on a body with a reaction estimate,
    /// under error control. Measured: waves between jammed bodies do not grow (tests, contact.rs).
    pub(crate) const MIN_DAMPING: f64 = 0.1;

    /// Gap at a link of a multibody, as a share of the length of the cable, beyond which the island
    /// is refused if the gap grows. Unknown: as large as the gap that is told of any attachment.
    pub(crate) const MAX_LINK_GAP_SHARE: f64 = 2e-3;

    /// Units of rounding of its position within which a body landed where it was predicted.
    /// Unknown: every substep rounds.
    pub(crate) const POSITION_ROUNDING: f64 = 32.0;

    /// Units of rounding of the velocity that it was given, within which a body landed. Unknown:
    /// Rapier adds up balanced forces in every substep.
    pub(crate) const VELOCITY_ROUNDING: f64 = 256.0;
}

/// Of [`statics`](crate::statics).
pub(crate) mod statics {
    /// Distance in m within which two colliders touch. Unknown: within it a body is taken to stand
    /// on another.
    pub(crate) const TOUCH: f64 = 1e-3;

    /// Way in m on which a body that nothing holds is looked for what it would fall on. Derived: no
    /// body falls as far within the 30 s of a relaxation.
    pub(crate) const FALL: f64 = 4.5e3;

    /// Host step in s of a relaxation. Derived: that of games.
    pub(crate) const RELAXATION_STEP: f64 = 1.0 / 60.0;

    /// Largest number of its host steps: 30 s. Setting.
    pub(crate) const RELAXATION_STEPS: u32 = 1800;

    /// Least numbers of host steps from one stop to the next, in turn. Derived: a quarter of a
    /// second to a second, quarters of the periods of pendulums of 0.25 to 4 m.
    pub(crate) const WINDOWS: [u32; 3] = [15, 30, 60];

    /// Host steps after a stop in which what rests does not move. Derived: a quarter of a second,
    /// in which gravity moves what it is not balanced on by 0.3 m.
    pub(crate) const STILL_STEPS: u32 = 15;

    /// Largest way in that time over the largest length of a cable. Setting: forces are then
    /// balanced to some 1e-5 of the weights.
    pub(crate) const STILL: f64 = 1e-6;

    /// Factor on that where nothing is touched that statics do not compute. Measured: the trial of
    /// a moored platform in 1.5 m/s of current moves by 3.5 times as much, though it stands
    /// (`tests/from_rest.rs` of lariat-scene); a rope that was found with 1.3 % too much force over
    /// a drum by more than ten times (`tests/bodies/laid_over.rs`).
    pub(crate) const UNTOUCHED: f64 = 10.0;
}

/// Of [`read`](crate::read).
pub(crate) mod read {
    /// Largest difference of velocities in m/s at the start of an attachment without a warning.
    /// Unknown: scenes have the same.
    pub(crate) const JOLT: f64 = 1e-5;

    /// Largest distance of an anchor from the origin of a dynamic body over the radius of its
    /// colliders. Derived: no hook is further from its body; scenes have the same.
    pub(crate) const FAR_ANCHOR: f64 = 3.0;

    /// Density in kg/m^3 below which no water is. Derived: fuels have 700, liquid gas 430.
    pub(crate) const LIGHT_WATER: f64 = 400.0;

    /// Depth in m, besides half the thickness of the cable, that is not taken for touching.
    /// Unknown: a millimetre.
    pub(crate) const TOUCHING: f64 = 1e-3;

    /// Points per element, of which one is a node, at which a cable is looked for in colliders.
    /// Unknown: lines between them find what is thinner.
    pub(crate) const POINTS: usize = 4;

    /// Places of a drawn and a found line that are matched with each other. Unknown: it bounds the
    /// cost, of its square.
    pub(crate) const MATCHED: usize = 400;

    /// Largest product of the normals of two faces that are opposite. Derived: those of an edge of
    /// 60 degrees.
    pub(crate) const OPPOSITE: rapier::math::Real = -0.5;

    /// Share by which a place must be deeper than another to be told in its stead. Derived: of
    /// places that are equal but for rounding, the first.
    pub(crate) const DEEPER: f64 = 1e-6;

    /// Lines per element that is drawn. Setting: `DrawStyle::lines`.
    #[cfg(feature = "debug-render")]
    pub(crate) const DRAWN_LINES: u32 = 4;

    /// Length in m of the line of a contact force of 1 N. Setting: `DrawStyle::force_length`.
    #[cfg(feature = "debug-render")]
    pub(crate) const FORCE_LENGTH: f64 = 5e-3;
}

/// Of [`set`](crate::set).
pub(crate) mod set {
    /// Damping ratio of the first axial mode of a rope with one end fixed.
    ///
    /// Unknown: why this much; a [`Cable`](lariat_ancf::Cable) of one's own has what its builder is
    /// given.
    pub const ROPE_DAMPING: f64 = 0.2;

    /// Planes in which a slack cable is looked for beside the bodies that it is tied to. Derived:
    /// 15 degrees apart, so that a box is missed by less than a thirtieth of its size.
    pub(crate) const PLANES: usize = 24;

    /// Shares of its length in which such a cable turns from the line between its ends. Derived:
    /// one arc as it is drawn, and the four quarters of a wave, which stay in front of both ends up
    /// to 5 times the distance of these.
    pub(crate) const LEADS: [f64; 2] = [0.0, 0.25];

    /// Share of its length by which one plane must be clearer than another. Derived: beyond
    /// rounding, so that of planes that are alike the first is taken.
    pub(crate) const SAME_CLEARANCE: f64 = 1e-6;

    /// Points per element at which its distance from bodies is measured. Unknown: as for those that
    /// are looked for in colliders.
    pub(crate) const SAMPLES: usize = 4;
}

/// Of [`water`](crate::water).
pub(crate) mod water {
    /// Sides of the prism that stands for a cylinder, cone or capsule. Derived: its radius is off
    /// by less than 0.3 % anywhere, with the true volume.
    pub(crate) const SIDES: u32 = 48;

    /// Rings of a half ball of a capsule. Derived: as many as a quarter of its circle has sides.
    pub(crate) const RINGS: u32 = 12;

    /// Most rounds in which the mean speed of a step is found. Derived: geometric means halve the
    /// logarithm of the error, so these leave nothing of it.
    pub(crate) const DRAG_ROUNDS: u32 = 60;

    /// Most rounds in which the height of a float in the middle of a step is found. Unknown: false
    /// position takes about ten.
    pub(crate) const HEIGHT_ROUNDS: u32 = 40;

    /// Change of the drag over drag and weight below which buoyancy and drag of a step agree.
    /// Derived: the rounding of forces in single precision.
    pub(crate) const SAME_DRAG: f64 = 1e-7;

    /// Most rounds in which they come to agree before bisection, half of them without relaxation.
    /// Unknown: one or two do, but where a light body falls into water.
    pub(crate) const STEP_ROUNDS: u32 = 32;

    /// Rise over the radius of a body below which the mean volume over the step is that at its
    /// middle. Derived: the error of either is then about 1e-11.
    pub(crate) const SMALLEST_RISE: f64 = 1e-5;

    /// Angle in rad of central differences of the righting moment. Derived: near the cube root of
    /// the rounding of `f64`.
    pub(crate) const SMALL_ANGLE: f64 = 1e-5;

    /// l h below which its means are series. Derived: the next term, z^4/120, is then below the
    /// rounding of `f64`.
    pub(crate) const SERIES: f64 = 3e-4;
}
