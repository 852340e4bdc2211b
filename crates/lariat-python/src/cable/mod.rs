//! `Cable`: built, stepped, saved; `read`, `change`, `contact` and `reel` hold the rest of its methods.

mod batch;
mod change;
pub mod contact;
mod read;
mod reel;

use crate::convert::{Array, Count, Numbers, Place, Places, Vector, data};
use crate::error::{Raise, raise};
use crate::integrator::{Choice, fidelity};
use crate::saved;
use crate::section::Section;
use crate::shared::Shared;
use crate::told::{Told, warn};
use crate::world::Contents;
pub use batch::{states, step_all, step_together};
pub use contact::Laid;
use lariat_ancf as ancf;
use lariat_ancf::{EquilibriumOptions, Error};
use lariat_rapier::CableHandle;
use pyo3::exceptions::PyTypeError;
use pyo3::marker::Ungil;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::borrow::Cow;

/// Gives to Python's `warnings` what is to be told of cables after their steps: each kind once.
fn tell<'a>(py: Python<'_>, cables: impl IntoIterator<Item = &'a Cable>) -> PyResult<()> {
    let (mut all, mut lines) = (Told::default(), Vec::new());
    for own in cables {
        let told = &own.told;
        lines.extend(own.read(py, |cable| Ok(told.lock().of_cable(cable, &mut all)))?);
    }
    warn(py, lines)
}

/// Where the cable is.
#[derive(Clone)]
enum Home {
    Own(Shared<ancf::Cable>),
    World(Shared<Contents>, CableHandle),
}

/// A cable of ANCF elements with its rule, integrator and state.
///
/// A point of a cable is "start", "end", an arc length of the unstretched cable in m from its start
/// (float), or a ``lariat.Node``; another integer than 0 could be either, and raises
/// AmbiguousPlaceError. Arrays are copies. Any number of threads may use a cable: they wait for
/// each other, and other threads run Python while it is stepped.
///
/// A cable through ``points`` (m, shape (n, 3), n >= 2) of one section, or of several: (arc length
/// in m where it begins, section).
/// - ``length``: unstretched, in m; by default that of the polyline. Longer: it starts slack, in
///   arcs that sag along gravity.
/// - ``pretension``, ``sag``: instead of ``length``, that with which it has this tension in N at
///   its middle, or hangs by this distance in m below the line between its ends, when it hangs
///   between them under its weight, loads per length and buoyancy.
/// - ``elements``: default 10. ``nodes_at``: arc lengths in m that get a node.
/// - ``finest``: length in m of the elements at ``finest_at``, by default both ends, from where
///   they grow by a constant ratio up to their number: for moments at clamps and loads, within
///   ``sqrt(EI/T)`` of which a cable under a tension T bends.
/// - ``rule``: "projected-3" (default), "G5-3", "ST2", "L2T2" ...
/// - ``fidelity`` ("engineering" by default) or ``integrator``.
/// - ``gravity``: m/s^2, default (0, -9.81, 0). ``velocity`` (m/s) and ``angular_velocity``
///   (rad/s): a rigid motion of the start.
/// - ``fix``, ``clamp``: points held as they start; a clamp holds the tangent in the direction of
///   the polyline, too, also of a slack cable, which starts in equilibrium between its clamps. A
///   node is placed there.
/// - ``clamp_along``: clamps with their directions, as pairs of a place and a vector of any size.
/// - ``effects``: see lariat.effects. ``damped_as``: a kind of rope, see ``rope_kinds()``.
///
/// Raises InvalidValueError, ShapeError, TooFewPointsError, CoincidentPointsError,
/// ElementCountError, NoSectionError, RankDeficientError, OutOfRangeError, NodeBeforeMeshError,
/// EffectsError, MissingForEffectError, ExplicitDampingError and those of unknown names.
#[pyclass(frozen, module = "lariat_cables")]
pub struct Cable {
    home: Home,
    /// Obstacles of its own.
    obstacles: Shared<Vec<Laid>>,
    /// What was told of it through Python's `warnings`.
    told: Shared<Told>,
}

impl Cable {
    /// Makes the Python object of a cable.
    pub fn new(cable: ancf::Cable) -> Self {
        Cable::laid(cable, Vec::new())
    }

