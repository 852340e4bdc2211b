//! The surface of a cable as triangles, for a renderer.
//!
//! # Equation
//!
//! Rings of vertices of a radius about points of the curve, closed by a disc at each end. The frame
//! of a ring does not twist about the tangent: from ring to ring it is reflected twice, in the plane
//! between the points and in that between the tangents (Wang, Juettler, Zheng & Liu 2008,
//! "Computation of rotation minimizing frames", ACM Trans. Graph. 27, 2; order 4 in the distance of
//! the rings). Where a cable with torsion is held against spin on both sides, the frame is that of a
//! [line that is painted](Cable::stripe) along it, so that the texture shows its twist. u runs round
//! the cable, v is the arc length over the length of the texture.
//!
//! # Validity
//!
//! For display. A curve that bends to less than the radius cuts through its own surface. The twist is
//! that of the last step, also where positions are between two steps; from ring to ring it is below
//! half a turn.

use crate::cables::Cables;
use bevy_ecs::change_detection::DetectChangesMut;
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::system::{Query, Res};
use lariat_ancf::element::shape;
use lariat_ancf::{Cable, Vector3};
use serde::{Deserialize, Serialize};

/// Lets a cable have a surface: a tube, whose [`RopeVertices`] are brought up to date after each host
/// step in which the cable moved.
#[derive(Component, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[require(RopeVertices)]
pub struct RopeMesh {
    radius: f64,
    sides: usize,
    rings: usize,
    texture_length: f64,
    tensions: Option<[f64; 2]>,
}

impl RopeMesh {
    /// A tube of a radius in m, with eight sides, four rings in each element, and a texture that is
    /// repeated after the circumference. A radius that is not positive counts as 1 mm.
    pub fn new(radius: f64) -> Self {
        let radius = if radius > 0.0 && radius.is_finite() { radius } else { 1e-3 };
        RopeMesh { radius, sides: 8, rings: 4, texture_length: core::f64::consts::TAU * radius, tensions: None }
    }

    /// Sets the number of sides, at least 3.
    pub fn sides(mut self, sides: usize) -> Self {
        self.sides = sides.max(3);
        self
    }

    /// Sets the number of rings in each element, at least 1.
    pub fn rings(mut self, rings: usize) -> Self {
        self.rings = rings.max(1);
        self
    }

    /// Sets the length in m after which the texture is repeated along the cable. One that is not
    /// positive is left out.
    pub fn texture_length(mut self, length: f64) -> Self {
        if length > 0.0 && length.is_finite() {
            self.texture_length = length;
        }
        self
    }

    /// Returns by ring the direction of a line that is painted along a cable; empty without torsion.
    fn stripe(&self, cable: &Cable) -> Vec<Option<Vector3<f64>>> {
        if cable.effects().torsion.is_none() {
            return Vec::new();
        }
        let mut places = Vec::with_capacity(cable.elements().len() * self.rings + 1);
        let mut from = 0.0;
        for element in cable.elements() {
            places.extend((0..self.rings).map(|k| from + k as f64 / self.rings as f64 * element.length));
            from += element.length;
        }
        places.push(cable.length());
        cable.stripe(&places).unwrap_or_default()
    }

    /// Colours vertices by the tension: white up to `low`, red from `high` (N) on.
    pub fn coloured_by_tension(mut self, low: f64, high: f64) -> Self {
        self.tensions = Some([low, high]);
        self
    }
}

/// The triangles of a cable's surface, in world coordinates and single precision, as renderers take
/// them: one entry of each array per vertex.
#[derive(Component, Clone, Debug, Default, PartialEq)]
pub struct RopeVertices {
    /// Positions in m.
    pub positions: Vec<[f32; 3]>,
    /// Outward unit normals.
    pub normals: Vec<[f32; 3]>,
    /// Coordinates of the texture.
    pub uvs: Vec<[f32; 2]>,
    /// Colours, red, green, blue, alpha, linear; empty unless they are
    /// [asked for](RopeMesh::coloured_by_tension).
    pub colours: Vec<[f32; 4]>,
    /// Vertices of the triangles, anticlockwise from outside.
    pub indices: Vec<u32>,
    /// Nodal coordinates of which these are the vertices, and the settings.
    drawn: (Vec<f64>, Option<RopeMesh>),
    /// By ring the direction of the painted line; empty without torsion.
    stripe: Vec<Option<Vector3<f64>>>,
    /// By vertex of a ring cosine and sine of the way round.
    circle: Vec<[f64; 2]>,
}

