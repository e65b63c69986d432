//! Laminated plates, tubes and spheres: reference data, limits, loads, residual stress, motion.

use core::f64::consts::TAU;

use piola_integrators::{DormandPrince853, Field, State, Tolerance};
use piola_numerics::Real;
use piola_solids::isochoric::{Gent, Isochoric, MooneyRivlin, NeoHookean, Rivlin, RivlinTerm};
use piola_tensor::Symmetric;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, difference_quotient, golden};
use piola_uniformity::UniformityError;
use piola_uniformity::laminated::{
    HomogeneousPlate, HomogeneousTube, LaminaMetric, LaminaStress, LaminatedOscillation, LaminatedPlate,
    LaminatedSphere, LaminatedTube, Lamination, SheetHistory, SheetLoads, SheetMotion, SheetState,
};
use serde_json::Value;

/// The specification's tolerance of the reference data.
const REFERENCE: Tol = Tol::stated(1e-12, "the specification's tolerance of the reference data");

fn polynomial<T: Real>(coefficients: &[f64], x: T) -> T {
    coefficients.iter().rev().fold(T::zero(), |sum, &c| sum * x + T::lit(c))
}

/// `M = m₁² dX² + h_ab dY^a dY^b` with h₁₁ = a², h₁₂ = a c, h₂₂ = b² + c², all polynomials.
struct Polynomials {
    normal: Vec<f64>,
    a: Vec<f64>,
    b: Vec<f64>,
    c: Vec<f64>,
}

impl Lamination for Polynomials {
    fn metric<T: Real>(&self, depth: T) -> LaminaMetric<T> {
        let [a, b, c] = [&self.a, &self.b, &self.c].map(|coefficients| polynomial(coefficients, depth));
        LaminaMetric { normal: polynomial(&self.normal, depth), in_plane: [a * a, b * b + c * c, a * c] }
    }
}

/// Either of the reference data's laws.
#[derive(Clone)]
enum Law {
    MooneyRivlin(MooneyRivlin),
    Gent(Gent),
}

impl Law {
    fn of(model: &Value) -> Self {
        let number = |key: &str| golden::number(&model[key]);
        match golden::text(&model["name"]) {
            "gent" => Self::Gent(Gent::new(number("mu"), number("Jm")).expect("moduli")),
            _ => Self::MooneyRivlin(MooneyRivlin::new(number("c10"), number("c01")).expect("moduli")),
        }
    }
}

impl Isochoric for Law {
    const SECOND: bool = true;
    fn energy<T: Real>(&self, first: T, second: T) -> T {
        match self {
            Self::MooneyRivlin(law) => law.energy(first, second),
            Self::Gent(law) => law.energy(first, second),
        }
    }
    fn slopes<T: Real>(&self, first: T, second: T) -> [T; 2] {
        match self {
            Self::MooneyRivlin(law) => law.slopes(first, second),
            Self::Gent(law) => law.slopes(first, second),
        }
    }
    fn curvatures<T: Real>(&self, first: T, second: T) -> [T; 3] {
        match self {
            Self::MooneyRivlin(law) => law.curvatures(first, second),
            Self::Gent(law) => law.curvatures(first, second),
        }
    }
}

fn flat(value: &Value) -> Vec<f64> {
    golden::matrix(value).concat()
}

fn rows(stress: &LaminaStress) -> Vec<f64> {
    stress.cauchy.0.rows().as_flattened().to_vec()
}

/// Compares one state at all points of a case; returns how many.
fn compare<A: Lamination>(id: &str, case: &Value, state: &SheetState<A>, law: &Law, is_cylinder: bool) -> usize {
    let start = golden::vector(&case["ref_coords0"])[0];
    // T₁₁ = 0 at ref_coords0, not at the inner face.
    let at_inner = -state.stress(law, start, 0.0).expect("T").cauchy.0.components[0];
    let at_inner = if is_cylinder { at_inner } else { 0.0 };
    let points = case["points"].as_array().expect("points");
    for point in points {
        let particle: [f64; 3] = golden::vector(&point["ref_coords"]).try_into().expect("three");
        let close = |what: &str, actual: &[f64], expected: &[f64]| {
            assert_close_at_scale(&format!("{id}: {what}"), actual, expected, 1.0, REFERENCE);
        };
        close("place", &state.place(particle).expect("x"), &golden::vector(&point["cur_coords"]));
        let strain = state.left_cauchy_green(particle[0]).expect("B");
        close("B", strain.rows().as_flattened(), &flat(&point["B_phys"]));
        let stress = state.stress(law, particle[0], at_inner).expect("T");
        close("T", &rows(&stress), &flat(&point["T_phys"]));
        close("p", &[stress.pressure], &[golden::number(&point["p"])]);
    }
    points.len()
}

