//! The twist of elements against identities and differences.

use super::check::Check;
use super::curve::Curve;
use super::element::{COORDINATES, TwistChange, node_step, twist_gradient, twist_hessian};
use super::lengths::Lengths;
use super::pair::change;
use super::segment::Segment;
use super::stranded::{elongation, elongation_gradient, elongation_hessian};
use crate::effect::Torsion;
use crate::element::shape;
use crate::linalg::BlockTridiagonal;
use crate::quadrature::gauss_legendre;
use crate::section::Element;
use nalgebra::{UnitQuaternion, Vector3};

const LENGTH: f64 = 0.7;

/// What the twist of an element by itself changes over a step.
fn twist_change(q: &[f64], step: &[f64], lengths: [f64; 2], secant: &mut [f64]) -> TwistChange {
    let [x, y] = [0..6, 6..12].map(|node| node_step(&q[node.clone()], &step[node]));
    super::element::twist_change(q, step, [&x, &y], lengths, secant)
}

fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// A straight element with slopes off by `size`, positions by a quarter of it in lengths.
fn element(size: f64, next: &mut impl FnMut() -> f64) -> [f64; COORDINATES] {
    core::array::from_fn(|i| match i {
        0..3 => 0.25 * size * LENGTH * next(),
        6..9 => LENGTH * (f64::from(u8::from(i == 6)) + 0.25 * size * next()),
        _ => f64::from(u8::from(i % 6 == 3)) + size * next(),
    })
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn vector(x: &[f64]) -> Vector3<f64> {
    Vector3::new(x[0], x[1], x[2])
}

/// The angle in rad that is left of the twist of an element when directors are carried along it.
fn determinant_share(q: &[f64]) -> f64 {
    let (x, y) = (vector(&q[3..]), vector(&q[9..]));
    let m = (vector(&q[6..]) - vector(q)) * (1.5 / LENGTH) - (x + y) * 0.25;
    let [x, m, y] = [x, m, y].map(|d| d.normalize());
    x.dot(&m.cross(&y)) / 6.0
}

/// Carries a director by the smallest rotation of a direction.
fn carry(director: Vector3<f64>, from: Vector3<f64>, to: Vector3<f64>) -> Vector3<f64> {
    UnitQuaternion::rotation_between(&from, &to).unwrap() * director
}

/// The secant times the change is the change of the twist, for any step, crumpled elements and
/// slips included.
///
/// *Source.* The identity on which the energy law rests.
#[test]
fn the_secant_is_exact() {
    let mut next = random(3);
    let mut slips = 0;
    for size in [0.1, 0.4, 1.0, 3.0, 10.0] {
        for _ in 0..500 {
            let (q, step) = (element(size, &mut next), element(size, &mut next));
            let step: Vec<f64> = step.iter().zip(&q).map(|(a, b)| a - b).collect();
            let mut c = [0.0; COORDINATES];
            let found = twist_change(&q, &step, [LENGTH; 2], &mut c);
            slips += found.slips;
            let scale: f64 = c.iter().zip(&step).map(|(c, d)| (c * d).abs()).sum();
            assert!((dot(&c, &step) - found.angle).abs() <= 1e-14 * scale.max(1.0), "{size}: {found:?}");
            // the length changes, too
            let last = LENGTH * (1.0 + 0.5 * next());
            let found = twist_change(&q, &step, [LENGTH, last], &mut c);
            let along = dot(&c, &step) + found.by_length * (last - LENGTH);
            let scale: f64 = c.iter().zip(&step).map(|(c, d)| (c * d).abs()).sum::<f64>() + found.by_length.abs();
            assert!((along - found.angle).abs() <= 1e-14 * scale.max(1.0), "{size}: {found:?}");
        }
    }
    assert!(slips > 100, "no step that turns too far was tried");
}

/// Gradient and Hessian are the derivatives of the change along straight lines.
///
/// *Source.* Central differences; a direction that is displaced along a line moves on a great
/// circle, so the exact change has no holonomy of its own.
#[test]
fn gradient_and_hessian_are_derivatives_of_the_change() {
    let mut next = random(5);
    for size in [0.2, 0.5] {
        for _ in 0..200 {
            let (q, along): (_, [f64; COORDINATES]) = (element(size, &mut next), core::array::from_fn(|_| next()));
            let by = |h: f64| {
                let step: Vec<f64> = along.iter().map(|x| h * x).collect();
                twist_change(&q, &step, [LENGTH; 2], &mut [0.0; COORDINATES]).angle
            };
            let mut g = [0.0; COORDINATES];
            twist_gradient(&q, LENGTH, &mut g);
            let h = 1e-4;
            let first = (8.0 * (by(h) - by(-h)) - (by(2.0 * h) - by(-2.0 * h))) / (12.0 * h);
            assert!((dot(&g, &along) - first).abs() < 1e-8 * (1.0 + first.abs()), "{} {first}", dot(&g, &along));
            let blocks = twist_hessian(&q, LENGTH, 1.0);
            let form: f64 = (0..4)
                .flat_map(|a| (0..=a).map(move |b| (a, b)))
                .map(|(a, b)| {
                    let value = vector(&along[3 * a..]).dot(&(blocks[a][b] * vector(&along[3 * b..])));
                    if a == b { value } else { 2.0 * value }
                })
                .sum();
            let h = 1e-3;
            let second = |h: f64| (by(h) + by(-h)) / (h * h);
            let second = (4.0 * second(0.5 * h) - second(h)) / 3.0;
            assert!((form - second).abs() < 1e-5 * (1.0 + second.abs()), "{form} {second}");
        }
    }
}

/// A change of the mesh that leaves the curve adds to the twist what the elements see of it more,
/// a high power of their length; one that moves nodes adds what the exact changes say.
///
/// *Source.* De Casteljau's halves of a cubic; exact changes of the same elements.
#[test]
fn a_change_of_the_mesh_adds_what_the_curve_does() {
    let mut next = random(19);
    let section = crate::Section::from_stiffness(1e3, 1.0, 0.1).unwrap();
    let mut seen = Vec::new();
    // slopes stay where their directions are not regularised
    for size in [0.2, 0.1, 0.05] {
        let mut worst = 0.0f64;
        for _ in 0..200 {
            let q = element(size, &mut next);
            let whole = Curve { lengths: vec![LENGTH], q: q.to_vec() };
            let [r, t] = [shape::position(0.5, LENGTH), shape::slope(0.5, LENGTH)];
            let at = |s: [f64; 4]| (0..3).map(move |x| (0..4).map(|k| s[k] * q[3 * k + x]).sum::<f64>());
            let middle = at(r).chain(at(t));
            let nodes = q[..6].iter().copied().chain(middle).chain(q[6..].iter().copied()).collect();
            let halves = Curve { lengths: vec![0.5 * LENGTH; 2], q: nodes };
            worst = worst.max(whole.change_to(&halves).abs());
            // the slopes at both ends stay
            let mut moved = halves.clone();
            (6..12).for_each(|i| moved.q[i] += 0.2 * size * next());
            let elements = [0, 1].map(|_| Element { length: 0.5 * LENGTH, section });
            let step: Vec<f64> = moved.q.iter().zip(&halves.q).map(|(a, b)| a - b).collect();
            let segment = Segment { nodes: [0, 2], stiffness: 1.0, strands: None, rest: 0.0 };
            let found = segment.change(&Lengths::fixed(&elements), &halves.q, &step, &mut Vec::new());
            let by_curve = halves.change_to(&moved);
            assert!((found.angle - by_curve).abs() < 1e-13, "{size}: {found:?}, {by_curve}");
        }
        println!("{size}: {worst:.2e} rad");
        seen.push(worst);
    }
    // three slopes and three curvatures of them: of third order in the size, odd in all
    assert!(seen[2] < 0.3 * seen[1] && seen[1] < 0.3 * seen[0] && seen[2] < 1e-3, "{seen:?}");
}

/// A rigid rotation of the element changes its twist by what its ends turn about themselves: sum q
/// cross g = x - y. Turning everything changes no twist, and reversing the element keeps it.
///
/// *Source.* Frame indifference; a right-handed helix is right-handed from both ends.
#[test]
fn twist_is_frame_indifferent_and_has_no_direction() {
    let mut next = random(7);
    for _ in 0..200 {
        let (q, other) = (element(0.4, &mut next), element(0.4, &mut next));
        let mut g = [0.0; COORDINATES];
        twist_gradient(&q, LENGTH, &mut g);
        let moment: Vector3<f64> = (0..4).map(|k| vector(&q[3 * k..]).cross(&vector(&g[3 * k..]))).sum();
        let ends = vector(&q[3..]).normalize() - vector(&q[9..]).normalize();
        assert!((moment - ends).norm() < 1e-13, "{moment} {ends}");
        let angle = |q: &[f64], to: &[f64]| {
            let step: Vec<f64> = to.iter().zip(q).map(|(a, b)| a - b).collect();
            twist_change(q, &step, [LENGTH; 2], &mut [0.0; COORDINATES]).angle
        };
        let turn = UnitQuaternion::from_scaled_axis(Vector3::new(next(), next(), next()) * 3.0);
        let turned = |q: &[f64]| q.chunks(3).flat_map(|x| <[f64; 3]>::from(turn * vector(x))).collect::<Vec<_>>();
        let reversed = |q: &[f64]| {
            let (position, slope) = (|k: usize| vector(&q[k..]), |k: usize| -vector(&q[k..]));
            [position(6), slope(9), position(0), slope(3)].into_iter().flat_map(<[f64; 3]>::from).collect::<Vec<_>>()
        };
        assert!((angle(&turned(&q), &turned(&other)) - angle(&q, &other)).abs() < 1e-13);
        assert!((angle(&reversed(&q), &reversed(&other)) - angle(&q, &other)).abs() < 1e-13);
    }
}

/// After 1000 random moves the sum of all increments is still the angle between the directors of
/// both ends, modulo a full turn.
///
/// *Source.* Directors carried by smallest rotations, along the element and at its ends.
#[test]
fn twist_does_not_drift() {
    let mut next = random(11);
    let mut q = element(0.3, &mut next);
    let middle =
        |q: &[f64]| (vector(&q[6..]) - vector(q)) * (1.5 / LENGTH) - (vector(&q[3..]) + vector(&q[9..])) * 0.25;
    let angle = |q: &[f64], first: Vector3<f64>, last: Vector3<f64>| {
        let (x, y) = (vector(&q[3..]), vector(&q[9..]));
        let along = carry(carry(first, x, middle(q)), middle(q), y);
        along.cross(&last).dot(&y.normalize()).atan2(along.dot(&last)) - determinant_share(q)
    };
    let normal = |d: Vector3<f64>| d.cross(&Vector3::new(0.3, -0.2, 0.9)).normalize();
    let (mut first, mut last) = (normal(vector(&q[3..])), normal(vector(&q[9..])));
    let start = angle(&q, first, last);
    let mut twist = 0.0;
    for _ in 0..1000 {
        let to = element(0.35, &mut next);
        let step: Vec<f64> = to.iter().zip(&q).map(|(a, b)| a - b).collect();
        let found = twist_change(&q, &step, [LENGTH; 2], &mut [0.0; COORDINATES]);
        assert_eq!(found.slips, 0);
        twist += found.angle;
        first = carry(first, vector(&q[3..]), vector(&to[3..]));
        last = carry(last, vector(&q[9..]), vector(&to[9..]));
        q = to;
    }
    let off = (angle(&q, first, last) - start - twist).rem_euclid(std::f64::consts::TAU);
    assert!(off.min(std::f64::consts::TAU - off) < 1e-12, "{off:e}");
    // an octant of the sphere has the area pi/2
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let octant = change([&x, &z], [&y, &z]).angle;
    assert!((octant.abs() - std::f64::consts::FRAC_PI_2).abs() < 1e-15, "{octant}");
}

/// The elongation of an element is the integral of its Green strain; its gradient at the mean is
/// an exact secant, and its Hessian what that changes by.
///
/// *Source.* Gauss's rule of five points, exact to degree 9, on a polynomial of degree 4; it is
/// quadratic in the coordinates.
#[test]
fn elongation_is_the_integral_of_the_strain_with_an_exact_secant() {
    let mut next = random(23);
    for _ in 0..200 {
        let (q, to) = (element(0.5, &mut next), element(0.5, &mut next));
        let slope = |xi: f64| {
            let weights = shape::slope(xi, LENGTH);
            (0..4).map(|k| vector(&q[3 * k..]) * weights[k]).sum::<Vector3<f64>>()
        };
        let exact: f64 = gauss_legendre(5)
            .iter()
            .map(|(xi, weight)| weight * LENGTH * 0.5 * (slope(*xi).norm_squared() - 1.0))
            .sum();
        assert!((elongation(&q, LENGTH) - exact).abs() < 1e-14, "{exact}");
        let step: Vec<f64> = to.iter().zip(&q).map(|(a, b)| a - b).collect();
        let [mut secant, mut first, mut last] = [[0.0; COORDINATES]; 3];
        elongation_gradient(|i| q[i] + 0.5 * step[i], LENGTH, 1.0, &mut secant);
        let change = elongation(&to, LENGTH) - elongation(&q, LENGTH);
        assert!((dot(&secant, &step) - change).abs() < 1e-14, "{change}");
        elongation_gradient(|i| q[i], LENGTH, 1.0, &mut first);
        elongation_gradient(|i| to[i], LENGTH, 1.0, &mut last);
        for i in 0..COORDINATES {
            let by_hessian: f64 = (0..4).map(|k| elongation_hessian(i / 3, k, LENGTH) * step[3 * k + i % 3]).sum();
            assert!((last[i] - first[i] - by_hessian).abs() < 1e-14, "{i}: {by_hessian}");
        }
    }
}

/// The matrix of a segment, bordered by its gradient, is the derivative of its force, of a rope
/// whose tension makes torque, too; the force that of the energy.
///
/// *Source.* Central differences.
#[test]
fn the_bordered_matrix_of_a_segment_is_the_derivative_of_its_force() {
    let mut next = random(29);
    let sections = [900.0, 1500.0, 700.0].map(|axial| crate::Section::from_stiffness(axial, 1.0, 0.1).unwrap());
    let elements = sections.map(|section| Element { length: LENGTH, section });
    for per_tension in [0.0, 0.03, -0.2] {
        let torsion = Torsion { torque_per_tension: per_tension, ..Torsion::new(0.8) };
        let segment = Segment::between(&torsion, None, &elements, [0, 3]);
        for _ in 0..20 {
            let node =
                |i: usize| if i.is_multiple_of(6) { LENGTH * (i / 6) as f64 } else { f64::from(u8::from(i % 6 == 3)) };
            let q: Vec<f64> = (0..24).map(|i| node(i) + 0.15 * next()).collect();
            let along: Vec<f64> = (0..24).map(|_| next()).collect();
            let twist = 4.0 * next();
            let (mut buffer, mut gradient) = (Vec::new(), Vec::new());
            let mut at = |h: f64| {
                let step: Vec<f64> = along.iter().map(|x| h * x).collect();
                let to: Vec<f64> = q.iter().zip(&step).map(|(a, b)| a + b).collect();
                let twist = twist + segment.change(&Lengths::fixed(&elements), &q, &step, &mut buffer).angle;
                segment.gradient(&elements, &to, &mut gradient);
                let torque = segment.torque(&elements, &to, twist);
                let energy = 0.5 * segment.stiffness * segment.loaded(&elements, &to, twist).powi(2);
                (energy, gradient.iter().map(|g| torque * g).collect::<Vec<f64>>())
            };
            let h = 1e-5;
            let ((_, force), (above, f1), (below, f0)) = (at(0.0), at(h), at(-h));
            let by_energy = (above - below) / (2.0 * h);
            assert!((dot(&force, &along) - by_energy).abs() < 1e-6 * (1.0 + by_energy.abs()), "{by_energy}");
            let mut matrix = BlockTridiagonal::zeros(4);
            let torque = segment.torque(&elements, &q, twist);
            segment.add_hessian(&Lengths::fixed(&elements), |i| q[i], torque, &mut matrix);
            segment.gradient(&elements, &q, &mut gradient);
            let border = segment.stiffness * dot(&gradient, &along);
            let mut product: Vec<f64> = gradient.iter().map(|g| border * g).collect();
            for n in 0..4 {
                for (r, c) in (0..6).flat_map(|r| (0..6).map(move |c| (r, c))) {
                    product[6 * n + r] += matrix.diag[n].0[c][r] * along[6 * n + c];
                    if n < 3 {
                        product[6 * n + 6 + r] += matrix.lower[n].0[c][r] * along[6 * n + c];
                        product[6 * n + c] += matrix.lower[n].0[c][r] * along[6 * n + 6 + r];
                    }
                }
            }
            let scale = product.iter().fold(1.0f64, |most, x| most.max(x.abs()));
            // the holonomy of the frames at both ends is not in the symmetric matrix
            for i in (0..24).filter(|i| !(3..6).contains(i) && !(21..24).contains(i)) {
                let exact = (f1[i] - f0[i]) / (2.0 * h);
                assert!((product[i] - exact).abs() < 1e-6 * scale, "{per_tension}, {i}: {} {exact}", product[i]);
            }
        }
    }
}

/// The coordinates of elements in a row whose slopes at nodes and in the middle have the given
/// directions.
fn coordinates(nodes: &[Vector3<f64>], middles: &[Vector3<f64>]) -> Vec<f64> {
    let (mut r, mut q) = (Vector3::zeros(), Vec::new());
    for (n, t) in nodes.iter().enumerate() {
        q.extend(r.iter().chain(t.iter()));
        if let (Some(m), Some(next)) = (middles.get(n), nodes.get(n + 1)) {
            r += (m + (t + next) * 0.25) * (LENGTH / 1.5);
        }
    }
    q
}

/// A change in one call is what it is in parts along the same great circles, by up to 175 degrees;
/// what turns further away from its neighbour than 120 is counted, in parts as at once.
///
/// *Source.* The area of a geodesic quadrilateral is the sum of those of its parts.
#[test]
fn a_change_that_no_step_makes_is_the_sum_of_its_parts() {
    let mut next = random(31);
    let section = crate::Section::from_stiffness(1e3, 1.0, 0.1).unwrap();
    let elements = [0, 1, 2].map(|_| Element { length: LENGTH, section });
    let segment = Segment { nodes: [0, 3], stiffness: 1.0, strands: None, rest: 0.0 };
    let (mut by_steps, mut sharp) = (0, 0);
    for degrees in [20.0f64, 100.0, 150.0, 175.0] {
        for run in 0..100 {
            let mut direction = || Vector3::new(2.0, next(), next()).normalize();
            let starts: [Vector3<f64>; 7] = core::array::from_fn(|_| direction());
            // the last runs turn one of them the other way
            let about: [Vector3<f64>; 7] = core::array::from_fn(|k| {
                let axis = Vector3::new(0.1 * next(), 1.0, next());
                let across = (axis - starts[k] * axis.dot(&starts[k])).normalize();
                if run >= 90 && k == 3 { -across } else { across }
            });
            let at = |share: f64| {
                let now: Vec<Vector3<f64>> = starts
                    .iter()
                    .zip(&about)
                    .map(|(d, axis)| UnitQuaternion::from_scaled_axis(axis * (share * degrees.to_radians())) * d)
                    .collect();
                coordinates(&now[..4], &now[4..])
            };
            let once = segment.follow(&elements, [&at(0.0), &at(1.0)]);
            let parts: Vec<(f64, u64)> = (0..50)
                .map(|k| segment.follow(&elements, [&at(f64::from(k) / 50.0), &at(f64::from(k + 1) / 50.0)]))
                .collect();
            let (angle, slips) = parts.iter().fold((0.0, 0), |sum, part| (sum.0 + part.0, sum.1 + part.1));
            assert_eq!(once.1 > 0, slips > 0, "{degrees}, {run}: {once:?} {slips}");
            if slips == 0 {
                assert!((once.0 - angle).abs() < 1e-12, "{degrees}, {run}: {once:?} {angle}");
            }
            sharp += u64::from(slips > 0 && run >= 90);
            let step: Vec<f64> = at(1.0).iter().zip(at(0.0)).map(|(a, b)| a - b).collect();
            by_steps += segment.change(&Lengths::fixed(&elements), &at(0.0), &step, &mut Vec::new()).slips;
        }
    }
    // one step would not follow it
    assert!(by_steps > 100 && sharp > 10, "{by_steps} {sharp}");
}

/// What slips on the way between two shapes is lost only if the twist is another one for it.
///
/// *Source.* Directors carried by smallest rotations.
#[test]
fn twist_that_comes_back_is_not_lost() {
    let section = crate::Section::from_stiffness(1e3, 1.0, 0.1).unwrap();
    let elements = [0, 1].map(|_| Element { length: LENGTH, section });
    let segment = Segment { nodes: [0, 2], stiffness: 1.0, strands: None, rest: 0.0 };
    let direction = |x: f64, y: f64, z: f64| Vector3::new(x, y, z).normalize();
    let [a, b] = [direction(1.0, 0.3, 0.0), direction(1.0, 0.0, 0.4)];
    let folded = [direction(-1.0, 0.4, 0.1), direction(0.2, -1.0, 0.3), direction(-0.3, 0.2, 1.0)];
    let shape = |x: Vector3<f64>| coordinates(&[a, x, b], &[direction(1.0, 0.1, 0.2), direction(1.0, -0.1, 0.3)]);
    let straight = shape(direction(1.0, 0.2, 0.2));
    let curve = |q: &[f64]| Curve::between([0, 2], &elements, q);
    let (mut lost, mut kept) = (0, 0);
    for way in [vec![0], vec![0, 1], vec![0, 1, 2], vec![1, 0, 2]] {
        let mut check = Check::of(&curve(&straight));
        let (mut before, mut slips) = (straight.clone(), 0);
        let ends = way.iter().map(|k| shape(folded[*k])).chain([straight.clone()]);
        let mut sum = 0.0;
        for q in ends {
            let change = segment.follow(&elements, [&before, &q]);
            check.follow(&curve(&q), change);
            (slips, sum, before) = (slips + change.1, sum + change.0, q);
        }
        assert!(slips > 0, "{way:?} does not slip");
        // the directors of both ends, which stay, say what the sum is: none, or whole turns
        let off = (sum + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
        assert_eq!(check.lost(&curve(&before)) > 0, off.abs() > 1e-6, "{way:?} {off}");
        if off.abs() > 1e-6 { lost += 1 } else { kept += 1 }
    }
    assert!(lost > 0 && kept > 0, "{lost} {kept}");
}
