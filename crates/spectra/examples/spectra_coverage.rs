//! How often 95 % intervals and bands of spectra hold the truth, in noisy tables of known spectra.
//!
//! ```sh
//! cargo run --release -p piola-spectra --example spectra_coverage -- 200
//! ```

#![expect(clippy::print_stdout, reason = "the tables are what the program is for")]

use piola_spectra::{
    RelaxationMode, RelaxationSpectrum, RetardationSpectrum, SpectrumData, SpectrumOptions, fit_continuous,
    fit_spectrum,
};

/// Normal numbers of a seed: Box and Muller's transform of a linear congruence.
struct Normal(u64);

impl Normal {
    fn new(seed: u64) -> Self {
        let mut normal = Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x2545_f491_4f6c_dd1d);
        for _ in 0..16 {
            normal.uniform();
        }
        normal
    }

    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    fn next(&mut self) -> f64 {
        let (radius, angle) = ((-2.0 * self.uniform().ln()).sqrt(), core::f64::consts::TAU * self.uniform());
        radius * angle.cos()
    }
}

/// What is measured.
#[derive(Clone, Copy)]
enum Kind {
    Oscillation,
    Relaxation,
    Creep,
}

/// A table: abscissas and one or two columns.
struct Table {
    kind: Kind,
    at: Vec<f64>,
    columns: [Vec<f64>; 2],
}

impl Table {
    /// Exact responses of a spectrum, ten rows for each decade from 10^`low` to 10^`high`.
    fn exact(kind: Kind, of: &RelaxationSpectrum, low: f64, high: f64) -> Self {
        let rows = (0..1000).map(|k| low + 0.1 * f64::from(k)).take_while(|x| *x < high + 0.05);
        let at: Vec<f64> = rows.map(|x| 10.0_f64.powf(x)).collect();
        let creep = RetardationSpectrum::of(of);
        let of_row = |x: &f64| match kind {
            Kind::Oscillation => [of.storage_modulus(*x), of.loss_modulus(*x)],
            Kind::Relaxation => [of.relaxation_modulus(*x); 2],
            Kind::Creep => [creep.compliance(*x); 2],
        };
        let columns = [0, 1].map(|k| at.iter().map(|x| of_row(x)[k]).collect());
        Self { kind, at, columns }
    }

    fn noisy(&self, noise: f64, seed: u64) -> Self {
        let mut normal = Normal::new(seed);
        let mut disturbed = |column: &Vec<f64>| column.iter().map(|y| y * (1.0 + noise * normal.next())).collect();
        let columns = [disturbed(&self.columns[0]), disturbed(&self.columns[1])];
        Self { kind: self.kind, at: self.at.clone(), columns }
    }

    fn data(&self) -> SpectrumData<'_> {
        let [first, second] = &self.columns;
        match self.kind {
            Kind::Oscillation => {
                SpectrumData::Oscillation { angular_frequencies: &self.at, storage_moduli: first, loss_moduli: second }
            }
            Kind::Relaxation => SpectrumData::Relaxation { times: &self.at, moduli: first },
            Kind::Creep => SpectrumData::Creep { times: &self.at, compliances: first },
        }
    }
}

fn of_modes(modes: &[[f64; 2]], equilibrium: f64) -> RelaxationSpectrum {
    let mode = |&[modulus, relaxation_time]: &[f64; 2]| RelaxationMode { modulus, relaxation_time };
    RelaxationSpectrum::new(modes.iter().map(mode).collect(), equilibrium).expect("positive")
}

/// A smooth spectrum H as modes that are a hundredth of a decade apart: its responses are those of the integral to 15 digits.
fn smooth(density: &dyn Fn(f64) -> f64) -> RelaxationSpectrum {
    let step = 0.02 * core::f64::consts::LN_10;
    let modes = (-600..=600).map(|k| {
        let time = (step * f64::from(k)).exp();
        [(density(time) * step).max(f64::MIN_POSITIVE), time]
    });
    of_modes(&modes.collect::<Vec<_>>(), 0.0)
}

