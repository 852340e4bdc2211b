//! Scenes with rigid bodies through the command, against values from outside.

mod bench;
mod holds;
mod motion;
mod runs;
mod scenes;
mod structures;
