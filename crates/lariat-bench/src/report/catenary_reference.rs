//! A hanging cable without bending stiffness, solved by shooting, independently of the elements.
//!
//! # Equation
//! The energy per unstretched length is EA (f^2 - 1)^2/8, f = |r'|, so the section carries T = EA f
//! (f^2 - 1)/2: Green's law. With H and V(s) = V0 + w s the components of the section force, T =
//! |(H, V)|, dx/ds = f H/T and dy/ds = f V/T. Solved with adaptive Gauss quadrature in the arc
//! length and Newton's method on the force at one end.
//!
//! # Alternatives considered
//! Irvine's catenary has the law T = EA (f - 1), which is another material.

/// Returns the stretch f >= 0.6 with EA f (f^2 - 1)/2 - c f = tension (N), by Newton's method.
pub fn stretch(axial: f64, tension: f64, c: f64) -> f64 {
    let mut f = (1.0 + tension.max(0.0) / axial).cbrt().max(1.0);
    for _ in 0..100 {
        let residual = axial * f * (f * f - 1.0) / 2.0 - c * f - tension;
        let step = residual / (axial * (3.0 * f * f - 1.0) / 2.0 - c);
        f -= step;
        if step.abs() < 1e-16 {
            break;
        }
    }
    f
}

/// Gauss-Legendre abscissae and weights, 8 points on [-1, 1] (Abramowitz & Stegun 25.4.30).
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_27),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// Integrates a vector function by 8-point Gauss on halved intervals until two levels agree to
/// 1e-14.
fn integrate(f: &dyn Fn(f64) -> [f64; 2], a: f64, b: f64) -> [f64; 2] {
    let gauss = |a: f64, b: f64| {
        let (m, h) = (0.5 * (a + b), 0.5 * (b - a));
        GAUSS.iter().fold([0.0; 2], |sum, &(x, w)| {
            let (l, r) = (f(m - h * x), f(m + h * x));
            [sum[0] + w * h * (l[0] + r[0]), sum[1] + w * h * (l[1] + r[1])]
        })
    };
    fn halve(gauss: &dyn Fn(f64, f64) -> [f64; 2], a: f64, b: f64, whole: [f64; 2], depth: u32) -> [f64; 2] {
        let m = 0.5 * (a + b);
        let (l, r) = (gauss(a, m), gauss(m, b));
        let sum = [l[0] + r[0], l[1] + r[1]];
        if depth == 0 || (0..2).all(|k| (sum[k] - whole[k]).abs() < 1e-15 + 1e-14 * sum[k].abs()) {
            return sum;
        }
        let (l, r) = (halve(gauss, a, m, l, depth - 1), halve(gauss, m, b, r, depth - 1));
        [l[0] + r[0], l[1] + r[1]]
    }
    halve(&gauss, a, b, gauss(a, b), 40)
}

/// The catenary of Green's law.
#[derive(Clone, Copy, Debug)]
pub struct Catenary {
    /// EA in N.
    pub axial: f64,
    /// Weight per unstretched length in N/m.
    pub weight: f64,
    /// Unstretched length in m.
    pub length: f64,
    /// Horizontal force in N.
    pub h: f64,
    /// Vertical force at s = 0 in N; negative if the cable goes down from there.
    pub v0: f64,
}

impl Catenary {
    /// Returns the catenary through (0, 0) and (`dx`, `dy`), dx > 0, by Newton's method on (log H,
    /// V0) from the parabola, with step halving. [`Catenary::miss`] returns the error at its end.
    pub fn between(axial: f64, weight: f64, length: f64, dx: f64, dy: f64) -> Self {
        let slack = (length * length - dy * dy).max(0.0).sqrt();
        let h =
            if slack > dx { weight * dx / (2.0 * (6.0 * (slack / dx - 1.0)).sqrt().max(1e-3)) } else { 0.1 * axial };
        let mut c = Catenary { axial, weight, length, h, v0: -0.5 * weight * length + h * dy / dx };
        let miss = |c: &Catenary| c.miss(dx, dy);
        let size = |e: [f64; 2]| e[0].hypot(e[1]);
        let mut e = miss(&c);
        for _ in 0..200 {
            if size(e) < 1e-13 * length {
                return c;
            }
            let d = 1e-6;
            let (mut a, mut b) = (c, c);
            a.h *= 1.0 + d;
            b.v0 += d * weight * length;
            let (ea, eb) = (miss(&a), miss(&b));
            let j = [
                [(ea[0] - e[0]) / d, (eb[0] - e[0]) / (d * weight * length)],
                [(ea[1] - e[1]) / d, (eb[1] - e[1]) / (d * weight * length)],
            ];
            let det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
            let p = -(e[0] * j[1][1] - e[1] * j[0][1]) / det;
            let q = -(e[1] * j[0][0] - e[0] * j[1][0]) / det;
            let mut t = 1.0;
            loop {
                let mut next = c;
                next.h *= (t * p).clamp(-2.0, 2.0).exp();
                next.v0 += t * q;
                let after = miss(&next);
                if size(after) < size(e) || t < 1e-9 {
                    (c, e) = (next, after);
                    break;
                }
                t *= 0.5;
            }
        }
        c
    }

    /// Returns the distance in m, by component, of the end from (`dx`, `dy`).
    pub fn miss(&self, dx: f64, dy: f64) -> [f64; 2] {
        let [x, y] = self.at(self.length);
        [x - dx, y - dy]
    }

    /// Returns the tension T in N at an unstretched arc length.
    pub fn tension(&self, s: f64) -> f64 {
        self.h.hypot(self.v0 + self.weight * s)
    }

    /// Returns the position (x, y) in m at an unstretched arc length.
    pub fn at(&self, s: f64) -> [f64; 2] {
        let slope = |s: f64| {
            let t = self.tension(s);
            let f = stretch(self.axial, t, 0.0) / t;
            [f * self.h, f * (self.v0 + self.weight * s)]
        };
        // the sharp bend at V = 0 is an end of an interval
        let bottom = (-self.v0 / self.weight).clamp(0.0, s);
        let (a, b) = (integrate(&slope, 0.0, bottom), integrate(&slope, bottom, s));
        [a[0] + b[0], a[1] + b[1]]
    }
}
