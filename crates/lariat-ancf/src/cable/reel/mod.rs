//! A reel at the end of a cable: it pays the cable out and takes it in.
//!
//! # Equation
//!
//! Only the element at the eye, the last one, is of changing material ([`element::flow`](crate::element)): its length l is a function of
//! time, given by the rate of the reel. All others are made of the same particles for ever, so supports, loads and samples keep their
//! arc length, which counts from the other end. [`remesh`] keeps l near the length of the elements, and [`plan`] chooses the rate.
//!
//! # Validity
//!
//! The rate is prescribed: the winch is as strong as it must be, and [`ReelReading::force`] says how strong that is. Stock leaves a drum
//! that runs with the rate. A rate above 0.3 of the speed of transverse waves, `sqrt(T/rho A)`, needs internal damping. A rope
//! that is paid out faster than it falls crumples at the eye, and splitting crumpled elements adds strain energy:
//! [`ReelReading::remeshed`] says how much. The node at
//! the eye is held by a support, or by an attachment to a body that is not moved by the cable: the stock's momentum is not accounted
//! on a free body. Implicit methods only. Gravity, internal damping and a uniform rest stretch act on the element at the eye; other
//! effects are refused ([`Error::NotWithReel`]).
//!
//! # Alternatives considered
//!
//! A reel at the first node: arc lengths would count from the eye. Reverse the points of the cable.

mod plan;
mod remesh;
mod step;

use super::{At, Cable, Snapshot};
use crate::effect::RestShape;
use crate::element::flow::Extent;
use crate::error::{Error, require};
use crate::model::Model;
use crate::section::Element;
use serde::{Deserialize, Serialize};

/// A reel as its user describes it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Reel {
    /// Rate in m/s by time in s, ascending: positive pays out; a rate holds until the next row. Default: no rows, at rest.
    pub rate: Vec<[f64; 2]>,
    /// Largest acceleration of the rate in m/s^2. Default 2: a jump of the rate by dv is one of the tension by dv sqrt(EA rho A).
    pub acceleration: f64,
    /// Largest length of cable in m that can be out: the reel stops there. Default: no limit.
    pub stock: Option<f64>,
}

impl Default for Reel {
    fn default() -> Self {
        Reel { rate: Vec::new(), acceleration: 2.0, stock: None }
    }
}

impl Reel {
    /// A reel with a constant rate in m/s.
    pub fn with_rate(rate: f64) -> Self {
        Reel { rate: vec![[f64::MIN, rate]], ..Self::default() }
    }

    fn check(&self) -> Result<(), Error> {
        require("acceleration of a reel (m/s^2)", self.acceleration, self.acceleration > 0.0, "> 0")?;
        if let Some(stock) = self.stock {
            require("stock of a reel (m)", stock, stock > 0.0, "> 0")?;
        }
        let mut before = f64::NEG_INFINITY;
        for &[time, rate] in &self.rate {
            require("rate of a reel (m/s)", rate, true, "a number")?;
            require("time of a rate of a reel (s)", time, time > before, "ascending")?;
            before = time;
        }
        Ok(())
    }
}

/// A reel in the description of its cable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReelModel {
    reel: Reel,
    /// The elements of the cable when it got its reel: as far as it is out, the mesh is this.
    mesh: Vec<Element>,
    /// An element of the stock.
    stock: Element,
}

impl ReelModel {
    /// Returns element `e` of the mesh at its full length.
    fn element(&self, e: usize) -> Element {
        self.mesh.get(e).copied().unwrap_or(self.stock)
    }

    /// Adapts the mesh to an element that is split in two.
    pub(crate) fn refine(&mut self, e: usize, parts: [Element; 2]) {
        while self.mesh.len() <= e {
            self.mesh.push(self.stock);
        }
        self.mesh.splice(e..=e, parts);
    }

    /// Returns the reel of the part of the cable behind a node.
    pub(crate) fn behind(&self, node: usize) -> ReelModel {
        ReelModel { mesh: self.mesh.get(node..).unwrap_or(&[]).to_vec(), ..self.clone() }
    }
}

/// The state of a reel, beside the coordinates of its cable.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Winding {
    /// The element at the eye: length in m, rate in m/s, acceleration in m/s^2.
    extent: [f64; 3],
    /// Length in m at the beginning of the last step of the integrator.
    length_before: f64,
    /// Work of the winch and of entering material in J.
    work: f64,
    /// Energy in J that merging and splitting elements added.
    remeshed: f64,
    splits: u64,
    merges: u64,
    stopped: bool,
}

impl Winding {
    /// Adds work in J.
    pub fn add_work(&mut self, work: f64) {
        self.work += work;
    }

    /// Refuses numbers that make no reel: for snapshots that come from a file.
    pub fn check(&self) -> Result<(), Error> {
        let [length, rate, acceleration] = self.extent;
        require("length of the element at the eye (m)", length, length > 0.0, "> 0")?;
        for x in [rate, acceleration, self.length_before, self.work, self.remeshed] {
            require("number of a reel", x, true, "a number")?;
        }
        Ok(())
    }
}

