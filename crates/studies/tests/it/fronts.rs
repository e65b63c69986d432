//! Fronts, rays and caustics beside closed forms.

use core::f64::consts::{PI, TAU};
use core::ops::ControlFlow;

use piola_studies::Outcome;
use piola_studies::fronts::{Fronts, Medium, MediumPart, Source, Wavefront};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, assert_each_close};

/// All fronts, and what the observer was told.
fn complete(asked: &Wavefront) -> (Fronts, Vec<f64>) {
    let mut told = Vec::new();
    let (found, outcome) = asked.run(&mut |done| {
        told.push(done);
        ControlFlow::Continue(())
    });
    assert_eq!(outcome, Outcome::Completed);
    (found, told)
}

#[test]
fn caustic_of_horizontal_rays_under_a_linear_index_is_the_envelope_of_catenaries() {
    // n = y: the ray from (0, a) is y = a cosh(x/a), and touches the line y = x sinh σ at x = σ a, where coth σ = σ.
    let touching = 1.199_678_640_257_733_8_f64;
    let asked = Wavefront {
        source: Source::Plane { middle: [0.0, 1.0], direction: [1.0, 0.0], width: 0.5 },
        medium: Medium { parts: vec![MediumPart::Layers { index: 1.0, gradient: 1.0, height: 1.0 }] },
        length: 3.5,
        fronts: 1,
        rays: 9,
        spacing: 10.0,
        first_only: false,
    };
    let (found, _) = complete(&asked);
    assert_eq!(found.caustic.len(), 9);
    // The Jacobian is taken as linear over 1/240 of the way: its zero is off by the square of that, along the ray.
    let along = Tol::stated(1e-4, "(3.5/240)² times an eighth of J″/J′");
    // The ray is a cubic there, and it touches the envelope.
    let across =
        Tol::stated(1e-8, "(3.5/240)⁴, times derivatives of the catenary, and the square of the error along it");
    for mark in &found.caustic {
        let start = 1.0 + mark.parameter;
        let [x, y] = mark.place;
        assert_close("place along the ray", &[x], &[touching * start], along);
        assert_close("the ray", &[y], &[start * (x / start).cosh()], across);
        assert_close("the envelope", &[y], &[x * touching.sinh()], across);
        // ∫ n ds = ∫ a cosh²(x/a) dx.
        let length = 0.5 * start * x + 0.25 * start * start * (2.0 * x / start).sinh();
        assert_close("optical length", &[mark.length], &[length], across);
        assert_eq!(mark.order, 1);
    }
    assert_eq!(found.first_caustic().map(|mark| mark.parameter.to_bits()), Some((-0.25_f64).to_bits()));
}

#[test]
fn fronts_of_a_point_apart_from_the_origin_are_circles_of_even_chords() {
    let place = [1.0, -0.5];
    let asked = Wavefront {
        source: Source::Point { place, from: 0.0, to: TAU },
        medium: Medium { parts: vec![MediumPart::Uniform { index: 1.5 }] },
        length: 3.0,
        fronts: 3,
        rays: 96,
        spacing: 10.0,
        first_only: false,
    };
    let (found, told) = complete(&asked);
    // At least 240 parts in all.
    assert_eq!((told.len(), asked.steps()), (240, 4 * 240));
    let shares: Vec<f64> = (1..=240).map(|part| f64::from(part) / 240.0).collect();
    assert_each_close("shares", &told, &shares, Tol::ulps(1.0));
    let tolerance = Tol::ulps_because(4096.0, "two ulp of coordinates up to 3 m in each of 960 steps");
    for (front, radius) in found.fronts.iter().zip([2.0 / 3.0, 4.0 / 3.0, 2.0]) {
        assert_close("optical length", &[front.length], &[1.5 * radius], tolerance);
        let distances: Vec<f64> = front.pieces[0].iter().map(|[x, y]| (x - place[0]).hypot(y - place[1])).collect();
        assert_close("radius", &distances, &[radius; 97], tolerance);
    }
    assert_eq!((found.fronts.len(), found.count, found.too_wide), (3, 96, 0));
    assert_close_at_scale("widest chord", &[found.widest], &[2.0 * 2.0 * (PI / 96.0).sin()], 2.0, tolerance);
    // Every second ray is kept, from the source to the last front.
    assert_eq!(found.rays.len(), 48);
    assert!(found.rays.iter().all(|ray| ray.len() == 241));
}
