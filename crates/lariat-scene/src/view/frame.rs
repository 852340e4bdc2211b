//! A frame: the cables and bodies at a time, as the numbers that `data.js` reads.
//!
//! ```text
//! pieces:    number of pieces; for each the index of its cable, the number of nodes, and NODE numbers of each node
//! bodies:    for each position and rotation x, y, z, w
//! contacts:  if cables can touch, the number of contacts, and for each place and force
//! stripes:   if a cable has torsion, STRIPE numbers for each node of all pieces
//! ```

use super::{NODE, NODES, cast};
use crate::run::World;
use lariat_ancf::{Cable, Error};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

/// The cables and bodies at a time in s.
#[derive(Default)]
pub struct Frame {
    pub time: f64,
    pub numbers: Vec<f32>,
}

/// Appends a piece of a cable, `from` (m) behind the start of the cable of this index. Returns the arc lengths of its nodes.
pub fn push_piece(numbers: &mut Vec<f32>, cable: &Cable, index: usize, from: f64) -> Result<Vec<f64>, Error> {
    let mut places = cable.node_arc_lengths();
    if places.len() > NODES {
        let step = cable.length() / (NODES - 1) as f64;
        places = (0..NODES).map(|k| (k as f64 * step).min(cable.length())).collect();
    }
    numbers.extend([index as f32, places.len() as f32]);
    for (i, &s) in places.iter().enumerate() {
        let here = cable.sample(s)?;
        let next = places.get(i + 1).map(|next| cable.sample(0.5 * (s + next))).transpose()?;
        numbers.push((from + s) as f32);
        numbers.extend(here.position.iter().chain(here.slope.iter()).map(|&x| x as f32));
        numbers.extend([here.tension as f32, next.unwrap_or(here).tension as f32]);
    }
    Ok(places)
}

/// Appends the stripe of a piece at its nodes, zeros where there is none.
pub fn push_stripe(numbers: &mut Vec<f32>, cable: &Cable, places: &[f64]) -> Result<(), Error> {
    for (direction, &s) in cable.stripe(places)?.into_iter().zip(places) {
        let rate = cable.torsion_at(s)?.map_or(0.0, |reading| reading.twist_rate);
        numbers.extend(direction.unwrap_or_default().iter().chain(&[rate]).map(|&x| x as f32));
    }
    Ok(())
}

/// Returns position and rotation of a body.
pub fn pose(at: &Isometry3<f64>) -> [f32; 7] {
    let (x, q) = (&at.translation.vector, &at.rotation);
    [x.x, x.y, x.z, q.i, q.j, q.k, q.w].map(|number| number as f32)
}

/// Appends places and forces of the contacts of cables, after their number.
pub fn push_contacts<'a>(numbers: &mut Vec<f32>, cables: impl Iterator<Item = &'a Cable>) -> Result<(), Error> {
    let count = numbers.len();
    numbers.push(0.0);
    for cable in cables {
        let on_bodies =
            cable.contacts().map(|touch| (touch.arc_length, touch.normal * touch.normal_force + touch.friction));
        let on_cables =
            cable.cable_contacts().map(|touch| (touch.arc_length, touch.normal * touch.normal_force + touch.friction));
        for (s, force) in on_bodies.chain(on_cables) {
            let place = cable.sample(s)?.position;
            numbers.extend(place.iter().chain(force.iter()).map(|&x| x as f32));
            numbers[count] += 1.0;
        }
    }
    Ok(())
}

impl Frame {
    /// Returns the present state of a run.
    pub fn of(world: &World) -> Result<Self, Error> {
        let (mut numbers, mut stripes) = (vec![world.pieces().len() as f32], Vec::new());
        let twisted = cast::is_twisted(world.scene());
        for (cable, piece) in world.cables().into_iter().zip(world.pieces()) {
            let places = push_piece(&mut numbers, cable, piece.cable, piece.from)?;
            if twisted {
                push_stripe(&mut stripes, cable, &places)?;
            }
        }
        for body in (0..world.scene().bodies.len()).filter_map(|i| world.body(i)) {
            numbers.extend(pose(&Isometry3::from_parts(body.position.into(), body.rotation)));
        }
        if cast::touches(world.scene()) {
            push_contacts(&mut numbers, world.cables().into_iter())?;
        }
        numbers.extend(stripes);
        Ok(Frame { time: world.time(), numbers })
    }

    /// Returns where the numbers of the pieces of each cable begin, and where those of the bodies do.
    pub fn places(&self, cables: usize) -> (Vec<Vec<usize>>, usize) {
        let (mut pieces, mut at) = (vec![Vec::new(); cables], 1);
        for _ in 0..self.numbers[0] as usize {
            pieces[self.numbers[at] as usize].push(at + 1);
            at += 2 + NODE * self.numbers[at + 1] as usize;
        }
        (pieces, at)
    }

    /// Returns the numbers of the nodes of the piece that begins at a place: arc length, position, slope, tension there and halfway to
    /// the next.
    pub fn nodes(&self, at: usize) -> impl ExactSizeIterator<Item = &[f32]> {
        self.numbers[at + 1..][..NODE * self.numbers[at] as usize].chunks_exact(NODE)
    }

    /// Returns the vertices of the cubic Bezier pieces of the elements of the piece that begins at a place.
    pub fn vertices(&self, at: usize) -> Vec<[f32; 3]> {
        let nodes: Vec<&[f32]> = self.nodes(at).collect();
        let mut points = Vec::with_capacity(3 * nodes.len());
        for (i, here) in nodes.iter().enumerate() {
            let beside = |share: f32| [1, 2, 3].map(|k| here[k] + share * here[k + 3]);
            if i > 0 {
                points.push(beside(-(here[0] - nodes[i - 1][0]) / 3.0));
            }
            points.push(beside(0.0));
            if let Some(next) = nodes.get(i + 1) {
                points.push(beside((next[0] - here[0]) / 3.0));
            }
        }
        points
    }

    /// Returns position and rotation of a body, of which the bodies begin at a place.
    pub fn pose(&self, bodies: usize, body: usize) -> Isometry3<f32> {
        let x = &self.numbers[bodies + 7 * body..][..7];
        let rotation = UnitQuaternion::new_unchecked(Quaternion::new(x[6], x[3], x[4], x[5]));
        Isometry3::from_parts(Translation3::new(x[0], x[1], x[2]), rotation)
    }
}
