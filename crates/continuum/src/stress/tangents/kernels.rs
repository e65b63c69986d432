//! Kernels of the tangents on arrays: two-stage contractions, inlined, so that they run in lanes.

use piola_numerics::Real;
use piola_numerics::linear::matrix3::dot;
use piola_tensor::internal::fourth::{congruence_matrix, transform_major};
use piola_tensor::internal::rows::Rows;
use piola_tensor::{PAIR, SLOT, Slots};

use crate::Symmetric;

/// `F_iA F_jB F_kC F_lD C_ABCD` of a tangent with all symmetries, as the 21 components of its upper triangle.
///
/// 396 products: see [`fourth::kernels`](piola_tensor::internal::fourth).
///
/// # Example
/// ```
/// use piola_continuum::internal::tangents::push_forward;
/// let f = [[2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// assert_eq!(push_forward(f, &[1.0; 21])[0], 16.0);
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn push_forward<T: Real>(f: Rows<T>, material: &[T; 21]) -> [T; 21] {
    transform_major(&congruence_matrix(f), material)
}

/// ∂P/∂F = `δ_ij S_AB + F_iC F_jD C_CADB`, row 3i + A and column 3j + B.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first_piola_tangent<T: Real>(f: Rows<T>, stress: &Symmetric<T>, material: &Slots<T>) -> [[T; 9]; 9] {
    let s = stress.rows();
    let mut tangent = [[T::zero(); 9]; 9];
    for a in 0..3 {
        let columns = [&material[SLOT[0][a]], &material[SLOT[1][a]], &material[SLOT[2][a]]];
        for i in 0..3 {
            let half = half_contracted(f[i], columns);
            let row = &mut tangent[3 * i + a];
            // Written out as `half`.
            macro_rules! entries {
                ($($j:literal $b:literal),*) => { $(
                    row[3 * $j + $b] = dot(f[$j], [half[SLOT[0][$b]], half[SLOT[1][$b]], half[SLOT[2][$b]]]);
                )* };
            }
            entries!(0 0, 0 1, 0 2, 1 0, 1 1, 1 2, 2 0, 2 1, 2 2);
            row[3 * i] += s[a][0];
            row[3 * i + 1] += s[a][1];
            row[3 * i + 2] += s[a][2];
        }
    }
    tangent
}

/// `F_iC C_CA(DB)` for the six pairs (DB), of row i of F and three rows of C. Written out: of a loop over pairs of eight
/// lanes the compiler makes one over pairs, which gathers and scatters the lanes.
#[cfg_attr(not(debug_assertions), inline(always))]
fn half_contracted<T: Real>(f: [T; 3], [x, y, z]: [&[T; 6]; 3]) -> [T; 6] {
    macro_rules! all {
        ($($k:literal)*) => { [$(f[0] * x[$k] + f[1] * y[$k] + f[2] * z[$k]),*] };
    }
    all!(0 1 2 3 4 5)
}

/// ∂S/∂E of ∂P/∂F: `F⁻¹_Ci F⁻¹_Dj (A_iAjB − δ_ij S_AB)`, the mean over exchanges of indices within the pairs.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn material_tangent<T: Real>(inverse: Rows<T>, stress: &Symmetric<T>, tangent: &[[T; 9]; 9]) -> Slots<T> {
    let (s, half, quarter) = (stress.rows(), T::lit(0.5), T::lit(0.25));
    // Twice the mean over (C, A): rows are pairs, columns (j, B).
    let mut first = [[T::zero(); 9]; 6];
    for (row, (c, a)) in first.iter_mut().zip(PAIR) {
        for (column, entry) in row.iter_mut().enumerate() {
            let (j, b) = (column / 3, column % 3);
            let term = |c: usize, a: usize| {
                let at = |i: usize| {
                    let entry = tangent[3 * i + a][column];
                    if i == j { entry - s[a][b] } else { entry }
                };
                dot(inverse[c], [at(0), at(1), at(2)])
            };
            *entry = if c == a { term(c, a) + term(c, a) } else { term(c, a) + term(a, c) };
        }
    }
    let mut result = [[T::zero(); 6]; 6];
    for (row, first) in result.iter_mut().zip(&first) {
        for (entry, (d, b)) in row.iter_mut().zip(PAIR) {
            let term = |d: usize, b: usize| dot(inverse[d], [first[b], first[3 + b], first[6 + b]]);
            *entry = if d == b { half * term(d, b) } else { quarter * (term(d, b) + term(b, d)) };
        }
    }
    result
}

