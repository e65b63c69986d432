//! Andrews' squeezing mechanism: seven bodies and angles, three loops, against the published solution.
//!
//! Angles q = (β, Θ, γ, Φ, δ, Ω, ε), in the plane, from the crank at the origin. The slider K2 starts at the end P of
//! the crank and ends at E, where three chains from the pivots B and A meet:
//!
//! ```text
//! P = r (cos β, sin β)                    E = P − d (cos(β + Θ), sin(β + Θ))
//! from B by K3       E = B + s (sin γ, −cos γ)
//! from A by K5, K4   E = A + z_t (cos δ, sin δ) + e (sin(Φ + δ), −cos(Φ + δ))
//! from A by K7, K6   E = A + u (sin ε, −cos ε) + z_f (cos(Ω + ε), sin(Ω + ε))
//! ```
//!
//! The centres of mass follow from the entries of the mass matrix in E. Hairer, G. Wanner, *Solving Ordinary
//! Differential Equations II*, VII.7: m₁₁ shows K1 at `ra` along the crank and K2 at `da` along the slider, m₃₃ K3 at
//! (`sa`, `sb`), m₅₄ and m₇₆ K4 and K6 at `e − ea` and `zf − fa` from their joints. The pivot B lies at
//! x = −0.03635 m: the closure at the published start says so.

use nalgebra::Vector3;
use piola_integrators::Tolerance;
use piola_kinematics::Attitude;
use piola_lagrangian::Placement;
use piola_lagrangian::constraints::{Constrained, Workspace};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, relative_error};
use serde_json::Value;

use crate::systems::{Drive, Spring, System, Ties, body, mechanism};

/// The parameters used, SI.
#[derive(Clone, Copy)]
pub(crate) struct Squeezer {
    masses: [f64; 7],
    moments: [f64; 7],
    a: [f64; 2],
    b: [f64; 2],
    /// The fixed end of the spring, its stiffness, its natural length, and its other end on K3.
    c: [f64; 2],
    stiffness: f64,
    natural: f64,
    on_k3: [f64; 2],
    d: [f64; 2],
    e: [f64; 2],
    r: [f64; 2],
    s: [f64; 3],
    t: [f64; 2],
    u: [f64; 3],
    zf: [f64; 2],
    zt: f64,
}

type Plane<T> = [T; 2];

/// (cos α, sin α) and (sin α, −cos α).
fn directions<T: Real>(angle: T) -> [Plane<T>; 2] {
    let (s, c) = angle.sin_cos();
    [[c, s], [s, -c]]
}

fn from<T: Real>(start: Plane<T>, length: f64, along: Plane<T>) -> Plane<T> {
    [start[0] + T::lit(length) * along[0], start[1] + T::lit(length) * along[1]]
}

impl Squeezer {
    pub(crate) fn place<T: Real>(&self, q: &[T], bodies: &mut impl Placement<T>) {
        let zero = [T::zero(); 2];
        let [beta, theta, gamma, phi, delta, omega, epsilon] = core::array::from_fn(|i| q[i]);
        let mut put = |k: usize, at: Plane<T>, angle: T| {
            let centre = Vector3::new(at[0], at[1], T::zero());
            bodies.body(&body(self.masses[k], self.moments[k]), centre, Attitude::about_z(angle));
        };
        let [crank, _] = directions(beta);
        put(0, from(zero, self.r[1], crank), beta);
        let [slider, _] = directions(beta + theta);
        put(1, from(from(zero, self.r[0], crank), -self.d[1], slider), beta + theta);
        let [across, along] = directions(gamma);
        put(2, from(from(self.b.map(T::lit), self.s[1], along), self.s[2], across), gamma);
        let [k5, beside] = directions(delta);
        let [_, k4] = directions(phi + delta);
        let a = self.a.map(T::lit);
        put(3, from(from(a, self.zt, k5), self.e[0] - self.e[1], k4), phi + delta);
        put(4, from(from(a, self.t[0], k5), self.t[1], beside), delta);
        let [aside, k7] = directions(epsilon);
        let [k6, _] = directions(omega + epsilon);
        put(5, from(from(a, self.u[0], k7), self.zf[0] - self.zf[1], k6), omega + epsilon);
        put(6, from(from(a, self.u[1], k7), self.u[2], aside), epsilon);
    }

