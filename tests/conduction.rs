//! Heat and current: against closed forms, image series, each other, and the stiffness of the same contact.

use std::f64::consts::PI;

use fret_core::case::Case;
use fret_core::conduction::{ConductionError, Potential, contact_resistance, surface_temperature};
use fret_core::model::{ConductingLayer, Conductor, Periodicity, SurfaceGrid};
use fret_validation::keeping;
use ndarray::Array2;

fn homogeneous(conductivity: f64) -> Conductor {
    Conductor::homogeneous(conductivity).unwrap()
}

fn coated(coating: f64, thickness: f64, substrate: f64) -> Conductor {
    Conductor::new(vec![ConductingLayer { thickness, conductivity: coating }], substrate).unwrap()
}

/// Grid of odd cells around a disc of radius 1, cells a diameter.
fn around_disc(per_diameter: usize) -> SurfaceGrid {
    let cells = per_diameter + 5 - per_diameter % 2;
    SurfaceGrid::new([cells, cells], [2.0 / per_diameter as f64; 2]).unwrap()
}

/// Mean over each cell of a flux that lies within the unit circle, from its integral between two y on a line of one x: whole lines
/// across the cell, many in cells that the circle cuts.
fn means_by_lines(grid: &SurfaceGrid, integral: impl Fn(f64, f64, f64) -> f64) -> Array2<f64> {
    let [dx, dy] = grid.spacing();
    let [nx, ny] = grid.cells();
    Array2::from_shape_fn((nx, ny), |(i, j)| {
        let (x, y) = (grid.centre(0, i), grid.centre(1, j));
        let is_cut = (x.hypot(y) - 1.0).abs() < dx.max(dy);
        let lines = if is_cut { 1000 } else { 40 };
        let along = |n: usize| x + dx * ((n as f64 + 0.5) / lines as f64 - 0.5);
        (0..lines).map(|n| integral(along(n), y - 0.5 * dy, y + 0.5 * dy)).sum::<f64>() / (lines as f64 * dy)
    })
}

/// Integral of [`disc`] along a line of one x.
fn disc_along_y(x: f64, from: f64, to: f64) -> f64 {
    let half = (1.0 - x * x).max(0.0).sqrt();
    (to.min(half) - from.max(-half)).max(0.0)
}

/// Integral of [`hertzian`] along a line of one x.
fn hertzian_along_y(x: f64, from: f64, to: f64) -> f64 {
    let square = (1.0 - x * x).max(0.0);
    let half = square.sqrt();
    let (from, to) = (from.max(-half), to.min(half));
    if from >= to {
        return 0.0;
    }
    let up_to =
        |y: f64| 0.5 * (y * (square - y * y).max(0.0).sqrt() + square * (y / half).clamp(-1.0, 1.0).asin());
    up_to(to) - up_to(from)
}

/// Mean of a function of the radius over each cell, by points of a fine lattice.
fn cell_means(grid: &SurfaceGrid, points: usize, of: impl Fn(f64) -> f64) -> Array2<f64> {
    let [dx, dy] = grid.spacing();
    let [nx, ny] = grid.cells();
    let offsets: Vec<f64> = (0..points).map(|n| (n as f64 + 0.5) / points as f64 - 0.5).collect();
    Array2::from_shape_fn((nx, ny), |(i, j)| {
        let (x, y) = (grid.centre(0, i), grid.centre(1, j));
        let mut sum = 0.0;
        for along_x in &offsets {
            for along_y in &offsets {
                sum += of((x + dx * along_x).hypot(y + dy * along_y));
            }
        }
        sum / (points * points) as f64
    })
}

fn disc(r: f64) -> f64 {
    if r < 1.0 { 1.0 } else { 0.0 }
}

fn hertzian(r: f64) -> f64 {
    (1.0 - r * r).max(0.0).sqrt()
}

fn rise(conductor: &Conductor, grid: &SurfaceGrid, flux: &Array2<f64>) -> Array2<f64> {
    let contact = flux.mapv(|flux| flux > 0.0);
    let found =
        surface_temperature([Some(conductor), None], grid, Periodicity::NONE, flux, &contact).unwrap();
    found.rise[0].clone().unwrap()
}

