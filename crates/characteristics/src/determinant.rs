//! Small determinants over any scalar, and orthogonal bases of a few vectors.

use piola_numerics::Real;

/// The determinant of an m×m matrix by rows, which is destroyed.
pub(super) fn determinant<T: Real>(rows: &mut [T], m: usize) -> T {
    match m {
        1 => rows[0],
        2 => rows[0] * rows[3] - rows[1] * rows[2],
        3 => {
            rows[0] * (rows[4] * rows[8] - rows[5] * rows[7]) - rows[1] * (rows[3] * rows[8] - rows[5] * rows[6])
                + rows[2] * (rows[3] * rows[7] - rows[4] * rows[6])
        }
        _ => eliminate(rows, m),
    }
}

fn eliminate<T: Real>(rows: &mut [T], m: usize) -> T {
    let mut product = T::one();
    for k in 0..m {
        let mut pivot = k;
        for i in k + 1..m {
            if rows[pivot * m + k].primal(0).abs() < rows[i * m + k].primal(0).abs() {
                pivot = i;
            }
        }
        if pivot != k {
            for j in 0..m {
                rows.swap(k * m + j, pivot * m + j);
            }
            product = -product;
        }
        let diagonal = rows[k * m + k];
        product *= diagonal;
        if diagonal.primal(0).abs() <= 0.0 {
            // The matrix of values is singular: without another pivot only the value is known, and it is zero.
            return product;
        }
        for i in k + 1..m {
            let weight = rows[i * m + k] / diagonal;
            for j in k + 1..m {
                let above = rows[k * m + j];
                rows[i * m + j] -= weight * above;
            }
        }
    }
    product
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(super) fn norm(a: &[f64]) -> f64 {
    let largest = a.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
    if largest <= 0.0 || !largest.is_finite() {
        return largest;
    }
    largest * a.iter().map(|a| (a / largest) * (a / largest)).sum::<f64>().sqrt()
}

/// An orthonormal basis of k vectors in m dimensions, A = R Q by rows with R lower triangular, and for k = m − 1 the
/// unit normal.
#[derive(Clone, Debug)]
pub(super) struct Basis {
    /// k rows of m.
    pub(super) q: Vec<f64>,
    /// k×k, lower triangular, by rows.
    pub(super) r: Vec<f64>,
    /// The unit normal with 0 < det(normal, vectors) where k = m − 1.
    pub(super) normal: Vec<f64>,
    k: usize,
    m: usize,
}

impl Basis {
    /// Of the rows `a`; the index and the share left of the first that depends on those before, if one does.
    pub(super) fn new(a: &[f64], m: usize) -> Result<Self, (usize, f64)> {
        /// Twice: once is not enough where the rows nearly depend.
        const PASSES: usize = 2;
        /// What is left of a row that depends on others is rounding.
        const DEPENDENT: f64 = 1e-13;
        let k = a.len() / m;
        let (mut q, mut r) = (a.to_vec(), vec![0.0; k * k]);
        for i in 0..k {
            let length = norm(&a[i * m..(i + 1) * m]);
            for _ in 0..PASSES {
                for j in 0..i {
                    let (before, row) = q.split_at_mut(i * m);
                    let part = dot(&before[j * m..(j + 1) * m], &row[..m]);
                    r[i * k + j] += part;
                    for (row, before) in row[..m].iter_mut().zip(&before[j * m..]) {
                        *row -= part * before;
                    }
                }
            }
            let left = norm(&q[i * m..(i + 1) * m]);
            if left.is_nan() || left <= DEPENDENT * length {
                return Err((i, if 0.0 < length { left / length } else { 0.0 }));
            }
            r[i * k + i] = left;
            q[i * m..(i + 1) * m].iter_mut().for_each(|q| *q /= left);
        }
        let mut basis = Self { q, r, normal: vec![0.0; m], k, m };
        if k + 1 == m {
            basis.find_normal(a);
        }
        Ok(basis)
    }

    fn find_normal(&mut self, a: &[f64]) {
        let (k, m) = (self.k, self.m);
        // The coordinate axis that has least in the span.
        let share = |i: usize| (0..k).map(|j| self.q[j * m + i] * self.q[j * m + i]).sum::<f64>();
        let axis = (0..m).fold(0, |best, i| if share(i) < share(best) { i } else { best });
        let mut normal = vec![0.0; m];
        normal[axis] = 1.0;
        for _ in 0..2 {
            for row in self.q.chunks(m) {
                let part = dot(row, &normal);
                normal.iter_mut().zip(row).for_each(|(n, q)| *n -= part * q);
            }
        }
        let length = norm(&normal);
        let mut rows: Vec<f64> = normal.iter().chain(a).copied().collect();
        let sign = if determinant(&mut rows, m) < 0.0 { -1.0 } else { 1.0 };
        for n in &mut normal {
            *n *= sign / length;
        }
        self.normal = normal;
    }

    /// The shortest ξ with A ξ = b: R y = b, ξ = Qᵀ y.
    pub(super) fn shortest(&self, b: &[f64]) -> Vec<f64> {
        let (k, m) = (self.k, self.m);
        let mut y = b.to_vec();
        for i in 0..k {
            let known: f64 = (0..i).map(|j| self.r[i * k + j] * y[j]).sum();
            y[i] = (y[i] - known) / self.r[i * k + i];
        }
        (0..m).map(|i| (0..k).map(|j| self.q[j * m + i] * y[j]).sum()).collect()
    }

    /// The coefficients a of the combination Σ aᵢ Aᵢ nearest to v: Rᵀ a = Q v.
    pub(super) fn coefficients(&self, v: &[f64]) -> Vec<f64> {
        let (k, m) = (self.k, self.m);
        let mut a: Vec<f64> = self.q.chunks(m).map(|q| dot(q, v)).collect();
        for i in (0..k).rev() {
            let known: f64 = (i + 1..k).map(|j| self.r[j * k + i] * a[j]).sum();
            a[i] = (a[i] - known) / self.r[i * k + i];
        }
        a
    }

    /// The volume of the rows, √det A Aᵀ.
    pub(super) fn volume(&self) -> f64 {
        (0..self.k).map(|i| self.r[i * self.k + i]).product()
    }
}