fn share(inside: usize, of: usize) -> f64 {
    100.0 * inside as f64 / of as f64
}

/// Intervals of all parameters of a discrete spectrum.
fn discrete(name: &str, kind: Kind, truth: &RelaxationSpectrum, window: [f64; 2], noise: f64, tables: u32) {
    let creep = RetardationSpectrum::of(truth);
    let exact = Table::exact(kind, truth, window[0], window[1]);
    let count = if matches!(kind, Kind::Creep) { creep.modes().len() } else { truth.modes().len() };
    let equilibrium = !truth.is_liquid();
    let (mut inside, mut counted, mut same) = (Vec::new(), Vec::new(), 0_usize);
    for seed in 1..=tables {
        let table = exact.noisy(noise, u64::from(seed));
        let options = SpectrumOptions { equilibrium, ..SpectrumOptions::default() };
        let chosen = fit_spectrum(table.data(), options).expect("a spectrum");
        let modes = chosen.retardation.as_ref().map_or(chosen.spectrum.modes().len(), |r| r.spectrum.modes().len());
        same += usize::from(modes == count);
        let fit = fit_spectrum(table.data(), SpectrumOptions { modes: Some(count), ..options }).expect("a spectrum");
        let mut told: Vec<(f64, Option<[f64; 2]>)> = Vec::new();
        if let Some(found) = &fit.retardation {
            let modes =
                creep.modes().iter().zip(found.compliance_intervals.iter().zip(&found.retardation_time_intervals));
            for (mode, (compliance, time)) in modes {
                told.extend([(mode.compliance, *compliance), (mode.retardation_time, *time)]);
            }
            told.push((creep.glassy_compliance(), found.glassy_interval));
            if !equilibrium {
                told.push((creep.fluidity(), found.fluidity_interval));
            }
        } else {
            let modes = truth.modes().iter().zip(fit.modulus_intervals.iter().zip(&fit.relaxation_time_intervals));
            for (mode, (modulus, time)) in modes {
                told.extend([(mode.modulus, *modulus), (mode.relaxation_time, *time)]);
            }
            if equilibrium {
                told.push((truth.equilibrium_modulus(), fit.equilibrium_interval));
            }
        }
        inside.resize(told.len(), 0_usize);
        counted.resize(told.len(), 0_usize);
        for (k, (value, interval)) in told.into_iter().enumerate() {
            if let Some([low, high]) = interval {
                counted[k] += 1;
                inside[k] += usize::from(low <= value && value <= high);
            }
        }
    }
    let shares: Vec<f64> = inside.iter().zip(&counted).map(|(i, c)| share(*i, *c)).collect();
    let (least, most) = shares.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), s| (a.min(*s), b.max(*s)));
    let all = share(inside.iter().sum(), counted.iter().sum());
    let determined = share(counted.iter().sum(), counted.len() * tables as usize);
    let same = share(same, tables as usize);
    println!(
        "{name:<34} {:>4.1} %  {all:>5.1} %  {least:>5.1}–{most:<5.1} %  {determined:>6.1} %  {same:>6.1} %",
        100.0 * noise
    );
}

