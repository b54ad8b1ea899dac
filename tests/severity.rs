//! Where a cycle is most severe: the search, against every cell evaluated on its own.

use fret_core::model::{Base, Coating, ElasticMaterial, HalfSpace, Periodicity, SurfaceGrid};
use fret_core::subsurface::fatigue::{FatigueConstants, LayerConstants};
use fret_core::subsurface::{EvenStress, LoadedSurface, Severity, depth_points, survey};
use ndarray::Array2;

/// The largest parameters of fatigue over all cells, looked for where bounds allow them, are those of every cell evaluated on its own; on one
/// thread or more, bit by bit.
#[test]
fn the_most_severe_cells_are_those_of_all_cells_one_by_one() {
    let (cells, spacing) = ([46, 41], 0.15);
    let grid = SurfaceGrid::new(cells, [spacing; 2]).unwrap();
    let material = |young, poisson| ElasticMaterial::new(young, poisson).unwrap();
    let coating = Coating::new(material(4.0, 0.25), 0.5).unwrap();
    let body = HalfSpace::new(vec![coating], Base::Elastic(material(1.0, 0.3))).unwrap();
    let points = depth_points(&body, &[0.0, 0.1, 0.5, 0.9]).unwrap();
    let round = |shift: f64, radius: f64| {
        Array2::from_shape_fn((cells[0], cells[1]), |(i, j)| {
            let [x, y] = [grid.centre(0, i) - shift, grid.centre(1, j)];
            (radius * radius - x * x - y * y).max(0.0).sqrt()
        })
    };
    let surfaces: Vec<LoadedSurface> = (0..7)
        .map(|increment| {
            let push = (f64::from(increment) * 0.9).sin();
            let (pressure, disc) = (round(0.0, 1.5), round(0.2 * push, 1.2));
            let shear = [&pressure * (0.4 * push) - &disc * (0.1 * push), &disc * (0.1 * push * push)];
            let increment = usize::try_from(increment).unwrap();
            LoadedSurface { increment, pressure, shear: Some(shear), slip: None, even: EvenStress::default() }
        })
        .collect();
    let constants = LayerConstants::everywhere(FatigueConstants {
        yield_strength: Some(2.0),
        torsion_limit: Some(0.5),
        tension_limit: Some(0.8),
        critical_distance: Some(0.3),
        ..FatigueConstants::default()
    });
    let judged = |threads: usize, row: Option<usize>| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let all = (0..surfaces.len()).collect();
            let mut severity = Severity::new(&body, &constants, &points, (&surfaces, all), row);
            survey(&body, &grid, Periodicity::NONE, &points, &surfaces, |point, surface, field| {
                severity.look(point, surface, field);
                true
            })
            .unwrap();
            severity.judged()
        })
    };
    let [looked_for, evaluated] = [judged(1, Some(30)), judged(1, None)];
    assert_eq!(looked_for.found.len(), 10); // five parameters in two layers
    assert_eq!(looked_for.found, evaluated.found);
    assert_eq!(looked_for.at_surface, evaluated.at_surface);
    assert!(
        looked_for.at_surface.iter().any(|found| found.off != [0.0; 2]),
        "a rim is the most severe place"
    );
    assert_eq!(looked_for.at_distance, evaluated.at_distance);
    assert_eq!(looked_for.at_distance.len(), 4); // all but shakedown
    for threads in [2, 3, 5] {
        assert_eq!(judged(threads, Some(30)), looked_for, "{threads} threads");
    }
    assert_eq!(judged(3, None), evaluated);
}
