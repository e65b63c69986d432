//! Identities of brackets and of the Legendre map, and their invariance under random canonical maps.

use piola_hamiltonian::{
    Bracket, Composed, Differential, HamiltonianField, Inverse, InvertiblePhaseMap, LegendreTransform, OneForm,
    PhaseFunction, PhaseMap, PointTransformation, PulledBack, SymplecticGradient, TransformedHamiltonian, TwoForm,
    VectorField, canonical_test, differential, hessian, image_and_jacobian, lie_derivative_of_function,
    lie_derivative_of_one_form, lie_derivative_of_two_form, poisson_bracket, rate_along, time_derivative,
};
use piola_integrators::{DormandPrince853, State, Tolerance};
use piola_lagrangian::{ChangeOfCoordinates, Lagrangian, Workspace};
use piola_numerics::{Gradient, Lanes, Real};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close_at_scale, difference_quotient};
use proptest::prelude::*;

use super::systems::{AnyField, AnyFunction, Relativistic, any_function, any_map, any_point};

/// The terms of the brackets below are sums of some tens of products of numbers up to a few units.
const SCALE: f64 = 30.0;

/// How large a function and its first and second derivatives are at a point, with what a rounding of the point itself
/// changes in them. Errors of brackets are measured by these.
#[derive(Clone, Copy, Debug)]
struct Sizes {
    value: f64,
    slope: f64,
    curvature: f64,
}

fn sizes(function: &AnyFunction, (q, p): (&[f64], &[f64])) -> Sizes {
    let reach = 1.0 + q.iter().chain(p).fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let value = function.value(q, p, 0.3).abs();
    let slope = differential(function, q, p, 0.3).unwrap().amax();
    let curvature = hessian(function, q, p, 0.3).unwrap().amax();
    // Third derivatives are of the size of second ones over the length in which these change, about one.
    Sizes { value: value + reach * slope, slope: slope + reach * curvature, curvature: reach * curvature + slope }
}

/// The largest component of a list of duals, and the largest of its derivatives.
fn values_and_slopes(
    x: &[f64],
    formula: impl Fn(&[Gradient<f64, 4>], &mut [Gradient<f64, 4>]),
    length: usize,
) -> (f64, f64) {
    let point: Vec<_> = x.iter().enumerate().map(|(i, &x)| Gradient::variable(x, i)).collect();
    let mut out = vec![Gradient::constant(0.0); length];
    formula(&point, &mut out);
    let largest = |x: &mut dyn Iterator<Item = f64>| x.fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let slopes = largest(&mut out.iter().flat_map(|x| x.partials));
    (largest(&mut out.iter().map(|x| x.value)), slopes)
}

struct Product<'a>(&'a AnyFunction, &'a AnyFunction);

impl PhaseFunction for Product<'_> {
    fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
        self.0.value(q, p, t) * self.1.value(q, p, t)
    }
}

/// The Lie derivative of a function as a function on phase space.
struct LieOf<'a, K, F>(&'a K, &'a F);

impl<K: VectorField, F: PhaseFunction> PhaseFunction for LieOf<'_, K, F> {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        lie_derivative_of_function(self.0, self.1, &[q, p].concat()).expect("a regular point")
    }
}

/// Forms of both degrees that are neither closed nor canonical.
struct AnyForm<A, B>(A, B);

impl<A: PhaseFunction, B: PhaseFunction> OneForm for AnyForm<A, B> {
    fn components<T: Real>(&self, x: &[T], out: &mut [T]) {
        let (a, b) = (self.0.value(&x[..2], &x[2..], T::zero()), self.1.value(&x[..2], &x[2..], T::zero()));
        out.copy_from_slice(&[b, a * x[3], x[0] * b, a - b]);
    }
}

