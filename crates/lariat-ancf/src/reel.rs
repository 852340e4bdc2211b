//! Reels as their users describe them, and the mesh that they wind up.

use crate::element::side::Side;
use crate::error::{Error, require};
use crate::scales::reel::{ARRIVED, SHORTFALL};
use crate::section::Element;
use serde::{Deserialize, Serialize};

/// A reel as its user describes it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Reel {
    /// Rate in m/s by time in s, ascending: positive pays out; a rate holds until the next row.
    /// What is asked for when a host step begins is reached at its end, linearly, if `acceleration`
    /// lets it, with any method; a row within it counts from the next host step on, or earlier.
    /// Default: no rows, at rest.
    pub rate: Vec<[f64; 2]>,
    /// Length of cable in m that is out when the reel stops: it comes there with the rates of the
    /// table, whatever their sign, and within the acceleration. Not at a sheave or a drum. Default:
    /// none, the rates are followed.
    pub to_length: Option<f64>,
    /// Largest acceleration of the rate in m/s^2. Default 2: a jump of the rate by dv is one of the
    /// tension by dv sqrt(EA rho A). What a table asks for in less time than that takes is not paid
    /// out, which the warning `slow_reel` tells. With `max_force` it is that of the rate that the
    /// motor is commanded; a reel that slipped returns to it as fast as the force lets it.
    pub acceleration: f64,
    /// Largest length of cable in m that can be out: the reel stops there, as softly as
    /// `acceleration` says. One that slips, a free spool or a brake, runs on to the end and stops
    /// at once, whatever `max_force` is: the stretch of the rope alone brakes what hangs on it. On
    /// a body that moves freely, what is not out rides with it, so it must be given there. Default:
    /// no limit.
    pub stock: Option<f64>,
    /// Largest force of the motor in N: a clutch between the reel and a shaft that turns at the
    /// commanded rate. The reel slips where the cable pulls more, and is pulled back by this force
    /// until it follows the shaft again; with a rate of zero a brake; 0 is a free spool. What it is
    /// commanded changes by `acceleration`, so that a brake that is to act by its force alone needs
    /// a large one. A force
    /// that is lowered falls linearly over the next host step, from what the motor pulls. Needs the
    /// integrator `discrete-gradient`. Default: as strong as it must be.
    pub max_force: Option<f64>,
    /// Inertia of the wheel over the square of its radius in kg; the stock on a drum is added, if
    /// `stock` says how much. It counts where the reel slips. Default 0.
    pub inertia: f64,
    /// How material comes to the eye. Default: from a drum.
    pub feed: Feed,
}

/// How material comes to the eye of a reel while cable is paid out: the same rope falls at
/// different speeds from each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Feed {
    /// From a drum that turns with the rate.
    #[default]
    Drum,
    /// From a coil that lies still, picked up inelastically: `m g = d(m v)/dt` for a falling chain.
    Coil,
    /// From a bag in which it lies still, without loss.
    Bag,
    /// From another cable, over a [`Sheave`](crate::island::Sheave) of the island that steps both.
    /// Rate and force are those of the sheave; `stock` is not used.
    Sheave,
    /// From a [`Drum`](crate::island::Drum) of the island, a body whose spin is the rate; `stock`
    /// and `inertia` are what it carries beside its own inertia.
    BodyDrum,
}

impl Default for Reel {
    fn default() -> Self {
        Reel {
            rate: Vec::new(),
            to_length: None,
            acceleration: 2.0,
            stock: None,
            max_force: None,
            inertia: 0.0,
            feed: Feed::Drum,
        }
    }
}

impl Reel {
    /// A reel with a constant rate in m/s.
    pub fn with_rate(rate: f64) -> Self {
        Reel { rate: vec![[f64::MIN, rate]], ..Self::default() }
    }

    /// A reel that comes to a length of cable (m) that is out, with at most a rate (m/s), and stops
    /// there. It speeds up and slows down with its acceleration, 2 m/s^2 unless that is set, and so
    /// does not come to the rate on ways that are shorter than rate^2/acceleration.
    pub fn to_length(length: f64, rate: f64) -> Self {
        Reel { to_length: Some(length), ..Self::with_rate(rate) }
    }

    /// A reel that turns freely: no motor, no brake.
    pub fn free_spool() -> Self {
        Reel { max_force: Some(0.0), ..Self::default() }
    }

    /// A brake that slips above a force in N.
    pub fn brake(force: f64) -> Self {
        Reel { max_force: Some(force), ..Self::default() }
    }

    /// The end of a cable at a sheave.
    pub fn over_sheave() -> Self {
        Reel { feed: Feed::Sheave, ..Self::default() }
    }

    /// The end of a cable at a drum that is a body.
    pub fn on_drum() -> Self {
        Reel { feed: Feed::BodyDrum, ..Self::default() }
    }

    /// Returns whether the rate is an unknown.
    pub(crate) fn has_law(&self) -> bool {
        self.max_force.is_some() || self.needs_island()
    }