impl Snapshot {
    /// Returns the number of nodes that the state must have: its own with a reel, else that of the cable.
    pub(super) fn nodes_with_reel(&self, reel: bool, nodes: usize) -> usize {
        if reel && self.winding.is_some() { (self.state.q.len() / 6).max(2) } else { nodes }
    }
}

/// What a reel does now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReelReading {
    /// Unstretched length of cable that is out, in m.
    pub length_out: f64,
    /// Rate in m/s: positive pays out.
    pub rate: f64,
    /// Pull of the winch on the cable along itself in N, at the present state and its known accelerations.
    pub force: f64,
    /// Tension of the cable at the eye in N, from the pull: `T f - u = pull + 1/2 rho A rate^2 (f^2 - 1)`, u the strain
    /// energy per length. Smoother than what [`Cable::sample`] reads there, which depends on the length of the element.
    pub tension: f64,
    /// Work of the winch on the cable so far in J, with the kinetic and the potential energy of the material that entered: the energy
    /// of the cable changes by this, by the work of all else, and by `remeshed`.
    pub work: f64,
    /// Energy in J that merging and splitting elements added so far.
    pub remeshed: f64,
    /// Elements split so far.
    pub splits: u64,
    /// Elements merged so far.
    pub merges: u64,
    /// Whether it slows down or stands at the end of its stock, at a held node or a load.
    pub stopped: bool,
    /// Rate over the speed of transverse waves at the eye: above 0.3, give the cable internal damping. Infinite without tension.
    pub speed_ratio: f64,
}

impl Cable {
    /// Puts a reel at the end of the cable: from the next step on, it pays cable out and takes it in through the last node, the
    /// eye. Hold that node by a support or an attachment.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for numbers out of range, [`Error::ReelPlace`] for another place than the end or for a second reel,
    /// [`Error::ExplicitReel`] for an explicit integrator, [`Error::NotWithReel`] for effects that the flowing element does not
    /// carry. The cable is then as before.
    pub fn add_reel(&mut self, at: impl Into<At>, reel: Reel) -> Result<(), Error> {
        reel.check().map_err(|e| e.of_cable(self.name()))?;
        let cable = || self.name().to_string();
        if self.model.reel.is_some() {
            return Err(Error::ReelPlace { cable: cable(), reason: "it has a reel already" });
        }
        if self.node(at)? + 1 != self.nodes() {
            return Err(Error::ReelPlace {
                cable: cable(),
                reason: "a reel is at the end of a cable: reverse its points",
            });
        }
        let mut model = self.model.clone();
        let stock = self.elements()[self.elements().len() - 1];
        model.reel = Some(ReelModel { reel, mesh: self.elements().to_vec(), stock });
        model.check_effects().map_err(|e| e.of_cable(self.name()))?;
        super::check_integrator(&model, &self.integrator().method)?;
        let length = self.elements()[self.elements().len() - 1].length;
        self.rebuild(model)?;
        self.snapshot.winding =
            Some(Winding { extent: [length, 0.0, 0.0], length_before: length, ..Winding::default() });
        self.sync_reel();
        self.revise();
        Ok(())
    }

    /// Changes what the reel does from now on. The rate follows with the acceleration of the reel.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for numbers out of range, [`Error::ReelPlace`] for a cable without a reel.
    pub fn set_reel(&mut self, reel: Reel) -> Result<(), Error> {
        reel.check().map_err(|e| e.of_cable(self.name()))?;
        match &mut self.model.reel {
            Some(own) => own.reel = reel,
            None => return Err(Error::ReelPlace { cable: self.name().to_string(), reason: "it has no reel" }),
        }
        Ok(())
    }

    /// Changes the rate of the reel in m/s: positive pays out.
    ///
    /// # Errors
    /// As [`set_reel`](Self::set_reel).
    pub fn set_reel_rate(&mut self, rate: f64) -> Result<(), Error> {
        let own = self.model.reel.as_ref().map(|own| own.reel.clone()).unwrap_or_default();
        self.set_reel(Reel { rate: Reel::with_rate(rate).rate, ..own })
    }

    /// Takes the reel away: what is out stays, and nothing moves through the eye any more. Does nothing without a reel.
    ///
    /// # Errors
    /// [`Error::StepFailed`] if the mass matrix cannot be factored; not for a cable that was built.
    pub fn remove_reel(&mut self) -> Result<(), Error> {
        if self.model.reel.is_some() {
            let mut model = self.model.clone();
            model.reel = None;
            self.rebuild(model)?;
            self.snapshot.winding = None;
            self.disturb();
            self.revise();
        }
        Ok(())
    }

    /// Returns the reel as it was described; `None` without one.
    pub fn reel_description(&self) -> Option<&Reel> {
        self.model.reel.as_ref().map(|own| &own.reel)
    }

