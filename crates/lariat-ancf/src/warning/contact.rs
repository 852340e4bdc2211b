//! Whether the mesh resolves what a cable touches.
//!
//! # Validity
//!
//! The centre line is looked at three places between two samples of its elements, at host times,
//! beside obstacles that are fixed or move as prescribed. Between samples a cable sags with the
//! square of their distance. Where an element that touches turns by more than a ninth of a turn,
//! tensions along a drum are off by 5 to 8 % (8 elements per turn; 10: by 1 %), and the iterations
//! of a step grow to tens. Both are told of if they last longer than an impact, and at once of a
//! cable that rests on what it touches.
//!
//! Where a cable leaves what it lies on, its curvature jumps from that of the surface to w/T. A
//! cubic that has this jump within it is off by a share of `L^2 w/T`, L its length, and the tension
//! by w times that: by up to `w L angle/12`, with the angle by which it and the one beside turn. Of
//! a chain of 850 m with 20 to 160 elements that hangs to a fairlead 186 m up, at 100 offsets, no
//! tension is further off than is told (`tests/contact/statics.rs`).
//!
//! A cable that slides along itself over the facets of a mesh, about which it bends, loses energy
//! at each edge without friction: masses on prisms of 12 to 96 sides fall 5 to 56 % too slowly
//! (docs/decisions/contact.md). It is told after ten radii.
//!
//! An attachment on a face holds the centre line in it, and beside it the cable lies its radius
//! away, from some radii on ([`Obstacle::except`]). One with bending stiffness pries itself up over
//! this height: with the moment M where it first may touch, `l` from the attachment, the forces
//! there have `M/l` from that, for which the fixture of a real rope, as thick as the rope, has no
//! counterpart. It is told above a twentieth of the largest tension, or of the weight.
//!
//! A cable runs over another one if their contact moves along one of them by half a turn of the
//! other, and less than half as much along that, while it sticks at all host times. What sticks
//! moves along neither, but for one that turns beneath one that bends around it. The contact that
//! pushes most is followed, one of a cable, up to four diameters in a host step.

use super::Warning;
use crate::cable::Cable;
use crate::obstacle::{LARGEST_RESTITUTION, Obstacle, RigidMotion};
use crate::scales::watch::{
    ADVISED, CONTACT_TURN, DEPTH, DURATION, FACET_TURN, FOLLOWED, INSIDE, PRIED, RUN, SLID, TOUCHDOWN,
};
use crate::state::PairMemory;
use crate::watch::{Contacts, Excess, Sticking};
use nalgebra::Vector3;

/// Returns the largest speed (m/s) with which a cable slides along itself over an obstacle about
/// which it bends.
fn sliding(cable: &Cable, obstacle: &Obstacle) -> Option<f64> {
    let touches = || cable.snapshot.state.memory.contacts.iter().filter(|touch| touch.obstacle == obstacle.key);
    let first = touches().next()?.direction;
    if touches().all(|touch| touch.direction.dot(&first) > FACET_TURN.cos()) {
        return None;
    }
    let RigidMotion { position, velocity, angular_velocity, .. } = &obstacle.motion;
    let (q, v) = (cable.positions(), cable.velocities());
    let slides = touches().filter(|touch| touch.slips || obstacle.friction == 0.0);
    let speed = slides.map(|touch| {
        let node = |x: &[f64], i: usize| Vector3::from_column_slice(&x[6 * i..6 * i + 3]);
        let e = touch.element as usize;
        let (along, place) = ((node(q, e + 1) - node(q, e)).normalize(), 0.5 * (node(q, e) + node(q, e + 1)));
        let own = 0.5 * (node(v, e) + node(v, e + 1));
        (own - velocity - angular_velocity.cross(&(place - position))).dot(&along).abs()
    });
    Some(speed.filter(|speed| speed.is_finite()).fold(0.0, f64::max))
}

impl Excess {
    fn note(&mut self, time: f64, [arc_length, reading]: [f64; 2], limit: f64) {
        if reading <= limit {
            self.since = None;
            return;
        }
        let since = *self.since.get_or_insert_with(|| {
            self.least = [arc_length, reading];
            time
        });
        if reading < self.least[1] {
            self.least = [arc_length, reading];
        }
        if time - since > DURATION && self.least[1] > self.worst[1] {
            self.worst = self.least;
        }
    }

