//! Torsion: one torque between two cross-sections that are held against spin.
//!
//! # Equation
//!
//! ```text
//! U = K Phi^2/2        K = 1/sum(l_e/GJ)        M = K (Phi + tau d Phi/dt)
//! ```
//!
//! Where the section is isotropic nothing acts on the spin of an inner cross-section, so the torque
//! M is the same all along a *segment*, the cable between two *holds*: clamps that also hold the
//! spin. Phi is the twist of its material, a function of the coordinates that are there already and
//! of the attitudes of both holds, modulo a full turn (`pair`, `element`). It is advanced by
//! exact increments; the state is one number per segment. The force on the coordinates is -M
//! dPhi/dq, the torque on the first hold +M t and on the last -M t.
//!
//! *Where material runs through an end* that holds the spin (a reel, a sheave, a drum), what comes
//! out is not twisted and what goes in is turned back: the eye holds the spin of whichever section
//! is at it, so Phi is that of the cable that is out, and stays while M = GJ Phi/L falls with its
//! length L. Such an eye takes the force dU/dL = -M^2/(2 GJ), beside M dPhi/dl of the curve.
//!
//! | file | what it holds |
//! |---|---|
//! | `direction` | directions of slopes, regularised |
//! | `pair` | twist between two directions |
//! | `element` | twist of an element: gradient, Hessian, exact change |
//! | `path` | twist that a change adds which no step makes |
//! | `lengths` | lengths of elements over a step |
//! | `check` | whether a twist was followed in statics |
//! | `curve` | what a change of the mesh does to the twist |
//! | `stranded` | torque by tension of a stranded rope |
//! | `segment` | segments of a cable, their torques, and what the state holds of them |
//! | `spin` | spin of a body about the direction of a clamp |
//! | `frequency` | a bound of the frequencies |
//! | `rank` | the solution with K g g^T added to the matrix |
//!
//! # Validity
//!
//! Isotropic sections whose rotary inertia about the axis is small: no torsional waves (they cross
//! L in L sqrt(rho J/GJ)), and a torsional pendulum of inertia I is too fast by rho J L/(6 I). No
//! torque that is distributed along the cable, as of friction that rolls it; no natural curvature
//! with a direction. A segment with one hold has no torque. Twist needs a mesh that resolves its
//! kinks, of wave length 4 pi EI/M: |M| l/EI = 0.6 errs by 0.014 % in the critical torque, 1.5 by
//! 0.2 %, 3 by 3 %.
//!
//! # References
//!
//! Kirchhoff 1859; Langer & Singer, SIAM Review 38 (1996) 605 (the isotropic rod: one torque);
//! Fuller, PNAS 75 (1978) 3557 (twist and writhe of two curves); Greenhill 1883; Michell 1889.
//!
//! # Alternatives considered
//!
//! A spin per node as seventh coordinate: the same statics to rounding, with wider blocks, frames
//! that are carried in time, and a gyroscopic term for angular momentum. Directors or quaternions
//! per node: constraints, or a mass matrix that is not constant. Twist of the nodal tangents
//! (discrete elastic rods): order 2.

pub(crate) mod check;
pub(crate) mod curve;
mod direction;
mod element;
mod frequency;
pub(crate) mod lengths;
mod pair;
mod path;
pub(crate) mod rank;
pub(crate) mod segment;
pub(crate) mod spin;
pub(crate) mod stranded;
#[cfg(test)]
mod tests;

use super::acts::{Acts, Nothing};
use super::{Cut, Effect, Target};
use crate::error::{Error, Requirement, require};
use crate::rows::{check_rows, is_constant};
use crate::smooth;
use core::f64::consts::TAU;
use serde::{Deserialize, Serialize};

