//! Influence coefficients of line contacts against the high-precision table of `golden/line_coefficients.py`.

use fret_core::kernel::{Components, line_coefficients};
use fret_core::model::{Base, Body, Coating, ContactPair, ElasticMaterial, HalfSpace};
use serde::Deserialize;

#[derive(Deserialize)]
struct Stack {
    layers: Vec<(f64, f64, f64)>,
    substrate: Option<(f64, f64)>,
}

/// Offset; zz, xx, yy, zx; error over the largest own coefficient.
type Row = (usize, f64, f64, f64, f64, f64);

#[derive(Deserialize)]
struct Entry {
    family: String,
    lower: Stack,
    upper: Option<Stack>,
    datum: f64,
    rows: Vec<Row>,
}

#[derive(Deserialize)]
struct Table {
    bodies: Vec<Entry>,
}

fn half_space(stack: &Stack) -> Body {
    let material = |(young, poisson): (f64, f64)| ElasticMaterial::new(young, poisson).unwrap();
    let coatings =
        stack.layers.iter().map(|&(e, nu, h)| Coating::new(material((e, nu)), h).unwrap()).collect();
    let base = stack.substrate.map_or(Base::Rigid, |elasticity| Base::Elastic(material(elasticity)));
    Body::Elastic(HalfSpace::new(coatings, base).unwrap())
}

#[test]
fn coefficients_are_those_of_high_precision_integrals() {
    let table: Table = serde_json::from_str(include_str!("golden/line_coefficients.json")).unwrap();
    assert_eq!(table.bodies.len(), 100);
    for entry in &table.bodies {
        let upper = entry.upper.as_ref().map_or(Body::Rigid, half_space);
        let pair = ContactPair::new(upper, half_space(&entry.lower)).unwrap();
        let found = line_coefficients(&pair, 1001, 1.0, entry.datum, Components::ALL);
        let at = |i: usize| {
            [&found.zz, &found.xx, &found.yy, &found.zx].map(|array| array.as_ref().unwrap()[[i, 0]])
        };
        let (_, zz, xx, yy, zx, _) = entry.rows[0];
        let own = [zz, xx, yy, zx].into_iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        // 1e-13 everywhere but under coatings 1e4 times stiffer: there the base moves 1e4 times as far as the coating is pressed in,
        // and a datum three cells deep in it takes the difference
        let (is_stiff, is_shallow) = (entry.lower.layers[0].0 == 1e4, entry.datum == 3.0);
        let bound = if is_stiff && is_shallow {
            2e-12
        } else if is_stiff {
            1e-12
        } else {
            2e-13
        };
        for &(i, zz, xx, yy, zx, error) in &entry.rows {
            assert!(error < 1e-16, "the table's own error");
            for (found, exact) in at(i).into_iter().zip([zz, xx, yy, zx]) {
                // far from a shallow datum coefficients are larger than the one at offset 0
                let error = (found - exact).abs() / own.max(exact.abs());
                assert!(error < bound, "{}, datum {}, offset {i}: {error:.1e}", entry.family, entry.datum);
            }
        }
    }
}
