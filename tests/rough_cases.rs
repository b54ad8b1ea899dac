//! Rough contacts drawn at random: a ball on ground steel, bare and coated, whose heights are rough down to two to four cells, pressed and rubbed.
//! Active sets read off feasible tractions wander in some of these increments. All are certified, none is solved in parts, and what an
//! increment takes is bounded by what those of its case take: counts are the same on every machine.

use fret_validation::certifier::run_certified;
use fret_validation::random::Random;
use ndarray::Array2;

/// Side of the grid [m], of four contact radii at the largest force [N].
const SIDE: f64 = 3.6e-4;
const FORCE: f64 = 60.0;
/// Waves that a surface is the sum of.
const WAVES: usize = 250;

/// Heights [m] of an isotropic surface: waves from a quarter of the side to some cells, random in direction, phase and length; amplitudes fall
/// with the power of the length that a Hurst exponent of 0.8 asks for, so many for each octave.
fn heights(random: &mut Random, cells: usize, rms: f64, finest: f64) -> Array2<f64> {
    let shortest = finest * SIDE / cells as f64;
    let waves: Vec<[f64; 4]> = (0..WAVES)
        .map(|_| {
            let length = random.log_uniform(shortest, 0.25 * SIDE);
            let (angle, phase) = (random.between(0.0, std::f64::consts::TAU), random.between(0.0, 6.3));
            let wavenumber = std::f64::consts::TAU / length;
            [wavenumber * angle.cos(), wavenumber * angle.sin(), phase, length.powf(0.8)]
        })
        .collect();
    let side = SIDE / cells as f64;
    let mut heights = Array2::from_shape_fn((cells, cells), |(i, j)| {
        let (x, y) = (side * i as f64, side * j as f64);
        waves.iter().map(|[kx, ky, phase, size]| size * (kx * x + ky * y + phase).cos()).sum::<f64>()
    });
    let square = heights.iter().map(|h| h * h).sum::<f64>() / heights.len() as f64;
    heights.mapv_inplace(|height| height * rms / square.sqrt());
    heights
}

/// A case of a seed with so many cells a side, and its heights.
fn drawn(seed: u64, cells: usize) -> (String, Array2<f64>) {
    let mut random = Random::seeded(seed);
    let friction = random.between(0.3, 0.8);
    let (rms, finest) = (random.log_uniform(3e-8, 1e-7), random.between(2.0, 4.0));
    let coatings = match seed % 3 {
        0 => "",
        1 => "coatings = [{ thickness = 30e-6, young = 380e9, poisson = 0.25 }]\n",
        _ => "coatings = [{ thickness = 3e-6, young = 900e9, poisson = 0.25 }]\n",
    };
    let wear = if seed % 4 == 3 { "[wear]\nlaw = \"archard\"\ncoefficient = 1e-15\n" } else { "" };
    let rule = if seed.is_multiple_of(2) { "end_point" } else { "second_order" };
    let text = format!(
        "[grid]\ncells = [{cells}, {cells}]\nsize = [{SIDE:e}, {SIDE:e}]\n\
         [upper]\nsubstrate = {{ young = 310e9, poisson = 0.26 }}\n[upper.profile]\nsphere = {{ radius = 10e-3 }}\n\
         heights = {{ values = {{ array = 0 }} }}\n[lower]\nsubstrate = {{ young = 210e9, poisson = 0.3 }}\n{coatings}\
         [friction]\ncoefficient = {friction}\n{wear}[solver]\nintegration = \"{rule}\"\n\
         [[load]]\nnormal_force = {FORCE}\nincrements = 10\nramp = \"cubic\"\n\
         [[load]]\ntangential_force = [{:e}, 0.0]\ncycles = 1\nincrements = 12\n",
        0.7 * friction * FORCE
    );
    (text, heights(&mut random, cells, rms, finest))
}

/// Checks the case of a seed: every law holds in all increments, as a whole, and none takes four times what half of them take. What they
/// take.
fn certified(seed: u64, cells: usize) -> (Vec<usize>, String) {
    let (text, heights) = drawn(seed, cells);
    let ended =
        run_certified(&text, &[heights]).unwrap_or_else(|error| panic!("seed {seed}: {error}\n{text}"));
    assert!(ended.error.is_none(), "seed {seed}, {cells} cells: {:?}", ended.error);
    assert_eq!(ended.wrong(), None, "seed {seed}, {cells} cells");
    assert!(ended.run.iter().all(|kept| kept.record.parts == 1), "seed {seed}, {cells} cells: in parts");
    let counts: Vec<usize> = ended.run.iter().map(|kept| kept.record.work.convolutions).collect();
    let most = counts.iter().copied().max().unwrap_or(0);
    let words = format!("seed {seed}, {cells} cells: median {}, most {most}", median(&counts));
    // Today 3.3 times at the most, once a hundred.
    assert!(most <= 4 * median(&counts), "seed {seed}, {cells} cells: {counts:?}");
    (counts, words)
}

fn median(counts: &[usize]) -> usize {
    let mut sorted = counts.to_vec();
    sorted.sort_unstable();
    sorted.get(sorted.len() / 2).copied().unwrap_or(0)
}

/// Checks cases of these sizes, seed after seed. What they take, in words.
fn certified_cases(sizes: &[usize]) -> String {
    let (mut all, mut words) = (Vec::new(), Vec::new());
    for (cells, seed) in sizes.iter().zip(100..) {
        let (counts, found) = certified(seed, *cells);
        all.extend(counts);
        words.push(found);
    }
    // Some took five thousand once.
    assert!(median(&all) <= 50, "{}", median(&all));
    format!("{}\n{} increments: median {}", words.join("\n"), all.len(), median(&all))
}

#[test]
fn rough_contacts_are_certified_in_a_bounded_number_of_applications() {
    println!("{}", certified_cases(&[64, 64, 64, 96]));
}

#[test]
#[ignore = "long: minutes"]
fn large_rough_contacts_are_certified_in_a_bounded_number_of_applications() {
    println!("{}", certified_cases(&[64, 128, 128, 96, 192, 192, 128, 128, 160, 96, 256, 128]));
}
