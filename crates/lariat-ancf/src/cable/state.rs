//! The state of a cable: read, put back, changed between steps.

use super::reel::Winding;
use super::{Cable, Snapshot};
use crate::error::{Error, require, require_finite};
use crate::support::Prescription;
use crate::term::EnergyLaw;
use nalgebra::{UnitQuaternion, Vector3};

impl Cable {
    /// Returns the nodal coordinates, flat: by node the position (m) and the slope dr/ds.
    pub fn positions(&self) -> &[f64] {
        &self.snapshot.state.q
    }

    /// Returns the nodal velocities, flat: by node m/s and 1/s.
    pub fn velocities(&self) -> &[f64] {
        &self.snapshot.state.v
    }

    /// Returns the terms of the energy law since the cable was built: of an island that steps by
    /// `discrete-gradient`, its first cable has those of all.
    pub fn energy_law(&self) -> &EnergyLaw {
        &self.snapshot.law
    }

    /// Returns the state: clone it to keep it.
    pub fn snapshot(&self) -> &Snapshot {
        &self.snapshot
    }

    /// Restores a state; the run then continues bitwise as it did from there (if supports, loads,
    /// effects and integrator are as they were, else from its positions and velocities). What is
    /// [prescribed](Self::prescribe) is restored, too; if anything was since, the run continues
    /// from positions and velocities.
    ///
    /// # Errors
    /// [`Error::WrongCount`] if the state is of a cable with another number of nodes,
    /// [`Error::InvalidValue`] if it is not finite.
    pub fn restore(&mut self, snapshot: Snapshot) -> Result<(), Error> {
        let nodes = snapshot.nodes_with_reel(self.has_reel(), self.nodes());
        snapshot.state.check(self.name(), 6 * nodes)?;
        let mut windings = snapshot.windings.iter().flatten();
        windings.try_for_each(Winding::check).map_err(|e| e.of_cable(self.name()))?;
        let mut works = snapshot.work.by_key();
        works
            .try_for_each(|(_, x)| require("work of effects (J)", x, true, "a number"))
            .map_err(|e| e.of_cable(self.name()))?;
        let mut terms = snapshot.law.terms().into_iter();
        terms
            .try_for_each(|x| require("term of the energy law (J)", x, true, "a number"))
            .map_err(|e| e.of_cable(self.name()))?;
        snapshot.prescribed.iter().try_for_each(Prescription::check).map_err(|e| e.of_cable(self.name()))?;
        self.mesh_of_reel(&snapshot, nodes)?;
        let revision = self.revision;
        self.restore_prescribed(&snapshot.prescribed)?;
        // supports are what they were
        self.revision = revision;
        self.snapshot = snapshot;
        if let Some(watch) = &mut self.watch {
            watch.interrupt();
        }
        self.sync_reel();
        Ok(())
    }

    /// Sets nodal coordinates and velocities, flat as [`positions`](Self::positions) and
    /// [`velocities`](Self::velocities). If positions change, contacts are forgotten: friction
    /// begins anew, and a depth at which the cable is set gives no force and no energy.
    /// [`restore`](Self::restore) keeps them.
    ///
    /// # Errors
    /// [`Error::WrongCount`] for the wrong number, [`Error::InvalidValue`] for numbers that are not
    /// finite.
    pub fn set_coordinates(&mut self, positions: &[f64], velocities: &[f64]) -> Result<(), Error> {
        let n = self.positions().len();
        for (what, each, given) in [("coordinates", "coordinate", positions), ("velocities", "velocity", velocities)] {
            if given.len() != n {
                let (cable, count) = (self.name().to_string(), given.len());
                return Err(Error::WrongCount { cable, what, count, expected: n });
            }
            given.iter().try_for_each(|&x| require(each, x, true, "a number")).map_err(|e| e.of_cable(self.name()))?;
        }
        let moved = self.snapshot.state.q != positions;
        let before = moved.then(|| self.snapshot.state.q.clone());
        self.snapshot.state.q.copy_from_slice(positions);
        self.snapshot.state.v.copy_from_slice(velocities);
        if let Some(before) = before {
            self.follow_twist(&before);
            self.disturb()
        } else {
            self.disturb_motion()
        }
        Ok(())
    }

