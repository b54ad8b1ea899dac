//! Cases drawn at random, far beyond what anybody would compute: contrasts of 1e-6 to 1e6, coatings of 1e-3 to 1e3 contact
//! sizes on one body or both, Poisson's ratios of -0.9 to 0.5, friction up to 2, cells up to 8:1, lengths and moduli over 24
//! decades, reversal and lift-off; some of them turn, wear, repeat, or rub differently from place to place.

mod body;
mod loads;
mod outcome;

use std::panic::{AssertUnwindSafe, catch_unwind};

use fret_core::case::CaseError;

pub use outcome::{Outcome, Refusal};

use crate::certifier::{Certificate, Ended, run_certified};
use crate::random::Random;
use body::Body;
use loads::loaded;
use outcome::judged;

/// What a case has besides pressing and pulling.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// Nothing; with friction or without.
    Plain,
    /// It turns about z, by a moment or a rotation.
    Torsion,
    /// Coefficients of friction differ from place to place.
    Map,
    /// It wears.
    Wear,
    /// It is periodic.
    Periodic,
}

impl Family {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Plain, Self::Torsion, Self::Map, Self::Wear, Self::Periodic];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plain => "indentation and tangential load",
            Self::Torsion => "torsion",
            Self::Map => "friction map",
            Self::Wear => "wear",
            Self::Periodic => "periodic",
        }
    }
}

/// A case that was run.
#[derive(Debug)]
pub struct Extreme {
    /// Its seed.
    pub seed: u64,
    /// What it has.
    pub family: Family,
    /// Its text.
    pub text: String,
    /// Certified increments.
    pub increments: usize,
    /// Certified increments that were solved in parts: all but the law of slip.
    pub in_parts: usize,
    /// Every law by name, and the largest fraction of its bound that an increment took.
    pub laws: Vec<(&'static str, f64)>,
    /// How it ended.
    pub outcome: Outcome,
}

/// Draws the case of a seed, with `cells` per side between two numbers; runs and certifies it.
pub fn run(seed: u64, cells: [usize; 2]) -> Extreme {
    let mut random = Random::seeded(seed);
    let body = Body::drawn(&mut random, cells);
    let ended = catch_unwind(AssertUnwindSafe(|| certified(&body, seed, random)));
    ended.unwrap_or_else(|_| Extreme {
        seed,
        family: body.family,
        text: body.head(false, "coefficient = 0.0"),
        increments: 0,
        in_parts: 0,
        laws: fractions(&[], body.tolerance),
        outcome: Outcome::Wrong("the program panicked".to_owned()),
    })
}

/// Every law, and the largest fraction of its bound.
fn fractions(certificates: &[Certificate], tolerance: f64) -> Vec<(&'static str, f64)> {
    let mut largest = Certificate::default().laws(tolerance).map(|(name, _, _)| (name, 0.0_f64));
    for certificate in certificates {
        for ((_, most), (_, value, bound)) in largest.iter_mut().zip(certificate.laws(tolerance)) {
            *most = most.max(if value == 0.0 { 0.0 } else { value / bound });
        }
    }
    largest.to_vec()
}

/// Presses, loads, and judges what comes back.
fn certified(body: &Body, seed: u64, mut random: Random) -> Extreme {
    // Without friction, pressed to the approach: what force that needs.
    let pressing = format!(
        "{}[[load]]\napproach = {:e}\nincrements = 1\n",
        body.head(false, "coefficient = 0.0"),
        body.approach
    );
    let extreme = |text: String, ended: &Result<Ended, CaseError>, outcome: Outcome| {
        let certificates = ended.as_ref().map_or(&[][..], |ended| &ended.certificates);
        Extreme {
            seed,
            family: body.family,
            text,
            increments: certificates.len(),
            in_parts: certificates.iter().filter(|certificate| !certificate.whole).count(),
            laws: fractions(certificates, body.tolerance),
            outcome,
        }
    };
    let pressed = run_certified(&pressing, &[]);
    let first = match (judged(body, &pressing, &[], &pressed), &pressed) {
        (Outcome::Certified, Ok(ended)) => ended.run[0].record.clone(),
        (other, _) => return extreme(pressing, &pressed, other),
    };
    let (text, maps) = loaded(body, &mut random, first.normal_force, first.max_pressure);
    let ended = run_certified(&text, &maps);
    let outcome = judged(body, &text, &maps, &ended);
    extreme(text, &ended, outcome)
}
