//! What each lane width buys: arithmetic and every elementary function, against a loop over scalars that
//! calls the standard library.
//!
//! Every benchmark handles 1024 points in cache, so that `time / elements` is the time of one point. Names
//! read `<kernel> <float>` for the scalar loop and `<kernel> <float> x<lanes>` for lanes, all dispatched to
//! the best level of the machine; ` avx2` or ` base` is appended where a lower level was forced.

use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use piola_numerics::{Element, Kernel, Lanes, Level, Real, dispatch_at};

const POINTS: usize = 1024;

/// A function of a point, inlined into the loop over points.
trait Formula {
    fn of<T: Real>(x: T) -> T;
}

/// A loop over points.
struct Loop<'a, F, T> {
    formula: std::marker::PhantomData<F>,
    input: &'a [T],
    output: &'a mut [T],
}

impl<F: Formula, T: Real> Kernel for Loop<'_, F, T> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        for (x, y) in self.input.iter().zip(self.output) {
            *y = F::of(*x);
        }
    }
}

macro_rules! formulas {
    ($($type:ident $name:literal $x:ident => $value:expr;)*) => {
        $(
            struct $type;
            impl Formula for $type {
                #[inline(always)]
                fn of<T: Real>($x: T) -> T {
                    $value
                }
            }
        )*
        fn elementary(group: &mut BenchmarkGroup<'_, WallTime>) {
            $(compare::<$type>(group, $name);)*
        }
    };
}

formulas! {
    Sqrt "sqrt" x => x.sqrt();
    Cbrt "cbrt" x => x.cbrt();
    Exp "exp" x => x.exp();
    ExpM1 "exp_m1" x => x.exp_m1();
    Ln "ln" x => x.ln();
    Ln1p "ln_1p" x => x.ln_1p();
    SinCos "sin_cos" x => { let (s, c) = x.sin_cos(); s + c };
    Tan "tan" x => x.tan();
    Asin "asin" x => x.asin();
    Acos "acos" x => x.acos();
    Atan "atan" x => x.atan();
    Atan2 "atan2" x => x.atan2(T::lit(0.7));
    Sinh "sinh" x => x.sinh();
    Cosh "cosh" x => x.cosh();
    Tanh "tanh" x => x.tanh();
    Powf "powf" x => x.powf(T::lit(1.7));
    Powi "powi 6" x => x.powi(6);
}

/// A polynomial of degree 15 by Horner's rule: one long chain.
struct Polynomial;
impl Formula for Polynomial {
    #[inline(always)]
    fn of<T: Real>(x: T) -> T {
        let mut sum = T::one();
        let mut k = 15.0;
        while 0.5 < k {
            sum = sum * x * T::lit(1.0 / k) + T::one();
            k -= 1.0;
        }
        sum
    }
}

/// tr(F Fᵀ F) and det F of a deformation that depends on the point: products of 3×3 arrays.
struct Tensors;
impl Formula for Tensors {
    #[inline(always)]
    fn of<T: Real>(x: T) -> T {
        let one = T::one();
        let f = [[one + x, x * x, x], [T::lit(0.25) * x, one - x * x, x], [x, -x * x, one + T::lit(0.5) * x]];
        let b = product(f, transpose(f));
        let c = product(b, f);
        let det = f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1])
            + f[0][1] * (f[1][2] * f[2][0] - f[1][0] * f[2][2])
            + f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
        c[0][0] + c[1][1] + c[2][2] + one / det
    }
}

#[inline(always)]
fn transpose<T: Real>(a: [[T; 3]; 3]) -> [[T; 3]; 3] {
    [[a[0][0], a[1][0], a[2][0]], [a[0][1], a[1][1], a[2][1]], [a[0][2], a[1][2], a[2][2]]]
}

#[inline(always)]
fn row<T: Real>(a: [T; 3], b: [[T; 3]; 3]) -> [T; 3] {
    [
        a[0] * b[0][0] + a[1] * b[1][0] + a[2] * b[2][0],
        a[0] * b[0][1] + a[1] * b[1][1] + a[2] * b[2][1],
        a[0] * b[0][2] + a[1] * b[1][2] + a[2] * b[2][2],
    ]
}

