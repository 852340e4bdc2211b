//! A cable as it is serialised: its description and state; the rest is derived.

use super::{Cable, Snapshot};
use crate::diagnostics::Diagnostics;
use crate::error::Error;
use crate::integrate::Integrator;
use crate::model::Model;
use crate::watch::{Passage, Watch};
use serde::{Deserialize, Serialize};

/// A cable as it is serialised.
#[derive(Clone, Serialize, Deserialize)]
#[serde(rename = "Cable")]
pub(super) struct Saved {
    model: Model,
    snapshot: Snapshot,
    integrator: Integrator,
    #[serde(default)]
    default_integrator: bool,
    diagnostics: Diagnostics,
    #[serde(default)]
    revision: u64,
    #[serde(default)]
    watch: Option<Box<Watch>>,
    #[serde(default)]
    passage: Option<Box<Passage>>,
}

impl From<Cable> for Saved {
    fn from(cable: Cable) -> Self {
        let Cable { model, snapshot, integrator, default_integrator, diagnostics, revision, watch, passage, .. } =
            cable;
        Saved { model, snapshot, integrator, default_integrator, diagnostics, revision, watch, passage }
    }
}

impl TryFrom<Saved> for Cable {
    type Error = Error;
    fn try_from(saved: Saved) -> Result<Self, Error> {
        let mut cable = Cable::from_parts(saved.model, saved.snapshot, saved.integrator)?;
        cable.default_integrator = saved.default_integrator;
        cable.diagnostics = saved.diagnostics;
        cable.revision = saved.revision;
        cable.watch = saved.watch;
        cable.passage = saved.passage;
        Ok(cable)
    }
}
