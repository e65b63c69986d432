//! Arrays of structures and structures of arrays, by rows and by columns, with a stride: all give the same.

use nalgebra::Matrix3;
use piola_batch as batch;
use piola_batch::{BatchError, ColumnMajor, Components, Displacements, Gradients, LaneBlocks, Strided};
use piola_continuum::{DeformationGradient, DisplacementGradient, Symmetric};

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
    let wrong = BatchError::WrongLength { quantity: "destination of a batch", found: 3, expected: 4 };
    assert_eq!((refusal, j), (Err(wrong), [7.0; 3]));
    let (stress, mut p) = ([Symmetric::<f64>::zero(); 5], [Matrix3::zeros(); 4]);
    let refusal = batch::evaluate(&f[..], batch::cauchy_to_first_piola(&stress[..], &mut p[..]));
    let wrong = BatchError::WrongLength { quantity: "CauchyStress", found: 5, expected: 4 };
    assert_eq!(refusal, Err(wrong));
    assert!(batch::points_of::<9, _>(&[0.0; 10]).is_err());
    assert!(Components::new([&[0.0; 2][..], &[0.0; 3]]).is_err());
    assert!(Strided::<_, 9>::new(&[0.0; 20][..], 8, [0, 1, 2, 3, 4, 5, 6, 7, 8]).is_err());
    assert!(Strided::<_, 2>::new(&[0.0; 21][..], 10, [0, 9]).is_err());
    let none: [DeformationGradient; 0] = [];
    assert_eq!(batch::evaluate(&none[..], batch::jacobian(&mut [0.0; 0][..])).map(|report| report.points), Ok(0));
}

#[test]
fn the_last_point_at_a_stride_may_end_with_its_last_component() {
    // F₁₁ = 2, 3 and 4; between the points two numbers that are something else.
    let mut numbers = Vec::new();
    for stretch in [2.0, 3.0, 4.0] {
        numbers.extend_from_slice(&[stretch, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, f64::NAN, f64::NAN]);
    }
    let places = [0, 1, 2, 3, 4, 5, 6, 7, 8];
    for length in 31..=33 {
        let f = Strided::new(&numbers[..length], 11, places).expect("whole points");
        let mut j = [0.0; 3];
        batch::evaluate(Gradients(f), batch::jacobian(&mut j[..])).expect("deformations");
        assert_eq!((length, j), (length, [2.0, 3.0, 4.0]));
    }
}

#[test]
fn numbers_that_end_within_a_point_are_refused_with_the_number_that_would_do() {
    let places = [0, 1, 2, 3, 4, 5, 6, 7, 8];
    let refusal = Strided::<_, 9>::new(&[0.0; 25][..], 11, places).err();
    assert_eq!(refusal, Some(BatchError::WrongLength { quantity: "numbers at a stride", found: 25, expected: 31 }));
    let wrong = BatchError::WrongLength { quantity: "numbers of points", found: 20, expected: 27 };
    assert_eq!(batch::points_of::<9, _>(&[0.0; 20]).err(), Some(wrong.clone()));
    assert_eq!(batch::points_of_mut::<9, _>(&mut [0.0; 20]).err(), Some(wrong));
}

/// C of so many points, in blocks of B in and out; what lies beyond the last point is NaN before and after.
fn in_blocks<const B: usize>(f: &[DeformationGradient]) {
    let count = f.len();
    let mut gradients = vec![[[f64::NAN; B]; 9]; count.div_ceil(B)];
    for (i, f) in f.iter().enumerate() {
        for (k, lanes) in gradients[i / B].iter_mut().enumerate() {
            lanes[i % B] = f.matrix()[(k / 3, k % 3)];
        }
    }
    let mut expected = vec![Symmetric::zero(); count];
    batch::evaluate(f, batch::right_cauchy_green(&mut expected[..])).expect("deformations");
    let input = Gradients(LaneBlocks::new(&gradients, count).expect("as many blocks"));
    let (mut blocks, mut mixed) = (vec![[[f64::NAN; B]; 6]; gradients.len()], vec![Symmetric::zero(); count]);
    let to = LaneBlocks::new_mut(&mut blocks, count).expect("as many blocks");
    batch::evaluate(input, batch::right_cauchy_green(to)).expect("deformations");
    batch::evaluate(input, batch::right_cauchy_green(&mut mixed[..])).expect("deformations");
    assert_eq!(mixed, expected, "{count} points in blocks of {B}");
    for i in 0..gradients.len() * B {
        let point: [f64; 6] = core::array::from_fn(|k| blocks[i / B][k][i % B]);
        match expected.get(i) {
            Some(c) => assert_eq!(
                point.map(f64::to_bits),
                c.components.map(f64::to_bits),
                "point {i} of {count} in blocks of {B}"
            ),
            None => assert!(point.iter().all(|x| x.is_nan()), "beyond {count} points in blocks of {B}"),
        }
    }
}

#[test]
fn blocks_of_lanes_hold_what_arrays_of_structures_hold() {
    for count in [0, 1, 7, 8, 9, 32, 37, 64, 101] {
        let f = deformations(count);
        in_blocks::<1>(&f);
        in_blocks::<4>(&f);
        in_blocks::<8>(&f);
        in_blocks::<16>(&f);
        in_blocks::<64>(&f);
    }
}

#[test]
fn blocks_that_do_not_fit_the_points_are_refused() {
    let blocks = [[[1.0; 8]; 9]; 2];
    for (count, fits) in [(8, false), (9, true), (16, true), (17, false)] {
        assert_eq!(LaneBlocks::new(&blocks, count).is_ok(), fits, "{count} points");
    }
    let expected = BatchError::WrongLength { quantity: "blocks of points", found: 2, expected: 3 };
    assert_eq!(LaneBlocks::new(&blocks, 17).err(), Some(expected));
}

#[test]
fn bad_points_in_blocks_are_found_and_the_others_written() {
    let mut gradients = [[[0.0; 8]; 9]; 3];
    for block in &mut gradients {
        for k in [0, 4, 8] {
            block[k] = [2.0; 8];
        }
    }
    gradients[1][0][3] = -1.0;
    gradients[2][4][1] = f64::NAN;
    let mut j = [[[0.0; 8]; 1]; 3];
    let to = LaneBlocks::new_mut(&mut j, 18).expect("as many blocks");
    let result = batch::evaluate(Gradients(LaneBlocks::new(&gradients, 18).expect("as many")), batch::jacobian(to));
    let Err(BatchError::BadPoints { points, .. }) = result else { panic!("two bad points") };
    assert_eq!(points.iter().map(|point| point.index).collect::<Vec<_>>(), [11, 17]);
    for i in 0..18 {
        let j = j[i / 8][0][i % 8];
        assert!(if i == 11 || i == 17 { j.is_nan() } else { j.to_bits() == 8.0_f64.to_bits() }, "point {i}");
    }
}
