//! The effects of a `[[cable]]`: a table each, read into the types of the mechanics.
//!
//! The mechanics' types are the tables. Where the format has a shorter form (a flow by three numbers, a wind by a power law, a
//! rest shape of the whole cable) it is written out before serde reads it.

use super::flow::{self, FLOW};
use super::sections::Sections;
use super::water;
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{
    ANY, ARC_LENGTH, Choose, Default, Key, Kind, NOT_NEGATIVE, POSITIVE, UNIT, VECTOR, choice, share, table,
};
use lariat_ancf::effect::Effect;
use lariat_ancf::{
    AxialLaw, BendingRule, Buoyancy, Contact, Damping, Drag, Effects, EndSpin, GravityScale, LineLoad, LineLoads,
    RestPiece, RestShape, RopeKind, Rule, Section, Torsion, Water, for_each_effect,
};
use toml::Value;

/// What effects need to know of their cable.
pub(super) struct Context<'c> {
    /// Sections.
    pub sections: &'c Sections,
    /// Force strategy.
    pub rule: Rule,
    /// Unstretched length in m.
    pub length: f64,
    /// Water of the scene.
    pub water: Option<&'c Water>,
}

impl Context<'_> {
    /// Returns the section of the cable, for a number at a path that follows from one.
    fn section(&self, doc: &Document<'_>, at: &KeyPath) -> Result<&Section, Error> {
        if self.sections.is_uniform() {
            return Ok(self.sections.first());
        }
        Err(doc.conflict(at, "it follows from one section, and the cable has several: give the numbers"))
    }

    /// Checks that a size at a path is written there, or follows from every section.
    fn given(
        &self,
        doc: &Document<'_>,
        at: &KeyPath,
        written: Option<f64>,
        of: impl Fn(&Section) -> Option<f64>,
    ) -> Result<(), Error> {
        let known = written.is_some() || self.sections.all(|section| of(section).is_some());
        if known { Ok(()) } else { Err(doc.missing(at)) }
    }
}

/// An effect as a scene writes it. Every effect of the list of the mechanics is one.
trait SceneEffect: Effect {
    /// The values of its key.
    const KIND: Kind;
    /// What holds without it.
    const WITHOUT: &'static str;

    /// Writes a shorter form of its value out as the mechanics reads it.
    fn write_out(_doc: &Document<'_>, _at: &KeyPath, _value: &mut Value, _cable: &Context<'_>) -> Result<(), Error> {
        Ok(())
    }

    /// Checks what single values do not show.
    fn check(&self, doc: &Document<'_>, at: &KeyPath, cable: &Context<'_>) -> Result<(), Error>;
}

macro_rules! generate {
    ($({ field: $field:ident, type: $type:ident, set: $set:ident, key: $key:literal, summary: $summary:literal })*) => {
        /// The keys of all effects.
        pub(super) const EFFECTS: &[Key] = &[$(Key {
            name: $key,
            kind: <$type as SceneEffect>::KIND,
            unit: "",
            default: Default::Absent(<$type as SceneEffect>::WITHOUT),
            meaning: $summary,
        }),*];

        /// Reads the effects of the cable at a path from its remaining keys.
        pub(super) fn read(
            doc: &Document<'_>,
            at: &KeyPath,
            mut rows: toml::Table,
            cable: &Context<'_>,
        ) -> Result<Effects, Error> {
            Ok(Effects { $($field: one(doc, &at.key($key), rows.remove($key), cable)?),* })
        }
    };
}

for_each_effect!(generate);

fn one<T: SceneEffect>(
    doc: &Document<'_>,
    at: &KeyPath,
    value: Option<Value>,
    cable: &Context<'_>,
) -> Result<Option<T>, Error> {
    let Some(mut value) = value.filter(|value| value.as_array().is_none_or(|rows| !rows.is_empty())) else {
        return Ok(None);
    };
    T::write_out(doc, at, &mut value, cable)?;
    let effect: T = doc.typed(at, value)?;
    SceneEffect::check(&effect, doc, at, cable)?;
    Ok(Some(effect))
}

