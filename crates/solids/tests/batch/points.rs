//! A batch gives the numbers of single points in every view and precision, and allocates nothing.

use nalgebra::Matrix3;
use piola_batch::{Components, Gradients, LaneBlocks};
use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{CauchyStress, Deformation, DeformationGradient, FirstPiola, KirchhoffStress, SecondPiola};
use piola_numerics::Real;
use piola_solids::batch;
use piola_solids::{Hyperelastic, MooneyRivlin, SaintVenantKirchhoff};
use piola_tensor::FourthOrder;
use piola_testkit::spectral::Random;
use piola_testkit::{Tol, allocations_in, assert_close};

fn rubber() -> MooneyRivlin {
    MooneyRivlin::stress_free(0.5, 0.25, 1.0).expect("parameters")
}

/// Near the reference and far from it in turn, so that blocks of lanes hold both.
fn deformations(count: usize) -> Vec<DeformationGradient> {
    let mut random = Random::new(11);
    (0..count)
        .map(|i| {
            let size = [1e-9, 0.1, 0.3][i % 3];
            let stretch = if i % 5 == 0 { 3.0 } else { 1.0 };
            let matrix = Matrix3::from_fn(|r, c| stretch * f64::from(u8::from(r == c)) + size * random.symmetric());
            DeformationGradient::new(matrix).expect("0 < det F")
        })
        .collect()
}

fn upper(tangent: &FirstPiolaTangent) -> Vec<f64> {
    let entries = &tangent.0.components;
    (0..9).flat_map(|r| entries[r][r..].to_vec()).collect()
}

#[test]
fn a_batch_equals_its_points_to_the_last_bit() {
    let (law, f) = (rubber(), deformations(203));
    let n = f.len();
    let (mut p, mut s) = (vec![FirstPiola::zero(); n], vec![SecondPiola::zero(); n]);
    let (mut k, mut t) = (vec![KirchhoffStress::zero(); n], vec![CauchyStress::zero(); n]);
    let (mut a, mut b) = (vec![[0.0; 45]; n], vec![FirstPiolaTangent(FourthOrder::zero()); n]);
    let requests = (
        batch::first_piola(&law, &mut p[..]),
        batch::second_piola(&law, &mut s[..]),
        batch::kirchhoff(&law, &mut k[..]),
        batch::cauchy(&law, &mut t[..]),
        batch::first_piola_tangent(&law, &mut a[..]),
        batch::first_piola_tangent_square(&law, &mut b[..]),
    );
    assert_eq!(batch::evaluate(&f[..], requests).expect("deformations").points, n);
    for (i, f) in f.iter().enumerate() {
        assert_eq!((p[i], s[i]), (law.first_piola(f), law.second_piola(f)), "point {i}");
        assert_eq!((k[i], t[i]), (law.kirchhoff(f), law.cauchy(f)), "point {i}");
        assert_eq!(b[i], law.first_piola_tangent(f), "point {i}");
        assert_eq!(a[i].to_vec(), upper(&b[i]), "point {i}");
    }
}

#[test]
fn tangents_of_strain_in_a_batch_equal_those_of_points() {
    let law = SaintVenantKirchhoff::new(1.5, 0.75).expect("parameters");
    let f = deformations(45);
    let (mut material, mut spatial) = (vec![[0.0; 21]; f.len()], vec![[0.0; 21]; f.len()]);
    batch::evaluate(&f[..], batch::material_tangent(&law, &mut material[..])).expect("deformations");
    batch::evaluate(&f[..], batch::truesdell_tangent(&law, &mut spatial[..])).expect("deformations");
    for (i, f) in f.iter().enumerate() {
        assert_close("∂S/∂E", &material[i], &law.material_tangent(f).0.components, Tol::ulps(0.0));
        assert_close("c/J", &spatial[i], &law.truesdell_tangent(f).0.components, Tol::ulps(0.0));
    }
}

#[test]
fn structures_of_arrays_equal_arrays_of_structures_and_allocate_nothing() {
    let (law, f) = (rubber(), deformations(1003));
    let n = f.len();
    let columns: [Vec<f64>; 9] = core::array::from_fn(|k| f.iter().map(|f| f.matrix()[(k / 3, k % 3)]).collect());
    let input = Gradients(Components::new(columns.each_ref().map(Vec::as_slice)).expect("nine arrays"));
    let mut p: [Vec<f64>; 9] = core::array::from_fn(|_| vec![0.0; n]);
    let mut a: [Vec<f64>; 45] = core::array::from_fn(|_| vec![0.0; n]);
    // The level of the machine is found out once.
    let _ = piola_numerics::Level::best();
    let (allocations, ()) = allocations_in(|| {
        let stress = Components::new_mut(p.each_mut().map(Vec::as_mut_slice)).expect("nine arrays");
        let tangent = Components::new_mut(a.each_mut().map(Vec::as_mut_slice)).expect("45 arrays");
        batch::evaluate(input, batch::first_piola_and_tangent(&law, stress, tangent)).expect("deformations");
    });
    assert_eq!(allocations, 0);
    for (i, f) in f.iter().enumerate() {
        let (stress, tangent) = law.first_piola_and_tangent(f);
        assert!((0..9).all(|k| p[k][i].to_bits() == stress.0[(k / 3, k % 3)].to_bits()), "P of point {i}");
        let expected = upper(&tangent);
        assert!((0..45).all(|k| a[k][i].to_bits() == expected[k].to_bits()), "∂P/∂F of point {i}");
    }
}