    /// Returns whether the cable has a reel.
    pub fn has_reel(&self) -> bool {
        self.model.reel.is_some()
    }

    /// Returns what the reel does now; `None` without one.
    pub fn reel(&self) -> Option<ReelReading> {
        let winding = self.snapshot.winding?;
        let n = self.positions().len();
        let memory = &self.snapshot.state.memory;
        let mut acceleration = [0.0; 12];
        let differences = &memory.differences;
        if memory.valid {
            acceleration.copy_from_slice(&memory.acceleration[n - 12..]);
        } else if !differences.is_empty() && differences.step > 0.0 {
            // the discrete gradient knows the mean ones of its last step
            (0..12).for_each(|i| acceleration[i] = differences.velocity[n - 12 + i] / differences.step);
        }
        let last = self.elements().len() - 1;
        let element = &self.elements()[last];
        let (q, v) = (&self.positions()[n - 12..], &self.velocities()[n - 12..]);
        let inertia = self.model.inertia(element);
        let force = self.system.flow_force(&self.model, self.time(), [q, v, &acceleration]);
        let rate = winding.extent[1];
        // T f - u0 = EA (eps + 3/2 eps^2) with the strain eps at the eye
        let stiffness = element.section.axial_stiffness;
        let square: f64 = (9..12).map(|i| q[i] * q[i]).sum();
        let eye = force.pull + 0.5 * inertia * rate * rate * (square - 1.0);
        let strain = ((1.0 + 6.0 * eye / stiffness).max(0.0).sqrt() - 1.0) / 3.0;
        let tension = stiffness * strain * (1.0 + 2.0 * strain).max(0.0).sqrt();
        Some(ReelReading {
            length_out: self.length(),
            rate,
            force: force.pull,
            tension,
            work: winding.work,
            remeshed: winding.remeshed,
            splits: winding.splits,
            merges: winding.merges,
            stopped: winding.stopped,
            speed_ratio: if rate == 0.0 { 0.0 } else { rate.abs() / (tension.max(0.0) / inertia).sqrt() },
        })
    }

    /// Returns the extent of the element at the eye; `None` without a reel.
    pub(crate) fn reel_extent(&self) -> Option<Extent> {
        let [length, rate, acceleration] = self.snapshot.winding?.extent;
        Some(Extent { length, rate, acceleration })
    }

    /// Returns whether the reel stands and is not asked to turn; true without one.
    pub fn is_reel_still(&self) -> bool {
        let (Some(own), Some(winding)) = (&self.model.reel, &self.snapshot.winding) else { return true };
        winding.extent[1] == 0.0 && (plan::asked(&own.reel, self.time()) == 0.0 || winding.stopped)
    }

    /// Sets the equations to the present state of the reel.
    pub(crate) fn sync_reel(&mut self) {
        let (Some(winding), Some(flow)) = (&self.snapshot.winding, &mut self.system.flow) else { return };
        let [length, rate, acceleration] = winding.extent;
        flow.start = self.snapshot.state.time;
        flow.extent = Extent { length, rate, acceleration };
        flow.length_before = winding.length_before;
        self.system.set_flow(&self.model, self.snapshot.state.time);
    }

    /// Sets the mesh to that of a reel's state with this number of nodes.
    pub(crate) fn mesh_of_reel(&mut self, winding: Option<Winding>, nodes: usize) -> Result<(), Error> {
        let (Some(own), Some(winding)) = (&self.model.reel, winding) else { return Ok(()) };
        let mut model = self.model.clone();
        model.elements = (0..nodes - 1).map(|e| own.element(e)).collect();
        model.elements[nodes - 2].length = winding.extent[0];
        if model.elements == self.model.elements {
            return Ok(());
        }
        let eye = self.nodes() - 1;
        model.supports.iter_mut().filter(|(node, _)| *node == eye).for_each(|(node, _)| *node = nodes - 1);
        self.rebuild(model)
    }
}

impl Model {
    /// Refuses effects that the element at the eye of a reel does not carry.
    pub(crate) fn check_with_reel(&self) -> Result<(), Error> {
        let curved = |shape: &RestShape| shape.pieces.len() > 1 || shape.at(0.0).1 > 0.0 || shape.pieces[0].from > 0.0;
        let refused = [
            ("drag", self.effects.drag.is_some()),
            ("buoyancy", self.effects.buoyancy.is_some()),
            ("contact", self.effects.contact.is_some()),
            ("line loads", self.effects.line_loads.is_some()),
            ("a rest shape that is curved or in pieces", self.effects.rest_shape.as_ref().is_some_and(curved)),
            ("forces per length of your own", !self.force_densities.is_empty()),
        ];
        match refused.iter().find(|(_, is_there)| *is_there) {
            None => Ok(()),
            Some((what, _)) => Err(Error::NotWithReel { cable: self.name.clone(), what }),
        }
    }
}
