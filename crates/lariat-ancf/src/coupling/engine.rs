//! What a coupling to an engine needs of a cable.

use crate::at::At;
use crate::cable::Cable;
use crate::contact::PairTouch;
use crate::diagnostics::Diagnostics;
use crate::effect::Effects;
use crate::error::Error;
use crate::integrate::{Fidelity, Integrator};
use crate::rule::Rule;
use crate::state::SegmentTwist;
use crate::strength::{Break, Load};
use crate::warning::{IslandChange, Level, Warning};
use nalgebra::{UnitQuaternion, Vector3};

/// What a coupling to an engine needs of a cable, and the user of a rope does not: nodes that
/// bodies hold, keys of contacts, reels of a host step, readings of an island.
pub trait Coupling {
    /// Returns the key by which other cables remember their contacts with this one.
    fn contact_key(&self) -> u64;

    /// Sets the key by which other cables remember their contacts with this one, unique among
    /// cables that can touch. Default: 0, which stands for the place of the cable in its island.
    fn set_contact_key(&mut self, key: u64);

    /// Returns the largest radius in m with which it touches; 0 without
    /// [`Contact`](crate::Contact).
    fn contact_radius(&self) -> f64;

    /// Returns the energy in J that contacts store.
    fn contact_energy(&self) -> f64;

    /// Gives an end at a corner of the drawn shape, where the cable was [cut](Cable::cut), the
    /// slope of its own side, as drawn. Does nothing at another point, and where the end has moved
    /// since the cable was built.
    fn open_corner(&mut self, at: impl Into<At>);

    /// Sets the Kelvin-Voigt time in s that the axial strain has at least from the next step on: 0
    /// by default and for numbers that are not positive. For a host that can move the cable only in
    /// steps of its own: what these excite and do not resolve, a time of a tenth of a step damps.
    /// It is no effect and no part of a saved cable; what it takes is work of
    /// [`damping`](Cable::effect_work).
    fn set_least_damping(&mut self, time: f64);

    /// Returns the counters, to reset them.
    fn diagnostics_mut(&mut self) -> &mut Diagnostics;

    /// Returns whether the integrator is the builder's default, because nobody chose one. A set of
    /// cables may then give it its own.
    fn has_default_integrator(&self) -> bool;

    /// Plans the rates of the reels for the coming host step of `dt` (s), which the caller takes in
    /// several steps: they are linear over all of it, but for one in which the table of the reel
    /// has a row. A step that nothing was planned for is planned by itself. Does nothing without a
    /// reel.
    fn plan_reels(&mut self, dt: f64);

    /// Tells that the cable runs on for a length in m beyond the sheave at one of its ends: a reel
    /// at the other end counts that as out, for its stock, for the length that it is to come to,
    /// and where it is read. 0 if it does not. Does nothing at an end without a reel.
    fn set_beyond(&mut self, start: bool, length: f64);

    /// Returns the number of steps of an [`Island`](crate::island::Island), not an integer, into
    /// which `dt` (s) is to be divided so that no reel moves more than half of the element at its
    /// eye in one; 0 without a reel.
    fn steps_of_reels(&self, dt: f64) -> f64;

    /// Splits or merges the elements at the eyes of reels where their lengths ask for it; does
    /// nothing without a reel. [`step`](Cable::step) does so by itself. Between the steps of an
    /// [`Island`](crate::island::Island) the caller does, because the numbers of nodes change: at a
    /// reel at the end that of the eye, at one at the start all others
    /// ([`nodes_from_start`](Self::nodes_from_start)).
    ///
    /// # Errors
    /// [`Error::StepFailed`] if the mass matrix of the new mesh is singular.
    fn remesh_reel(&mut self) -> Result<(), Error>;

    /// Returns whether all reels stand and are not asked to turn; true without one.
    fn is_reel_still(&self) -> bool;

    /// Returns the number of elements that came through the eye of a reel at the start so far, on
    /// balance: the numbers of all nodes but that one have grown by this.
    fn nodes_from_start(&self) -> i64;

