//! `work-precision` with two more peers, `diffsol` and `russell_ode`.
//!
//! ```sh
//! cargo run --release --manifest-path benches/peers/integration/Cargo.toml -- --out docs/measurements/figures
//! ```

use diffsol::{FaerLU, FaerMat, OdeBuilder, OdeSolverMethod, OdeSolverStopReason, Vector as _};
use piola_benches::problems::{Equations, Problem, SpringChain};
use piola_benches::program::{DormandPrincePeers, Peers, program};
use piola_benches::work_precision::{Family, Method, Outcome, tolerances};
use russell_lab::Vector;
use russell_ode::prelude::{Method as RussellMethod, OdeSolver, Params, System};

struct AllPeers;

impl Peers for AllPeers {
    fn of<'a, E: Equations<D> + Copy + Send + Sync, const D: usize>(
        &self,
        problem: &'a Problem<E, D>,
    ) -> Vec<Method<'a>> {
        let mut methods = DormandPrincePeers.of(problem);
        let tsit = move |tolerance: f64| diffsol_tsit45(problem, tolerance).map_err(|error| error.to_string());
        methods.push(Method::new("diffsol 0.18, Tsit45", Family::Diffsol, 5, tolerances(), tsit));
        let eighth = move |tolerance: f64| russell(problem, RussellMethod::DoPri8, tolerance);
        methods.push(Method::new("russell_ode 5.0, DoPri8", Family::Russell, 8, tolerances(), eighth));
        methods
    }

    fn stiff<'a>(&self, problem: &'a Problem<SpringChain, 40>) -> Vec<Method<'a>> {
        let bdf = move |tolerance: f64| diffsol_bdf(problem, tolerance).map_err(|error| error.to_string());
        let esdirk = move |tolerance: f64| diffsol_esdirk34(problem, tolerance).map_err(|error| error.to_string());
        let radau = move |tolerance: f64| russell(problem, RussellMethod::Radau5, tolerance);
        vec![
            Method::new("diffsol 0.18, BDF", Family::Diffsol, 2, tolerances(), bdf),
            Method::new("diffsol 0.18, ESDIRK34", Family::Diffsol, 4, tolerances(), esdirk),
            Method::new("russell_ode 5.0, Radau5", Family::Russell, 6, tolerances(), radau),
        ]
    }
}

type Outcomes = Result<Outcome, diffsol::error::DiffsolError>;

/// The right-hand side on slices.
fn rate<E: Equations<D>, const D: usize>(equations: &E, y: &[f64], out: &mut [f64]) {
    if let (Some(y), Some(out)) = (y.first_chunk(), out.first_chunk_mut()) {
        equations.rate(y, out);
    }
}

/// Steps to the end; evaluations are not counted by the crate.
macro_rules! finish {
    ($solver:expr, $end:expr) => {{
        let mut solver = $solver;
        solver.set_stop_time($end)?;
        let mut steps = 0;
        while !matches!(solver.step()?, OdeSolverStopReason::TstopReached) {
            steps += 1;
        }
        let state = solver.state().y.clone_as_vec();
        Ok(Outcome { state, evaluations: 0, steps: steps + 1 })
    }};
}

fn diffsol_tsit45<E: Equations<D> + Copy, const D: usize>(problem: &Problem<E, D>, tolerance: f64) -> Outcomes {
    let (equations, start) = (problem.equations, problem.start);
    let given = OdeBuilder::<FaerMat<f64>>::new()
        .rtol(tolerance)
        .atol([tolerance * problem.small])
        .rhs(move |y, _p, _t, out| rate(&equations, y, out))
        .init(move |_p, _t, y| y.copy_from_slice(&start), D)
        .build()?;
    finish!(given.tsit45()?, problem.end)
}

macro_rules! implicit {
    ($name:ident, $method:ident) => {
        fn $name(problem: &Problem<SpringChain, 40>, tolerance: f64) -> Outcomes {
            let (equations, start) = (problem.equations, problem.start);
            let given = OdeBuilder::<FaerMat<f64>>::new()
                .rtol(tolerance)
                .atol([tolerance * problem.small])
                .rhs_implicit(
                    move |y, _p, _t, out| rate(&equations, y, out),
                    move |y, _p, _t, w, out| equations.jacobian_product(y, w, out),
                )
                .init(move |_p, _t, y| y.copy_from_slice(&start), 40)
                .build()?;
            finish!(given.$method::<FaerLU<f64>>()?, problem.end)
        }
    };
}
implicit!(diffsol_bdf, bdf);
implicit!(diffsol_esdirk34, esdirk34);

fn russell<E: Equations<D> + Copy + Send + Sync, const D: usize>(
    problem: &Problem<E, D>,
    method: RussellMethod,
    tolerance: f64,
) -> Result<Outcome, String> {
    let mut params = Params::new(method);
    params.set_tolerances(tolerance * problem.small, tolerance, None)?;
    params.newton.use_numerical_jacobian = true;
    params.step.n_step_max = 1_000_000;
    let equations = problem.equations;
    let system = System::new(D, move |out: &mut Vector, _t: f64, y: &Vector, _: &mut ()| {
        rate(&equations, y.as_data(), out.as_mut_data());
        Ok(())
    });
    let mut solver = OdeSolver::new(params, system)?;
    let mut y = Vector::from(&problem.start);
    solver.solve(&mut y, 0.0, problem.end, None, &mut (), None)?;
    let stats = solver.stats();
    Ok(Outcome { state: y.as_data().to_vec(), evaluations: stats.n_function as u64, steps: stats.n_accepted as u64 })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    program(&AllPeers)
}