/// The band of a continuous spectrum, at the nodes within the window of the data.
fn continuous(name: &str, kind: Kind, density: &dyn Fn(f64) -> f64, window: [f64; 2], noise: f64, tables: u32) {
    let exact = Table::exact(kind, &smooth(density), window[0], window[1]);
    let (mut inside, mut counted, mut worst) = (0_usize, 0_usize, Vec::new());
    let (mut errors, mut halves): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (Vec::new(), Vec::new());
    let mut hits: Vec<usize> = Vec::new();
    let mut weights = Vec::new();
    for seed in 1..=tables {
        let table = exact.noisy(noise, u64::from(seed));
        let found = fit_continuous(table.data(), false).expect("a spectrum");
        weights.push(found.regularisation.log10());
        let nodes = found.times.iter().zip(&found.spectrum).zip(&found.band);
        // Within the data.
        let ends = match kind {
            Kind::Oscillation => [-window[1], -window[0]],
            _ => window,
        };
        let (low, high) = (10.0_f64.powf(ends[0]), 10.0_f64.powf(ends[1]));
        let kept: Vec<_> = nodes.filter(|((t, _), _)| low <= **t && **t <= high).collect();
        errors.resize(kept.len(), Vec::new());
        halves.resize(kept.len(), Vec::new());
        hits.resize(kept.len(), 0);
        for (k, ((t, height), [a, b])) in kept.into_iter().enumerate() {
            let truth = density(*t);
            counted += 1;
            let is_inside = *a <= truth && truth <= *b;
            inside += usize::from(is_inside);
            hits[k] += usize::from(is_inside);
            errors[k].push((height / truth).ln().abs());
            // Where nothing is known below, the upper half.
            halves[k].push(if 0.0 < *a { 0.5 * (b / a).ln() } else { (b / height).ln() });
        }
    }
    for (errors, halves) in errors.iter_mut().zip(&mut halves) {
        errors.sort_by(f64::total_cmp);
        halves.sort_by(f64::total_cmp);
        worst.push(halves[halves.len() / 2] / errors[errors.len() * 95 / 100]);
    }
    let most = worst.iter().fold(0.0_f64, |most, ratio| most.max(*ratio));
    let least = hits.iter().map(|h| share(*h, tables as usize)).fold(f64::INFINITY, f64::min);
    weights.sort_by(f64::total_cmp);
    println!(
        "{name:<34} {:>4.1} %  {:>5.1} %  {least:>5.1} %  {most:>5.2}   10^{:.1}",
        100.0 * noise,
        share(inside, counted),
        weights[weights.len() / 2]
    );
}

fn main() {
    let tables = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(200);
    let three = of_modes(&[[1e5, 0.01], [3e4, 0.3], [1e3, 20.0]], 0.0);
    let gel = of_modes(&[[1e5, 0.05], [1e4, 8.0]], 2e3);
    println!(
        "{tables} tables each\nmodes                              noise    all   of a parameter  determined  modes chosen"
    );
    for noise in [0.01, 0.03] {
        discrete("G′, G″ of three modes", Kind::Oscillation, &three, [-3.0, 3.0], noise, tables);
        discrete("G(t) of two modes and Gₑ", Kind::Relaxation, &gel, [-3.0, 3.0], noise, tables);
        discrete("J(t) of a liquid", Kind::Creep, &three, [-3.5, 2.5], noise, tables);
        discrete("J(t) of a solid", Kind::Creep, &gel, [-3.0, 3.0], noise, tables);
    }
    println!("\nH                                  noise    all    node  half/95th  λ");
    let pipkin = |t: f64| (-1.0 / t).exp() / t;
    let lognormal = |t: f64| (-0.5 * (t.ln() / 1.5).powi(2)).exp();
    let two = |t: f64| {
        let peak = |at: f64, width: f64| (-0.5 * ((t / at).ln() / width).powi(2)).exp();
        peak(0.01, 1.2) + 0.05 * peak(10.0, 1.2)
    };
    let wedge = |t: f64| t.powf(-0.5) * (-t / 30.0).exp();
    for noise in [0.01, 0.03] {
        continuous("G(t) = 1/(1 + t)", Kind::Relaxation, &pipkin, [-1.0, 2.0], noise, tables);
        continuous("G(t), log-normal", Kind::Relaxation, &lognormal, [-2.0, 2.0], noise, tables);
        continuous("G′, G″, log-normal", Kind::Oscillation, &lognormal, [-2.0, 2.0], noise, tables);
        continuous("G′, G″, two peaks", Kind::Oscillation, &two, [-3.0, 3.5], noise, tables);
        continuous("G′, G″, power law with an end", Kind::Oscillation, &wedge, [-2.0, 3.0], noise, tables);
        continuous("G(t), power law with an end", Kind::Relaxation, &wedge, [-3.0, 2.0], noise, tables);
    }
}