table! {
    /// Internal damping after Kelvin and Voigt: stress = E (strain + time x strain rate). By its times, or by the kind of rope.
    struct DampingTable("[cable.damping]") {
        /// Time of the axial strain.
        axial: Option<f64> = ("0"), Kind::Number(NOT_NEGATIVE), "s";
        /// Time of the curvature, 0 with a rule without bending.
        bending: Option<f64> = ("0"), Kind::Number(NOT_NEGATIVE), "s";
        /// Kind of rope, instead of `axial` and `bending`: damps the lowest axial mode of the cable, both ends held, and bending in ten
        /// half waves over its length by 0.1 % of critical (`"parallel-wires"`), 0.32 % (`"spiral-strand"`), 2 % (`"wire-rope"`), 5 %
        /// (`"fibre-rope"`) or 10 % (`"rubber-hose"`). Slower motion is damped less: a heavy load on the rope needs its own `axial`.
        rope: Option<RopeKind> = ("none"), Kind::Choice(|| RopeKind::ALL.map(RopeKind::name).to_vec());
    }
    choose Choose::AtLeastOne(&["axial", "bending", "rope"]);
}

impl SceneEffect for Damping {
    const KIND: Kind = Kind::Table(&DampingTable::TABLE);
    const WITHOUT: &'static str = "off";

    fn write_out(doc: &Document<'_>, at: &KeyPath, value: &mut Value, cable: &Context<'_>) -> Result<(), Error> {
        let DampingTable { axial, bending, rope } = doc.typed(at, value.clone())?;
        let mut damping = Damping { axial: axial.unwrap_or(0.0), bending: bending.unwrap_or(0.0) };
        if let Some(rope) = rope {
            for (key, given) in [("axial", axial), ("bending", bending)] {
                if given.is_some() {
                    return Err(doc.conflict(&at.key(key), "both a kind of rope and times are given"));
                }
            }
            damping = rope
                .damping(cable.section(doc, &at.key("rope"))?, cable.length)
                .map_err(|error| doc.conflict(&at.key("rope"), error.to_string()))?;
            if cable.rule.bending == BendingRule::None {
                damping.bending = 0.0;
            }
        }
        *value = Value::try_from(damping).map_err(|error| doc.conflict(at, error.to_string()))?;
        Ok(())
    }

    fn check(&self, doc: &Document<'_>, at: &KeyPath, cable: &Context<'_>) -> Result<(), Error> {
        if self.bending > 0.0 && cable.rule.bending == BendingRule::None {
            return Err(doc.conflict(&at.key("bending"), format!("rule {} has no bending to damp", cable.rule)));
        }
        Ok(())
    }
}

table! {
    /// Drag of a fluid or wind by Morison's formula.
    keys DRAG for Drag("[cable.drag]") {
        /// Density of the fluid. Without it the cable is in the water of `[water]`, with its current, level and wave.
        fluid_density = ("that of `[water]`; required without one"), Kind::Number(POSITIVE), "kg/m^3";
        /// Normal coefficient on the diameter.
        normal = 1.2, Kind::Number(NOT_NEGATIVE);
        /// Tangential coefficient on the diameter: a coefficient that counts on the circumference, as `CdAx` of MoorDyn, is pi times as much here.
        tangential = 0.01, Kind::Number(NOT_NEGATIVE);
        /// Diameter, required for a cable without `section`. That of a chain is 1.8 times its bar: coefficients that count on the bar, as 2.4 of a
        /// studless chain, want the bar here.
        diameter = ("that of the section"), Kind::Number(POSITIVE), "m";
        /// Velocity of the fluid: the same everywhere and always, or a table.
        flow = ("at rest"), Kind::Either(&[VECTOR, Kind::Table(&FLOW)]), "m/s";
    }
}

impl SceneEffect for Drag {
    const KIND: Kind = Kind::Table(&DRAG);
    const WITHOUT: &'static str = "off";

    fn write_out(doc: &Document<'_>, at: &KeyPath, value: &mut Value, cable: &Context<'_>) -> Result<(), Error> {
        if water::write_into(doc, at, value, cable.water)?
            && let (Some(drag), Some(water)) = (value.as_table_mut(), cable.water)
        {
            if drag.contains_key("flow") {
                return Err(doc.conflict(
                    &at.key("flow"),
                    "the current is that of [water]: give a fluid_density of its own, too",
                ));
            }
            drag.insert("flow".to_string(), water::as_toml(doc, at, &water.flow)?);
            return Ok(());
        }
        value.get_mut("flow").map_or(Ok(()), |flow| flow::write_out(doc, &at.key("flow"), flow))
    }

