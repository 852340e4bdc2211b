//! `World`: rapier3d with cables on its bodies. `bodies`, `colliders`, `events`, `joints`, `queries`, `ropes`, `scene`, `water` and `wheels` hold what their names say.

mod bodies;
mod colliders;
mod events;
mod joints;
mod queries;
mod ropes;
mod scene;
mod water;
mod wheels;

pub use scene::load_scene;

use crate::cable::Cable;
use crate::convert::{Count, Place, Vector, result, vector};
use crate::error::{Raise, raise};
use crate::integrator::fidelity;
use crate::saved;
use crate::shared::Shared;
use crate::told::{Told, warn};
use bodies::{Handle, single};
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::rapier::pipeline::PhysicsWorld;
use lariat_rapier::{
    AttachmentHandle, AttachmentKind, AttachmentOptions, CableHandle, CableSet, Error, Gap, JunctionHandle,
    SheaveHandle,
};
use lariat_scene::run::Script;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use scene::{Names, Which};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Bodies and cables.
#[derive(Serialize, Deserialize)]
pub struct Contents {
    pub world: PhysicsWorld,
    pub set: CableSet,
    /// Simulated time in s.
    pub time: f64,
    /// Bodies of the user, in the order in which they were added.
    pub bodies: Vec<RigidBodyHandle>,
    /// Attachments in the order of their numbers.
    pub attachments: Vec<AttachmentHandle>,
    /// Sheaves in the order of their numbers.
    pub sheaves: Vec<SheaveHandle>,
    /// Junctions in the order of their numbers.
    pub junctions: Vec<JunctionHandle>,
    /// What a scene calls its parts; empty without a scene.
    names: Names,
    /// Paths and loads of a scene.
    script: Script,
    /// What was told through Python's `warnings`.
    #[serde(skip)]
    told: Told,
}

/// rapier3d with cables on its bodies. Names are those of the ``rapier3d`` wheel where they
/// overlap; bodies have single precision.
///
/// A world of this gravity (m/s^2, default (0, -9.81, 0)) and host step (s, default 1/60).
/// ``fidelity``: of cables whose integrator nobody chose. ``rapier_steps``, ``max_rapier_steps``:
/// Rapier's steps per host step. ``sleep_speed``: in m/s, below which cables and bodies may fall
/// asleep; 0 = never. ``max_iterations`` (Newton iterations of each island, repeatable) or
/// ``max_time`` (wall-clock s): the work of a host step beyond which accuracy is reduced, with the
/// event "degraded"; by default 2000 iterations per 1/60 s for cables with fidelity game, and no
/// limit for others, nor for any with ``max_time=math.inf``. ``warn_level``: up to which level
/// ``warnings`` and events warn; by default of cables with fidelity game up to "wrong", of others
/// up to "coarse". Raises InvalidValueError, UnknownFidelityError, UnknownKindError.
#[pyclass(frozen, module = "lariat_cables")]
pub struct World(pub Shared<Contents>);

/// Returns the kind of an attachment by its name.
fn kind(name: &str) -> PyResult<AttachmentKind> {
    match name {
        "ball" => Ok(AttachmentKind::Ball),
        "clamp" => Ok(AttachmentKind::Clamp),
        _ => Err(raise(Raise::new("UnknownKindError", format!("expected \"ball\" or \"clamp\", got {name:?}")))),
    }
}

/// Returns what has a number among those of a kind; `error` is the name of the exception if none has.
fn numbered<T: Copy>(all: &[T], number: usize, kind: &str, error: &'static str) -> Result<T, Raise> {
    let none = || Raise::new(error, format!("no {kind} {number} in this world"));
    all.get(number).copied().ok_or_else(none)
}

impl Contents {
    fn add_attachment(&mut self, handle: AttachmentHandle) -> usize {
        self.attachments.push(handle);
        self.attachments.len() - 1
    }
}

