//! Cases cut up and filled with nonsense: read or refused with a place, never a panic; and the public constructors under any
//! number. Seeded, so that every run tries the same. `fuzz/` holds the same question for a fuzzer.

use std::panic::{AssertUnwindSafe, catch_unwind};

use fret_core::case::{Case, CaseError};
use fret_core::kernel::PairResponse;
use fret_core::model::{
    Base, Body, Coating, ContactPair, CoulombFriction, ElasticMaterial, HalfSpace, SurfaceGrid,
};
use fret_core::plan::Plan;
use fret_validation::random::Random;

fn below(random: &mut Random, count: usize) -> usize {
    random.whole(0, count - 1)
}

/// Any number: the odd ones, any bits, or something usual.
fn number(random: &mut Random) -> f64 {
    const ODD: [f64; 12] = [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        0.0,
        -0.0,
        f64::MIN_POSITIVE,
        5e-324,
        f64::MAX,
        f64::MIN,
        0.5,
        -1.0,
        1.0,
    ];
    match below(random, 3) {
        0 => ODD[below(random, ODD.len())],
        1 => f64::from_bits(random.bits()),
        _ => random.between(-1.0, 1.0),
    }
}

/// What is put where a word or a number was.
const NONSENSE: [&str; 30] = [
    "nan",
    "inf",
    "-inf",
    "0",
    "-0.0",
    "-1",
    "1e999",
    "1e-320",
    "1e308",
    "9223372036854775807",
    "-9223372036854775808",
    "99999999999999999999",
    "0.5",
    "0.50000001",
    "-0.999999",
    "true",
    "\"\"",
    "\"auto\"",
    "\"rigid\"",
    "[]",
    "[[]]",
    "{}",
    "[1, 2, 3]",
    "[nan, 1]",
    "1979-05-27",
    "'x'",
    "[[load]]",
    "[profile.cone]\nslope = 1",
    "é",
    "\u{0}",
];

fn seeds() -> Vec<String> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let mut paths: Vec<_> = [folder.clone(), folder.join("surfaces"), folder.join("friction")]
        .iter()
        .flat_map(|folder| std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()))
        .filter(|path| path.extension().is_some_and(|end| end == "toml"))
        .collect();
    paths.sort();
    paths.iter().map(|path| std::fs::read_to_string(path).unwrap()).collect()
}

/// A case with up to four cuts, swaps and fillings.
fn mutilated(seed: &str, random: &mut Random) -> String {
    let mut words: Vec<&str> = seed.split_inclusive([' ', '\n', '=', ',', '[', ']', '{', '}']).collect();
    for _ in 0..=below(random, 4) {
        let (place, other) = (below(random, words.len()), below(random, words.len()));
        match below(random, 6) {
            0 => drop(words.remove(place)),
            1 => words.swap(place, other),
            2 => words.insert(place, words[other]),
            3 => words.truncate(place.max(1)),
            _ => words[place] = NONSENSE[below(random, NONSENSE.len())],
        }
        if words.is_empty() {
            break;
        }
    }
    words.concat()
}

fn is_well_told(error: &CaseError, text: &str) {
    assert!(!error.mistakes().is_empty());
    for mistake in error.mistakes() {
        assert!(!mistake.message.is_empty());
        if let Some((line, column)) = error.place(mistake) {
            assert!((1..=text.lines().count() + 1).contains(&line), "line {line}");
            let longest = text.lines().map(|line| line.chars().count()).max().unwrap_or(0);
            assert!((1..=longest + 2).contains(&column), "column {column}");
        }
    }
    assert!(!error.render(false).is_empty());
}

#[test]
fn mutilated_cases_are_read_or_refused_with_a_place() {
    let seeds = seeds();
    assert!(seeds.len() > 10);
    let mut random = Random::seeded(0x5eed_0001);
    let (mut read, mut refused) = (0, 0);
    for number in 0..6000 {
        let text = mutilated(&seeds[number % seeds.len()], &mut random);
        let judged = catch_unwind(AssertUnwindSafe(|| match Case::from_toml(&text, "case.toml") {
            // A plan may look for the contact on a coarse grid: on small grids, now and then.
            Ok(case) if case.cells[0] * case.cells[1] <= 1 << 14 && number % 8 == 0 => {
                if let Err(error) = Plan::new(case) {
                    is_well_told(&error, &text);
                }
                true
            }
            Ok(_) => true,
            Err(error) => {
                is_well_told(&error, &text);
                false
            }
        }));
        assert!(judged.is_ok(), "case {number} panics:\n{text}");
        if judged.is_ok_and(|is_read| is_read) {
            read += 1;
        } else {
            refused += 1;
        }
    }
    // Neither all sense nor all nonsense, else little was tried.
    assert!(read > 300 && refused > 1500, "{read} read, {refused} refused");
}

#[test]
fn what_public_constructors_take_is_sound_whatever_the_numbers() {
    let mut random = Random::seeded(0x5eed_0002);
    let mut pairs = 0;
    for _ in 0..200_000 {
        let spacing = [number(&mut random), number(&mut random)];
        let cells = [below(&mut random, 5), below(&mut random, 5)];
        if let Ok(grid) = SurfaceGrid::new(cells, spacing) {
            assert_eq!(grid.len(), cells[0] * cells[1]);
        }
        if let Ok(friction) = CoulombFriction::uniform(number(&mut random)) {
            assert!(friction.largest() >= 0.0 && friction.largest().is_finite());
        }
        let Ok(material) = ElasticMaterial::new(number(&mut random), number(&mut random)) else { continue };
        assert!(material.young() > 0.0 && material.shear_modulus() > 0.0);
        let coatings = match Coating::new(material, number(&mut random)) {
            Ok(coating) => vec![coating],
            Err(_) => Vec::new(),
        };
        let base = if below(&mut random, 2) == 0 { Base::Rigid } else { Base::Elastic(material) };
        let Ok(half_space) = HalfSpace::new(coatings, base) else { continue };
        let k = number(&mut random).abs();
        // Materials and thicknesses are taken within these bounds; a wavenumber is for the caller to choose.
        if (1e-100..=1e100).contains(&k) {
            let Ok(pair) = ContactPair::new(Body::Rigid, Body::Elastic(half_space)) else { continue };
            let found = PairResponse::new(&pair).times_k(k);
            for value in [found.zz, found.rr, found.rz, found.tt] {
                assert!(!value.is_nan(), "{pair:?} at {k:e}: {found:?}");
            }
            pairs += 1;
        }
    }
    assert!(pairs > 1000, "{pairs}");
}
