//! The examples of Lariat that need more than the mechanics are the example targets of this
//! package. The code on the pages of the repository is compiled and run as its documentation tests,
//! because all crates are at hand here.

/// Runs the code of a page.
#[cfg(doctest)]
macro_rules! page {
    ($name:ident, $path:literal) => {
        #[doc = include_str!($path)]
        struct $name;
    };
}

#[cfg(doctest)]
mod pages {
    page!(Readme, "../../../README.md");
    page!(Modes, "../../../docs/modes.md");
    page!(OwnSets, "../../../docs/own_sets.md");
    page!(Theory, "../../../docs/theory.md");
    page!(Ancf, "../../lariat-ancf/README.md");
    page!(Rapier, "../../lariat-rapier/README.md");
    page!(RapierF64, "../../lariat-rapier-f64/README.md");
    page!(Bevy, "../../lariat-bevy/README.md");
    page!(Scene, "../../lariat-scene/README.md");
}
