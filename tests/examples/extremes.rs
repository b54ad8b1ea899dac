//! `cargo xtask extremes`: five thousand cases drawn at random, run and certified, and the page `docs/trust/random-cases.md` of what
//! was found. `cargo run --release -p fret-validation --example extremes -- [--page FILE] [FIRST COUNT [LEAST MOST]]` runs others,
//! on LEAST to MOST cells per side; with a count of one it shows the case.

#![expect(clippy::print_stdout, reason = "its output is the table")]

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write;
use std::process::ExitCode;

use fret_validation::extreme_cases::{Extreme, Family, Outcome, run};
use rayon::prelude::*;

const COUNT: u64 = 5000;
const CELLS: [usize; 2] = [16, 40];

/// LEAST and MOST stand for the cells per side.
const HEAD: &str = "# Random cases

Written by `cargo xtask extremes`. Every case is solved and then checked by an independent program (the certifier): from the kept
fields of consecutive increments it evaluates all laws again in double precision by direct summation. A test runs the first hundred
cases. The cases of [Extreme cases](extremes.md) vary one parameter at a time; these vary all of them:

- coatings 1e-6 to 1e6 times as stiff as the layer below and 1e-3 to 1e3 contact sizes thick, none to two per body; rigid
  bases; Poisson's ratios from -0.9 to 0.5; lengths and moduli over 24 decades each;
- friction coefficient up to 2, or none; forces up to 0.9999 of the friction limit, or displacements; reversal, cycles, unloading,
  lift-off and renewed contact; friction that changes between stages;
- cells from 1:8 to 8:1, LEAST to MOST per side; tolerances of 1e-6 and 1e-8;
- some have torsion, wear, periodicity, or a coefficient of friction per patch.

Line contacts, stretched and tilted, are drawn by a test of their own (`tests/line_extremes.rs`): every case is certified, or refused:
contact at the edge of the grid.
";

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let mut words: Vec<String> = std::env::args().skip(1).collect();
    let page = words.iter().position(|word| word == "--page").map(|at| words.drain(at..at + 2).next_back());
    let (first, count, cells) = match &words[..] {
        [] => (0, COUNT, CELLS),
        [first, count] => (first.parse()?, count.parse()?, CELLS),
        [first, count, least, most] => (first.parse()?, count.parse()?, [least.parse()?, most.parse()?]),
        _ => return Err("usage: extremes [--page FILE] [FIRST COUNT [LEAST MOST]]".into()),
    };
    let found: Vec<Extreme> = (first..first + count).into_par_iter().map(|seed| run(seed, cells)).collect();
    if let [extreme] = &found[..] {
        println!("{}\n{:?}", extreme.text, extreme.outcome);
    }
    let [least, most] = cells.map(|cells| cells.to_string());
    let head = HEAD.replace("LEAST", &least).replace("MOST", &most);
    let text = format!("{head}\n{}", tables(&found)?);
    if let Some(Some(page)) = page {
        std::fs::write(page, &text)?;
    }
    print!("{text}");
    let wrong = found.iter().any(|extreme| matches!(extreme.outcome, Outcome::Wrong(_)));
    Ok(if wrong { ExitCode::from(2) } else { ExitCode::SUCCESS })
}

fn tables(found: &[Extreme]) -> Result<String, std::fmt::Error> {
    let mut text = String::from(
        "| kind | cases | certified | refused | not converged | wrong | increments | with sub-steps |\n|---|---|---|---|---|---|---|---|\n",
    );
    for family in Family::ALL {
        let of_family: Vec<_> = found.iter().filter(|extreme| extreme.family == family).collect();
        row(&mut text, family.name(), &of_family)?;
    }
    row(&mut text, "all", &found.iter().collect::<Vec<_>>())?;
    text += "\nIncrements that were solved with sub-steps are certified except for the slip law, which depends on intermediate tractions that \
             are not kept.\n\n";
    let mut reasons = BTreeMap::new();
    for extreme in found {
        if let Outcome::Refused(refusal) = extreme.outcome {
            *reasons.entry(refusal).or_insert(0) += 1;
        }
    }
    text += "| refused for | cases |\n|---|---|\n";
    for (refusal, count) in reasons {
        writeln!(text, "| {} | {count} |", refusal.name())?;
    }
    text += "\nA refusal counts only if its reason is true: the film is that thin, the contact passes the edge of a grid three times as \
             wide, the friction limit is lower.\n\n| law | largest fraction of its bound |\n|---|---|\n";
    let laws = found.first().map_or(&[][..], |extreme| &extreme.laws);
    for (index, (name, _)) in laws.iter().enumerate() {
        let solved = found.iter().filter(|extreme| !matches!(extreme.outcome, Outcome::Wrong(_)));
        let most = solved.map(|extreme| extreme.laws[index].1).fold(0.0, f64::max);
        writeln!(text, "| {} | {most:.0e} |", name.replace('_', " "))?;
    }
    for (head, list) in [("Not converged", outcomes(found, true)), ("Wrong", outcomes(found, false))] {
        if !list.is_empty() {
            writeln!(text, "\n## {head}\n")?;
        }
        for (extreme, why) in list {
            writeln!(text, "- seed {}, {}: {why}", extreme.seed, extreme.family.name())?;
        }
    }
    Ok(text)
}

fn row(text: &mut String, name: &str, of: &[&Extreme]) -> std::fmt::Result {
    let count = |wanted: fn(&Outcome) -> bool| of.iter().filter(|extreme| wanted(&extreme.outcome)).count();
    let sum = |value: fn(&Extreme) -> usize| of.iter().map(|extreme| value(extreme)).sum::<usize>();
    writeln!(
        text,
        "| {name} | {} | {} | {} | {} | {} | {} | {} |",
        of.len(),
        count(|outcome| *outcome == Outcome::Certified),
        count(|outcome| matches!(outcome, Outcome::Refused(_))),
        count(|outcome| matches!(outcome, Outcome::Unsolved(_))),
        count(|outcome| matches!(outcome, Outcome::Wrong(_))),
        sum(|extreme| extreme.increments),
        sum(|extreme| extreme.in_parts),
    )
}

/// The cases that were not solved, or those that are wrong, with what was said.
fn outcomes(found: &[Extreme], unsolved: bool) -> Vec<(&Extreme, String)> {
    let said = |extreme: &'_ Extreme| match &extreme.outcome {
        Outcome::Unsolved(why) if unsolved => Some(why.split(';').next().unwrap_or_default().to_owned()),
        Outcome::Wrong(why) if !unsolved => Some(why.clone()),
        _ => None,
    };
    found.iter().filter_map(|extreme| said(extreme).map(|why| (extreme, why))).collect()
}