/// How a clamp of a cable with [torsion](Torsion) holds its spin about the axis. At an end that is
/// not clamped nothing holds it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum EndSpin {
    /// It turns with what it is clamped to.
    #[default]
    Held,
    /// Not at all: a swivel.
    Swivel,
    /// A motor turns it, beside what it is clamped to.
    Motor {
        /// Turns per second, right-handed about the axis in the direction of arc length.
        rate: f64,
        /// Time in s at which it starts.
        from: f64,
        /// Time in s at which it stops, and holds.
        until: f64,
    },
    /// A motor turns it, beside what it is clamped to, by a course: rows of time in s, ascending,
    /// and turns, right-handed about the axis in the direction of arc length. Between them the
    /// turns and their rate are [continuous](crate::smooth); before the first row and behind the
    /// last it holds. What counts is by how much it turns from when the cable is built.
    Course(Vec<[f64; 2]>),
}

impl EndSpin {
    /// Returns the angle in rad of the motor at a time in s.
    pub(crate) fn angle(&self, time: f64) -> f64 {
        match self {
            &EndSpin::Motor { rate, from, until } => TAU * rate * (time.clamp(from, until) - from),
            EndSpin::Course(rows) => TAU * smooth::value(rows, time),
            EndSpin::Held | EndSpin::Swivel => 0.0,
        }
    }

    /// Returns the rate in rad/s of the motor at a time in s.
    pub(crate) fn rate(&self, time: f64) -> f64 {
        match self {
            &EndSpin::Motor { rate, from, until } if (from..until).contains(&time) => TAU * rate,
            EndSpin::Course(rows) => TAU * smooth::rate_at(rows, time),
            EndSpin::Motor { .. } | EndSpin::Held | EndSpin::Swivel => 0.0,
        }
    }

    fn is_still(&self, time: f64) -> bool {
        self.is_steady(time, f64::INFINITY)
    }

    /// Whether it does not turn from one time to another.
    fn is_steady(&self, time: f64, to: f64) -> bool {
        match self {
            &EndSpin::Motor { rate, from, until } => rate == 0.0 || time >= until || to <= from,
            EndSpin::Course(rows) => is_constant(rows, time, to),
            EndSpin::Held | EndSpin::Swivel => true,
        }
    }

    fn delay(&mut self, by: f64) {
        match self {
            EndSpin::Motor { from, until, .. } => (*from, *until) = (*from + by, *until + by),
            EndSpin::Course(rows) => rows.iter_mut().for_each(|row| row[0] += by),
            EndSpin::Held | EndSpin::Swivel => {}
        }
    }

    fn check(&self) -> Result<(), Error> {
        match self {
            &EndSpin::Motor { rate, from, until } => {
                require("rate of a motor (turns/s)", rate, true, "a number")?;
                require("start of a motor (s)", from, true, "a number")?;
                require("end of a motor (s)", until, until >= from, "at or after its start")
            }
            EndSpin::Course(rows) => {
                require("rows of the course of a motor", rows.len() as f64, !rows.is_empty(), ">= 1")?;
                check_rows("the course of a motor (s, turns)", rows)
            }
            EndSpin::Held | EndSpin::Swivel => Ok(()),
        }
    }
}

/// Torsion of an isotropic cable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Torsion {
    /// Torsional stiffness GJ in N m^2, > 0.
    pub stiffness: f64,
    /// Turns by which the cable is twisted as built between its first and its last hold; default 0.
    #[serde(default)]
    pub initial_twist: f64,
    /// Time in s by which it damps, >= 0; default 0: M = K (Phi + time d Phi/dt). A damping ratio z
    /// at omega rad/s is 2 z/omega. A hook that swings on a [stranded](Self::stranded) rope gets
    /// about GJ/(GJ + EA k^2) of it, k the torque per tension, since its rope stretches as it
    /// turns; all of it with axial damping of the same time.
    #[serde(default)]
    pub damping: f64,
    /// Torque per tension in m while twist is held: `c d` of a stranded rope with the torque factor
    /// c and the diameter d, positive for a right-hand lay, which tension unlays; default 0, as a
    /// section that is isotropic has it. EA is then the axial stiffness while twist is held, and
    /// [`stiffness`](Self::stiffness) the torsional one while tension is: M = c d T + GJ times the
    /// twist rate. Not on reels, nor with an axial law.
    #[serde(default)]
    pub torque_per_tension: f64,
    /// Spin of the first node, if it is clamped.
    #[serde(default)]
    pub start: EndSpin,
    /// Spin of the last node, if it is clamped.
    #[serde(default)]
    pub end: EndSpin,
    /// Spin of all nodes between that are clamped. A clamp that does not hold it lets the torque
    /// through.
    #[serde(default)]
    pub inner: EndSpin,
}