#[test]
fn heat_of_a_disc_and_of_hertzs_pressure_warms_a_half_space_as_carslaw_and_jaeger_say() {
    // Carslaw & Jaeger (1959), Conduction of Heat in Solids, 10.5: centre q a/kappa, mean 8 q a/(3 pi kappa); Johnson (1985),
    // Contact Mechanics, 3.4 with 1/kappa for (1 - nu)/G: pi q0 a/(4 kappa)
    let steel = homogeneous(45.0);
    let centre = |per_diameter: usize, of: fn(f64) -> f64| {
        let grid = around_disc(per_diameter);
        let flux = cell_means(&grid, 64, of);
        let middle = grid.cells()[0] / 2;
        let rise = rise(&steel, &grid, &flux);
        (rise[[middle, middle]] * 45.0, (&rise * &flux).sum() / flux.sum() * 45.0)
    };
    let (at_centre, mean) = centre(160, disc);
    // flux of the cells cut by the rim is spread over them: (side/radius)^2
    assert!((at_centre - 1.0).abs() < 1e-4, "{at_centre}");
    assert!((mean - 8.0 / (3.0 * PI)).abs() < 3e-4, "{mean}");
    let (hertz, _) = centre(160, hertzian);
    assert!((hertz - PI / 4.0).abs() < 1e-4, "{hertz}");
}

#[test]
fn one_layer_warms_as_its_image_series_says_once_cells_are_refined() {
    // centre temperature times k1/(q a): disc, and q0 sqrt(1 - r^2/a^2); image series of the layer, nine digits
    for (ratio, thickness, of_disc, of_hertz) in [
        (0.1, 0.1, 0.197_988_394, 0.175_333_959),
        (0.1, 1.0, 0.721_813_686, 0.597_362_871),
        (0.5, 0.1, 0.571_201_355, 0.461_687_362),
        (0.5, 0.5, 0.766_697_992, 0.624_042_902),
        (0.5, 1.0, 0.865_063_167, 0.694_330_273),
        (2.0, 0.1, 1.755_615_810, 1.345_070_830),
        (2.0, 0.5, 1.344_796_200, 1.021_869_070),
        (2.0, 1.0, 1.192_974_030, 0.915_269_480),
        (10.0, 0.5, 2.537_727_480, 1.829_066_280),
        (10.0, 1.0, 1.826_009_910, 1.339_388_140),
    ] {
        let body = coated(ratio, thickness, 1.0);
        for (along_y, exact) in
            [(disc_along_y as fn(f64, f64, f64) -> f64, of_disc), (hertzian_along_y, of_hertz)]
        {
            let centre = |per_diameter: usize| {
                let grid = around_disc(per_diameter);
                let flux = means_by_lines(&grid, along_y);
                let middle = grid.cells()[0] / 2;
                rise(&body, &grid, &flux)[[middle, middle]] * ratio
            };
            let [coarse, fine] = [50, 150].map(|cells| centre(cells) / exact - 1.0);
            // the flux of the cells that the rim cuts is spread over them: second order, so that a third of the side leaves a ninth;
            // extrapolated to no side; the staircase of the rim, another one on each grid, leaves up to 8.8e-7
            let extrapolated = (9.0 * fine - coarse) / 8.0;
            assert!(extrapolated.abs() < 1e-6, "{ratio}, {thickness}: {coarse:e} {fine:e} {extrapolated:e}");
            assert!(fine.abs() < 4e-5, "{ratio}, {thickness}: {fine:e}");
        }
    }
}

#[test]
fn homogeneous_bodies_share_heat_by_their_conductivities_whatever_the_contact() {
    let grid = SurfaceGrid::new([24, 20], [0.5, 0.7]).unwrap();
    let heat =
        Array2::from_shape_fn((24, 20), |(i, j)| if (i * 7 + j * 5) % 3 == 0 { 1.0 + i as f64 } else { 0.0 });
    let contact = Array2::from_shape_fn((24, 20), |(i, j)| (i + j) % 4 != 1);
    let [lower, upper] = [homogeneous(3.0), homogeneous(1.0)];
    let found =
        surface_temperature([Some(&lower), Some(&upper)], &grid, Periodicity::NONE, &heat, &contact).unwrap();
    // both responses are one function of place: the parts are 3/4 and 1/4 in every cell, to the solver's 1e-11
    assert!((found.lower_fraction().unwrap() - 0.75).abs() < 1e-10);
    for (cell, part) in found.into_lower.indexed_iter() {
        assert!((part - 0.75 * heat[cell]).abs() < 1e-8, "{cell:?}");
    }
    let [one, other] = found.rise.map(Option::unwrap);
    assert!(one.iter().zip(&other).all(|(one, other)| (one - other).abs() < 1e-9 * one));
}