    /// ½ c₀ (L − l₀)².
    pub(crate) fn potential<T: Real>(&self, q: &[T]) -> T {
        let [across, along] = directions(q[2]);
        let end = from(from(self.b.map(T::lit), self.on_k3[0], along), self.on_k3[1], across);
        let (x, y) = (end[0] - T::lit(self.c[0]), end[1] - T::lit(self.c[1]));
        let stretch = (x * x + y * y).sqrt() - T::lit(self.natural);
        T::lit(0.5 * self.stiffness) * stretch * stretch
    }

    /// E by the crank less E by each of the three chains.
    pub(crate) fn close<T: Real>(&self, q: &[T], out: &mut [T]) {
        let [crank, _] = directions(q[0]);
        let [slider, _] = directions(q[0] + q[1]);
        let joint = from(from([T::zero(); 2], self.r[0], crank), -self.d[0], slider);
        let (a, b) = (self.a.map(T::lit), self.b.map(T::lit));
        let chains = [
            from(b, self.s[0], directions(q[2])[1]),
            from(from(a, self.zt, directions(q[4])[0]), self.e[0], directions(q[3] + q[4])[1]),
            from(from(a, self.u[0], directions(q[6])[1]), self.zf[0], directions(q[5] + q[6])[0]),
        ];
        for (chain, out) in chains.iter().zip(out.chunks_exact_mut(2)) {
            out[0] = joint[0] - chain[0];
            out[1] = joint[1] - chain[1];
        }
    }
}

/// The published problem: parameters, start and solution at t = 0.03, each (q, q̇, q̈, λ).
pub(crate) struct Published {
    pub(crate) squeezer: &'static Squeezer,
    pub(crate) moment: f64,
    pub(crate) start: Vec<f64>,
    solution: Vec<f64>,
    /// The solution in 30 digits.
    precise: Vec<f64>,
}

pub(crate) fn published() -> Published {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../testdata/reference/andrews_squeezer.json");
    let file: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let p = |name: &str| file["parameters"][name].as_f64().unwrap();
    let numbered = |letter: &str| core::array::from_fn(|k| p(&format!("{letter}{}", k + 1)));
    let squeezer = Squeezer {
        masses: numbered("m"),
        moments: numbered("i"),
        a: [p("xa"), p("ya")],
        b: [p("xb"), p("yb")],
        c: [p("xc"), p("yc")],
        stiffness: p("c0"),
        natural: p("l0"),
        on_k3: [p("sc"), p("sd")],
        d: [p("d"), p("da")],
        e: [p("e"), p("ea")],
        r: [p("rr"), p("ra")],
        s: [p("ss"), p("sa"), p("sb")],
        t: [p("ta"), p("tb")],
        u: [p("u"), p("ua"), p("ub")],
        zf: [p("zf"), p("fa")],
        zt: p("zt"),
    };
    let numbers = |list: &Value| -> Vec<f64> {
        list.as_array().unwrap().iter().map(|x| x.as_str().unwrap().parse().unwrap()).collect()
    };
    let (start, solution) = (numbers(&file["initial_state"]), numbers(&file["published_reference_t003"]));
    let precise = numbers(&file["own_reference_t003"]["state"]);
    let squeezer = Box::leak(Box::new(squeezer));
    Published { squeezer, moment: p("mom"), start, solution, precise }
}

