//! The names that warnings and errors have for what a user sets, in the interface that the user
//! writes.
//!
//! Their texts name them as Rust does, in backticks: `elements(24)`. The table `NAMES`
//! says how scenes, Python and Bevy write each, and [`Interface::text`] puts that in their place: a
//! text is written once. The handles of Rapier in errors are written as Python does, too; Bevy has
//! entities in their place.
//!
//! # Alternatives considered
//!
//! A text by interface for each warning: they would part. Names that no interface has: none could
//! be copied into a program.

use core::fmt;

/// What a user writes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Interface {
    /// Programs in Rust, as the texts of warnings are by themselves.
    #[default]
    Rust,
    /// Scene files.
    Scene,
    /// Programs in Python.
    Python,
    /// Components and resources of Bevy.
    Bevy,
}

/// By the name in Rust, without arguments, those of scenes, of Python and of Bevy: `{0}` is the
/// first argument.
const NAMES: [(&str, [&str; 3]); 21] = [
    ("elements", ["elements = {0}", "elements={0}", "elements({0})"]),
    (
        "elements.finest",
        [
            "elements = { count = {0}, finest = {1}, at = {2} }",
            "elements={0}, finest={1}, finest_at={2}",
            "elements({0}).finest({1}, {2})",
        ],
    ),
    ("Fidelity::Game", ["fidelity = \"game\"", "fidelity=\"game\"", "Fidelity::Game"]),
    (
        "StepControl::MaxStep",
        ["integrator.max_step = {0}", "Integrator(max_step={0})", "lariat_ancf::StepControl::MaxStep({0})"],
    ),
    (
        "StepControl::Tolerance",
        ["integrator.tolerance", "Integrator(tolerance=...)", "lariat_ancf::StepControl::Tolerance"],
    ),
    ("GravityScale", ["gravity_scale = {0}", "GravityScale({0})", "GravityScale::new({0})"]),
    ("Contact", ["contact", "lariat.Contact", "Contact"]),
    ("Contact::stiffness", ["contact.stiffness", "Contact(stiffness=...)", "lariat_ancf::Contact::stiffness"]),
    ("AxialLaw::Hooke", ["axial_law = \"hooke\"", "AxialLaw(\"hooke\")", "AxialLaw::hooke()"]),
    ("AxialLaw::Green", ["axial_law = \"green\"", "AxialLaw(\"green\")", "AxialLaw::green()"]),
    (
        "CableBuilder::damped_as",
        ["damping = { rope = \"wire-rope\" }", "Cable(damped_as=...)", "Damping::critical_fraction"],
    ),
    ("Strength", ["break", "set_strength", "BreakTension"]),
    ("CableSet::add_kink", ["kinks", "World.add_kink", "KinkAlong"]),
    ("CableSet::move_bodies", ["a motion without jumps", "World.move_bodies", "Cables::move_bodies"]),
    ("equilibrium_among", ["initial = \"equilibrium\"", "World.equilibrium", "Cables::equilibrium"]),
    ("CableBuilder::node_at", ["a node there", "Cable(nodes_at=[...])", "Cable::node_at"]),
    ("Gap", ["gap", "gap=...", "Gap"]),
    ("Obstacle::moving", ["the velocity of its body", "Obstacle(velocity=...)", "a kinematic body"]),
    ("Reel::max_force", ["reel.max_force", "Reel(max_force=...)", "Reel::max_force"]),
    ("Island::step", ["a scene with bodies", "World.step", "CableStep"]),
    ("Settings::rapier_steps", ["dt", "World(rapier_steps=...)", "Settings::rapier_steps"]),
];

/// By what Rust writes for a point of a cable, what scenes, Python and Bevy do.
const POINTS: [(&str, [&str; 3]); 5] = [
    ("At::Start", ["\"start\"", "\"start\"", "At::Start"]),
    ("At::End", ["\"end\"", "\"end\"", "At::End"]),
    ("At::ArcLength(", ["", "", "At::ArcLength("]),
    ("At::Node(", ["node ", "", "At::Node("]),
    (")", ["", "", ")"]),
];

impl Interface {
    /// Returns the text of a warning or of an error with the names of this interface.
    pub fn text(self, told: &impl fmt::Display) -> String {
        let text = told.to_string();
        let column = match self {
            Interface::Rust => return text,
            Interface::Scene => 0,
            Interface::Python => 1,
            Interface::Bevy => 2,
        };
        let text = if self == Interface::Python { as_python_writes(&text) } else { text };
        let mut rest = text.as_str();
        let mut translated = String::new();
        while let Some((before, after)) = rest.split_once('`') {
            translated.push_str(before);
            translated.push('`');
            // a name that a user gave a cable may have such marks, too
            let name = after.split_once('`').and_then(|(code, end)| Some((translate(code, column)?, end)));
            rest = match name {
                Some((name, end)) => {
                    translated.push_str(&name);
                    translated.push('`');
                    end
                }
                None => after,
            };
        }
        translated + rest
    }
}

