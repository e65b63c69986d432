//! Sparse Jacobians: patterns, colours, the same results as dense matrices, failures, memory.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_integrators::{Field, IntegratorsError, State, Tolerance};
use piola_stiff::{
    Differentiable, ExactJacobian, RadauIia, RadauOrder, RadauReport, SparseJacobian, Sparsity, StiffField, WithMass,
};
use piola_testkit::{Tol, allocations_in, assert_close};

use super::large::{Chain, Diffusion};
use super::mechanisms::Squeezer;
use super::problems::{Hires, Oregonator, Robertson, SpringPendulum, VanDerPol};

/// The field with the pattern that is found at y.
fn sparse<F>(field: F, y: &[f64]) -> SparseJacobian<F>
where
    F: Field<Error = Infallible> + Field<Differentiable, Error = Infallible> + Copy,
{
    let sparsity = Sparsity::of_field(&mut field.clone(), 0.0, y).unwrap();
    SparseJacobian::new(field, sparsity).unwrap()
}

/// Numbers of no pattern between ½ and 1½.
fn somewhere(n: usize) -> Vec<f64> {
    (1..=n).map(|k| 1.0 + 0.5 * (1e3 * k as f64).sin()).collect()
}

#[test]
fn pattern_of_a_field_names_what_each_rate_depends_on() {
    let line = Sparsity::of_field(&mut Diffusion { side: 9, rows: 1 }, 0.0, &[0.0; 9]).unwrap();
    let near = (0..9_usize).flat_map(|i| (i.saturating_sub(1)..(i + 2).min(9)).map(move |j| (i, j)));
    assert_eq!(line, Sparsity::from_entries(9, near).unwrap());
    // Entries in any order, and twice.
    let backwards: Vec<_> = line.entries().collect::<Vec<_>>().into_iter().rev().chain([(3, 4)]).collect();
    assert_eq!(Sparsity::from_entries(9, backwards).unwrap(), line);
    let grid = Sparsity::of_field(&mut Diffusion { side: 4, rows: 4 }, 0.0, &[0.0; 16]).unwrap();
    assert_eq!((grid.dimension(), grid.count()), (16, 16 + 2 * 24));
    assert_eq!(grid.rows_of(5), [1, 4, 5, 6, 9]);
    assert!(grid.rows_of(16).is_empty());
    let diagonal = Sparsity::from_entries(16, (0..16).map(|k| (k, k))).unwrap();
    assert!(grid.covers(&diagonal) && !diagonal.covers(&grid));
}

#[test]
fn columns_that_share_no_row_take_one_pass() {
    // Three colours on a line of any length: one pass of four.
    for side in [10, 1000] {
        let line = sparse(Diffusion { side, rows: 1 }, &vec![0.0; side]);
        assert_eq!((line.colours(), line.passes()), (3, 1));
    }
    // At least five on a grid: a point and its four neighbours share a row.
    let grid = sparse(Diffusion { side: 20, rows: 20 }, &[0.0; 400]);
    assert!((5..=8).contains(&grid.colours()) && grid.passes() == 2, "{}", grid.colours());
    // A chain's masses: three colours of places, three of velocities.
    let chain = sparse(Chain { masses: 300 }, &[0.0; 600]);
    assert!(chain.colours() <= 8 && chain.passes() == 2, "{}", chain.colours());
    // A full row needs a colour for each column.
    let full = sparse(Hires, &[1.0; 8]);
    assert!(full.colours() <= 6, "{}", full.colours());
}

/// Entry for entry, and nothing outside of the pattern.
fn assert_is_the_dense_jacobian<F>(field: F)
where
    F: Field<Error = Infallible> + Field<Differentiable, Error = Infallible> + Copy,
{
    let n = <F as Field>::dimension(&field);
    let y = somewhere(n);
    let mut system = sparse(field, &y);
    let sparsity = system.sparsity().unwrap().clone();
    let (mut entries, mut dense) = (vec![0.0; sparsity.count()], vec![0.0; n * n]);
    system.jacobian(0.0, &y, &mut entries).unwrap();
    ExactJacobian::new(field).jacobian(0.0, &y, &mut dense).unwrap();
    for ((row, column), entry) in sparsity.entries().zip(entries) {
        assert_eq!(entry.to_bits(), core::mem::take(&mut dense[row + column * n]).to_bits(), "({row}, {column})");
    }
    assert!(dense.iter().all(|entry| entry.abs() <= 0.0));
}

#[test]
fn sparse_jacobian_equals_the_dense_one_to_the_last_bit() {
    assert_is_the_dense_jacobian(VanDerPol);
    assert_is_the_dense_jacobian(Robertson);
    assert_is_the_dense_jacobian(Hires);
    assert_is_the_dense_jacobian(Oregonator);
    assert_is_the_dense_jacobian(SpringPendulum);
    assert_is_the_dense_jacobian(Squeezer { on_velocities: false });
    assert_is_the_dense_jacobian(Squeezer { on_velocities: true });
    assert_is_the_dense_jacobian(Chain { masses: 23 });
    assert_is_the_dense_jacobian(Diffusion { side: 7, rows: 7 });
}