#[test]
fn accelerations_and_multipliers_at_the_start_equal_the_published_ones() {
    let Published { squeezer, moment, start, .. } = published();
    let system = mechanism(System::Squeezer(squeezer), [0.0; 3], moment).with_constraints(Ties::Squeezer(squeezer));
    let assembled = system.assemble(&start[..7], &start[7..14], 0.0).unwrap();
    assert_close("q", &assembled.coordinates, &start[..7], Tol::ulps(8.0));
    assert!(assembled.residual <= 2.0 * f64::EPSILON, "{:e}", assembled.residual);
    assert_eq!(system.degrees_of_freedom(&start[..7], 0.0).unwrap(), 1);
    let acceleration = system.acceleration(&start[..7], &start[7..14], 0.0).unwrap();
    let multipliers = system.multipliers(&start[..7], &start[7..14], 0.0).unwrap();
    let tol = Tol::stated(1e-13, "a thousand ulp: the start is given to sixteen digits and more");
    assert_close("q̈", acceleration.as_slice(), &start[14..21], tol);
    assert_close("λ", multipliers.as_slice(), &start[21..], tol);
}

#[test]
fn squeezer_at_three_hundredths_of_a_second_equals_the_published_solution() {
    let Published { squeezer, moment, start, solution, precise } = published();
    let system = mechanism(System::Squeezer(squeezer), [0.0; 3], moment).with_constraints(Ties::Squeezer(squeezer));
    let tolerance = Tolerance::relative(1e-14).unwrap();
    let run = system.integrate(&start[..7], &start[7..14], 0.0..0.03, tolerance).unwrap();
    let all = complete(&system, run.last());
    let tol = Tol::stated(1e-9, "what is asked of the published solution");
    for i in 0..7 {
        assert_close(&format!("angle {i}"), &all[i..=i], &solution[i..=i], tol);
    }
    assert_close("rates", &all[7..14], &solution[7..14], tol);
    // Every component, small ones too, of the solution in 30 digits.
    for i in 0..27 {
        let tol = Tol::stated(if i < 7 { 1e-12 } else { 1e-10 }, "rounding of a third of a thousand steps");
        assert_close(&format!("component {i}"), &all[i..=i], &precise[i..=i], tol);
    }
    assert!(run.residual() <= 2.0 * f64::EPSILON, "{:e}", run.residual());
    let loops = system.residuals(&all[..7], 0.03);
    assert_close_at_scale("loops", loops.as_slice(), &[0.0; 6], 0.1, Tol::ulps(4.0));
}

/// The published accelerations and multipliers are not those of the published angles and rates: they were found from
/// equations of index three, and are good to 10⁻⁷ of the largest and to 10⁻⁶ of their own. No computation can come
/// nearer to all of the published numbers than they are to each other.
#[test]
fn published_accelerations_are_those_of_the_published_state_to_six_digits_only() {
    let Published { squeezer, moment, solution, precise, .. } = published();
    let system = mechanism(System::Squeezer(squeezer), [0.0; 3], moment).with_constraints(Ties::Squeezer(squeezer));
    let all = complete(&system, (&solution[..7], &solution[7..14]));
    let exact = complete(&system, (&precise[..7], &precise[7..14]));
    for (what, range) in [("q̈", 14..21), ("λ", 21..27)] {
        let (found, expected) = (&all[range.clone()], &solution[range.clone()]);
        assert_close(what, found, expected, Tol::stated(1e-6, "the digits of the published accelerations"));
        assert!(1e-8 < relative_error(found, expected), "the published ones have more digits than that");
        // Not so for the solution in 30 digits.
        let tol = Tol::stated(1e-12, "ulps by the condition of the equations");
        assert_close(what, &exact[range.clone()], &precise[range], tol);
    }
}

/// (q, q̇, q̈, λ) of a state.
fn complete(system: &Constrained<System, Spring, Drive, Ties>, (q, v): (&[f64], &[f64])) -> Vec<f64> {
    let (mut acceleration, mut multipliers) = ([0.0; 7], [0.0; 6]);
    system.solve_into(&mut Workspace::default(), q, v, 0.03, &mut acceleration, &mut multipliers).unwrap();
    q.iter().chain(v).chain(&acceleration).chain(&multipliers).copied().collect()
}