/// Returns the name and the arguments of what Rust writes: those of calls in a row are one list.
fn parts(code: &str) -> (String, Vec<String>) {
    let (mut name, mut arguments, mut depth) = (String::new(), Vec::new(), 0);
    for c in code.chars() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            _ => {}
        }
        match (c, depth) {
            ('(', 1) => arguments.push(String::new()),
            (',', 1) => arguments.push(String::new()),
            (')', 0) => {}
            (_, 0) => name.push(c),
            _ => arguments.last_mut().into_iter().for_each(|last: &mut String| last.push(c)),
        }
    }
    (name, arguments.into_iter().map(|argument| argument.trim().to_string()).collect())
}

/// Returns a text in which the handles of Rapier are those of Python, `RigidBodyHandle(index=0,
/// generation=0)`.
fn as_python_writes(text: &str) -> String {
    let mut parts = text.split("(Index { index: ");
    let mut written = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let handle = part.split_once(" })").and_then(|(inner, rest)| Some((inner.split_once(", generation: ")?, rest)));
        written += &match handle {
            Some(((index, generation), rest)) => format!("(index={index}, generation={generation}){rest}"),
            None => format!("(Index {{ index: {part}"),
        };
    }
    written
}

/// Returns what a column of the table has for what Rust writes.
fn translate(code: &str, column: usize) -> Option<String> {
    let (name, arguments) = parts(code);
    let (_, names) = NAMES.iter().find(|(own, _)| *own == name)?;
    let mut text = names[column].to_string();
    for (k, argument) in arguments.iter().enumerate() {
        let argument = POINTS.iter().fold(argument.clone(), |text, (own, others)| text.replace(own, others[column]));
        text = text.replace(&format!("{{{k}}}"), &argument);
    }
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::at::At;
    use crate::warning::{AdvisedMesh, Warning, less_energy};

    /// The names in the texts of a file, which stand in backticks outside of comments.
    fn names(source: &str) -> Vec<String> {
        let code = source.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
        code.split('`').skip(1).step_by(2).map(|span| parts(span).0).collect()
    }

    #[test]
    fn every_name_of_a_text_is_in_the_table() {
        let own = names(include_str!("mod.rs"));
        assert!(own.len() > 8, "{own:?}");
        for name in own.iter().filter(|name| *name != "{enough}") {
            assert!(NAMES.iter().any(|(known, _)| known == name), "{name}");
        }
        // names of scenes are in scenes alone
        assert!(!include_str!("mod.rs").contains("elements = {") && !include_str!("mod.rs").contains("[cable"));
    }

    /// Errors have few names in backticks; those of rules of the mechanics are the same everywhere.
    #[test]
    fn every_name_of_an_error_is_in_the_table() {
        let texts = [include_str!("../error/mod.rs"), include_str!("../error/failure.rs")];
        let own: Vec<String> = texts.into_iter().flat_map(names).collect();
        assert!(own.len() > 3, "{own:?}");
        for name in own.iter().filter(|name| !["projected", "exact", "mean"].contains(&name.as_str())) {
            assert!(NAMES.iter().any(|(known, _)| known == name), "{name}");
        }
    }

    #[test]
    fn handles_are_written_as_python_does() {
        let text = "no body RigidBodyHandle(Index { index: 3, generation: 1 }) in this world, nor `Gap`";
        let wanted = "no body RigidBodyHandle(index=3, generation=1) in this world, nor `gap=...`";
        assert_eq!(Interface::Python.text(&text), wanted);
        assert_eq!(Interface::Python.text(&"Index { index: 3"), "Index { index: 3");
        assert_eq!(Interface::Python.text(&"a(Index { index: 3"), "a(Index { index: 3");
    }

    #[test]
    fn each_interface_has_its_own_names() {
        let cable = String::from("a ` in its name");
        let coarse = Warning::CoarseMesh { cable: cable.clone(), error_m: 0.1, elements: 3, enough: 7 };
        for (interface, wanted) in [
            (Interface::Rust, "`elements(7)`"),
            (Interface::Scene, "`elements = 7`"),
            (Interface::Python, "`elements=7`"),
            (Interface::Bevy, "`elements(7)`"),
        ] {
            let text = interface.text(&coarse);
            assert!(text.ends_with(wanted) && text.matches('`').count() == 5, "{text}");
        }
        let at = vec![At::Start, At::ArcLength(1.5), At::Node(3)];
        let mesh = AdvisedMesh { elements: 20, finest_m: Some(0.01), at };
        let mesh = format!("try `{mesh}`");
        assert_eq!(mesh, "try `elements(20).finest(0.01, [At::Start, At::ArcLength(1.5), At::Node(3)])`");
        let wanted = "try `elements = { count = 20, finest = 0.01, at = [\"start\", 1.5, node 3] }`";
        assert_eq!(Interface::Scene.text(&mesh), wanted);
        let wanted = "try `elements=20, finest=0.01, finest_at=[\"start\", 1.5, 3]`";
        assert_eq!(Interface::Python.text(&mesh), wanted);
        assert!(Interface::Scene.text(&less_energy(false)).contains("`fidelity = \"game\"`"));
    }
}
