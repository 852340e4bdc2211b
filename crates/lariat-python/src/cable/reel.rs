//! Reels at the ends of a cable, its strength, and what breaks.

use super::Cable;
use crate::convert::{Place, data, object, result};
use crate::error::{Raise, raise};
use lariat_ancf::{Break, Reel, ReelReading, Strength};
use pyo3::prelude::*;

/// Returns a reel from what `lariat.Reel` holds.
fn description(reel: &Bound<'_, PyAny>) -> PyResult<Reel> {
    let plain = reel.py().import("lariat_cables.reel")?.getattr("plain")?.call1((reel,))?;
    serde_json::from_value(data(&plain)?).map_err(|error| raise(Raise::new("BuilderError", error.to_string())))
}

/// Makes the Python object of a break.
pub fn broken<'py>(py: Python<'py>, how: &Break) -> PyResult<Bound<'py, PyAny>> {
    let Break { cause, arc_length, tension, damping, strain, time, strain_energy, inserted_energy, breaks, .. } = *how;
    let name = cause.name();
    result(py, "Break", (name, arc_length, tension, strain, time, strain_energy, inserted_energy, damping, breaks))
}

#[pymethods]
impl Cable {
    /// Puts a reel at an end: from the next step on it pays cable out and takes it in through that
    /// node, which a support or an attachment must hold. Raises ReelPlaceError, ExplicitReelError,
    /// ReelMethodError, NotWithReelError, InvalidValueError, BuilderError.
    fn add_reel(&self, py: Python<'_>, at: Place, reel: &Bound<'_, PyAny>) -> PyResult<()> {
        let reel = description(reel)?;
        self.change(py, |cable| cable.add_reel(at.0, reel))
    }

    /// Changes what the reel at an end does from now on. Raises ReelPlaceError, ReelMethodError,
    /// InvalidValueError, BuilderError.
    fn set_reel(&self, py: Python<'_>, at: Place, reel: &Bound<'_, PyAny>) -> PyResult<()> {
        let reel = description(reel)?;
        self.change(py, |cable| cable.set_reel(at.0, reel))
    }

    /// Changes the rate of the reel at an end in m/s: positive pays out. Raises as ``set_reel``.
    fn set_reel_rate(&self, py: Python<'_>, at: Place, rate: f64) -> PyResult<()> {
        self.change(py, |cable| cable.set_reel_rate(at.0, rate))
    }

    /// Lets the reel at an end come to a length of cable (m) that is out, with at most a rate
    /// (m/s), and stop there. Raises as ``set_reel``.
    fn set_reel_length(&self, py: Python<'_>, at: Place, length: f64, rate: f64) -> PyResult<()> {
        self.change(py, |cable| cable.set_reel_length(at.0, length, rate))
    }

    /// Takes the reel at an end away; what is out stays. Does nothing without a reel. Raises
    /// UnknownPlaceError.
    fn remove_reel(&self, py: Python<'_>, at: Place) -> PyResult<()> {
        self.change(py, |cable| cable.remove_reel(at.0))
    }

    /// Returns what the reel at an end does now; None without one. Raises UnknownPlaceError.
    fn reel<'py>(&self, py: Python<'py>, at: Place) -> PyResult<Option<Bound<'py, PyAny>>> {
        let Some(reading) = self.read(py, |cable| Ok(cable.reel(at.0)))? else { return Ok(None) };
        let ReelReading {
            length_out, rate, force, tension, work, remeshed, splits, merges, stopped, speed_ratio, ..
        } = reading;
        let values = (length_out, rate, force, tension, work, remeshed, splits, merges, stopped, speed_ratio);
        result(py, "ReelReading", values).map(Some)
    }

    /// Returns the reel at an end as it was described; None without one. Raises UnknownPlaceError.
    fn reel_description<'py>(&self, py: Python<'py>, at: Place) -> PyResult<Option<Bound<'py, PyAny>>> {
        let Some(reel) = self.read(py, |cable| Ok(cable.reel_description(at.0).cloned()))? else { return Ok(None) };
        let value = serde_json::to_value(&reel).unwrap_or_default();
        py.import("lariat_cables.reel")?.getattr("build")?.call1((object(py, &value)?,)).map(Some)
    }

    /// Sets the tension in N and the strain above which ``break_overloaded`` breaks the cable;
    /// None: no limit. Raises InvalidValueError, OneElementError, InWorldError.
    #[pyo3(signature = (tension=None, *, strain=None))]
    fn set_strength(&self, py: Python<'_>, tension: Option<f64>, strain: Option<f64>) -> PyResult<()> {
        self.own("set its strength by itself: see World.set_strength")?;
        self.change(py, |cable| cable.set_strength(Strength { tension, strain }))
    }

    /// Breaks the cable at the inner node that exceeds its strength most; this one keeps the part
    /// before it. Returns the part behind it and why it broke, or None if it holds. Raises
    /// InWorldError.
    fn break_overloaded<'py>(&self, py: Python<'py>) -> PyResult<Option<(Cable, Bound<'py, PyAny>)>> {
        self.own("break by itself: the world breaks it")?;
        let Some((rest, how)) = self.change(py, |cable| cable.break_overloaded())? else { return Ok(None) };
        Ok(Some((Cable::laid(rest, self.obstacles(py)), broken(py, &how)?)))
    }
}
