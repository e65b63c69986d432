//! Lanes: arithmetic, masks and memory lane by lane equal the scalar's; dispatched kernels return and write
//! what the kernel alone does; derivatives nest around lanes.

use piola_numerics::{Dual, Gradient, Kernel, Lanes, Level, Mask, Real, dispatch, dispatch_at};
use piola_testkit::{Tol, assert_close};

/// The period of a heavy pendulum to fourth order in its amplitude, with a mask for good measure: a formula
/// with every operator.
#[cfg_attr(not(debug_assertions), inline(always))]
fn period<T: Real>(length: T, amplitude: T) -> T {
    let half = amplitude * T::lit(0.5);
    let s = half * (T::one() - half * half / T::lit(6.0));
    let s2 = s * s;
    let mut series = T::one();
    series += s2 * T::lit(0.25);
    series += s2 * s2 * T::lit(9.0 / 64.0);
    let small = T::lit(2.0) * T::lit(core::f64::consts::PI) * (length / T::lit(9.81)).sqrt();
    T::select(amplitude.abs().less_than(T::lit(1e-8)), small, small * series) - T::zero()
}

/// A formula through the elementary functions.
fn transcendental<T: Real>(x: T) -> T {
    (x.sin() * x.exp() + (T::one() + x * x).ln()).tanh() + x.powf(T::lit(1.5)).atan2(T::lit(2.0) + x)
}

const ARGUMENTS: [f64; 8] = [0.0, 0.125, 0.3, 0.75, 1.0, 1.7, 2.5, 3.0];

fn lanes_equal_scalars<const N: usize>() {
    let x = Lanes::<f64, N>(std::array::from_fn(|i| ARGUMENTS[i]));
    let actual = period(Lanes::lit(2.0), x);
    // Sums, products, quotients and roots are rounded alike in lanes and alone.
    let expected = Lanes(std::array::from_fn(|i| period(2.0, ARGUMENTS[i])));
    assert_eq!(actual, expected);
    let actual = transcendental(x).0;
    let expected: [f64; N] = std::array::from_fn(|i| transcendental(ARGUMENTS[i]));
    // Six functions of 2 ulp each, none ill-conditioned at these points, on top of the library's own error.
    assert_close("transcendental formula", &actual, &expected, Tol::ulps(16.0));
}

#[test]
fn one_formula_in_lanes_equals_the_same_in_scalars() {
    lanes_equal_scalars::<1>();
    lanes_equal_scalars::<2>();
    lanes_equal_scalars::<4>();
    lanes_equal_scalars::<8>();
}

#[test]
#[expect(clippy::cast_possible_truncation, reason = "the arguments of the single-precision run")]
fn one_formula_in_single_lanes_equals_doubles_to_single_precision() {
    let x = Lanes::<f32, 8>(ARGUMENTS.map(|x| x as f32));
    let actual: Vec<f64> = (0..8).map(|i| transcendental(x).primal(i)).collect();
    let expected: Vec<f64> = x.0.iter().map(|x| transcendental(f64::from(*x))).collect();
    assert_close("transcendental formula", &actual, &expected, Tol::ulps32(16.0));
    let alone: [f32; 8] = x.0.map(|x| period(2.0_f32, x));
    assert_eq!(period(Lanes::lit(2.0), x), Lanes(alone));
}

#[test]
fn derivatives_in_lanes_equal_derivatives_alone() {
    let x = Lanes::<f64, 4>([0.125, 0.3, 0.75, 1.7]);
    let lanes = transcendental(Dual::variable(Dual::variable(x)));
    for i in 0..4 {
        let alone = transcendental(Dual::variable(Dual::variable(x.0[i])));
        let actual = [lanes.value.value.0[i], lanes.tangent.value.0[i], lanes.tangent.tangent.0[i]];
        let expected = [alone.value.value, alone.tangent.value, alone.tangent.tangent];
        assert_close("value, slope and curvature", &actual, &expected, Tol::ulps(64.0));
    }
    let gradient = period(Gradient::<_, 2>::variable(Lanes([2.0; 4]), 0), Gradient::variable(x, 1));
    for i in 0..4 {
        let alone = period(Gradient::<_, 2>::variable(2.0, 0), Gradient::variable(x.0[i], 1));
        assert_close(
            "gradient",
            &[gradient.partials[0].0[i], gradient.partials[1].0[i]],
            &alone.partials,
            Tol::ulps(16.0),
        );
    }
}