impl<A: PhaseFunction, B: PhaseFunction> TwoForm for AnyForm<A, B> {
    fn entries<T: Real>(&self, x: &[T], out: &mut [T]) {
        let (a, b) = (self.0.value(&x[..2], &x[2..], T::zero()), self.1.value(&x[..2], &x[2..], T::zero()));
        out.fill(T::zero());
        for (i, j, entry) in [(0, 1, a), (0, 2, b), (0, 3, a * x[1]), (1, 2, b * x[0]), (1, 3, a + b), (2, 3, x[2])] {
            (out[i + 4 * j], out[j + 4 * i]) = (entry, -entry);
        }
    }
}

/// A field or a form on the new phase space of a map as it is seen in the old coordinates.
struct Seen<'a, A, M>(&'a A, M);

impl<A: VectorField, M: InvertiblePhaseMap> VectorField for Seen<'_, A, M> {
    fn components<T: Real>(&self, x: &[T], out: &mut [T]) {
        let (mut image, mut k) = ([T::zero(); 4], [T::zero(); 4]);
        self.1.map(&x[..2], &x[2..], T::zero(), &mut image).expect("a regular point");
        self.0.components(&image, &mut k);
        // Vectors are carried back by the Jacobian of the inverse map.
        let inverse = Inverse(&self.1);
        let (_, back) = image_and_jacobian(&inverse, &image[..2], &image[2..], T::zero()).expect("a regular point");
        for (i, out) in out.iter_mut().enumerate() {
            *out = (0..4).fold(T::zero(), |sum, j| sum + back[(i, j)] * k[j]);
        }
    }
}

impl<A: OneForm, M: PhaseMap> OneForm for Seen<'_, A, M> {
    fn components<T: Real>(&self, x: &[T], out: &mut [T]) {
        let (image, slopes) = image_and_jacobian(&self.1, &x[..2], &x[2..], T::zero()).expect("a regular point");
        let mut alpha = [T::zero(); 4];
        self.0.components(image.as_slice(), &mut alpha);
        for (i, out) in out.iter_mut().enumerate() {
            *out = (0..4).fold(T::zero(), |sum, j| sum + slopes[(j, i)] * alpha[j]);
        }
    }
}

impl<A: TwoForm, M: PhaseMap> TwoForm for Seen<'_, A, M> {
    fn entries<T: Real>(&self, x: &[T], out: &mut [T]) {
        let (image, slopes) = image_and_jacobian(&self.1, &x[..2], &x[2..], T::zero()).expect("a regular point");
        let mut beta = [T::zero(); 16];
        self.0.entries(image.as_slice(), &mut beta);
        for (number, out) in out.iter_mut().enumerate() {
            let (i, j) = (number % 4, number / 4);
            *out = T::zero();
            for (entry, &beta) in beta.iter().enumerate() {
                *out += slopes[(entry % 4, i)] * beta * slopes[(entry / 4, j)];
            }
        }
    }
}