    fn check(&self, doc: &Document<'_>, at: &KeyPath, cable: &Context<'_>) -> Result<(), Error> {
        cable.given(doc, &at.key("diameter"), self.diameter, |section| section.diameter)
    }
}

table! {
    /// Buoyancy and added mass in a fluid at rest, or in the water of `[water]`: there what is above the level has none, and the wave pushes.
    keys BUOYANCY for Buoyancy("[cable.buoyancy]") {
        /// Density of the fluid.
        fluid_density = ("that of `[water]`; required without one"), Kind::Number(POSITIVE), "kg/m^3";
        /// Coefficient of added mass; 0 for none, as a cable with a reel asks for. It acts along all of the cable, above the level of `[water]`, too.
        added_mass = 1.0, Kind::Number(NOT_NEGATIVE);
        /// Displaced area, required for a cable without `section`.
        area = ("that of the section"), Kind::Number(POSITIVE), "m^2";
    }
    without surface;
}

impl SceneEffect for Buoyancy {
    const KIND: Kind = Kind::Table(&BUOYANCY);
    const WITHOUT: &'static str = "off";

    fn write_out(doc: &Document<'_>, at: &KeyPath, value: &mut Value, cable: &Context<'_>) -> Result<(), Error> {
        if water::write_into(doc, at, value, cable.water)?
            && let Some(surface) = cable.water.and_then(|water| water.flow.surface.as_deref())
            && let Some(buoyancy) = value.as_table_mut()
        {
            buoyancy.insert("surface".to_string(), water::as_toml(doc, at, surface)?);
        }
        Ok(())
    }

    fn check(&self, doc: &Document<'_>, at: &KeyPath, cable: &Context<'_>) -> Result<(), Error> {
        cable.given(doc, &at.key("area"), self.area, |section| section.outer_area)
    }
}

table! {
    /// Stress-free stretch and curvature, of the whole cable or of pieces. The natural curvature has no direction, because an
    /// element without twist knows none: a coil may unwind into any curve of the same curvature, and a cable that is straighter
    /// than its natural curvature may wrinkle. Draw its start shape with many points.
    struct RestShapeTable("[cable.rest_shape]") {
        /// Stress-free stretch of the whole cable: below 1 it pulls at its unstretched length.
        stretch: Option<f64> = ("1"), Kind::Number(POSITIVE);
        /// Stress-free curvature of the whole cable, 0 with a rule without bending; it has no direction.
        curvature: Option<f64> = ("0"), Kind::Number(NOT_NEGATIVE), "1/m";
        /// Pieces, instead of `stretch` and `curvature`.
        piece: Vec<RestPiece> = ("none"), Kind::Tables(&REST_PIECE);
    }
    choose Choose::AtLeastOne(&["stretch", "curvature", "piece"]);
}

table! {
    /// A piece of a rest shape, up to the next piece. An element belongs to the piece in which its middle lies.
    keys REST_PIECE for RestPiece("[[cable.rest_shape.piece]]") {
        /// Arc length of the unstretched cable where the piece begins, or a share of its length, ascending from piece to piece.
        from = required, ARC_LENGTH, "m";
        /// Stress-free stretch.
        stretch = 1.0, Kind::Number(POSITIVE);
        /// Stress-free curvature, 0 with a rule without bending.
        curvature = 0.0, Kind::Number(NOT_NEGATIVE), "1/m";
    }
    choose Choose::AtLeastOne(&["stretch", "curvature"]);
}

impl SceneEffect for RestShape {
    const KIND: Kind = Kind::Table(&RestShapeTable::TABLE);
    const WITHOUT: &'static str = "straight and unstretched";

    fn write_out(doc: &Document<'_>, at: &KeyPath, value: &mut Value, cable: &Context<'_>) -> Result<(), Error> {
        let pieces = value.get_mut("piece").and_then(Value::as_array_mut);
        for piece in pieces.into_iter().flatten().filter_map(Value::as_table_mut) {
            in_metres(piece, &["from"], cable.length);
        }
        let RestShapeTable { stretch, curvature, mut piece } = doc.typed(at, value.clone())?;
        if stretch.is_some() || curvature.is_some() {
            if !piece.is_empty() {
                return Err(doc.conflict(&at.key("piece"), "both pieces and numbers of the whole cable are given"));
            }
            let (stretch, curvature) = (stretch.unwrap_or(1.0), curvature.unwrap_or(0.0));
            piece.push(RestPiece { from: 0.0, stretch, curvature });
        }
        *value = Value::try_from(piece).map_err(|error| doc.conflict(at, error.to_string()))?;
        Ok(())
    }