    /// Returns whether its rate is that of a sheave or a drum of an island.
    pub fn needs_island(&self) -> bool {
        matches!(self.feed, Feed::Sheave | Feed::BodyDrum)
    }

    /// Refuses numbers that make no reel.
    pub(crate) fn check(&self) -> Result<(), Error> {
        require("acceleration of a reel (m/s^2)", self.acceleration, self.acceleration > 0.0, "> 0")?;
        if let Some(length) = self.to_length {
            require("length that a reel comes to (m)", length, length > 0.0, "> 0")?;
            let own = u8::from(!self.needs_island());
            require("lengths that a sheave or drum may come to", 1.0, own == 1, "0: material runs as it is pulled")?;
        }
        if let Some(stock) = self.stock {
            require("stock of a reel (m)", stock, stock > 0.0, "> 0")?;
        }
        let force = self.max_force.unwrap_or(0.0);
        require("largest force of a reel (N)", force, force >= 0.0, ">= 0")?;
        require("inertia of a reel (kg)", self.inertia, self.inertia >= 0.0, ">= 0")?;
        if self.feed == Feed::BodyDrum {
            let own = self.rate.len() + usize::from(self.max_force.is_some());
            require("rates and largest forces of a reel on a drum", own as f64, own == 0, "0: torque its body")?;
        }
        let mut before = f64::NEG_INFINITY;
        for &[time, rate] in &self.rate {
            require("rate of a reel (m/s)", rate, true, "a number")?;
            require("time of a rate of a reel (s)", time, time > before, "ascending")?;
            before = time;
        }
        Ok(())
    }

    /// Returns the rate in m/s that is asked for at a time in s; `way` is how much in m the length
    /// that it is to come to is ahead, if there is one.
    pub(crate) fn asked(&self, time: f64, way: Option<f64>) -> f64 {
        let rows = self.rate.partition_point(|row| row[0] <= time);
        let rate = if rows == 0 { 0.0 } else { self.rate[rows - 1][1] };
        way.map_or(rate, |way| if way.abs() > ARRIVED { rate.abs().copysign(way) } else { 0.0 })
    }

    /// Returns the rate in m/s that is asked for at the end of a step in s, of a reel at `rate`
    /// when that begins: of one that is to come to a length, which is `way` (m) ahead, and of one
    /// that others drive, the rate of its beginning.
    pub(crate) fn wanted(&self, rate: f64, [begin, end]: [f64; 2], way: Option<f64>) -> f64 {
        match way {
            None if !self.needs_island() => self.follow(rate, begin, end),
            _ => self.asked(begin, way),
        }
    }

    /// Returns the rate in m/s to which one at a time in s comes until another by the table:
    /// towards each row from its time on, within the acceleration.
    fn follow(&self, mut rate: f64, begin: f64, end: f64) -> f64 {
        let mut time = begin;
        while time < end {
            let next = self.rate.iter().map(|row| row[0]).find(|row| *row > time).map_or(end, |row| row.min(end));
            let most = self.acceleration * (next - time);
            rate = self.asked(time, None).clamp(rate - most, rate + most);
            time = next;
        }
        rate
    }

    /// Returns the lengths in m that the table asks for and that its acceleration gives, from time
    /// 0 on until the rate is that of the last row, and the largest rate in m/s that is not
    /// reached; `None` where they are the same.
    ///
    /// A rate that is reached late is left late: what a ramp lacks in the beginning the next one
    /// adds. They differ where a row ends before its rate is reached.
    pub(crate) fn shortfall(&self) -> Option<[f64; 3]> {
        let (mut given, mut asked, mut paid, mut way) = (0.0_f64, 0.0, 0.0, 0.0);
        let mut missed: Option<f64> = None;
        for (i, &[time, rate]) in self.rate.iter().enumerate().filter(|_| self.to_length.is_none()) {
            let next = self.rate.get(i + 1).map(|row| row[0].max(0.0));
            let ramp = (rate - given).abs() / self.acceleration;
            let duration = next.map_or(ramp, |next| next - time.max(0.0));
            if next.is_some() && duration < ramp * (1.0 - crate::scales::SAME) && duration > 0.0 {
                missed = Some(missed.map_or(rate, |most| if rate.abs() > most.abs() { rate } else { most }));
            }
            let rising = duration.min(ramp);
            let reached = if ramp > 0.0 { given + rising / ramp * (rate - given) } else { rate };
            asked += rate * duration;
            way += rate.abs() * duration;
            paid += 0.5 * (given + reached) * rising + rate * (duration - rising);
            given = reached;
        }
        missed.filter(|_| (asked - paid).abs() > SHORTFALL * way).map(|rate| [asked, paid, rate])
    }
}

/// The reel of one end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Wound {
    reel: Reel,
    /// An element of the stock.
    stock: Element,
}

