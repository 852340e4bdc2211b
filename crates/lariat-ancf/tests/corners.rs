//! Cables drawn around corners start without strain, near the line that was drawn.

use lariat_ancf::coupling::Coupling;
use lariat_ancf::{At, Cable, CableBuilder, Section, Vector3};

const EA: f64 = 1e5;

/// Numbers in `0..1`, of a linear congruential generator (Knuth).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn unit(&mut self) -> Vector3<f64> {
        loop {
            let v = Vector3::new(self.next(), self.next(), self.next()) * 2.0 - Vector3::repeat(1.0);
            if (0.1..1.0).contains(&v.norm()) {
                return v.normalize();
            }
        }
    }
}

/// A polyline of 2 to 6 points whose corners turn by at most 150 degrees.
fn polyline(random: &mut Random) -> Vec<Vector3<f64>> {
    let count = 2 + (5.0 * random.next()) as usize;
    let (mut at, mut along) = (Vector3::zeros(), random.unit());
    let mut points = vec![at];
    for _ in 1..count {
        at += along * (0.3 + 1.7 * random.next());
        points.push(at);
        let axis = along.cross(&random.unit()).normalize();
        let turn = 150.0 * random.next();
        along = nalgebra::Rotation3::from_scaled_axis(axis * turn.to_radians()) * along;
    }
    points
}

fn rope(points: &[Vector3<f64>]) -> CableBuilder {
    Cable::builder().points(points.iter().copied()).section(Section::from_stiffness(EA, 0.0, 0.1).unwrap())
}

fn drawn(points: &[Vector3<f64>]) -> f64 {
    points.windows(2).map(|p| (p[1] - p[0]).norm()).sum()
}

/// The distance of a point from a polyline.
fn distance(points: &[Vector3<f64>], from: &Vector3<f64>) -> f64 {
    let to_segment = |p: &[Vector3<f64>]| {
        let along = p[1] - p[0];
        let share = ((from - p[0]).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
        (from - p[0] - along * share).norm()
    };
    points.windows(2).map(to_segment).fold(f64::INFINITY, f64::min)
}

/// Random polylines of 2 to 6 points with corners up to 150 degrees, 4 to 60 elements, 5 % stretched, as long as drawn or up to 30 % longer: beyond the
/// even stretch there is less than 1e-6 EA L, the ends are where they were drawn, and a cable that is not slack is near the line.
///
/// *Source.* An unstretched cable without bending stiffness has no energy; one that is evenly stretched by f has EA L (f^2 - 1)^2/8.
#[test]
fn a_cable_drawn_around_corners_has_no_strain_but_an_even_stretch() {
    let mut random = Random(7);
    let (mut most, mut farthest) = (0.0f64, 0.0f64);
    for case in 0..900 {
        let points = polyline(&mut random);
        let elements = 4 + (57.0 * random.next()) as usize;
        let share = [1.0 / 1.05, 1.0, 1.0 + 0.3 * random.next()][case % 3];
        let length = drawn(&points) * share;
        let cable = rope(&points).length(length).elements(elements).build().unwrap();
        let stretch = (1.0 / share).max(1.0);
        let even = 0.125 * (stretch * stretch - 1.0).powi(2);
        let energy = cable.energy().axial / (EA * length) - even;
        // a strain e beside the even one e_0 adds e_0 e + e^2/2: with e^2/2 = 1e-6, at most (Cauchy-Schwarz)
        let strain = 0.5 * (stretch * stretch - 1.0);
        let energy = energy / (1.0 + strain * 2e6f64.sqrt());
        assert!(energy.abs() < 1e-6, "case {case}: {energy:e} EA L");
        let last = points.len() - 1;
        let ends = [(0, 0), (elements, last)].map(|(node, point)| (cable.node_position(node) - points[point]).norm());
        assert!(ends[0].max(ends[1]) < 1e-14, "case {case}: {ends:?}");
        if share <= 1.0 {
            let off = |node| distance(&points, &cable.node_position(node));
            let off = (0..=elements).map(off).fold(0.0, f64::max) * elements as f64 / drawn(&points);
            assert!(off < 0.6, "case {case}: {off} elements");
            farthest = farthest.max(off);
        }
        most = most.max(energy);
    }
    println!("{most:.1e} EA L, {farthest:.2} elements");
}

/// A node that is held or asked for stays where it is drawn, and the parts of a cable that is cut at such a corner, for a sheave, are those of the drawing:
/// straight and unstrained.
///
/// *Source.* The drawing.
#[test]
fn a_corner_that_is_held_or_asked_for_stays() {
    let corner = Vector3::new(0.0, 1.5, 0.0);
    let points = [Vector3::new(-1.0, 0.0, 0.0), corner, Vector3::new(1.2, 0.0, 0.4)];
    let at = (points[1] - points[0]).norm();
    for builder in
        [rope(&points).node_at(at), rope(&points).fix(At::ArcLength(at)), rope(&points).clamp(At::ArcLength(at))]
    {
        let mut cable = builder.elements(11).build().unwrap();
        let node = cable.node(At::ArcLength(at)).unwrap();
        assert_eq!(cable.node_position(node), corner);
        let mut rest = cable.cut(at).unwrap();
        cable.open_corner(At::End);
        rest.open_corner(At::Start);
        for part in [&cable, &rest] {
            assert!(part.energy().axial < 1e-20 * EA, "{:e} J", part.energy().axial);
        }
    }
    // one beside a corner that is rounded: the parts are unstrained, too
    let bent = [points[0], corner, points[2], points[2] + Vector3::new(0.0, 0.0, 2.0)];
    let mut cable = rope(&bent).node_at(at).elements(20).build().unwrap();
    let mut rest = cable.cut(at).unwrap();
    cable.open_corner(At::End);
    rest.open_corner(At::Start);
    for part in [&cable, &rest] {
        assert!(part.energy().axial < 1e-6 * EA * part.length(), "{:e} J", part.energy().axial);
    }
}

/// A shape that is drawn so finely that it is hardly strained stays as it is drawn, to the bit.
#[test]
fn a_straight_line_of_many_points_and_a_fine_arc_stay_as_drawn() {
    let straight: Vec<_> = (0..7).map(|k| Vector3::new(f64::from(k) * 0.3, 0.0, 0.0)).collect();
    let cable = rope(&straight).elements(9).build().unwrap();
    for node in 0..=9 {
        let off = cable.node_position(node) - Vector3::new(0.2 * node as f64, 0.0, 0.0);
        assert!(off.norm() < 1e-15, "{off:?}");
    }
    let angle = |k: i32| 0.5 * f64::from(k) / 40.0;
    let arc: Vec<_> = (0..=40).map(|k| Vector3::new(angle(k).sin(), angle(k).cos(), 0.0)).collect();
    let cable = rope(&arc).elements(40).build().unwrap();
    for (node, point) in arc.iter().enumerate() {
        assert!((cable.node_position(node) - point).norm() < 1e-13, "{node}");
    }
}