    fn check(&self, doc: &Document<'_>, at: &KeyPath, cable: &Context<'_>) -> Result<(), Error> {
        let mut before = f64::NEG_INFINITY;
        for (i, piece) in self.pieces.iter().enumerate() {
            let written = at.key("piece").item(i);
            let at = if doc.contains(&written) { &written } else { at };
            if piece.from <= before || piece.from >= cable.length {
                return Err(doc.error(&at.key("from"), Problem::OutOfRange(piece.from)));
            }
            if piece.curvature > 0.0 && cable.rule.bending == BendingRule::None {
                let problem = format!("rule {} has no bending to curve", cable.rule);
                return Err(doc.conflict(&at.key("curvature"), problem));
            }
            before = piece.from;
        }
        Ok(())
    }
}

table! {
    /// A constant force per length of a piece of the cable.
    keys LINE_LOAD for LineLoad("[[cable.line_load]]") {
        /// Arc length of the unstretched cable where it begins, below the length of the cable, or a share of this.
        from = 0.0, ARC_LENGTH, "m";
        /// Arc length where it ends, above `from`, at most the length of the cable, or a share of this.
        to = ("the end of the cable"), ARC_LENGTH, "m";
        /// Force per length of unstretched cable, in world axes.
        force = required, VECTOR, "N/m";
    }
}

/// Writes the shares of a length (m) under some keys in metres.
fn in_metres(table: &mut toml::Table, keys: &[&str], length: f64) {
    for key in keys {
        if let Some(share) = table.get(*key).and_then(Value::as_str).and_then(|text| share(text).ok()) {
            table.insert((*key).to_string(), Value::Float(share * length));
        }
    }
}

impl SceneEffect for LineLoads {
    const KIND: Kind = Kind::Tables(&LINE_LOAD);
    const WITHOUT: &'static str = "none";

    fn write_out(_: &Document<'_>, _: &KeyPath, value: &mut Value, cable: &Context<'_>) -> Result<(), Error> {
        for load in value.as_array_mut().into_iter().flatten().filter_map(Value::as_table_mut) {
            load.entry("to").or_insert(Value::Float(cable.length));
            in_metres(load, &["from", "to"], cable.length);
        }
        Ok(())
    }

    fn check(&self, doc: &Document<'_>, at: &KeyPath, cable: &Context<'_>) -> Result<(), Error> {
        for (i, load) in self.0.iter().enumerate() {
            let at = at.item(i);
            if load.from >= cable.length {
                return Err(doc.error(&at.key("from"), Problem::OutOfRange(load.from)));
            }
            if load.to <= load.from || load.to > cable.length * (1.0 + 1e-12) {
                return Err(doc.error(&at.key("to"), Problem::OutOfRange(load.to)));
            }
        }
        Ok(())
    }
}

table! {
    /// Torsion of an isotropic cable: one torque between two clamps that hold the spin; a ball holds none. By GJ, or by a Poisson number
    /// for a solid round section or a round tube. On bodies and with reels it needs the integrator `discrete-gradient`. An eye that
    /// is clamped holds the spin, and the twist of the cable that is out.
    struct TorsionTable("[cable.torsion]") {
        /// Torsional stiffness GJ.
        stiffness: Option<f64> = ("by `poisson`"), Kind::Number(POSITIVE), "N m^2";
        /// Poisson number nu, up to 0.5, instead of `stiffness`: GJ = EI/(1 + nu).
        poisson: Option<f64> = ("none"), Kind::Number(NOT_NEGATIVE);
        /// Turns by which the cable is twisted as it is built, right-handed positive.
        initial_twist: f64 = 0.0, Kind::Number(ANY);
        /// Time by which the twist is damped: that of a damping ratio z at omega rad/s is 2 z/omega. A hook on a rope with
        /// `torque_per_tension` k gets about GJ/(GJ + EA k^2) of z, and all of it if `axial` of its `damping` is the same time.
        damping: f64 = 0.0, Kind::Number(NOT_NEGATIVE), "s";
        /// Torque per tension while twist is held: `c d` of a stranded rope with the torque factor c and the diameter d, positive for a right-hand lay. EA is then that at held twist.
        torque_per_tension: f64 = 0.0, Kind::Number(ANY), "m";
        /// Whether a clamp at the start holds the spin, does not, or turns it by a motor.
        start: Option<Value> = ("\"held\""), END_SPIN;
        /// The same of a clamp at the end.
        end: Option<Value> = ("\"held\""), END_SPIN;
        /// The same of all clamps between; one that is not held lets the torque through.
        inner: Option<Value> = ("\"held\""), END_SPIN;
    }
    choose Choose::AtLeastOne(&["stiffness", "poisson"]);
}

