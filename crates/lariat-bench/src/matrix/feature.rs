//! The features whose pairs are run.
//!
//! The list is checked against the lists of the code: each effect ([`EffectWork::by_key`]) and each
//! term of a step ([`lariat_ancf::island::terms`]) is that of some feature, and so is each axial
//! law and each kind of reel. A new one without a feature fails a test.
//!
//! [`EffectWork::by_key`]: lariat_ancf::EffectWork::by_key

/// Makes the features of a list: what each is, and its name in tables and on the command line.
macro_rules! features {
    ($($(#[$what:meta])* $feature:ident = $name:literal,)*) => {
        /// Something that a cable can have, that holds it, or that is done with it.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Feature {
            $($(#[$what])* $feature,)*
        }

        impl Feature {
            /// All features.
            pub const ALL: [Feature; [$($name),*].len()] = [$(Feature::$feature),*];

            /// Returns the name in tables and on the command line.
            pub fn name(self) -> &'static str {
                match self {
                    $(Feature::$feature => $name,)*
                }
            }
        }
    };
}

features! {
    /// An end that the world holds.
    Held = "held end",
    /// An end whose direction the world holds, too.
    Clamped = "clamped end",
    /// An end whose motion is prescribed.
    Prescribed = "prescribed end",
    /// An end on a fixed body.
    FixedBody = "fixed body",
    /// An end on a kinematic body that moves.
    KinematicBody = "kinematic body",
    /// An end on a kinematic body that turns on a curved path.
    TurningPath = "path that turns",
    /// A free dynamic body.
    DynamicBody = "dynamic body",
    /// A dynamic body that holds the direction of an end, too.
    ClampedBody = "clamp on a body",
    /// A body on an impulse joint.
    ImpulseJoint = "body on an impulse joint",
    /// A body on a multibody joint.
    MultibodyJoint = "body on a multibody joint",
    /// Another cable tied to a point between its ends.
    Junction = "junction",
    /// A point between its ends at which its slope is free.
    Kink = "kink",
    /// Contact with a fixed floor.
    TouchesFloor = "contact with a floor",
    /// Contact with a kinematic body that moves.
    TouchesMoving = "contact with a moving body",
    /// Contact with a loose dynamic body.
    TouchesLoose = "contact with a loose body",
    /// Contact with itself.
    TouchesItself = "contact with itself",
    /// Contact with another cable.
    TouchesCable = "contact with a cable",
    /// A reel whose rate is given.
    ReelByRate = "reel by rate",
    /// A reel with a motor of limited force.
    ReelByForce = "reel by force",
    /// A reel that is a brake.
    ReelBrake = "brake",
    /// A reel that turns freely.
    FreeSpool = "free spool",
    /// A sheave between two cables.
    Sheave = "sheave",
    /// A sheave whose wheel has friction and inertia.
    HeavySheave = "sheave with friction",
    /// A drum that is a body.
    Drum = "drum",
    /// Damping of strain.
    AxialDamping = "axial damping",
    /// Damping of curvature.
    BendingDamping = "bending damping",
    /// Drag in a fluid at rest.
    Drag = "drag",
    /// Drag in a current that grows.
    Current = "current that grows",
    /// Buoyancy and added mass.
    Buoyancy = "buoyancy",
    /// Water with a level and a current, a cable and a body in it.
    Water = "water",
    /// Water whose added mass is another along each axis of a body.
    AddedMass = "added mass by axes",
    /// Water with a wave.
    Wave = "wave",
    /// A rest shape.
    RestShape = "rest shape",
    /// Torsion, twisted as built, between clamps.
    Torsion = "torsion",
    /// Torsion of a stranded rope, whose tension makes a torque.
    Stranded = "stranded torsion",
    /// Gravity scaled for one cable.
    GravityScale = "scaled gravity",
    /// A line load.
    LineLoad = "line load",
    /// A force per length of a program.
    ForceDensity = "force density",
    /// A point load.
    PointLoad = "point load",
    /// A point load with a history.
    LoadHistory = "load that varies",
    /// Hooke's law.
    HookeLaw = "Hooke's law",
    /// A law that cannot push.
    RopeLaw = "rope law",
    /// A measured law.
    CurveLaw = "measured law",
    /// A cable that breaks.
    Break = "break",
    /// A cable that is cut while it moves.
    Cut = "cut",
    /// A start in equilibrium.
    Statics = "statics",
    /// A state that is saved and read back in the middle.
    Snapshot = "snapshot",
    /// Sleep.
    Sleep = "sleep",
    /// A run to a given error.
    ErrorTarget = "given error",
    /// Fidelity game.
    Game = "game",
    /// Fidelity engineering.
    Engineering = "engineering",
    /// Steps of the discrete gradient by its own estimate.
    Adaptive = "adaptive steps",
}

use Feature::*;

impl Feature {
    /// Returns the key of the effect that it is, as the mechanics lists it.
    pub fn effect(self) -> Option<&'static str> {
        Some(match self {
            TouchesFloor | TouchesMoving | TouchesLoose | TouchesItself | TouchesCable => "contact",
            AxialDamping | BendingDamping => "damping",
            Drag | Current | Water | AddedMass | Wave => "drag",
            Buoyancy => "buoyancy",
            RestShape => "rest_shape",
            Torsion | Stranded => "torsion",
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
            FixedBody | KinematicBody | TurningPath | Junction | Kink => "pins",
            DynamicBody | ClampedBody | ImpulseJoint | MultibodyJoint => "bodies",
            feature if feature.is_water() => "bodies",
            ReelByRate | ReelByForce | ReelBrake | FreeSpool | Sheave | HeavySheave | Drum => "reels",
            Torsion | Stranded => "torsion",
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
        matches!(self, Held | Clamped | Prescribed | FixedBody | KinematicBody | TurningPath)
    }

    /// Whether it is water that bodies are in.
    pub fn is_water(self) -> bool {
        matches!(self, Water | AddedMass | Wave)
    }

    /// Whether it winds cable at an end.
    pub fn is_reel(self) -> bool {
        matches!(self, ReelByRate | ReelByForce | ReelBrake | FreeSpool | Drum)
    }

    /// Whether it is something that is done with a scene, and adds nothing to it.
    pub fn is_procedure(self) -> bool {
        matches!(self, Statics | Snapshot | Sleep | ErrorTarget | Game | Engineering | Adaptive)
    }

    /// Whether a system that has it, and no more, keeps its momentum: nothing acts from outside.
    pub fn keeps_momentum(self) -> bool {
        let internal = matches!(
            self,
            DynamicBody | ClampedBody | Junction | Kink | TouchesLoose | TouchesItself | TouchesCable | Break | Cut
        );
        let own = matches!(
            self,
            AxialDamping | BendingDamping | RestShape | Torsion | Stranded | HookeLaw | RopeLaw | CurveLaw
        );
        internal || own || matches!(self, Snapshot | Game | Engineering | Adaptive)
    }

    /// Whether a cable in equilibrium that has it rests for ever.
    pub fn rests(self) -> bool {
        let moves = matches!(
            self,
            Prescribed | KinematicBody | TurningPath | TouchesMoving | Current | Wave | ForceDensity | LoadHistory
        );
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
