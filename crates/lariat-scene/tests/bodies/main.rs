//! Scenes with rigid bodies through the command, against values from outside.

mod holds;
mod motion;
mod results;
mod runs;
mod scenes;
mod structures;
