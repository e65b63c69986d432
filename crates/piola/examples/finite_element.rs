//! A finite-element program of its own: mixed bricks (displacements of second order on 27 nodes, pressures linear in each element)
//! assembled from stresses and tangents in batches, solved by Newton's method with a sparse LU decomposition, and compared with the
//! exact torsion of a block and the exact inflation of a segment of a tube.
//!
//! ```text
//! ∫ (P_law − p Cof F) : ∇δu dV = ∫ t·δu dA        ∫ δp (J − 1) dV = 0
//! ```
//! `cargo run --release -p piola --example finite_element --features batch,solutions -- 8` refines to 8³ elements; with the name of a
//! file behind it, it draws the errors there as SVG.
#![expect(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;
use std::fmt::Write;
use std::time::Instant;

use faer::prelude::Solve;
use faer::sparse::{SparseColMat, Triplet};
use nalgebra::{Matrix3, Vector3};
use piola::batch::Displacements;
use piola::continuum::FirstPiola;
use piola::fields::{Coordinates, Cylindrical};
use piola::solids::{MooneyRivlin, batch, isochoric};
use piola::solutions::families::{Datum, Family, FromCartesian, TubeDeformation};

type Outcome<T> = Result<T, Box<dyn Error>>;
/// Values and slopes of the shape functions of 27 nodes.
type Shapes = [(f64, Vector3<f64>); 27];

/// A body with the errors of u and T for numbers of elements along an edge.
type Refinement<'a> = (&'a str, Vec<(usize, [f64; 2])>);

/// Gauss' three points of [−1, 1].
const GAUSS: [(f64, f64); 3] =
    [(-0.774_596_669_241_483, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483, 5.0 / 9.0)];

/// Quadratic polynomials with the value 1 at −1, 0 or 1, and their slopes.
fn quadratic(x: f64) -> [[f64; 2]; 3] {
    [[0.5 * x * (x - 1.0), x - 0.5], [1.0 - x * x, -2.0 * x], [0.5 * x * (x + 1.0), x + 0.5]]
}

fn shapes(at: [f64; 3]) -> Shapes {
    let [x, y, z] = at.map(quadratic);
    core::array::from_fn(|a| {
        let ([f, df], [g, dg], [h, dh]) = (x[a % 3], y[a / 3 % 3], z[a / 9]);
        (f * g * h, Vector3::new(df * g * h, f * dg * h, f * g * dh))
    })
}

/// A point of quadrature.
struct Point {
    element: usize,
    place: Vector3<f64>,
    /// Volume of the reference.
    weight: f64,
    /// Nₐ and ∂Nₐ/∂X of the 27 nodes.
    shapes: Shapes,
    /// 1, ξ, η, ζ of the pressure.
    linear: [f64; 4],
}

/// Places, elements, and nodes whose displacements are given: all of the surface without the upper side of the first coordinate.
struct Mesh {
    places: Vec<Vector3<f64>>,
    elements: Vec<[usize; 27]>,
    fixed: Vec<bool>,
    /// On the upper side: node values of the shape functions, place and normal times area.
    loaded: Vec<(Shapes, usize, Vector3<f64>, Vector3<f64>)>,
}

impl Mesh {
    /// n³ elements over a map of the unit cube.
    fn new(n: usize, map: impl Fn([f64; 3]) -> Vector3<f64>) -> Self {
        let (m, mut mesh) = (2 * n + 1, Self { places: vec![], elements: vec![], fixed: vec![], loaded: vec![] });
        for index in 0..m * m * m {
            let [i, j, k] = [index % m, index / m % m, index / m / m];
            mesh.places.push(map([i, j, k].map(|i| i as f64 / (m - 1) as f64)));
            mesh.fixed.push(i == 0 || [j, k].iter().any(|&j| j == 0 || j == m - 1));
        }
        for index in 0..n * n * n {
            let [i, j, k] = [index % n, index / n % n, index / n / n];
            let nodes = core::array::from_fn(|a| 2 * i + a % 3 + m * (2 * j + a / 3 % 3 + m * (2 * k + a / 9)));
            mesh.elements.push(nodes);
            if i == n - 1 {
                for ((y, wy), (z, wz)) in GAUSS.into_iter().flat_map(|y| GAUSS.map(|z| (y, z))) {
                    let shapes = shapes([1.0, y, z]);
                    let (place, tangents) = mesh.place(index, &shapes);
                    let area = tangents.column(1).cross(&tangents.column(2)) * (wy * wz);
                    mesh.loaded.push((shapes, index, place, area));
                }
            }
        }
        mesh
    }