#[pymethods]
impl World {
    #[new]
    #[pyo3(signature = (gravity=None, *, dt=1.0/60.0, fidelity="game", rapier_steps=Count(1), max_rapier_steps=Count(32), sleep_speed=2e-3,
        max_iterations=None, max_time=None, warn_level=None), text_signature = "(gravity=None, *, dt=..., fidelity='game', rapier_steps=1, max_rapier_steps=32, sleep_speed=2e-3, max_iterations=None, max_time=None, warn_level=None)")]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn new(
        gravity: Option<Vector>,
        dt: f64,
        fidelity: &str,
        rapier_steps: Count<u32>,
        max_rapier_steps: Count<u32>,
        sleep_speed: f64,
        max_iterations: Option<u64>,
        max_time: Option<f64>,
        warn_level: Option<&str>,
    ) -> PyResult<Self> {
        let mut world = PhysicsWorld::new();
        world.gravity = single("gravity (m/s^2)", gravity.map_or(lariat_ancf::STANDARD_GRAVITY, |v| v.0))?;
        world.integration_parameters.dt = bodies::positive("dt (s)", dt)?;
        let mut set = CableSet::new();
        if !(sleep_speed.is_finite() && sleep_speed >= 0.0) {
            return Err(bodies::invalid("sleep_speed (m/s)", sleep_speed, ">= 0"));
        }
        let (Count(rapier_steps), Count(max_rapier_steps)) = (rapier_steps, max_rapier_steps);
        if rapier_steps == 0 {
            return Err(bodies::invalid("rapier_steps", 0.0, "> 0"));
        }
        set.settings.rapier_steps = rapier_steps;
        set.settings.max_rapier_steps = max_rapier_steps;
        set.settings.sleep_speed = sleep_speed;
        set.settings.fidelity = self::fidelity(fidelity)?;
        set.settings.budget = ropes::budget(max_iterations, max_time)?;
        let level = |name: &str| {
            name.parse::<lariat_ancf::Level>().map_err(|problem| raise(Raise::new("UnknownKindError", problem)))
        };
        set.settings.warn_level = warn_level.map(level).transpose()?;
        let (bodies, attachments, sheaves, junctions) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let (names, script, told) = Default::default();
        let contents = Contents { world, set, time: 0.0, bodies, attachments, sheaves, junctions, names, script, told };
        Ok(World(Shared::new(contents)))
    }

    /// Advances bodies and cables by ``dt`` (s); without, by that of the world. The first warning of
    /// each kind, before the first step and after each, goes through Python's ``warnings`` as
    /// ``errors.ResultWarning``; ``warnings()`` has all. Raises InvalidValueError, and
    /// StepRefusedError if some cables cannot step; all others have advanced.
    #[pyo3(signature = (dt=None))]
    fn step(&self, py: Python<'_>, dt: Option<f64>) -> PyResult<()> {
        let dt = dt.map(|dt| bodies::positive("dt (s)", dt)).transpose()?;
        let (outcome, lines) = self.0.compute(py, |contents| {
            let mut lines = contents.of_start();
            let Contents { world, set, time, script, .. } = contents;
            let own = world.integration_parameters.dt;
            let step = dt.unwrap_or(own);
            let end = *time + f64::from(step);
            script.set(world, *time, end);
            world.integration_parameters.dt = step;
            let outcome = set.step(world);
            world.integration_parameters.dt = own;
            if matches!(outcome, Ok(()) | Err(Error::StepRefused { .. })) {
                *time = end;
            }
            lines.extend(contents.of_events());
            (outcome, lines)
        });
        outcome.map_err(raise)?;
        warn(py, lines)
    }

    /// Adds a copy of a cable, and returns it as a part of this world. Raises NoCableError for one
    /// that was removed from its world.
    fn add_cable(&self, py: Python<'_>, cable: &Cable) -> PyResult<Cable> {
        let cable = cable.copied(py)?;
        let handle = self.0.compute(py, |contents| contents.set.insert(cable));
        Ok(Cable::of_world(self.0.clone(), handle))
    }

    /// All cables.
    #[getter]
    fn cables(&self, py: Python<'_>) -> Vec<Cable> {
        let handles: Vec<CableHandle> = self.0.with(py, |contents| contents.set.iter().map(|(h, _)| h).collect());
        handles.into_iter().map(|handle| Cable::of_world(self.0.clone(), handle)).collect()
    }

    /// Removes a cable with its attachments, and returns it by itself. Raises NoCableError,
    /// OtherWorldError.
    fn remove_cable(&self, py: Python<'_>, cable: &Cable) -> PyResult<Cable> {
        let handle = cable.handle_in(&self.0)?;
        let removed = self.0.compute(py, |Contents { world, set, .. }| set.remove(world, handle));
        removed.map(Cable::new).map_err(raise)
    }

    /// Cuts a cable; it keeps the part before the point, the other is returned. Raises
    /// OutOfRangeError.
    fn cut(&self, py: Python<'_>, cable: &Cable, at: Place) -> PyResult<Cable> {
        let handle = cable.handle_in(&self.0)?;
        let rest = self.0.compute(py, |contents| contents.set.cut(handle, at.0)).map_err(raise)?;
        Ok(Cable::of_world(self.0.clone(), rest))
    }

    /// Attaches a point of a cable to a body: at ``anchor`` (m, body axes), by default where the
    /// point is now. ``gap``: the largest distance in m that is closed; None: any. ``direction``:
    /// of the tangent of a clamp, in body axes; by default as it is, of a slack cable as it was
    /// laid that of the drawing. Returns the number of the attachment. Raises GapTooLongError,
    /// AlreadyAttachedError, NoBodyError, NoCableError, OutOfRangeError.
    #[pyo3(signature = (cable, at, body, anchor=None, *, kind="ball", gap=1e-3, direction=None))]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn attach(
        &self,
        py: Python<'_>,
        cable: &Cable,
        at: Place,
        body: Handle,
        anchor: Option<Vector>,
        kind: &str,
        gap: Option<f64>,
        direction: Option<Vector>,
    ) -> PyResult<usize> {
        let (handle, kind) = (cable.handle_in(&self.0)?, self::kind(kind)?);
        let gap = gap.map_or(Gap::Close, Gap::Refuse);
        let options = AttachmentOptions { kind, gap, direction: direction.map(|v| v.0) };
        let attached = self.0.compute(py, |contents| {
            let Contents { world, set, .. } = contents;
            let attachment = match anchor {
                None => set.attach_here(world, handle, at.0, body.0, options),
                Some(Vector(anchor)) => set.attach(world, handle, at.0, body.0, anchor, options),
            };
            attachment.map(|attachment| contents.add_attachment(attachment))
        });
        attached.map_err(raise)
    }

    /// Ends an attachment, by its number or its name in the scene. Raises NoAttachmentError.
    fn detach(&self, py: Python<'_>, attachment: Which) -> PyResult<()> {
        let outcome = self.0.compute(py, |contents| {
            let handle = contents.attachment(&attachment)?;
            contents.set.detach(&mut contents.world, handle).map_err(Raise::from)
        });
        outcome.map_err(raise)
    }

    /// Returns what the cable does to the body, after the last step; of an attachment by its
    /// number, or its name in the scene. Raises NoAttachmentError.
    fn attachment<'py>(&self, py: Python<'py>, attachment: Which) -> PyResult<Bound<'py, PyAny>> {
        let reading = self.0.with(py, |contents| {
            let handle = contents.attachment(&attachment)?;
            contents.set.attachment(handle).map(|attachment| *attachment.reading()).map_err(Raise::from)
        });
        let reading = reading.map_err(raise)?;
        let [force, moment, gap] = [reading.force, reading.moment, reading.gap].map(|v| vector(py, &v));
        result(py, "Attachment", (force, moment, gap, reading.work))
    }

    /// Returns whether a cable is asleep with the bodies attached to it. Raises OtherWorldError,
    /// NoCableError.
    fn is_asleep(&self, py: Python<'_>, cable: &Cable) -> PyResult<bool> {
        let handle = cable.handle_in(&self.0)?;
        self.0.with(py, |contents| contents.set.is_asleep(handle)).map_err(raise)
    }

    /// Returns energies in J.
    fn energy<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let energy = self.0.with(py, |contents| contents.set.energy(&contents.world)).map_err(raise)?;
        let cables = energy.cables;
        let cables =
            result(py, "Energy", (cables.kinetic, cables.axial, cables.bending, cables.gravity, cables.torsion))?;
        result(py, "WorldEnergy", (cables, energy.bodies_kinetic, energy.bodies_gravity))
    }

    /// Returns the momentum of cables and bodies.
    fn momentum<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let momentum = self.0.with(py, |contents| contents.set.momentum(&contents.world)).map_err(raise)?;
        result(py, "Momentum", (vector(py, &momentum.linear), vector(py, &momentum.angular)))
    }

    /// Simulated time in s.
    #[getter]
    fn time(&self, py: Python<'_>) -> f64 {
        self.0.with(py, |contents| contents.time)
    }

    /// The host step in s. Set: raises InvalidValueError.
    #[getter]
    fn dt(&self, py: Python<'_>) -> f64 {
        self.0.with(py, |contents| f64::from(contents.world.integration_parameters.dt))
    }

    #[setter]
    fn set_dt(&self, py: Python<'_>, value: f64) -> PyResult<()> {
        let dt = bodies::positive("dt (s)", value)?;
        self.0.with(py, |contents| contents.world.integration_parameters.dt = dt);
        Ok(())
    }

    /// Gravity in m/s^2, shape (3,). Set: raises ShapeError, InvalidValueError.
    #[getter]
    fn gravity<'py>(&self, py: Python<'py>) -> Bound<'py, numpy::PyArray1<f64>> {
        vector(py, &lariat_rapier::convert::vector(self.0.with(py, |contents| contents.world.gravity)))
    }

    #[setter]
    fn set_gravity(&self, py: Python<'_>, value: Vector) -> PyResult<()> {
        let gravity = single("gravity (m/s^2)", value.0)?;
        self.0.with(py, |contents| contents.world.gravity = gravity);
        Ok(())
    }

    /// Returns bodies and cables, for ``restore``.
    fn snapshot<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        self.to_bytes(py)
    }

    /// Restores bodies and cables of a snapshot of the same version; the run continues bitwise from
    /// there. Cables and handles of what is in it stay valid; those of what was added since raise
    /// NoCableError, NoBodyError. Raises FormatError, after which all is as before.
    fn restore(&self, py: Python<'_>, snapshot: Cow<'_, [u8]>) -> PyResult<()> {
        let saved: Contents = saved::from_bytes("world", &snapshot)?;
        self.0.compute(py, |contents| {
            let told = core::mem::take(&mut contents.told);
            *contents = Contents { told, ..saved };
        });
        Ok(())
    }

    /// Returns bodies and cables; ``from_bytes`` continues the run bitwise. Pickle uses it.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        saved::to_bytes(py, "world", self.0.compute(py, |contents| saved::write(contents)))
    }

    /// Returns a saved world of the same version, from ``to_bytes`` or ``snapshot``. Raises
    /// FormatError.
    #[staticmethod]
    fn from_bytes(bytes: Cow<'_, [u8]>) -> PyResult<Self> {
        Ok(World(Shared::new(saved::from_bytes("world", &bytes)?)))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        let from_bytes = slf.get_type().getattr("from_bytes")?;
        Ok((from_bytes, (slf.get().to_bytes(slf.py())?,)))
    }
}