#[test]
fn laminated_plates_equal_reference() {
    let mut compared = 0;
    for case in golden::load("universal").cases.iter().filter(|case| golden::text(&case["id"]).starts_with("laminated"))
    {
        let id = golden::text(&case["id"]);
        let (p, law) = (&case["params"], Law::of(&case["model"]));
        let list = |key: &str| golden::vector(&p[key]);
        let number = |key: &str| golden::number(&p[key]);
        let lamination = Polynomials { normal: list("m1"), a: list("a"), b: list("b"), c: list("c") };
        let plate = LaminatedPlate::new(lamination, [number("X0"), 1.0]).expect("a plate");
        let matrix = [[number("B"), number("C")], [number("D"), number("E")]];
        let is_cylinder = id.contains("cylinder");
        let state = if is_cylinder { plate.bent(number("r0"), matrix) } else { plate.flat(number("r0"), matrix) };
        let state = state.expect("a state");
        compared += compare(id, case, &state, &law, is_cylinder);
        for point in case["points"].as_array().expect("points") {
            let depth = golden::vector(&point["ref_coords"])[0];
            let gradient = state.gradient(depth).expect("F");
            assert_close("F", gradient.as_flattened(), &flat(&point["F_phys"]), REFERENCE);
        }
    }
    assert_eq!(compared, 6, "points of four cases");
}

