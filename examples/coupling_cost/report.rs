//! Rows as Markdown.

use crate::measure::{self, Row};
use crate::peers::Chain;
use crate::rig::{Make, Split};
use crate::scene::Scene;
use crate::{Outcome, SPLITS};
use lariat::{Fidelity, Vector3};
use std::fmt::Write as _;

fn fidelity(fidelity: Fidelity) -> &'static str {
    match fidelity {
        Fidelity::Game => "game",
        Fidelity::Engineering => "engineering",
        Fidelity::Reference => "reference",
    }
}

fn name(make: Make) -> String {
    match make {
        Make::Nothing => "nothing".to_string(),
        Make::Lariat(p) => format!("**Lariat, {}**", fidelity(p)),
        Make::Exact(integrator) => integrator.method.to_string(),
        Make::SoftRope(30.0) => "soft rope, 30 Hz (default)".to_string(),
        Make::SoftRope(frequency) => format!("soft rope, {frequency:.0e} Hz"),
        Make::Capsules(Chain::Impulse) => "10 capsules, impulse joints".to_string(),
        Make::Capsules(Chain::Multibody) => "10 capsules, multibody".to_string(),
    }
}

fn split(Split { steps, iterations }: Split) -> String {
    format!("{steps} x {iterations}")
}

/// A row in short, for the terminal.
pub fn line(r: &Row) -> String {
    format!("{} {}: {:.1} us, stretch {:.4}", name(r.make), split(r.split), r.micros, r.stretch)
}

/// Distances of centres in m.
pub fn distances(a: &[Vector3<f64>; 2], b: &[Vector3<f64>; 2]) -> [f64; 2] {
    [(a[0] - b[0]).norm(), (a[1] - b[1]).norm()]
}

/// An error in m.
fn metres(error: f64) -> String {
    if error >= 0.1 { format!("{error:.2}") } else { format!("{error:.1e}") }
}

fn percent(stretch: f64) -> String {
    let p = 100.0 * stretch;
    if p.abs() >= 1.0 { format!("{p:.1}") } else { format!("{p:.3}") }
}

/// Time of Rapier with the boxes alone, in the same split.
fn rapier_alone(bare: &[Row], split: Split) -> f64 {
    bare.iter().find(|r| r.split == split).map_or(f64::NAN, |r| r.micros)
}

/// What is measured and how.
pub fn head(command: &str, machine: &str) -> String {
    format!(
        "# What a cable on a body costs\n\nMade by `{command}`; do not edit. {machine}\n\n\
         Boxes of rapier3d (`f32`, 0.2 m wide) hang by their top faces on cables of 2 m with a square section of 1 cm; *soft* is \
         E = 1e9 Pa, 4000 kg/m^3, *steel* E = 2e11 Pa, 7850 kg/m^3. The host steps by 1/60 s. *Time* is CPU time per host step on one \
         thread in us: the mean over 2 s, the least of 2 to 25 runs. *Rapier alone* is the time of the same world without \
         cables, *cable* the difference. *Split* is the number of Rapier steps per host step and of solver iterations in each: \
         `1 x 4` is Rapier's default, `4 x 4` Lariat's. *Stretch* is the largest of the polyline from the fixed point through nodes, \
         particles or joints to the point of the box, at the host's steps.\n\n\
         - **Lariat**: 10 elements, `CableSet`, one `AttachmentKind::Ball`.\n\
         - **soft rope**: `SoftBodyBuilder::rope`, 11 particles of the cable's mass, the first pinned, the last attached with \
         `attach_particle`, no collider; once with the default material, once with edges of 1e6 Hz, what Rapier's joints have.\n\
         - **capsules**: 10 rigid links as thick and heavy as the cable, without contacts, with spherical joints: impulse joints or \
         multibody joints. They have no stiffness to choose; what they stretch is the solver's error. Nor can they \
         stretch as the soft cable does: that is part of their error there.\n\n\
         World settings are Rapier's defaults but for the split.\n"
    )
}

/// Time in us that the game fidelity may take, Rapier's four steps included.
const TARGET: f64 = 30.0;

/// Whether the game fidelity in the default split keeps within [`TARGET`].
pub fn target(rows: &[Row]) -> String {
    let game = rows.iter().find(|r| r.make == Make::Lariat(Fidelity::Game) && r.split == SPLITS[2]);
    let time = game.map_or(f64::NAN, |r| r.micros);
    let verdict = if time <= TARGET { "met" } else { "missed" };
    format!(
        "\nTarget for the game fidelity in the default split: {TARGET:.0} us, Rapier included. Measured {time:.1} us: {verdict}.\n"
    )
}

