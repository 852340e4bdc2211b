//! A monolithic solution that shares with the island only the cable's force and mass matrix.
//!
//! The payload pendulum in its plane, in minimal coordinates: those of the cable except for its
//! ends, and (x, y, theta) of the body. With f the free coordinates of the cable and p the position
//! of its last node,
//!
//! ```text
//! p = x + rho,  p'' = x'' + theta'' (-rho_y, rho_x) - theta'^2 rho
//! M_ff f'' + M_fp p'' = F_f     R = F_p - M_pf f'' - M_pp p''     m x'' = m g + R     I theta'' = rho_x R_y - rho_y R_x
//! ```
//!
//! Dense matrices, the classical Runge-Kutta method of order 4, steps of a fraction of its
//! stability limit.

use super::bench::{Scene, payload};
use super::common::dense;
use lariat_ancf::coupling::Linearisation;
use lariat_ancf::{Cable, Integrator, Section};
use nalgebra::{DMatrix, DVector, Matrix3, Vector2, Vector3};

pub struct Reference {
    cable: Cable,
    mass: f64,
    inertia: f64,
    inverse: DMatrix<f64>,
    /// M_ff^-1 M_fp.
    y: DMatrix<f64>,
    mass_pf: DMatrix<f64>,
    /// M_pp - M_pf M_ff^-1 M_fp.
    mass_p: DMatrix<f64>,
    /// Free coordinates of the cable, then x, y, theta.
    pub q: DVector<f64>,
    pub v: DVector<f64>,
}

const ANCHOR: Vector2<f64> = Vector2::new(0.0, 0.1);

fn turned(theta: f64) -> Vector2<f64> {
    let (s, c) = theta.sin_cos();
    Vector2::new(c * ANCHOR.x - s * ANCHOR.y, s * ANCHOR.x + c * ANCHOR.y)
}

impl Reference {
    pub fn new(section: Section, mass: f64) -> Self {
        let Scene { mut cables, bodies, .. } = payload(section, mass, Integrator::default());
        let mut cable = cables.remove(0);
        let m = dense(&cable.mass_matrix());
        let last = cable.nodes() - 1;
        // the position of the first node is held, that of the last follows the body: 3 coordinates
        // before, 6 after the free
        let free: Vec<usize> = (3..6 * last).chain(6 * last + 3..6 * last + 6).collect();
        let pinned: Vec<usize> = (6 * last..6 * last + 3).collect();
        let part = |rows: &[usize], columns: &[usize]| {
            DMatrix::from_fn(rows.len(), columns.len(), |r, c| m[(rows[r], columns[c])])
        };
        let inverse = part(&free, &free).try_inverse().unwrap();
        let mass_pf = part(&pinned, &free);
        let y = &inverse * part(&free, &pinned);
        let mass_p = part(&pinned, &pinned) - &mass_pf * &y;
        let n = free.len();
        let mut q = DVector::zeros(n + 3);
        q.rows_mut(0, n).copy_from(&DVector::from_iterator(n, free.iter().map(|&i| cable.positions()[i])));
        let body = &bodies[0];
        q[n] = body.position.x;
        q[n + 1] = body.position.y;
        let inertia = body.inertia[(2, 2)];
        Reference { cable, mass, inertia, inverse, y, mass_pf, mass_p, v: q.clone() * 0.0, q }
    }

    fn acceleration(&mut self, q: &DVector<f64>, v: &DVector<f64>, all: &mut [f64], force: &mut [f64]) -> DVector<f64> {
        let n = q.len() - 3;
        let rho = turned(q[n + 2]);
        let size = all.len();
        // force does not depend on velocity
        all[3..size - 6].copy_from_slice(&q.as_slice()[..size - 9]);
        all[size - 6] = q[n] + rho.x;
        all[size - 5] = q[n + 1] + rho.y;
        all[size - 3..].copy_from_slice(&q.as_slice()[size - 9..n]);
        let zero = vec![0.0; size];
        self.cable.set_coordinates(all, &zero).unwrap();
        self.cable.evaluate(force);
        let mut f = DVector::zeros(n);
        f.rows_mut(0, size - 9).copy_from_slice(&force[3..size - 6]);
        f.rows_mut(size - 9, 3).copy_from_slice(&force[size - 3..]);
        let free = &self.inverse * f;
        let f_p = Vector3::from_column_slice(&force[size - 6..size - 3]) - &self.mass_pf * &free;
        // R = f_p - S p'', planar
        let s = self.mass_p.fixed_view::<2, 2>(0, 0).into_owned();
        let lever = Vector2::new(-rho.y, rho.x);
        let centripetal = -rho * v[n + 2] * v[n + 2];
        let push = f_p.xy() - s * centripetal;
        let mut a = Matrix3::zeros();
        a.fixed_view_mut::<2, 2>(0, 0).copy_from(&s);
        a[(0, 0)] += self.mass;
        a[(1, 1)] += self.mass;
        let coupling = s * lever;
        for i in 0..2 {
            a[(i, 2)] = coupling[i];
            a[(2, i)] = coupling[i];
        }
        a[(2, 2)] = self.inertia + lever.dot(&coupling);
        let rhs = Vector3::new(push.x, push.y - 9.81 * self.mass, lever.dot(&push));
        let body = a.lu().solve(&rhs).unwrap();
        let p = body.xy() + lever * body.z + centripetal;
        let mut k = DVector::zeros(n + 3);
        k.rows_mut(0, n).copy_from(&(free - &self.y * Vector3::new(p.x, p.y, 0.0)));
        k.rows_mut(n, 3).copy_from(&body);
        k
    }

    /// Runs for `duration` (s) with steps of `share` of 2.8 / omega_max, the limit of the method.
    pub fn run(&mut self, duration: f64, share: f64) {
        let steps = (duration * self.cable.frequency_bound() / (2.8 * share)).ceil();
        let h = duration / steps;
        let mut all = self.cable.positions().to_vec();
        let mut force = all.clone();
        for _ in 0..steps as usize {
            let (q, v) = (self.q.clone(), self.v.clone());
            let k1 = self.acceleration(&q, &v, &mut all, &mut force);
            let v2 = &v + &k1 * (0.5 * h);
            let k2 = self.acceleration(&(&q + &v * (0.5 * h)), &v2, &mut all, &mut force);
            let v3 = &v + &k2 * (0.5 * h);
            let k3 = self.acceleration(&(&q + &v2 * (0.5 * h)), &v3, &mut all, &mut force);
            let v4 = &v + &k3 * h;
            let k4 = self.acceleration(&(&q + &v3 * h), &v4, &mut all, &mut force);
            self.q += (v + (v2 + v3) * 2.0 + v4) * (h / 6.0);
            self.v += (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0);
        }
    }

    /// Centre of the body (m) and its angle (rad).
    pub fn body(&self) -> Vector3<f64> {
        let n = self.q.len() - 3;
        Vector3::new(self.q[n], self.q[n + 1], self.q[n + 2])
    }
}