    /// X and ∂X/∂ξ.
    fn place(&self, element: usize, shapes: &Shapes) -> (Vector3<f64>, Matrix3<f64>) {
        let nodes = || self.elements[element].iter().map(|&node| self.places[node]).zip(shapes);
        (nodes().map(|(x, (n, _))| x * *n).sum(), nodes().map(|(x, (_, slope))| x * slope.transpose()).sum())
    }

    fn points(&self) -> Outcome<Vec<Point>> {
        let point = |index: usize| {
            let [(x, wx), (y, wy), (z, wz)] = [index % 3, index / 3 % 3, index / 9 % 3].map(|i| GAUSS[i]);
            let (element, shapes) = (index / 27, shapes([x, y, z]));
            let (place, tangents) = self.place(element, &shapes);
            let inverse = tangents.try_inverse().ok_or("an element is singular")?.transpose();
            let shapes = shapes.map(|(n, slope)| (n, inverse * slope));
            let weight = tangents.determinant() * wx * wy * wz;
            Ok(Point { element, place, weight, shapes, linear: [1.0, x, y, z] })
        };
        (0..27 * self.elements.len()).map(point).collect()
    }
}

/// A tube of the radii 1 and 2 with the outer face free, and its law.
struct Exact {
    tube: TubeDeformation,
    law: isochoric::MooneyRivlin,
}

impl Exact {
    /// Of the stretch of the inner face and of the twist at fixed length.
    fn new(inner: f64, twist: f64) -> Outcome<Self> {
        let tube = TubeDeformation::new([1.0, inner * inner - 1.0, 1.0, twist, 0.0, 1.0])?;
        Ok(Self { tube, law: isochoric::MooneyRivlin::new(0.4, 0.1)? })
    }

    /// u, T and P at a place of the reference, in Cartesian components.
    fn at(&self, place: &Vector3<f64>) -> Outcome<(Vector3<f64>, Matrix3<f64>, Matrix3<f64>)> {
        let rows = |rows: [[f64; 3]; 3]| Matrix3::from(rows).transpose();
        let at = Cylindrical::of_place((*place).into());
        let moved = Vector3::from(self.tube.place(at));
        let before = rows(Cylindrical.physical_frame(&at.into())?.directions);
        let after = rows(Cylindrical.physical_frame(&moved)?.directions);
        let stress = self.tube.stress(&self.law, &Datum::free_at([2.0, 0.0, 0.0]), at)?.cauchy.0.matrix();
        let (stress, gradient) = (after.transpose() * stress * after, rows(self.tube.gradient(at)));
        let inverse = (after.transpose() * gradient * before).try_inverse().ok_or("a singular deformation")?;
        Ok((Cylindrical.place(&moved) - place, stress, stress * inverse.transpose()))
    }
}

/// A mesh with its unknowns.
struct Problem {
    mesh: Mesh,
    points: Vec<Point>,
    law: MooneyRivlin,
    /// The number of the unknown of each component of each node; `None` where it is given.
    numbers: Vec<Option<usize>>,
    unknowns: usize,
    displacements: Vec<f64>,
    /// Four of each element.
    pressures: Vec<f64>,
}

/// Cof F.
fn cofactor(f: &Matrix3<f64>) -> Matrix3<f64> {
    let [a, b, c] = [0, 1, 2].map(|i| f.row(i).transpose());
    Matrix3::from_rows(&[b.cross(&c).transpose(), c.cross(&a).transpose(), a.cross(&b).transpose()])
}

/// (∂Cof F/∂F) : Δ, the part of Cof (F + Δ) that is linear in Δ.
fn cofactor_change(f: &Matrix3<f64>, d: &Matrix3<f64>) -> Matrix3<f64> {
    cofactor(&(f + d)) - cofactor(f) - cofactor(d)
}

impl Problem {
    fn new(mesh: Mesh, law: MooneyRivlin) -> Outcome<Self> {
        let points = mesh.points()?;
        let (mut numbers, mut unknowns) = (Vec::new(), 0);
        for fixed in mesh.fixed.iter().flat_map(|&fixed| [fixed; 3]) {
            numbers.push((!fixed).then_some(unknowns));
            unknowns += usize::from(!fixed);
        }
        let (displacements, pressures) = (vec![0.0; numbers.len()], vec![0.0; 4 * mesh.elements.len()]);
        unknowns += pressures.len();
        Ok(Self { mesh, points, law, numbers, unknowns, displacements, pressures })
    }

