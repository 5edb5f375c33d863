use super::*;

#[test]
fn summaries_agree_with_sorting() {
    let values: Vec<f32> =
        (0..100_001u32).map(|i| (i.wrapping_mul(2_654_435_761) % 1_000_003) as f32).collect();
    let mut sorted = values.clone();
    sorted.sort_by(f32::total_cmp);
    let summary = Summary::of(&values).unwrap();
    assert_eq!((summary.min, summary.max), (sorted[0], sorted[100_000]));
    assert_eq!(summary.percentile_1, sorted[1000]);
    let mean = values.iter().map(|&v| f64::from(v)).sum::<f64>() / values.len() as f64;
    assert!((summary.mean - mean).abs() < 1e-6 * mean);
    assert_eq!(Summary::of(&[]), None);
    assert_eq!(Summary::of(&[1.0, 2.0]).unwrap().percentile_1, 1.01);
}

#[test]
fn histograms_count_every_value_once() {
    let values: Vec<f32> = (0..50_000).map(|i| i as f32 / 1000.0).collect();
    let histogram = Histogram::of(&values, 10.0..20.0, 5);
    assert_eq!(histogram.counts, [12_000, 2000, 2000, 2000, 32_000]);
    assert_eq!(Histogram::of(&[f32::NAN, -1e30, 1e30], 0.0..1.0, 2).counts, [2, 1]);
}
