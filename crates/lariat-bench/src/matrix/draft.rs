//! The drawing of a small scene, to which features are added one after the other.
//!
//! A rope of 1.2 m and 0.12 kg, drawn level from the origin, with 0.25 kg at its end where a body
//! asks for it. Axial waves are resolved by steps of 1/240 s, so that a finer run shows what
//! features do, not what the step leaves out. What touches itself is drawn as a coil. It falls, whips and
//! snaps taut, and without damping such waves are not resolved: its positions are 4 to 7 % off those of
//! dt/8 *without contact*, and 0.2 to 0.8 % with damping of five steps. So it has that damping, and what
//! differs is what contact does.

use super::feature::Feature;
use lariat_ancf::{
    AxialLaw, Buoyancy, Contact, Damping, Drag, Effects, Fidelity, Flow, GravityScale, Integrator, LineLoad, PointLoad,
    Reel, RestShape, Section, Strength, Surface, Torsion, Vector3, Water, Wave,
};

/// Length of the rope in m.
pub const LENGTH: f64 = 1.2;
/// Radius of contact in m.
pub const RADIUS: f64 = 0.01;
/// How long a cable acts before it is cut, in s.
pub const CUT: f64 = 0.2;
/// Radius of the coil that touches itself, in m.
const COIL: f64 = 0.1;
/// Height of a turn of it in m.
const PITCH: f64 = 0.06;
/// Damping of the coil in s: five steps of 1/240 s.
const COIL_DAMPING: f64 = 5.0 / 240.0;

/// What holds an end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hold {
    /// Nothing.
    Free,
    /// The world.
    World,
    /// The world, and the direction.
    Clamp,
    /// A prescribed motion.
    Motion,
    /// A body.
    Body(Kind),
}

/// The kind of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// It does not move.
    Fixed,
    /// It moves as it is told.
    Kinematic,
    /// It turns on a curved path.
    Turning,
    /// It moves freely.
    Dynamic,
    /// It turns on a hinge, an impulse joint.
    Impulse,
    /// It turns on a hinge, a multibody joint.
    Multibody,
}

/// What winds cable at an end.
#[derive(Clone, Debug)]
pub enum Wound {
    /// A reel.
    Reel(Reel),
    /// A drum that is a body.
    Drum,
}

/// Something that the cable can touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Thing {
    /// A fixed floor under the rope.
    Floor,
    /// A kinematic box that rises.
    Moving,
    /// A dynamic ball that falls.
    Loose,
    /// Another cable across.
    Cable,
}

/// A drawing.
#[derive(Clone, Debug)]
pub struct Draft {
    /// Where the rope begins, in m.
    pub origin: Vector3<f64>,
    /// Whether nothing holds it and there is no gravity.
    pub floats: bool,
    /// Whether it is a coil.
    pub coil: bool,
    /// Whether it hangs straight down, and what it can touch is beside it, at rest.
    pub hangs: bool,
    /// Whether it is to be in equilibrium: what could only turn is locked.
    pub rests: bool,
    /// When what acts begins to act, in s.
    pub from: f64,
    /// What holds the start.
    pub start: Hold,
    /// What holds the end.
    pub end: Hold,
    /// A body in the middle, beside the one at the end.
    pub middle: Option<Kind>,
    /// Whether what holds the start, and the end, also holds its direction.
    pub clamps: [bool; 2],
    /// Whether it runs over a sheave in its middle.
    pub sheave: bool,
    /// Whether the wheel of that has friction and inertia.
    pub heavy: bool,
    /// Whether another cable is tied to it.
    pub tied: bool,
    /// Whether it has a kink.
    pub kink: bool,
    /// What winds cable at the start and at the end.
    pub wound: [Option<Wound>; 2],
    /// Its effects.
    pub effects: Effects,
    /// Whether a force per length of a program acts.
    pub force_density: bool,
    /// Point loads.
    pub loads: Vec<PointLoad>,
    /// What it withstands, if not all.
    pub strength: Option<Strength>,
    /// Whether it is cut.
    pub cut: bool,
    /// Water that its free bodies are in.
    pub water: Option<Water>,
    /// Added mass of these bodies along their axes, as shares of what they displace.
    pub added_mass: [f64; 3],
    /// What it can touch.
    pub things: Vec<Thing>,
    /// Its fidelity; that of the set without.
    pub fidelity: Option<Fidelity>,
    /// Its number of elements.
    pub elements: usize,
}

