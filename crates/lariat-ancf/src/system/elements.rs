//! The numbers of all elements of a cable, ready for the kernels.

use crate::Real;
use crate::effect::EffectWork;
use crate::effect::tables::ElementTables;
use crate::element::axial::AxialTable;
use crate::element::bending::gauss::Gauss;
use crate::element::bending::t1::T1;
use crate::element::bending::t2::T2;
use crate::element::bending::{Bending, NoBending};
use crate::element::gram::{Control, Six, Upper, gram, gram_rates};
use crate::element::kernel::{self, GramState, Stiffness};
use crate::element::mass;
use crate::model::Model;
use crate::rule::BendingRule;
use crate::section::Element;
use crate::simd::padded;

/// Layout: rows and columns, over (r_i, t_i, r_j, t_j), of the entries of the mass matrix that
/// lanes load.
const MASS_ENTRIES: [(usize, usize); 10] =
    [(0, 0), (0, 1), (1, 1), (2, 0), (2, 1), (3, 0), (3, 1), (2, 2), (2, 3), (3, 3)];

/// A bending rule with its numbers.
#[derive(Clone, Debug)]
pub(crate) enum BendingKernel {
    None(NoBending),
    T1(T1),
    T2(T2),
    Gauss(Gauss),
}

/// Runs `$body` with `$kernel` bound to the concrete bending rule.
macro_rules! with_bending {
    ($bending:expr, $kernel:ident => $body:expr) => {
        match $bending {
            BendingKernel::None($kernel) => $body,
            BendingKernel::T1($kernel) => $body,
            BendingKernel::T2($kernel) => $body,
            BendingKernel::Gauss($kernel) => $body,
        }
    };
}

/// The rule is chosen where it acts, once for a group of elements: a loop that was compiled for
/// each rule would repeat all the rest.
impl Bending for BendingKernel {
    fn energy(&self, g: &Six<f64>) -> f64 {
        with_bending!(self, rule => rule.energy(g))
    }
    #[inline(always)]
    fn add_gradient<T: Real>(&self, g: &Six<T>, scale: T, n: &mut Six<T>) {
        with_bending!(self, rule => rule.add_gradient(g, scale, n));
    }
    #[inline(always)]
    fn add_hessian<T: Real>(&self, g: &Six<T>, scale: T, n: &mut Six<T>, h: &mut Upper<T>) {
        with_bending!(self, rule => rule.add_hessian(g, scale, n, h));
    }
    #[inline(always)]
    fn add_discrete_gradient<T: Real>(&self, g: [&Six<T>; 2], scale: T, n: &mut Six<T>) {
        with_bending!(self, rule => rule.add_discrete_gradient(g, scale, n));
    }
}

/// The numbers of all elements, ready for the kernels.
#[derive(Clone, Debug)]
pub(crate) struct Elements {
    pub(super) table: AxialTable,
    pub(super) bending: BendingKernel,
    pub(super) count: usize,
    /// 3/l, EA l/4 and 2 EI/l by element, padded.
    pub(super) scale: Vec<f64>,
    pub(super) axial: Vec<f64>,
    pub(super) flexural: Vec<f64>,
    /// Entries of the element's mass matrix: (i, i) rr, rt, tt; (j, i) rr, rt, tr, tt; (j, j) rr,
    /// rt, tt. Padded likewise.
    pub(super) mass: [Vec<f64>; 10],
}

impl Elements {
    pub fn new(model: &Model) -> Self {
        let bending = match model.rule.bending {
            BendingRule::None => BendingKernel::None(NoBending),
            BendingRule::T1 => BendingKernel::T1(T1),
            BendingRule::T2 => BendingKernel::T2(T2::default()),
            BendingRule::Gauss(points) => BendingKernel::Gauss(Gauss::new(points as usize)),
        };
        let by_element = |f: &dyn Fn(&Element) -> f64| padded(model.elements.iter().map(f));
        Elements {
            table: model.rule.axial_table(),
            bending,
            count: model.elements.len(),
            scale: by_element(&|e| 3.0 / e.length),
            axial: by_element(&|e| 0.25 * model.axial_stiffness(e) * e.length),
            flexural: by_element(&|e| 2.0 * e.section.bending_stiffness / e.length),
            mass: MASS_ENTRIES
                .map(|(row, column)| by_element(&|e| mass::consistent(model.inertia(e), e.length)[row][column])),
        }
    }

    /// Sets the mass of element `e` to that of a length in m.
    pub fn set_mass(&mut self, e: usize, inertia: f64, length: f64) {
        let m = mass::consistent(inertia, length);
        for (list, (row, column)) in self.mass.iter_mut().zip(MASS_ENTRIES) {
            list[e] = m[row][column];
        }
    }

    /// Returns the number of elements.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Returns whether a bending rule runs.
    #[inline(always)]
    pub fn bends(&self) -> bool {
        !matches!(self.bending, BendingKernel::None(_))
    }

    /// Returns 3/l of element `e`.
    pub fn slope_scale(&self, e: usize) -> f64 {
        self.scale[e]
    }

    /// Returns the control vectors of element `e`.
    pub fn control(&self, e: usize, q: &[f64]) -> Control<f64> {
        self.control_at(e, q, self.scale[e])
    }

    /// Returns the control vectors of element `e` with 3/l given.
    pub fn control_at(&self, e: usize, q: &[f64], s: f64) -> Control<f64> {
        let n = &q[6 * e..6 * e + 12];
        [[n[3], n[4], n[5]], core::array::from_fn(|x| s * (n[6 + x] - n[x])), [n[9], n[10], n[11]]]
    }

    /// Returns axial and bending energy in J, without effects.
    pub fn energy(&self, q: &[f64]) -> (f64, f64) {
        let mut sum = (0.0, 0.0);
        for e in 0..self.count {
            let (d, stiffness) = (self.control(e, q), self.stiffness(e));
            let (axial, bending) =
                with_bending!(&self.bending, rule => kernel::energy(&self.table, rule, stiffness, &d));
            sum = (sum.0 + axial, sum.1 + bending);
        }
        sum
    }

    pub(super) fn stiffness(&self, e: usize) -> Stiffness<f64> {
        Stiffness { axial: self.axial[e], bending: self.flexural[e] }
    }

    /// Returns element `e` as effects see it, at nodal coordinates `q` and, unless that is empty,
    /// velocities `v`.
    pub fn gram_state(&self, e: usize, q: &[f64], v: &[f64]) -> GramState<'_, f64> {
        let d = self.control(e, q);
        let rates = (!v.is_empty()).then(|| gram_rates(&d, &self.control(e, v)));
        GramState { table: &self.table, stiffness: self.stiffness(e), g: gram(&d), rates }
    }

    /// Returns axial and bending energy in J that effects add.
    pub fn effect_energy(&self, effects: &ElementTables, q: &[f64]) -> (f64, f64) {
        let mut sum = (0.0, 0.0);
        for e in 0..self.count {
            let (axial, bending) = effects.energy(e, &self.gram_state(e, q, &[]));
            sum = (sum.0 + axial, sum.1 + bending);
        }
        sum
    }

    /// Adds the power in W that each effect gives to the elements.
    pub fn add_effect_power(&self, effects: &ElementTables, q: &[f64], v: &[f64], power: &mut EffectWork) {
        for e in 0..self.count {
            effects.add_power(&self.gram_state(e, q, v), &self.control(e, v), power);
        }
    }
}
