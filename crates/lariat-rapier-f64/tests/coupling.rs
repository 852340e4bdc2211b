//! The tests of lariat-rapier with rapier3d-f64: the same files.

extern crate lariat_rapier_f64 as lariat_rapier;

#[path = "../../lariat-rapier/tests/coupling/bench.rs"]
mod bench;
#[path = "../../lariat-rapier/tests/coupling/changes.rs"]
mod changes;
#[path = "../../lariat-rapier/tests/coupling/clamps.rs"]
mod clamps;
#[path = "../../lariat-rapier/tests/coupling/contact.rs"]
mod contact;
#[path = "../../lariat-rapier/tests/coupling/draw.rs"]
mod draw;
#[path = "../../lariat-rapier/tests/coupling/hanging.rs"]
mod hanging;
#[path = "../../lariat-rapier/tests/coupling/hoist.rs"]
mod hoist;
#[path = "../../lariat-rapier/tests/coupling/joints.rs"]
mod joints;
#[path = "../../lariat-rapier/tests/coupling/many.rs"]
mod many;
#[path = "../../lariat-rapier/tests/coupling/motion.rs"]
mod motion;
#[path = "../../lariat-rapier/tests/coupling/nodes.rs"]
mod nodes;
#[path = "../../lariat-rapier/tests/coupling/payload.rs"]
mod payload;
#[path = "../../lariat-rapier/tests/coupling/replay.rs"]
mod replay;
#[path = "../../lariat-rapier/tests/coupling/sleep.rs"]
mod sleep;
#[path = "../../lariat-rapier/tests/coupling/spinning.rs"]
mod spinning;
#[path = "../../lariat-rapier/tests/coupling/split.rs"]
mod split;
