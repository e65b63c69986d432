//! A yardstick for polar decompositions and tensor logarithms, and deformations that are hard to decompose.
//!
//! The reference is the plainest method in twice the precision: C = `FᵀF`, or 2E = C − 1 of ∇u, from exact products,
//! its eigenvectors by cyclic two-sided rotations of Jacobi, and everything else from these. It shares nothing
//! with the methods it judges. With 31 digits a stretch ratio of 10⁸ leaves 15.
//!
//! ```
//! use piola_testkit::spectral::{adversarial_set, polar_reference};
//! // A simple shear by 1.5: its stretches are 2, 1 and ½.
//! let reference = polar_reference([[1.0, 1.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
//! assert_eq!(reference.stretches, [2.0, 1.0, 0.5]);
//! assert!(adversarial_set().iter().all(|case| case.condition < 2e8));
//! ```

use nalgebra::{one, zero};
use piola_numerics::Real;

use crate::DoubleDouble;

/// A 3×3 array of rows.
pub type Rows<T> = [[T; 3]; 3];

/// R, U, V and the logarithms of a deformation, computed with 31 digits and rounded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolarReference {
    /// λ₁ ≥ λ₂ ≥ λ₃.
    pub stretches: [f64; 3],
    /// ln λₖ.
    pub log_stretches: [f64; 3],
    /// R.
    pub rotation: Rows<f64>,
    /// U.
    pub right_stretch: Rows<f64>,
    /// U − 1.
    pub right_stretch_less_one: Rows<f64>,
    /// V.
    pub left_stretch: Rows<f64>,
    /// ln U.
    pub hencky_material: Rows<f64>,
    /// ln V.
    pub hencky_spatial: Rows<f64>,
}

/// The reference of F, which is taken as exact.
#[must_use]
pub fn polar_reference(gradient: Rows<f64>) -> PolarReference {
    let f = gradient.map(|row| row.map(DoubleDouble::lit));
    reference(f, map2(|i, j| if i == j { f[i][j] - one() } else { f[i][j] }))
}

/// The reference of ∇u, which is taken as exact.
#[must_use]
pub fn polar_reference_of_displacement(displacement: Rows<f64>) -> PolarReference {
    let h = displacement.map(|row| row.map(DoubleDouble::lit));
    reference(map2(|i, j| if i == j { h[i][j] + one() } else { h[i][j] }), h)
}