    /// Returns the length in m that came through the eye of a reel at the start so far, on balance:
    /// the arc lengths of all material have grown by this.
    fn length_from_start(&self) -> f64;

    /// Adds a step of the [island](crate::island) of which it is the first cable to its energy
    /// balance, if it is watched: for those who step islands.
    fn note_island(&mut self, step: &IslandChange);

    /// Reads the cable at the end of a host step, if it is watched, and calls `tell` with each
    /// warning that it was not called with before. For those who step [islands](crate::island), and
    /// those who want to hear of warnings as they come up. `alone` says whether nothing but its own
    /// supports, loads and effects acted on it, which its energy balance needs: neither a dynamic
    /// body nor another cable.
    fn note_host_step(&mut self, alone: bool, tell: impl FnMut(Warning));

    /// Leaves out of what is read of a watched cable, from now on, what only warnings beyond a
    /// level need: how coarse mesh and steps are is most of it. [`warnings`](Cable::warnings) of
    /// that are then of its present shape.
    fn watch_up_to(&mut self, level: Level);

    /// Tells by how much (m) positions of what holds the cable were rounded in a host step of `h`
    /// (s); for those who hold cables by bodies in single precision. If the cable is straight, the
    /// rounding u makes forces of `u EA/L (1 + T/h)` with the axial retardation time T; warnings
    /// compare them with the tension. What is not finite counts as zero.
    fn set_end_rounding(&mut self, rounding: f64, h: f64);

    /// Gives the position of a node to an island: it will follow the body that a
    /// [`PinConstraint`](crate::island::PinConstraint) names.
    ///
    /// # Errors
    /// As [`node`](Cable::node).
    fn attach(&mut self, at: impl Into<At>) -> Result<usize, Error>;

    /// Gives the position of a node and the direction of its tangent to an island, for a
    /// [`PinConstraint`](crate::island::PinConstraint) with a direction: `along`, or as
    /// [`clamp`](Cable::clamp).
    ///
    /// # Errors
    /// As [`node`](Cable::node); [`Error::NoTangent`] if the tangent has no length;
    /// [`Error::InvalidValue`] for a direction that is zero or not finite.
    fn attach_clamped(&mut self, at: impl Into<At>, along: Option<Vector3<f64>>) -> Result<usize, Error>;

    /// Returns where a node was drawn, if its part of the cable has a free end and has
    /// [turned](Cable::clamp_along) with its clamp since, and nothing else has happened.
    fn drawn_position(&self, at: impl Into<At>) -> Option<Vector3<f64>>;

    /// Lays a node back to its [drawn position](Self::drawn_position), with its part of the cable
    /// bent in equilibrium, before something is attached there.
    ///
    /// # Errors
    /// As [`node`](Cable::node).
    fn lay_as_drawn(&mut self, at: impl Into<At>) -> Result<(), Error>;

    /// Returns whether it is slack and as it was laid, so that its arcs
    /// [can be turned](Self::turn_slack).
    fn can_turn_slack(&self) -> bool;

    /// Lays the arcs of a slack cable anew, turned by an angle (rad) about the line from its first
    /// to its last point, from the side to which they sag under gravity; they turn into the angle
    /// at which arcs begin within a share `lead` of each segment at both of its ends, below 1/2.
    /// Returns whether it has done so: the cable must be as it was built, without clamps, and held
    /// at drawn points alone.
    fn turn_slack(&mut self, angle: f64, lead: f64) -> bool;

    /// Frees a node that was attached: its position, and its tangent if that was clamped to the
    /// body.
    ///
    /// # Errors
    /// As [`node`](Cable::node).
    fn detach(&mut self, at: impl Into<At>) -> Result<(), Error>;

    /// Returns the twists between the nodes that hold the spin, to be [set](Self::set_twists) when
    /// something else has taken hold of these; `None` of a cable that is as built.
    fn twists(&self) -> Option<Vec<SegmentTwist>>;

