//! Requests in single precision give the numbers of double precision, to the rounding of single.

use nalgebra::Matrix3;
use piola_batch as batch;
use piola_continuum::{CauchyStress, DeformationGradient, FirstPiola, Symmetric};
use piola_testkit::spectral::{Random, with_stretches};
use piola_testkit::{Tol, assert_close_at_scale};

/// Some roundings each, of stretches between ½ and 2 and inputs up to 1.
fn single() -> Tol {
    Tol::ulps32(64.0)
}

/// Numbers that both precisions hold.
fn both<const K: usize>(random: &mut Random) -> ([f64; K], [f32; K]) {
    let single: [f32; K] = std::array::from_fn(|_| rounded(random.symmetric()));
    (single.map(f64::from), single)
}

fn rounded(x: f64) -> f32 {
    num_traits::AsPrimitive::<f32>::as_(x)
}

/// A deformation that both precisions hold.
fn deformation(random: &mut Random) -> (DeformationGradient, DeformationGradient<f32>) {
    let stretches = [(); 3].map(|()| (0.69 * random.symmetric()).exp());
    let single = with_stretches(&random.rotation(), stretches, &random.rotation()).map(|row| row.map(rounded));
    let double = single.map(|row| row.map(f64::from));
    (
        DeformationGradient::from_rows(double).expect("a deformation"),
        DeformationGradient::from_rows(single).expect("a deformation"),
    )
}

/// Requests that need no destination of some type.
macro_rules! in_both {
    ($f:ident: $($function:ident($($argument:ident),*);)*) => { $(
        let double = batch::$function($(&[$argument.0][..],)* &mut [[0.0_f64; _]; 0][..]).at(&$f.0, 0);
        let single = batch::$function($(&[$argument.1][..],)* &mut [[0.0_f32; _]; 0][..]).at(&$f.1, 0);
        assert_close_at_scale(stringify!($function), &single.map(f64::from), &double, 1.0, self::single());
    )* };
}

#[test]
fn requests_in_single_precision_equal_those_in_double() {
    let mut random = Random::new(20);
    for _ in 0..200 {
        let f = deformation(&mut random);
        let (s, g, c) = (both::<6>(&mut random), both::<9>(&mut random), both::<21>(&mut random));
        in_both! { f:
            jacobian(); right_cauchy_green(); green_strain(); rotation(); right_stretch(); left_stretch();
            spatial_hencky(); principal_stretches(); hencky_derivative();
            cauchy_to_kirchhoff(s); cauchy_to_second_piola(s); first_piola_to_cauchy(g); second_piola_to_first_piola(s);
            von_mises(s); velocity_gradient(g); hencky_rate(g);
            push_forward_tangent(c); first_piola_tangent(s, c); jaumann_tangent(s, c);
        }
    }
}

#[test]
fn batches_in_single_precision_equal_those_in_double() {
    let mut random = Random::new(21);
    let (double, single): (Vec<_>, Vec<_>) = (0..203).map(|_| deformation(&mut random)).unzip();
    let (stress, stress32): (Vec<_>, Vec<_>) = (0..203).map(|_| both::<6>(&mut random)).unzip();
    let typed: Vec<_> = stress32.iter().map(|s| CauchyStress(Symmetric { components: *s })).collect();
    let zero = Symmetric::<f32>::zero();
    let (mut r, mut h) = (vec![Matrix3::<f32>::zeros(); 203], vec![zero; 203]);
    let (mut e, mut p, mut m) = (vec![zero; 203], vec![FirstPiola::<f32>::zero(); 203], vec![0.0_f32; 203]);
    let requests = (
        batch::rotation(&mut r[..]),
        batch::hencky(&mut h[..]),
        batch::green_strain(&mut e[..]),
        batch::cauchy_to_first_piola(&typed[..], &mut p[..]),
        batch::von_mises(&typed[..], &mut m[..]),
    );
    batch::evaluate(&single[..], requests).expect("deformations");
    for (i, f) in double.iter().enumerate() {
        let close = |what: &str, found: &[f32], expected: &[f64]| {
            let found: Vec<f64> = found.iter().copied().map(f64::from).collect();
            assert_close_at_scale(what, &found, expected, 1.0, self::single());
        };
        let stress = &[stress[i]][..];
        close("R", r[i].transpose().as_slice(), &batch::rotation(&mut [[0.0; 9]; 0][..]).at(f, 0));
        close("ln U", &h[i].components, &batch::hencky(&mut [[0.0; 6]; 0][..]).at(f, 0));
        close("E", &e[i].components, &batch::green_strain(&mut [[0.0; 6]; 0][..]).at(f, 0));
        let expected = batch::cauchy_to_first_piola(stress, &mut [[0.0; 9]; 0][..]).at(f, 0);
        close("P", p[i].0.transpose().as_slice(), &expected);
        close("σ of von Mises", &[m[i]], &batch::von_mises(stress, &mut [[0.0; 1]; 0][..]).at(f, 0));
    }
}
