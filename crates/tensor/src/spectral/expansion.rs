//! A function of a tensor that is diagonal but for derivatives and rounding, order by order.
//!
//! ```text
//! f(Λ + N)ᵢⱼ = f(λᵢ) δᵢⱼ + f[λᵢ, λⱼ] Nᵢⱼ + Σₖ f[λᵢ, λₖ, λⱼ] Nᵢₖ Nₖⱼ + Σₖₗ f[λᵢ, λₖ, λₗ, λⱼ] Nᵢₖ Nₖₗ Nₗⱼ + …
//! ```
//! (Daleckii and Krein). Λ holds frozen values, N the rest: derivatives, and what rounding left off the diagonal.
//! Terms up to the order of the scalar's derivatives are exact; without derivatives the first corrects the
//! rounding of the frame to second order.

use piola_numerics::{Mask, Real};

use super::IsotropicFunction;
use super::isotropic::{clustered, difference_of_series, series_at, unit_at};

/// The largest order of derivatives that the expansion brings in.
const LARGEST_ORDER: usize = 4;

/// Place of component (i, j) in 11, 22, 33, 12, 23, 13.
const PLACE: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];
/// The row and column of each component.
const ENTRY: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)];

/// The components of f(Λ + N), given f at the nodes Λ.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn expand<T: Real, F: IsotropicFunction + ?Sized>(f: &F, nodes: [T; 3], values: [T; 3], n: [T; 6]) -> [T; 6] {
    const { assert!(T::ORDER <= LARGEST_ORDER, "isotropic functions have derivatives up to the fourth order") };
    let [a, b, c] = nodes;
    if T::ORDER == 0 {
        let [u, v, w] = values;
        let pairs = [
            f.rough_divided_difference(a, b, u, v),
            f.rough_divided_difference(b, c, v, w),
            f.rough_divided_difference(a, c, u, w),
        ];
        return [values[0], values[1], values[2], pairs[0] * n[3], pairs[1] * n[4], pairs[2] * n[5]];
    }
    let pairs = [f.divided_difference(a, b), f.divided_difference(b, c), f.divided_difference(a, c)];
    let twice = [f.divided_difference(a, a), f.divided_difference(b, b), f.divided_difference(c, c)];
    let mut result = [
        values[0] + twice[0] * n[0],
        values[1] + twice[1] * n[1],
        values[2] + twice[2] * n[2],
        pairs[0] * n[3],
        pairs[1] * n[4],
        pairs[2] * n[5],
    ];
    if T::ORDER < 2 {
        return result;
    }
    let table = Table::of(f, nodes, values, twice, pairs);
    for ((i, j), entry) in ENTRY.into_iter().zip(&mut result) {
        for k in 0..3 {
            let product = n[PLACE[i][k]] * n[PLACE[k][j]];
            *entry += table.at([i, k, j]) * product;
            if 2 < T::ORDER {
                for l in 0..3 {
                    let product = n[PLACE[i][k]] * n[PLACE[k][l]] * n[PLACE[l][j]];
                    *entry += table.at([i, k, l, j]) * product;
                    if 3 < T::ORDER {
                        for m in 0..3 {
                            let product = n[PLACE[i][k]] * n[PLACE[k][l]] * n[PLACE[l][m]] * n[PLACE[m][j]];
                            *entry += table.at([i, k, l, m, j]) * product;
                        }
                    }
                }
            }
        }
    }
    result
}

/// Divided differences on the nodes λ₁, λ₂, λ₃, each taken some number of times: `entries[n₁][n₂][n₃]`.
struct Table<T> {
    entries: [[[T; SIZE]; SIZE]; SIZE],
}

const SIZE: usize = LARGEST_ORDER + 2;

impl<T: Real> Table<T> {
    #[inline]
    fn of<F: IsotropicFunction + ?Sized>(f: &F, nodes: [T; 3], values: [T; 3], twice: [T; 3], pairs: [T; 3]) -> Self {
        let mut table = Self { entries: [[[T::zero(); SIZE]; SIZE]; SIZE] };
        let e = &mut table.entries;
        [e[1][0][0], e[0][1][0], e[0][0][1]] = values;
        [e[2][0][0], e[0][2][0], e[0][0][2]] = twice;
        [e[1][1][0], e[0][1][1], e[1][0][1]] = pairs;
        let counts = |total: usize| (0..=total).flat_map(move |i| (0..=total - i).map(move |j| [i, j, total - i - j]));
        for [i, j, k] in counts(3) {
            let mut list = [nodes[2]; 3];
            list[..i].fill(nodes[0]);
            list[i..i + j].fill(nodes[1]);
            e[i][j][k] = f.second_divided_difference(list[0], list[1], list[2]);
        }
        if T::ORDER < 3 {
            return table;
        }
        // From the fourth node on by power series where the nodes are close, by recursion over the widest gap
        // where they are not.
        // Narrow spans first: the recursion over a wide one needs those inside it.
        for (first, last) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)] {
            let middle = T::lit(0.5) * (nodes[first] + nodes[last]);
            let near = clustered(f, nodes[last], nodes[first]);
            let gap = T::select(near, T::one(), nodes[first] - nodes[last]);
            let unit = unit_at(f, middle);
            let series = series_at(f, middle, unit);
            let cube = unit * unit * unit;
            for total in 4..=T::ORDER + 1 {
                for count in counts(total) {
                    let spans = count[first] != 0
                        && count[last] != 0
                        && count[..first].iter().chain(&count[last + 1..]).all(|&n| n == 0);
                    if !spans {
                        continue;
                    }
                    let offset = |number: usize| {
                        let which = if number < count[0] {
                            0
                        } else if number < count[0] + count[1] {
                            1
                        } else {
                            2
                        };
                        (nodes[which] - middle) / unit
                    };
                    let by_series = if total == 4 {
                        difference_of_series(series, [offset(0), offset(1), offset(2), offset(3)]) / cube
                    } else {
                        difference_of_series(series, [offset(0), offset(1), offset(2), offset(3), offset(4)])
                            / cube
                            / unit
                    };
                    let e = &mut table.entries;
                    let [i, j, k] = count;
                    e[i][j][k] = if first == last || near.all() {
                        by_series
                    } else {
                        let without = |which: usize| {
                            let mut fewer = count;
                            fewer[which] -= 1;
                            e[fewer[0]][fewer[1]][fewer[2]]
                        };
                        T::select(near, by_series, (without(last) - without(first)) / gap)
                    };
                }
            }
        }
        table
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn at<const M: usize>(&self, nodes: [usize; M]) -> T {
        let mut count = [0; 3];
        for node in nodes {
            count[node] += 1;
        }
        self.entries[count[0]][count[1]][count[2]]
    }
}
