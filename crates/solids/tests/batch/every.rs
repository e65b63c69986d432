//! One law of each kind in lanes and on all cores: the numbers of single points.

use nalgebra::Matrix3;
use piola_batch::BatchScalar;
use piola_continuum::stress::tangents::{MaterialTangent, TruesdellTangent};
use piola_continuum::{CauchyStress, DeformationGradient, FirstPiola, SecondPiola};
use piola_numerics::Real;
use piola_solids::isochoric::{ArrudaBoyce, Gent, MooneyRivlin};
use piola_solids::volumetric::{Miehe, SimoTaylor};
use piola_solids::{
    Compressible, EngineeringConstants, Fibre, Fung, Hencky, HolzapfelGasserOgden, Hyperelastic, IsochoricOgden,
    OgdenTerm, SaintVenantKirchhoff, Stiffness,
};
use piola_solids::{SolidsError, batch};
use piola_tensor::MajorSymmetric;
use piola_testkit::spectral::Random;
use piola_testkit::{Tol, assert_close_at_scale};

/// From 8192 points on a batch goes to all cores.
const MANY: usize = 8192 + 17;

/// Near the reference and far from it in turn, so that blocks of lanes hold both.
fn deformations<T: Real>(count: usize) -> Vec<DeformationGradient<T>> {
    let mut random = Random::new(5);
    let mut entry = |size: f64, r: usize, c: usize| if r == c { 1.0 } else { 0.0 } + size * random.symmetric();
    (0..count)
        .map(|i| {
            let size = [1e-3, 0.1, 0.3][i % 3];
            let matrix = Matrix3::from_fn(|r, c| T::lit(entry(size, r, c)));
            DeformationGradient::new(matrix).expect("0 < det F")
        })
        .collect()
}

/// P: elementary functions of lanes are others than those of single values, within 2 ulp, so that stresses differ by some ulp of
/// the moduli, which are about 10.
fn compare<T: BatchScalar, L: Hyperelastic + Sync>(name: &str, law: &L, f: &[DeformationGradient<T>], tolerance: Tol) {
    let mut p = vec![FirstPiola::zero(); f.len()];
    batch::evaluate(f, batch::first_piola(law, &mut p[..])).expect("deformations of the law");
    for (i, (f, p)) in f.iter().zip(&p).enumerate() {
        let numbers = |p: &FirstPiola<T>| p.0.iter().map(|x| x.primal(0)).collect::<Vec<_>>();
        let alone = numbers(&law.first_piola(f));
        let size = alone.iter().fold(10.0_f64, |size, x| size.max(x.abs()));
        assert_close_at_scale(&format!("P of {name}, point {i}"), &numbers(p), &alone, size, tolerance);
    }
}

/// Every request: elementary functions of lanes are others than those of single values, within 2 ulp, so that stresses differ
/// by some ulp of the moduli, which are about 10, and tangents by some ulp of their norm.
fn compare_all<T: BatchScalar, L: Hyperelastic + Sync>(
    name: &str,
    law: &L,
    f: &[DeformationGradient<T>],
    tolerance: Tol,
) {
    let n = f.len();
    let zero = T::zero();
    let (mut w, mut energy) = (vec![zero; n], vec![zero; n]);
    let (mut p, mut first_piola, mut along) =
        (vec![FirstPiola::zero(); n], vec![FirstPiola::zero(); n], vec![FirstPiola::zero(); n]);
    let mut a = vec![[zero; 45]; n];
    let direction = vec![Matrix3::from_fn(|i, j| T::lit(0.3 - 0.2 * i as f64 + 0.1 * j as f64)); n];
    let good = "deformations of the law";
    batch::evaluate(f, batch::energy(law, &mut energy[..])).expect(good);
    batch::evaluate(f, batch::first_piola(law, &mut p[..])).expect(good);
    let all = batch::energy_first_piola_and_tangent(law, &mut w[..], &mut first_piola[..], &mut a[..]);
    batch::evaluate(f, all).expect(good);
    batch::evaluate(f, batch::first_piola_derivative(law, &direction[..], &mut along[..])).expect(good);
    let (mut work, mut stress) = (vec![zero; n], vec![FirstPiola::zero(); n]);
    batch::evaluate(f, batch::energy_and_first_piola(law, &mut work[..], &mut stress[..])).expect(good);
    for (i, f) in f.iter().enumerate() {
        let numbers = |values: &[T]| values.iter().map(|x| x.primal(0)).collect::<Vec<_>>();
        let close = |what: &str, actual: &[T], expected: &[T], moduli: f64| {
            let expected = numbers(expected);
            let size = expected.iter().fold(moduli, |size, x| size.max(x.abs()));
            assert_close_at_scale(
                &format!("{what} of {name}, point {i}"),
                &numbers(actual),
                &expected,
                size,
                tolerance,
            );
        };
        let (energy_alone, alone, tangent) = law.energy_first_piola_and_tangent(f);
        for (actual, what) in [(w[i], "W with both"), (work[i], "W with P"), (energy[i], "W")] {
            close(what, &[actual], &[energy_alone], 0.0);
        }
        for (actual, what) in [(&p[i], "P"), (&first_piola[i], "P with W and ∂P/∂F"), (&stress[i], "P with W")] {
            close(what, actual.0.as_slice(), alone.0.as_slice(), 10.0);
        }
        let entries = tangent.0.components;
        let upper: Vec<T> = (0..9).flat_map(|row| entries[row][row..].to_vec()).collect();
        close("∂P/∂F", &a[i], &upper, 10.0);
        let derivative = law.first_piola_derivative(f, &direction[i]);
        close("(∂P/∂F) : δF", along[i].0.as_slice(), derivative.0.as_slice(), 10.0);
    }
}