/// Lie derivatives of a function and of forms are tensors: what is derived along a field in the new coordinates and
/// carried back is what is derived along the field seen in the old ones.
fn lie_derivatives_are_carried_by(
    map: &impl InvertiblePhaseMap,
    field: &AnyField<&AnyFunction, &AnyFunction>,
    form: &AnyForm<&AnyFunction, &AnyFunction>,
    (q, p): ([f64; 2], [f64; 2]),
) {
    let x = [q, p].concat();
    let (image, slopes) = image_and_jacobian(map, &q, &p, 0.0).unwrap();
    let seen = Seen(field, map);
    // What the sums are made of at this point: k and the form with their derivatives. Each place of a tensor brings a
    // Jacobian, and a rounding of the place grows by its second derivatives, here at most by the square of the place.
    let size = 1.0 + image.amax();
    let (_, back) = image_and_jacobian(&Inverse(map), &image.as_slice()[..2], &image.as_slice()[2..], 0.0).unwrap();
    let bend = (1.0 + slopes.amax()) * (1.0 + back.amax());
    let (k, k_slope) = values_and_slopes(image.as_slice(), |x, out| field.components(x, out), 4);
    let (one, one_slope) = values_and_slopes(image.as_slice(), |x, out| form.components(x, out), 4);
    let (two, two_slope) = values_and_slopes(image.as_slice(), |x, out| form.entries(x, out), 16);
    let terms = |form: f64, slope: f64| size * size * (k * slope + form * k_slope);
    let (f, one, two) = (terms(0.0, one_slope), terms(one, one_slope), terms(two, two_slope));
    let rounding = Tol::ulps(4.0);
    let there = lie_derivative_of_function(field, form.0, image.as_slice()).unwrap();
    let here = lie_derivative_of_function(&seen, &PulledBack { function: form.0, map }, &x).unwrap();
    assert_close_at_scale("L_k f", &[here], &[there], f * bend, rounding);
    let there = slopes.transpose() * lie_derivative_of_one_form(field, form, image.as_slice()).unwrap();
    let here = lie_derivative_of_one_form(&seen, &Seen(form, map), &x).unwrap();
    assert_close_at_scale("L_k α", here.as_slice(), there.as_slice(), one * bend.powi(2), rounding);
    let there = slopes.transpose() * lie_derivative_of_two_form(field, form, image.as_slice()).unwrap() * &slopes;
    let here = lie_derivative_of_two_form(&seen, &Seen(form, map), &x).unwrap();
    assert_close_at_scale("L_k β", here.as_slice(), there.as_slice(), two * bend.powi(3), rounding);
}

/// New coordinates that bend, and that move with the time.
#[derive(Clone, Copy, Debug)]
struct Sheared([f64; 4]);