/// A point of the curve with a frame that does not twist but with the cable.
#[derive(Clone, Copy)]
struct Ring {
    centre: Vector3<f64>,
    tangent: Vector3<f64>,
    across: Vector3<f64>,
}

impl RopeVertices {
    /// Draws a cable at nodal coordinates, which are its own or
    /// [between two steps](crate::Interpolate::positions). Nothing is allocated unless there are more
    /// vertices than before, or torsion. Returns whether anything changed.
    pub fn draw(&mut self, mesh: &RopeMesh, cable: &Cable, positions: &[f64]) -> bool {
        // a straight cable is twisted in place
        let stripe = mesh.stripe(cable);
        if self.drawn.0 == positions && self.drawn.1.as_ref() == Some(mesh) && self.stripe == stripe {
            return false;
        }
        self.stripe = stripe;
        let other = self.drawn.1.as_ref() != Some(mesh);
        let fewer = other || self.drawn.0.len() != positions.len();
        self.drawn.0.clear();
        self.drawn.0.extend_from_slice(positions);
        if other {
            self.drawn.1 = Some(mesh.clone());
            self.circle.clear();
            let angles = (0..=mesh.sides).map(|k| core::f64::consts::TAU * (k as f64 / mesh.sides as f64));
            self.circle.extend(angles.map(|angle| [angle.cos(), angle.sin()]));
        }
        self.positions.clear();
        self.normals.clear();
        self.uvs.clear();
        self.colours.clear();
        let (mut before, mut from, mut count) = (None, 0.0, 0);
        // read at nodes, and linear between them
        let read = |s: f64| cable.sample(s.min(cable.length())).map_or(0.0, |sample| sample.tension);
        let mut tensions = mesh.tensions.map(|_| [0.0, read(0.0)]);
        for (e, element) in cable.elements().iter().enumerate() {
            if let Some([start, end]) = &mut tensions {
                (*start, *end) = (*end, read(from + element.length));
            }
            let last = e + 1 == cable.elements().len();
            for k in 0..mesh.rings + usize::from(last) {
                let xi = k as f64 / mesh.rings as f64;
                let mut ring = Ring::at(positions, e, xi, element.length, before);
                ring.turn_to(self.stripe.get(count as usize).copied().flatten());
                let s = from + xi * element.length;
                let pull = tensions.map(|[start, end]| (1.0 - xi) * start + xi * end);
                let colour = pull.zip(mesh.tensions).map(|(pull, tensions)| colour(pull, tensions));
                if before.is_none() {
                    self.disc(mesh, &ring, -1.0, s, colour);
                }
                self.ring(mesh, &ring, s, colour);
                count += 1;
                if last && k == mesh.rings {
                    self.disc(mesh, &ring, 1.0, s, colour);
                }
                before = Some(ring);
            }
            from += element.length;
        }
        if fewer {
            self.connect(mesh.sides as u32, count);
        }
        true
    }

    /// Appends a vertex.
    fn vertex(&mut self, at: Vector3<f64>, normal: Vector3<f64>, uv: [f64; 2], colour: Option<[f32; 4]>) {
        self.positions.push(single(at));
        self.normals.push(single(normal));
        self.uvs.push(uv.map(|x| x as f32));
        self.colours.extend(colour);
    }

    /// Appends a ring; its first vertex is there twice, for both ends of the texture.
    fn ring(&mut self, mesh: &RopeMesh, ring: &Ring, s: f64, colour: Option<[f32; 4]>) {
        let up = ring.tangent.cross(&ring.across);
        for k in 0..=mesh.sides {
            let (u, [cos, sin]) = (k as f64 / mesh.sides as f64, self.circle[k]);
            let normal = ring.across * cos + up * sin;
            self.vertex(ring.centre + normal * mesh.radius, normal, [u, s / mesh.texture_length], colour);
        }
    }