#[test]
fn laws_of_each_kind_on_all_cores_equal_themselves_at_their_points() -> Result<(), SolidsError> {
    let f = deformations::<f64>(MANY);
    let ulps = Tol::ulps(8.0);
    let terms =
        [(0.63, 1.3), (0.0012, 5.0), (-0.01, -2.0)].map(|(mu, alpha)| OgdenTerm { modulus: mu, exponent: alpha });
    let tissue = EngineeringConstants { young: [0.9, 0.5, 0.4], poisson: [0.3, 0.2, 0.25], shear: [0.2, 0.15, 0.3] };
    let fibres = [Fibre::in_plane(0.6)?, Fibre::in_plane(-0.6)?];
    compare("Gent", &Compressible::new(Gent::new(0.8, 30.0)?, SimoTaylor::new(5.0)?), &f, ulps);
    compare_all("Mooney–Rivlin", &Compressible::new(MooneyRivlin::new(0.8, 0.4)?, Miehe::new(5.0)?), &f, ulps);
    compare("Arruda–Boyce", &Compressible::new(ArrudaBoyce::new(0.8, 9.0)?, Miehe::new(5.0)?), &f, ulps);
    compare("Ogden", &IsochoricOgden::new(&terms, 10.0)?, &f, ulps);
    compare("Hencky", &Hencky::new(2.0, 0.9)?, &f, ulps);
    compare("Fung", &Fung::new(1.7, Stiffness::orthotropic(&tissue, &Matrix3::identity())?)?, &f, ulps);
    compare("wall", &HolzapfelGasserOgden::new(1.5, 20.0, 2.4, 0.8, 0.2, fibres)?, &f, ulps);
    Ok(())
}

#[test]
fn laws_of_single_precision_in_lanes_equal_themselves_at_their_points() -> Result<(), SolidsError> {
    let f = deformations::<f32>(203);
    compare("Gent", &Compressible::new(Gent::new(0.8, 30.0)?, SimoTaylor::new(5.0)?), &f, Tol::ulps32(8.0));
    compare("Hencky", &Hencky::new(2.0, 0.9)?, &f, Tol::ulps32(8.0));
    compare_all(
        "Mooney–Rivlin",
        &Compressible::new(MooneyRivlin::new(0.8, 0.4)?, Miehe::new(5.0)?),
        &f,
        Tol::ulps32(8.0),
    );
    Ok(())
}

#[test]
fn stresses_and_tangents_of_two_frames_equal_those_at_their_points() -> Result<(), SolidsError> {
    let (f, law) = (deformations::<f64>(203), SaintVenantKirchhoff::new(5.0, 2.0)?);
    let (mut s, mut t) = (vec![SecondPiola::zero(); f.len()], vec![CauchyStress::zero(); f.len()]);
    let (mut material, mut spatial) = (vec![[0.0; 21]; f.len()], vec![[0.0; 21]; f.len()]);
    batch::evaluate(&f[..], batch::second_piola_and_tangent(&law, &mut s[..], &mut material[..]))?;
    batch::evaluate(&f[..], batch::cauchy_and_tangent(&law, &mut t[..], &mut spatial[..]))?;
    for (i, f) in f.iter().enumerate() {
        // Products and sums alone: the same bits.
        assert_eq!(
            (s[i], MaterialTangent(MajorSymmetric { components: material[i] })),
            law.second_piola_and_tangent(f)
        );
        assert_eq!((t[i], TruesdellTangent(MajorSymmetric { components: spatial[i] })), law.cauchy_and_tangent(f));
    }
    Ok(())
}