    /// Sets the twists, if the same nodes hold the spin: they are lost where none does in between.
    fn set_twists(&mut self, twists: Vec<SegmentTwist>);

    /// Sets the clock to `time` (s); prescribed motions and the ramps of loads keep their distance
    /// from it.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a time that is not finite.
    fn set_time(&mut self, time: f64) -> Result<(), Error>;

    /// Sets the velocity field of a rigid motion: `velocity` (m/s) of the start point,
    /// `angular_velocity` (rad/s) about it. Held points keep the velocity of their supports.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for numbers that are not finite.
    fn set_rigid_motion(&mut self, velocity: Vector3<f64>, angular_velocity: Vector3<f64>) -> Result<(), Error>;

    /// Moves shape, motion and what the method remembers rigidly: turned about the origin, then
    /// displaced by `by` (m). Contacts are forgotten. For those who move a cable with all that
    /// holds it: supports, loads and effects stay as they are.
    fn move_by(&mut self, turn: &UnitQuaternion<f64>, by: &Vector3<f64>);

    /// Returns whether no support and no reel moves.
    fn is_held_still(&self) -> bool;

    /// Returns whether what acts on the cable at rest stays the same for a time of `h` (s): all
    /// loads are at their full value, no flow changes, and no force per length of your own depends
    /// on time.
    fn is_loaded_steadily(&self, h: f64) -> bool;

    /// Begins to come to rest by steps of a host, who [stops](Self::stop) it at every peak of
    /// kinetic energy: it stands, its loads act as statics have them, at the end of their ramps, it
    /// has the integrator of games, and it cannot break. What is not [held
    /// still](Self::is_held_still) moves on.
    fn begin_relaxation(&mut self);

    /// Stops it where it is, but for moving supports; what it touches stays.
    fn stop(&mut self);

    /// Ends a relaxation at rest, with the clock, loads, strength, integrator and history of the
    /// cable `before` it.
    fn end_relaxation(&mut self, before: &Cable);

    /// Returns the largest load since the cable was compared with its limits last, the present one
    /// included; `None` without a limit.
    fn peak_load(&self) -> Option<Load>;

    /// Returns the time in s at which the load first exceeded its limit since the cable was
    /// compared with it: at the end of an integration step, or where it ends far above the limit,
    /// by linear interpolation within; `None` if it did not.
    fn overloaded_at(&self) -> Option<f64>;

    /// Cuts the cable at a point as [`break_at`](Cable::break_at) does where both parts go on
    /// carrying, as at a wheel: they do not recoil.
    ///
    /// # Errors
    /// As [`cut`](Cable::cut).
    fn divide_at(&mut self, at: At) -> Result<(Cable, Break), Error>;

    /// Returns whether an effect, or a reel whose rate is an unknown, asks for
    /// `discrete-gradient`, which alone solves for it.
    fn needs_discrete_gradient(&self) -> bool;

    /// Lets the stock of a reel ride with a body at its eye, if that is at this node: energy and
    /// momentum have it from now on, as from a step on such a body.
    fn ride(&mut self, node: usize);

    /// Returns the elastic energy in J that [inserted nodes](Cable::insert_node) have added so far,
    /// those of [cuts](Cable::cut) included: it belongs in an energy balance over such an edit.
    /// Zero with the exact axial rule, or 5 Gauss points and more, and no bending.
    fn inserted_energy(&self) -> f64;

    /// Returns the energy in J that the method `discrete-gradient` holds beyond the mechanical
    /// energy: S of the last step. Its law is about the sum of both.
    fn energy_in_store(&self) -> f64;

    /// Returns the largest jump between neighbouring elements of the tension that their strain
    /// says, in N: a bound of its error that converges with the first order under bending, far
    /// above that of the tension that is read by equilibrium. `None` if no node can judge.
    fn tension_jump(&self) -> Option<f64>;

    /// Returns force (N) and moment about the node (N m) of the cable on what holds `node`, at the
    /// present state and its known accelerations; unknown ones are taken as zero. Allocates
    /// nothing.
    fn pull(&mut self, node: usize) -> (Vector3<f64>, Vector3<f64>);