#[test]
fn laminated_bodies_reduce_to_homogeneous_ones() {
    let mut compared = 0;
    for case in &golden::load("universal").cases {
        let id = golden::text(&case["id"]);
        let p = &case["params"];
        if id.starts_with("torsion") {
            compared += torsion(id, case);
            continue;
        } else if !id.starts_with("family") {
            continue;
        }
        let law = Law::of(&case["model"]);
        let number = |key: &str| golden::number(&p[key]);
        if id.starts_with("family1") {
            let plate = LaminatedPlate::new(HomogeneousPlate, [0.25, 3.0]).expect("a plate");
            let matrix = [[number("B"), number("C")], [number("D"), number("E")]];
            let state = plate.bent((2.0 * number("A") * 0.25).sqrt(), matrix).expect("a state");
            compared += compare(id, case, &state, &law, true);
        } else if id.starts_with("family2") {
            let tube = LaminatedTube::new(HomogeneousTube, [0.25, 3.0]).expect("a tube");
            let matrix = [[number("B"), number("C")], [number("D"), number("E")]];
            let state = tube.straightened(0.5 * number("A") * 0.0625, matrix).expect("a state");
            compared += compare(id, case, &state, &law, false);
        } else if id.starts_with("family3") {
            let tube = LaminatedTube::new(HomogeneousTube, [0.25, 3.0]).expect("a tube");
            let matrix = [[number("C"), number("D")], [number("E"), number("F")]];
            let state = tube.inflated((number("A") * 0.0625 + number("B")).sqrt(), matrix).expect("a state");
            compared += compare(id, case, &state, &law, true);
        } else if id.starts_with("family4") {
            let sphere = LaminatedSphere::new(HomogeneousTube, [0.25, 3.0]).expect("a sphere");
            let radius = (number("sign") * 0.25_f64.powi(3) + number("A")).cbrt();
            let state = if 0.0 < number("sign") { sphere.inflated(radius) } else { sphere.everted(radius) };
            let state = state.expect("a state");
            let start = golden::vector(&case["ref_coords0"])[0];
            let at_inner = -state.stress(&law, start, 0.0).expect("T").cauchy.0.components[0];
            for point in case["points"].as_array().expect("points") {
                let depth = golden::vector(&point["ref_coords"])[0];
                let radius = golden::vector(&point["cur_coords"])[0];
                assert_close(id, &[state.radius(depth).expect("r")], &[radius], REFERENCE);
                let strain = state.left_cauchy_green(depth).expect("B");
                assert_close(id, strain.rows().as_flattened(), &flat(&point["B_phys"]), REFERENCE);
                let stress = state.stress(&law, depth, at_inner).expect("T");
                assert_close_at_scale(id, &rows(&stress), &flat(&point["T_phys"]), 1.0, REFERENCE);
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 18, "points of families 1 to 4 with two laws, and two twisted rods");
}

/// W = C₁₀ (I − 3) + C₀₂ (II − 3)²: both invariants of the stretch must be right.
#[test]
fn stress_of_a_stretched_plate_equals_the_closed_form_of_a_law_of_both_invariants() {
    let (c10, c02) = (0.5, 0.3);
    let term = |first, second, coefficient| RivlinTerm { first, second, coefficient };
    let law = Rivlin::new(vec![term(1, 0, c10), term(0, 2, c02)]).expect("a law");
    let plate = LaminatedPlate::new(HomogeneousPlate, [0.0, 1.0]).expect("a plate");
    let [y, z]: [f64; 2] = [1.3, 0.9];
    let [a, b, c] = [1.0 / (y * z), y, z].map(|stretch| stretch * stretch);
    // Tᵢ − Tⱼ = 2 (λᵢ² − λⱼ²)(W₁ + λₖ² W₂) with W₁ = C₁₀, W₂ = 2 C₀₂ (II − 3).
    let slope = 2.0 * c02 * (a * b + b * c + c * a - 3.0);
    let expected = [0.0, 2.0 * (b - a) * (c10 + c * slope), 2.0 * (c - a) * (c10 + b * slope), 0.0, 0.0, 0.0];
    let state = plate.flat(0.0, [[y, 0.0], [0.0, z]]).expect("a state");
    let stress = state.stress(&law, 0.5, 0.0).expect("T").cauchy.0.components;
    assert_close_at_scale("T", &stress, &expected, 1.0, Tol::ulps(16.0));
}

/// A solid rod, twisted and stretched: axial force and torque.
fn torsion(id: &str, case: &Value) -> usize {
    let number = |key: &str| golden::number(&case["params"][key]);
    let (stretch, twist) = (number("lam"), number("psi"));
    let law = &MooneyRivlin::new(number("c10"), number("c01")).expect("moduli");
    let rod = LaminatedTube::new(HomogeneousTube, [0.0, number("R0")]).expect("a rod");
    let state = rod.inflated(0.0, [[1.0, twist], [0.0, stretch]]).expect("a state");
    // The lateral surface is free.
    let at_axis = -state.loads(law, 0.0).expect("loads").normal_stress_difference;
    let loads = state.loads(law, at_axis).expect("loads");
    let (force, torque) = (golden::number(&case["output"]["N"]), golden::number(&case["output"]["M"]));
    assert_close(id, &[TAU * loads.second_force], &[force], REFERENCE);
    assert_close(id, &[TAU * loads.shear], &[torque], REFERENCE);
    1
}

/// A plate or tube of two layers with a jump, and a smooth change in each.
#[derive(Clone, Copy)]
struct Layers;

impl Lamination for Layers {
    fn metric<T: Real>(&self, depth: T) -> LaminaMetric<T> {
        let upper = T::lit(1.5).less_than(depth);
        let growth = T::select(upper, T::lit(1.1) + T::lit(0.05) * depth, T::one());
        let axial = T::select(upper, T::lit(0.95), T::lit(1.05));
        let shear = T::lit(0.1) * depth;
        LaminaMetric {
            normal: T::one() + T::lit(0.1) * depth,
            in_plane: [(growth * depth).powi(2), axial * axial + T::lit(0.01), shear],
        }
    }
    fn interfaces(&self) -> &[f64] {
        &[1.5]
    }
}

/// Gauss's rule of three points on 64 panels in each layer: forces and moments from the stresses themselves.
fn summed(state: &SheetState<&Layers>, law: &impl Isochoric, at_inner: f64, is_cylinder: bool) -> [f64; 5] {
    let node = 0.6_f64.sqrt();
    let mut sums = [0.0; 5];
    for (low, high) in [(1.0, 1.5), (1.5, 2.0)] {
        let width = (high - low) / 64.0;
        for panel in 0..64 {
            for (x, weight) in [(-node, 5.0 / 18.0), (0.0, 8.0 / 18.0), (node, 5.0 / 18.0)] {
                let depth = low + width * (f64::from(panel) + 0.5 + 0.5 * x);
                let t = state.stress(law, depth, at_inner).expect("T").cauchy.0.components;
                let (across, slope) =
                    (state.place([depth, 0.0, 0.0]).expect("x")[0], state.gradient(depth).expect("F")[0][0].abs());
                let radius = if is_cylinder { across } else { 1.0 };
                let second_moment = if is_cylinder { 0.0 } else { t[2] * across };
                let terms = [t[1], t[2] * radius, t[4] * radius * radius, t[1] * across, second_moment];
                for (sum, term) in sums.iter_mut().zip(terms) {
                    *sum += weight * width * slope * term;
                }
            }
        }
    }
    sums
}

#[test]
fn loads_equal_integrals_of_the_stresses() {
    let law = MooneyRivlin::new(0.5, 0.25).expect("moduli");
    let (plate, tube) = (
        LaminatedPlate::new(Layers, [1.0, 2.0]).expect("a plate"),
        LaminatedTube::new(Layers, [1.0, 2.0]).expect("a tube"),
    );
    let matrix = [[0.9, 0.2], [-0.1, 1.2]];
    let everted = [[0.9, 0.2], [0.1, -1.2]];
    let states = [
        (plate.flat(0.5, matrix), false),
        (plate.bent(1.0, matrix), true),
        (tube.straightened(0.5, matrix), false),
        (tube.inflated(1.1, matrix), true),
        (tube.inflated(2.5, everted), true),
    ];
    let mut compared = 0;
    for (state, is_cylinder) in states {
        let state = state.expect("a state");
        let SheetLoads { normal_stress_difference, first_force, second_force, shear, first_moment, second_moment } =
            state.loads(&law, 0.25).expect("loads");
        let expected = summed(&state, &law, 0.25, is_cylinder);
        let found = [first_force, second_force, shear, first_moment, second_moment];
        let tol = Tol::stated(1e-10, "Gauss's rule of order six on 128 panels");
        assert_close_at_scale("loads", &found, &expected, 1.0, tol);
        let outer = state.stress(&law, 2.0, 0.25).expect("T").cauchy.0.components[0];
        assert_close_at_scale("T11", &[0.25 + normal_stress_difference], &[outer], 1.0, Tol::ulps(64.0));
        compared += 1;
    }
    assert_eq!(compared, 5);
}

/// ∫ f dX over both layers, by Gauss's rule of three points on 64 panels in each.
fn through_layers(f: impl Fn(f64) -> f64) -> f64 {
    let node = 0.6_f64.sqrt();
    let mut sum = 0.0;
    for low in [1.0, 1.5] {
        let width = 0.5 / 64.0;
        for panel in 0..64 {
            for (x, weight) in [(-node, 5.0 / 18.0), (0.0, 8.0 / 18.0), (node, 5.0 / 18.0)] {
                sum += weight * width * f(low + width * (f64::from(panel) + 0.5 + 0.5 * x));
            }
        }
    }
    sum
}

/// W of a strain B with det B = 1.
fn stored(law: &impl Isochoric, strain: &Symmetric) -> f64 {
    law.energy(strain.trace() - 3.0, strain.inverse().expect("B⁻¹").trace() - 3.0)
}

/// A state of origin and matrix.
type Make<'a> = Box<dyn Fn(f64, [[f64; 2]; 2]) -> Result<SheetState<&'a Layers>, UniformityError> + 'a>;

#[test]
fn loads_of_laminated_bodies_equal_derivatives_of_their_energy() {
    let law = MooneyRivlin::new(0.5, 0.25).expect("moduli");
    let tol = Tol::stated(1e-8, "differences of the sixth order");
    let (plate, tube) = (
        LaminatedPlate::new(Layers, [1.0, 2.0]).expect("a plate"),
        LaminatedTube::new(Layers, [1.0, 2.0]).expect("a tube"),
    );
    let (flat, everted) = ([[0.9, 0.2], [-0.1, 1.2]], [[0.9, 0.2], [0.1, -1.2]]);
    let states: [(Make<'_>, f64, [[f64; 2]; 2], bool); 5] = [
        (Box::new(|x, q| plate.flat(x, q)), 0.5, flat, false),
        (Box::new(|r, q| plate.bent(r, q)), 1.0, flat, true),
        (Box::new(|x, q| tube.straightened(x, q)), 0.5, flat, false),
        (Box::new(|r, q| tube.inflated(r, q)), 1.1, flat, true),
        (Box::new(|r, q| tube.inflated(r, q)), 2.5, everted, true),
    ];
    let volume = |depth: f64| Lamination::metric::<f64>(&Layers, depth).volume();
    let whole = through_layers(volume);
    let mut compared = 0;
    for (make, origin, matrix, is_cylinder) in states {
        // E for a unit of the two coordinates of the reference along the laminae; x = (r₀, Q).
        let energy = |x: &[f64]| {
            let state = make(x[0], [[x[1], x[2]], [x[3], x[4]]]).expect("a state");
            let density = |depth: f64| stored(&law, &state.left_cauchy_green(depth).expect("B")) * volume(depth);
            vec![through_layers(density)]
        };
        let at_inner = 0.25;
        let state = make(origin, matrix).expect("a state");
        let loads = state.loads(&law, at_inner).expect("loads");
        let [[b, c], [d, e]] = matrix;
        let determinant = b * e - c * d;
        // δQ = L Q at a fixed place of the inner face: forces, moment and torque, and T₁₁ at the outer face.
        for l in [[[1.0, 0.0], [0.0, 0.0]], [[0.0, 0.0], [0.0, 1.0]], [[0.0, 1.0], [0.0, 0.0]]] {
            let [[l11, l12], [_, l22]] = l;
            let change = [0.0, l11 * b + l12 * d, l11 * c + l12 * e, l22 * d, l22 * e];
            let slope = difference_quotient(energy, &[origin, b, c, d, e], &change);
            let along = if is_cylinder { loads.first_moment } else { loads.first_force };
            let work = determinant.abs() * (along * l11 + loads.second_force * l22 + loads.shear * l12);
            let outer = (at_inner + loads.normal_stress_difference) * whole * (l11 + l22);
            assert_close_at_scale("dE", &[work - outer], &slope, 1.0, tol);
            compared += 1;
        }
        // δr₀ of a cylinder: the pressure; a plane is moved only.
        let slope = difference_quotient(energy, &[origin, b, c, d, e], &[1.0, 0.0, 0.0, 0.0, 0.0]);
        let work = if is_cylinder { determinant * origin * loads.normal_stress_difference } else { 0.0 };
        assert_close_at_scale("dE/dr₀", &[work], &slope, 1.0, tol);
    }
    assert_eq!(compared, 15);

    let shell = LaminatedSphere::new(Layers, [1.0, 2.0]).expect("a shell");
    for (sign, radius) in [(1.0, 1.3), (-1.0, 3.0)] {
        let state = |radius: f64| if 0.0 < sign { shell.inflated(radius) } else { shell.everted(radius) };
        let energy = |x: &[f64]| {
            let state = state(x[0]).expect("a state");
            let density = |depth: f64| {
                let lamina: LaminaMetric = Layers.metric(depth);
                stored(&law, &state.left_cauchy_green(depth).expect("B")) * lamina.normal * lamina.in_plane[0]
            };
            vec![through_layers(density)]
        };
        let difference = state(radius).expect("a state").normal_stress_difference(&law).expect("T");
        let slope = difference_quotient(energy, &[radius], &[1.0]);
        assert_close_at_scale("dE/dr₀", &[sign * radius * radius * difference], &slope, 1.0, tol);
    }
}

#[test]
fn general_form_of_family_0_is_no_solution() {
    // The trap: a shear y = Y + k X of a laminated plate. Equilibrium asks for T_xy′ = ∂p/∂y and T_xx′ = ∂p/∂x with stresses that depend on X
    // alone, so that p = y T_xy′(X) + …, and T_xy″ = 0; but T_xy = g₁ B_xy = μ x_X M^XX y_X is not linear in X.
    let law = NeoHookean::new(1.0).expect("a modulus");
    let shear_modulus = 2.0 * law.slopes(0.0, 0.0)[0];
    let of_layers = |depth: f64| shear_modulus * 0.5 / Lamination::metric::<f64>(&Layers, depth).normal.powi(2);
    let bend = of_layers(1.0) - 2.0 * of_layers(1.25) + of_layers(1.5);
    assert!(1e-4 < bend.abs(), "{bend:e}");
    // Of a homogeneous plate it is linear.
    let of_plate =
        |depth: f64| shear_modulus * 0.5 / Lamination::metric::<f64>(&HomogeneousPlate, depth).normal.powi(2);
    assert!((of_plate(1.0) - 2.0 * of_plate(1.25) + of_plate(1.5)).abs() <= 0.0);
}

/// A shell grown along the sphere by 1 + g in its inner half.
struct Grown(f64);

impl Lamination for Grown {
    fn metric<T: Real>(&self, depth: T) -> LaminaMetric<T> {
        let growth = T::select(depth.less_than(T::lit(1.5)), T::lit(1.0 + self.0), T::one());
        LaminaMetric { normal: T::one(), in_plane: [(growth * depth).powi(2), T::one(), T::zero()] }
    }
    fn interfaces(&self) -> &[f64] {
        &[1.5]
    }
}

#[test]
fn residual_stress_of_a_grown_shell_tends_to_the_linear_one() {
    // Linear: r = R + δ, R²δ = a²δ₀ + ∫ 2 g R² dR, e = δ/R − g, T_rr′ = 12 μ e/R, zero at both faces.
    let (a, c, b) = (1.0_f64, 1.5_f64, 2.0_f64);
    // ∫ e/R dR with δ₀ = 0 and g = 1: inside ⅔ (R³ − a³)/R⁴ − 1/R, outside ⅔ (c³ − a³)/R⁴.
    let inside = 2.0 / 3.0 * ((c / a).ln() - (1.0 - (a / c).powi(3)) / 3.0) - (c / a).ln();
    let outside = 2.0 / 9.0 * (c.powi(3) - a.powi(3)) * (c.powi(-3) - b.powi(-3));
    let of_unit = a * a / 3.0 * (a.powi(-3) - b.powi(-3));
    let start = -(inside + outside) / of_unit;
    // T_θθ − T_rr = 6 μ e.
    let strain = |r: f64| {
        let (growth, swollen) = if r < c { (1.0, r.powi(3)) } else { (0.0, c.powi(3)) };
        (a * a * start + 2.0 / 3.0 * (swollen - a.powi(3))) / r.powi(3) - growth
    };
    let law = NeoHookean::new(1.0).expect("a modulus");
    let sizes = [1e-2, 5e-3, 2.5e-3];
    let errors = sizes.map(|g| {
        let shell = LaminatedSphere::new(Grown(g), [a, b]).expect("a shell");
        let rest = shell.at_rest(&law).expect("at rest");
        let depths = [1.1, 1.4, 1.6, 1.9];
        let error = depths.map(|depth| {
            let t = rest.state.stress(&law, depth, rest.normal_stress).expect("T").cauchy.0.components;
            ((t[1] - t[0]) / g - 6.0 * strain(depth)).abs()
        });
        error.into_iter().fold(0.0, f64::max)
    });
    piola_testkit::assert_order("linear limit", &sizes, &errors, 1.0, 0.1);
}

#[test]
fn bodies_at_rest_bear_no_loads_and_homogeneous_ones_no_stress() {
    let law = MooneyRivlin::new(0.5, 0.25).expect("moduli");
    let scale = 1e-9; // of a modulus of 1.5 Pa: the solver stops at relative steps of 1e-11
    let tube = LaminatedTube::new(Layers, [1.0, 2.0]).expect("a tube");
    let rest = tube.at_rest(&law).expect("at rest");
    let loads = rest.state.loads(&law, rest.normal_stress).expect("loads");
    assert!(
        loads.normal_stress_difference.abs() < scale
            && loads.second_force.abs() < scale
            && loads.first_force.abs() < scale
    );
    let hoop = |depth: f64| rest.state.stress(&law, depth, 0.0).expect("T").cauchy.0.components[1];
    assert!(0.05 < hoop(1.1) && hoop(1.9) < -0.05, "{} {}", hoop(1.1), hoop(1.9));

    let plate = LaminatedPlate::new(Layers, [1.0, 2.0]).expect("a plate");
    let held = plate.held_flat(&law).expect("held flat");
    let loads = held.state.loads(&law, 0.0).expect("loads");
    assert!(loads.first_force.abs() < scale && loads.second_force.abs() < scale && loads.shear.abs() < scale);
    assert!(1e-3 < loads.first_moment.abs(), "moments keep it flat");

    let mut compared = 0;
    for radii in [[1.0, 2.0], [0.0, 2.0]] {
        let tube = LaminatedTube::new(HomogeneousTube, radii).expect("a tube");
        let rest = tube.at_rest(&law).expect("at rest");
        let stress = rest.state.stress(&law, 1.5, rest.normal_stress).expect("T");
        assert!(stress.cauchy.0.components.iter().all(|t| t.abs() < scale), "{stress:?}");
        let sphere = LaminatedSphere::new(HomogeneousTube, radii).expect("a sphere");
        let rest = sphere.at_rest(&law).expect("at rest");
        let stress = rest.state.stress(&law, 1.5, rest.normal_stress).expect("T");
        assert!(stress.cauchy.0.components.iter().all(|t| t.abs() < scale), "{stress:?}");
        compared += 2;
    }
    assert_eq!(compared, 4);
}

#[test]
fn eversion_turns_a_shell_inside_out_and_back() {
    let shell = LaminatedSphere::new(Grown(0.1), [1.0, 2.0]).expect("a shell");
    let everted = shell.everted(2.25).expect("everted");
    let (inner, outer) = (everted.radius(1.0).expect("r"), everted.radius(2.0).expect("r"));
    assert!(outer < inner, "the inner face is outside");
    let law = NeoHookean::new(1.0).expect("a modulus");
    // What was inside is stretched now.
    assert!(1.0 < everted.left_cauchy_green(1.0).expect("B").components[1]);
    // The change of T_rr through the wall by differences of the stress.
    let slope = difference_quotient(
        |r| vec![everted.stress(&law, r[0], 0.0).expect("T").cauchy.0.components[0]],
        &[1.75],
        &[1.0],
    );
    let t = everted.stress(&law, 1.75, 0.0).expect("T").cauchy.0.components;
    let radius = everted.radius(1.75).expect("r");
    // dT_rr/dR = 2 (T_θθ − T_rr)/r dr/dR, dr/dR = −m h²/r².
    let expected = -2.0 * (t[1] - t[0]) / radius * 1.75 * 1.75 / (radius * radius);
    assert_close("T_rr′", &slope, &[expected], Tol::stated(1e-9, "differences of the sixth order of an integral"));
}

/// Parameters that are polynomials of time, for family 2.
struct History {
    matrix: [Vec<f64>; 4],
}

impl SheetHistory for History {
    fn origin<T: Real>(&self, _t: T) -> T {
        T::zero()
    }
    fn matrix<T: Real>(&self, t: T) -> [[T; 2]; 2] {
        let [b, c, d, e] = [0, 1, 2, 3].map(|i: usize| polynomial(&self.matrix[i], t));
        [[b, c], [d, e]]
    }
}

#[test]
fn motions_of_family_2_equal_reference() {
    let mut compared = [0; 2];
    for case in golden::load("universal").cases.iter().filter(|case| case["kind"] == "dynamic_family2") {
        let (p, law) = (&case["params"], Law::of(&case["model"]));
        let history = History { matrix: ["B", "C", "D", "E"].map(|key| golden::vector(&p[key])) };
        // From the axis on, where x = ½ A R² vanishes.
        let tube = LaminatedTube::new(HomogeneousTube, [0.0, 2.0]).expect("a tube");
        let motion = SheetMotion::of_straightened_tube(&tube, &history, golden::number(&p["t"]));
        if case["has_acceleration_potential"] == false {
            let (left, right) = match motion {
                Err(UniformityError::NoAccelerationPotential { left, right, .. }) => (left, right),
                other => panic!("{other:?}"),
            };
            // S₁₂ − S₂₁ = (B C̈ − C B̈ − E D̈ + D Ë)/Δ.
            let determinant = 1.0 / golden::number(&case["jets"]["A"][0]);
            let condition = golden::number(&case["condition_lhs"]) - golden::number(&case["condition_rhs"]);
            assert_close("condition", &[(left - right) * determinant], &[condition], REFERENCE);
            compared[1] += 1;
            continue;
        }
        let motion = motion.expect("a potential");
        for point in case["points"].as_array().expect("points") {
            let particle: [f64; 3] = golden::vector(&point["ref_coords"]).try_into().expect("three");
            let place = motion.state.place(particle).expect("x");
            assert_close("x", &place, &golden::vector(&point["cur_coords"]), REFERENCE);
            let acceleration = motion.acceleration(particle).expect("a");
            assert_close("a", &acceleration, &golden::vector(&point["acceleration"]), REFERENCE);
            let potential = motion.potential(particle).expect("ζ");
            assert_close("ζ", &[potential], &[golden::number(&point["zeta"])], REFERENCE);
            let stress = motion.stress(&law, golden::number(&p["rho"]), 0.0, particle).expect("T");
            assert_close("T", &rows(&stress), &flat(&point["T_phys"]), REFERENCE);
            assert_close("p", &[stress.pressure], &[golden::number(&point["p"])], REFERENCE);
            compared[0] += 1;
        }
    }
    assert_eq!(compared, [3, 1], "points with a potential, and a case without");
}

/// A tube that swells, turns apart and lengthens: S₁₁ = A₁₁ A₂₂ holds for ċ = k f.
struct Swelling;

impl SheetHistory for Swelling {
    fn origin<T: Real>(&self, t: T) -> T {
        T::lit(1.2) + T::lit(0.3) * t.sin()
    }
    fn matrix<T: Real>(&self, t: T) -> [[T; 2]; 2] {
        let (o, n) = (T::zero(), T::lit);
        let stretch = T::one() + n(0.1) * t * t;
        let angle = T::one() + n(0.2) * (t + n(0.1 / 3.0) * t * t * t);
        [[angle, o], [o, stretch]]
    }
}

/// A tube that is twisted in time: its acceleration has no potential.
struct Twisting;
impl SheetHistory for Twisting {
    fn origin<T: Real>(&self, _t: T) -> T {
        T::lit(1.0)
    }
    fn matrix<T: Real>(&self, t: T) -> [[T; 2]; 2] {
        [[T::one(), t], [T::zero(), T::one()]]
    }
}

/// x of a particle at a time.
type PlaceAt = fn(&LaminatedTube<Layers>, &LaminatedPlate<Layers>, f64) -> [f64; 3];

#[test]
fn acceleration_of_a_laminated_tube_is_minus_the_gradient_of_its_potential() {
    let tube = LaminatedTube::new(Layers, [1.0, 2.0]).expect("a tube");
    let plate = LaminatedPlate::new(Layers, [1.0, 2.0]).expect("a plate");
    let (t, particle) = (0.7, [1.25, 0.4, 0.8]);
    let states: [PlaceAt; 2] = [
        |tube, _, t| {
            let motion = SheetMotion::of_inflated_tube(tube, &Swelling, t).expect("a potential");
            motion.state.place([1.25, 0.4, 0.8]).expect("x")
        },
        |_, plate, t| {
            let motion = SheetMotion::of_bent_plate(plate, &Swelling, t).expect("a potential");
            motion.state.place([1.25, 0.4, 0.8]).expect("x")
        },
    ];
    let motions = [
        SheetMotion::of_inflated_tube(&tube, &Swelling, t).expect("a potential"),
        SheetMotion::of_bent_plate(&plate, &Swelling, t).expect("a potential"),
    ];
    for (motion, place) in motions.iter().zip(states) {
        let cartesian = |t: f64| {
            let [r, angle, z] = place(&tube, &plate, t);
            [r * angle.cos(), r * angle.sin(), z]
        };
        // Second differences of the fourth order.
        let h = 0.01;
        let weights = [(-2.0, -1.0), (-1.0, 16.0), (0.0, -30.0), (1.0, 16.0), (2.0, -1.0)];
        let mut second = [0.0; 3];
        for (step, weight) in weights {
            let x = cartesian(t + step * h);
            second = core::array::from_fn(|i| second[i] + weight * x[i] / (12.0 * h * h));
        }
        let [_, angle, _] = motion.state.place(particle).expect("x");
        let physical = [
            second[0] * angle.cos() + second[1] * angle.sin(),
            second[1] * angle.cos() - second[0] * angle.sin(),
            second[2],
        ];
        let acceleration = motion.acceleration(particle).expect("a");
        assert_close("a", &acceleration, &physical, Tol::stated(1e-7, "differences of the fourth order, h = 1/100"));
        // ζ along each coordinate: −∂ζ/∂r, −∂ζ/∂θ/r, −∂ζ/∂z, by the chain rule through the particle's coordinates.
        let potential = |x: &[f64]| vec![motion.potential([x[0], x[1], x[2]]).expect("ζ")];
        let slope = |v: [f64; 3]| difference_quotient(potential, &particle, &v)[0];
        let gradient = motion.state.gradient(particle[0]).expect("F");
        let radius = motion.state.place(particle).expect("x")[0];
        let expected = [
            -slope([1.0, 0.0, 0.0]) / gradient[0][0],
            -slope([0.0, 1.0, 0.0]) / (gradient[1][1] / radius) / radius,
            -slope([0.0, 0.0, 1.0]) / gradient[2][2],
        ];
        assert_close("−grad ζ", &acceleration, &expected, Tol::stated(1e-8, "differences of the sixth order"));
    }
    assert!(matches!(
        SheetMotion::of_inflated_tube(&tube, &Twisting, 0.0),
        Err(UniformityError::NoAccelerationPotential { condition: "A12 = 0", .. })
    ));
}

#[test]
fn small_oscillations_have_the_linear_frequency_and_large_ones_keep_their_energy() {
    let (law, density) = (NeoHookean::new(1.0).expect("a modulus"), 2.0);
    let (a, b) = (1.0_f64, 1.5_f64);
    let tolerance = Tolerance::relative(1e-11).expect("a tolerance");
    let half_period = |square: f64| 0.5 * TAU / square.sqrt();

    let shell = LaminatedSphere::new(HomogeneousTube, [a, b]).expect("a shell");
    let mut swing = LaminatedOscillation::of_sphere(&shell, &law, density, 0.0).expect("a swing");
    // ω² = 4 (μ/ρ) (a⁻³ − b⁻³)/(a⁻¹ − b⁻¹).
    let square = 4.0 / density * (a.powi(-3) - b.powi(-3)) / (a.recip() - b.recip());
    let amplitude = 1e-6;
    let opposite = |swing: &mut dyn FnMut(&mut State, f64), start: [f64; 2], time: f64| {
        let mut state = State::new(0.0, start.to_vec()).expect("a state");
        swing(&mut state, time);
        [state.values[0], state.values[1]]
    };
    let start = swing.at_rest_with_radius(a + amplitude);
    let end = {
        let mut run = |state: &mut State, time: f64| integrate(&mut swing, state, time, tolerance);
        opposite(&mut run, start, half_period(square))
    };
    let tol = Tol::stated(1e-5, "terms of second order in the amplitude, 1e-6, and rounding of r₀ − a");
    assert_close("r₀ − a", &[swing.radius(end) - a], &[-amplitude], tol);

    // A tube in plane strain: ω² = 2 (μ/ρ) (a⁻² − b⁻²)/ln(b/a).
    let tube = LaminatedTube::new(HomogeneousTube, [a, b]).expect("a tube");
    let matrix = [[1.0, 0.0], [0.0, 1.0]];
    let mut swing = LaminatedOscillation::of_tube(&tube, matrix, &law, density, 0.0).expect("a swing");
    let square = 2.0 / density * (a.powi(-2) - b.powi(-2)) / (b / a).ln();
    let start = swing.at_rest_with_radius(a + amplitude);
    assert_close("r₀", &[swing.radius(start)], &[a + amplitude], Tol::ulps(4.0));
    let end = {
        let mut run = |state: &mut State, time: f64| integrate(&mut swing, state, time, tolerance);
        opposite(&mut run, start, half_period(square))
    };
    assert_close("r₀ − a", &[swing.radius(end) - a], &[-amplitude], tol);

    // Large, of laminated bodies, with a law of both invariants.
    let law = MooneyRivlin::new(0.5, 0.25).expect("moduli");
    let shell = LaminatedSphere::new(Layers, [1.0, 2.0]).expect("a shell");
    let mut swing = LaminatedOscillation::of_sphere(&shell, &law, density, 0.0).expect("a swing");
    keeps_energy(&mut swing, 1.5, |swing, y| swing.energy(y).expect("E"), LaminatedOscillation::at_rest_with_radius);
    let tube = LaminatedTube::new(Layers, [1.0, 2.0]).expect("a tube");
    let mut swing =
        LaminatedOscillation::of_tube(&tube, [[1.1, 0.2], [0.0, 0.9]], &law, density, 0.0).expect("a swing");
    keeps_energy(&mut swing, 1.5, |swing, y| swing.energy(y).expect("E"), LaminatedOscillation::at_rest_with_radius);
}

fn integrate<F: Field<Error = UniformityError>>(field: &mut F, state: &mut State, time: f64, tolerance: Tolerance) {
    DormandPrince853::new(tolerance).integrate_to(field, state, time).expect("a run");
}

fn keeps_energy<F: Field<Error = UniformityError>>(
    field: &mut F,
    radius: f64,
    energy: impl Fn(&F, [f64; 2]) -> f64,
    start: impl Fn(&F, f64) -> [f64; 2],
) {
    let start = start(field, radius);
    let before = energy(field, start);
    let mut state = State::new(0.0, start.to_vec()).expect("a state");
    integrate(field, &mut state, 2.0, Tolerance::relative(1e-10).expect("a tolerance"));
    let after = energy(field, [state.values[0], state.values[1]]);
    assert!((state.values[0] / start[0] - 1.0).abs() > 1e-2, "it moves");
    assert_close(
        "energy",
        &[after],
        &[before],
        Tol::stated(1e-8, "a tolerance of 1e-10 a step, over some fifty steps"),
    );
}