impl Draft {
    /// Returns the drawing of some features.
    pub fn of(features: &[Feature], floats: bool) -> Draft {
        let coil = features.contains(&Feature::TouchesItself);
        let damping = coil.then_some(Damping { axial: COIL_DAMPING, bending: COIL_DAMPING });
        let mut draft = Draft {
            origin: Vector3::zeros(),
            floats,
            coil,
            hangs: false,
            rests: features.contains(&Feature::Statics),
            from: 0.0,
            start: Hold::Free,
            end: Hold::Free,
            middle: None,
            clamps: [false; 2],
            sheave: false,
            heavy: false,
            tied: false,
            kink: false,
            wound: [None, None],
            effects: Effects { damping, ..Effects::default() },
            force_density: false,
            loads: Vec::new(),
            strength: None,
            cut: false,
            water: None,
            added_mass: [0.5; 3],
            things: Vec::new(),
            fidelity: None,
            elements: elements(features),
        };
        features.iter().for_each(|feature| draft.add(*feature));
        if draft.start == Hold::Free && !floats {
            draft.start = Hold::World;
        }
        // cable is wound at a point that does not move freely
        if draft.wound[1].is_some() && draft.end == Hold::Free {
            draft.end = Hold::World;
        }
        draft
    }

    /// Returns whether it has something that only the discrete gradient steps.
    pub fn needs_discrete_gradient(&self) -> bool {
        let slips = |wound: &Wound| match wound {
            Wound::Reel(reel) => reel.max_force.is_some(),
            Wound::Drum => true,
        };
        let wound = self.wound.iter().flatten().any(slips);
        self.sheave || wound || self.effects.need_discrete_gradient()
    }