    /// Returns the share of a contact with another cable in the [pull](Self::pull) on what holds
    /// `node`: force (N) and moment (N m). For those contacts that the other cable keeps.
    fn share_of_contact(&self, node: usize, touch: &PairTouch) -> (Vector3<f64>, Vector3<f64>);

    /// Returns whether the cable reads itself.
    fn is_watched(&self) -> bool;

    /// Returns the integrator that `choice` means for this cable: an implicit one where internal
    /// damping needs it.
    fn integrator_for(&self, choice: impl Into<Fidelity>) -> Integrator;

    /// Replaces rule, effects and integrator together from the next step on, where one needs the
    /// other: damping needs an implicit integrator, a natural curvature a bending rule.
    ///
    /// # Errors
    /// As [`set_rule`](Cable::set_rule) (except for zero-energy modes, which a cable may be built
    /// with), [`set_effects`](Cable::set_effects) and [`set_integrator`](Cable::set_integrator).
    /// The cable is then as before.
    fn redefine(&mut self, rule: Rule, effects: Effects, integrator: Integrator) -> Result<(), Error>;

    /// Returns the speed of the fastest node in m/s.
    fn speed(&self) -> f64;

    /// Returns the largest rate in rad/s at which the twist of a segment changed in the last step.
    fn spin_rate(&self) -> f64;

    /// Advances the clock by `dt` (s) at rest: positions stay, velocities become zero. For a caller
    /// who knows that the cable is at rest, or wants it frozen.
    fn rest(&mut self, dt: f64);
}

impl Coupling for Cable {
    fn contact_key(&self) -> u64 {
        Cable::contact_key(self)
    }

    fn set_contact_key(&mut self, key: u64) {
        Cable::set_contact_key(self, key)
    }

    fn contact_radius(&self) -> f64 {
        Cable::contact_radius(self)
    }

    fn contact_energy(&self) -> f64 {
        Cable::contact_energy(self)
    }

    fn open_corner(&mut self, at: impl Into<At>) {
        Cable::open_corner(self, at)
    }

    fn set_least_damping(&mut self, time: f64) {
        Cable::set_least_damping(self, time)
    }

    fn diagnostics_mut(&mut self) -> &mut Diagnostics {
        Cable::diagnostics_mut(self)
    }

    fn has_default_integrator(&self) -> bool {
        Cable::has_default_integrator(self)
    }

    fn plan_reels(&mut self, dt: f64) {
        Cable::plan_reels(self, dt)
    }

    fn set_beyond(&mut self, start: bool, length: f64) {
        Cable::set_beyond(self, start, length)
    }

    fn steps_of_reels(&self, dt: f64) -> f64 {
        Cable::steps_of_reels(self, dt)
    }

    fn remesh_reel(&mut self) -> Result<(), Error> {
        Cable::remesh_reel(self)
    }

    fn is_reel_still(&self) -> bool {
        Cable::is_reel_still(self)
    }

    fn nodes_from_start(&self) -> i64 {
        Cable::nodes_from_start(self)
    }

    fn length_from_start(&self) -> f64 {
        Cable::length_from_start(self)
    }

    fn note_island(&mut self, step: &IslandChange) {
        Cable::note_island(self, step)
    }

    fn note_host_step(&mut self, alone: bool, tell: impl FnMut(Warning)) {
        Cable::note_host_step(self, alone, tell)
    }

    fn watch_up_to(&mut self, level: Level) {
        Cable::watch_up_to(self, level);
    }

    fn set_end_rounding(&mut self, rounding: f64, h: f64) {
        Cable::set_end_rounding(self, rounding, h)
    }

    fn attach(&mut self, at: impl Into<At>) -> Result<usize, Error> {
        Cable::attach(self, at)
    }

    fn attach_clamped(&mut self, at: impl Into<At>, along: Option<Vector3<f64>>) -> Result<usize, Error> {
        Cable::attach_clamped(self, at, along)
    }