/// The reels in the description of a cable, by end, and the mesh that they wind up.
///
/// Elements are numbered by material: with n elements that came through the eye at the start on
/// balance, the element e of the cable has the number e - n.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Reels {
    at: [Option<Wound>; 2],
    /// As far as the cable is out, its mesh is this.
    mesh: Vec<Element>,
    /// Position in it of the element 0.
    origin: i64,
}

impl Reels {
    /// Returns whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.at.iter().all(Option::is_none)
    }

    /// Returns whether the rate of one is an unknown.
    pub(crate) fn have_laws(&self) -> bool {
        self.at.iter().flatten().any(|own| own.reel.has_law())
    }

    /// Returns the ends that have one.
    pub(crate) fn sides(&self) -> impl Iterator<Item = Side> {
        Side::BOTH.into_iter().filter(|&side| self.at[side as usize].is_some())
    }

    /// Returns the reel at an end.
    pub(crate) fn get(&self, side: Side) -> Option<&Reel> {
        self.at[side as usize].as_ref().map(|own| &own.reel)
    }

    /// Returns the reel at an end, to change it.
    pub(crate) fn get_mut(&mut self, side: Side) -> Option<&mut Reel> {
        self.at[side as usize].as_mut().map(|own| &mut own.reel)
    }

    /// Adds a reel to a cable with these elements, whose last number is `last`.
    pub(crate) fn add(&mut self, side: Side, reel: Reel, elements: &[Element], last: i64) {
        if self.is_empty() {
            *self = Reels { mesh: elements.to_vec(), ..Reels::default() };
        }
        let stock = self.element(if side == Side::End { last } else { last + 1 - elements.len() as i64 });
        self.at[side as usize] = Some(Wound { reel, stock });
    }

    /// Removes a reel; the element `number` at its eye keeps its present length, and is 0 if the
    /// eye is at the start.
    pub(crate) fn remove(&mut self, side: Side, number: i64, element: Element) {
        let at = self.reach(number);
        self.mesh[at] = element;
        self.at[side as usize] = None;
        match side {
            Side::Start => (_, self.origin) = (self.mesh.drain(..at), 0),
            Side::End => self.mesh.truncate(at + 1),
        }
    }

    /// Refuses reels that do not have all of `count` elements, the first of which has this number:
    /// those of a damaged file.
    pub(crate) fn check_numbers(&self, first: i64, count: usize) -> Result<(), Error> {
        let from = first.checked_add(self.origin);
        let to = from.and_then(|from| from.checked_add(count as i64));
        let has = |side: Side| self.at[side as usize].is_some();
        let held = from.zip(to).is_some_and(|(from, to)| {
            (from >= 0 || has(Side::Start)) && (to <= self.mesh.len() as i64 || has(Side::End))
        });
        require("number of the first element beside a reel", first as f64, held, "one of the mesh that reels wind up")
    }

    /// Returns an element by its number, at its full length.
    pub(crate) fn element(&self, number: i64) -> Element {
        let at = number + self.origin;
        let side = if at < 0 { Side::Start } else { Side::End };
        let stock = |side: Side| self.at[side as usize].as_ref().map(|own| own.stock);
        let wound = usize::try_from(at).ok().and_then(|at| self.mesh.get(at).copied());
        let Some(element) = wound.or_else(|| stock(side)) else {
            unreachable!("elements come from an end with a reel")
        };
        element
    }

    /// Returns the least length of an element in m.
    pub(crate) fn least_length(&self) -> f64 {
        let stocks = self.at.iter().flatten().map(|own| own.stock);
        self.mesh.iter().copied().chain(stocks).map(|element| element.length).fold(f64::INFINITY, f64::min)
    }

    /// Extends the mesh by elements of the stocks to the element `number`, and returns its
    /// position.
    fn reach(&mut self, number: i64) -> usize {
        while number + self.origin < 0 {
            let next = self.element(-self.origin - 1);
            self.mesh.insert(0, next);
            self.origin += 1;
        }
        let at = (number + self.origin) as usize;
        while self.mesh.len() <= at {
            let next = self.element(self.mesh.len() as i64 - self.origin);
            self.mesh.push(next);
        }
        at
    }

    /// Adapts the mesh to the element `number`, which is split in two.
    pub(crate) fn refine(&mut self, number: i64, parts: [Element; 2]) {
        let at = self.reach(number);
        self.mesh.splice(at..=at, parts);
    }

    /// Returns the reels of the parts of the cable before and behind a node; `number` is that of
    /// the element behind it.
    pub(crate) fn cut(&self, number: i64) -> [Reels; 2] {
        if self.is_empty() {
            return [Reels::default(), Reels::default()];
        }
        let (mut head, mut tail) = (self.clone(), self.clone());
        let at = tail.reach(number);
        (_, tail.origin) = (tail.mesh.drain(..at), 0);
        head.mesh.truncate(usize::try_from(number + head.origin).unwrap_or(0));
        (head.at[Side::End as usize], tail.at[Side::Start as usize]) = (None, None);
        [head, tail].map(|part| if part.is_empty() { Reels::default() } else { part })
    }
}