fn run(
    system: &mut impl StiffField<Error = Infallible>,
    method: &mut RadauIia,
    start: &[f64],
    end: f64,
) -> (Vec<f64>, RadauReport) {
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    let report = method.integrate_to(system, &mut state, end).unwrap();
    (state.values, report)
}

/// Twenty equal steps of each order by dense and by sparse matrices.
fn assert_equals_dense<F>(name: &str, field: F, start: &[f64], end: f64, tol: Tol)
where
    F: Field<Error = Infallible> + Field<Differentiable, Error = Infallible> + Copy,
{
    for order in RadauOrder::ALL {
        let mut method = RadauIia::with_step(order, end / 20.0).unwrap();
        let (dense, report) = run(&mut ExactJacobian::new(field), &mut method, start, end);
        let (sparse, sparse_report) = run(&mut sparse(field, start), &mut method, start, end);
        assert_close(name, &sparse, &dense, tol);
        assert_eq!(sparse_report.run.steps, report.run.steps);
    }
}

#[test]
fn sparse_runs_equal_dense_ones_to_rounding() {
    let tol = Tol::ulps(16.0);
    assert_equals_dense("van der Pol", VanDerPol, &[2.0, -0.66], 0.5, tol);
    assert_equals_dense("Robertson", Robertson, &[1.0, 3.65e-5, 1e-3], 1.0, tol);
    let mut hires = [0.0; 8];
    (hires[0], hires[7]) = (1.0, 0.0057);
    assert_equals_dense("HIRES", Hires, &hires, 1.0, tol);
    assert_equals_dense("Oregonator", Oregonator, &[1.0, 2.0, 3.0], 0.02, tol);
    assert_equals_dense("spring pendulum", SpringPendulum, &[1.0, 0.0, 0.0, 0.0], 0.1, tol);
    let in_links = Tol::ulps_because(1024.0, "the pull of a link, 10⁶ times a difference of places");
    assert_equals_dense("chain", Chain { masses: 20 }, &[0.0; 40], 2.0, in_links);
    let line = Diffusion { side: 30, rows: 1 };
    assert_equals_dense("line", line, &line.start(), 0.1, tol);
    let grid = Diffusion { side: 6, rows: 6 };
    assert_equals_dense("grid", grid, &grid.start(), 0.1, tol);
}

/// M = (2 1; 1 3) and the singular mass matrix of the squeezer, in every form.
#[test]
fn mass_matrices_of_all_forms_lead_to_one_end() {
    let dense_mass = vec![2.0, 1.0, 0.0, 1.0, 3.0, 0.0, 0.0, 0.0, 1.0];
    let entries = vec![(0, 0, 2.0), (1, 1, 2.5), (0, 1, 1.0), (1, 0, 1.0), (2, 2, 1.0), (1, 1, 0.5)];
    let (line, start) = (Diffusion { side: 3, rows: 1 }, [1.0, 0.5, 0.2]);
    let mut method = RadauIia::new(Tolerance::new(1e-8, 1e-12).unwrap());
    let mut ends = Vec::new();
    for entries in [None, Some(entries)] {
        let mass = |entries: &Option<Vec<_>>| entries.clone();
        let dense = ExactJacobian::new(line);
        let mut dense = match mass(&entries) {
            None => WithMass::new(dense, dense_mass.clone()),
            Some(entries) => WithMass::from_entries(dense, entries),
        }
        .unwrap();
        ends.push(run(&mut dense, &mut method, &start, 1.0));
        let few = sparse(line, &start);
        let mut few = match mass(&entries) {
            None => WithMass::new(few, dense_mass.clone()),
            Some(entries) => WithMass::from_entries(few, entries),
        }
        .unwrap();
        ends.push(run(&mut few, &mut method, &start, 1.0));
    }
    for (end, report) in &ends {
        assert_close("end", end, &ends[0].0, Tol::ulps_because(1e4, "the condition of the matrices"));
        assert_eq!(report.run.steps, ends[0].1.run.steps);
    }
}

