//! Cases drawn at random, far beyond what anybody would compute: every increment that comes back is certified, and what has no
//! answer is refused for a reason that is true. `cargo xtask extremes` runs five thousand of them;
//! `FRET_CASES=2000 cargo test --release -p fret-validation random_cases -- --include-ignored --nocapture` as many small ones as one likes.

use std::ops::Range;

use fret_validation::extreme_cases::{Extreme, Outcome, run};
use rayon::prelude::*;

/// Runs the cases of these seeds; none may be wrong, and at the most so many may not be solved. What was found, in words.
fn certified_or_refused(seeds: Range<u64>, cells: [usize; 2], most_unsolved: u64) -> String {
    let count = seeds.end - seeds.start;
    let found: Vec<_> = seeds.into_par_iter().map(|seed| run(seed, cells)).collect();
    let (mut certified, mut refused) = (0, 0);
    let (mut unsolved, mut wrong) = (Vec::new(), Vec::new());
    for Extreme { seed, outcome, text, .. } in &found {
        match outcome {
            Outcome::Certified => certified += 1,
            Outcome::Refused(_) => refused += 1,
            Outcome::Unsolved(why) => unsolved.push(format!("seed {seed}: {why}\n{text}")),
            Outcome::Wrong(why) => wrong.push(format!("seed {seed}: {why}\n{text}")),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(unsolved.len() as u64 <= most_unsolved, "{}", unsolved.join("\n"));
    // Most cases have an answer: the draw is not a way to refuse everything.
    assert!(10 * certified >= 9 * count, "{certified} of {count} certified");
    let increments: usize = found.iter().map(|extreme| extreme.increments).sum();
    format!(
        "{count} cases, {increments} increments: {certified} certified, {refused} refused, {} not solved\n{}",
        unsolved.len(),
        unsolved.join("\n")
    )
}

#[test]
#[ignore = "long: 6 s"]
fn small_random_cases_are_certified_or_refused_for_a_reason() {
    let count = std::env::var("FRET_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(200);
    // Today none of 1000.
    println!("{}", certified_or_refused(0..count, [8, 20], count.div_ceil(1000)));
}

#[test]
fn the_first_of_the_extreme_cases_are_certified_or_refused_for_a_reason() {
    println!("{}", certified_or_refused(0..100, [16, 40], 0));
}

/// Stiff frictionless films whose contact wandered; forces and moments a little above what a contact on patches, or one that is turned, carries
/// when it slides.
#[test]
fn cases_that_were_not_solved_once_are_certified_or_refused() {
    let coarse = [(3875, false), (3913, false)];
    let fine = [
        (10147, true),
        (10201, false),
        (10231, true),
        (10773, true),
        (10808, true),
        (11315, true),
        (11957, false),
    ];
    for (cases, cells) in [(&coarse[..], [16, 40]), (&fine, [48, 96])] {
        cases.par_iter().for_each(|&(seed, has_answer)| {
            let Extreme { outcome, text, .. } = run(seed, cells);
            let is_right = match outcome {
                Outcome::Certified => has_answer,
                Outcome::Refused(reason) => !has_answer && reason.name().contains("than the friction limit"),
                _ => false,
            };
            assert!(is_right, "{seed}: {outcome:?}\n{text}");
        });
    }
}

/// A force of nothing that becomes a shift of nothing; friction that falls while loads stand; a force on cells without friction.
#[test]
fn cases_that_were_wrong_once_are_certified_or_refused() {
    for (seeds, cells) in [([0, 360, 1933], [16, 40]), ([11190, 11617, 11866], [48, 96])] {
        for seed in seeds {
            let Extreme { outcome, text, .. } = run(seed, cells);
            assert!(
                matches!(outcome, Outcome::Certified | Outcome::Refused(_)),
                "{seed}: {outcome:?}\n{text}"
            );
        }
    }
}
