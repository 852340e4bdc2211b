//! The families of hard cases.

/// A family of hard cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Family {
    /// Loads from a hundredth to a hundred thousand times the mass of their cable.
    MassRatio,
    /// Soft and stiff, thick and thin cables with few and many elements.
    Stiffness,
    /// Slack ropes that become taut.
    Snatch,
    /// Whips and spinning cables.
    Whip,
    /// Ends pushed together, rods that buckle, folds.
    Compression,
    /// Nodes that coincide, slopes of zero, inverted elements.
    Collapse,
    /// No bending stiffness, no tension, no gravity; then all at once.
    ZeroBending,
    /// Wedged bodies and sudden release.
    Jam,
    /// Changes that a user makes to a running world.
    Changes,
    /// Runs of ten minutes and an hour, sleep.
    Long,
    /// Far from the origin, tiny and huge.
    Scale,
    /// Many cables, many bodies, loops.
    Many,
    /// Joints, motors, limits, CCD, locked axes, kinematic bodies.
    Mechanisms,
    /// Reels and drums.
    Reels,
    /// Random combinations of the above.
    Random,
}

impl Family {
    /// All families.
    pub const ALL: [Family; 15] = [
        Family::MassRatio,
        Family::Stiffness,
        Family::Snatch,
        Family::Whip,
        Family::Compression,
        Family::Collapse,
        Family::ZeroBending,
        Family::Jam,
        Family::Changes,
        Family::Long,
        Family::Scale,
        Family::Many,
        Family::Mechanisms,
        Family::Reels,
        Family::Random,
    ];

    /// Returns the name in tables and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Family::MassRatio => "mass-ratio",
            Family::Stiffness => "stiffness",
            Family::Snatch => "snatch",
            Family::Whip => "whip",
            Family::Compression => "compression",
            Family::Collapse => "collapse",
            Family::ZeroBending => "zero-bending",
            Family::Jam => "jam",
            Family::Changes => "changes",
            Family::Long => "long",
            Family::Scale => "scale",
            Family::Many => "many",
            Family::Mechanisms => "mechanisms",
            Family::Reels => "reels",
            Family::Random => "random",
        }
    }
}

impl std::str::FromStr for Family {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let names = || Family::ALL.map(Family::name).join(", ");
        Family::ALL.into_iter().find(|f| f.name() == text).ok_or_else(|| format!("{text:?}; accepted: {}", names()))
    }
}
