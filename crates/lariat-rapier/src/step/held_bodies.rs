//! The bodies that cables are attached to, each once, with its attachments.

use crate::contents::Contents;
use crate::contents::attachment::Attachment;
use crate::step::stiffness::{self, Part, length_and_compliance};
use rapier::dynamics::RigidBodyHandle;

/// Attachments by body, and what is asked of their cables.
#[derive(Clone, Debug, Default)]
pub(crate) struct HeldBodies {
    /// Body and index of each attachment, those of a body one after the other.
    list: Vec<(RigidBodyHandle, usize)>,
    /// By node of all cables, length in m and compliance in m/N of the elements before it, and by
    /// index of a cable where its own begin.
    sums: Vec<[f64; 2]>,
    starts: Vec<usize>,
    /// The parts of the cables of a body: a buffer.
    parts: Vec<Part>,
}

impl HeldBodies {
    /// Reads the attachments of a set and their cables.
    pub fn read(&mut self, contents: &Contents) {
        self.list.clear();
        self.list.extend(contents.attachments.iter().map(|(index, a)| (a.body, index)));
        self.list.sort_unstable_by_key(|(body, index)| (body.into_raw_parts(), *index));
        self.sums.clear();
        self.starts.clear();
        for (index, slot) in contents.cables.iter() {
            self.starts.resize(index + 1, self.sums.len());
            let mut sum = [0.0; 2];
            self.sums.push(sum);
            for own in slot.cable.elements().iter().map(length_and_compliance) {
                sum = [sum[0] + own[0], sum[1] + own[1]];
                self.sums.push(sum);
            }
        }
    }

    /// Returns the bodies, each once.
    pub fn bodies(&self) -> impl Iterator<Item = RigidBodyHandle> {
        self.list.chunk_by(|a, b| a.0 == b.0).map(|of| of[0].0)
    }

    /// Calls `f` with each body, its attachments in their order, and the parts of its cables.
    pub(super) fn for_each(&mut self, contents: &Contents, mut f: impl FnMut(RigidBodyHandle, &OfBody<'_>)) {
        let HeldBodies { list, sums, starts, parts } = self;
        for of in list.chunk_by(|a, b| a.0 == b.0) {
            let attachments = || of.iter().filter_map(|(_, index)| contents.attachments.get(*index));
            parts.clear();
            for a in attachments() {
                if let Some(slot) = contents.slot(a.cable) {
                    let own = &sums[starts[a.cable.0 as usize]..];
                    let between = |a: usize, b: usize| [0, 1].map(|x| own[b][x] - own[a][x]);
                    parts.extend(stiffness::parts(&slot.cable, a, between));
                }
            }
            f(of[0].0, &OfBody { contents, list: of, parts });
        }
    }
}

/// The attachments of a body.
pub(super) struct OfBody<'a> {
    contents: &'a Contents,
    list: &'a [(RigidBodyHandle, usize)],
    /// The parts of its cables.
    pub parts: &'a [Part],
}

impl OfBody<'_> {
    /// Returns the attachments.
    pub fn attachments(&self) -> impl Iterator<Item = &Attachment> {
        self.list.iter().filter_map(|(_, index)| self.contents.attachments.get(*index))
    }
}
