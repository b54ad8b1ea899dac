//! The judged families as a page of the documentation.

use std::fmt::Write;

use super::judgement::{Bounds, Row};
use super::scene::TOLERANCE;
use super::table::{HEADS, benign, cells};

const HEAD: &str = "# Stiff and extreme cases

`fret extremes` solves the scenes of this page and judges each by what must hold whatever the numbers; `fret extremes --quick`
takes some of them. The exit code is 0 when all hold and 2 when one does not. This page is written by
`fret extremes --page docs/extremes.md`. Cases in which everything varies at once are on [Cases drawn at random](random-cases.md).

Scenes: a rigid sphere pressed on a body under coatings, then pulled along x; pressure, shear and slip coupled, with friction 0.3
and T = 0.8 mu W unless they are what varies; a is the contact radius of the sphere's shape, the plain substrate has E = 1 and
nu = 0.3. Each row shows the worst of its family.

";

/// The page.
pub fn page(rows: &[Row]) -> String {
    let benign = benign(rows);
    let mut text = HEAD.to_owned();
    let _ = writeln!(
        text,
        "| column | what it is | bound |\n|---|---|---|\n\
         | response | error of the frequency response on waves of 1e-3 to 1e3 over a, against a twin that carries displacements \
         and tractions through the layers by the plain exponential of the elastic equations in 768 binary digits and more; `rz` \
         relative to `sqrt(rr zz)` | {:.0e} |\n\
         | asymmetry | of the matrix of all displacements from all tractions on 8 x 8 cells, its diagonal scaled to 1 | {:.0e} |\n\
         | least pivot | of Cholesky's factors of that matrix | above 0 |\n\
         | residual | of complementarity, Coulomb's law and equilibrium, the worst increment | {TOLERANCE:.0e} |\n\
         | energy | work done less energy stored and dissipated, over the work done, the worst increment that was solved as a whole | {:.0e} |\n\
         | mirror | the scene solved without its mirrors: pressure and shear against their image in the line of the pull, and largest pressure, approach and shift against those in front of the mirrors as far as both took the same steps, over the largest | {:.0e} |\n\
         | iterations | convolutions an increment, over those of the benign scene | shown |\n",
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
            let _ = writeln!(text, "- {}: **does not hold**: {scene}: {what}.", row.name);
        }
        for [scene, why] in &row.refused {
            let _ = writeln!(text, "- {}: {scene} is refused: {why}.", row.name);
        }
    }
    text
}