/// A table of swinging boxes.
pub fn swinging(rows: &[Row], bare: &[Row], centres: &[Vector3<f64>; 2]) -> String {
    let mut out = String::from(
        "| cable | split | time us | Rapier alone us | cable us | stretch % | error at 0.5 s m | error at 1 s m |\n\
         |---|---|---:|---:|---:|---:|---:|---:|\n",
    );
    for r in rows {
        let alone = rapier_alone(bare, r.split);
        let off = distances(&r.centres, centres);
        let result = match r.lost {
            None => format!("{} | {} | {}", percent(r.stretch), metres(off[0]), metres(off[1])),
            Some(t) => format!("lost at {t:.2} s | {} | {}", metres(off[0]), metres(off[1])),
        };
        let (time, cable) = (r.micros, r.micros - alone);
        let _ =
            writeln!(out, "| {} | {} | {time:.1} | {alone:.1} | {cable:.1} | {result} |", name(r.make), split(r.split));
    }
    out
}

/// A table of hanging boxes.
pub fn hanging(rows: &[Row], bare: &[Row]) -> String {
    let mut out = String::from(
        "| cable | split | time us | Rapier alone us | cable us | stretch at the end % | largest % |\n|---|---|---:|---:|---:|---:|---:|\n",
    );
    for r in rows {
        let alone = rapier_alone(bare, r.split);
        let result = match r.lost {
            None => format!("{:.4} | {:.4}", 100.0 * r.last, 100.0 * r.stretch),
            Some(t) => format!("lost at {t:.2} s | "),
        };
        let (time, cable) = (r.micros, r.micros - alone);
        let _ =
            writeln!(out, "| {} | {} | {time:.1} | {alone:.1} | {cable:.1} | {result} |", name(r.make), split(r.split));
    }
    out
}

/// A table of many boxes.
pub fn many(rows: &[Row], bare: &[Row], count: usize) -> String {
    let mut out = String::from(
        "| cable | split | time us | Rapier alone us | per cable us | stretch % |\n|---|---|---:|---:|---:|---:|\n",
    );
    for r in rows {
        let alone = rapier_alone(bare, r.split);
        let each = (r.micros - alone) / count as f64;
        let stretch = r.lost.map_or_else(|| percent(r.stretch), |t| format!("lost at {t:.2} s"));
        let _ = writeln!(
            out,
            "| {} | {} | {:.0} | {alone:.1} | {each:.1} | {stretch} |",
            name(r.make),
            split(r.split),
            r.micros
        );
    }
    out
}

/// Counts per host step.
pub fn counts(rows: &[Row]) -> String {
    let mut out = String::from(
        "\nCounts per host step:\n\n| cable | split | steps | rejected | Newton | factorisations | solves | element evaluations | \
         of them with tangent |\n|---|---|---:|---:|---:|---:|---:|---:|---:|\n",
    );
    for (r, d) in rows.iter().filter_map(|r| Some((r, r.counts?))) {
        let counts = [
            d.steps,
            d.rejected_steps,
            d.newton_iterations,
            d.factorisations,
            d.solves,
            d.element_evaluations(),
            d.tangent_evaluations,
        ];
        let counts = counts.map(|n| format!("{:.1}", n as f64 / measure::STEPS as f64)).join(" | ");
        let _ = writeln!(out, "| {} | {} | {counts} |", name(r.make), split(r.split));
    }
    out
}

/// Where the time of the coupling goes.
pub fn shares(scene: &Scene) -> Outcome<String> {
    let mut out = String::from(
        "\nWhere it goes, in us per host step (wall time, the stages called one by one); *the cable alone* is `Cable::step` of the \
         same cable without its box, which moves otherwise. Called one by one, every Rapier step has the whole tolerance of a host \
         step, so *engineering* in four takes less than above:\n\n\
         | cable | split | predict | Rapier | reconcile | the cable alone |\n|---|---|---:|---:|---:|---:|\n",
    );
    for p in [Fidelity::Game, Fidelity::Engineering] {
        let make = Make::Lariat(p);
        let alone = measure::alone(scene, make)?;
        for s in [SPLITS[0], SPLITS[2]] {
            let measure::Shares { predict, rapier, reconcile } = measure::shares(scene, make, s)?;
            writeln!(
                out,
                "| {} | {} | {predict:.1} | {rapier:.1} | {reconcile:.1} | {alone:.1} |",
                name(make),
                split(s)
            )?;
        }
    }
    Ok(out)
}
