//! Series of exponentials against values by hand.

use piola_solids::memory::{Prony, PronyTerm};
use piola_testkit::{Tol, assert_close};

#[test]
fn moduli_of_an_oscillation_equal_closed_forms() {
    let terms = [(0.5, 0.25), (0.3, 2.0)].map(|(weight, time)| PronyTerm { weight, time });
    let series = Prony::new(terms.to_vec()).expect("a series");
    // g ω τ/(1 + ω² τ²) and ω τ times that, with ω τ = ½ and 4.
    let (loss, storage) = (0.5 * 0.4 + 0.3 * 4.0 / 17.0, 0.5 * 0.2 + 0.3 * 16.0 / 17.0);
    assert_close("g″, g′", &[series.loss(2.0), series.storage(2.0)], &[loss, storage], Tol::ulps(4.0));
    // 1/2 is the largest of one term, where ω τ = 1.
    let one = Prony::new(vec![PronyTerm { weight: 1.0, time: 4.0 }]).expect("a series");
    assert_close("g″, g′", &[one.loss(0.25), one.storage(0.25)], &[0.5, 0.5], Tol::ulps(2.0));
}
