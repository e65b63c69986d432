//! Nanoseconds a joint of inverse and forward dynamics of chains: how the cost grows.
#![expect(clippy::print_stdout, reason = "it prints its table")]

use std::hint::black_box;
use std::time::Instant;

#[path = "../tests/it/trees.rs"]
mod trees;

fn measure(mut f: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    let mut repeats = 1;
    for _ in 0..30 {
        let start = Instant::now();
        for _ in 0..repeats {
            f();
        }
        let t = start.elapsed().as_secs_f64();
        best = best.min(t / f64::from(repeats));
        if t < 2e-3 {
            repeats *= 2;
        }
    }
    best * 1e9
}

fn main() {
    let mut list = vec![("ur5".to_owned(), trees::ur5())];
    for n in [10, 30, 100, 300, 1000] {
        list.push((format!("chain {n}"), trees::chain(n)));
    }
    for (name, tree) in list {
        let n = tree.freedoms();
        let mut work = tree.workspace();
        let q: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
        let v: Vec<f64> = (0..n).map(|i| (i as f64 * 1.3).cos()).collect();
        let a = v.clone();
        let mut out = vec![0.0; n];
        let id = measure(|| {
            tree.inverse_dynamics(&mut work, black_box(&q), &v, &a, &mut out).unwrap();
            black_box(&mut out);
        });
        let fd = measure(|| {
            tree.forward_dynamics(&mut work, black_box(&q), &v, &a, &mut out).unwrap();
            black_box(&mut out);
        });
        let mut matrix = vec![0.0; n * n];
        let mm = measure(|| {
            tree.mass_matrix(&mut work, black_box(&q), &mut matrix).unwrap();
            black_box(&mut matrix);
        });
        println!("mass matrix {mm:.0} ns");
        let mut d = piola_multibody::AccelerationDerivatives::new(&tree);
        let fdd = measure(|| {
            tree.forward_dynamics_derivatives(&mut work, black_box(&q), &v, &a, &mut d).unwrap();
            black_box(&mut d);
        });
        println!("forward dynamics derivatives {fdd:.0} ns");
        let states = 64;
        let mut qs = piola_multibody::StateBlocks::new(n, states);
        for i in 0..states {
            qs.set(i, &q).unwrap();
        }
        let mut outs = qs.clone();
        let mut batch = piola_multibody::BatchWorkspace::new(&tree, 1);
        let idl = measure(|| {
            tree.inverse_dynamics_of_states(&mut batch, black_box(&qs), &qs, &qs, &mut outs).unwrap();
            black_box(&mut outs);
        });
        let fdl = measure(|| {
            tree.forward_dynamics_of_states(&mut batch, black_box(&qs), &qs, &qs, &mut outs).unwrap();
            black_box(&mut outs);
        });
        let per = (n * states) as f64;
        println!("lanes: inverse {:.1} forward {:.1}", idl / per, fdl / per);
        let mut m = [vec![0.0; n * n], vec![0.0; n * n], vec![0.0; n * n]];
        let [x, y, z] = &mut m;
        let idd = measure(|| {
            tree.inverse_dynamics_derivatives(&mut work, black_box(&q), &v, &a, x, y, z).unwrap();
            black_box(&mut *x);
        });
        println!("inverse dynamics derivatives {idd:.0} ns");
        let sc = measure(|| {
            for q in black_box(&q) {
                black_box(q.sin_cos());
            }
        });
        println!(
            "{name}: inverse {:.1} forward {:.1} ns/joint, sin_cos {:.1}",
            id / n as f64,
            fd / n as f64,
            sc / n as f64
        );
    }
}
