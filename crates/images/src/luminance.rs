//! Colours become their luminance.

/// Weights of red, green and blue (ITU-R BT.709), applied to the stored numbers.
const WEIGHTS: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// One number for each group of `channels`, and whether they were colours. A last channel of an even number is opacity, which is left out.
pub(crate) fn grey(stored: &[f64], channels: usize) -> (Vec<f64>, bool) {
    let groups = stored.chunks_exact(channels.max(1));
    if channels < 3 {
        return (groups.map(|group| group[0]).collect(), false);
    }
    // Rounded, because the type of the samples stays that of the file.
    let luminance = |group: &[f64]| group.iter().zip(WEIGHTS).map(|(part, weight)| part * weight).sum::<f64>().round();
    (groups.map(luminance).collect(), true)
}