#[inline(always)]
fn product<T: Real>(a: [[T; 3]; 3], b: [[T; 3]; 3]) -> [[T; 3]; 3] {
    [row(a[0], b), row(a[1], b), row(a[2], b)]
}

/// The arguments: spread over (0.05, 0.95), inside the domain of every function.
fn argument(i: usize) -> f64 {
    0.05 + 0.9 * (i as f64 * 0.618_033_988_749_895).fract()
}

fn scalars<F: Formula, T: Real>(group: &mut BenchmarkGroup<'_, WallTime>, name: &str) {
    let input: Vec<T> = (0..POINTS).map(|i| T::lit(argument(i))).collect();
    measure::<F, T>(group, name, Level::Base, &input);
}

fn lanes<F: Formula, T: Element, const N: usize>(group: &mut BenchmarkGroup<'_, WallTime>, name: &str, level: Level)
where
    Lanes<T, N>: Real,
{
    let mut input = vec![Lanes::<T, N>::lit(0.0); POINTS / N];
    for (i, lanes) in input.iter_mut().enumerate() {
        for k in 0..N {
            lanes.0[k] = Lanes::<T, 1>::lit(argument(i * N + k)).0[0];
        }
    }
    let name = match level {
        _ if level == Level::best() => format!("{name} x{N}"),
        Level::Avx2 => format!("{name} x{N} avx2"),
        _ => format!("{name} x{N} base"),
    };
    measure::<F, Lanes<T, N>>(group, &name, level, &input);
}

fn measure<F: Formula, T: Real>(group: &mut BenchmarkGroup<'_, WallTime>, name: &str, level: Level, input: &[T]) {
    let mut output = vec![T::zero(); input.len()];
    group.throughput(Throughput::Elements(POINTS as u64));
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            let (input, output) = (black_box(input), black_box(&mut output[..]));
            dispatch_at(level, Loop::<F, T> { formula: std::marker::PhantomData, input, output });
        });
    });
}

/// One elementary function: scalar loop, the two useful widths, and the width of AVX2 where that is not
/// the best level.
fn compare<F: Formula>(group: &mut BenchmarkGroup<'_, WallTime>, name: &str) {
    let best = Level::best();
    let (double, single) = (format!("{name} f64"), format!("{name} f32"));
    scalars::<F, f64>(group, &double);
    lanes::<F, f64, 4>(group, &double, best);
    lanes::<F, f64, 8>(group, &double, best);
    scalars::<F, f32>(group, &single);
    lanes::<F, f32, 8>(group, &single, best);
    lanes::<F, f32, 16>(group, &single, best);
    if Level::Avx2 < best {
        lanes::<F, f64, 4>(group, &double, Level::Avx2);
        lanes::<F, f32, 8>(group, &single, Level::Avx2);
    }
}

/// An arithmetic kernel at every width.
fn every_width<F: Formula>(group: &mut BenchmarkGroup<'_, WallTime>, name: &str) {
    let best = Level::best();
    let (double, single) = (format!("{name} f64"), format!("{name} f32"));
    scalars::<F, f64>(group, &double);
    scalars::<F, f32>(group, &single);
    for level in Level::available().filter(|level| Level::Base < *level || Level::Base == best) {
        lanes::<F, f64, 1>(group, &double, level);
        lanes::<F, f64, 2>(group, &double, level);
        lanes::<F, f64, 4>(group, &double, level);
        lanes::<F, f64, 8>(group, &double, level);
        lanes::<F, f32, 4>(group, &single, level);
        lanes::<F, f32, 8>(group, &single, level);
        lanes::<F, f32, 16>(group, &single, level);
    }
}

fn numerics(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("numerics");
    group.sample_size(20).nresamples(2000);
    group.warm_up_time(Duration::from_millis(50)).measurement_time(Duration::from_millis(200));
    every_width::<Polynomial>(&mut group, "polynomial");
    every_width::<Tensors>(&mut group, "tensors");
    elementary(&mut group);
    group.finish();
}

criterion_group!(benches, numerics);
criterion_main!(benches);
