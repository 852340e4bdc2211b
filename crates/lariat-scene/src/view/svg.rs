//! The motion as an animated SVG, for a README or a page: no script, no network, any browser.
//!
//! Every picture is a state of the run, shown until the next; the run is repeated, in its own time between [`SHORTEST`] and
//! [`LONGEST`] seconds. The view is from afar, so that equal lengths look equal. Cables are the cubics of their elements, coloured by
//! their largest tension; bodies are outlines, from far to near as they start.

use super::cast::Cast;
use super::frame::Frame;
use crate::scene::body::{BodyKind, BodyShape};
use nalgebra::{Isometry3, Point3, Vector2, Vector3};
use std::fmt::Write as _;

/// Most pictures of an animation, and letters of all pictures together: what a README bears.
const PICTURES: usize = 96;
const LETTERS: usize = 400_000;
/// Shortest and longest time of an animation, in s.
const SHORTEST: f64 = 3.0;
const LONGEST: f64 = 12.0;
/// Width of a picture in px, its largest and smallest height, and its margin.
const WIDTH: f32 = 720.0;
const HEIGHTS: [f32; 2] = [160.0, 480.0];
const MARGIN: f32 = 16.0;
/// Angle in rad by which the view is turned about the vertical, and that from above.
const VIEW: [f32; 2] = [0.45, 0.25];
/// Corners of the outline of a round body.
const ROUND: usize = 24;
/// Colours of the smallest to the largest tension.
const COLOURS: [[f32; 3]; 3] = [[91.0, 75.0, 219.0], [217.0, 72.0, 110.0], [232.0, 180.0, 34.0]];

/// Returns the file.
pub fn write(cast: &Cast, frames: &[Frame]) -> String {
    let frames = chosen(cast, frames);
    let shown: Vec<Shown> = frames.iter().map(|frame| Shown::of(cast, frame)).collect();
    let paper = Paper::of(cast, &shown);
    let time = frames.last().map_or(0.0, |frame| frame.time).clamp(SHORTEST, LONGEST);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {0:.0}\" width=\"{WIDTH}\" height=\"{0:.0}\">\n\
         <title>{1}</title>\n<rect width=\"100%\" height=\"100%\" rx=\"8\" fill=\"#fbfbfc\"/>\n",
        paper.height,
        super::page::escaped(&cast.name)
    );
    let animated = |text: &mut String, name: &str, values: Vec<String>| {
        if values.windows(2).any(|pair| pair[0] != pair[1]) {
            let _ = write!(
                text,
                "<animate attributeName=\"{name}\" dur=\"{time:.2}s\" repeatCount=\"indefinite\" calcMode=\"discrete\" values=\"{}\"/>",
                values.join(";")
            );
        }
    };
    let mut order: Vec<usize> = (0..cast.bodies.len()).collect();
    let depth =
        |body: &usize| shown.first().map_or(0.0, |first| first.poses[*body].translation.vector.dot(&paper.towards));
    order.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
    for body in order {
        let outlines: Vec<String> =
            shown.iter().map(|shown| paper.outline(&cast.bodies[body].shape, &shown.poses[body])).collect();
        let Some(first) = outlines.first().filter(|first| !first.is_empty()) else { continue };
        let fill = match cast.bodies[body].kind {
            BodyKind::Dynamic => "#9fb8d8",
            BodyKind::Fixed => "#d9d9de",
            BodyKind::Kinematic => "#b9d3bd",
        };
        let _ = write!(
            text,
            "<path d=\"{first}\" fill=\"{fill}\" stroke=\"#4a4a52\" stroke-width=\"1\" stroke-linejoin=\"round\">"
        );
        animated(&mut text, "d", outlines);
        text.push_str("</path>\n");
    }
    for cable in 0..cast.cables.len() {
        let lines: Vec<String> = shown.iter().map(|shown| paper.line(&shown.cables[cable])).collect();
        let colours: Vec<String> = shown.iter().map(|shown| paper.colour(shown.tensions[cable])).collect();
        let (Some(line), Some(colour)) = (lines.first(), colours.first()) else { continue };
        let _ = write!(
            text,
            "<path d=\"{line}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\" stroke-linecap=\"round\" stroke-linejoin=\"round\">"
        );
        animated(&mut text, "d", lines);
        animated(&mut text, "stroke", colours);
        text.push_str("</path>\n");
    }
    text.push_str("</svg>\n");
    text
}

/// Returns evenly spaced frames, as many as the size of the file allows.
fn chosen<'a>(cast: &Cast, frames: &'a [Frame]) -> Vec<&'a Frame> {
    // 13 letters of each of three vertices of an element, and of each corner of a body
    let letters = 13 * (3 * cast.elements + ROUND * cast.bodies.len()).max(1);
    let most = (LETTERS / letters).clamp(2, PICTURES);
    let every = frames.len().div_ceil(most).max(1);
    frames.iter().step_by(every).collect()
}

