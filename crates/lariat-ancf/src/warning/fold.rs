//! The order of warnings, and which of them are consequences of another one.
//!
//! A warning of a cause explains those of its symptoms at the same cable: they are folded into it
//! and not told by themselves. The table `CAUSES` says which, with the physics of it; a cause
//! never explains what is of an earlier [level](super::Level) than itself, nor what came before it
//! in time. Two warnings of one sign at one cable are one: the first in the order of levels is
//! told. Warnings of one kind about several cables are one line, that of the worst.
//!
//! # Alternatives considered
//!
//! Silence for symptoms: what a program looks for would be gone. Folded ones stay in the lists of
//! warnings, with what explains them.

pub use super::level::{Judged, Sign};

/// What each cause explains, and why.
const CAUSES: [(Sign, &[Sign]); 10] = [
    // stiffness, mass and radius go with powers of a size in another unit, and strains, frequencies
    // and bends with them
    (Sign::Sizes, &[Sign::Strain, Sign::Steps, Sign::Mesh, Sign::Depth, Sign::EnergyLost]),
    // a jump of the velocity has all frequencies: no step and no element resolves it, and what
    // integration damps is lost
    (Sign::Shock, &[Sign::Steps, Sign::Mesh, Sign::EnergyLost]),
    // contact pushes out what starts inside, with any force, and bends it sharply
    (Sign::Inside, &[Sign::Depth, Sign::Steps, Sign::Mesh, Sign::EnergyLost]),
    // the strain at a corner is set free at once, as a jump of the velocity is
    (Sign::Corner, &[Sign::Steps, Sign::Mesh, Sign::EnergyLost]),
    // what is put elsewhere, or starts elsewhere, is pulled to its place within steps, at any
    // speed, by work that no account has
    (Sign::Gap, &[Sign::Strain, Sign::EnergyMade, Sign::Steps, Sign::Mesh, Sign::EnergyLost]),
    // steps that do not resolve the motion make it, and it goes into the shortest waves, which no
    // mesh resolves
    (Sign::EnergyMade, &[Sign::Steps, Sign::Mesh, Sign::EnergyLost]),
    // a cable goes through where mesh and steps do not resolve the contact: one remedy
    (Sign::Crossing, &[Sign::Steps, Sign::Mesh, Sign::Depth]),
    // twist is lost where an element turns too far: one remedy
    (Sign::Twist, &[Sign::Mesh]),
    // what a method damps grows with the frequency of the motion times the step: one remedy
    (Sign::Steps, &[Sign::EnergyLost]),
    // between its points of contact a cable sags with the square of the element length
    (Sign::Mesh, &[Sign::Depth]),
];

/// Sorts warnings by level; those of one level keep their order.
pub fn sort<T: Judged>(warnings: &mut [T]) {
    warnings.sort_by_key(Judged::level);
}

/// Returns whether a cause of a sign explains a warning of the same cable.
pub fn explains<T: Judged>(cause: Sign, symptom: &T) -> bool {
    let of = |sign: Sign| CAUSES.iter().any(|(own, symptoms)| *own == cause && symptoms.contains(&sign));
    symptom.sign().is_some_and(of)
}

/// Returns for each of some sorted warnings which one explains it. `subject` names the cable that
/// a warning is about; one about everything, `None`, explains and is explained by those of any.
/// What is not `told` explains nothing.
pub fn explained<T: Judged, S: PartialEq>(
    warnings: &[T],
    subject: impl Fn(&T) -> Option<S>,
    told: impl Fn(&T) -> bool,
) -> Vec<Option<usize>> {
    let follows = |cause: &T, symptom: &T, earlier: bool| {
        let (Some(a), Some(b)) = (cause.sign(), symptom.sign()) else { return false };
        if a == b {
            return earlier && !cause.same_kind(symptom);
        }
        let before = match (cause.time(), symptom.time()) {
            (Some(cause), Some(symptom)) => cause <= symptom,
            _ => true,
        };
        explains(a, symptom) && before && cause.level() <= symptom.level()
    };
    let of_one = |a: &T, b: &T| match (subject(a), subject(b)) {
        (Some(a), Some(b)) => a == b,
        _ => true,
    };
    let of = |(s, symptom): (usize, &T)| {
        let mut causes = warnings.iter().enumerate().filter(|(c, cause)| *c != s && told(cause));
        causes.find(|(c, cause)| of_one(cause, symptom) && follows(cause, symptom, *c < s)).map(|(c, _)| c)
    };
    warnings.iter().enumerate().map(of).collect()
}

/// Returns what to tell of some sorted warnings, up to a level: a line for each kind that nothing
/// explains, with the text of the worst.
pub fn lines<T: Judged, S: PartialEq>(
    warnings: &[T],
    subject: impl Fn(&T) -> Option<S>,
    told: impl Fn(&T) -> bool,
) -> Vec<String> {
    let explained = explained(warnings, subject, &told);
    let mut kinds: Vec<(&T, usize)> = Vec::new();
    for (warning, _) in warnings.iter().zip(explained).filter(|(w, cause)| cause.is_none() && told(w)) {
        match kinds.iter_mut().find(|(other, _)| other.same_kind(warning)) {
            Some((worst, count)) => {
                *count += 1;
                if warning.severity() > worst.severity() {
                    *worst = warning;
                }
            }
            None => kinds.push((warning, 1)),
        }
    }
    let line = |(worst, count): (&T, usize)| match count {
        1 => worst.to_string(),
        _ => format!("{count} times, the worst: {worst}"),
    };
    kinds.into_iter().map(line).collect()
}
