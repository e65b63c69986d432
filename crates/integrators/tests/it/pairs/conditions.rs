//! The conditions of order of all tableaux: one for each rooted tree, in twice double precision.
//!
//! A tree is f with arguments that are subtrees. Its value at stage i is the product of its arguments' values there; on the exact
//! solution the same product is α θᵐ. An argument is the integral of a subtree (the double integral for Nyström pairs, whose
//! positions have the time itself as another argument).

use piola_integrators::internal::{NystromCoefficients, RungeKuttaCoefficients};
use piola_integrators::{DormandPrincePair, NystromPair86, NystromPair1210, VernerPair};
use piola_numerics::Real;
use piola_testkit::DoubleDouble;

type Weights = &'static [(usize, f64)];

fn wide(x: f64) -> DoubleDouble {
    DoubleDouble::lit(x)
}

/// A product at the stages, a bound of its rounding there in units of the coefficients' own, and α θᵐ.
#[derive(Clone)]
struct Tree {
    values: Vec<DoubleDouble>,
    /// The same product of absolute values.
    sizes: Vec<f64>,
    exact: DoubleDouble,
    degree: u32,
}

fn degree_as(number: u32) -> DoubleDouble {
    wide(f64::from(number))
}

/// A weighted sum of a tree over the stages, and the bound of its error by the rounding of coefficients to double precision: half
/// an ulp for each coefficient of a product, of which there are no more than its degree and one.
fn summed(weights: &[(usize, f64)], tree: &Tree) -> (DoubleDouble, f64) {
    let sum = weights.iter().fold(wide(0.0), |sum, &(j, a)| sum + wide(a) * tree.values[j]);
    let size: f64 = weights.iter().map(|&(j, a)| a.abs() * tree.sizes[j]).sum();
    (sum, 0.5 * f64::EPSILON * f64::from(tree.degree + 2) * size)
}

/// All trees up to a degree. `rows` are the stages after the first that have a row, by their numbers.
fn trees(stages: usize, nodes: &[f64], rows: &[(usize, Weights)], nystrom: bool, most: u32) -> Vec<Tree> {
    let one = Tree { values: vec![wide(1.0); stages], sizes: vec![1.0; stages], exact: wide(1.0), degree: 0 };
    let mut arguments: Vec<Tree> = Vec::new();
    if nystrom {
        arguments.push(Tree {
            values: nodes.iter().map(|&c| wide(c)).chain(core::iter::repeat(wide(1.0))).take(stages).collect(),
            sizes: vec![1.0; stages],
            exact: wide(1.0),
            degree: 1,
        });
    }
    let mut trees = vec![one];
    let mut done = 0;
    for degree in 0..=most {
        // The trees of this degree become arguments; what is longer is made of shorter ones.
        if degree > 0 {
            let (from, mut found) = (trees.len(), Vec::new());
            products(&arguments, 0, &trees[0].clone(), degree, &mut found);
            trees.extend(found);
            done = from;
        }
        for tree in &trees[done..] {
            let gained = if nystrom { 2 } else { 1 };
            let mut argument = Tree {
                values: vec![wide(0.0); stages],
                sizes: vec![0.0; stages],
                exact: tree.exact / degree_as(degree + 1),
                degree: degree + gained,
            };
            if nystrom {
                argument.exact /= degree_as(degree + 2);
            }
            for &(i, weights) in rows {
                argument.values[i] = summed(weights, tree).0;
                argument.sizes[i] = weights.iter().map(|&(j, a)| a.abs() * tree.sizes[j]).sum();
            }
            arguments.push(argument);
        }
        arguments.sort_by_key(|argument| argument.degree);
    }
    trees
}

/// Products of arguments, from the given one on, of exactly this degree.
fn products(arguments: &[Tree], from: usize, so_far: &Tree, degree: u32, found: &mut Vec<Tree>) {
    if so_far.degree == degree {
        found.push(so_far.clone());
        return;
    }
    for (index, argument) in arguments.iter().enumerate().skip(from) {
        if degree < so_far.degree + argument.degree {
            break;
        }
        let product = Tree {
            values: so_far.values.iter().zip(&argument.values).map(|(&a, &b)| a * b).collect(),
            sizes: so_far.sizes.iter().zip(&argument.sizes).map(|(a, b)| a * b).collect(),
            exact: so_far.exact * argument.exact,
            degree: so_far.degree + argument.degree,
        };
        products(arguments, index, &product, degree, found);
    }
}

/// Checks Σ wᵢ Φᵢ = `exact` for all trees that count for an order, and that the next order asks for more.
fn check(
    what: &str,
    weights: &[(usize, f64)],
    trees: &[Tree],
    order: u32,
    expected: usize,
    exact: impl Fn(&Tree) -> Option<(u32, DoubleDouble)>,
) {
    let (mut checked, mut next_fails) = (0, false);
    for tree in trees {
        let Some((of_order, exact)) = exact(tree) else { continue };
        let (sum, bound) = summed(weights, tree);
        let residual = (sum - exact).primal(0).abs();
        if of_order <= order {
            assert!(residual <= bound, "{what}, order {of_order}: {residual:e} beyond {bound:e}");
            checked += 1;
        } else if of_order == order + 1 {
            next_fails |= 1e-9 < residual;
        }
    }
    assert_eq!(checked, expected, "{what}");
    assert!(next_fails, "{what}: its order is higher than {order}");
}