/// What a picture shows.
struct Shown {
    /// By cable, the vertices of its pieces.
    cables: Vec<Vec<Vec<[f32; 3]>>>,
    /// By cable, the largest tension in N.
    tensions: Vec<f32>,
    poses: Vec<Isometry3<f32>>,
}

impl Shown {
    fn of(cast: &Cast, frame: &Frame) -> Self {
        let (pieces, bodies) = frame.places(cast.cables.len());
        let largest = |pieces: &Vec<usize>| {
            let tensions = pieces.iter().flat_map(|&at| frame.nodes(at)).map(|node| node[7]);
            tensions.filter(|t| t.is_finite()).fold(0.0, f32::max)
        };
        Shown {
            tensions: pieces.iter().map(largest).collect(),
            cables: pieces.iter().map(|pieces| pieces.iter().map(|&at| frame.vertices(at)).collect()).collect(),
            poses: (0..cast.bodies.len()).map(|body| frame.pose(bodies, body)).collect(),
        }
    }
}

/// Where points of the world are in a picture.
struct Paper {
    /// Axes to the right, upwards, and towards who looks.
    axes: [Vector3<f32>; 2],
    towards: Vector3<f32>,
    /// px per m, the point at the lower left, and where it is.
    scale: f32,
    low: Vector2<f32>,
    left: f32,
    height: f32,
    tensions: [f32; 2],
}

impl Paper {
    fn of(cast: &Cast, shown: &[Shown]) -> Self {
        let gravity = cast.gravity.cast::<f32>();
        let axis = if gravity == Vector3::zeros() { 1 } else { gravity.iamax() };
        let up = Vector3::ith(axis, if gravity[axis] > 0.0 { -1.0 } else { 1.0 });
        let level = Vector3::ith(usize::from(axis == 0), 1.0);
        let front = level.cross(&up);
        let right = level * VIEW[0].cos() - front * VIEW[0].sin();
        let ahead = level * VIEW[0].sin() + front * VIEW[0].cos();
        let towards = ahead * VIEW[1].cos() + up * VIEW[1].sin();
        let axes = [right, up * VIEW[1].cos() - ahead * VIEW[1].sin()];
        let mut paper = Paper {
            axes,
            towards,
            scale: 1.0,
            low: Vector2::zeros(),
            left: 0.0,
            height: HEIGHTS[0],
            tensions: [0.0; 2],
        };
        let (mut low, mut high) = (Vector2::repeat(f32::INFINITY), Vector2::repeat(f32::NEG_INFINITY));
        for shown in shown {
            let bodies =
                cast.bodies.iter().zip(&shown.poses).flat_map(|(body, pose)| corners(&body.shape, pose, &paper.axes));
            let cables = shown.cables.iter().flatten().flatten().map(|p| Vector3::from(*p));
            for p in bodies.chain(cables).map(|p| paper.flat(&p)).filter(|p| p.iter().all(|x| x.is_finite())) {
                (low, high) = (low.inf(&p), high.sup(&p));
            }
        }
        if low.x > high.x {
            return paper;
        }
        let size = (high - low).map(|x| x.max(1e-6));
        let inside = [WIDTH - 2.0 * MARGIN, HEIGHTS[1] - 2.0 * MARGIN];
        paper.scale = (inside[0] / size.x).min(inside[1] / size.y);
        paper.height = (size.y * paper.scale + 2.0 * MARGIN).max(HEIGHTS[0]);
        let room = 0.5 * (paper.height - 2.0 * MARGIN - size.y * paper.scale);
        paper.low = Vector2::new(low.x, low.y - room / paper.scale);
        paper.left = 0.5 * (WIDTH - size.x * paper.scale);
        let mut tensions: Vec<f32> = shown.iter().flat_map(|shown| shown.tensions.iter().copied()).collect();
        tensions.sort_by(f32::total_cmp);
        let at = |share: usize| tensions.get((tensions.len().max(1) - 1) * share / 100).copied().unwrap_or(0.0);
        paper.tensions = [at(1), at(99)];
        paper
    }

    fn flat(&self, p: &Vector3<f32>) -> Vector2<f32> {
        Vector2::new(self.axes[0].dot(p), self.axes[1].dot(p))
    }

    fn place(&self, p: &Vector3<f32>) -> Vector2<f32> {
        let from = (self.flat(p) - self.low) * self.scale;
        Vector2::new(self.left + from.x, self.height - MARGIN - from.y)
    }

    /// Returns the path of the pieces of a cable.
    fn line(&self, pieces: &[Vec<[f32; 3]>]) -> String {
        let mut text = String::new();
        for piece in pieces {
            for (i, p) in piece.iter().enumerate() {
                let p = self.place(&Vector3::from(*p));
                let command = match i {
                    0 => "M",
                    1 => "C",
                    _ => " ",
                };
                let _ = write!(text, "{command}{:.1} {:.1}", p.x, p.y);
            }
        }
        text
    }

