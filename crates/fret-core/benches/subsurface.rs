//! Time a depth for six components from pressure and both shears, kernels' set-up included: 128 x 128 cells, stiff coating.
//! Processor time is told apart by running in one thread.

#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "a measurement tells what it found")]

use std::time::Instant;

use fret_core::model::{Base, Coating, ElasticMaterial, HalfSpace, SurfaceGrid};
use fret_core::subsurface::{DepthOperator, Tractions, automatic_depths};
use ndarray::Array2;

fn main() {
    let material = |young| ElasticMaterial::new(young, 0.3).unwrap();
    let body = HalfSpace::new(vec![Coating::new(material(2.0), 1.0).unwrap()], Base::Elastic(material(1.0)))
        .unwrap();
    let grid = SurfaceGrid::new([128; 2], [2.4 / 128.0; 2]).unwrap();
    let field = Array2::from_shape_fn((128, 128), |(i, j)| ((i * 31 + j * 17) % 11) as f64);
    let tractions = Tractions { pressure: field.view(), shear: Some([field.view(), field.view()]) };
    let points = automatic_depths(&body, 3.0, 64);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    pool.install(|| {
        // tables of the method are made once a process
        drop(DepthOperator::new(&body, points[0], &grid, false, true, false).unwrap());
        for round in 0..3 {
            let (mut made, mut applied) = (0.0, 0.0);
            for &point in &points {
                let started = Instant::now();
                let mut operator = DepthOperator::new(&body, point, &grid, false, true, false).unwrap();
                made += started.elapsed().as_secs_f64();
                let started = Instant::now();
                let stress = operator.stress(&tractions);
                applied += started.elapsed().as_secs_f64();
                assert!(stress.components[0][[0, 0]].is_finite());
            }
            let per_depth = 1e3 / points.len() as f64;
            println!(
                "round {round}: {} depths, kernels {:.2} ms, products {:.2} ms a depth",
                points.len(),
                made * per_depth,
                applied * per_depth
            );
        }
    });
}