    /// Makes the Python object of a cable of a world.
    pub fn of_world(contents: Shared<Contents>, handle: CableHandle) -> Self {
        let (obstacles, told) = Default::default();
        Cable { home: Home::World(contents, handle), obstacles, told }
    }

    /// Makes the Python object of a cable that has these obstacles.
    fn laid(cable: ancf::Cable, obstacles: Vec<Laid>) -> Self {
        Cable { home: Home::Own(Shared::new(cable)), obstacles: Shared::new(obstacles), told: Shared::default() }
    }

    /// Makes the Python object of a cable that was saved with these obstacles.
    pub fn with_obstacles(mut cable: ancf::Cable, obstacles: Vec<Laid>) -> PyResult<Self> {
        if !obstacles.is_empty() {
            cable.set_obstacles(contact::made(&obstacles).map_err(raise)?).map_err(raise)?;
        }
        Ok(Cable::laid(cable, obstacles))
    }

    /// Returns the obstacles of its own.
    pub fn obstacles(&self, py: Python<'_>) -> Vec<Laid> {
        self.obstacles.with(py, |own| own.clone())
    }

    /// Returns a copy of the cable.
    pub fn copied(&self, py: Python<'_>) -> PyResult<ancf::Cable> {
        self.read(py, |cable| Ok(cable.clone()))
    }

    /// Gives to Python's `warnings` what is to be told of the cable after its steps.
    pub fn tell(&self, py: Python<'_>) -> PyResult<()> {
        tell(py, [self])
    }

    /// Reads the cable.
    fn read<R: Ungil + Send>(
        &self,
        py: Python<'_>,
        f: impl FnOnce(&ancf::Cable) -> Result<R, Error> + Ungil + Send,
    ) -> PyResult<R> {
        match &self.home {
            Home::Own(cable) => cable.with(py, |cable| f(cable)).map_err(raise),
            Home::World(contents, handle) => {
                contents.with(py, |contents| Ok(f(contents.set.get(*handle)?)?)).map_err(raise::<lariat_rapier::Error>)
            }
        }
    }

    /// Changes the cable; one that sleeps in a world wakes up. Other threads run Python meanwhile.
    fn change<R: Ungil + Send>(
        &self,
        py: Python<'_>,
        f: impl FnOnce(&mut ancf::Cable) -> Result<R, Error> + Ungil + Send,
    ) -> PyResult<R> {
        match &self.home {
            Home::Own(cable) => cable.compute(py, f).map_err(raise),
            Home::World(contents, handle) => contents
                .compute(py, |contents| Ok(f(contents.set.get_mut(*handle)?)?))
                .map_err(raise::<lariat_rapier::Error>),
        }
    }

    /// Returns the cable, if it belongs to no world.
    pub fn own(&self, what: &str) -> PyResult<&Shared<ancf::Cable>> {
        match &self.home {
            Home::Own(cable) => Ok(cable),
            Home::World(..) => {
                let message = format!("the cable belongs to a world, and cannot {what}: step the world");
                Err(raise(Raise::new("InWorldError", message)))
            }
        }
    }

    /// Returns the handle, if it belongs to this world.
    pub fn handle_in(&self, contents: &Shared<Contents>) -> PyResult<CableHandle> {
        match &self.home {
            Home::World(home, handle) if home.address() == contents.address() => Ok(*handle),
            _ => Err(raise(Raise::new("OtherWorldError", "the cable is not in this world: add it with add_cable"))),
        }
    }
}