/// Heat in the disc where two layered bodies touch, on cells of 0.1.
fn layered_bodies(cells: usize) -> (SurfaceGrid, Array2<f64>, [Conductor; 2]) {
    let grid = SurfaceGrid::new([cells; 2], [0.1; 2]).unwrap();
    let heat = cell_means(&grid, 4, disc);
    (grid, heat, [coated(0.2, 0.3, 5.0), coated(40.0, 0.1, 1.0)])
}

#[test]
fn layered_bodies_have_one_temperature_in_contact_and_lose_no_heat() {
    let (grid, heat, [lower, upper]) = layered_bodies(32);
    let contact = heat.mapv(|heat| heat > 0.0);
    let found =
        surface_temperature([Some(&lower), Some(&upper)], &grid, Periodicity::NONE, &heat, &contact).unwrap();
    let [one, other] = found.rise.each_ref().map(|rise| rise.as_ref().unwrap());
    let largest = found.largest().0;
    let mut outside = 0.0_f64;
    for (cell, touches) in contact.indexed_iter() {
        let difference = (one[cell] - other[cell]).abs() / largest;
        if *touches {
            assert!(difference < 1e-10, "{cell:?}: {difference:.1e}"); // the solver's 1e-11, twice
        } else {
            outside = outside.max(difference);
            assert!(found.into_lower[cell] == 0.0);
        }
    }
    assert!(outside > 1e-3, "beside the contact each body has its own");
    // the fraction is that of the whole: with one body alone it is all or nothing
    let alone = surface_temperature([None, Some(&upper)], &grid, Periodicity::NONE, &heat, &contact).unwrap();
    assert!(alone.into_lower.iter().all(|flux| *flux == 0.0) && alone.rise[0].is_none());
}

/// Twice the heat is twice the temperature, in numbers whose squares there are none of; what has no number at all is refused.
#[test]
fn heat_of_any_size_has_its_temperature_or_is_refused() {
    let (grid, heat, [lower, upper]) = layered_bodies(24);
    let contact = heat.mapv(|heat| heat > 0.0);
    let found = |size: f64| {
        let heat = heat.mapv(|heat| size * heat);
        surface_temperature([Some(&lower), Some(&upper)], &grid, Periodicity::NONE, &heat, &contact)
    };
    let one = found(1.0).unwrap();
    for exponent in [660, -660] {
        let size = 2.0_f64.powi(exponent);
        let other = found(size).unwrap();
        assert_eq!(other.into_lower, one.into_lower.mapv(|flux| size * flux));
        assert_eq!(other.largest().0, size * one.largest().0);
    }
    assert_eq!(found(1e308).unwrap_err(), ConductionError::Beyond);
}

#[test]
fn a_disc_resists_as_holm_says() {
    // Holm (1967), Electric Contacts: (rho1 + rho2)/(4 a). The flux grows without bound at the rim: error of a cell's side over the
    // radius, which halving the cells halves; extrapolated it is of the next order, and of the staircase of the rim.
    let [lower, upper] = [homogeneous(1.0 / 2e-8), homogeneous(1.0 / 6e-8)];
    let exact = 8e-8 / 4.0;
    let resistance = |per_diameter: usize| {
        let grid = around_disc(per_diameter);
        let contact = cell_means(&grid, 1, disc).mapv(|inside| inside > 0.0);
        let found =
            contact_resistance([Some(&lower), Some(&upper)], &grid, Periodicity::NONE, &contact).unwrap();
        // of the disc that has the area of the cells, so that the staircase counts little
        let area = contact.iter().filter(|inside| **inside).count() as f64 * grid.cell_area();
        found * (area / PI).sqrt()
    };
    let [coarse, fine] = [resistance(60), resistance(120)];
    assert!((fine / exact - 1.0).abs() < 0.01, "{}", fine / exact);
    let extrapolated = 2.0 * fine - coarse;
    assert!((extrapolated / exact - 1.0).abs() < 1e-4, "{}", extrapolated / exact);
}

