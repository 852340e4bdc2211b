//! The features whose pairs are run.
//!
//! The list is checked against the lists of the code: each effect ([`EffectWork::by_key`]) and each
//! term of a step ([`lariat_ancf::island::terms`]) is that of some feature, and so is each axial law
//! and each kind of reel. A new one without a feature fails a test.
//!
//! [`EffectWork::by_key`]: lariat_ancf::EffectWork::by_key

/// Something that a cable can have, that holds it, or that is done with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Feature {
    /// An end that the world holds.
    Held,
    /// An end whose direction the world holds, too.
    Clamped,
    /// An end whose motion is prescribed.
    Prescribed,
    /// An end on a fixed body.
    FixedBody,
    /// An end on a kinematic body that moves.
    KinematicBody,
    /// A free dynamic body.
    DynamicBody,
    /// A body on an impulse joint.
    ImpulseJoint,
    /// A body on a multibody joint.
    MultibodyJoint,
    /// Contact with a fixed floor.
    TouchesFloor,
    /// Contact with a kinematic body that moves.
    TouchesMoving,
    /// Contact with a loose dynamic body.
    TouchesLoose,
    /// Contact with itself.
    TouchesItself,
    /// Contact with another cable.
    TouchesCable,
    /// A reel whose rate is given.
    ReelByRate,
    /// A reel with a motor of limited force.
    ReelByForce,
    /// A reel that is a brake.
    ReelBrake,
    /// A reel that turns freely.
    FreeSpool,
    /// A sheave between two cables.
    Sheave,
    /// A drum that is a body.
    Drum,
    /// Damping of strain.
    AxialDamping,
    /// Damping of curvature.
    BendingDamping,
    /// Drag in a fluid at rest.
    Drag,
    /// Drag in a current that grows.
    Current,
    /// Buoyancy and added mass.
    Buoyancy,
    /// A rest shape.
    RestShape,
    /// Torsion, twisted as built, between clamps.
    Torsion,
    /// Gravity scaled for one cable.
    GravityScale,
    /// A line load.
    LineLoad,
    /// A force per length of a program.
    ForceDensity,
    /// A point load.
    PointLoad,
    /// Hooke's law.
    HookeLaw,
    /// A law that cannot push.
    RopeLaw,
    /// A measured law.
    CurveLaw,
    /// A cable that breaks.
    Break,
    /// A cable that is cut while it moves.
    Cut,
    /// A start in equilibrium.
    Statics,
    /// A state that is saved and read back in the middle.
    Snapshot,
    /// Sleep.
    Sleep,
    /// A run to a given error.
    ErrorTarget,
    /// Fidelity game.
    Game,
    /// Fidelity engineering.
    Engineering,
}

use Feature::*;

impl Feature {
    /// All features.
    pub const ALL: [Feature; 41] = [
        Held,
        Clamped,
        Prescribed,
        FixedBody,
        KinematicBody,
        DynamicBody,
        ImpulseJoint,
        MultibodyJoint,
        TouchesFloor,
        TouchesMoving,
        TouchesLoose,
        TouchesItself,
        TouchesCable,
        ReelByRate,
        ReelByForce,
        ReelBrake,
        FreeSpool,
        Sheave,
        Drum,
        AxialDamping,
        BendingDamping,
        Drag,
        Current,
        Buoyancy,
        RestShape,
        Torsion,
        GravityScale,
        LineLoad,
        ForceDensity,
        PointLoad,
        HookeLaw,
        RopeLaw,
        CurveLaw,
        Break,
        Cut,
        Statics,
        Snapshot,
        Sleep,
        ErrorTarget,
        Game,
        Engineering,
    ];

