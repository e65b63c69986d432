//! P and ∂P/∂F as numbers one after the other, for `Lanewise`.

use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{Deformation, FirstPiola};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{from_rows, rows_of};
use piola_tensor::FourthOrder;
use piola_tensor::internal::rows::Rows;

// Written out: loops within the loop over lanes would keep that from becoming vectors.

/// F and ∇u, nine numbers each.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn of_deformation<T: Real>(deformation: &impl Deformation<T>) -> [T; 18] {
    let [[a, b, c], [d, e, f], [g, h, i]] = deformation.gradient_rows();
    let [[j, k, l], [m, n, o], [p, q, r]] = deformation.displacement_rows();
    [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r]
}

/// F and ∇u of their numbers.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn gradients<T: Real>(numbers: [T; 18]) -> [Rows<T>; 2] {
    let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r] = numbers;
    [[[a, b, c], [d, e, f], [g, h, i]], [[j, k, l], [m, n, o], [p, q, r]]]
}

/// One more number.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn with_jacobian<T: Real>(numbers: [T; 18], jacobian: T) -> [T; 19] {
    let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r] = numbers;
    [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, jacobian]
}

/// F, ∇u and J of their numbers.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn gradients_and_jacobian<T: Real>(numbers: [T; 19]) -> ([Rows<T>; 2], T) {
    let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, jacobian] = numbers;
    (gradients([a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r]), jacobian)
}

/// P as nine numbers.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn of_stress<T: Real>(stress: Rows<T>) -> [T; 9] {
    let [[a, b, c], [d, e, f], [g, h, i]] = stress;
    [a, b, c, d, e, f, g, h, i]
}

/// P of its numbers.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn stress<T: Real>([a, b, c, d, e, f, g, h, i]: [T; 9]) -> FirstPiola<T> {
    FirstPiola(from_rows([[a, b, c], [d, e, f], [g, h, i]]))
}

/// P and the upper triangle of ∂P/∂F, 9 and 45 numbers.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn of_both<T: Real>(p: Rows<T>, a: &[[T; 9]; 9]) -> [T; 54] {
    [
        p[0][0], p[0][1], p[0][2], p[1][0], p[1][1], p[1][2], p[2][0], p[2][1], p[2][2], a[0][0], a[0][1], a[0][2],
        a[0][3], a[0][4], a[0][5], a[0][6], a[0][7], a[0][8], a[1][1], a[1][2], a[1][3], a[1][4], a[1][5], a[1][6],
        a[1][7], a[1][8], a[2][2], a[2][3], a[2][4], a[2][5], a[2][6], a[2][7], a[2][8], a[3][3], a[3][4], a[3][5],
        a[3][6], a[3][7], a[3][8], a[4][4], a[4][5], a[4][6], a[4][7], a[4][8], a[5][5], a[5][6], a[5][7], a[5][8],
        a[6][6], a[6][7], a[6][8], a[7][7], a[7][8], a[8][8],
    ]
}

/// P and the upper triangle of ∂P/∂F.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn of_pair<T: Real>((stress, tangent): (FirstPiola<T>, FirstPiolaTangent<T>)) -> [T; 54] {
    of_both(rows_of(&stress.0), &tangent.0.components)
}

/// One number more at the end.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn with_one_more<T: Real>(n: [T; 54], last: T) -> [T; 55] {
    [
        n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8], n[9], n[10], n[11], n[12], n[13], n[14], n[15], n[16],
        n[17], n[18], n[19], n[20], n[21], n[22], n[23], n[24], n[25], n[26], n[27], n[28], n[29], n[30], n[31], n[32],
        n[33], n[34], n[35], n[36], n[37], n[38], n[39], n[40], n[41], n[42], n[43], n[44], n[45], n[46], n[47], n[48],
        n[49], n[50], n[51], n[52], n[53], last,
    ]
}

/// The last number apart.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn without_last<T: Real>(n: [T; 55]) -> ([T; 54], T) {
    let numbers = [
        n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8], n[9], n[10], n[11], n[12], n[13], n[14], n[15], n[16],
        n[17], n[18], n[19], n[20], n[21], n[22], n[23], n[24], n[25], n[26], n[27], n[28], n[29], n[30], n[31], n[32],
        n[33], n[34], n[35], n[36], n[37], n[38], n[39], n[40], n[41], n[42], n[43], n[44], n[45], n[46], n[47], n[48],
        n[49], n[50], n[51], n[52], n[53],
    ];
    (numbers, n[54])
}

/// P and ∂P/∂F of their numbers.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn both<T: Real>(n: [T; 54]) -> (FirstPiola<T>, FirstPiolaTangent<T>) {
    let components = [
        [n[9], n[10], n[11], n[12], n[13], n[14], n[15], n[16], n[17]],
        [n[10], n[18], n[19], n[20], n[21], n[22], n[23], n[24], n[25]],
        [n[11], n[19], n[26], n[27], n[28], n[29], n[30], n[31], n[32]],
        [n[12], n[20], n[27], n[33], n[34], n[35], n[36], n[37], n[38]],
        [n[13], n[21], n[28], n[34], n[39], n[40], n[41], n[42], n[43]],
        [n[14], n[22], n[29], n[35], n[40], n[44], n[45], n[46], n[47]],
        [n[15], n[23], n[30], n[36], n[41], n[45], n[48], n[49], n[50]],
        [n[16], n[24], n[31], n[37], n[42], n[46], n[49], n[51], n[52]],
        [n[17], n[25], n[32], n[38], n[43], n[47], n[50], n[52], n[53]],
    ];
    let first_piola = FirstPiola(from_rows([[n[0], n[1], n[2]], [n[3], n[4], n[5]], [n[6], n[7], n[8]]]));
    (first_piola, FirstPiolaTangent(FourthOrder { components }))
}

/// A numbers and B numbers after them; C is A + B.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn joined<T: Copy, const A: usize, const B: usize, const C: usize>(first: &[T; A], then: &[T; B]) -> [T; C] {
    let mut all = [first[0]; C];
    let mut k = 0;
    while k < C {
        all[k] = if k < A { first[k] } else { then[k - A] };
        k += 1;
    }
    all
}