/// How a clamp holds the spin.
const END_SPIN: Kind = Kind::Either(&[Kind::Choice(|| vec!["held", "swivel"]), Kind::Table(&MotorTable::TABLE)]);

table! {
    /// A motor that turns the spin at a clamp, at a constant rate or by a course.
    struct MotorTable("[cable.torsion.start], [cable.torsion.end] and [cable.torsion.inner]") {
        /// Turns per second, right-handed about the axis in the direction of arc length.
        rate: Option<f64> = ("by `rows`"), Kind::Number(ANY), "1/s";
        /// Time at which it starts, with `rate`.
        from: Option<f64> = ("0"), Kind::Number(ANY), "s";
        /// Time at which it stops and holds, with `rate`.
        until: Option<f64> = ("never"), Kind::Number(ANY), "s";
        /// Instead of `rate` its turns at times. Between rows the rate is continuous (cubics), and zero between equal ones; before the first and behind the last it holds: begin and end with two equal rows to start and stop without a jump of the rate.
        rows: Option<Vec<[f64; 2]>> = ("by `rate`"), Kind::Ascending(&["t", "turns"]), "s, turns";
    }
    choose Choose::AtLeastOne(&["rate", "rows"]);
}

/// Reads a motor.
fn motor(doc: &Document<'_>, at: &KeyPath, written: Value) -> Result<EndSpin, Error> {
    let MotorTable { rate, from, until, rows } = doc.typed(at, written)?;
    let Some(rows) = rows else {
        let (from, until) = (from.unwrap_or(0.0), until.unwrap_or(f64::MAX));
        if until < from {
            return Err(doc.conflict(at, "the motor stops before it starts"));
        }
        return Ok(EndSpin::Motor { rate: rate.unwrap_or_default(), from, until });
    };
    for (key, given) in [("rate", rate.is_some()), ("from", from.is_some()), ("until", until.is_some())] {
        if given {
            return Err(doc.conflict(&at.key(key), format!("both rows and {key} are given")));
        }
    }
    Ok(EndSpin::Course(rows))
}

impl SceneEffect for Torsion {
    const KIND: Kind = Kind::Table(&TorsionTable::TABLE);
    const WITHOUT: &'static str = "off";

    fn write_out(doc: &Document<'_>, at: &KeyPath, value: &mut Value, cable: &Context<'_>) -> Result<(), Error> {
        let table: TorsionTable = doc.typed(at, value.clone())?;
        if table.stiffness.is_some() && table.poisson.is_some() {
            return Err(doc.conflict(&at.key("poisson"), "both a stiffness and a Poisson number are given"));
        }
        let mut torsion = match (table.stiffness, table.poisson) {
            (None, Some(poisson)) => Torsion::round(cable.section(doc, &at.key("poisson"))?.bending_stiffness, poisson)
                .map_err(|error| doc.conflict(&at.key("poisson"), error.to_string()))?,
            (stiffness, _) => Torsion::new(stiffness.unwrap_or_default()),
        };
        (torsion.initial_twist, torsion.damping) = (table.initial_twist, table.damping);
        torsion.torque_per_tension = table.torque_per_tension;
        let spins = [
            ("start", table.start, &mut torsion.start),
            ("end", table.end, &mut torsion.end),
            ("inner", table.inner, &mut torsion.inner),
        ];
        for (key, written, spin) in spins {
            *spin = match written {
                Some(Value::String(text)) if text == "swivel" => EndSpin::Swivel,
                Some(written @ Value::Table(_)) => motor(doc, &at.key(key), written)?,
                _ => EndSpin::Held,
            };
        }
        *value = Value::try_from(torsion).map_err(|error| doc.conflict(at, error.to_string()))?;
        Ok(())
    }