    /// Appends the vertices of the disc at an end, along the tangent or against it.
    fn disc(&mut self, mesh: &RopeMesh, ring: &Ring, sign: f64, s: f64, colour: Option<[f32; 4]>) {
        let (normal, v) = (ring.tangent * sign, s / mesh.texture_length);
        self.vertex(ring.centre, normal, [0.5, v], colour);
        let up = ring.tangent.cross(&ring.across);
        for k in 0..mesh.sides {
            let (u, [cos, sin]) = (k as f64 / mesh.sides as f64, self.circle[k]);
            let outward = ring.across * cos + up * sin;
            self.vertex(ring.centre + outward * mesh.radius, normal, [u, v], colour);
        }
    }

    /// Makes the triangles between `count` rings, and those of the discs before and behind them.
    fn connect(&mut self, sides: u32, count: u32) {
        self.indices.clear();
        let (disc, ring) = (sides + 1, sides + 1);
        let end = disc + count * ring;
        for k in 0..sides {
            let next = (k + 1) % sides;
            self.indices.extend([0, 1 + next, 1 + k, end, end + 1 + k, end + 1 + next]);
        }
        for i in 0..count.saturating_sub(1) {
            let (a, b) = (disc + i * ring, disc + (i + 1) * ring);
            for k in 0..sides {
                self.indices.extend([a + k, a + k + 1, b + k, b + k, a + k + 1, b + k + 1]);
            }
        }
    }
}

impl Ring {
    /// Returns the ring at a point of an element, with the frame of the one before reflected to it.
    fn at(q: &[f64], element: usize, xi: f64, length: f64, before: Option<Ring>) -> Ring {
        let [centre, slope] =
            [shape::position, shape::slope].map(|weights| shape::combine(q, element, &weights(xi, length)));
        let back = before.map_or(Vector3::y(), |ring| ring.tangent);
        let tangent = slope.try_normalize(f64::MIN_POSITIVE).unwrap_or(back);
        let turned = match before {
            None => any_across(&tangent),
            Some(Ring { centre: c, tangent: t, across: r }) => {
                let between = centre - c;
                let (r, t) = (reflect(r, between), reflect(t, between));
                reflect(r, tangent - t)
            }
        };
        let across = turned - tangent * turned.dot(&tangent);
        let across = across.try_normalize(f64::MIN_POSITIVE).unwrap_or_else(|| any_across(&tangent));
        Ring { centre, tangent, across }
    }

    /// Turns the frame to a direction, if there is one across the curve.
    fn turn_to(&mut self, direction: Option<Vector3<f64>>) {
        let across = direction.map(|d| d - self.tangent * d.dot(&self.tangent));
        self.across = across.and_then(|d| d.try_normalize(f64::MIN_POSITIVE)).unwrap_or(self.across);
    }
}

/// Returns a vector reflected in the plane of a normal of any length; a normal of no length reflects
/// nothing.
fn reflect(x: Vector3<f64>, normal: Vector3<f64>) -> Vector3<f64> {
    let square = normal.norm_squared();
    if square > 0.0 { x - normal * (2.0 * normal.dot(&x) / square) } else { x }
}

/// Returns a unit vector across another.
fn any_across(tangent: &Vector3<f64>) -> Vector3<f64> {
    let axis = Vector3::from(core::array::from_fn(|i| f64::from(u8::from(i == tangent.iamin()))));
    (axis - tangent * axis.dot(tangent)).normalize()
}

/// Returns white at the low tension or less, and red at the high one or more.
fn colour(tension: f64, [low, high]: [f64; 2]) -> [f32; 4] {
    let share = if high > low { ((tension - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 } as f32;
    [1.0, 1.0 - share, 1.0 - share, 1.0]
}

fn single(x: Vector3<f64>) -> [f32; 3] {
    [x.x as f32, x.y as f32, x.z as f32]
}

/// Draws the cables that have a surface and moved.
pub(crate) fn draw(cables: Res<Cables>, mut meshes: Query<(Entity, &RopeMesh, &mut RopeVertices)>) {
    for (entity, mesh, mut vertices) in &mut meshes {
        let Ok(cable) = cables.get(entity) else { continue };
        if vertices.bypass_change_detection().draw(mesh, cable, cable.positions()) {
            vertices.set_changed();
        }
    }
}