impl Torsion {
    /// Torsion of stiffness GJ in N m^2: untwisted as built, clamps hold the spin.
    pub fn new(stiffness: f64) -> Self {
        let (initial_twist, damping, torque_per_tension) = (0.0, 0.0, 0.0);
        let (start, end, inner) = Default::default();
        Torsion { stiffness, initial_twist, damping, torque_per_tension, start, end, inner }
    }

    /// That of a stranded rope of stiffness GJ in N m^2 by its torque factor c and its diameter in
    /// m: at held twist the tension T makes the torque c d T. c is in the data of its maker:
    /// about 0.1 for common six-strand ropes, near 0 for ropes that resist rotation.
    ///
    /// ```
    /// use lariat_ancf::Torsion;
    ///
    /// // 10 kN on a held rope of 12 mm
    /// let rope = Torsion::stranded(2.0, 0.1, 0.012);
    /// assert!((rope.torque_per_tension * 10e3 - 12.0).abs() < 1e-9); // N m
    /// ```
    pub fn stranded(stiffness: f64, torque_factor: f64, diameter: f64) -> Self {
        Torsion { torque_per_tension: torque_factor * diameter, ..Self::new(stiffness) }
    }

    /// That of a solid round section or a round tube of bending stiffness EI in N m^2 and a Poisson
    /// number: GJ = EI/(1 + nu).
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a Poisson number that is not between -1 and 0.5.
    pub fn round(bending_stiffness: f64, poisson: f64) -> Result<Self, Error> {
        require("Poisson number", poisson, poisson > -1.0 && poisson <= 0.5, "-1 to 0.5")?;
        Ok(Self::new(bending_stiffness / (1.0 + poisson)))
    }
}

impl Torsion {
    /// Returns all settings of the spin.
    fn spins(&self) -> [&EndSpin; 3] {
        [&self.start, &self.end, &self.inner]
    }

    /// Returns whether no motor turns from a time in s on.
    pub(crate) fn is_still(&self, time: f64) -> bool {
        self.spins().iter().all(|spin| spin.is_still(time))
    }

    /// Lets motors turn later by a time in s.
    pub(crate) fn delay(&mut self, by: f64) {
        [&mut self.start, &mut self.end, &mut self.inner].into_iter().for_each(|spin| spin.delay(by));
    }
}

impl Effect for Torsion {
    const DISSIPATIVE: bool = true;

    fn check(&self, cable: &Target<'_>) -> Result<(), Error> {
        require("torsional stiffness GJ (N m^2)", self.stiffness, self.stiffness > 0.0, "> 0")?;
        require("initial twist (turns)", self.initial_twist, true, "a number")?;
        require("torque per tension (m)", self.torque_per_tension, true, "a number")?;
        require("damping time of torsion (s)", self.damping, self.damping >= 0.0, ">= 0")?;
        if cable.has_no_bending() {
            return Err(cable.missing("torsion", Requirement::BendingRule));
        }
        self.spins().iter().try_for_each(|spin| spin.check())
    }

    fn depends_on_velocity(&self) -> bool {
        self.damping > 0.0
    }

    fn has_exact_tangent(&self) -> bool {
        self.damping == 0.0
    }

    fn needs_implicit_integrator(&self) -> bool {
        self.damping > 0.0
    }

    fn is_steady(&self, from: f64, to: f64) -> bool {
        self.spins().iter().all(|spin| spin.is_steady(from, to))
    }

    fn cut(&self, _: Cut<'_>) -> [Option<Self>; 2] {
        let (head, tail) =
            (Torsion { end: EndSpin::Held, ..self.clone() }, Torsion { start: EndSpin::Held, ..self.clone() });
        [Some(head), Some(tail)]
    }

    fn refine(&mut self, _: usize, _: f64) {}
}

impl Acts for Torsion {
    type InElement = Nothing;
    type AtPoints = Nothing;
}