    /// Notes the reading of a cable at rest, which lasts.
    fn rest(&mut self, reading: [f64; 2], limit: f64) {
        if reading[1] > limit.max(self.worst[1]) {
            self.worst = reading;
        }
    }

    fn told(&self) -> Option<[f64; 2]> {
        Some(self.worst).filter(|worst| worst[1] > 0.0)
    }
}

impl Cable {
    /// Notes, if the cable is watched, whether it is in an obstacle of its own.
    pub(crate) fn note_inside(&mut self) {
        let Some(mut watch) = self.watch.take() else { return };
        watch.contacts.note_inside(self);
        self.watch = Some(watch);
    }
}

impl Contacts {
    /// Reads whether the cable is in an obstacle, as obstacles come.
    pub fn note_inside(&mut self, cable: &Cable) {
        // what the colliders of a set are to its cables it knows by itself
        let Some(found) = cable.overlap().filter(|_| cable.contact_key() == 0) else { return };
        let is_inside = found.depth > INSIDE.max(cable.contact_radius());
        let is_deeper = self.inside.is_none_or(|(_, [_, depth])| depth < found.depth);
        if is_inside && is_deeper {
            self.inside = Some((found.obstacle, [found.arc_length, found.depth]));
        }
    }

    pub fn starts_inside(&self, cable: &Cable) -> Option<Warning> {
        let (obstacle, [arc_length_m, depth_m]) = self.inside?;
        Some(Warning::StartsInside { cable: cable.name().to_string(), obstacle, arc_length_m, depth_m })
    }

    /// Reads the cable at a host time.
    pub fn note(&mut self, cable: &Cable) {
        if cable.effects().contact.is_none() {
            return;
        }
        self.note_facets(cable);
        self.follow(cable);
        let [depth, turn] = cable.contact_quality(CONTACT_TURN);
        let rests = !cable.snapshot.state.memory.contacts.is_empty() && cable.velocities().iter().all(|v| *v == 0.0);
        let touchdown = cable.touchdown_quality();
        let (pried, bears) =
            cable.prying().map_or(([0.0; 2], f64::INFINITY), |own| ([own.arc_length, own.force], own.scale));
        for (excess, reading, limit) in [
            (&mut self.depth, depth, DEPTH),
            (&mut self.turn, turn, 1.0),
            (&mut self.touchdown, touchdown, TOUCHDOWN),
            (&mut self.pried, pried, PRIED * bears),
        ] {
            excess.note(cable.time(), reading, limit);
            if rests {
                excess.rest(reading, limit);
            }
        }
    }

    /// Reads how fast the cable slides along itself over facets.
    fn note_facets(&mut self, cable: &Cable) {
        let Some(before) = self.facets.at.replace(cable.time()) else { return };
        let obstacles = cable.obstacles().iter().filter(|obstacle| obstacle.surface.has_facets());
        let fastest = obstacles.filter_map(|obstacle| sliding(cable, obstacle)).fold(0.0, f64::max);
        self.facets.slid += fastest * (cable.time() - before).max(0.0);
    }

    pub fn facets(&self, cable: &Cable) -> Option<Warning> {
        let slid_m = self.facets.slid;
        (slid_m > SLID * cable.contact_radius()).then(|| Warning::Facets {
            cable: cable.name().to_string(),
            time_s: cable.time(),
            slid_m,
        })
    }

    pub fn sinks(&self, cable: &Cable) -> Option<Warning> {
        self.depth.told().map(|[arc_length_m, share]| {
            let enough = (cable.elements().len() as f64 * (2.0 * share / DEPTH).sqrt()).ceil() as usize;
            let cable = cable.name().to_string();
            Warning::Sinks { cable, arc_length_m, share, enough }
        })
    }

