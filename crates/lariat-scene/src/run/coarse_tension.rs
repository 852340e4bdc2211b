//! Whether the tension in an equilibrium is off because a cable bends more sharply than its elements can.
//!
//! # Equation
//!
//! A mesh that is smooth at a corner takes more length there than the cable does, `c` in all ([`Cable::sharp_bends`]). Between ends that do
//! not move the tension is too large by
//!
//! ```text
//! EA c/L
//! ```
//!
//! and by less where a shape that sags gives way. Where that much is a tenth of the tension, the equilibrium is found again on a mesh that is
//! fine at these places, and what differs is told.
//!
//! # Validity
//!
//! Of an equilibrium. In motion, positions are told (`coarse_kink`), and `--error tension=..` proves tensions.

use super::World;
use super::fine::refined;
use crate::scene::Purpose;
use crate::warning::Warning;
use lariat_ancf::{Cable, SharpBend};

/// Share of the largest tension of a cable that is told, as of the moments in lariat-ancf. Setting: what users are told.
const SHARE: f64 = 0.1;

/// Returns the warnings about the cables of a world in equilibrium; none where the finer mesh finds none.
pub(super) fn warnings(world: &World, purpose: Purpose) -> Vec<Warning> {
    let cables = world.cables();
    let doubted = |(index, cable): (usize, &&Cable)| {
        let excess: f64 = cable.sharp_bends().iter().map(|bend: &SharpBend| bend.excess).sum();
        let stiffness = world.scene.cables[index].mean_of(|section| section.axial_stiffness);
        stiffness * excess / cable.length() > SHARE * cable.peak_tension().1
    };
    if !cables.iter().enumerate().any(doubted) {
        return Vec::new();
    }
    let scene = refined(world, |_| true);
    let Ok(mut finer) = World::build(&scene) else { return Vec::new() };
    if finer.start(purpose).is_err() {
        return Vec::new();
    }
    let pairs = cables.iter().zip(finer.cables()).enumerate();
    pairs.filter_map(|(index, (cable, finer))| warning(world, index, cable, finer)).collect()
}

/// Returns the warning about a cable of a world, by its largest difference from a finer one amid the elements, if that is large.
fn warning(world: &World, index: usize, cable: &Cable, finer: &Cable) -> Option<Warning> {
    let mut from = 0.0;
    let mut worst = None;
    for element in cable.elements() {
        let at_m = from + 0.5 * element.length;
        from += element.length;
        let [own, fine] = [cable, finer].map(|cable| cable.sample(at_m).ok().map(|sample| sample.tension));
        let (tension_n, fine_n) = own.zip(fine)?;
        if worst.is_none_or(|(_, own, fine): (f64, f64, f64)| (tension_n - fine_n).abs() > (own - fine).abs()) {
            worst = Some((at_m, tension_n, fine_n));
        }
    }
    let (at_m, tension_n, fine_n) = worst?;
    let share = (tension_n - fine_n).abs() / finer.peak_tension().1;
    let whole = world.scene.whole(index);
    (share > SHARE).then(|| Warning::CoarseTension {
        cable: world.scene.cables[whole].name.clone(),
        at_m: world.scene.along(index, at_m),
        tension_n,
        fine_n,
        share,
        elements: world.scene.parts[whole].iter().map(|&part| world.scene.cables[part].elements).sum(),
    })
}
