//! The families and what was found of them as the page `docs/trust/extremes.md`.

use std::fmt::Write;

use super::judgement::{Bounds, Row};
use super::scene::TOLERANCE;

/// Heads of the columns.
const HEADS: [&str; 10] = [
    "family",
    "cases",
    "response",
    "asymmetry",
    "least pivot",
    "residual",
    "energy",
    "symmetry",
    "iterations",
    "result",
];

const HEAD: &str = "# Stiff and extreme cases

Written by `cargo xtask extremes`. Every case is solved and its invariants are checked: symmetry, positive definiteness, energy
balance, residuals. A test checks a subset on coarser grids. In [Random cases](random-cases.md) everything varies at once.

Cases: a rigid sphere indents a coated body and is then loaded along x, with normal-tangential coupling. Friction 0.3 and
Q = 0.8 mu P unless they vary; a is the Hertz contact radius of the uncoated substrate with E = 1 and nu = 0.3. E_c and E_s are
Young's moduli of coating and substrate, h is the coating thickness. Each row shows the worst case of its family.

";

/// The page.
pub fn page(rows: &[Row]) -> String {
    let benign = benign(rows);
    let mut text = HEAD.to_owned();
    let _ = writeln!(
        text,
        "| column | what it is | bound |\n|---|---|---|\n\
         | response | error of the frequency response on waves of 1e-3 to 1e3 over a, against a second implementation: matrix exponential of the \
         elastic equations, layer by layer, with at least 768 bits; `rz` relative to `sqrt(rr zz)` | {:.0e} |\n\
         | asymmetry | of the matrix of all displacements from all tractions on 8 x 8 cells, its diagonal scaled to 1 | {:.0e} |\n\
         | least pivot | of the Cholesky factorisation of that matrix | above 0 |\n\
         | residual | of complementarity, Coulomb's law and equilibrium, the worst increment | {TOLERANCE:.0e} |\n\
         | energy | work done less energy stored and dissipated, over the work done, the worst increment that was solved as a whole | {:.0e} |\n\
         | symmetry | the case solved without symmetry reduction: pressure and shear against their mirror image, and maximum pressure, approach and shift against the run with symmetry reduction, relative to the maximum | {:.0e} |\n\
         | iterations | convolutions per increment, relative to the benign case | shown |\n",
        Bounds::RESPONSE,
        Bounds::ASYMMETRY,
        Bounds::BALANCE,
        Bounds::MIRROR,
    );
    let _ = writeln!(text, "| {} |\n|{}", HEADS.join(" | "), "---|".repeat(HEADS.len()));
    for row in rows {
        let _ = writeln!(text, "| {} |", cells(row, benign).join(" | "));
    }
    let _ = writeln!(text, "\n## Limits found\n");
    for row in rows {
        if let Some(worst) = row.worst
            && worst.effort > 2.0 * benign
        {
            let times = worst.effort / benign;
            let _ = writeln!(text, "- {}: {} takes {times:.1} times the iterations.", row.name, row.slowest);
        }
        for [scene, what] in &row.broken {
            let _ = writeln!(text, "- {}: **fails**: {scene}: {what}.", row.name);
        }
        for [scene, why] in &row.refused {
            let _ = writeln!(text, "- {}: {scene} is refused: {why}.", row.name);
        }
    }
    text
}

/// The cells of a row. Iterations are the convolutions per increment, relative to the benign case.
fn cells(row: &Row, benign: f64) -> [String; 10] {
    let [response, asymmetry, pivot, residual, balance, mirror, effort] = match &row.worst {
        Some(worst) => [
            format!("{:.0e}", worst.response),
            format!("{:.0e}", worst.asymmetry),
            format!("{:.0e}", worst.pivot),
            format!("{:.0e}", worst.residual),
            format!("{:.0e}", worst.balance),
            format!("{:.0e}", worst.mirror),
            format!("{:.1}", worst.effort / benign),
        ],
        None => [const { String::new() }; 7].map(|_| "-".to_owned()),
    };
    let name = format!("{}: {}", row.name, row.range);
    [
        name,
        row.scenes.to_string(),
        response,
        asymmetry,
        pivot,
        residual,
        balance,
        mirror,
        effort,
        row.verdict(),
    ]
}

/// Convolutions per increment of the benign case, which is the first family.
fn benign(rows: &[Row]) -> f64 {
    rows.first().and_then(|row| row.worst).map_or(f64::NAN, |worst| worst.effort)
}