    fn drawn_position(&self, at: impl Into<At>) -> Option<Vector3<f64>> {
        Cable::drawn_position(self, at.into())
    }

    fn lay_as_drawn(&mut self, at: impl Into<At>) -> Result<(), Error> {
        Cable::lay_as_drawn(self, at.into())
    }

    fn can_turn_slack(&self) -> bool {
        Cable::can_turn_slack(self)
    }

    fn turn_slack(&mut self, angle: f64, lead: f64) -> bool {
        Cable::turn_slack(self, angle, lead)
    }

    fn detach(&mut self, at: impl Into<At>) -> Result<(), Error> {
        Cable::detach(self, at)
    }

    fn twists(&self) -> Option<Vec<SegmentTwist>> {
        self.snapshot.state.memory.torsion.clone()
    }

    fn set_twists(&mut self, twists: Vec<SegmentTwist>) {
        if self.model.segments().map(|segment| segment.nodes).eq(twists.iter().map(|twist| twist.nodes)) {
            self.snapshot.state.memory.torsion = Some(twists);
        }
    }

    fn set_time(&mut self, time: f64) -> Result<(), Error> {
        Cable::set_time(self, time)
    }

    fn set_rigid_motion(&mut self, velocity: Vector3<f64>, angular_velocity: Vector3<f64>) -> Result<(), Error> {
        Cable::set_rigid_motion(self, velocity, angular_velocity)
    }

    fn move_by(&mut self, turn: &UnitQuaternion<f64>, by: &Vector3<f64>) {
        Cable::move_by(self, turn, by)
    }

    fn is_held_still(&self) -> bool {
        Cable::is_held_still(self)
    }

    fn is_loaded_steadily(&self, h: f64) -> bool {
        Cable::is_loaded_steadily(self, h)
    }

    fn begin_relaxation(&mut self) {
        Cable::begin_relaxation(self);
    }

    fn stop(&mut self) {
        Cable::stop(self);
    }

    fn end_relaxation(&mut self, before: &Cable) {
        Cable::end_relaxation(self, before);
    }

    fn peak_load(&self) -> Option<Load> {
        Cable::peak_load(self)
    }

    fn overloaded_at(&self) -> Option<f64> {
        self.snapshot.load.crossed()
    }

    fn divide_at(&mut self, at: At) -> Result<(Cable, Break), Error> {
        Cable::divide_at(self, at)
    }

    fn needs_discrete_gradient(&self) -> bool {
        self.effects().need_discrete_gradient() || self.model.reels.have_laws()
    }

    fn ride(&mut self, node: usize) {
        if self.has_reel() {
            self.add_riding_stock(node);
        }
    }

    fn inserted_energy(&self) -> f64 {
        Cable::inserted_energy(self)
    }

    fn energy_in_store(&self) -> f64 {
        Cable::energy_in_store(self)
    }

    fn tension_jump(&self) -> Option<f64> {
        Cable::tension_jump(self)
    }

    fn pull(&mut self, node: usize) -> (Vector3<f64>, Vector3<f64>) {
        Cable::pull(self, node)
    }

    fn share_of_contact(&self, node: usize, touch: &PairTouch) -> (Vector3<f64>, Vector3<f64>) {
        Cable::share_of_contact(self, node, touch)
    }

    fn is_watched(&self) -> bool {
        Cable::is_watched(self)
    }

    fn integrator_for(&self, choice: impl Into<Fidelity>) -> Integrator {
        Cable::integrator_for(self, choice)
    }

    fn redefine(&mut self, rule: Rule, effects: Effects, integrator: Integrator) -> Result<(), Error> {
        Cable::redefine(self, rule, effects, integrator)
    }

    fn speed(&self) -> f64 {
        Cable::speed(self)
    }

    fn spin_rate(&self) -> f64 {
        Cable::spin_rate(self)
    }

    fn rest(&mut self, dt: f64) {
        Cable::rest(self, dt)
    }
}
