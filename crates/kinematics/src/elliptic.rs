//! Elliptic integrals in Carlson's symmetric form, and Jacobi's functions.
//!
//! # References
//! B. C. Carlson, Numer. Algorithms 10 (1995) 13 (duplication); R. Bulirsch, Numer. Math. 7 (1965) 78 (Landen's transformation).

/// Duplications after which arguments agree, whatever they are; NaN never does.
const MOST_DUPLICATIONS: usize = 100;

/// `R_F(x, y, z)` = ½ ∫₀^∞ dt/√((t + x)(t + y)(t + z)), at most one argument zero.
pub(crate) fn first_kind([mut x, mut y, mut z]: [f64; 3]) -> f64 {
    for _ in 0..MOST_DUPLICATIONS {
        let mean = (x + y + z) / 3.0;
        let [dx, dy, dz] = [x, y, z].map(|x| (mean - x) / mean);
        // The first terms that are left out are of the sixth order.
        if dx.abs().max(dy.abs()).max(dz.abs()) < 2e-3 {
            let (second, third) = (dx * dy - dz * dz, dx * dy * dz);
            let series = 1.0 - second / 10.0 + third / 14.0 + second * second / 24.0 - 3.0 * second * third / 44.0;
            return series / mean.sqrt();
        }
        let shift = (x * y).sqrt() + (y * z).sqrt() + (z * x).sqrt();
        [x, y, z] = [x, y, z].map(|x| 0.25 * (x + shift));
    }
    f64::NAN
}

/// `R_J(x, y, z, p)` = 3/2 ∫₀^∞ dt/((t + p) √((t + x)(t + y)(t + z))), 0 < p, at most one of the others zero.
pub(crate) fn third_kind([mut x, mut y, mut z]: [f64; 3], mut p: f64) -> f64 {
    let start = 0.2 * (x + y + z + 2.0 * p);
    let differences = [x, y, z].map(|x| start - x);
    let width = differences.iter().fold((start - p).abs(), |width, d| width.max(d.abs()));
    let delta = (p - x) * (p - y) * (p - z);
    let (mut mean, mut factor, mut sum) = (start, 1.0, 0.0);
    for _ in 0..MOST_DUPLICATIONS {
        if factor * width < 2e-3 * mean {
            break;
        }
        let [rx, ry, rz, rp] = [x, y, z, p].map(f64::sqrt);
        let shift = rx * ry + ry * rz + rz * rx;
        let product = (rp + rx) * (rp + ry) * (rp + rz);
        sum += factor / product * elementary(factor * factor * factor * delta / (product * product));
        [x, y, z, p] = [x, y, z, p].map(|x| 0.25 * (x + shift));
        (mean, factor) = (0.25 * (mean + shift), 0.25 * factor);
    }
    let [x, y, z] = differences.map(|d| factor * d / mean);
    let p = -0.5 * (x + y + z);
    let e2 = x * y + x * z + y * z - 3.0 * p * p;
    let e3 = x * y * z + 2.0 * e2 * p + 4.0 * p * p * p;
    let e4 = (2.0 * x * y * z + e2 * p + 3.0 * p * p * p) * p;
    let e5 = x * y * z * p * p;
    let series = 1.0 - 3.0 * e2 / 14.0 + e3 / 6.0 + 9.0 * e2 * e2 / 88.0 - 3.0 * e4 / 22.0 - 9.0 * e2 * e3 / 52.0
        + 3.0 * e5 / 26.0;
    factor * series / (mean * mean.sqrt()) + 6.0 * sum
}

/// `R_C(1, 1 + e)` = arctan(√e)/√e, or with the hyperbolic tangent for negative e; −1 < e.
fn elementary(e: f64) -> f64 {
    if e.abs() < 0.01 {
        // 1 − e/3 + e²/5 − …; the ninth term is below an ulp.
        (0..9).rev().fold(0.0, |sum, k| 1.0 / f64::from(2 * k + 1) - e * sum)
    } else if 0.0 < e {
        let root = e.sqrt();
        root.atan() / root
    } else {
        let root = (-e).sqrt();
        root.atanh() / root
    }
}

/// sn u, cn u and dn u, |u| ≤ K, of the complementary parameter 1 − m.
pub(crate) fn jacobi(u: f64, complement: f64) -> [f64; 3] {
    if complement <= 0.0 {
        let secant = u.cosh().recip();
        return [u.tanh(), secant, secant];
    }
    // Arithmetic and geometric means, until they agree to half the digits.
    let (mut pairs, mut count) = ([[0.0; 2]; 16], 0);
    let (mut arithmetic, mut complement) = (1.0, complement);
    let scale = loop {
        let geometric = f64::sqrt(complement);
        pairs[count] = [arithmetic, geometric];
        let mean = 0.5 * (arithmetic + geometric);
        count += 1;
        if (arithmetic - geometric).abs() <= 1e-8 * arithmetic || count == pairs.len() {
            break mean;
        }
        complement = geometric * arithmetic;
        arithmetic = mean;
    };
    let (sine, cosine) = (scale * u).sin_cos();
    if sine.abs() <= 0.0 {
        return [sine, cosine, 1.0];
    }
    let mut ratio = cosine / sine;
    let (mut scale, mut dn) = (scale * ratio, 1.0);
    for [arithmetic, geometric] in pairs[..count].iter().rev() {
        ratio *= scale;
        scale *= dn;
        dn = (geometric + ratio) / (arithmetic + ratio);
        ratio = scale / arithmetic;
    }
    let sn = (scale * scale + 1.0).sqrt().recip().copysign(sine);
    [sn, scale * sn, dn]
}
