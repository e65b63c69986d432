//! The coefficients, compared with the conditions that define them in 31 digits.

use piola_numerics::Real;
use piola_stiff::RadauOrder;
use piola_stiff::internal::Tableau;
use piola_testkit::DoubleDouble;

type Matrix = Vec<Vec<DoubleDouble>>;

fn lit(x: f64) -> DoubleDouble {
    DoubleDouble::lit(x)
}

fn rows(entries: &[f64], s: usize) -> Matrix {
    entries.chunks(s).map(|row| row.iter().map(|&x| lit(x)).collect()).collect()
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let s = a.len();
    let entry = |i: usize, j: usize| (0..s).fold(lit(0.0), |sum, k| sum + a[i][k] * b[k][j]);
    (0..s).map(|i| (0..s).map(|j| entry(i, j)).collect()).collect()
}

/// Λ.
fn blocks(tableau: &Tableau) -> Matrix {
    let s = tableau.stages();
    let mut out = vec![vec![lit(0.0); s]; s];
    out[0][0] = lit(tableau.real);
    for (pair, &[alpha, beta]) in tableau.pairs.iter().enumerate() {
        let (k, alpha, beta) = (2 * pair + 1, lit(alpha), lit(beta));
        (out[k][k], out[k][k + 1], out[k + 1][k], out[k + 1][k + 1]) = (alpha, beta, -beta, alpha);
    }
    out
}

fn runge_kutta_matrix(tableau: &Tableau) -> Matrix {
    rows(tableau.matrix, tableau.stages())
}

fn power(c: f64, k: usize) -> DoubleDouble {
    (0..k).fold(lit(1.0), |product, _| product * lit(c))
}

/// What rounding of the stored doubles may leave.
fn assert_zero(what: &str, value: DoubleDouble) {
    let value = value.primal(0);
    assert!(value.abs() < 2e-15, "{what}: {value:e}");
}

fn tableaux() -> impl Iterator<Item = &'static Tableau> {
    RadauOrder::ALL.into_iter().map(RadauOrder::tableau)
}

/// `P_s − P_{s−1}` on [0, 1] by the recurrence of Legendre's polynomials.
fn radau_polynomial(s: usize, c: f64) -> DoubleDouble {
    let x = lit(2.0) * lit(c) - lit(1.0);
    let (mut before, mut p) = (lit(1.0), x);
    for k in 1..s {
        let m = k as f64;
        (before, p) = (p, (lit(2.0 * m + 1.0) * x * p - lit(m) * before) / lit(m + 1.0));
    }
    p - before
}

#[test]
fn nodes_are_zeros_of_the_radau_polynomial() {
    for tableau in tableaux() {
        let s = tableau.stages();
        for &c in tableau.nodes {
            assert_zero("P_s - P_(s-1)", radau_polynomial(s, c));
            // Next to the node the polynomial has another sign.
            let [left, right] = [c - 1e-13, c + 1e-13].map(|c| radau_polynomial(s, c).primal(0));
            assert!(left * right < 0.0, "{s} stages at {c}");
        }
        assert!(tableau.nodes.is_sorted());
        assert_eq!(tableau.nodes.last(), Some(&1.0));
    }
}

#[test]
fn transformation_times_its_inverse_is_one() {
    for tableau in tableaux() {
        let s = tableau.stages();
        let one = product(&rows(tableau.transformation, s), &rows(tableau.inverse, s));
        for (i, row) in one.iter().enumerate() {
            for (j, &entry) in row.iter().enumerate() {
                // Entries of T⁻¹ are as large as 300.
                assert_zero("T T⁻¹", (entry - lit(if i == j { 1.0 } else { 0.0 })) * lit(1.0 / 64.0));
            }
        }
    }
}

/// A T Λ = T: the transformation brings A⁻¹ to its real blocks.
#[test]
fn transformation_brings_the_inverse_of_a_to_blocks() {
    for tableau in tableaux() {
        let s = tableau.stages();
        let t = rows(tableau.transformation, s);
        let image = product(&product(&runge_kutta_matrix(tableau), &t), &blocks(tableau));
        for (image, t) in image.iter().flatten().zip(t.iter().flatten()) {
            assert_zero("A T Λ − T", *image - *t);
        }
    }
}