#[test]
fn resistance_is_barbers_inverse_of_the_incremental_stiffness_of_a_rough_contact() {
    // Barber (2003), Proc. R. Soc. A 459, 53: 1/R = 2/(E* (rho1 + rho2)) dP/d approach. Two approaches so near that the same cells touch:
    // then P is linear between them, and the stiffness is exact on the grid.
    let case = |approach: f64| {
        let heights: Vec<String> = (0..48)
            .map(|i| {
                let row = (0..48).map(|j| {
                    let (x, y) = (f64::from(i), f64::from(j));
                    let rough = (0.9 * x).sin() * (0.7 * y + 0.3).cos()
                        + 0.6 * (1.7 * x + 2.1 * y).sin()
                        + 0.3 * (2.9 * y - 1.3 * x).cos();
                    format!("{:.6e}", 1e-3 * rough)
                });
                row.collect::<Vec<_>>().join(" ")
            })
            .collect();
        let text = format!(
            "[grid]\ncells = [48, 48]\nsize = [4.8, 4.8]\n[upper]\nsubstrate = {{ young = 3.0, poisson = 0.2, electrical_resistivity = 5.0 }}\n\
             [lower]\nsubstrate = {{ young = 1.0, poisson = 0.3, electrical_resistivity = 2.0 }}\n[profile.sphere]\nradius = 100.0\n\
             [lower.profile.heights]\nfile = \"rough.txt\"\n[solver]\ntolerance = 1e-12\n[[load]]\napproach = {approach:e}\nincrements = 1\n{}",
            keeping(1)
        );
        let files = |_: &str| Ok(heights.join("\n").into_bytes());
        let attachments = fret_core::case::Attachments::files(&files);
        Case::from_toml_with(&text, "case.toml", attachments).unwrap_or_else(|error| panic!("{error}"))
    };
    let run = |approach: f64| {
        let plan = fret_core::Plan::new(case(approach)).unwrap();
        fret_core::Simulation::new(&plan).run(&mut fret_core::Silent).unwrap()
    };
    let (near, far) = (run(0.012), run(0.012 * (1.0 + 1e-6)));
    let contact = near.state.pressure.mapv(|pressure| pressure > 0.0);
    assert_eq!(contact, far.state.pressure.mapv(|pressure| pressure > 0.0));
    let touching = contact.iter().filter(|inside| **inside).count();
    assert!(touching > 100 && touching < 1000, "{touching} cells: a rough contact");
    let force = |history: &fret_core::History| history.steps[0].normal_force;
    let stiffness = (force(&far) - force(&near)) / (far.state.approach - near.state.approach);
    let [lower, upper] = case(0.012).conduction.electrical;
    let found = contact_resistance([lower.as_ref(), upper.as_ref()], &near.grid, Periodicity::NONE, &contact)
        .unwrap();
    let modulus = 1.0 / ((1.0 - 0.09) / 1.0 + (1.0 - 0.04) / 3.0);
    let exact = modulus * (2.0 + 5.0) / (2.0 * stiffness);
    // difference of forces that are solved to 1e-12, over a change of 1e-6
    assert!((found / exact - 1.0).abs() < 1e-6, "{:e}", found / exact - 1.0);
}

#[test]
fn a_periodic_contact_adds_less_resistance_than_one_that_stands_alone() {
    // constriction of a disc in a cylinder, Cooper, Mikic & Yovanovich (1969), Int. J. Heat Mass Transf. 12, 279: (1 - a/b)^1.5 of the lone
    // one; of square cells with a small disc the same to some percent
    let grid = SurfaceGrid::new([128, 128], [10.0 / 128.0; 2]).unwrap();
    let contact = cell_means(&grid, 1, disc).mapv(|inside| inside > 0.0);
    let body = homogeneous(2.0);
    let of = |periodic| contact_resistance([Some(&body), Some(&body)], &grid, periodic, &contact).unwrap();
    let ratio = of(Periodicity::BOTH) / of(Periodicity::NONE);
    let expected = (1.0 - 1.0 / (10.0 / PI.sqrt())).powf(1.5);
    assert!((ratio - expected).abs() < 0.02, "{ratio} {expected}");
    let all = contact.mapv(|_| true);
    assert_eq!(contact_resistance([Some(&body), Some(&body)], &grid, Periodicity::BOTH, &all).unwrap(), 0.0);
}

#[test]
fn what_has_no_steady_state_is_refused() {
    let body = homogeneous(1.0);
    let line = SurfaceGrid::line(16, 0.1).unwrap();
    assert!(Potential::new([Some(&body), None], &line, Periodicity::NONE).is_err());
    let grid = SurfaceGrid::new([8, 8], [1.0, 1.0]).unwrap();
    let (none, heat) = (Array2::from_elem((8, 8), false), Array2::zeros((8, 8)));
    assert!(surface_temperature([Some(&body), None], &grid, Periodicity::BOTH, &heat, &none).is_err());
    assert!(surface_temperature([None, None], &grid, Periodicity::NONE, &heat, &none).is_err());
    assert!(contact_resistance([Some(&body), None], &grid, Periodicity::NONE, &none).is_err());
    assert!(contact_resistance([Some(&body), Some(&body)], &grid, Periodicity::NONE, &none).is_err());
}