#[test]
fn squeezer_by_sparse_matrices_equals_dense_ones() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../testdata/reference/andrews_squeezer.json");
    let file: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let start = piola_testkit::golden::vector(&file["initial_state"]);
    let mass: Vec<_> = (0..14).map(|k| (k, k, 1.0)).collect();
    for on_velocities in [false, true] {
        let mut system = WithMass::from_entries(sparse(Squeezer { on_velocities }, &start), mass.clone()).unwrap();
        if on_velocities {
            system = system.with_index_two_from(14);
        }
        let mut method = RadauIia::new(Tolerance::relative(1e-7).unwrap());
        let (few, report) = run(&mut system, &mut method, &start, 0.005);
        let (all, dense) = run(&mut Squeezer { on_velocities }.system().unwrap(), &mut method, &start, 0.005);
        for part in [0..7, 7..14, 14..21, 21..27] {
            assert_close("end", &few[part.clone()], &all[part], Tol::stated(1e-8, "a tenth of the tolerance"));
        }
        assert!(report.run.steps.abs_diff(dense.run.steps) <= 2, "{report:?} {dense:?}");
    }
}

#[test]
fn sparse_runs_repeat_to_the_last_bit() {
    let (chain, start) = (Chain { masses: 12 }, [0.0; 24]);
    let mut method = RadauIia::new(Tolerance::relative(1e-8).unwrap());
    let one = run(&mut sparse(chain, &start), &mut method, &start, 3.0);
    // By the same method after other systems, sparse and dense, and by a copy of it.
    let line = Diffusion { side: 10, rows: 1 };
    run(&mut sparse(line, &line.start()), &mut method, &line.start(), 0.1);
    run(&mut ExactJacobian::new(VanDerPol), &mut method, &[2.0, 0.0], 0.1);
    let other = run(&mut sparse(chain, &start), &mut method, &start, 3.0);
    let copied = run(&mut sparse(chain, &start), &mut method.clone(), &start, 3.0);
    assert_eq!((&one, &one), (&other, &copied));
}

#[test]
fn second_sparse_run_of_a_method_allocates_nothing() {
    let line = Diffusion { side: 40, rows: 1 };
    let start = line.start();
    let mut system = sparse(line, &start);
    let mut method = RadauIia::new(Tolerance::relative(1e-8).unwrap());
    let mut state = State::new(0.0, start.clone()).unwrap();
    let first = method.integrate_to(&mut system, &mut state, 1.0).unwrap();
    state.values.copy_from_slice(&start);
    let (count, second) = allocations_in(|| {
        state.time = 0.0;
        method.integrate_to(&mut system, &mut state, 1.0).unwrap()
    });
    assert!(5 < first.factorisations && 5 < second.factorisations, "{first:?} {second:?}");
    assert_eq!(count, 0);
}

#[test]
fn sparse_runs_of_ten_and_of_a_thousand_steps_allocate_alike() {
    let counts = [10_u32, 1_000].map(|steps| {
        let (count, report) = allocations_in(|| {
            let mut state = State::new(0.0, vec![2.0, -0.66]).unwrap();
            let mut method = RadauIia::with_step(RadauOrder::Nine, 5e-4).unwrap();
            method.integrate_to(&mut sparse(VanDerPol, &[2.0, 0.0]), &mut state, f64::from(steps) * 5e-4).unwrap()
        });
        assert_eq!(report.run.steps, u64::from(steps));
        (count, report.factorisations)
    });
    assert_eq!(counts[0].0, counts[1].0);
    assert!(counts[0].1 < counts[1].1);
}

#[test]
fn patterns_and_masses_that_do_not_fit_are_refused_by_name() {
    let outside = Sparsity::from_entries(3, [(0, 0), (1, 3)]).unwrap_err();
    let (quantity, row, column, dimension) = ("sparsity", 1, 3, 3);
    assert_eq!(outside, IntegratorsError::OutsideMatrix { quantity, row, column, dimension });
    let error = SparseJacobian::new(VanDerPol, Sparsity::from_entries(3, [(0, 0)]).unwrap()).err();
    assert_eq!(error, Some(IntegratorsError::WrongLength { quantity: "sparsity", expected: 2, found: 3 }));
    let error = Sparsity::of_field(&mut VanDerPol, 0.0, &[1.0]).unwrap_err();
    assert_eq!(error, IntegratorsError::WrongLength { quantity: "state", expected: 2, found: 1 });
    let error = WithMass::from_entries(ExactJacobian::new(VanDerPol), vec![(0, 0, 1.0), (2, 0, 1.0)]).err();
    let (quantity, row, column, dimension) = ("mass", 2, 0, 2);
    assert_eq!(error, Some(IntegratorsError::OutsideMatrix { quantity, row, column, dimension }));
    let error = WithMass::from_entries(ExactJacobian::new(VanDerPol), vec![(0, 0, 1.0), (1, 1, f64::NAN)]).err();
    assert!(matches!(error, Some(IntegratorsError::NotFinite { quantity: "mass", index: 1, .. })), "{error:?}");
}

