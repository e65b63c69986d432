//! The program `work-precision`: error against time on fourteen problems, our methods and the peers', as `work-precision.json`
//! and one SVG each.
//!
//! Options: `--out FOLDER` (default: the current one), `--filter PROBLEM` (part of a problem's name), `--table FILE` (the data
//! of `piola_integrators::advise`).

use std::error::Error;
use std::path::PathBuf;

use crate::advice::{self, Entry};
use crate::chain::Chain;
use crate::figure::figure;
use crate::methods::{
    at_rest, closed_form, closed_form_of_top, on_the_group, quaternion_gauss_legendre_16, radau_iia,
    universal_variables, wisdom_holman,
};
use crate::problems::{self, Accelerations, Equations, Force, Problem, SpringChain};
use crate::work_precision::{
    Curve, Method, canonical_gauss_legendre, composition, derived_dormand_prince, derived_gauss_legendre_16,
    derived_gauss_radau_15, derived_nystrom, dormand_prince, gauss_legendre, gauss_legendre_16, gauss_radau_15,
    measure, nystrom, peer_methods, verner,
};
use piola_gravitation::{Gravitation, PostNewtonian};
use piola_integrators::Order;
use piola_lagrangian::Lagrangian;
use serde_json::Value;

const COLLOCATION: [Order; 3] = [Order::Four, Order::Six, Order::Eight];

/// The measured points of all problems, and the folder they are written to.
struct Results {
    folder: PathBuf,
    records: Vec<Value>,
    entries: Vec<Entry>,
}

/// Peers to be measured in turn with our methods.
pub trait Peers {
    /// Their methods on a problem.
    fn of<'a, E: Equations<D> + Copy + Send + Sync, const D: usize>(
        &self,
        problem: &'a Problem<E, D>,
    ) -> Vec<Method<'a>>;
    /// Their methods for stiff equations.
    fn stiff<'a>(&self, _problem: &'a Problem<SpringChain, 40>) -> Vec<Method<'a>> {
        Vec::new()
    }
}

/// `ode_solvers` and `differential-equations`.
#[derive(Clone, Copy, Debug)]
pub struct DormandPrincePeers;

impl Peers for DormandPrincePeers {
    fn of<'a, E: Equations<D> + Copy + Send + Sync, const D: usize>(
        &self,
        problem: &'a Problem<E, D>,
    ) -> Vec<Method<'a>> {
        peer_methods(problem).into()
    }
}

/// Measures, with the options of the command line.
///
/// # Errors
/// Unknown options and problems, references that cannot be read, files that cannot be written.
pub fn program(peers: &impl Peers) -> Result<(), Box<dyn Error>> {
    let (mut folder, mut filter, mut table) = (PathBuf::from("."), String::new(), None);
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let value = arguments.next().ok_or_else(|| format!("{argument} wants a value"))?;
        match argument.as_str() {
            "--out" => folder = value.into(),
            "--filter" => filter = value,
            "--table" => table = Some(PathBuf::from(value)),
            _ => {
                return Err(format!("unknown option {argument}: --out FOLDER, --filter PROBLEM, --table FILE").into());
            }
        }
    }
    std::fs::create_dir_all(&folder)?;
    let mut results = Results { folder, records: Vec::new(), entries: Vec::new() };
    if "double-pendulum".contains(&filter) {
        double_pendulum(peers, &mut results)?;
    }
    if "henon-heiles".contains(&filter) {
        let problem = problems::henon_heiles()?;
        run(&problem, &separable_methods(&problem, peers, 200.0), &mut results)?;
    }
    for problem in [problems::kepler_round(), problems::kepler(), problems::kepler_long()] {
        if problem.name.contains(&filter) {
            let mut methods = separable_methods(&problem, peers, 200.0);
            methods.push(universal_variables(&problem));
            run(&problem, &methods, &mut results)?;
        }
    }
    if "arenstorf".contains(&filter) {
        let problem = problems::arenstorf()?;
        let mut methods =
            vec![dormand_prince(&problem), verner(&problem), gauss_legendre_16(&problem), gauss_radau_15(&problem)];
        methods.extend(at_rest(&problem));
        methods.extend(COLLOCATION.map(|order| gauss_legendre(&problem, order, 200.0)));
        methods.extend(peers.of(&problem));
        run(&problem, &methods, &mut results)?;
    }
    if "pleiades".contains(&filter) {
        let problem = problems::pleiades()?;
        run(&problem, &separable_methods(&problem, peers, 100.0), &mut results)?;
    }
    if "outer-solar-system".contains(&filter) {
        outer_solar_system(peers, &mut results)?;
    }
    many_bodies(peers, &filter, &mut results)?;
    tops_and_springs(peers, &filter, &mut results)?;
    let Results { folder, records, entries } = results;
    if records.is_empty() {
        return Err(format!(
            "no problem is called {filter}: there are double-pendulum, henon-heiles, kepler-03, kepler, kepler-099, \
             arenstorf, pleiades, outer-solar-system, outer-solar-system-long, inner-solar-system, cluster, free-top, \
             heavy-top, spring-chain"
        )
        .into());
    }
    // One record a line: differences stay readable.
    let lines: Vec<String> = records.iter().map(Value::to_string).collect();
    std::fs::write(folder.join("work-precision.json"), format!("[\n{}\n]\n", lines.join(",\n")))?;
    if let Some(table) = table {
        std::fs::write(table, advice::table(&entries))?;
    }
    Ok(())
}