/// C(s): Σ aᵢⱼ cⱼᵏ⁻¹ = cᵢᵏ/k for k ≤ s: the stages are collocation, of order s.
#[test]
fn stages_have_order_s() {
    for tableau in tableaux() {
        let s = tableau.stages();
        let a = runge_kutta_matrix(tableau);
        for k in 1..=s {
            for (row, &c) in a.iter().zip(tableau.nodes) {
                let sum = row.iter().zip(tableau.nodes).fold(lit(0.0), |sum, (&a, &c)| sum + a * power(c, k - 1));
                assert_zero("C(s)", sum - power(c, k) / lit(k as f64));
            }
        }
        // The next condition fails.
        let sum = a[0].iter().zip(tableau.nodes).fold(lit(0.0), |sum, (&a, &c)| sum + a * power(c, s));
        let beyond = (sum - power(tableau.nodes[0], s + 1) / lit(s as f64 + 1.0)).primal(0);
        assert!(1e-9 < beyond.abs(), "{s}: {beyond:e}");
    }
}

/// B(2s − 1): Σ bⱼ cⱼᵏ⁻¹ = 1/k for k ≤ 2s − 1, b being the last row of A; with C(s) and D(s − 1) this is order 2s − 1.
#[test]
fn weights_integrate_polynomials_of_degree_2s_minus_2() {
    for tableau in tableaux() {
        let s = tableau.stages();
        let a = runge_kutta_matrix(tableau);
        let defect = |k: usize| {
            let sum = a[s - 1].iter().zip(tableau.nodes).fold(lit(0.0), |sum, (&b, &c)| sum + b * power(c, k - 1));
            sum - lit(1.0) / lit(k as f64)
        };
        for k in 1..2 * s {
            assert_zero("B(2s - 1)", defect(k));
        }
        assert!(1e-9 < defect(2 * s).primal(0).abs());
    }
}

/// D(s − 1): Σᵢ bᵢ cᵢᵏ⁻¹ aᵢⱼ = bⱼ (1 − cⱼᵏ)/k for k ≤ s − 1.
#[test]
fn transposed_simplifying_conditions_hold() {
    for tableau in tableaux() {
        let s = tableau.stages();
        let a = runge_kutta_matrix(tableau);
        let b = &a[s - 1];
        for k in 1..s {
            for (j, &cj) in tableau.nodes.iter().enumerate() {
                let sum = (0..s).fold(lit(0.0), |sum, i| sum + b[i] * power(tableau.nodes[i], k - 1) * a[i][j]);
                assert_zero("D(s - 1)", sum - b[j] * (lit(1.0) - power(cj, k)) / lit(k as f64));
            }
        }
    }
}

/// Σ dⱼ cⱼᵏ = −1 for k = 1 and 0 for k = 2 … s: f(t, y) + Σ dⱼ Zⱼ/h vanishes for polynomials of degree s.
#[test]
fn defect_of_a_polynomial_of_degree_s_vanishes() {
    for tableau in tableaux() {
        for k in 1..=tableau.stages() {
            let sum =
                tableau.defect.iter().zip(tableau.nodes).fold(lit(0.0), |sum, (&d, &c)| sum + lit(d) * power(c, k));
            assert_zero("defect", sum + lit(if k == 1 { 1.0 } else { 0.0 }));
        }
    }
}

/// Eigenvalues λ of A⁻¹ are the zeros of the denominator Σ qₖ (−z)ᵏ of the Padé approximation (s − 1, s) of the exponential.
#[test]
fn eigenvalues_are_zeros_of_the_denominator() {
    for tableau in tableaux() {
        let s = tableau.stages();
        let mut coefficients = vec![lit(1.0)];
        for k in 1..=s {
            // qₖ/qₖ₋₁ = (s − k + 1)/((2s − k) k).
            let ratio = lit((s - k + 1) as f64) / (lit((2 * s - k) as f64) * lit(k as f64));
            coefficients.push(-coefficients[k - 1] * ratio);
        }
        // Horner's rule.
        let q = |re: f64, im: f64| {
            let (re, im) = (lit(re), lit(im));
            let (mut a, mut b, mut size) = (lit(0.0), lit(0.0), 0.0_f64);
            for &coefficient in coefficients.iter().rev() {
                (a, b) = (a * re - b * im + coefficient, a * im + b * re);
                size = size.max(a.primal(0).abs());
            }
            (a.primal(0).hypot(b.primal(0)), size)
        };
        for [re, im] in tableau.pairs.iter().copied().chain([[tableau.real, 0.0]]) {
            let (value, size) = q(re, im);
            assert!(value < 1e-13 * size.max(1.0), "{s} stages, {re} + {im}i: {value:e}");
        }
    }
}
