//! Sheaves and drums of a world.

use super::bodies::{Handle, invalid, not_negative, positive, single};
use super::scene::Which;
use super::{Contents, World};
use crate::cable::Cable;
use crate::convert::{Place, Vector, result};
use crate::error::{Raise, raise};
use lariat_ancf::Reel;
use lariat_rapier::{Drum, SheaveOptions};
use pyo3::prelude::*;

/// Checks the numbers of a sheave.
fn options(inertia: f64, friction: f64, turns: f64, brake: f64) -> PyResult<SheaveOptions> {
    not_negative("inertia (kg)", inertia)?;
    not_negative("friction", friction)?;
    not_negative("turns (rad)", turns)?;
    not_negative("brake (N)", brake)?;
    Ok(SheaveOptions { inertia, friction, turns, brake, ..SheaveOptions::default() })
}

#[pymethods]
impl World {
    /// Lets the first cable run into the second over a wheel, where an end of each is attached to
    /// one point of a body. ``inertia``: that of the wheel over the square of its radius, in kg;
    /// ``friction``: tensions differ by up to exp(friction angle); ``turns``: angle in rad wound
    /// beyond that between the two; ``brake``: constant friction in N. Both need the integrator
    /// "discrete-gradient" and one section. Returns the number of the sheave. Raises
    /// ReelPlaceError, ReelMethodError, NotWithReelError, InvalidValueError, NoCableError; what
    /// makes no sheave beyond that is an error of the next step.
    #[pyo3(signature = (first, at, second, second_at, *, inertia=0.0, friction=0.0, turns=0.0, brake=0.0))]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn add_sheave(
        &self,
        py: Python<'_>,
        first: &Cable,
        at: Place,
        second: &Cable,
        second_at: Place,
        inertia: f64,
        friction: f64,
        turns: f64,
        brake: f64,
    ) -> PyResult<usize> {
        let ends = ((first.handle_in(&self.0)?, at.0), (second.handle_in(&self.0)?, second_at.0));
        let options = options(inertia, friction, turns, brake)?;
        let added = self.0.compute(py, |contents| {
            contents.set.add_sheave(ends.0, ends.1, options).map(|sheave| {
                contents.sheaves.push(sheave);
                contents.sheaves.len() - 1
            })
        });
        added.map_err(raise)
    }

    /// Lets a cable run over an eye at ``anchor`` of a body (m, body axes), within 1 mm of a point
    /// between its ends; an arc length counts along all :meth:`parts`. Other arguments as in
    /// :meth:`add_sheave`. Returns the number of the sheave, and the part of the cable behind it.
    /// Raises GapTooLongError, AlreadyAttachedError, NoBodyError, ReelPlaceError, ReelMethodError,
    /// NotWithReelError, OutOfRangeError, InvalidValueError, NoCableError; nothing changes then.
    #[pyo3(signature = (cable, at, body, anchor, *, inertia=0.0, friction=0.0, turns=0.0, brake=0.0))]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn add_sheave_at(
        &self,
        py: Python<'_>,
        cable: &Cable,
        at: Place,
        body: Handle,
        anchor: Vector,
        inertia: f64,
        friction: f64,
        turns: f64,
        brake: f64,
    ) -> PyResult<(usize, Cable)> {
        let (handle, anchor) = (cable.handle_in(&self.0)?, single("anchor (m)", anchor.0)?);
        let options = options(inertia, friction, turns, brake)?;
        let added = self.0.compute(py, |contents| {
            let Contents { world, set, sheaves, .. } = contents;
            let sheave = set.add_sheave_at(world, (handle, at.0), (body.0, anchor), options)?;
            sheaves.push(sheave);
            Ok::<_, lariat_rapier::Error>((sheaves.len() - 1, set.sheave(sheave)?.ends()[1].0))
        });
        let (number, rest) = added.map_err(raise)?;
        Ok((number, Cable::of_world(self.0.clone(), rest)))
    }

    /// Returns the parts of a cable that runs over sheaves along it, from start to end. Raises
    /// NoCableError.
    fn parts(&self, py: Python<'_>, cable: &Cable) -> PyResult<Vec<Cable>> {
        let handle = cable.handle_in(&self.0)?;
        let parts = self.0.with(py, |contents| contents.set.parts(handle)).map_err(raise)?;
        Ok(parts.into_iter().map(|part| Cable::of_world(self.0.clone(), part)).collect())
    }

    /// Ends a sheave: what is on its sides stays there. Raises NoSheaveError.
    fn remove_sheave(&self, py: Python<'_>, sheave: Which) -> PyResult<()> {
        let removed = self.0.compute(py, |contents| {
            let handle = contents.sheave(&sheave)?;
            contents.set.remove_sheave(handle).map_err(Raise::from)
        });
        removed.map_err(raise)
    }

    /// Returns what a sheave did so far, by its number or its name in the scene. Raises
    /// NoSheaveError.
    fn sheave<'py>(&self, py: Python<'py>, sheave: Which) -> PyResult<Bound<'py, PyAny>> {
        let reading = self.0.with(py, |contents| {
            let handle = contents.sheave(&sheave)?;
            let sheave = contents.set.sheave(handle).map_err(Raise::from)?;
            Ok::<_, Raise>((sheave.passed(), sheave.force(), sheave.lost()))
        });
        result(py, "SheaveReading", reading.map_err(raise)?)
    }

    /// Winds an end of a cable on a dynamic body that turns about ``axis`` (in its frame; positive
    /// spin pays out): the cable runs at ``radius`` (m), and its pull turns the body. ``stock``:
    /// largest length in m that can be out; ``inertia``: what the drum carries beside the body's
    /// own, over the square of the radius, in kg. Needs the integrator "discrete-gradient". Raises
    /// DrumBodyError, NoBodyError, ReelPlaceError, ReelMethodError, NotWithReelError,
    /// InvalidValueError, NoCableError; a step raises DrumJoinedError.
    #[pyo3(signature = (cable, at, body, axis, radius, *, stock=None, inertia=0.0))]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn add_drum(
        &self,
        py: Python<'_>,
        cable: &Cable,
        at: Place,
        body: Handle,
        axis: Vector,
        radius: f64,
        stock: Option<f64>,
        inertia: f64,
    ) -> PyResult<()> {
        let unit = axis.0.try_normalize(1e-9).ok_or_else(|| invalid("length of the axis", axis.0.norm(), "> 0"))?;
        let drum = Drum { body: body.0, axis: single("axis", unit)?, radius: positive("radius (m)", radius)? };
        not_negative("inertia (kg)", inertia)?;
        let reel = Reel { stock, inertia, ..Reel::on_drum() };
        let handle = cable.handle_in(&self.0)?;
        let added =
            self.0.compute(py, |contents| contents.set.add_drum(&contents.world.bodies, (handle, at.0), drum, reel));
        added.map_err(raise)
    }

    /// Ends the drum at an end of a cable: what is out stays. Returns whether there was one. Raises
    /// NoCableError.
    fn remove_drum(&self, py: Python<'_>, cable: &Cable, at: Place) -> PyResult<bool> {
        let handle = cable.handle_in(&self.0)?;
        let removed = self.0.compute(py, |contents| contents.set.remove_drum(handle, at.0));
        removed.map(|drum| drum.is_some()).map_err(raise)
    }
}