impl ChangeOfCoordinates<2> for Sheared {
    const TIME_DEPENDENT: bool = true;
    fn old_coordinates<T: Real>(&self, new: &[T], t: T) -> [T; 2] {
        let c = self.0.map(T::lit);
        [
            new[0] + c[0] * (new[1] + t).sin() + c[1] * t,
            T::lit(1.25) * new[1] + c[2] * new[0] * new[0] + c[3] * t * new[0],
        ]
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(2_000)))]

    #[test]
    fn the_lie_derivative_of_a_function_goes_with_its_differential(
        a in any_function(), b in any_function(), f in any_function(), (q, p) in any_point(),
    ) {
        let (x, field) = ([q, p].concat(), AnyField(a, b));
        let of_differential = lie_derivative_of_one_form(&field, &Differential(&f), &x).unwrap();
        let mut differential = [0.0; 4];
        Differential(LieOf(&field, &f)).components(&x, &mut differential);
        assert_close_at_scale("L_k df = d L_k f", of_differential.as_slice(), &differential, 4.0 * SCALE, Tol::ulps(20.0));
    }

    #[test]
    fn the_lie_derivative_of_a_function_along_hamiltons_field_is_its_poisson_bracket(
        k in any_function(), h in any_function(), (q, p) in any_point(), t in -2.0..2.0_f64,
    ) {
        let motion = SymplecticGradient(&h);
        let along = lie_derivative_of_function(&motion, &k, &[q, p].concat()).unwrap();
        let bracket = poisson_bracket(&k, &h, &q, &p, 0.0).unwrap();
        assert_close_at_scale("L_h K = {K, H}", &[along], &[bracket], SCALE, Tol::ulps(20.0));
        // On the extended space the field has the component one along the time.
        let along = lie_derivative_of_function(&motion, &k, &[&q[..], &p, &[t]].concat()).unwrap();
        let rate = rate_along(&k, &h, &q, &p, t).unwrap();
        assert_close_at_scale("L_h K = ∂K/∂t + {K, H}", &[along], &[rate], SCALE, Tol::ulps(20.0));
    }

    #[test]
    fn the_bracket_is_skew_to_the_last_bit(k in any_function(), h in any_function(), (q, p) in any_point()) {
        let there = poisson_bracket(&k, &h, &q, &p, 0.3).unwrap();
        let back = poisson_bracket(&h, &k, &q, &p, 0.3).unwrap();
        prop_assert!((there + back).abs() <= 0.0);
        prop_assert!(poisson_bracket(&h, &h, &q, &p, 0.3).unwrap().abs() <= 0.0);
    }

    #[test]
    fn the_bracket_is_a_derivation(
        k in any_function(), l in any_function(), m in any_function(), (q, p) in any_point(),
    ) {
        let bracket = |a: &AnyFunction, b: &AnyFunction| poisson_bracket(a, b, &q, &p, 0.3).unwrap();
        let product = poisson_bracket(&Product(&k, &l), &m, &q, &p, 0.3).unwrap();
        let parts = k.value(&q, &p, 0.3) * bracket(&l, &m) + bracket(&k, &m) * l.value(&q, &p, 0.3);
        let [a, b, c] = [&k, &l, &m].map(|function| sizes(function, (&q, &p)));
        let terms = (a.value * b.slope + a.slope * b.value) * c.slope;
        assert_close_at_scale("{K L, M}", &[product], &[parts], terms, Tol::ulps(1.0));
    }

    #[test]
    fn nested_brackets_obey_jacobis_identity(
        k in any_function(), l in any_function(), m in any_function(), (q, p) in any_point(),
    ) {
        let nested = |a: &AnyFunction, b: &AnyFunction, c: &AnyFunction| {
            poisson_bracket(a, &Bracket(b, c), &q, &p, 0.3).unwrap()
        };
        let sum = nested(&k, &l, &m) + nested(&l, &m, &k) + nested(&m, &k, &l);
        let [a, b, c] = [&k, &l, &m].map(|function| sizes(function, (&q, &p)));
        let terms = a.slope * (b.curvature * c.slope + b.slope * c.curvature) + a.curvature * b.slope * c.slope;
        assert_close_at_scale("Jacobi", &[sum], &[0.0], terms, Tol::ulps(1.0));
    }

    #[test]
    fn brackets_through_a_canonical_map_are_brackets_at_the_image(
        k in any_function(),
        h in any_function(),
        q in prop::array::uniform2(-0.8..0.8_f64),
        p in prop::array::uniform2(-0.8..0.8_f64),
        map in any_map(),
    ) {
        let mut image = [0.0; 4];
        map.map(&q, &p, 0.3, &mut image).unwrap();
        let through = poisson_bracket(
            &PulledBack { function: &k, map }, &PulledBack { function: &h, map }, &q, &p, 0.3,
        ).unwrap();
        let at_image = poisson_bracket(&k, &h, &image[..2], &image[2..], 0.3).unwrap();
        // Slopes of both functions at the image, seen through the Jacobian of the map.
        let (_, jacobian) = image_and_jacobian(&map, &q, &p, 0.3).unwrap();
        let bend = 1.0 + jacobian.amax();
        let [there, here] = [&k, &h].map(|function| sizes(function, image.split_at(2)).slope);
        let scale = bend * bend * there * here;
        assert_close_at_scale("{K, H}∘φ", &[through], &[at_image], scale, Tol::ulps(2.0));
    }

    #[test]
    fn random_canonical_maps_their_compositions_and_inverses_keep_the_symplectic_form(
        (q, p) in any_point(), first in any_map(), second in any_map(),
    ) {
        // Entries of a Jacobian that nearly vanish are rounding of what they are differences of: beside them the residual has
        // no bound of some ulp.
        prop_assert!(canonical_test(&first, &q, &p, 0.0).unwrap().relative < 1e-9);
        let both = Composed(first, second);
        prop_assert!(canonical_test(&both, &q, &p, 0.0).unwrap().relative < 1e-9);
        prop_assert!(canonical_test(&Inverse(&both), &q, &p, 0.0).unwrap().relative < 1e-9);
        let (mut there, mut back) = ([0.0; 4], [0.0; 4]);
        both.map(&q, &p, 0.0, &mut there).unwrap();
        Inverse(&both).map(&there[..2], &there[2..], 0.0, &mut back).unwrap();
        let size = there.iter().map(|x| x.abs()).fold(1.0, f64::max);
        assert_close_at_scale("φ⁻¹∘φ", &back, &[q[0], q[1], p[0], p[1]], size * size * size, Tol::ulps(100.0));
    }

    #[test]
    fn the_hamiltonian_is_one_function_in_all_coordinates_but_for_their_own_motion(
        new in prop::array::uniform2(-0.8..0.8_f64),
        v in prop::array::uniform2(-0.5..0.5_f64),
        bends in prop::array::uniform4(-0.2..0.2_f64),
        t in -0.5..0.5_f64,
    ) {
        let (old, change) = (Lagrangian::from_function(Relativistic { wobble: 0.5 }), Sheared(bends));
        let q = change.old_coordinates(&new, t);
        let p = old.momenta(&q, &v, t).unwrap();
        // The momenta in the new coordinates, and F = −p·∂c/∂t.
        let map = PointTransformation::new(change, new);
        let mut image = [0.0; 4];
        map.map(&q, p.as_slice(), t, &mut image).unwrap();
        let excess = map.excess(&q, p.as_slice(), t).unwrap();
        let seen = Lagrangian::from_function(Relativistic { wobble: 0.5 }).in_coordinates(change);
        let (here, there) = (old.hamiltonian(&q, p.as_slice(), t).unwrap(), seen.hamiltonian(&image[..2], &image[2..], t).unwrap());
        assert_close_at_scale("H̄ = H + F", &[there], &[here + excess], 5.0, Tol::ulps(40.0));
    }

    #[test]
    fn lanes_give_the_brackets_of_each_lane(k in any_function(), h in any_function(), (q, p) in any_point()) {
        let spread = |x: f64| Lanes::<f64, 4>::load(&[x, x + 0.125, x + 0.25, x + 0.375], x);
        let t = Lanes::lit(0.3);
        let lanes = poisson_bracket(&k, &h, &q.map(spread), &p.map(spread), t).unwrap();
        for lane in 0..4 {
            let at = |x: [f64; 2]| x.map(|x| spread(x).primal(lane));
            let alone = poisson_bracket(&k, &h, &at(q), &at(p), 0.3).unwrap();
            assert_close_at_scale("lane", &[lanes.primal(lane)], &[alone], SCALE, Tol::ulps(20.0));
        }
    }

    #[test]
    fn velocities_of_the_momenta_of_velocities_are_the_velocities(
        q in prop::array::uniform2(-1.0..1.0_f64), v in prop::array::uniform2(-0.65..0.65_f64), t in 0.0..5.0_f64,
    ) {
        let particle = Lagrangian::from_function(Relativistic { wobble: 0.5 });
        let p = particle.momenta(&q, &v, t).unwrap();
        let mut back = [0.0; 2];
        particle.velocities_into(&mut Workspace::default(), &q, p.as_slice(), t, &mut back).unwrap();
        // ∂v/∂p is at most one.
        assert_close_at_scale("v", &back, &v, 1.0, Tol::ulps(20.0));
        let certificate = particle.legendre_certificate(&q, &back, p.as_slice(), t).unwrap();
        // Newton's iteration ends where its corrections are made of rounding.
        assert!(certificate.residual < 1e-14 && certificate.correction < 1e-14, "{certificate:?}");
        // H = γ (1 + γ² v v): the second pivot over its entry is (1 − v²)/((1 − v₁²)(1 − v₂²)), at least 0.46.
        let squares = v.map(|v| v * v);
        let pivot = (1.0 - squares[0] - squares[1]) / ((1.0 - squares[0]) * (1.0 - squares[1]));
        assert_close_at_scale("pivot", &[certificate.smallest_pivot], &[pivot], 1.0, Tol::ulps(64.0));
        let hamiltonian = LegendreTransform(&particle);
        let expected = (1.0 + p.norm_squared()).sqrt() + 0.5 * (1.0 + 0.5 * t.sin()) * (q[0] * q[0] + q[1] * q[1]);
        let value = hamiltonian.value(&q, p.as_slice(), t);
        assert_close_at_scale("H", &[value], &[expected], expected, Tol::ulps(8.0));
        let growth = time_derivative(&hamiltonian, &q, p.as_slice(), t).unwrap();
        let expected = 0.25 * t.cos() * (q[0] * q[0] + q[1] * q[1]);
        assert_close_at_scale("∂H/∂t", &[growth], &[expected], 1.0, Tol::ulps(20.0));
        let loss = particle.time_derivative(&q, &v, t).unwrap();
        assert_close_at_scale("∂H/∂t = −∂L/∂t", &[growth], &[-loss], 1.0, Tol::ulps(20.0));
    }

    #[test]
    fn the_rate_of_a_function_along_the_motion_is_its_difference_quotient(
        k in any_function(), h in any_function(), (q, p) in any_point(),
    ) {
        let rate = rate_along(&k, &h, &q, &p, 0.3).unwrap();
        let along = |time: f64| {
            let mut field = HamiltonianField::new(&h, 2);
            let mut state = State::new(0.3, [q, p].concat()).unwrap();
            DormandPrince853::new(Tolerance::relative(1e-13).unwrap())
                .integrate_to(&mut field, &mut state, 0.3 + time)
                .unwrap();
            let (q, p) = state.values.split_at(2);
            k.value(q, p, 0.3 + time)
        };
        let quotient = difference_quotient(|x| vec![along(x[0])], &[0.0], &[1.0]);
        assert_close_at_scale("dK/dt", &quotient, &[rate], SCALE, Tol::stated(1e-7, "a quotient of differences"));
    }
}

