//! Influence coefficients: what they cost beside a convolution, and error against time of the exact conversion and of the
//! sampled one. `cargo bench -p fretting --bench influence_coefficients -- [TABLE.csv]`; the table is for
//! `docs/pictures/sampled_coefficients.py`.

#![expect(clippy::print_stdout, reason = "a benchmark answers on the terminal")]

use std::collections::HashMap;
use std::error::Error;
use std::fmt::Write;
use std::time::Instant;

use fretting::compliance::{OperatorSet, SpectralCompliance, SurfaceCompliance, SurfaceResponse};
use fretting::kernel::sublayers::RESPONSE_BOUND;
use fretting::kernel::{
    Components, InfluenceCoefficients, influence_coefficients, layered_half_space, sampled_coefficients,
};
use fretting::model::{
    Base, Body, Coating, ContactPair, ElasticMaterial, GradedCoating, HalfSpace, Layer, YoungGradient,
};

/// Cells a side of the error table.
const CELLS: usize = 256;
/// Offsets of the error table.
const OFFSETS: [[usize; 2]; 4] = [[0, 0], [3, 2], [CELLS / 4, 0], [CELLS - 1, 0]];

fn main() -> Result<(), Box<dyn Error>> {
    // cargo hands `--bench` to every benchmark
    let table = std::env::args().skip(1).find(|argument| !argument.starts_with("--"));
    costs()?;
    graded_costs()?;
    let csv = errors()?;
    if let Some(path) = table {
        std::fs::write(&path, csv)?;
        println!("\nwritten: {path}");
    }
    Ok(())
}

/// A bilayer under a rigid body: coating `(E, 0.3, h)` on `(1, 0.3)`.
fn bilayer(young: f64, thickness: f64) -> Result<ContactPair, Box<dyn Error>> {
    let coating = Coating::new(ElasticMaterial::new(young, 0.3)?, thickness)?;
    let base = Base::Elastic(ElasticMaterial::new(1.0, 0.3)?);
    Ok(ContactPair::new(Body::Rigid, Body::Elastic(HalfSpace::new(vec![coating], base)?))?)
}

/// Least time of a few runs [s], and what the last one made.
fn timed<T>(mut work: impl FnMut() -> T) -> (f64, T) {
    let mut least = f64::INFINITY;
    let begun = Instant::now();
    loop {
        let start = Instant::now();
        let made = work();
        least = least.min(start.elapsed().as_secs_f64());
        if begun.elapsed().as_secs_f64() > 0.5 {
            return (least, made);
        }
    }
}

/// Coefficients of a bilayer, all components, beside one product of all tractions with all of them.
fn costs() -> Result<(), Box<dyn Error>> {
    println!("E1/E2 = 2, h = 10 cells, all six components; least times");
    println!("   cells   coefficients [ms]   per cell [ns]   convolution [ms]   convolutions");
    let pair = bilayer(2.0, 10.0)?;
    for n in [64, 128, 256, 512] {
        let (seconds, coefficients) =
            timed(|| influence_coefficients(&pair, [n, n], [1.0, 1.0], Components::ALL));
        let product = convolution_seconds(&coefficients, n)?;
        println!(
            "{n:>8} {:>19.2} {:>15.0} {:>18.3} {:>14.1}",
            1e3 * seconds,
            1e9 * seconds / (n * n) as f64,
            1e3 * product,
            seconds / product
        );
    }
    Ok(())
}

/// The same for a graded coating, at the number of sublayers its error bound asks for.
fn graded_costs() -> Result<(), Box<dyn Error>> {
    println!(
        "\ngraded coating 10 cells thick on a substrate as stiff as its lower face, 256 x 256 cells, six components"
    );
    println!("   law          top : bottom   sublayers   cutting [ms]   coefficients [ms]");
    let exponential = |top| YoungGradient::Exponential { top, bottom: 1.0 };
    let linear = |top| YoungGradient::Linear { top, bottom: 1.0 };
    for (law, top, young) in [
        ("exponential", 4.0, exponential(4.0)),
        ("exponential", 100.0, exponential(100.0)),
        ("linear", 4.0, linear(4.0)),
        ("linear", 0.01, linear(0.01)),
    ] {
        let layers = [Layer::Graded { coating: GradedCoating::new(young, 0.3, 10.0)?, sublayers: None }];
        let base = Base::Elastic(ElasticMaterial::new(1.0, 0.3)?);
        let (cutting, body) = timed(|| layered_half_space(&layers, base, RESPONSE_BOUND));
        let pair = ContactPair::new(Body::Rigid, Body::Elastic(body?))?;
        let Body::Elastic(body) = pair.lower() else { return Err("the lower body is elastic".into()) };
        let (seconds, _) = timed(|| influence_coefficients(&pair, [256, 256], [1.0, 1.0], Components::ALL));
        println!(
            "   {law:<12} {top:>6} : 1 {:>14} {:>14.1} {:>19.1}",
            body.coatings().len(),
            1e3 * cutting,
            1e3 * seconds
        );
    }
    Ok(())
}

