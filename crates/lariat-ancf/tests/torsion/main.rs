//! Cables with torsion, in statics and in motion, and with all else that a cable has.

mod course;
mod motion;
mod others;
mod plectoneme;
mod reels;
mod statics;
mod stranded;