/// Two components; what the system says of its matrices is given.
struct Given {
    sparsity: Sparsity,
    entries: Vec<f64>,
    mass: Option<Vec<(usize, usize, f64)>>,
}
impl Field for Given {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        2
    }
    fn rate(&mut self, _t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
        rate.copy_from_slice(&[-y[0], y[0] - 1.0]);
        Ok(())
    }
}
impl StiffField for Given {
    fn jacobian(&mut self, _t: f64, _y: &[f64], jacobian: &mut [f64]) -> Result<(), Infallible> {
        jacobian.copy_from_slice(&self.entries);
        Ok(())
    }
    fn mass_entries(&self) -> Option<&[(usize, usize, f64)]> {
        self.mass.as_deref()
    }
    fn sparsity(&self) -> Option<&Sparsity> {
        Some(&self.sparsity)
    }
}

fn fail(system: &mut Given) -> IntegratorsError {
    let start = State::new(0.0, vec![1.0, 1.0]).unwrap();
    let mut state = start.clone();
    let mut method = RadauIia::new(Tolerance::relative(1e-6).unwrap());
    let error = method.integrate(system, &mut state, 1.0, |_| ControlFlow::Continue(())).unwrap_err();
    assert_eq!(state, start);
    error
}

#[test]
fn failed_sparse_runs_say_why_and_keep_the_state() {
    let pattern = |entries: &[(usize, usize)]| Sparsity::from_entries(2, entries.iter().copied()).unwrap();
    let first = Some(vec![(0, 0, 1.0)]);
    // 0 = y₁ − 1 does not determine y₂: no entry in its column, or entries that are zero.
    let mut system = Given { sparsity: pattern(&[(0, 0), (1, 0)]), entries: vec![-1.0, 1.0], mass: first.clone() };
    let error = fail(&mut system);
    assert!(matches!(error, IntegratorsError::SingularMatrix { pivot: 1, .. }), "{error:?}");
    let all = pattern(&[(0, 0), (1, 0), (0, 1), (1, 1)]);
    system = Given { sparsity: all.clone(), entries: vec![-1.0, 1.0, 0.0, 0.0], mass: first };
    let error = fail(&mut system);
    assert!(matches!(error, IntegratorsError::SingularMatrix { pivot: 1, .. }), "{error:?}");
    // A Jacobian that is not finite: the number of the entry in the pattern.
    system = Given { sparsity: all, entries: vec![-1.0, 1.0, 0.0, f64::INFINITY], mass: None };
    let error = fail(&mut system);
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "jacobian", index: 3, .. }), "{error:?}");
    // A pattern, and a mass matrix, of another size.
    let three = Sparsity::from_entries(3, [(0, 0)]).unwrap();
    let error = fail(&mut Given { sparsity: three, entries: vec![1.0], mass: None });
    assert_eq!(error, IntegratorsError::WrongLength { quantity: "sparsity", expected: 2, found: 3 });
    let (sparsity, mass) = (pattern(&[(0, 0)]), Some(vec![(0, 5, 1.0)]));
    let error = fail(&mut Given { sparsity, entries: vec![1.0], mass });
    let (quantity, row, column, dimension) = ("mass", 0, 5, 2);
    assert_eq!(error, IntegratorsError::OutsideMatrix { quantity, row, column, dimension });
}

#[test]
fn pattern_is_found_only_where_the_field_is_defined() {
    struct Nowhere;
    #[derive(Debug, PartialEq)]
    struct Undefined;
    impl<T: piola_numerics::Real> Field<T> for Nowhere {
        type Error = Undefined;
        fn dimension(&self) -> usize {
            1
        }
        fn rate(&mut self, _t: f64, _y: &[T], _rate: &mut [T]) -> Result<(), Undefined> {
            Err(Undefined)
        }
    }
    let error = Sparsity::of_field(&mut Nowhere, 2.0, &[1.0]).unwrap_err();
    assert_eq!(error, IntegratorsError::Field { t: 2.0, source: Undefined });
}

/// Residuals are those of the field: the end is right, or there is an error.
#[test]
fn pattern_that_lacks_entries_does_not_mislead() {
    let line = Diffusion { side: 8, rows: 1 };
    let start = line.start();
    let method = || RadauIia::new(Tolerance::relative(1e-7).unwrap()).with_most_steps(2000);
    let (exact, report) = run(&mut ExactJacobian::new(line), &mut method(), &start, 0.1);
    let diagonal = Sparsity::from_entries(8, (0..8).map(|k| (k, k))).unwrap();
    let mut lacking = SparseJacobian::new(line, diagonal).unwrap();
    let mut state = State::new(0.0, start.clone()).unwrap();
    let slower = method().integrate_to(&mut lacking, &mut state, 0.1).unwrap();
    assert_close("end", &state.values, &exact, Tol::stated(1e-6, "tolerance 1e-7"));
    assert!(report.run.evaluations < slower.run.evaluations && report.jacobians < slower.jacobians, "{slower:?}");
}