    fn check(&self, doc: &Document<'_>, at: &KeyPath, cable: &Context<'_>) -> Result<(), Error> {
        if cable.rule.bending == BendingRule::None {
            return Err(doc.conflict(at, format!("rule {} has no bending, which a twisted cable needs", cable.rule)));
        }
        Ok(())
    }
}

table! {
    /// Contact and friction with the bodies, and with cables.
    struct ContactTable("[cable.contact]") {
        /// Radius, required for a cable without `section`.
        radius: Option<f64> = ("half the diameter of the section"), Kind::Number(POSITIVE), "m";
        /// Normal force per length and depth.
        stiffness: Option<f64> = ("EA/(40 radius^2)"), Kind::Number(POSITIVE), "N/m^2";
        /// Coefficient of friction of the cable; that of a contact is the mean of both.
        friction: f64 = 0.5, Kind::Number(NOT_NEGATIVE);
        /// Coefficient of restitution of the cable; that of a contact is the mean of both, at most 15/17.
        restitution: f64 = 0.0, Kind::Number(UNIT);
        /// Whether the cable touches itself, and other cables that say so: both of the keys below.
        self_contact: bool = false, Kind::Flag;
        /// Whether the cable touches other cables that say so.
        cables: Option<bool> = ("that of `self_contact`"), Kind::Flag;
        /// Whether the cable touches itself.
        itself: Option<bool> = ("that of `self_contact`"), Kind::Flag;
    }
}

impl ContactTable {
    /// Whether the cable is to touch others.
    fn cables(&self) -> bool {
        self.cables.unwrap_or(self.self_contact)
    }

    /// Whether the cable is to touch itself.
    fn itself(&self) -> bool {
        self.itself.unwrap_or(self.self_contact)
    }
}

/// Returns whether the cable of a row is to touch cables, others or itself.
pub(super) fn touches_cables(doc: &Document<'_>, at: &KeyPath, row: &toml::Table) -> Result<bool, Error> {
    let Some(value) = row.get("contact") else { return Ok(false) };
    let table: ContactTable = doc.typed(at, value.clone())?;
    Ok(table.cables() || table.itself())
}

impl SceneEffect for Contact {
    const KIND: Kind = Kind::Table(&ContactTable::TABLE);
    const WITHOUT: &'static str = "off";

    fn write_out(doc: &Document<'_>, at: &KeyPath, value: &mut Value, _: &Context<'_>) -> Result<(), Error> {
        let table: ContactTable = doc.typed(at, value.clone())?;
        let (cables, itself) = (table.cables(), table.itself());
        let ContactTable { radius, stiffness, friction, restitution, .. } = table;
        *value = Value::try_from(Contact { radius, stiffness, friction, restitution, cables, itself })
            .map_err(|error| doc.conflict(at, error.to_string()))?;
        Ok(())
    }

    fn check(&self, doc: &Document<'_>, at: &KeyPath, cable: &Context<'_>) -> Result<(), Error> {
        cable.given(doc, &at.key("radius"), self.radius, |section| section.diameter)
    }
}

choice! {
    /// Axial laws by name.
    enum LawName {
        /// EA times the Green strain, as without a law: where that is meant.
        Green = "green",
        /// EA times the engineering strain.
        Hooke = "hooke",
        /// The same, without force in compression.
        Rope = "rope",
    }
}

table! {
    /// A measured axial force against engineering strain. It cannot push: below the first row the force is zero, beyond the last it
    /// goes on straight; between the rows it is smooth and does not fall. `axial_stiffness` is its steepest slope or more.
    keys CURVE("[cable.axial_law]") {
        /// Strains and forces, both ascending; the first force is 0.
        curve = required, Kind::Rows(&["strain", "force"], 2), "N";
    }
}

impl SceneEffect for AxialLaw {
    const KIND: Kind = Kind::Either(&[Kind::Choice(LawName::names), Kind::Table(&CURVE)]);
    const WITHOUT: &'static str = "the Green law of the paper; `\"rope\"` of a rope or chain by name";

    fn check(&self, _: &Document<'_>, _: &KeyPath, _: &Context<'_>) -> Result<(), Error> {
        Ok(())
    }
}

impl SceneEffect for GravityScale {
    const KIND: Kind = Kind::Number(ANY);
    const WITHOUT: &'static str = "1";

    fn check(&self, _: &Document<'_>, _: &KeyPath, _: &Context<'_>) -> Result<(), Error> {
        Ok(())
    }
}
