//! Lariat for Python: the extension module `lariat_cables._lariat` of the wheel `lariat-cables`.
//!
//! | file | what it holds |
//! |---|---|
//! | `cable` | `Cable`: built, stepped, read, changed |
//! | `section`, `integrator` | what a cable is made of, how it is stepped |
//! | `cosimulation` | `CoSimulation`: a cable on bodies that another program moves |
//! | `world` | `World`: rapier3d with cables on its bodies |
//! | `scene` | runs of scene files and sweeps over them |
//! | `film` | the pages of what a program steps itself |
//! | `convert`, `error`, `shared`, `saved` | arguments, exceptions, objects that several threads use, objects as bytes |
//!
//! What needs no Rust (exceptions, results as named tuples, effects, tables) is in `python/lariat_cables`.
//!
//! No method holds a lock while it touches Python, and every method that computes releases the interpreter: two threads that use one
//! object wait for each other, and cannot deadlock.

mod cable;
mod convert;
mod cosimulation;
mod error;
mod film;
mod integrator;
mod quaternion;
mod saved;
mod scene;
mod section;
mod shared;
mod told;
mod world;

/// The extension module.
#[pyo3::pymodule]
mod _lariat {
    #[pymodule_export]
    use crate::cable::{Cable, states, step_all, step_together};
    #[pymodule_export]
    use crate::cosimulation::CoSimulation;
    #[pymodule_export]
    use crate::film::Film;
    #[pymodule_export]
    use crate::integrator::{Integrator, integrators, recommended_elements, rope_kinds};
    #[pymodule_export]
    use crate::scene::{
        Recorded, Stop, import_mjcf, run_command, run_scene, save_file, save_files, scene_keys, scene_rules,
        sweep_append, sweep_check, sweep_done, sweep_local, sweep_row, sweep_run, sweep_table, to_toml,
    };
    #[pymodule_export]
    use crate::section::Section;
    #[pymodule_export]
    use crate::world::{World, load_scene};

    /// The version of the wheel.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