/// The long run of the outer Solar System, the inner Solar System, the cluster.
fn many_bodies(peers: &impl Peers, filter: &str, results: &mut Results) -> Result<(), Box<dyn Error>> {
    if "outer-solar-system-long".contains(filter) {
        let problem = problems::outer_solar_system_long()?;
        let gravitation = Gravitation::new(problem.equations.parameters.to_vec())?;
        let gravitation = || gravitation.clone();
        let mut methods = vec![
            dormand_prince(&problem),
            verner(&problem),
            gauss_legendre_16(&problem),
            gauss_radau_15(&problem),
            derived_gauss_radau_15("Gravitation", problem.start, problem.end, gravitation),
        ];
        methods.extend(nystrom(&problem));
        methods.push(composition(&problem, Order::Eight, 10_000.0));
        methods.extend(wisdom_holman(&problem, 2000.0));
        methods.extend(peers.of(&problem));
        run(&problem, &methods, results)?;
    }
    if "inner-solar-system".contains(filter) {
        let problem = problems::inner_solar_system()?;
        let term = PostNewtonian { centre: 0, speed_of_light: problem.equations.speed_of_light };
        let bodies = Gravitation::new(problem.equations.bodies.parameters.to_vec())?.with_post_newtonian(term)?;
        let bodies = || bodies.clone();
        let mut methods = vec![
            dormand_prince(&problem),
            verner(&problem),
            gauss_legendre_16(&problem),
            gauss_radau_15(&problem),
            derived_gauss_legendre_16("Gravitation", problem.start, problem.end, bodies),
            gauss_legendre(&problem, Order::Eight, 1000.0),
        ];
        methods.extend(peers.of(&problem));
        run(&problem, &methods, results)?;
    }
    if "cluster".contains(filter) {
        let problem = problems::cluster()?;
        let gravitation = Gravitation::new(problem.equations.parameters.to_vec())?;
        let gravitation = || gravitation.clone();
        let mut methods = vec![
            dormand_prince(&problem),
            verner(&problem),
            gauss_legendre_16(&problem),
            gauss_radau_15(&problem),
            derived_dormand_prince("Gravitation", problem.start, problem.end, gravitation),
            derived_gauss_legendre_16("Gravitation", problem.start, problem.end, gravitation),
            derived_gauss_radau_15("Gravitation", problem.start, problem.end, gravitation),
        ];
        methods.extend(nystrom(&problem));
        methods.extend(derived_nystrom("Gravitation", problem.start, problem.end, gravitation));
        methods.extend(peers.of(&problem));
        run(&problem, &methods, results)?;
    }
    Ok(())
}