    /// Marks the accelerations as unknown, and forgets contacts, after a change of the positions.
    pub(crate) fn disturb(&mut self) {
        self.disturb_motion();
        self.snapshot.state.memory.contacts.clear();
        self.snapshot.state.memory.pairs.clear();
    }

    /// Marks the accelerations as unknown, after a change of the velocities; contacts are of the
    /// positions.
    fn disturb_motion(&mut self) {
        let memory = &mut self.snapshot.state.memory;
        memory.valid = false;
        memory.step = 0.0;
        memory.differences.clear();
        self.snapshot.load.interrupt();
        if let Some(watch) = &mut self.watch {
            watch.interrupt();
        }
    }

    /// Marks a change of supports, loads, effects or integrator: states from before keep their
    /// positions and velocities only.
    pub(crate) fn revise(&mut self) {
        self.revision += 1;
        self.refresh_memory();
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn set_rigid_motion(
        &mut self,
        velocity: Vector3<f64>,
        angular_velocity: Vector3<f64>,
    ) -> Result<(), Error> {
        require_finite("velocity (m/s)", &velocity)?;
        require_finite("angular velocity (rad/s)", &angular_velocity)?;
        let start = self.node_position(0);
        let state = &mut self.snapshot.state;
        for (q, v) in state.q.chunks_exact(6).zip(state.v.chunks_exact_mut(6)) {
            let (r, t) = (Vector3::new(q[0], q[1], q[2]), Vector3::new(q[3], q[4], q[5]));
            v[..3].copy_from_slice((velocity + angular_velocity.cross(&(r - start))).as_slice());
            v[3..].copy_from_slice(angular_velocity.cross(&t).as_slice());
        }
        for (node, support) in &self.model.supports {
            // the next step moves held coordinates to their positions; here only their velocity
            // counts
            let mut position = [0.0; 6];
            support.prescribe(state.time, &mut position, &mut state.v[6 * node..6 * node + 6]);
        }
        self.disturb_motion();
        Ok(())
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn move_by(&mut self, turn: &UnitQuaternion<f64>, by: &Vector3<f64>) {
        self.snapshot.state.move_by(turn, by);
        if let Some(watch) = &mut self.watch {
            watch.interrupt();
        }
    }

    /// Returns whether it rests, and has not been stepped since it was built or inserted.
    pub(crate) fn is_as_begun(&self) -> bool {
        self.time() == self.begins && self.velocities().iter().all(|v| *v == 0.0)
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn speed(&self) -> f64 {
        let squared = |v: &[f64]| v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        self.velocities().chunks_exact(6).map(squared).fold(0.0, f64::max).sqrt()
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn rest(&mut self, dt: f64) {
        let state = &mut self.snapshot.state;
        state.time += dt;
        state.v.fill(0.0);
        self.disturb_motion();
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn set_time(&mut self, time: f64) -> Result<(), Error> {
        require("time (s)", time, true, "a number")?;
        let later = time - self.time();
        if self.begins == self.time() {
            self.begins = time;
        }
        self.model.loads.iter_mut().for_each(|load| load.start += later);
        for (_, support) in &mut self.model.supports {
            support.delay(later);
        }
        if let Some(torsion) = &mut self.model.effects.torsion {
            torsion.delay(later);
        }
        self.snapshot.prescribed.iter_mut().for_each(|led| led.delay(later));
        self.snapshot.state.time = time;
        self.sync_reel();
        self.revise();
        Ok(())
    }

    /// Discards accelerations that belong to another description of the cable (of a snapshot from
    /// before a change).
    pub(crate) fn refresh_memory(&mut self) {
        let memory = &mut self.snapshot.state.memory;
        if memory.revision != self.revision {
            memory.valid = false;
            memory.step = 0.0;
            memory.revision = self.revision;
        }
    }
}