proptest! {
    // Four maps a case, through derivatives of derivatives.
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn lie_derivatives_seen_through_maps_are_lie_derivatives_at_the_image(
        a in any_function(),
        b in any_function(),
        f in any_function(),
        q in prop::array::uniform2(-0.8..0.8_f64),
        p in prop::array::uniform2(-0.8..0.8_f64),
        map in any_map(),
        bends in prop::array::uniform4(-0.2..0.2_f64),
    ) {
        let (field, form) = (AnyField(&a, &b), AnyForm(&f, &a));
        lie_derivatives_are_carried_by(&map, &field, &form, (q, p));
        lie_derivatives_are_carried_by(&PointTransformation::new(Sheared(bends), q), &field, &form, (q, p));
    }
}

#[test]
fn motions_of_a_hamiltonian_through_a_map_are_motions_of_the_new_hamiltonian() {
    let (q, p) = ([0.3, -0.7], [0.5, 0.2]);
    let hamiltonian = AnyFunction([0.3, -0.2, 0.5, 0.4, 0.1, 0.25, 0.3]);
    let map = super::systems::AnyMap([0.3, -0.2, 0.4, 0.1, 0.6, -0.3]);
    let run = |hamiltonian: &dyn Fn(&mut State), start: Vec<f64>| {
        let mut state = State::new(0.0, start).unwrap();
        hamiltonian(&mut state);
        state.values
    };
    let tolerance = || Tolerance::relative(1e-13).unwrap();
    let old = run(
        &|state| {
            let mut field = HamiltonianField::new(&hamiltonian, 2);
            DormandPrince853::new(tolerance()).integrate_to(&mut field, state, 2.0).map(|_| ()).unwrap();
        },
        [q, p].concat(),
    );
    let (mut start, mut expected) = ([0.0; 4], [0.0; 4]);
    map.map(&q, &p, 0.0, &mut start).unwrap();
    map.map(&old[..2], &old[2..], 2.0, &mut expected).unwrap();
    let new = run(
        &|state| {
            let seen = TransformedHamiltonian { hamiltonian: &hamiltonian, map };
            let mut field = HamiltonianField::new(&seen, 2);
            DormandPrince853::new(tolerance()).integrate_to(&mut field, state, 2.0).map(|_| ()).unwrap();
        },
        start.to_vec(),
    );
    assert_close_at_scale("φ(motion)", &new, &expected, 1.0, Tol::stated(1e-11, "two integrations at 1e-13"));
}
