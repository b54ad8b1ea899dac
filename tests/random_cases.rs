//! Cases drawn at random, far beyond what anybody would compute: every increment that comes back is certified, and what has no
//! answer is refused for a reason that is true. `cargo xtask extremes` runs five thousand of them;
//! `FRET_CASES=2000 cargo test --release -p fret-validation random_cases -- --nocapture` as many small ones as one likes.

use fret_validation::extreme_cases::{Outcome, run};
use rayon::prelude::*;

/// Runs the cases of these seeds; none may be wrong, and at the most so many may not be solved.
fn certified_or_refused(seeds: std::ops::Range<u64>, cells: [usize; 2], most_unsolved: u64) {
    let count = seeds.end - seeds.start;
    let found: Vec<_> = seeds.into_par_iter().map(|seed| run(seed, cells)).collect();
    let mut wrong = 0;
    let (mut certified, mut refused, mut unsolved) = (0, 0, 0);
    for extreme in &found {
        match &extreme.outcome {
            Outcome::Certified => certified += 1,
            Outcome::Refused(_) => refused += 1,
            Outcome::Unsolved(why) => {
                unsolved += 1;
                println!("seed {}: {why}", extreme.seed);
            }
            Outcome::Wrong(why) => {
                wrong += 1;
                println!("seed {}: WRONG: {why}\n{}", extreme.seed, extreme.text);
            }
        }
    }
    let increments: usize = found.iter().map(|extreme| extreme.increments).sum();
    println!(
        "{count} cases, {increments} increments: {certified} certified, {refused} refused, {unsolved} not solved, {wrong} wrong"
    );
    assert_eq!(wrong, 0);
    assert!(unsolved <= most_unsolved, "{unsolved} of {count} not solved");
    // Most cases have an answer: the draw is not a way to refuse everything.
    assert!(10 * certified >= 9 * count, "{certified} of {count} certified");
}

#[test]
fn small_random_cases_are_certified_or_refused_for_a_reason() {
    let count = std::env::var("FRET_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(200);
    // Today 1 of 200.
    certified_or_refused(0..count, [8, 20], count.div_ceil(200));
}

#[test]
fn the_first_of_the_extreme_cases_are_certified_or_refused_for_a_reason() {
    // Today 2.
    certified_or_refused(0..100, [16, 40], 2);
}
