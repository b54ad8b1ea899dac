//! The page `docs/leaving-out.md`: what each shortcut changes in the answer (nothing) and in the work, measured.
//! `cargo run --release -p fret-validation --example leaving_out > docs/leaving-out.md`

#![expect(clippy::print_stdout, reason = "its output is the page")]

use fret_core::plan::LeaveOut;
use fret_fft::{Block, Convolution, Kernel, Mirrors, Parity};
use fret_validation::shortcuts::{Run, TOLERANCE, cases, difference, solved};
use ndarray::Array2;

const CELLS: usize = 128;

const HEAD: &str = "# What is left out

Before any work the plan decides what a scene does not need, and says so: `fret plan CASE` lists each thing with the reason and
with what it saves, and so does `plan.left_out` in Python. `fret run CASE --leave-out none` computes everything all the same: the
answer does not change, the work does.

| left out | when |
|---|---|
| layered response | no body has a coating that differs from what lies below it |
| coupling of pressure and shear | the bodies answer shear with equal normal displacements, or there is no friction |
| shear and its equations | there is no friction, or nothing has caused shear so far and pressure cannot |
| normal problem | the load stays and the bodies do not couple; wear changes the gap between cycles alone |
| shear across the load | nothing loads it, and shear moves nothing across it: bodies without lateral contraction, or a line contact |
| cells behind a mirror | gap, friction and loads are their own mirror images: half of the grid in general, a quarter without pull or where the bodies do not couple |
| cells far from the contact | always, but in scenes that repeat; they are checked once an increment |
| all but six digits | on frozen zones and in approximate inverses, from 64 x 64 cells on, unless the scene repeats, long waves move a surface four times more or less than short ones, or bodies couple under hardly any friction; of coupled bodies also in looks far from the solution; what is accepted was judged with all digits |
| fields, stresses | nobody asked for them |

";

const TAIL: &str = "
The largest difference is that of pressure and shear in any cell of any increment over the largest pressure, of approach and
shift over the largest approach, and of the dissipated energy over the largest force times that; 0 means the same bits. The
other shortcuts start an iteration elsewhere or round otherwise, and both runs are right to the solver tolerance. The machine
was loaded by other work: times that differ by less than a quarter do not differ. The layered response of a plain body costs
too little to be seen.

";

fn main() {
    print!("{HEAD}");
    println!(
        "Measured on {CELLS} x {CELLS} cells with residuals of at most {TOLERANCE:e}, two threads. Convolutions count those of the \
         whole grid; ones in boxes and on coarser grids by their share of its cells. Times hold everything, kernels included, the \
         best of three.\n"
    );
    println!(
        "| scene | left out | largest difference | convolutions without, with | time without, with [s] | \
         everything computed: largest difference | convolutions | time [s] |"
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
        "## In front of the mirrors\n\nA sphere pulled along x is its own mirror image in the line of the pull; where pressure and shear \
         do not act on each other, or without a pull, also in the line across. Fields in front of a mirror are transformed by cosines \
         or sines, and everything the solver does is done for a half or a quarter of the cells: a convolution of one field on {cells} x \
         {cells} cells takes {whole:.2} ms, of the half {half:.2} ms, of the quarter {quarter:.2} ms (one thread). The plan looks for \
         mirrors in the numbers themselves: the gap of every cell and every map of friction have to equal those of the image to the \
         bit, and the number of cells across the mirror has to be even."
    );
}