    fn displacement(&self, node: usize) -> Vector3<f64> {
        Vector3::from_column_slice(&self.displacements[3 * node..3 * node + 3])
    }

    /// ∇u at all points.
    fn gradients(&self) -> Vec<Matrix3<f64>> {
        let gradient = |point: &Point| {
            let nodes = &self.mesh.elements[point.element];
            nodes.iter().zip(&point.shapes).map(|(&node, (_, slope))| self.displacement(node) * slope.transpose()).sum()
        };
        self.points.iter().map(gradient).collect()
    }

    fn pressure(&self, point: &Point) -> f64 {
        (0..4).map(|k| point.linear[k] * self.pressures[4 * point.element + k]).sum()
    }

    /// One step of Newton's method, with changes of the given displacements; returns the size of the correction.
    fn step(&mut self, change: &[f64], loads: &[f64]) -> Outcome<f64> {
        // Stresses and tangents of all points in one batch, in lanes: 9 + 45 numbers each, nothing more.
        let gradients = self.gradients();
        let (mut stress, mut tangent) = (vec![FirstPiola::zero(); gradients.len()], vec![[0.0; 45]; gradients.len()]);
        let request = batch::first_piola_and_tangent(&self.law, &mut stress[..], &mut tangent[..]);
        batch::evaluate(Displacements(&gradients[..]), request)?;

        let (free, base) = (self.unknowns - self.pressures.len(), self.pressures.len());
        let mut right = faer::Mat::<f64>::zeros(free + base, 1);
        for (row, load) in self.numbers.iter().zip(loads).filter_map(|(row, load)| Some(((*row)?, load))) {
            right[(row, 0)] += load;
        }
        let mut entries = Vec::new();
        for element in 0..self.mesh.elements.len() {
            let (mut matrix, mut residual) = (vec![0.0; 85 * 85], [0.0; 85]);
            for index in 27 * element..27 * (element + 1) {
                let point = &self.points[index];
                let (f, p) = (gradients[index] + Matrix3::identity(), self.pressure(point));
                let cof = cofactor(&f);
                let whole = stress[index].0 - cof * p;
                let upper = |r: usize, c: usize| tangent[index][r.min(c) * (19 - r.min(c)) / 2 + r.abs_diff(c)];
                for a in 0..27 {
                    let slope = point.shapes[a].1 * point.weight;
                    let (force, along) = (whole * slope, cof * slope);
                    for i in 0..3 {
                        let row = 3 * a + i;
                        residual[row] += force[i];
                        // A : (eᵢ ⊗ ∂Nₐ): what a displacement of the node does to P.
                        let turned = |k, l| (0..3).map(|j| slope[j] * upper(3 * i + j, 3 * k + l)).sum();
                        let mut unit = Matrix3::zeros();
                        unit.set_row(i, &slope.transpose());
                        let change = Matrix3::from_fn(turned) - cofactor_change(&f, &unit) * p;
                        for b in 0..27 {
                            let column = change * point.shapes[b].1;
                            (0..3).for_each(|k| matrix[85 * row + 3 * b + k] += column[k]);
                        }
                        for k in 0..4 {
                            matrix[85 * row + 81 + k] -= along[i] * point.linear[k];
                            matrix[85 * (81 + k) + row] -= along[i] * point.linear[k];
                        }
                    }
                }
                let volume = (f.determinant() - 1.0) * point.weight;
                for k in 0..4 {
                    residual[81 + k] -= volume * point.linear[k];
                }
            }
            let nodes = &self.mesh.elements[element];
            let of_node = |r: usize| self.numbers[3 * nodes[r / 3] + r % 3];
            let number = |r: usize| if r < 81 { of_node(r) } else { Some(free + 4 * element + r - 81) };
            for r in 0..85 {
                let Some(row) = number(r) else { continue };
                right[(row, 0)] -= residual[r];
                for c in 0..85 {
                    match number(c) {
                        Some(column) => entries.push(Triplet::new(row, column, matrix[85 * r + c])),
                        None => right[(row, 0)] -= matrix[85 * r + c] * change[3 * nodes[c / 3] + c % 3],
                    }
                }
            }
        }
        let matrix = SparseColMat::<usize, f64>::try_new_from_triplets(free + base, free + base, &entries)
            .map_err(|error| format!("{error:?}"))?;
        let found = matrix.sp_lu().map_err(|error| format!("{error:?}"))?.solve(&right);
        for (index, number) in self.numbers.iter().enumerate() {
            self.displacements[index] += number.map_or(change[index], |row| found[(row, 0)]);
        }
        self.pressures.iter_mut().enumerate().for_each(|(index, p)| *p += found[(free + index, 0)]);
        Ok((0..free).fold(0.0, |largest, row| found[(row, 0)].abs().max(largest)))
    }