/// c/J of ∂P/∂F: `F_jA F_lB A_iAkB/J − δ_ik T_jl` at i ≤ j, the mean over the exchange of k and l.
///
/// Its parts are functions: closures are not inlined into lanes, which doubles the time.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn spatial_tangent<T: Real>(f: Rows<T>, volume: T, stress: &Symmetric<T>, tangent: &[[T; 9]; 9]) -> Slots<T> {
    let (scale, half) = (volume.recip(), T::lit(0.5));
    let g = [scaled(f[0], scale), scaled(f[1], scale), scaled(f[2], scale)];
    let [x, y, z] = [block(&g, tangent, 0, half), block(&g, tangent, 1, half), block(&g, tangent, 2, half)];
    let mut rows = [
        half_contracted(f[0], [&x[0], &x[1], &x[2]]),
        half_contracted(f[1], [&y[0], &y[1], &y[2]]),
        half_contracted(f[2], [&z[0], &z[1], &z[2]]),
        half_contracted(f[1], [&x[0], &x[1], &x[2]]),
        half_contracted(f[2], [&y[0], &y[1], &y[2]]),
        half_contracted(f[2], [&x[0], &x[1], &x[2]]),
    ];
    let [t11, t22, t33, t12, t23, t13] = stress.components;
    let [h22, h33, h12, h23, h13] = [half * t22, half * t33, half * t12, half * t23, half * t13];
    // ½ (`δ_ik T_jl + δ_il T_jk`).
    rows[0][0] -= t11;
    rows[0][3] -= h12;
    rows[0][5] -= h13;
    rows[1][1] -= t22;
    rows[1][3] -= h12;
    rows[1][4] -= h23;
    rows[2][2] -= t33;
    rows[2][4] -= h23;
    rows[2][5] -= h13;
    rows[3][0] -= t12;
    rows[3][3] -= h22;
    rows[3][5] -= h23;
    rows[4][1] -= t23;
    rows[4][3] -= h13;
    rows[4][4] -= h33;
    rows[5][0] -= t13;
    rows[5][3] -= h23;
    rows[5][5] -= h33;
    rows
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn scaled<T: Real>(row: [T; 3], scale: T) -> [T; 3] {
    [row[0] * scale, row[1] * scale, row[2] * scale]
}

/// `A_iAkB F_lB` of row (i, A).
#[cfg_attr(not(debug_assertions), inline(always))]
fn along<T: Real>(g: [T; 3], row: &[T; 9], k: usize) -> T {
    g[0] * row[3 * k] + g[1] * row[3 * k + 1] + g[2] * row[3 * k + 2]
}

/// The same for the six pairs (k, l).
#[cfg_attr(not(debug_assertions), inline(always))]
fn contracted<T: Real>(g: &Rows<T>, row: &[T; 9], half: T) -> [T; 6] {
    [
        along(g[0], row, 0),
        along(g[1], row, 1),
        along(g[2], row, 2),
        half * (along(g[1], row, 0) + along(g[0], row, 1)),
        half * (along(g[2], row, 1) + along(g[1], row, 2)),
        half * (along(g[2], row, 0) + along(g[0], row, 2)),
    ]
}

/// The same for the three rows of i.
#[cfg_attr(not(debug_assertions), inline(always))]
fn block<T: Real>(g: &Rows<T>, tangent: &[[T; 9]; 9], i: usize, half: T) -> [[T; 6]; 3] {
    [
        contracted(g, &tangent[3 * i], half),
        contracted(g, &tangent[3 * i + 1], half),
        contracted(g, &tangent[3 * i + 2], half),
    ]
}