/// One section, or several with the arc length at which each begins.
fn sections(section: &Bound<'_, PyAny>) -> PyResult<Vec<(f64, ancf::Section)>> {
    if let Ok(section) = section.cast::<Section>() {
        return Ok(vec![(0.0, section.get().0)]);
    }
    let wrong = || PyTypeError::new_err("expected a Section, or a list of (arc length, Section)");
    let items = section.try_iter().map_err(|_| wrong())?;
    items
        .map(|item| {
            let (from, section): (f64, Bound<'_, PyAny>) = item?.extract().map_err(|_| wrong())?;
            Ok((from, section.cast::<Section>().map_err(|_| wrong())?.get().0))
        })
        .collect()
}

/// Returns effects from what `lariat.effects.collect` makes of them.
fn effects(effects: &Bound<'_, PyAny>) -> PyResult<ancf::Effects> {
    let dict = effects.py().import("lariat_cables.effects")?.getattr("collect")?.call1((effects,))?;
    serde_json::from_value(data(&dict)?).map_err(|error| raise(Raise::new("EffectsError", format!("effects: {error}"))))
}

#[pymethods]
impl Cable {
    #[new]
    #[pyo3(signature = (points, section, *, length=None, pretension=None, sag=None, elements=None, finest=None, finest_at=None, name="cable", rule=None, allow_rank_deficient=false,
        fidelity=None, integrator=None, gravity=None, velocity=None, angular_velocity=None, fix=None, clamp=None,
        clamp_along=None, nodes_at=None, effects=None, damped_as=None))]
    fn py_new(
        points: Array,
        section: &Bound<'_, PyAny>,
        length: Option<f64>,
        pretension: Option<f64>,
        sag: Option<f64>,
        elements: Option<Count>,
        finest: Option<f64>,
        finest_at: Option<Places>,
        name: &str,
        rule: Option<&str>,
        allow_rank_deficient: bool,
        fidelity: Option<&str>,
        integrator: Option<Choice>,
        gravity: Option<Vector>,
        velocity: Option<Vector>,
        angular_velocity: Option<Vector>,
        fix: Option<Places>,
        clamp: Option<Places>,
        clamp_along: Option<Vec<(Place, Vector)>>,
        nodes_at: Option<Numbers>,
        effects: Option<&Bound<'_, PyAny>>,
        damped_as: Option<&str>,
    ) -> PyResult<Self> {
        if fidelity.is_some() && integrator.is_some() {
            return Err(raise(Raise::new("StepControlError", "give fidelity or integrator, not both")));
        }
        let mut builder = ancf::Cable::builder().name(name).points(points.vectors()?);
        for (from, section) in sections(section)? {
            builder = builder.section_from(from, section);
        }
        builder = match (length, pretension, sag) {
            (None, None, None) => builder,
            (Some(length), None, None) => builder.length(length),
            (None, Some(tension), None) => builder.pretension(tension),
            (None, None, Some(sag)) => builder.sag(sag),
            _ => return Err(PyTypeError::new_err("give one of length, pretension and sag")),
        };
        if let Some(elements) = elements {
            builder = builder.elements(elements.0);
        }
        match (finest, finest_at) {
            (None, None) => {}
            (Some(finest), None) => builder = builder.finest(finest, [ancf::At::Start, ancf::At::End]),
            (Some(finest), Some(Places(at))) => builder = builder.finest(finest, at),
            (None, Some(_)) => return Err(PyTypeError::new_err("finest_at needs finest, a length in m")),
        }
        if let Some(rule) = rule {
            builder = builder.rule(rule.parse().map_err(raise::<Error>)?);
        }
        if allow_rank_deficient {
            builder = builder.allow_rank_deficient();
        }
        if let Some(fidelity) = fidelity {
            builder = builder.fidelity(self::fidelity(fidelity)?);
        }
        if let Some(Choice(choice)) = integrator {
            builder = builder.integrator(choice);
        }
        if let Some(Vector(gravity)) = gravity {
            builder = builder.gravity(gravity);
        }
        if let Some(Vector(velocity)) = velocity {
            builder = builder.velocity(velocity);
        }
        if let Some(Vector(angular_velocity)) = angular_velocity {
            builder = builder.angular_velocity(angular_velocity);
        }
        builder = fix.unwrap_or_default().0.into_iter().fold(builder, |builder, at| builder.fix(at));
        builder = clamp.unwrap_or_default().0.into_iter().fold(builder, |builder, at| builder.clamp(at));
        let along = clamp_along.unwrap_or_default().into_iter();
        builder = along.fold(builder, |builder, (at, direction)| builder.clamp_along(at.0, direction.0));
        builder = nodes_at.map_or(Vec::new(), |at| at.0).into_iter().fold(builder, |builder, s| builder.node_at(s));
        if let Some(effects) = effects {
            builder = builder.effects(self::effects(effects)?);
        }
        if let Some(kind) = damped_as {
            builder = builder.damped_as(kind.parse().map_err(raise::<Error>)?);
        }
        let mut cable = builder.build().map_err(raise)?;
        cable.set_watched(true);
        Ok(Cable::new(cable))
    }

    /// Advances the cable by ``steps`` steps of ``dt`` (s); 0 does nothing. Ctrl-C ends it after a
    /// step. The first warning of each kind goes through Python's ``warnings`` as
    /// ``errors.ResultWarning``; ``warnings()`` has all. Raises InvalidValueError, AttachedError,
    /// InWorldError, and StepFailedError, after which the cable is as it was before the step that
    /// failed.
    #[pyo3(signature = (dt, *, steps=Count(1)), text_signature = "($self, dt, *, steps=1)")]
    fn step(&self, py: Python<'_>, dt: f64, steps: Count) -> PyResult<()> {
        self.own("step by itself")?.repeat(py, steps.0, |cable| cable.step(dt))?.map_err(raise)?;
        self.tell(py)
    }

    /// Moves the cable to static equilibrium. ``tolerance``: largest residual force over the sum of
    /// the loads. Raises NoEquilibriumError, after which the cable is as it was; AttachedError,
    /// InWorldError.
    #[pyo3(signature = (*, tolerance=1e-9, iterations=Count(400)), text_signature = "($self, *, tolerance=1e-9, iterations=400)")]
    fn equilibrium<'py>(&self, py: Python<'py>, tolerance: f64, iterations: Count) -> PyResult<Bound<'py, PyAny>> {
        let options = EquilibriumOptions { tolerance, iterations: iterations.0 };
        let own = self.own("find its equilibrium by itself (`World.equilibrium` does)")?;
        let report = own.compute(py, |cable| cable.equilibrium_with(options)).map_err(raise)?;
        crate::convert::result(py, "Equilibrium", (report.iterations, report.residual, report.stable))
    }

    /// Returns description and state; ``from_bytes`` continues the run bitwise. Pickle uses it.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let obstacles = self.obstacles(py);
        let written = self.read(py, |cable| Ok(saved::write(&(cable, &obstacles))))?;
        saved::to_bytes(py, "cable", written)
    }

    /// Returns a saved cable of the same version. Raises FormatError.
    #[staticmethod]
    fn from_bytes(bytes: Cow<'_, [u8]>) -> PyResult<Self> {
        let (cable, obstacles) = saved::from_bytes("cable", &bytes)?;
        Cable::with_obstacles(cable, obstacles)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        if let Home::World(..) = slf.get().home {
            // beside its world, it would be a cable of none
            let message =
                "the cable belongs to a world: pickle that, and take its cables of what is loaded, or pickle a copy()";
            return Err(raise(Raise::new("InWorldError", message)));
        }
        let restore = slf.get_type().getattr("from_bytes")?;
        Ok((restore, (slf.get().to_bytes(slf.py())?,)))
    }

    /// Returns a copy; that of a cable of a world belongs to no world.
    pub fn copy(&self, py: Python<'_>) -> PyResult<Self> {
        Ok(Cable::laid(self.copied(py)?, self.obstacles(py)))
    }

    fn __copy__(&self, py: Python<'_>) -> PyResult<Self> {
        self.copy(py)
    }

    fn __deepcopy__(&self, py: Python<'_>, _memo: &Bound<'_, PyDict>) -> PyResult<Self> {
        self.copy(py)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        self.read(py, |cable| {
            let (name, elements, length, time) = (cable.name(), cable.elements().len(), cable.length(), cable.time());
            Ok(format!("<Cable {name:?}: {elements} elements, {length} m, t = {time} s>"))
        })
    }

    /// Cuts the cable; this one keeps the part before the point, the other is returned. Raises
    /// OutOfRangeError, InWorldError.
    fn cut(&self, py: Python<'_>, at: Place) -> PyResult<Self> {
        let cut = self.own("be cut by itself")?.compute(py, |cable| cable.cut(at.0)).map_err(raise)?;
        Ok(Cable::laid(cut, self.obstacles(py)))
    }
}