/// Eigenvalues, descending, and eigenvectors by rows of a symmetric matrix, by cyclic rotations of Jacobi.
#[must_use]
pub fn eigenpairs(matrix: Rows<DoubleDouble>) -> ([DoubleDouble; 3], Rows<DoubleDouble>) {
    let mut a = matrix;
    let mut vectors = map2(|i, j| if i == j { one() } else { zero::<DoubleDouble>() });
    for _ in 0..60 {
        let mut rotated = false;
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let size = a[p][p].abs().primal(0).max(a[q][q].abs().primal(0));
            if a[p][q].abs().primal(0) <= 1e-40 * size {
                continue;
            }
            rotated = true;
            let theta = (a[q][q] - a[p][p]) / (a[p][q] + a[p][q]);
            let root = (theta * theta + one()).sqrt();
            let t = if theta.abs().primal(0) < 1e150 { one::<DoubleDouble>() / (theta.abs() + root) } else { zero() };
            let t = t.copysign(theta);
            let c = one::<DoubleDouble>() / (t * t + one()).sqrt();
            let s = t * c;
            for row in &mut a {
                let (x, y) = (row[p], row[q]);
                (row[p], row[q]) = (c * x - s * y, s * x + c * y);
            }
            for k in 0..3 {
                let (x, y) = (a[p][k], a[q][k]);
                (a[p][k], a[q][k]) = (c * x - s * y, s * x + c * y);
                let (x, y) = (vectors[p][k], vectors[q][k]);
                (vectors[p][k], vectors[q][k]) = (c * x - s * y, s * x + c * y);
            }
            (a[p][q], a[q][p]) = (zero(), zero());
        }
        if !rotated {
            break;
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(
        |&i, &j| {
            if a[j][j].less_than(a[i][i]) { core::cmp::Ordering::Less } else { core::cmp::Ordering::Greater }
        },
    );
    (order.map(|k| a[k][k]), order.map(|k| vectors[k]))
}

/// Σ f(λₖ) vₖ ⊗ vₖ of a symmetric matrix, rounded.
#[must_use]
pub fn function_reference(matrix: Rows<f64>, f: impl Fn(DoubleDouble) -> DoubleDouble) -> Rows<f64> {
    let (values, vectors) = eigenpairs(matrix.map(|row| row.map(DoubleDouble::lit)));
    rounded(&dyads(values.map(f), &vectors, &vectors))
}

fn map2<T>(f: impl Fn(usize, usize) -> T) -> Rows<T> {
    core::array::from_fn(|i| core::array::from_fn(|j| f(i, j)))
}

fn rounded(a: &Rows<DoubleDouble>) -> Rows<f64> {
    a.map(|row| row.map(|x| x.primal(0)))
}

/// Σ fₖ pₖ ⊗ qₖ.
fn dyads(f: [DoubleDouble; 3], p: &Rows<DoubleDouble>, q: &Rows<DoubleDouble>) -> Rows<DoubleDouble> {
    map2(|i, j| f[0] * p[0][i] * q[0][j] + f[1] * p[1][i] * q[1][j] + f[2] * p[2][i] * q[2][j])
}

fn reference(f: Rows<DoubleDouble>, h: Rows<DoubleDouble>) -> PolarReference {
    let two = DoubleDouble::lit(2.0);
    let twice_green = map2(|i, j| h[i][j] + h[j][i] + (h[0][i] * h[0][j] + h[1][i] * h[1][j] + h[2][i] * h[2][j]));
    // Small strain from 2E, where C would cancel; anything else from C, where a small stretch would be lost in 1 + 2E.
    let small = twice_green.as_flattened().iter().all(|x| x.abs().primal(0) < 0.5);
    let square = map2(|i, j| f[0][i] * f[0][j] + f[1][i] * f[1][j] + f[2][i] * f[2][j]);
    let (values, material) = eigenpairs(if small { twice_green } else { square });
    let stretches = values.map(|x| if small { (x + one()).sqrt() } else { x.sqrt() });
    let excess: [DoubleDouble; 3] = core::array::from_fn(|k| {
        let less_one = if small { values[k] } else { values[k] - one() };
        less_one / (stretches[k] + one())
    });
    let logs = values.map(|x| if small { x.ln_1p() / two } else { x.ln() / two });
    // R q = F q/λ, orthogonal to 31 digits less those of the stretch ratio.
    let spatial: Rows<DoubleDouble> = core::array::from_fn(|k| {
        let q = material[k];
        core::array::from_fn(|i| (f[i][0] * q[0] + f[i][1] * q[1] + f[i][2] * q[2]) / stretches[k])
    });
    let ones = [one::<DoubleDouble>(); 3];
    PolarReference {
        stretches: stretches.map(|x| x.primal(0)),
        log_stretches: logs.map(|x| x.primal(0)),
        rotation: rounded(&dyads(ones, &spatial, &material)),
        right_stretch: rounded(&dyads(stretches, &material, &material)),
        right_stretch_less_one: rounded(&dyads(excess, &material, &material)),
        left_stretch: rounded(&dyads(stretches, &spatial, &spatial)),
        hencky_material: rounded(&dyads(logs, &material, &material)),
        hencky_spatial: rounded(&dyads(logs, &spatial, &spatial)),
    }
}

/// A deformation that is hard to decompose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdversarialCase {
    /// In which way.
    pub kind: &'static str,
    /// F.
    pub gradient: Rows<f64>,
    /// λ₁/λ₃, about.
    pub condition: f64,
}

/// Numbers of each kind in the set.
const EACH: usize = 160;