    /// Returns the name in tables and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Held => "held end",
            Clamped => "clamped end",
            Prescribed => "prescribed end",
            FixedBody => "fixed body",
            KinematicBody => "kinematic body",
            DynamicBody => "dynamic body",
            ImpulseJoint => "body on an impulse joint",
            MultibodyJoint => "body on a multibody joint",
            TouchesFloor => "contact with a floor",
            TouchesMoving => "contact with a moving body",
            TouchesLoose => "contact with a loose body",
            TouchesItself => "contact with itself",
            TouchesCable => "contact with a cable",
            ReelByRate => "reel by rate",
            ReelByForce => "reel by force",
            ReelBrake => "brake",
            FreeSpool => "free spool",
            Sheave => "sheave",
            Drum => "drum",
            AxialDamping => "axial damping",
            BendingDamping => "bending damping",
            Drag => "drag",
            Current => "current that grows",
            Buoyancy => "buoyancy",
            RestShape => "rest shape",
            Torsion => "torsion",
            GravityScale => "scaled gravity",
            LineLoad => "line load",
            ForceDensity => "force density",
            PointLoad => "point load",
            HookeLaw => "Hooke's law",
            RopeLaw => "rope law",
            CurveLaw => "measured law",
            Break => "break",
            Cut => "cut",
            Statics => "statics",
            Snapshot => "snapshot",
            Sleep => "sleep",
            ErrorTarget => "given error",
            Game => "game",
            Engineering => "engineering",
        }
    }

    /// Returns the key of the effect that it is, as the mechanics lists it.
    pub fn effect(self) -> Option<&'static str> {
        Some(match self {
            TouchesFloor | TouchesMoving | TouchesLoose | TouchesItself | TouchesCable => "contact",
            AxialDamping | BendingDamping => "damping",
            Drag | Current => "drag",
            Buoyancy => "buoyancy",
            RestShape => "rest_shape",
            Torsion => "torsion",
            GravityScale => "gravity_scale",
            LineLoad => "line_load",
            ForceDensity => "force_density",
            HookeLaw | RopeLaw | CurveLaw => "axial_law",
            _ => return None,
        })
    }

    /// Returns the term of a step that it brings, as the mechanics lists it.
    pub fn term(self) -> &'static str {
        match self {
            FixedBody | KinematicBody => "pins",
            DynamicBody | ImpulseJoint | MultibodyJoint => "bodies",
            ReelByRate | ReelByForce | ReelBrake | FreeSpool | Sheave | Drum => "reels",
            Torsion => "torsion",
            feature if feature.is_contact() => "contacts",
            _ => "cables",
        }
    }

    /// Whether it is a contact.
    pub fn is_contact(self) -> bool {
        self.effect() == Some("contact")
    }

    /// Whether it holds an end in place or direction.
    pub fn is_support(self) -> bool {
        matches!(self, Held | Clamped | Prescribed | FixedBody | KinematicBody)
    }

    /// Whether it is a body that cables move.
    pub fn is_body(self) -> bool {
        matches!(self, DynamicBody | ImpulseJoint | MultibodyJoint)
    }

    /// Whether it winds cable at an end.
    pub fn is_reel(self) -> bool {
        matches!(self, ReelByRate | ReelByForce | ReelBrake | FreeSpool | Drum)
    }

    /// Whether it is something that is done with a scene, and adds nothing to it.
    pub fn is_procedure(self) -> bool {
        matches!(self, Statics | Snapshot | Sleep | ErrorTarget | Game | Engineering)
    }

    /// Whether a system that has it, and no more, keeps its momentum: nothing acts from outside.
    pub fn keeps_momentum(self) -> bool {
        let internal = matches!(self, DynamicBody | TouchesLoose | TouchesItself | TouchesCable | Break | Cut);
        let own = matches!(self, AxialDamping | BendingDamping | RestShape | Torsion | HookeLaw | RopeLaw | CurveLaw);
        internal || own || matches!(self, Snapshot | Game | Engineering)
    }

    /// Whether a cable in equilibrium that has it rests for ever.
    pub fn rests(self) -> bool {
        let moves = matches!(self, Prescribed | KinematicBody | TouchesMoving | Current | ForceDensity);
        let falls = matches!(self, TouchesLoose | Cut | Break);
        !(moves || falls || self.is_reel())
    }
}

impl std::str::FromStr for Feature {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let names = || Feature::ALL.map(Feature::name).join(", ");
        Feature::ALL.into_iter().find(|f| f.name() == text).ok_or_else(|| format!("{text:?}; accepted: {}", names()))
    }
}

/// Two features, the first before the second in the list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Pair(pub Feature, pub Feature);

impl Pair {
    /// Returns all pairs of different features.
    pub fn all() -> Vec<Pair> {
        let of = |(i, a): (usize, Feature)| Feature::ALL.into_iter().skip(i + 1).map(move |b| Pair(a, b));
        Feature::ALL.into_iter().enumerate().flat_map(of).collect()
    }

    /// Both features.
    pub fn both(self) -> [Feature; 2] {
        [self.0, self.1]
    }

    /// Whether it has a feature.
    pub fn has(self, feature: Feature) -> bool {
        self.both().contains(&feature)
    }

    /// Returns the feature beside one that it has.
    pub fn beside(self, feature: Feature) -> Option<Feature> {
        match self {
            Pair(a, b) if a == feature => Some(b),
            Pair(a, b) if b == feature => Some(a),
            _ => None,
        }
    }
}

impl std::fmt::Display for Pair {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} + {}", self.0.name(), self.1.name())
    }
}
