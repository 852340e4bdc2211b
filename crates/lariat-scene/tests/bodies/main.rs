//! Scenes with rigid bodies, run by the command, against independent values.

mod contacts;
mod holds;
mod joined_statics;
mod laid_over;
mod motion;
mod passed;
mod results;
mod runs;
mod scenes;
mod statics;
mod structures;
