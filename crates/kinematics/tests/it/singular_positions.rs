//! Combinations of gradients that are reversed between two states.

use piola_kinematics::internal::Passages;

/// What a motion from `before` at 0 s to `after` at 1 s goes through.
fn passed(before: &[f64], after: &[f64], n: usize) -> Option<(f64, usize)> {
    let conditions = before.len() / n;
    let order: Vec<usize> = (0..conditions).collect();
    let mut passages = Passages::of(conditions, n);
    assert!(passages.look(before, n, &order, 0.0).is_none());
    assert!(passages.accept(0.0));
    let found = passages.look(after, n, &order, 1.0);
    assert!(passages.accept(1.0) && passages.count() == usize::from(found.is_some()));
    found.map(|position| (position.t, position.condition))
}

#[test]
fn reversed_gradient_vanished_in_between_and_turned_one_did_not() {
    assert_eq!(passed(&[3.0, 0.0], &[-1.0, 0.0], 2), Some((0.75, 0)));
    for angle in [0.5_f64, 1.5, 2.0] {
        assert_eq!(passed(&[1.0, 0.0], &[angle.cos(), angle.sin()], 2), None, "{angle}");
    }
}

/// The second combination is reversed: in any axes of the conditions, and also where two are at once.
#[test]
fn reversed_combination_is_found_in_turned_axes() {
    for turn in [0.0_f64, 0.3, 0.8, 1.2, 2.5] {
        let (s, c) = turn.sin_cos();
        let turned = |x: [f64; 3], y: [f64; 3]| -> Vec<f64> {
            let rows = [0, 1]
                .map(|row| core::array::from_fn::<f64, 3, _>(|k| [c * x[k] - s * y[k], s * x[k] + c * y[k]][row]));
            rows.concat()
        };
        let before = turned([0.9, 1.0, -0.9], [-0.5, 0.0, 0.5]);
        let (t, _) = passed(&before, &turned([0.9, 1.0, -0.9], [0.5, 0.0, -0.5]), 3).expect("one is reversed");
        assert!((t - 0.5).abs() < 1e-12, "{t}");
        assert!(passed(&before, &turned([0.7, 1.0, -0.7], [-0.1, 0.0, 0.1]), 3).is_none());
        let (t, _) =
            passed(&before, &before.iter().map(|x| -3.0 * x).collect::<Vec<_>>(), 3).expect("two are reversed");
        assert!((t - 0.25).abs() < 1e-12, "{t}");
    }
}