    pub fn coarse(&self, cable: &Cable) -> Option<Warning> {
        self.turn.told().map(|[arc_length_m, share]| {
            let turn_rad = share * CONTACT_TURN;
            let enough = (cable.elements().len() as f64 * turn_rad / ADVISED).ceil() as usize;
            Warning::CoarseContact { cable: cable.name().to_string(), arc_length_m, turn_rad, enough }
        })
    }

    pub fn touchdown(&self, cable: &Cable) -> Option<Warning> {
        self.touchdown.told().map(|[arc_length_m, share]| {
            let enough = (cable.elements().len() as f64 * (2.0 * share / TOUCHDOWN).sqrt()).ceil() as usize;
            Warning::CoarseTouchdown { cable: cable.name().to_string(), arc_length_m, share, enough }
        })
    }

    /// Whether an attachment pries.
    pub fn pried(&self, cable: &Cable) -> Option<Warning> {
        let [arc_length_m, force_n] = self.pried.told()?;
        let (cable, radius_m) = (cable.name().to_string(), cable.contact_radius());
        Some(Warning::PriedAttachment { cable, arc_length_m, radius_m, force_n })
    }

    /// Follows the contact with a cable that pushes most while it sticks.
    fn follow(&mut self, cable: &Cable) {
        let memory = &cable.snapshot.state.memory.pairs;
        if memory.is_empty() || cable.effects().contact.is_none_or(|own| own.friction <= 0.0) {
            self.sticking = None;
            return;
        }
        let material = |pair: &PairMemory| [0, 1].map(|k| pair.arcs[k] - pair.passed[k]);
        let sticks = |pair: &&PairMemory| !pair.contact.slips && pair.contact.force > 0.0;
        let reach = 2.0 * cable.contact_radius();
        self.sticking = self.sticking.and_then(|last| {
            let apart = |pair: &PairMemory| [0, 1].map(|k| (material(pair)[k] - last.now[k]).abs());
            let same = |pair: &&PairMemory| {
                let apart = apart(pair);
                let [less, more] = [apart[0].min(apart[1]), apart[0].max(apart[1])];
                pair.contact.obstacle == last.other && less < 0.5 * reach && more < FOLLOWED * reach
            };
            let sum = |pair: &PairMemory| apart(pair).iter().sum::<f64>();
            let nearest = memory.iter().filter(same).min_by(|a, b| sum(a).total_cmp(&sum(b)));
            nearest.filter(sticks).map(|pair| Sticking { now: material(pair), ..last })
        });
        let Some(Sticking { start, now, .. }) = self.sticking else {
            let most = memory.iter().filter(sticks).max_by(|a, b| a.contact.force.total_cmp(&b.contact.force));
            self.sticking = most.map(|pair| {
                let now = material(pair);
                Sticking { other: pair.contact.obstacle, start: now, now }
            });
            return;
        };
        let ways = [0, 1].map(|k| (now[k] - start[k]).abs());
        let [less, more] = [ways[0].min(ways[1]), ways[0].max(ways[1])];
        // one that is laid along the other moves along both
        if less < 0.5 * more && more > RUN * reach && more > self.run[0] {
            self.run = [more, now[0]];
        }
    }

    /// Whether a cable ran over another one although its contact stuck.
    pub fn runs_over(&self, cable: &Cable) -> Option<Warning> {
        let [run_m, arc_length_m] = self.run;
        (run_m > 0.0).then(|| Warning::RunsOver { cable: cable.name().to_string(), arc_length_m, run_m })
    }

    /// Whether it touched a cable with more restitution than it can have.
    pub fn bounces(cable: &Cable) -> Option<Warning> {
        let restitution = cable.effects().contact?.restitution;
        let told = restitution > LARGEST_RESTITUTION && cable.diagnostics().touching_steps > 0;
        told.then(|| Warning::HighRestitution { cable: cable.name().to_string(), restitution })
    }

    /// Whether friction lags in more than a hundredth of all steps.
    pub fn lags(cable: &Cable) -> Option<Warning> {
        let counts = cable.diagnostics();
        let steps = counts.lagging_steps;
        (steps > 10 && 100 * steps > counts.steps)
            .then(|| Warning::FrictionLags { cable: cable.name().to_string(), steps })
    }
}