    /// Returns the outline of a body, of a cuboid those of its faces in sight; nothing of a body without a size.
    fn outline(&self, shape: &BodyShape, pose: &Isometry3<f32>) -> String {
        let corners = corners(shape, pose, &self.axes);
        let place = |of: &[Vector3<f32>]| of.iter().map(|p| self.place(p)).collect();
        let mut text = String::new();
        let mut add = |polygon: Vec<Vector2<f32>>| {
            for (i, p) in polygon.iter().enumerate() {
                let _ = write!(text, "{}{:.1} {:.1}", if i == 0 { "M" } else { "L" }, p.x, p.y);
            }
            text.push_str(if polygon.is_empty() { "" } else { "Z" });
        };
        let BodyShape::Cuboid(_) = shape else {
            add(hull(place(&corners)));
            return text;
        };
        for axis in 0..3 {
            let normal = pose.rotation * Vector3::ith(axis, 1.0);
            // the four corners on the side in sight, around it
            let side = usize::from(normal.dot(&self.towards) < 0.0) << axis;
            let [u, v] = [1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3)];
            add(place(&[side, side | u, side | u | v, side | v].map(|i| corners[i])));
        }
        text
    }

    fn colour(&self, tension: f32) -> String {
        let [low, high] = self.tensions;
        let x = ((tension - low) / (high - low).max(1e-3 * high.abs()).max(1e-9)).clamp(0.0, 1.0) * 2.0;
        let i = (x as usize).min(1);
        let [r, g, b] = [0, 1, 2].map(|k| COLOURS[i][k] + (x - i as f32) * (COLOURS[i + 1][k] - COLOURS[i][k]));
        // in steps that the eye does not tell apart, so that a calm cable keeps its colour
        let [r, g, b] = [r, g, b].map(|c| ((c / 8.0).round() * 8.0).clamp(0.0, 255.0) as u8);
        format!("#{r:02x}{g:02x}{b:02x}")
    }
}

/// Returns points whose hull is the shape as one sees it along the normal of two axes, in the world.
fn corners(shape: &BodyShape, pose: &Isometry3<f32>, axes: &[Vector3<f32>; 2]) -> Vec<Vector3<f32>> {
    let circle = |centre: Vector3<f32>, [u, v]: [Vector3<f32>; 2], radius: f64| {
        (0..ROUND).map(move |k| {
            let (sin, cos) = (std::f32::consts::TAU * k as f32 / ROUND as f32).sin_cos();
            centre + (u * cos + v * sin) * radius as f32
        })
    };
    let own = |p: Vector3<f32>| pose.transform_point(&Point3::from(p)).coords;
    let ends = |half: f64| [1.0, -1.0].map(|side| own(Vector3::new(0.0, side * half as f32, 0.0)));
    match shape {
        BodyShape::None | BodyShape::Plane(_) => Vec::new(),
        BodyShape::Cuboid(half) => {
            let half = half.cast::<f32>();
            let corner = |i: usize| Vector3::from_fn(|k, _| if i >> k & 1 == 0 { half[k] } else { -half[k] });
            (0..8).map(|i| own(corner(i))).collect()
        }
        BodyShape::Ball(radius) => circle(own(Vector3::zeros()), *axes, *radius).collect(),
        BodyShape::Cylinder([half, radius]) => {
            let axes = [Vector3::x(), Vector3::z()].map(|axis| pose.rotation * axis);
            ends(*half).into_iter().flat_map(|end| circle(end, axes, *radius)).collect()
        }
        BodyShape::Capsule([half, radius]) => {
            ends(*half).into_iter().flat_map(|end| circle(end, *axes, *radius)).collect()
        }
        BodyShape::Mesh(mesh) => mesh.vertices.iter().map(|p| own(Vector3::from(p.map(|x| x as f32)))).collect(),
    }
}

/// Returns the convex hull of points, in order (Andrew 1979); nothing of fewer than three.
fn hull(mut points: Vec<Vector2<f32>>) -> Vec<Vector2<f32>> {
    points.retain(|p| p.iter().all(|x| x.is_finite()));
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    if points.len() < 3 {
        return Vec::new();
    }
    let half = |points: &mut dyn Iterator<Item = Vector2<f32>>| {
        let mut chain: Vec<Vector2<f32>> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..]
                && (b - a).perp(&(p - b)) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter().copied());
    hull.extend(half(&mut points.iter().rev().copied()));
    hull
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hull_of_a_box_is_its_outline() {
        let corner = |x: f32, y: f32| Vector2::new(x, y);
        let inside = vec![
            corner(0.0, 0.0),
            corner(2.0, 0.0),
            corner(1.0, 0.5),
            corner(2.0, 1.0),
            corner(0.0, 1.0),
            corner(1.0, 0.0),
        ];
        assert_eq!(hull(inside), [corner(0.0, 0.0), corner(2.0, 0.0), corner(2.0, 1.0), corner(0.0, 1.0)]);
        assert!(hull(vec![corner(0.0, 0.0); 2]).is_empty());
    }
}