    /// Solves for a state of the family: its displacements are given on the fixed nodes, its tractions on the upper side.
    fn solve(&mut self, exact: &Exact) -> Outcome<()> {
        let mut change = vec![0.0; self.displacements.len()];
        for (node, place) in self.mesh.places.iter().enumerate().filter(|(node, _)| self.mesh.fixed[*node]) {
            let displacement = exact.at(place)?.0;
            (0..3).for_each(|i| change[3 * node + i] = displacement[i] - self.displacements[3 * node + i]);
        }
        let mut loads = vec![0.0; change.len()];
        for (shapes, element, place, area) in &self.mesh.loaded {
            let traction = exact.at(place)?.2 * area;
            for (&node, (n, _)) in self.mesh.elements[*element].iter().zip(shapes) {
                (0..3).for_each(|i| loads[3 * node + i] += traction[i] * n);
            }
        }
        for _ in 0..12 {
            if self.step(&change, &loads)? < 1e-10 {
                return Ok(());
            }
            change.fill(0.0);
        }
        Err("Newton's method does not converge".into())
    }

    /// Errors of u and T in the mean, relative to their size.
    fn errors(&self, exact: &Exact) -> Outcome<[f64; 2]> {
        let gradients = self.gradients();
        let mut stress = vec![piola::continuum::CauchyStress::zero(); gradients.len()];
        batch::evaluate(Displacements(&gradients[..]), batch::cauchy(&self.law, &mut stress[..]))?;
        let (mut wrong, mut size) = ([0.0; 2], [0.0; 2]);
        for (point, stress) in self.points.iter().zip(&stress) {
            let (displacement, cauchy, _) = exact.at(&point.place)?;
            let nodes = self.mesh.elements[point.element].iter().zip(&point.shapes);
            let found: Vector3<f64> = nodes.map(|(&node, (n, _))| self.displacement(node) * *n).sum();
            let found_stress = stress.0.matrix() - Matrix3::identity() * self.pressure(point);
            let squares = [(found - displacement).norm_squared(), (found_stress - cauchy).norm_squared()];
            for (k, scale) in [displacement.norm_squared(), cauchy.norm_squared()].into_iter().enumerate() {
                wrong[k] += squares[k] * point.weight;
                size[k] += scale * point.weight;
            }
        }
        Ok([0, 1].map(|k: usize| (wrong[k] / size[k]).sqrt()))
    }
}

/// Errors over the number of elements along an edge, on logarithmic axes: of each body one line for u and one for T.
fn picture(bodies: &[Refinement<'_>]) -> Result<String, std::fmt::Error> {
    let place = |n: f64, error: f64| (90.0 + 130.0 * n.log2(), 40.0 - 65.0 * error.log10());
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 780 500\" font-family=\"sans-serif\" font-size=\"14\" fill=\"#222222\">\n\
         <rect width=\"780\" height=\"500\" fill=\"white\"/>\n",
    );
    let line = |svg: &mut String, points: &[(f64, f64)], style: &str| {
        let path: Vec<String> = points.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        writeln!(svg, "<polyline points=\"{}\" fill=\"none\" {style}/>", path.join(" "))
    };
    for decade in -6..=0 {
        let (left, y) = place(1.0, 10.0_f64.powi(decade));
        line(&mut svg, &[(left, y), (left + 400.0, y)], "stroke=\"#dddddd\"")?;
        writeln!(svg, "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">1e{decade}</text>", left - 8.0, y + 5.0)?;
    }
    for n in [1.0, 2.0, 4.0, 8.0] {
        let (x, bottom) = place(n, 1e-6);
        writeln!(svg, "<text x=\"{x}\" y=\"{}\" text-anchor=\"middle\">{n}³</text>", bottom + 22.0)?;
    }
    svg += "<text x=\"285\" y=\"480\" text-anchor=\"middle\">elements</text>\n\
            <text x=\"90\" y=\"24\">error in the mean, relative to the size of u or T</text>\n";
    for (order, start) in [(3, 8e-4), (2, 6e-2)] {
        let ends = [1.0, 8.0_f64].map(|n| place(n, start * n.powi(-order)));
        line(&mut svg, &ends, "stroke=\"#888888\" stroke-dasharray=\"2 4\"")?;
        writeln!(
            svg,
            "<text x=\"{}\" y=\"{}\" fill=\"#666666\">order {order}</text>",
            ends[1].0 + 8.0,
            ends[1].1 + 5.0
        )?;
    }
    for ((name, errors), (colour, row)) in bodies.iter().zip([("#0072B2", 0.0), ("#D55E00", 50.0)]) {
        for (k, (what, dash, below)) in
            [("u", "", 0.0), ("T", "stroke-dasharray=\"8 4\"", 24.0)].into_iter().enumerate()
        {
            let points: Vec<_> = errors.iter().map(|(n, errors)| place(*n as f64, errors[k])).collect();
            let (style, y) = (format!("stroke=\"{colour}\" stroke-width=\"2\" {dash}"), 60.0 + row + below);
            line(&mut svg, &points, &style)?;
            for (x, y) in points {
                writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{colour}\"/>")?;
            }
            line(&mut svg, &[(510.0, y - 5.0), (540.0, y - 5.0)], &style)?;
            writeln!(svg, "<text x=\"548\" y=\"{y}\">{what}, {name}</text>")?;
        }
    }
    Ok(svg + "</svg>\n")
}