    /// Adds a feature.
    fn add(&mut self, feature: Feature) {
        let effects = &mut self.effects;
        match feature {
            Feature::Held => self.hold(Hold::World),
            Feature::Clamped => self.hold(Hold::Clamp),
            Feature::Prescribed => self.hold(Hold::Motion),
            Feature::FixedBody => self.hold(Hold::Body(Kind::Fixed)),
            Feature::KinematicBody => self.hold(Hold::Body(Kind::Kinematic)),
            Feature::TurningPath => self.hold(Hold::Body(Kind::Turning)),
            Feature::DynamicBody => self.carry(Kind::Dynamic),
            Feature::ClampedBody => {
                self.carry(Kind::Dynamic);
                self.clamps[1] = true;
            }
            Feature::ImpulseJoint => self.carry(Kind::Impulse),
            Feature::MultibodyJoint => self.carry(Kind::Multibody),
            Feature::TouchesFloor => self.touch(Some(Thing::Floor)),
            Feature::TouchesMoving => self.touch(Some(Thing::Moving)),
            Feature::TouchesLoose => self.touch(Some(Thing::Loose)),
            Feature::TouchesItself => self.touch(None),
            Feature::TouchesCable => self.touch(Some(Thing::Cable)),
            Feature::ReelByRate => self.wind(Wound::Reel(Reel { rate: vec![[0.0, 0.4]], ..Reel::default() })),
            // what slips has no equilibrium
            Feature::ReelByForce => {
                let max_force = Some(if self.rests { 5.0 } else { 1.5 });
                let motor = Reel { rate: vec![[0.0, -0.4]], max_force, inertia: 0.1, ..Reel::default() };
                self.wind(Wound::Reel(motor));
            }
            Feature::ReelBrake => {
                self.wind(Wound::Reel(Reel { inertia: 0.05, ..Reel::brake(if self.rests { 5.0 } else { 0.5 }) }))
            }
            Feature::FreeSpool => self.wind(Wound::Reel(Reel { inertia: 0.2, ..Reel::free_spool() })),
            Feature::Sheave => self.sheave = true,
            Feature::HeavySheave => (self.sheave, self.heavy) = (true, true),
            Feature::Junction => self.tied = true,
            Feature::Kink => self.kink = true,
            Feature::Drum => self.wind(Wound::Drum),
            Feature::AxialDamping => effects.damping.get_or_insert(Damping { axial: 0.0, bending: 0.0 }).axial = 2e-3,
            Feature::BendingDamping => {
                effects.damping.get_or_insert(Damping { axial: 0.0, bending: 0.0 }).bending = 0.02;
            }
            Feature::Drag => set_drag(effects, Vector3::zeros()),
            Feature::Current => set_drag(effects, Vector3::new(0.3, 0.0, 0.4)),
            Feature::Buoyancy => {
                let mut buoyancy = Buoyancy::new(100.0, 1.0);
                buoyancy.area = Some(4e-4);
                effects.buoyancy = Some(buoyancy);
            }
            Feature::Torsion => {
                // half of the torque at which a straight rope that nothing pulls kinks, 2.861 pi EI/L (Greenhill 1883)
                effects.torsion = Some(Torsion { initial_twist: 0.715, damping: 0.2, ..Torsion::new(1e-3) });
                self.clamp_both();
            }
            Feature::Stranded => {
                effects.torsion = Some(Torsion { damping: 1.0, ..Torsion::stranded(1e-3, 0.1, 0.02) });
                self.clamp_both();
            }
            Feature::Water => self.immerse(water()),
            Feature::AddedMass => {
                self.added_mass = [0.2, 0.9, 0.5];
                self.immerse(water());
            }
            Feature::Wave => self.immerse(waving()),
            Feature::RestShape => effects.rest_shape = Some(RestShape::curved(2.0)),
            Feature::GravityScale => effects.gravity_scale = Some(GravityScale(0.8)),
            Feature::LineLoad => effects.line_loads = Some(LineLoad::uniform(Vector3::new(0.0, 0.0, 0.3)).into()),
            Feature::ForceDensity => self.force_density = true,
            Feature::PointLoad => self.loads.push(PointLoad::force(0.8, Vector3::new(0.0, -0.3, 0.5))),
            Feature::LoadHistory => self.loads.push(varying(0.0)),
            Feature::HookeLaw => effects.axial_law = Some(AxialLaw::Hooke),
            Feature::RopeLaw => effects.axial_law = Some(AxialLaw::Rope),
            Feature::CurveLaw => {
                effects.axial_law = Some(AxialLaw::Curve(vec![[0.0, 0.0], [0.01, 1.0], [0.02, 3.0], [0.03, 5.0]]));
            }
            Feature::Break => self.strength = Some(Strength::tension(0.6)),
            Feature::Cut => self.cut = true,
            Feature::Game => self.fidelity = Some(Fidelity::Game),
            Feature::Engineering => self.fidelity = Some(Fidelity::Engineering),
            Feature::Adaptive => self.fidelity = Some(Fidelity::Custom(Integrator::ADAPTIVE)),
            // statics are known from the start
            Feature::Statics | Feature::Snapshot | Feature::Sleep | Feature::ErrorTarget => {}
        }
    }

    /// Holds the start, or the end if that is held.
    fn hold(&mut self, hold: Hold) {
        if self.start == Hold::Free { self.start = hold } else { self.end = hold }
    }

    /// Puts a body on the end, or into the middle if one is there.
    fn carry(&mut self, kind: Kind) {
        if self.end == Hold::Free { self.end = Hold::Body(kind) } else { self.middle = Some(kind) }
    }

    /// Puts the rope and its free bodies into water, and such a body on the rope.
    fn immerse(&mut self, water: Water) {
        self.effects.drag = Some(Drag { diameter: Some(0.02), ..water.drag(1.2, 0.02) });
        self.water = Some(water);
        self.carry(Kind::Dynamic);
    }

    /// Clamps what holds both ends, and puts a body on an end that nothing holds: one clamp bears no torque.
    fn clamp_both(&mut self) {
        self.clamps = [true; 2];
        if self.end == Hold::Free {
            self.end = Hold::Body(Kind::Dynamic);
        }
    }

