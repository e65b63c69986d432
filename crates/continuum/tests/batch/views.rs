//! Arrays of structures and structures of arrays, by rows and by columns, with a stride: all give the same.

use nalgebra::Matrix3;
use piola_continuum::batch::{self, ColumnMajor, Components, Displacements, Gradients, Strided};
use piola_continuum::{ContinuumError, DeformationGradient, DisplacementGradient, Symmetric};

use super::cases::deformations;

const COUNT: usize = 37;

#[test]
fn every_view_of_the_same_gradients_gives_the_same_strains() {
    let f = deformations(COUNT);
    let matrices: Vec<Matrix3<f64>> = f.iter().map(|f| *f.matrix()).collect();
    let rows: Vec<[[f64; 3]; 3]> = matrices.iter().map(|f| [0, 1, 2].map(|i| [0, 1, 2].map(|j| f[(i, j)]))).collect();
    let by_rows = rows.as_flattened().as_flattened();
    let by_columns: Vec<f64> = matrices.iter().flat_map(|f| f.iter().copied()).collect();
    let mut padded = Vec::new();
    for point in by_rows.chunks(9) {
        padded.extend_from_slice(&[f64::NAN, f64::NAN]);
        padded.extend_from_slice(point);
    }
    let arrays: [Vec<f64>; 9] = std::array::from_fn(|k| by_rows.iter().skip(k).step_by(9).copied().collect());

    let mut expected = vec![Symmetric::zero(); COUNT];
    batch::evaluate(&f[..], batch::green_strain(&mut expected[..])).expect("deformations");
    macro_rules! same {
        ($view:expr) => {{
            let mut strains = vec![Symmetric::zero(); COUNT];
            batch::evaluate(Gradients($view), batch::green_strain(&mut strains[..])).expect("deformations");
            assert_eq!(strains, expected);
        }};
    }
    same!(&matrices[..]);
    same!(&rows[..]);
    same!(batch::points_of::<9, _>(by_rows).expect("whole points"));
    same!(ColumnMajor(batch::points_of::<9, _>(&by_columns).expect("whole points")));
    same!(Strided::new(&padded[..], 11, [2, 3, 4, 5, 6, 7, 8, 9, 10]).expect("whole points"));
    same!(Components::new(arrays.each_ref().map(Vec::as_slice)).expect("equal lengths"));
    same!(&f[..]);
}

#[test]
fn every_destination_holds_the_same_rotations_and_strains() {
    let f = deformations(COUNT);
    let mut matrices = vec![Matrix3::zeros(); COUNT];
    let (mut by_rows, mut by_columns, mut strided) =
        (vec![0.0; 9 * COUNT], vec![0.0; 9 * COUNT], vec![-1.0; 10 * COUNT]);
    let mut arrays: [Vec<f64>; 9] = std::array::from_fn(|_| vec![0.0; COUNT]);
    let (mut symmetric, mut full) = (vec![Symmetric::zero(); COUNT], vec![Matrix3::zeros(); COUNT]);
    let requests = (
        batch::rotation(&mut matrices[..]),
        batch::rotation(batch::points_of_mut::<9, _>(&mut by_rows).expect("whole points")),
        batch::rotation(ColumnMajor(batch::points_of_mut::<9, _>(&mut by_columns).expect("whole points"))),
        batch::rotation(Strided::new(&mut strided[..], 10, [1, 2, 3, 4, 5, 6, 7, 8, 9]).expect("whole points")),
        batch::rotation(Components::new_mut(arrays.each_mut().map(Vec::as_mut_slice)).expect("equal lengths")),
        batch::right_stretch(&mut symmetric[..]),
        batch::right_stretch(&mut full[..]),
    );
    batch::evaluate(&f[..], requests).expect("deformations");
    for (i, r) in matrices.iter().enumerate() {
        for (k, (row, column)) in (0..9).map(|k| (k, (k / 3, k % 3))) {
            let expected = r[(row, column)].to_bits();
            assert_eq!(by_rows[9 * i + k].to_bits(), expected);
            assert_eq!(by_columns[9 * i + 3 * column + row].to_bits(), expected);
            assert_eq!(strided[10 * i + 1 + k].to_bits(), expected);
            assert_eq!(arrays[k][i].to_bits(), expected);
        }
        assert_eq!(strided[10 * i].to_bits(), (-1.0_f64).to_bits());
        assert_eq!(full[i], symmetric[i].matrix());
    }
}

#[test]
fn displacement_gradients_keep_the_digits_that_gradients_lose() {
    let h = [Matrix3::from_diagonal_element(1e-20); COUNT];
    let typed = h.map(|h| DisplacementGradient::new(h).expect("a deformation"));
    let (mut raw, mut checked, mut rounded) = ([[0.0; 6]; COUNT], [[0.0; 6]; COUNT], [[1.0; 6]; COUNT]);
    batch::evaluate(Displacements(&h[..]), batch::hencky(&mut raw[..])).expect("deformations");
    batch::evaluate(&typed[..], batch::hencky(&mut checked[..])).expect("deformations");
    let f = typed.map(|h| h.to_deformation_gradient().expect("a deformation"));
    batch::evaluate(&f[..], batch::hencky(&mut rounded[..])).expect("deformations");
    assert_eq!(raw, [[1e-20, 1e-20, 1e-20, 0.0, 0.0, 0.0]; COUNT]);
    assert_eq!(raw, checked);
    assert_eq!(rounded, [[0.0; 6]; COUNT]);
}

#[test]
fn lengths_that_differ_are_refused_before_anything_is_computed() {
    let f = deformations(4);
    let mut j = [7.0; 3];
    let refusal = batch::evaluate(&f[..], batch::jacobian(&mut j[..]));
    let wrong = ContinuumError::WrongLength { quantity: "destination of a batch", found: 3, expected: 4 };
    assert_eq!((refusal, j), (Err(wrong), [7.0; 3]));
    let (stress, mut p) = ([Symmetric::<f64>::zero(); 5], [Matrix3::zeros(); 4]);
    let refusal = batch::evaluate(&f[..], batch::cauchy_to_first_piola(&stress[..], &mut p[..]));
    let wrong = ContinuumError::WrongLength { quantity: "CauchyStress", found: 5, expected: 4 };
    assert_eq!(refusal, Err(wrong));
    assert!(batch::points_of::<9, _>(&[0.0; 10]).is_err());
    assert!(Components::new([&[0.0; 2][..], &[0.0; 3]]).is_err());
    assert!(Strided::<_, 9>::new(&[0.0; 20][..], 8, [0, 1, 2, 3, 4, 5, 6, 7, 8]).is_err());
    assert!(Strided::<_, 2>::new(&[0.0; 21][..], 10, [0, 9]).is_err());
    let none: [DeformationGradient; 0] = [];
    assert_eq!(batch::evaluate(&none[..], batch::jacobian(&mut [0.0; 0][..])).map(|report| report.points), Ok(0));
}