fn main() -> Outcome<()> {
    let finest = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(2);
    // The isochoric law of the exact solution, with any volumetric part: it has nothing to do at J = 1.
    let law = MooneyRivlin::stress_free(0.4, 0.1, 1.0)?;
    let block = |[x, y, z]: [f64; 3]| Vector3::new(1.0 + x, y - 0.5, z);
    let segment = |[x, y, z]: [f64; 3]| {
        let (s, c) = (core::f64::consts::FRAC_PI_4 * (2.0 * y - 1.0)).sin_cos();
        Vector3::new((1.0 + x) * c, (1.0 + x) * s, z)
    };
    println!(
        "| body | elements | unknowns | error of u | order | error of T | order | s |\n|---|---|---|---|---|---|---|---|"
    );
    let (mut gradients, mut bodies) = (Vec::new(), Vec::new());
    for (name, inner, twist) in [("block, twisted", 1.0, 0.6), ("segment of a tube, inflated", 1.5, 0.0)] {
        let (mut before, mut rows): (Option<[f64; 2]>, _) = (None, Vec::new());
        for n in core::iter::successors(Some(1), |n| Some(2 * n)).take_while(|&n| n <= finest) {
            let clock = Instant::now();
            let mut problem = Problem::new(if twist > 0.0 { Mesh::new(n, block) } else { Mesh::new(n, segment) }, law)?;
            for share in [0.5, 1.0] {
                problem.solve(&Exact::new(1.0 + share * (inner - 1.0), share * twist)?)?;
            }
            let errors = problem.errors(&Exact::new(inner, twist)?)?;
            let order = |k: usize| before.map_or(f64::NAN, |before| (before[k] / errors[k]).log2());
            let (unknowns, seconds) = (problem.unknowns, clock.elapsed().as_secs_f64());
            let [u, t] = [0, 1].map(|k| format!("{:.2e} | {:.2}", errors[k], order(k)).replace("NaN", "–"));
            println!("| {name} | {n}³ | {unknowns} | {u} | {t} | {seconds:.1} |");
            // Order 3 of u and 2 of T, with room for coarse meshes.
            assert!(before.is_none() || (2.4 < order(0) && 1.5 < order(1)), "orders {} and {}", order(0), order(1));
            before = Some(errors);
            rows.push((n, errors));
            gradients = problem.gradients();
        }
        bodies.push((name, rows));
    }
    if let Some(file) = std::env::args().nth(2) {
        std::fs::write(file, picture(&bodies)?)?;
    }

    // A million points: the same call, whatever the length. Room is made once and used in every step.
    let gradients: Vec<_> = gradients.iter().copied().cycle().take(1_000_000).collect();
    let (mut stress, mut tangent) = (vec![FirstPiola::zero(); gradients.len()], vec![[0.0; 45]; gradients.len()]);
    let clock = Instant::now();
    let request = batch::first_piola_and_tangent(&law, &mut stress[..], &mut tangent[..]);
    batch::evaluate(Displacements(&gradients[..]), request)?;
    println!("stress and tangent at {} points: {:.0} ns each", gradients.len(), clock.elapsed().as_secs_f64() * 1e3);
    Ok(())
}