    /// Winds cable at the start, or at the end if it is wound at the start.
    fn wind(&mut self, mut wound: Wound) {
        let second = self.wound[0].is_some();
        // the other end may be on a body that moves, whose mass changes with what is out
        if let Wound::Reel(reel) = &mut wound
            && second
        {
            reel.stock = Some(9.0);
        }
        self.wound[usize::from(second)] = Some(wound);
    }

    /// Lets the cable touch something, or itself.
    fn touch(&mut self, thing: Option<Thing>) {
        let contact = self.effects.contact.get_or_insert_with(|| Contact::with_friction(0.3).with_radius(RADIUS));
        contact.itself |= thing.is_none();
        contact.cables |= thing == Some(Thing::Cable);
        self.things.extend(thing);
    }

    /// Returns the drawn points, from the start.
    pub fn points(&self) -> Vec<Vector3<f64>> {
        let at = |x: f64, y: f64, z: f64| self.origin + Vector3::new(x, y, z);
        if self.hangs {
            return vec![at(0.0, 0.0, 0.0), at(0.0, -LENGTH, 0.0)];
        }
        if !self.coil {
            return vec![at(0.0, 0.0, 0.0), at(LENGTH, 0.0, 0.0)];
        }
        let per_turn = (COIL * COIL + (PITCH / std::f64::consts::TAU).powi(2)).sqrt() * std::f64::consts::TAU;
        let turns = LENGTH / per_turn;
        let turn = |k: usize| std::f64::consts::TAU * turns * k as f64 / 64.0;
        (0..=64)
            .map(|k| (turn(k), PITCH * turns * k as f64 / 64.0))
            .map(|(angle, y)| at(COIL * angle.sin(), y, COIL * (1.0 - angle.cos())))
            .collect()
    }

    /// Returns the point of the drawing at a share of its length.
    pub fn point(&self, share: f64) -> Vector3<f64> {
        let points = self.points();
        let x = share * (points.len() - 1) as f64;
        let k = (x as usize).min(points.len() - 2);
        points[k] + (points[k + 1] - points[k]) * (x - k as f64)
    }

    /// Returns the section of the rope.
    pub fn section() -> Section {
        Section::from_stiffness(400.0, 1e-3, 0.1).expect("a section")
    }
}

/// Returns the elements of a scene: more for a coil, and for statics, which look for contacts at
/// samples.
fn elements(features: &[Feature]) -> usize {
    match features {
        _ if features.contains(&Feature::TouchesItself) => 16,
        _ if features.contains(&Feature::Statics) => 16,
        _ => 6,
    }
}

/// Returns water with a level at the drawing, which is a little above the middle of its bodies, and a
/// current.
pub fn water() -> Water {
    let surface = Surface::at(0.01, Vector3::new(0.0, -9.81, 0.0));
    Water::new(300.0).with_flow(Flow::uniform(Vector3::new(0.3, 0.0, 0.4)).with_surface(surface))
}

/// Returns such water with a wave on it.
pub fn waving() -> Water {
    let mut water = water();
    let wave = Wave::deep(0.03, 1.0, Vector3::new(1.0, 0.0, 0.5));
    water.flow.surface.iter_mut().for_each(|surface| surface.wave = Some(wave));
    water
}

/// Returns a force that grows, turns round and fades from a time (s) on; its corners are at host
/// times.
pub fn varying(start: f64) -> PointLoad {
    let rows = [[0.0, 0.0], [0.1, 1.0], [0.3, -0.8], [0.5, 0.2], [0.6, 0.0]];
    PointLoad::force(0.7, Vector3::new(0.0, 0.3, 0.6)).with_history(rows.map(|[time, factor]| [start + time, factor]))
}

/// Sets drag in a fluid of 100 kg/m^3, 2 cm thick, that flows within a fifth of a second.
fn set_drag(effects: &mut Effects, velocity: Vector3<f64>) {
    let mut flow = Flow::uniform(velocity);
    if velocity != Vector3::zeros() {
        flow = flow.with_history([[0.0, 0.0], [0.2, 1.0]]);
    }
    let mut drag = Drag::new(100.0, 1.2, 0.02, flow);
    drag.diameter = Some(0.02);
    effects.drag = Some(drag);
}