/// Tops and the stiff chain.
fn tops_and_springs(peers: &impl Peers, filter: &str, results: &mut Results) -> Result<(), Box<dyn Error>> {
    for problem in [problems::free_top()?, problems::heavy_top()?] {
        if problem.name.contains(filter) {
            let is_free = problem.name == "free-top";
            let mut methods = vec![dormand_prince(&problem), verner(&problem), quaternion_gauss_legendre_16(&problem)];
            methods.extend(on_the_group(&problem, if is_free { 40.0 } else { 400.0 }));
            methods.push(if is_free { closed_form(&problem) } else { closed_form_of_top(&problem) });
            methods.extend(peers.of(&problem));
            run(&problem, &methods, results)?;
        }
    }
    if "spring-chain".contains(filter) {
        let problem = problems::spring_chain()?;
        let mut methods = vec![radau_iia(&problem), dormand_prince(&problem), verner(&problem)];
        methods.extend(peers.of(&problem));
        methods.extend(peers.stiff(&problem));
        run(&problem, &methods, results)?;
    }
    Ok(())
}

fn double_pendulum(peers: &impl Peers, results: &mut Results) -> Result<(), Box<dyn Error>> {
    let problem = problems::double_pendulum()?;
    let pendulum = problem.equations;
    let chain = Chain::<2> { masses: pendulum.masses, lengths: pendulum.lengths };
    let lagrangian = Lagrangian::of(chain).with_gravity(pendulum.gravity);
    let back = |y: &mut [f64]| {
        if let Some(&[q1, q2, p1, p2]) = y.first_chunk() {
            y[2..4].copy_from_slice(&pendulum.velocities([q1, q2], [p1, p2]));
        }
    };
    let mut methods = vec![
        dormand_prince(&problem),
        verner(&problem),
        gauss_legendre_16(&problem),
        gauss_radau_15(&problem),
        derived_gauss_legendre_16("by placement", problem.start, problem.end, || lagrangian.motion(2)),
        derived_dormand_prince("by placement", problem.start, problem.end, || lagrangian.motion(2)),
    ];
    methods.extend(COLLOCATION.map(|order| gauss_legendre(&problem, order, 30.0)));
    // It starts from rest: momenta are zero as velocities are.
    methods.extend(COLLOCATION.map(|order| {
        canonical_gauss_legendre(problem.start, problem.end, || lagrangian.canonical_motion(2), back, order, 30.0)
    }));
    methods.extend(peers.of(&problem));
    run(&problem, &methods, results)
}

fn outer_solar_system(peers: &impl Peers, results: &mut Results) -> Result<(), Box<dyn Error>> {
    let problem = problems::outer_solar_system()?;
    let gravitation = Gravitation::new(problem.equations.parameters.to_vec())?;
    let mut methods = separable_methods(&problem, peers, 100.0);
    let gravitation = || gravitation.clone();
    methods.insert(1, derived_dormand_prince("Gravitation", problem.start, problem.end, gravitation));
    methods.insert(2, derived_gauss_legendre_16("Gravitation", problem.start, problem.end, gravitation));
    methods.insert(3, derived_gauss_radau_15("Gravitation", problem.start, problem.end, gravitation));
    run(&problem, &methods, results)
}

/// All methods on equations written by hand that separate.
fn separable_methods<'a, E: Equations<D> + Force + Accelerations + Copy + Send + Sync, const D: usize>(
    problem: &'a Problem<E, D>,
    peers: &impl Peers,
    fewest: f64,
) -> Vec<Method<'a>> {
    let mut methods =
        vec![dormand_prince(problem), verner(problem), gauss_legendre_16(problem), gauss_radau_15(problem)];
    methods.extend(nystrom(problem));
    methods.extend(Order::ALL.map(|order| composition(problem, order, fewest)));
    methods.extend(COLLOCATION.map(|order| gauss_legendre(problem, order, fewest)));
    methods.extend(peers.of(problem));
    methods
}

fn run<E: Equations<D>, const D: usize>(
    problem: &Problem<E, D>,
    methods: &[Method<'_>],
    results: &mut Results,
) -> Result<(), Box<dyn Error>> {
    eprintln!("{}", problem.title);
    let curves: Vec<Curve> = measure(problem, methods, |complaint| eprintln!("  left out: {complaint}"));
    let path = results.folder.join(format!("work-precision-{}.svg", problem.name));
    std::fs::write(&path, figure(problem.title, &curves))?;
    eprintln!("  {}", path.display());
    results.records.extend(curves.iter().flat_map(|curve| curve.records(problem.name)));
    results.entries.extend(advice::entries(problem, &curves));
    Ok(())
}
