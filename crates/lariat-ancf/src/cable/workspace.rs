//! The buffers of a step: one set per thread, lent to each cable while it steps.
//!
//! A cable between two steps holds its description, its state and its tables, but no matrix and no
//! vector that a step overwrites: these are some 40 kB per cable of 16 elements, and one set that
//! stays in the cache serves a whole fleet. What a cable finds in them is unspecified, and nothing
//! of it reaches a result.

use super::Cable;
use crate::integrate::Scratch;
use crate::state::State;
use crate::system::{Buffers, StepMatrix, StepVectors};
use core::cell::RefCell;
use core::mem::swap;

/// What a step overwrites.
#[derive(Clone, Debug, Default)]
pub(crate) struct Workspace {
    matrix: StepMatrix,
    buffers: Buffers,
    step_buffers: StepVectors,
    scratch: Scratch,
    before: State,
}

/// The workspaces of a thread. As many are lent as calls are nested, or as an island has cables.
#[derive(Debug, Default)]
struct Pool {
    workspaces: Vec<Workspace>,
    lent: usize,
}

thread_local! {
    static POOL: RefCell<Pool> = RefCell::default();
}

impl Workspace {
    /// Exchanges the buffers with those of a cable.
    fn exchange(&mut self, cable: &mut Cable) {
        swap(&mut self.matrix, &mut cable.system.step);
        swap(&mut self.buffers, &mut cable.buffers);
        swap(&mut self.step_buffers, &mut cable.step_buffers);
        swap(&mut self.scratch, &mut cable.scratch);
        swap(&mut self.before, &mut cable.before);
    }
}

impl Cable {
    /// Lends a workspace of this thread to the cable.
    pub(crate) fn take_workspace(&mut self) {
        POOL.with_borrow_mut(|pool| {
            if pool.lent == pool.workspaces.len() {
                pool.workspaces.push(Workspace::default());
            }
            pool.workspaces[pool.lent].exchange(self);
            pool.lent += 1;
        });
        self.buffers.resize(&self.model);
        self.system.step.begin(self.model.nodes());
    }

    /// Returns the workspace that was lent last on this thread.
    pub(crate) fn return_workspace(&mut self) {
        POOL.with_borrow_mut(|pool| {
            pool.lent -= 1;
            pool.workspaces[pool.lent].exchange(self);
        });
    }

    /// Runs `f` with a workspace of this thread.
    pub(crate) fn with_workspace<R>(&mut self, f: impl FnOnce(&mut Cable) -> R) -> R {
        self.take_workspace();
        let result = f(self);
        self.return_workspace();
        result
    }
}
