//! The closed form that textbooks give: eigenvalues by the arccosine, eigenvectors by cross products.

use nalgebra::{Matrix3, Vector3};

/// Eigenvalues, descending, of a symmetric matrix (Smith 1961).
#[must_use]
pub fn eigenvalues(a: &Matrix3<f64>) -> [f64; 3] {
    let mean = a.trace() / 3.0;
    let off = a.m12 * a.m12 + a.m13 * a.m13 + a.m23 * a.m23;
    let square = (a.m11 - mean).powi(2) + (a.m22 - mean).powi(2) + (a.m33 - mean).powi(2) + 2.0 * off;
    let p = (square / 6.0).sqrt();
    if p <= 0.0 {
        return [mean; 3];
    }
    let b = (a - Matrix3::identity() * mean) / p;
    let angle = (0.5 * b.determinant()).clamp(-1.0, 1.0).acos() / 3.0;
    let first = mean + 2.0 * p * angle.cos();
    let last = mean + 2.0 * p * (angle + 2.0 * core::f64::consts::FRAC_PI_3).cos();
    [first, 3.0 * mean - first - last, last]
}

/// Eigenvalues and eigenvectors by columns: those of the outer eigenvalues by the longest cross product of two rows
/// of A − λ1, the middle one across both; coordinate axes where the rows vanish.
#[must_use]
pub fn eigenpairs(a: &Matrix3<f64>) -> ([f64; 3], Matrix3<f64>) {
    let values = eigenvalues(a);
    let first = null_vector(a, values[0]).unwrap_or_else(Vector3::x);
    let last = null_vector(a, values[2]).unwrap_or_else(Vector3::z);
    let middle = last.cross(&first);
    (values, Matrix3::from_columns(&[first, middle, last]))
}

fn null_vector(a: &Matrix3<f64>, value: f64) -> Option<Vector3<f64>> {
    let shifted = a - Matrix3::identity() * value;
    let [x, y, z] = [shifted.column(0), shifted.column(1), shifted.column(2)];
    let products = [x.cross(&y), y.cross(&z), z.cross(&x)];
    let longest = products.into_iter().max_by(|v, w| v.norm_squared().total_cmp(&w.norm_squared()))?;
    longest.try_normalize(0.0)
}