fn runge_kutta<P: RungeKuttaCoefficients>(what: &str, order: u32, estimates: u32, counts: [usize; 2]) {
    let all = trees(P::STAGES, P::NODES, P::ROWS, false, order);
    for &(i, weights) in P::ROWS.iter().chain(P::DENSE_ROWS) {
        let sum = weights.iter().fold(wide(-P::NODES[i]), |sum, &(_, a)| sum + wide(a)).primal(0).abs();
        let size: f64 = weights.iter().map(|(_, a)| a.abs()).sum();
        assert!(sum <= 0.5 * f64::EPSILON * (size + 1.0), "{what}, stage {i}: {sum:e}");
    }
    let result = |tree: &Tree| Some((tree.degree + 1, tree.exact / degree_as(tree.degree + 1)));
    check(what, P::WEIGHTS, &all, order, counts[0], result);
    let nothing = |tree: &Tree| Some((tree.degree + 1, wide(0.0)));
    check(what, P::ERROR, &all, estimates, counts[1], nothing);
}

#[test]
fn dormand_prince_satisfies_the_conditions_of_order_eight() {
    // 200 trees of up to eight vertices, seventeen of up to five.
    runge_kutta::<DormandPrincePair>("8(5,3)", 8, 5, [200, 17]);
    let all = trees(16, DormandPrincePair::NODES, DormandPrincePair::ROWS, false, 4);
    let result = |tree: &Tree| Some((tree.degree + 1, tree.exact / degree_as(tree.degree + 1)));
    check("of order three", DormandPrincePair::COARSER, &all, 3, 4, result);
}

#[test]
fn verner_satisfies_the_conditions_of_order_nine() {
    // 486 trees of up to nine vertices, 200 of up to eight.
    runge_kutta::<VernerPair>("9(8)", 9, 8, [486, 200]);
}

#[test]
fn interpolant_of_verner_satisfies_the_conditions_of_order_nine_within_the_step() {
    let rows: Vec<(usize, Weights)> = VernerPair::ROWS
        .iter()
        .copied()
        .chain([(VernerPair::END, VernerPair::WEIGHTS)])
        .chain(VernerPair::DENSE_ROWS.iter().copied())
        .collect();
    let all = trees(VernerPair::STAGES, VernerPair::NODES, &rows, false, 8);
    for theta in [0.1, 0.25, 0.5, 0.7, 0.9] {
        // b(θ): the increment of a stage that alone is one, with h = 1.
        let weights: Vec<(usize, f64)> = (0..VernerPair::STAGES)
            .map(|j| {
                let mut stages = vec![0.0; VernerPair::STAGES];
                stages[j] = 1.0;
                let mut interpolant = vec![0.0; VernerPair::INTERPOLANT];
                let (increment, others) = interpolant.split_at_mut(1);
                VernerPair::interpolant(&stages, increment, 1.0, others);
                (j, VernerPair::increment(&interpolant, 1, 0, theta))
            })
            .collect();
        let mut checked = 0;
        for tree in &all {
            let degree = tree.degree + 1;
            let power = (0..degree).fold(wide(1.0), |power, _| power * wide(theta));
            let (sum, bound) = summed(&weights, tree);
            let residual = (sum - tree.exact * power / degree_as(degree)).primal(0).abs();
            // Ten polynomials of at most one are summed in double precision.
            assert!(residual <= 10.0 * bound + 4.0 * f64::EPSILON, "at {theta}, order {degree}: {residual:e}");
            checked += 1;
        }
        assert_eq!(checked, 486);
    }
}

fn nystrom<P: NystromCoefficients>(what: &str, order: u32, estimates: u32, counts: [[usize; 2]; 2]) {
    let rows: Vec<(usize, Weights)> = P::ROWS.iter().enumerate().map(|(i, &row)| (i + 1, row)).collect();
    let all = trees(P::STAGES, P::NODES, &rows, true, order);
    let position = |tree: &Tree| {
        let (once, twice) = (tree.degree + 1, tree.degree + 2);
        Some((twice, tree.exact / (degree_as(once) * degree_as(twice))))
    };
    let velocity = |tree: &Tree| Some((tree.degree + 1, tree.exact / degree_as(tree.degree + 1)));
    check(what, P::POSITION, &all, order, counts[0][0], position);
    check(what, P::VELOCITY, &all, order, counts[0][1], velocity);
    let position = |tree: &Tree| Some((tree.degree + 2, wide(0.0)));
    let velocity = |tree: &Tree| Some((tree.degree + 1, wide(0.0)));
    check(what, P::POSITION_ERROR, &all, estimates, counts[1][0], position);
    check(what, P::VELOCITY_ERROR, &all, estimates, counts[1][1], velocity);
}

#[test]
fn nystrom_pairs_satisfy_the_conditions_of_their_orders() {
    nystrom::<NystromPair86>("8(6)", 8, 6, [[43, 79], [13, 23]]);
    nystrom::<NystromPair1210>("12(10)", 12, 10, [[563, 1104], [151, 288]]);
}
