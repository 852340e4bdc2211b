//! What the contacts of a cable with bodies of its island add to the matrix of a step, beyond the
//! cable's own part.
//!
//! # Equation
//!
//! A contact with the tangent G at the shape functions S of the cable and the arm y about the
//! centre of the body sees the increments of the cable's coordinates and of the body's velocity and
//! rotation as `S du - J dw`, J = (1, -[y]x). Of all contacts of a cable with one body
//!
//! ```text
//! columns -sum S^T G J (six, however many contacts)        block sum J^T G J
//! ```

use nalgebra::{Matrix3, Matrix6, Vector3};

/// A body that the cable touches.
#[derive(Clone, Debug, Default)]
pub(crate) struct Border {
    /// Its index in the island.
    pub body: usize,
    /// Six columns of the cable's size, one after the other.
    pub columns: Vec<f64>,
    pub block: Matrix6<f64>,
}

/// The bodies that the cable touches.
#[derive(Clone, Debug, Default)]
pub(crate) struct Borders {
    list: Vec<Border>,
    count: usize,
    size: usize,
}

impl Borders {
    /// Begins anew for a cable with `size` coordinates.
    pub fn begin(&mut self, size: usize) {
        (self.count, self.size) = (0, size);
    }

    /// Returns the bodies, in the order in which they were met.
    pub fn get(&self) -> &[Border] {
        &self.list[..self.count]
    }

    /// Adds a contact of an element.
    pub fn add(&mut self, body: usize, element: usize, shape: &[f64; 4], tangent: &Matrix3<f64>, arm: &Vector3<f64>) {
        let size = self.size;
        let border = self.border(body);
        let parts = [*tangent, tangent * -arm.cross_matrix()];
        let turned = arm.cross_matrix();
        for (k, part) in parts.iter().enumerate() {
            for column in 0..3 {
                let out = &mut border.columns[(3 * k + column) * size + 6 * element..][..12];
                for (s, weight) in shape.iter().enumerate() {
                    for row in 0..3 {
                        out[3 * s + row] -= weight * part[(row, column)];
                    }
                }
            }
            // the transpose of -[y]x is [y]x
            let mut block = border.block.fixed_view_mut::<6, 3>(0, 3 * k);
            let mut upper = block.fixed_view_mut::<3, 3>(0, 0);
            upper += part;
            let mut lower = block.fixed_view_mut::<3, 3>(3, 0);
            lower += turned * part;
        }
    }

    fn border(&mut self, body: usize) -> &mut Border {
        let found = self.list[..self.count].iter().position(|border| border.body == body);
        let index = found.unwrap_or_else(|| {
            if self.count == self.list.len() {
                self.list.push(Border::default());
            }
            let new = &mut self.list[self.count];
            new.body = body;
            new.block = Matrix6::zeros();
            new.columns.clear();
            new.columns.resize(6 * self.size, 0.0);
            self.count += 1;
            self.count - 1
        });
        &mut self.list[index]
    }
}
