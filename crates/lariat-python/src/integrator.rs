//! `Integrator`: a method with its step control; names of methods and kinds of rope.

use crate::convert::Count;
use crate::error::{Raise, raise};
use lariat_ancf::{self as ancf, ErrorNorm, Fidelity, Method, RopeKind, StepControl};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

/// A time integration method and how its steps are chosen.
///
/// A method by name (see ``integrators()``), and exactly one of: ``tolerance``, the error of
/// position in m per host step (of the errors that ``norm`` selects); ``substeps`` per host step;
/// ``max_step`` in s; ``adaptive``, 1, 2, 4 or 8 equal steps in 1/60 s of "discrete-gradient" (1
/// and 2 keep this error in m in that time, in proportion for cables shorter than 1 m); ``stable``,
/// a share in (0, 1] of the stability limit of an explicit method. ``dissipation`` of
/// "discrete-gradient", 0 to 1/16: a motion of angular frequency w loses the share a (h w)^3/2 of
/// its amplitude per radian in steps of h; default 1/16, with a tolerance 1/256.
///
/// Raises UnknownIntegratorError, StepControlError, NoErrorEstimateError, NoErrorNormError,
/// NoStabilityLimitError, InvalidValueError.
#[pyclass(frozen, module = "lariat_cables")]
#[derive(Clone)]
pub struct Integrator(pub ancf::Integrator);

#[pymethods]
impl Integrator {
    #[new]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    #[pyo3(signature = (method="esdirk4", *, tolerance=None, norm=None, substeps=None, max_step=None, adaptive=None, stable=None, dissipation=None))]
    fn new(
        method: &str,
        tolerance: Option<f64>,
        norm: Option<&str>,
        substeps: Option<Count<u32>>,
        max_step: Option<f64>,
        adaptive: Option<f64>,
        stable: Option<f64>,
        dissipation: Option<f64>,
    ) -> PyResult<Self> {
        let method: Method = method.parse().map_err(raise::<ancf::Error>)?;
        let method = match (method, dissipation) {
            (Method::DiscreteGradient, Some(dissipation)) => Method::DiscreteGradientWith { dissipation },
            (Method::DiscreteGradient, None) if tolerance.is_some() => ancf::Integrator::COUPLED.method,
            (_, Some(_)) => {
                return Err(raise(Raise::new("StepControlError", "dissipation belongs to discrete-gradient")));
            }
            (method, None) => method,
        };
        let norm = norm.map(|name| name.parse::<ErrorNorm>().map_err(raise)).transpose()?;
        let controls = [
            tolerance.map(|x| norm.map_or(StepControl::Tolerance(x), |norm| StepControl::ToleranceOf(x, norm))),
            substeps.map(|Count(substeps)| StepControl::Substeps(substeps)),
            max_step.map(StepControl::MaxStep),
            adaptive.map(StepControl::Adaptive),
            stable.map(StepControl::Stable),
        ];
        let mut given = controls.into_iter().flatten();
        let (Some(control), None) = (given.next(), given.next()) else {
            let message = "give exactly one of tolerance, substeps, max_step, adaptive and stable";
            return Err(raise(Raise::new("StepControlError", message)));
        };
        if norm.is_some() && tolerance.is_none() {
            return Err(raise(Raise::new("StepControlError", "norm belongs to a tolerance")));
        }
        ancf::Integrator { method, control }.checked().map(Integrator).map_err(raise)
    }

    /// The name of the method.
    #[getter]
    fn method(&self) -> String {
        self.0.method.to_string()
    }

    /// Arguments that make the same integrator again, for pickle and copy.
    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<((String,), Bound<'py, PyDict>)> {
        let named = PyDict::new(py);
        match self.0.control {
            StepControl::Tolerance(x) => named.set_item("tolerance", x)?,
            StepControl::ToleranceOf(x, norm) => {
                named.set_item("tolerance", x)?;
                named.set_item("norm", norm.name())?;
            }
            StepControl::Substeps(n) => named.set_item("substeps", n)?,
            StepControl::MaxStep(h) => named.set_item("max_step", h)?,
            StepControl::Adaptive(x) => named.set_item("adaptive", x)?,
            StepControl::Stable(share) => named.set_item("stable", share)?,
        }
        // the name of the method has the dissipation in it
        Ok(((self.0.method.to_string(),), named))
    }

    fn __repr__(&self) -> String {
        let control = match self.0.control {
            StepControl::Tolerance(x) => format!("tolerance={x:?}"),
            StepControl::ToleranceOf(x, norm) => format!("tolerance={x:?}, norm={:?}", norm.name()),
            StepControl::Substeps(n) => format!("substeps={n}"),
            StepControl::MaxStep(h) => format!("max_step={h:?}"),
            StepControl::Adaptive(x) => format!("adaptive={x:?}"),
            StepControl::Stable(share) => format!("stable={share:?}"),
        };
        format!("Integrator({:?}, {control})", self.0.method.to_string())
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

/// An `Integrator`, or the name of a fidelity.
pub struct Choice(pub Fidelity);

impl<'a, 'py> FromPyObject<'a, 'py> for Choice {
    type Error = PyErr;
    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(integrator) = object.cast::<Integrator>() {
            return Ok(Choice(integrator.get().0.into()));
        }
        if object.is_instance_of::<PyString>() {
            return Ok(Choice(fidelity(&object.extract::<String>()?)?));
        }
        Err(PyTypeError::new_err("expected an Integrator, or \"game\", \"engineering\" or \"reference\""))
    }
}

/// Returns a fidelity by its name.
pub fn fidelity(name: &str) -> PyResult<Fidelity> {
    name.parse().map_err(raise::<ancf::Error>)
}

/// Returns the names of the integration methods.
#[pyfunction]
pub fn integrators() -> Vec<String> {
    Method::ALL.map(|method| method.to_string()).to_vec()
}

/// Returns the names of the kinds of rope, by which damping is named.
#[pyfunction]
pub fn rope_kinds() -> Vec<&'static str> {
    RopeKind::ALL.map(RopeKind::name).to_vec()
}

/// Returns the number of elements that a fidelity recommends. Raises UnknownFidelityError.
#[pyfunction]
#[pyo3(signature = (fidelity="engineering"))]
pub fn recommended_elements(fidelity: &str) -> PyResult<usize> {
    self::fidelity(fidelity).map(Fidelity::elements)
}