#[test]
fn masks_select_lane_by_lane() {
    let (a, b) = (Lanes([1.0, f64::NAN, -0.0, 3.0]), Lanes([2.0, 2.0, 0.0, 3.0]));
    let lanes = |mask: <Lanes<f64, 4> as Real>::Mask| [0, 1, 2, 3].map(|i| mask.lane(i));
    assert_eq!(lanes(a.less_than(b)), [true, false, false, false]);
    assert_eq!(lanes(a.at_most(b)), [true, false, true, true]);
    assert_eq!(lanes(a.is_finite()), [true, false, true, true]);
    assert_eq!(lanes(!a.less_than(b) & a.at_most(b)), [false, false, true, true]);
    assert_eq!(lanes(a.less_than(b) | !a.is_finite()), [true, true, false, false]);
    assert!(a.less_than(b).any() && !a.less_than(b).all() && b.is_finite().all());
    assert!(!a.less_than(b).lane(4), "beyond the last lane");
    assert_eq!(Lanes::select(a.at_most(b), b, Lanes([7.0; 4])), Lanes([2.0, 7.0, 0.0, 3.0]));
    let infinite = Lanes([f32::INFINITY, f32::NEG_INFINITY]);
    assert!(!infinite.is_finite().any());
}

#[test]
fn partial_loads_and_stores_keep_to_the_slice() {
    let values = [1.0, 2.0, 3.0, 4.0, 5.0];
    assert_eq!(Lanes::<f64, 4>::load(&values, 9.0), Lanes([1.0, 2.0, 3.0, 4.0]));
    assert_eq!(Lanes::<f64, 4>::load(&values[3..], 9.0), Lanes([4.0, 5.0, 9.0, 9.0]));
    assert_eq!(Lanes::<f64, 4>::load(&[], 9.0), Lanes::splat(9.0));
    let mut written = [0.0; 5];
    Lanes([1.0, 2.0, 3.0, 4.0]).store(&mut written[2..]);
    assert_eq!(Lanes(written), Lanes([0.0, 0.0, 1.0, 2.0, 3.0]));
    Lanes([6.0, 7.0]).store(&mut written);
    assert_eq!(Lanes(written), Lanes([6.0, 7.0, 1.0, 2.0, 3.0]));
}

/// Σ period(1, xᵢ), lane by lane.
struct Total<'a>(&'a [Lanes<f64, 4>]);

impl Kernel for Total<'_> {
    type Output = Lanes<f64, 4>;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> Lanes<f64, 4> {
        let mut total = Lanes::lit(0.0);
        for x in self.0 {
            total += period(Lanes::lit(1.0), *x);
        }
        total
    }
}

#[test]
fn dispatched_kernels_equal_the_kernel_alone_at_every_level() {
    let x = [Lanes([0.0, 0.1, 0.2, 0.3]), Lanes([0.4, 0.5, 0.6, 0.7])];
    let alone = Total(&x).run();
    assert_eq!(dispatch(Total(&x)), alone);
    // A level that the machine lacks runs at its best one.
    for level in [Level::Base, Level::Avx2, Level::Avx512] {
        assert_eq!(dispatch_at(level, Total(&x)), alone, "{level:?}");
    }
    assert_eq!(Level::available().last(), Some(Level::best()));
}

/// Records of K numbers to N lanes and back, number by number the same.
fn records_through_lanes<const N: usize, const K: usize, const ROWS: usize>() {
    let numbers: [[f64; K]; N] = core::array::from_fn(|lane| core::array::from_fn(|k| (100 * lane + k) as f64));
    let mut components = [Lanes([0.0; N]); K];
    Lanes::gather::<K, ROWS>(numbers.each_ref(), &mut components);
    for (place, lanes) in components.iter().enumerate() {
        // Place (row, column) of a matrix by rows is number (column, row) by columns.
        let columns = K / ROWS;
        let number = place % columns * ROWS + place / columns;
        for (x, record) in lanes.0.iter().zip(&numbers) {
            assert_eq!(x.to_bits(), record[number].to_bits(), "{N} records of {K}");
        }
    }
    let mut written = [[f64::NAN; K]; N];
    Lanes::scatter::<K, ROWS>(&components, written.each_mut());
    let equal = written.as_flattened().iter().zip(numbers.as_flattened()).all(|(x, y)| x.to_bits() == y.to_bits());
    assert!(equal, "{N} records of {K}: {written:?}");
}

#[test]
fn gathered_lanes_are_the_numbers_of_the_records_and_scattered_ones_the_records() {
    macro_rules! all {
        ($($k:literal)*) => { $(
            records_through_lanes::<2, $k, 1>();
            records_through_lanes::<4, $k, 1>();
            records_through_lanes::<8, $k, 1>();
            records_through_lanes::<16, $k, 1>();
        )* };
    }
    all!(1 2 3 4 5 6 7 8 9 10 11 21 36 45 81);
    records_through_lanes::<4, 9, 3>();
    records_through_lanes::<8, 9, 3>();
    records_through_lanes::<8, 6, 2>();
}
