//! Time a depth for six components from pressure and both shears, kernels' set-up included: 128 x 128 cells, stiff coating.
//! `-- THREADS ROUNDS`; `benches/depth_cost.py` sets it against convolutions by scipy.

#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "a measurement tells what it found")]

use std::time::Instant;

use fretting::model::{Base, Coating, ElasticMaterial, HalfSpace, Periodicity, SurfaceGrid};
use fretting::subsurface::{DepthOperator, StressField, Tractions, automatic_depths};
use ndarray::Array2;

fn main() {
    let mut numbers = std::env::args().skip(1).filter_map(|argument| argument.parse::<usize>().ok());
    let threads = numbers.next().unwrap_or(1);
    let rounds = numbers.next().unwrap_or(5);
    let material = |young| ElasticMaterial::new(young, 0.3).unwrap();
    let body = HalfSpace::new(vec![Coating::new(material(2.0), 1.0).unwrap()], Base::Elastic(material(1.0)))
        .unwrap();
    let grid = SurfaceGrid::new([128; 2], [2.4 / 128.0; 2]).unwrap();
    let field = Array2::from_shape_fn((128, 128), |(i, j)| ((i * 31 + j * 17) % 11) as f64);
    let tractions = Tractions { pressure: field.view(), shear: Some([field.view(), field.view()]) };
    let points = automatic_depths(&body, 3.0, 64);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
            // tables of the method are made once a process, memory once a survey
            let mut operator = DepthOperator::new(&body, points[0], &grid, Periodicity::NONE, true, false).unwrap();
            let mut stress = StressField::zeros([128; 2]);
            let mut least = vec![[f64::INFINITY; 2]; points.len()];
            for _round in 0..rounds {
                for (&point, least) in points.iter().zip(&mut least) {
                    let started = Instant::now();
                    operator.move_to(point).unwrap();
                    least[0] = least[0].min(started.elapsed().as_secs_f64());
                    let started = Instant::now();
                    operator.stress_into(&tractions, &mut stress);
                    least[1] = least[1].min(started.elapsed().as_secs_f64());
                    assert!(stress.components[0][[0, 0]].is_finite());
                }
            }
            let mean =
                |part: usize| 1e3 * least.iter().map(|least| least[part]).sum::<f64>() / points.len() as f64;
            println!(
                "threads {threads}, {} depths: kernels {:.2} ms, products {:.2} ms a depth (least of {rounds} rounds)",
                points.len(),
                mean(0),
                mean(1)
            );
        });
}
