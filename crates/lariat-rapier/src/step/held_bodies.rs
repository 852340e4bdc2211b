//! The bodies that cables are attached to, each once, with its attachments.

use crate::contents::Contents;
use crate::contents::attachment::Attachment;
use crate::step::stiffness::Part;
use rapier::dynamics::RigidBodyHandle;

/// Attachments by body, and buffers of what is asked of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct HeldBodies {
    /// Body and index of each attachment, those of a body one after the other.
    list: Vec<(RigidBodyHandle, usize)>,
    /// The parts of the cables of a body.
    pub(super) parts: Vec<Part>,
}

impl HeldBodies {
    /// Reads the attachments of a set.
    pub fn read(&mut self, contents: &Contents) {
        self.list.clear();
        self.list.extend(contents.attachments.iter().map(|(index, a)| (a.body, index)));
        self.list.sort_unstable_by_key(|(body, index)| (body.into_raw_parts(), *index));
    }

    /// Returns the bodies with their attachments, in the order of these, and the buffer.
    pub(super) fn each<'a>(
        &'a mut self,
        contents: &'a Contents,
    ) -> (
        impl Iterator<Item = (RigidBodyHandle, impl Iterator<Item = &'a Attachment> + Clone)> + Clone,
        &'a mut Vec<Part>,
    ) {
        let of_body = move |of: &'a [(RigidBodyHandle, usize)]| {
            (of[0].0, of.iter().filter_map(move |(_, index)| contents.attachments.get(*index)))
        };
        (self.list.chunk_by(|a, b| a.0 == b.0).map(of_body), &mut self.parts)
    }
}
