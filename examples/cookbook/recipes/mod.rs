//! The recipes of docs/cookbook.md, a file each. The page shows every file up to its `impl Stage`.

mod bridge;
mod corner;
mod crane;
mod cut;
mod edge;
mod flag;
mod grapple;
mod hook;
mod lamp;
mod lamps;
mod leash;
mod mooring;
mod net;
mod pulley;
mod rov;
mod save;
mod seabed;
mod teleport;
mod tow_rope;
mod walked_bridge;
mod zip_line;

use std::error::Error;

pub type Outcome<T> = Result<T, Box<dyn Error>>;

/// A recipe that is built and can be stepped.
pub trait Stage {
    /// Advances by one host step of 1/60 s.
    fn step(&mut self) -> Outcome<()>;

    /// Compares the end of the run with a value known by hand, and returns one line that says so.
    ///
    /// # Errors
    /// If it is off by more than the recipe allows.
    fn check(&mut self) -> Outcome<String>;
}

/// A recipe of the page.
pub struct Recipe {
    /// Name of the file, and of the mark on the page.
    pub name: &'static str,
    /// Cables and elements of each, bodies, and preset, for the table.
    pub cables: &'static str,
    pub bodies: u32,
    pub preset: &'static str,
    /// Host steps of a run.
    pub steps: u32,
    /// What a host step of a game may cost in us: the mean over a run.
    pub budget: u32,
    pub build: fn() -> Outcome<Box<dyn Stage>>,
    /// The file.
    pub source: &'static str,
}

macro_rules! recipe {
    ($name:ident, $stage:ident, $cables:literal, $bodies:literal, $preset:literal, $steps:literal, $budget:literal) => {
        Recipe {
            name: stringify!($name),
            cables: $cables,
            bodies: $bodies,
            preset: $preset,
            steps: $steps,
            budget: $budget,
            build: || Ok(Box::new($name::$stage::new()?)),
            source: include_str!(concat!(stringify!($name), ".rs")),
        }
    };
}

/// All recipes, in the order of the page.
pub const ALL: [Recipe; 21] = [
    recipe!(tow_rope, TowRope, "1 x 10", 2, "generalised-alpha-0, 1/240 s", 300, 1000),
    recipe!(grapple, Grapple, "1 x 10", 1, "game", 120, 500),
    recipe!(bridge, Bridge, "2 x 16", 7, "generalised-alpha-0, 1/240 s", 300, 1000),
    recipe!(walked_bridge, WalkedBridge, "2 x 43", 21, "game", 570, 4000),
    recipe!(lamp, Lamp, "1 x 8", 1, "game", 1200, 200),
    recipe!(hook, Hook, "1 x 4", 1, "game", 900, 200),
    recipe!(cut, Cut, "1 x 12, then 2 x 6", 1, "game", 90, 200),
    recipe!(crane, Crane, "1 x 10", 1, "generalised-alpha-0, 1/240 s", 900, 300),
    recipe!(pulley, Pulley, "1 x 42", 2, "game", 45, 2000),
    recipe!(net, Net, "40 x 4", 1, "game", 360, 3000),
    recipe!(mooring, Mooring, "1 x 30", 0, "engineering, tolerance 1e-4 m", 600, 500),
    recipe!(seabed, Seabed, "1 x 52", 0, "game", 1200, 1000),
    recipe!(rov, Rov, "1 x 15", 1, "game", 4800, 500),
    recipe!(corner, Corner, "1 x 16", 1, "game", 180, 1000),
    recipe!(edge, Edge, "1 x 40", 1, "game", 420, 1000),
    recipe!(zip_line, ZipLine, "2 x 10", 1, "game", 240, 1000),
    recipe!(flag, Flag, "2 x 7", 1, "game", 1200, 500),
    recipe!(lamps, Lamps, "12 x 4", 12, "game", 2400, 500),
    recipe!(leash, Leash, "1 x 10", 1, "game", 900, 200),
    recipe!(teleport, Teleport, "1 x 10", 2, "game", 180, 200),
    recipe!(save, Save, "1 x 10", 1, "game", 300, 300),
];

impl Recipe {
    /// The beginning of its row in the table of costs.
    pub fn row(&self) -> String {
        let Recipe { name, cables, bodies, preset, budget, .. } = self;
        format!("| {} | {cables} | {bodies} | {preset} | {budget} |", name.replace('_', " "))
    }

    /// What the page shows of the file: all but its first comment and its `impl Stage`.
    pub fn shown(&self) -> &'static str {
        let end = self.source.find("impl Stage for").unwrap_or(self.source.len());
        let begin = self.source.find("use ").unwrap_or(0);
        self.source[begin..end].trim_end()
    }
}