/// Pseudorandom numbers that are the same everywhere: Vigna's `SplitMix64`.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The sequence of a seed.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// A number of [−1, 1).
    pub fn symmetric(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z >> 11) as f64 * 2.0_f64.powi(-52) - 1.0
    }

    /// A matrix with entries of [−1, 1).
    pub fn matrix(&mut self) -> Rows<f64> {
        let mut rows = [[0.0; 3]; 3];
        for entry in rows.as_flattened_mut() {
            *entry = self.symmetric();
        }
        rows
    }

    /// A random rotation matrix, of all angles.
    pub fn rotation(&mut self) -> Rows<f64> {
        loop {
            let q: [f64; 4] = core::array::from_fn(|_| self.symmetric());
            let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
            if 0.1 < length && length < 1.0 {
                return crate::strategies::rotation_matrix(q.map(|x| x / length));
            }
        }
    }
}

fn product(a: &Rows<f64>, b: &Rows<f64>) -> Rows<f64> {
    map2(|i, j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j])
}

/// P diag(λ) Qᵀ.
#[must_use]
pub fn with_stretches(p: &Rows<f64>, stretches: [f64; 3], q: &Rows<f64>) -> Rows<f64> {
    map2(|i, j| (0..3).map(|k| p[i][k] * stretches[k] * q[j][k]).sum())
}

/// Deformations that are hard to decompose, the same in every run: ordinary ones, near the identity
/// (10⁻² … 10⁻¹⁴), gaps between stretches of 10⁻⁶ … 10⁻¹³, exact coalescence, stretch ratios up to 10⁸, near half
/// turns, simple shears, pure rotations, small and large volumes.
///
/// All have 0 < det F.
#[must_use]
pub fn adversarial_set() -> Vec<AdversarialCase> {
    let mut random = Random::new(2026);
    let mut set = Vec::with_capacity(10 * EACH);
    for number in 0..EACH {
        let share = number as f64 / (EACH - 1) as f64;
        let (p, q) = (random.rotation(), random.rotation());
        let mut add = |kind, gradient: Rows<f64>, condition| set.push(AdversarialCase { kind, gradient, condition });

        let ordinary = core::array::from_fn(|_| (1.1 * random.symmetric()).exp());
        add("ordinary", with_stretches(&p, ordinary, &q), 10.0);

        let size = 10.0_f64.powf(-2.0 - 12.0 * share);
        let a = random.matrix();
        let near = map2(|i, j| f64::from(u8::from(i == j)) + size * a[i][j]);
        add("near identity", near, 1.0 + 4.0 * size);

        let gap = 10.0_f64.powf(-6.0 - 7.0 * share);
        let (base, other) = (1.0 + 0.5 * random.symmetric(), 1.0 + 0.5 * random.symmetric());
        add("small gap", with_stretches(&p, [base * (1.0 + gap), base, other], &q), 3.0);
        add("uniaxial", with_stretches(&p, [base, base, other], &p), 3.0);
        add("isotropic", p.map(|row| row.map(|x| base * x)), 1.0);

        let ratio = 10.0_f64.powf(0.5 + 7.5 * share);
        let middle = ratio.powf(0.5 * (1.0 + random.symmetric()));
        let bottom = ratio.powf(-0.5);
        add("large ratio", with_stretches(&p, [bottom * ratio, bottom * middle, bottom], &q), ratio);
        add("large ratio, two small", with_stretches(&p, [bottom * ratio, bottom * (1.0 + gap), bottom], &q), ratio);

        // A half turn less a little, after a stretch.
        let angle = core::f64::consts::PI - 10.0_f64.powf(-1.0 - 8.0 * share);
        let half = 0.5 * angle;
        let axis = p[0];
        let (s, c) = half.sin_cos();
        let turn = crate::strategies::rotation_matrix([c, s * axis[0], s * axis[1], s * axis[2]]);
        add("half turn", product(&turn, &with_stretches(&q, ordinary, &q)), 10.0);
        add("pure rotation", turn, 1.0);

        let shear = 10.0_f64.powf(-8.0 + 11.0 * share);
        let mut simple = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        simple[number % 3][(number + 1) % 3] = shear;
        add("simple shear", simple, 1.0 + shear * shear);

        let scale = 10.0_f64.powf(60.0 * (share - 0.5));
        add("volume", with_stretches(&p, ordinary, &q).map(|row| row.map(|x| scale * x)), 10.0);
    }
    set
}
