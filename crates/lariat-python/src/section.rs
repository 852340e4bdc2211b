//! `Section`: stiffness and mass of a cable.

use crate::error::{Raise, raise};
use lariat_ancf as ancf;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// Axial stiffness, bending stiffness and mass per length of a cable.
///
/// Measured stiffness: EA in N (> 0), EI in N m^2 (>= 0), mass per unstretched length in kg/m (>
/// 0).
///
/// ``diameter`` (m) is for drag and drawing, ``outer_area`` (m^2) for buoyancy; a ``rope``, or what
/// has a ``breaking_load`` (N), cannot push, and is told to be overloaded above that. Raises
/// InvalidValueError.
#[pyclass(frozen, module = "lariat_cables")]
#[derive(Clone)]
pub struct Section(pub ancf::Section);

fn made(section: Result<ancf::Section, ancf::Error>) -> PyResult<Section> {
    section.map(Section).map_err(raise)
}

/// Returns the material of a name, as scenes have it.
fn named(material: &str) -> PyResult<ancf::RopeMaterial> {
    serde_json::from_value(serde_json::Value::from(material.replace("-", "_")))
        .map_err(|error| raise(Raise::new("BuilderError", format!("material: {error}"))))
}

#[pymethods]
impl Section {
    #[new]
    #[pyo3(signature = (axial_stiffness, bending_stiffness, mass_per_length, *, diameter=None, outer_area=None, rope=false,
        breaking_load=None))]
    fn new(
        axial_stiffness: f64,
        bending_stiffness: f64,
        mass_per_length: f64,
        diameter: Option<f64>,
        outer_area: Option<f64>,
        rope: bool,
        breaking_load: Option<f64>,
    ) -> PyResult<Self> {
        let numbers =
            [("diameter (m)", diameter), ("outer area (m^2)", outer_area), ("breaking load (N)", breaking_load)];
        for (what, value) in numbers {
            if let Some(value) = value.filter(|x| !(x.is_finite() && *x > 0.0)) {
                let (cable, what, expected) = (None, what.to_string(), "> 0");
                return Err(raise(ancf::Error::InvalidValue { cable, what, value, expected }));
            }
        }
        let section = made(ancf::Section::from_stiffness(axial_stiffness, bending_stiffness, mass_per_length))?.0;
        let is_rope = rope || breaking_load.is_some();
        let make = if is_rope { ancf::Make::Rope(breaking_load) } else { ancf::Make::Unknown };
        Ok(Section(ancf::Section { diameter, outer_area, make, ..section }))
    }

    /// A solid round section: m, Pa, kg/m^3. Raises InvalidValueError.
    #[staticmethod]
    fn round(diameter: f64, youngs_modulus: f64, density: f64) -> PyResult<Self> {
        made(ancf::Section::round(diameter, youngs_modulus, density))
    }

    /// A solid square section: m, Pa, kg/m^3. Raises InvalidValueError.
    #[staticmethod]
    fn square(side: f64, youngs_modulus: f64, density: f64) -> PyResult<Self> {
        made(ancf::Section::square(side, youngs_modulus, density))
    }

    /// A tube: outer and inner diameter in m, Pa, kg/m^3. Raises InvalidValueError.
    #[staticmethod]
    fn tube(outer: f64, inner: f64, youngs_modulus: f64, density: f64) -> PyResult<Self> {
        made(ancf::Section::tube(outer, inner, youngs_modulus, density))
    }

    /// A steel wire rope, 6x36WS with an independent wire rope core, of this nominal diameter in m.
    /// Raises InvalidValueError.
    #[staticmethod]
    fn wire_rope(diameter: f64) -> PyResult<Self> {
        made(ancf::Section::wire_rope(diameter))
    }

    /// A rope or chain of this nominal diameter in m, that of a chain of its bar, as catalogues
    /// have them: ``"nylon"``, ``"polyester"``, ``"hmpe"``, ``"wire_rope"`` or ``"chain"``. A cable
    /// of it has the axial law ``"rope"``, unless it is given another one: force over elongation,
    /// and no push.
    ///
    /// Raises BuilderError for another material, InvalidValueError for a diameter that is not
    /// positive and at most 0.35 m.
    #[staticmethod]
    fn rope(material: &str, diameter: f64) -> PyResult<Self> {
        made(named(material)?.section(diameter))
    }

    /// The breaking load in N of such a rope or chain, for ``set_strength``. Raises as ``rope``.
    #[staticmethod]
    fn breaking_load(material: &str, diameter: f64) -> PyResult<f64> {
        named(material)?.breaking_load(diameter).map_err(raise)
    }

    /// EA in N.
    #[getter]
    fn axial_stiffness(&self) -> f64 {
        self.0.axial_stiffness
    }

    /// EI in N m^2.
    #[getter]
    fn bending_stiffness(&self) -> f64 {
        self.0.bending_stiffness
    }

    /// Mass per unstretched length in kg/m.
    #[getter]
    fn mass_per_length(&self) -> f64 {
        self.0.mass_per_length
    }

    /// Outer diameter or side in m; None if no shape was given.
    #[getter]
    fn diameter(&self) -> Option<f64> {
        self.0.diameter
    }

    /// Area inside the outline in m^2; None if no shape was given.
    #[getter]
    fn outer_area(&self) -> Option<f64> {
        self.0.outer_area
    }

    fn __repr__(&self) -> String {
        let s = &self.0;
        let option = |x: Option<f64>| x.map_or("None".to_string(), |x| format!("{x:?}"));
        let stiffness = format!("{:?}, {:?}, {:?}", s.axial_stiffness, s.bending_stiffness, s.mass_per_length);
        format!("Section({stiffness}, diameter={}, outer_area={})", option(s.diameter), option(s.outer_area))
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.0 == other.0
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let s = &slf.get().0;
        let (axial, bending, mass) = (s.axial_stiffness, s.bending_stiffness, s.mass_per_length);
        let breaking_load = if let ancf::Make::Rope(load) = s.make { load } else { None };
        let numbers = (axial, bending, mass, s.diameter, s.outer_area, s.is_rope(), breaking_load);
        let restore = slf.py().import("lariat_cables.results")?.getattr("section")?;
        Ok((restore, numbers.into_pyobject(slf.py())?))
    }
}
