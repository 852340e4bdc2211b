//! Changing a cable between steps.

use super::{Cable, effects};
use crate::convert::{Array, Place, Vector, node};
use crate::error::{Raise, raise};
use crate::integrator::Choice;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{Error, PointLoad, Vector3};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::borrow::Cow;

const SNAPSHOT: &str = concat!("lariat snapshot ", env!("CARGO_PKG_VERSION"), "\n");

#[pymethods]
impl Cable {
    /// Holds the position of a node where it is. Raises OutOfRangeError, NoNodeError.
    fn fix(&self, py: Python<'_>, at: Place) -> PyResult<()> {
        self.change(py, |cable| cable.fix(at.0))
    }

    /// Holds the position of a node as it is and its tangent along ``direction``, by default as it
    /// is; at an end of a slack cable as it was laid, as drawn. Raises as ``fix``, NoTangentError,
    /// and InvalidValueError for a direction of size zero.
    #[pyo3(signature = (at, direction=None))]
    fn clamp(&self, py: Python<'_>, at: Place, direction: Option<Vector>) -> PyResult<()> {
        self.change(py, |cable| match direction {
            None => cable.clamp(at.0),
            Some(Vector(direction)) => cable.clamp_along(at.0, direction),
        })
    }

    /// Frees a node. Raises as ``fix``.
    fn release(&self, py: Python<'_>, at: Place) -> PyResult<()> {
        self.change(py, |cable| cable.release(at.0))
    }

    /// Prescribes the position of a node: the cubic from where it is, at its present velocity, to
    /// ``position`` (m) at ``velocity`` (m/s; default 0) a time ``duration`` (s) later; then it is
    /// held there. ``restore`` restores it. Raises OutOfRangeError, NoNodeError, ShapeError,
    /// InvalidValueError.
    #[pyo3(signature = (at, position, duration, velocity=None))]
    fn prescribe(
        &self,
        py: Python<'_>,
        at: Place,
        position: Vector,
        duration: f64,
        velocity: Option<Vector>,
    ) -> PyResult<()> {
        let velocity = velocity.map_or(Vector3::zeros(), |v| v.0);
        self.change(py, |cable| cable.prescribe(at.0, position.0, velocity, duration))
    }

    /// Adds a force (N) and moment (N m) in world axes at a point, ramped over ``ramp`` s, times
    /// the factor of ``history``: rows of seconds from now and factor, linear between them,
    /// constant outside. Raises OutOfRangeError, InvalidValueError.
    #[pyo3(signature = (at, force=None, *, moment=None, ramp=0.0, history=None))]
    fn add_load(
        &self,
        py: Python<'_>,
        at: Place,
        force: Option<Vector>,
        moment: Option<Vector>,
        ramp: f64,
        history: Option<Vec<[f64; 2]>>,
    ) -> PyResult<()> {
        if force.is_none() && moment.is_none() {
            return Err(PyTypeError::new_err("add_load needs a force, a moment, or both"));
        }
        let [force, moment] = [force, moment].map(|v| v.map_or(Vector3::zeros(), |v| v.0));
        let history = history.unwrap_or_default();
        self.change(py, |cable| {
            let s = cable.arc_length(at.0)?;
            cable.add_load(PointLoad { moment, ramp, history, ..PointLoad::force(s, force) })
        })
    }

    /// Removes all point loads.
    fn clear_loads(&self, py: Python<'_>) -> PyResult<()> {
        self.change(py, |cable| {
            cable.clear_loads();
            Ok(())
        })
    }

    #[setter]
    fn set_effects(&self, py: Python<'_>, value: &Bound<'_, PyAny>) -> PyResult<()> {
        let effects = effects(value)?;
        self.change(py, |cable| cable.set_effects(effects))
    }

    #[setter]
    fn set_gravity(&self, py: Python<'_>, value: Vector) -> PyResult<()> {
        self.change(py, |cable| cable.set_gravity(value.0))
    }

    #[setter]
    fn set_time(&self, py: Python<'_>, value: f64) -> PyResult<()> {
        self.own("change its clock")?;
        self.change(py, |cable| cable.set_time(value))
    }

    #[setter]
    fn set_integrator(&self, py: Python<'_>, value: Choice) -> PyResult<()> {
        self.change(py, |cable| cable.set_integrator(cable.integrator_for(value.0)))
    }

    #[setter]
    fn set_rule(&self, py: Python<'_>, value: &str) -> PyResult<()> {
        let rule = value.parse().map_err(raise::<Error>)?;
        self.change(py, |cable| cable.set_rule(rule))
    }