fn convolution_seconds(coefficients: &InfluenceCoefficients, n: usize) -> Result<f64, Box<dyn Error>> {
    let wanted = OperatorSet { full: true, ..OperatorSet::default() };
    let mut compliance =
        SpectralCompliance::new(&SurfaceResponse::FreeSpace(coefficients.clone()), [n, n], wanted)?;
    let pressure = vec![1.0; n * n];
    let shear = [vec![0.3; n * n], vec![-0.2; n * n]];
    let [mut normal, mut x, mut y] = [0; 3].map(|_| vec![0.0; n * n]);
    let tractions = [&pressure[..], &shear[0], &shear[1]];
    let (seconds, ()) = timed(|| compliance.full(tractions, [&mut normal, &mut x, &mut y]));
    Ok(seconds)
}

/// Normal coefficients of the golden file, by stack and offset.
fn golden() -> Result<HashMap<String, f64>, Box<dyn Error>> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/golden/normal_coefficients.json");
    let table: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(path)?)?;
    let mut values = HashMap::new();
    for row in table["rows"].as_array().ok_or("no rows")? {
        let layer = &row["layers"][0];
        let zz = row["zz"].as_str().ok_or("no zz")?.parse()?;
        values.insert(format!("{} {} {} {}", layer[0], layer[2], row["i"], row["j"]), zz);
    }
    Ok(values)
}

/// The error table, printed; the same as CSV.
fn errors() -> Result<String, Box<dyn Error>> {
    let golden = golden()?;
    let mut csv = String::from(
        "contrast,thickness,method,extension,seconds,error_own,error_near,error_quarter,error_end\n",
    );
    println!("\n{CELLS} x {CELLS} cells, normal component alone; error over zz at the offset");
    println!(
        " E1/E2   h/cell   conversion            time [ms]   own cell      (3,2)     (n/4,0)    (n-1,0)"
    );
    for contrast in [2.0, 100.0] {
        for thickness in [1.0, 10.0] {
            let pair = bilayer(contrast, thickness)?;
            let mut row = |method: &str, extension: usize, made: (f64, InfluenceCoefficients)| {
                let (seconds, coefficients) = made;
                let zz = coefficients.zz.ok_or("no zz")?;
                let mut errors = [0.0; 4];
                for (error, [i, j]) in errors.iter_mut().zip(OFFSETS) {
                    let key = format!("{contrast:?} {thickness:?} {i} {j}");
                    let exact = golden.get(&key).ok_or("no golden value")?;
                    *error = (zz[[i, j]] / exact - 1.0).abs();
                }
                let name = if extension == 0 {
                    method.to_owned()
                } else {
                    format!("{method}, {extension} x {extension}")
                };
                println!(
                    "{contrast:>6} {thickness:>8}   {name:<20} {:>10.2} {}",
                    1e3 * seconds,
                    errors.map(|error| format!("{error:>11.1e}")).concat()
                );
                writeln!(
                    csv,
                    "{contrast},{thickness},{method},{extension},{seconds:e},{}",
                    errors.map(|error| format!("{error:e}")).join(",")
                )?;
                Ok::<(), Box<dyn Error>>(())
            };
            let shape = [CELLS, CELLS];
            let exact = timed(|| influence_coefficients(&pair, shape, [1.0, 1.0], Components::NORMAL));
            row("exact", 0, exact)?;
            for extension in [1, 2, 4, 8] {
                let sampled =
                    timed(|| sampled_coefficients(&pair, shape, [1.0, 1.0], Components::NORMAL, extension));
                row("sampled", extension, sampled)?;
            }
        }
    }
    Ok(csv)
}