#[test]
fn blocks_of_lanes_equal_single_points_and_allocate_nothing() {
    let (law, f) = (rubber(), deformations(1003));
    let (n, blocks) = (f.len(), f.len().div_ceil(8));
    let mut gradients = vec![[[0.0; 8]; 9]; blocks];
    for (i, f) in f.iter().enumerate() {
        for (k, lanes) in gradients[i / 8].iter_mut().enumerate() {
            lanes[i % 8] = f.matrix()[(k / 3, k % 3)];
        }
    }
    let (mut p, mut a) = (vec![[[0.0; 8]; 9]; blocks], vec![[[0.0; 8]; 45]; blocks]);
    let _ = piola_numerics::Level::best();
    let (allocations, ()) = allocations_in(|| {
        let input = Gradients(LaneBlocks::new(&gradients, n).expect("as many blocks"));
        let stress = LaneBlocks::new_mut(&mut p, n).expect("as many blocks");
        let tangent = LaneBlocks::new_mut(&mut a, n).expect("as many blocks");
        batch::evaluate(input, batch::first_piola_and_tangent(&law, stress, tangent)).expect("deformations");
    });
    assert_eq!(allocations, 0);
    for (i, f) in f.iter().enumerate() {
        let (stress, tangent) = law.first_piola_and_tangent(f);
        let (p, a) = (&p[i / 8], &a[i / 8]);
        assert!((0..9).all(|k| p[k][i % 8].to_bits() == stress.0[(k / 3, k % 3)].to_bits()), "P of point {i}");
        let expected = upper(&tangent);
        assert!((0..45).all(|k| a[k][i % 8].to_bits() == expected[k].to_bits()), "∂P/∂F of point {i}");
    }
}

#[test]
fn a_derivative_of_a_batch_equals_the_tangent_times_its_direction() {
    let (law, f) = (rubber(), deformations(103));
    let direction = Matrix3::new(0.5, -1.0, 0.25, 2.0, 0.0, 1.0, -0.5, 0.125, 1.5);
    let (directions, mut q) = (vec![direction; f.len()], vec![FirstPiola::zero(); f.len()]);
    batch::evaluate(&f[..], batch::first_piola_derivative(&law, &directions[..], &mut q[..])).expect("deformations");
    for (f, q) in f.iter().zip(&q) {
        let rows = core::array::from_fn(|i| core::array::from_fn(|j| direction[(i, j)]));
        let product = law.first_piola_tangent(f).0.contract(rows);
        let expected: Vec<f64> = product.as_flattened().to_vec();
        let tolerance = Tol::stated(1e-13, "a sum of nine products, in another order");
        assert_close("(∂P/∂F) : δF", q.0.transpose().as_slice(), &expected, tolerance);
    }
}

#[test]
fn single_precision_batches_equal_single_precision_points() {
    let law = rubber();
    let f: Vec<DeformationGradient<f32>> = deformations(103)
        .iter()
        .map(|f| DeformationGradient::new(f.matrix().map(<f32 as Real>::lit)))
        .collect::<Result<_, _>>()
        .expect("0 < det F");
    let mut p = vec![FirstPiola::<f32>::zero(); f.len()];
    batch::evaluate(&f[..], batch::first_piola(&law, &mut p[..])).expect("deformations");
    assert!(f.iter().zip(&p).all(|(f, p)| *p == law.first_piola(f)));
}

/// ½ (J − 1)², by its energy alone.
struct Volume;

impl Hyperelastic for Volume {
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let change = deformation.volume_change();
        T::lit(0.5) * change * change
    }
}

#[test]
fn a_law_of_its_energy_alone_runs_in_batches() {
    let f = deformations(53);
    let (mut w, mut p) = (vec![0.0; f.len()], vec![FirstPiola::zero(); f.len()]);
    batch::evaluate(&f[..], (batch::energy(&Volume, &mut w[..]), batch::first_piola(&Volume, &mut p[..])))
        .expect("deformations");
    for (i, f) in f.iter().enumerate() {
        assert_eq!(w[i].to_bits(), Volume.energy(f).to_bits());
        assert_eq!(p[i], Volume.first_piola(f));
    }
}
