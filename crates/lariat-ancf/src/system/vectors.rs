//! Products of nodal vectors.

/// Returns the product of nodal vectors, summed by coordinate of the node first: one sum would wait
/// for every addition.
#[inline]
pub(crate) fn dot(x: &[f64], y: &[f64]) -> f64 {
    let ((x, _), (y, _)) = (x.as_chunks::<6>(), y.as_chunks::<6>());
    let mut sums = [0.0; 6];
    for (x, y) in x.iter().zip(y) {
        for k in 0..6 {
            sums[k] += x[k] * y[k];
        }
    }
    sums.iter().sum()
}