    /// Sets nodal coordinates and their rates, both of shape (nodes, 6). If coordinates change,
    /// contacts are forgotten: friction begins anew, and the depth at which the cable is set gives
    /// no force. ``restore`` keeps them. Raises ShapeError, InvalidValueError.
    fn set_state(&self, py: Python<'_>, coordinates: Array, rates: Array) -> PyResult<()> {
        let nodes = self.read(py, |cable| Ok(cable.nodes()))?;
        for given in [&coordinates, &rates] {
            if given.shape != [nodes, 6] {
                return Err(given.wrong_shape(&format!("({nodes}, 6)")));
            }
        }
        self.change(py, |cable| cable.set_coordinates(&coordinates.values, &rates.values))
    }

    /// Sets the velocities of a rigid motion: ``velocity`` (m/s) of the start, ``angular_velocity``
    /// (rad/s) about it. Raises ShapeError, InvalidValueError.
    #[pyo3(signature = (velocity, angular_velocity=None))]
    fn set_rigid_motion(&self, py: Python<'_>, velocity: Vector, angular_velocity: Option<Vector>) -> PyResult<()> {
        let spin = angular_velocity.map_or(Vector3::zeros(), |v| v.0);
        self.change(py, |cable| cable.set_rigid_motion(velocity.0, spin))
    }

    /// Returns the node at a point, and places one if there is none. Raises OutOfRangeError,
    /// InWorldError.
    fn insert_node<'py>(&self, py: Python<'py>, at: Place) -> PyResult<Bound<'py, PyAny>> {
        self.own("be divided")?;
        node(py, self.change(py, |cable| cable.insert_node(at.0))?)
    }

    /// Samples a flow at the nodes, in m/s, shape (nodes, 3): valid until the next call, on top of
    /// that of the drag. Raises MissingForEffectError, WrongCountError.
    fn sample_flow(&self, py: Python<'_>, velocities: Array) -> PyResult<()> {
        let rows = velocities.vectors()?;
        self.change(py, |cable| {
            if rows.len() != cable.nodes() {
                let (cable, expected) = (cable.name().to_string(), cable.nodes());
                return Err(Error::WrongCount { cable, what: "samples of the flow", count: rows.len(), expected });
            }
            let mut rows = rows.iter();
            cable.sample_flow(|_| rows.next().copied().unwrap_or_default())
        })
    }

    /// Returns the state alone, for ``restore``.
    fn snapshot<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = self.read(py, |cable| Ok(rmp_serde::to_vec_named(cable.snapshot())))?;
        let bytes = bytes.map_err(|error| raise(Raise::new("FormatError", error.to_string())))?;
        Ok(PyBytes::new(py, &[SNAPSHOT.as_bytes(), &bytes].concat()))
    }

    /// Restores a state of this cable; the run continues bitwise from there. Raises FormatError,
    /// WrongCountError.
    fn restore(&self, py: Python<'_>, snapshot: Cow<'_, [u8]>) -> PyResult<()> {
        let wrong = |problem: String| raise(Raise::new("FormatError", format!("not a snapshot of a cable: {problem}")));
        let Some(body) = snapshot.strip_prefix(SNAPSHOT.as_bytes()) else {
            return Err(wrong(format!("it does not begin with {SNAPSHOT:?}")));
        };
        let snapshot = rmp_serde::from_slice(body).map_err(|error| wrong(error.to_string()))?;
        self.change(py, |cable| cable.restore(snapshot))
    }

    /// Replaces rule, effects and integrator together, where one needs the other. Raises
    /// UnknownRuleError, RankDeficientError, EffectsError, MissingForEffectError,
    /// ExplicitDampingError; the cable is then as it was.
    #[pyo3(signature = (*, rule=None, effects=None, integrator=None))]
    fn redefine(
        &self,
        py: Python<'_>,
        rule: Option<&str>,
        effects: Option<&Bound<'_, PyAny>>,
        integrator: Option<Choice>,
    ) -> PyResult<()> {
        let rule = rule.map(|rule| rule.parse().map_err(raise::<Error>)).transpose()?;
        let effects = effects.map(self::effects).transpose()?;
        self.change(py, |cable| {
            let effects = effects.unwrap_or_else(|| cable.effects().clone());
            let chosen = integrator.map_or(cable.integrator(), |choice| cable.integrator_for(choice.0));
            cable.redefine(rule.unwrap_or_else(|| cable.rule()), effects, chosen)
        })
    }
}
