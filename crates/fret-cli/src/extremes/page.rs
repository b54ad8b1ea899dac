//! The families and their checks as a page of the documentation.

use std::fmt::Write;

use super::judgement::{Bounds, Row};
use super::scene::TOLERANCE;
use super::table::{HEADS, benign, cells};

const HEAD: &str = "# Stiff and extreme cases

`fret extremes` is a stress test: it solves the cases of this page and checks invariants (symmetry, positive definiteness, energy
balance, residuals). `fret extremes --quick` runs a subset. Exit code 0 if all pass, 2 otherwise. This page is written by
`fret extremes --page docs/trust/extremes.md`. In [Random cases](random-cases.md) everything varies at once.

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
        let mut cells = cells(row, benign);
        cells[0] = format!("{}: {}", row.name, row.range);
        let _ = writeln!(text, "| {} |", cells.join(" | "));
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
