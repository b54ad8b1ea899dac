//! The page `docs/developers/simplifications-measured.md`: what each automatic simplification changes in the result and in the work.
//! `cargo run --release -p fret-validation --example leaving_out > docs/developers/simplifications-measured.md`

#![expect(clippy::print_stdout, reason = "its output is the page")]

use fret_core::plan::LeaveOut;
use fret_fft::{Block, Convolution, Kernel, Mirrors, Parity};
use fret_validation::shortcuts::{Run, TOLERANCE, cases, difference, solved};
use ndarray::Array2;

const CELLS: usize = 128;

const HEAD: &str = "---
search:
  exclude: true
---

# Automatic simplifications, measured

What each [automatic simplification](../theory/simplifications.md) changes in the result and in the work. Written by
`cargo run --release -p fret-validation --example leaving_out > docs/developers/simplifications-measured.md`.

";

const TAIL: &str = "
Difference: pressure and shear of any cell and increment relative to the maximum contact pressure, approach and relative
displacement relative to the maximum approach, dissipated energy relative to the maximum force times that. 0 means the same bits.
Simplifications change where an iteration starts, or its rounding; both results satisfy the solver tolerance. Times are the best of
three runs on a shared machine: differences below 25 % mean nothing.

";

fn main() {
    print!("{HEAD}");
    println!(
        "Grid {CELLS} x {CELLS}, residuals at most {TOLERANCE:e}, two threads. Convolutions on subdomains and coarser grids count by their \
         fraction of the cells. Times include everything, influence coefficients too.\n"
    );
    println!(
        "| case | simplification | max difference | convolutions without, with | time without, with [s] | \
         no simplification at all: max difference | convolutions | time [s] |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for case in cases(CELLS) {
        let short = best(&case.text, LeaveOut::ALL);
        let full = best(&case.text, LeaveOut::NONE);
        let work = |run: &Run| run.history.work().full_grid_convolutions;
        let (name, off, counts, times) = match case.shortcut {
            Some(shortcut) => {
                let without = best(&case.text, LeaveOut::all_but(shortcut));
                (
                    shortcut.name(),
                    format!("{:.0e}", difference(&without.history, &short.history)),
                    format!("{:.1}, {:.1}", work(&without), work(&short)),
                    format!("{:.3}, {:.3}", without.seconds, short.seconds),
                )
            }
            None => (
                "all of them",
                "see right".to_owned(),
                format!("see right, {:.1}", work(&short)),
                format!("see right, {:.3}", short.seconds),
            ),
        };
        println!(
            "| {} | {name} | {off} | {counts} | {times} | {:.0e} | {:.1} | {:.3} |",
            case.name,
            difference(&full.history, &short.history),
            work(&full),
            full.seconds
        );
    }
    print!("{TAIL}");
    mirror();
}

fn best(text: &str, leave_out: LeaveOut) -> Run {
    let mut runs: Vec<Run> = (0..3).map(|_| solved(text, leave_out)).collect();
    runs.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    runs.swap_remove(0)
}

/// What mirrors save in a convolution.
fn mirror() {
    let cells = 2 * CELLS;
    let time = |axes: [bool; 2]| {
        let values =
            Array2::from_shape_fn([cells, cells], |(i, j)| 1.0 / (1.0 + (i * i + j * j) as f64).sqrt());
        let kernel = Kernel { values: values.view(), parity: Parity::EvenEven };
        let blocks = [Block { output: 0, input: 0, kernel: 0, sign: 1.0 }];
        let shape = axes.map(|mirrored| if mirrored { cells / 2 } else { cells });
        let mirrors = Mirrors { axes, inputs: vec![Parity::EvenEven] };
        let Ok(convolution) = Convolution::mirrored(shape, &[kernel], &blocks, mirrors) else {
            return f64::NAN;
        };
        let (input, mut output) = (vec![1.0; shape[0] * shape[1]], vec![0.0; shape[0] * shape[1]]);
        let mut workspace = convolution.workspace();
        let mut best = f64::INFINITY;
        for _ in 0..50 {
            let started = std::time::Instant::now();
            convolution.apply(&mut workspace, &[&input], &mut [&mut output]);
            best = best.min(started.elapsed().as_secs_f64());
        }
        1e3 * best
    };
    let [whole, half, quarter] = [[false, false], [false, true], [true, true]].map(time);
    println!(
        "## Symmetry reduction\n\nFields of a symmetric case are transformed by cosine and sine transforms on a half or a quarter of the \
         cells. One convolution of one field on {cells} x {cells} cells takes {whole:.2} ms, {half:.2} ms on the half and {quarter:.2} ms \
         on the quarter (one thread). Symmetry is found in the numbers: gap and friction of every cell must equal those of the mirror \
         cell to the bit, and the number of cells across the plane must be even."
    );
}
