//! Indices of media, and the lengths of fronts in a uniform one.

use piola_studies::fronts::{Medium, MediumPart, Source};
use piola_testkit::{Tol, assert_close};

#[test]
fn index_of_each_medium_is_its_law() {
    let bump = MediumPart::Gaussian { centre: [1.0, -2.0], radius: 2.0, amplitude: 0.5 };
    let lens = MediumPart::Luneburg { centre: [0.5, 0.25], radius: 2.0 };
    let layers = MediumPart::Layers { index: 1.5, gradient: 0.25, height: 2.0 };
    // r²/R² is (1.2² + 1.6²)/2² = 1 and (1.2² + 0.9²)/2² = 9/16.
    let cases = [
        (bump, [2.2, -0.4], 1.0 + 0.5 * (-1.0_f64).exp()),
        (lens, [1.7, 1.15], (2.0_f64 - 0.5625).sqrt()),
        (layers, [7.0, 5.0], 1.5 + 0.25 * 3.0),
        (layers, [7.0, 0.0], 1.5 - 0.25 * 2.0),
    ];
    for (part, place, expected) in cases {
        let alone = Medium { parts: vec![part] }.index(place);
        assert_close("index", &[alone], &[expected], Tol::ulps(4.0));
        let behind_glass = Medium { parts: vec![part, MediumPart::Uniform { index: 1.5 }] }.index(place);
        assert_close("product", &[behind_glass], &[1.5 * expected], Tol::ulps(4.0));
    }
}

#[test]
fn front_of_a_point_is_its_angle_times_the_length_over_the_index() {
    let point = Source::Point { place: [4.0, 1.0], from: 0.5, to: 2.0 };
    assert_close("arc", &[point.front(3.0, 1.5)], &[1.5 * 3.0 / 1.5], Tol::ulps(2.0));
    let plane = Source::Plane { middle: [4.0, 1.0], direction: [0.6, 0.8], width: 2.5 };
    assert_eq!((plane.front(3.0, 1.5).to_bits(), plane.range()), (2.5_f64.to_bits(), (-1.25, 1.25)));
}
