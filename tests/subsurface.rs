//! Stresses under the surface against closed forms and an independent integration over wavenumbers.

use std::f64::consts::PI;
use std::fmt::Write as _;

use fret_core::model::{Base, Coating, ElasticMaterial, HalfSpace, Periodicity, SurfaceGrid};
use fret_core::subsurface::largest::look;
use fret_core::subsurface::{DepthOperator, DepthPoint, Measure, StressField, Tractions, depth_points};
use fret_validation::{Sphere, keeping, solved};
use ndarray::Array2;
use serde::Deserialize;

type Layers = [(f64, f64, f64)];

fn body(layers: &Layers, substrate: Option<(f64, f64)>) -> HalfSpace {
    let material = |young, poisson| ElasticMaterial::new(young, poisson).unwrap();
    let coatings = layers.iter().map(|&(e, nu, h)| Coating::new(material(e, nu), h).unwrap()).collect();
    let base = substrate.map_or(Base::Rigid, |(e, nu)| Base::Elastic(material(e, nu)));
    HalfSpace::new(coatings, base).unwrap()
}

fn stress(
    body: &HalfSpace,
    point: DepthPoint,
    grid: &SurfaceGrid,
    periodic: Periodicity,
    pressure: &Array2<f64>,
    shear: Option<[&Array2<f64>; 2]>,
) -> StressField {
    let mut operator = DepthOperator::new(body, point, grid, periodic, shear.is_some(), false).unwrap();
    let shear = shear.map(|components| components.map(|component| component.view()));
    operator.stress(&Tractions { pressure: pressure.view(), shear })
}

fn random_field(seed: u64, cells: [usize; 2]) -> Array2<f64> {
    let mut state = seed;
    Array2::from_shape_simple_fn((cells[0], cells[1]), || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    })
}

#[derive(Deserialize)]
struct Row {
    layers: Vec<(f64, f64, f64)>,
    substrate: Option<(f64, f64)>,
    depth: f64,
    layer: usize,
    sides: [f64; 2],
    i: usize,
    j: usize,
    stress: [[f64; 6]; 3],
}

#[derive(Deserialize)]
struct Table {
    rows: Vec<Row>,
}

/// The stress under every offset from one loaded cell, all components and loads, against the sum over plane waves of one
/// dense system of equations a wavenumber.
#[test]
fn cells_agree_with_an_independent_integration_over_waves() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/golden/subsurface_cells.json");
    let table: Table = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let cells = [9, 9];
    let mut worst_of_all = 0.0_f64;
    for rows in table
        .rows
        .chunk_by(|a, b| (a.depth, a.layer, a.sides, &a.layers) == (b.depth, b.layer, b.sides, &b.layers))
    {
        let first = &rows[0];
        let half_space = body(&first.layers, first.substrate);
        let grid = SurfaceGrid::new(cells, first.sides).unwrap();
        let point = DepthPoint { depth: first.depth, layer: first.layer };
        let mut unit = Array2::zeros((9, 9));
        unit[[0, 0]] = 1.0;
        let zero = Array2::zeros((9, 9));
        let fields: Vec<StressField> = (0..3)
            .map(|load| {
                let of = |n: usize| if load == n { &unit } else { &zero };
                stress(&half_space, point, &grid, Periodicity::NONE, of(0), Some([of(1), of(2)]))
            })
            .collect();
        let mut worst = 0.0_f64;
        for row in rows {
            for load in 0..3 {
                for component in 0..6 {
                    let found = fields[load].components[component][[row.i, row.j]];
                    worst = worst.max((found - row.stress[load][component]).abs());
                }
            }
        }
        // of the traction; the dense systems of the table lose up to 1e-13 at a contrast of 100
        assert!(worst < 1e-11, "{:?} depth {} layer {}: {worst:e}", first.layers, first.depth, first.layer);
        worst_of_all = worst_of_all.max(worst);
    }
    println!("cells against plane waves: {worst_of_all:.1e} of the traction");
}

/// Cell values whose piecewise constant field acts like Hertz's pressure up to the fourth order of the cell: means over the
/// cells, less a twelfth of their second differences.
fn hertz(cells: usize, spacing: f64) -> Array2<f64> {
    let n = cells;
    let fine = 64;
    let centre = |i: usize| (i as f64 - (n as f64 - 1.0) / 2.0) * spacing;
    let mean = Array2::from_shape_fn((n, n), |(i, j)| {
        let (x, y) = (centre(i), centre(j));
        let far = x.hypot(y);
        if far > 1.0 + spacing {
            return 0.0;
        }
        let mut sum = 0.0;
        for a in 0..fine {
            let u = x + spacing * ((f64::from(a) + 0.5) / f64::from(fine) - 0.5);
            // along y in closed form: integral of sqrt(c^2 - v^2)
            let c2 = 1.0 - u * u;
            if c2 <= 0.0 {
                continue;
            }
            let c = c2.sqrt();
            let primitive = |v: f64| {
                let v = v.clamp(-c, c);
                0.5 * (v * (c2 - v * v).max(0.0).sqrt() + c2 * (v / c).clamp(-1.0, 1.0).asin())
            };
            sum += primitive(y + 0.5 * spacing) - primitive(y - 0.5 * spacing);
        }
        sum / (f64::from(fine) * spacing)
    });
    let at = |i: isize, j: isize| {
        let inside = |v: isize| v >= 0 && v < n as isize;
        if inside(i) && inside(j) { mean[[i as usize, j as usize]] } else { 0.0 }
    };
    Array2::from_shape_fn((n, n), |(i, j)| {
        let (i, j) = (i as isize, j as isize);
        let around = at(i + 1, j) + at(i - 1, j) + at(i, j + 1) + at(i, j - 1);
        at(i, j) - (around - 4.0 * at(i, j)) / 12.0
    })
}

/// Value on the axis, which lies between cells when their number is even: sixth-order mean over the cells around, for fields
/// that are even in x and y.
fn on_axis(field: &Array2<f64>) -> f64 {
    let half = field.nrows() / 2;
    // even extension: values at 1/2, 3/2, 5/2 spacings
    let weights = [150.0 / 128.0, -25.0 / 128.0, 3.0 / 128.0];
    let mut sum = 0.0;
    for (a, wa) in weights.iter().enumerate() {
        for (b, wb) in weights.iter().enumerate() {
            sum += wa * wb * field[[half + a, half + b]];
        }
    }
    sum
}

#[test]
fn axis_stresses_under_hertz_pressure_on_a_coating() {
    // coating as thick as the contact radius, nu = 0.3: sigma_zz, sigma_rr at half its thickness and on both sides of the
    // interface, u_z there; Hankel integrals with closed-form transform of Hertz's pressure, eight digits
    let rows = [
        (1.0, [-0.8, -0.180_353_33], [-0.5, -0.028_982_39], -0.028_982_39),
        (0.5, [-0.831_916_31, -0.178_104_78], [-0.560_055_93, -0.151_669_23], -0.063_314_49),
        (2.0, [-0.756_464_62, -0.176_659_45], [-0.423_468_85, 0.169_609_63], -0.005_938_51),
        (4.0, [-0.705_364_53, -0.165_415_98], [-0.337_392_81, 0.445_493_69], 0.002_925_74),
    ];
    for cells in [128_usize, 256] {
        let spacing = 2.2 / cells as f64;
        let grid = SurfaceGrid::new([cells; 2], [spacing; 2]).unwrap();
        let pressure = hertz(cells, spacing);
        let mut worst_of_all = 0.0_f64;
        for (ratio, middle, above, below) in rows {
            let half_space = body(&[(ratio, 0.3, 1.0)], Some((1.0, 0.3)));
            let at = |depth: f64, layer: usize| {
                let field = stress(
                    &half_space,
                    DepthPoint { depth, layer },
                    &grid,
                    Periodicity::NONE,
                    &pressure,
                    None,
                );
                [on_axis(&field.components[2]), on_axis(&field.components[0])]
            };
            let (found_middle, found_above, found_below) = (at(0.5, 0), at(1.0, 0), at(1.0, 1));
            let errors = [
                found_middle[0] - middle[0],
                found_middle[1] - middle[1],
                found_above[0] - above[0],
                found_above[1] - above[1],
                found_below[0] - above[0],
                found_below[1] - below,
            ];
            let worst = errors.iter().fold(0.0_f64, |worst, error| worst.max(error.abs()));
            worst_of_all = worst_of_all.max(worst);
            if cells == 256 {
                assert!(worst < 1e-6, "E1/E2 = {ratio}: {errors:?}");
            }
        }
        println!("axis stresses under Hertz pressure, {cells} cells: {worst_of_all:.1e} of p0");
    }
}

#[test]
fn homogeneous_axis_stresses_follow_hertz_and_the_sliding_sphere() {
    let cells = 256_usize;
    let spacing = 2.2 / cells as f64;
    let grid = SurfaceGrid::new([cells; 2], [spacing; 2]).unwrap();
    let pressure = hertz(cells, spacing);
    let zero = Array2::zeros((cells, cells));
    let nu = 0.3;
    let half_space = body(&[], Some((1.0, nu)));
    let mut worst = 0.0_f64;
    for s in [0.25, 0.480_864_485_3, 1.0, 3.0] {
        let point = DepthPoint { depth: s, layer: 0 };
        let normal = stress(&half_space, point, &grid, Periodicity::NONE, &pressure, None);
        let q = 1.0 + s * s;
        let zz = -1.0 / q;
        let rr = -((1.0 + nu) * (1.0 - s * (1.0 / s).atan()) - 0.5 / q);
        worst = worst.max((on_axis(&normal.components[2]) - zz).abs());
        worst = worst.max((on_axis(&normal.components[0]) - rr).abs());
        let sliding = stress(&half_space, point, &grid, Periodicity::NONE, &zero, Some([&pressure, &zero]));
        // axis shear of Hertz-distributed shear q0 along x (negative: the upper body pulls the surface along +x)
        let xz = -(1.0 - 1.5 * s * (1.0 / s).atan() + 0.5 * s * s / q);
        worst = worst.max((on_axis(&sliding.components[4]) - xz).abs());
        if s == 0.480_864_485_3 {
            let von_mises = (on_axis(&normal.components[2]) - on_axis(&normal.components[0])).abs();
            assert!((von_mises - 0.620_041_003_9).abs() < 1e-6);
        }
    }
    println!("homogeneous axis stresses, {cells} cells: {worst:.1e} of p0");
    assert!(worst < 1e-6, "{worst:e}");
}

#[test]
fn surface_stresses_of_the_sliding_sphere() {
    // r <= a, z = 0: sxx = -(pi/8)(4 + nu) q0 x/a, syy = -(3 pi nu/8) q0 x/a, sxy = -(pi/8)(2 - nu) q0 y/a
    let nu = 0.3;
    let half_space = body(&[], Some((1.0, nu)));
    let by_cells = |cells: usize| {
        let spacing = 2.2 / cells as f64;
        let grid = SurfaceGrid::new([cells; 2], [spacing; 2]).unwrap();
        let shear = hertz(cells, spacing);
        let zero = Array2::zeros((cells, cells));
        let point = DepthPoint { depth: 0.0, layer: 0 };
        let field = stress(&half_space, point, &grid, Periodicity::NONE, &zero, Some([&shear, &zero]));
        assert!(field.components[2].iter().all(|zz| zz.abs() < 1e-13));
        assert!(field.components[4].iter().zip(&shear).all(|(xz, q)| (xz + q).abs() < 1e-13));
        (grid, field)
    };
    // a third of the cell: every centre of the coarse grid is one of the fine grid
    let ((grid, coarse), (_, fine)) = (by_cells(44), by_cells(132));
    let mut worst = [0.0_f64; 3];
    for i in 0..44 {
        for j in 0..44 {
            let (x, y) = (grid.centre(0, i), grid.centre(1, j));
            if x.hypot(y) > 0.7 {
                continue;
            }
            let exact = [
                (0, -PI / 8.0 * (4.0 + nu) * x),
                (1, -3.0 * PI * nu / 8.0 * x),
                (3, -PI / 8.0 * (2.0 - nu) * y),
            ];
            for (component, exact) in exact {
                let one = coarse.components[component][[i, j]];
                let third = fine.components[component][[3 * i + 1, 3 * j + 1]];
                // in the surface itself the slope of the traction within the cell is felt: first order in the cell
                let limit = 1.5 * third - 0.5 * one;
                for (worst, found) in worst.iter_mut().zip([one, third, limit]) {
                    *worst = worst.max((found - exact).abs());
                }
            }
        }
    }
    println!(
        "surface stresses of the sliding sphere, r < 0.7 a, 44 and 132 cells, extrapolated: {worst:?} of q0"
    );
    assert!(worst[1] < 0.4 * worst[0] && worst[2] < 1e-4, "{worst:?}");
}

#[test]
fn tractions_are_continuous_across_interfaces_at_every_contrast_and_thickness() {
    let cells = [24, 20];
    let pressure = random_field(1, cells);
    let (x, y) = (random_field(2, cells), random_field(3, cells));
    let mut worst_of_all = 0.0_f64;
    for contrast in [1e-4, 1e-2, 0.5, 2.0, 1e2, 1e4] {
        for thickness in [0.01, 0.3, 10.0, 100.0] {
            // contact radius 1, thickness in contact radii
            let half_space = body(&[(contrast, 0.25, thickness)], Some((1.0, 0.35)));
            let grid = SurfaceGrid::new(cells, [0.1, 0.12]).unwrap();
            for periodic in [false, true].map(Periodicity::Both) {
                let [above, below] = [0, 1].map(|layer| {
                    let point = DepthPoint { depth: thickness, layer };
                    stress(&half_space, point, &grid, periodic, &pressure, Some([&x, &y]))
                });
                let finite = above.components.iter().chain(&below.components);
                assert!(finite.flatten().all(|value| value.is_finite()));
                for component in [2, 4, 5] {
                    for (one, other) in above.components[component].iter().zip(&below.components[component]) {
                        worst_of_all = worst_of_all.max((one - other).abs());
                    }
                }
            }
        }
    }
    println!("jump of tractions across interfaces, contrasts 1e-4..1e4: {worst_of_all:.1e}");
    assert!(worst_of_all < 1e-10, "{worst_of_all:e}");
}

#[test]
fn a_periodic_scene_carries_its_mean_and_meets_free_space_in_wide_periods() {
    let half_space = body(&[(3.0, 0.3, 0.2)], Some((1.0, 0.3)));
    let mut differences = Vec::new();
    for cells in [64_usize, 128] {
        let grid = SurfaceGrid::new([cells; 2], [0.05; 2]).unwrap();
        let load = Array2::from_shape_fn((cells, cells), |(i, j)| {
            let square = grid.centre(0, i).powi(2) + grid.centre(1, j).powi(2);
            (-6.0 * square).exp()
        });
        let zero = Array2::zeros((cells, cells));
        let point = depth_points(&half_space, &[0.3]).unwrap()[0];
        let all = |periodic| stress(&half_space, point, &grid, periodic, &load, Some([&load, &zero]));
        let (repeating, alone) = (all(Periodicity::BOTH), all(Periodicity::NONE));
        let sum = |field: &Array2<f64>| field.iter().sum::<f64>() / (cells * cells) as f64;
        let mean = sum(&load);
        assert!((sum(&repeating.components[2]) + mean).abs() < 1e-13);
        assert!((sum(&repeating.components[4]) + mean).abs() < 1e-13);
        let middle = cells / 2;
        let found = [0, 2, 4].map(|component| {
            (repeating.components[component][[middle, middle]]
                - alone.components[component][[middle, middle]])
            .abs()
        });
        differences.push(found.iter().fold(0.0_f64, |worst, error| worst.max(*error)));
    }
    println!("periodic against free space, periods 3.2 and 6.4: {differences:?}");
    // the images' far field falls with the square of the period
    assert!(differences[1] < 0.3 * differences[0] && differences[1] < 2e-2, "{differences:?}");
}

/// A loaded cell against the nine cells that tile it: another table, another disc, other Gauss orders. Contact radius 1 is
/// ten small cells.
#[test]
fn a_cell_answers_like_the_cells_that_tile_it_at_every_contrast_and_depth() {
    let coarse = SurfaceGrid::new([8, 8], [0.3; 2]).unwrap();
    let fine = SurfaceGrid::new([24, 24], [0.1; 2]).unwrap();
    let load = |n: usize, from: usize, count: usize| {
        Array2::from_shape_fn((n, n), |(i, j)| {
            let within = |index: usize| (from..from + count).contains(&index);
            if within(i) && within(j) { 1.0 } else { 0.0 }
        })
    };
    let (one, nine) = (load(8, 2, 1), load(24, 6, 3));
    println!("largest difference over the largest stress there, thickness 1:");
    println!("contrast \\ depth    0        0.01     0.1      0.9      1 below  1.1      10       100");
    for contrast in [1e-4, 1e-2, 0.5, 2.0, 1e2, 1e4] {
        let half_space = body(&[(contrast, 0.25, 1.0)], Some((1.0, 0.35)));
        let mut line = format!("{contrast:<16e}");
        for (depth, layer) in
            [(0.0, 0), (0.01, 0), (0.1, 0), (0.9, 0), (1.0, 1), (1.1, 1), (10.0, 1), (100.0, 1)]
        {
            let point = DepthPoint { depth, layer };
            let by = |grid: &SurfaceGrid, load: &Array2<f64>| {
                stress(&half_space, point, grid, Periodicity::NONE, load, Some([load, load]))
            };
            let (whole, parts) = (by(&coarse, &one), by(&fine, &nine));
            let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
            for component in 0..6 {
                for i in 0..8 {
                    for j in 0..8 {
                        let found = whole.components[component][[i, j]];
                        let sum = parts.components[component][[3 * i + 1, 3 * j + 1]];
                        worst = worst.max((found - sum).abs());
                        largest = largest.max(found.abs());
                    }
                }
            }
            let _ = write!(line, "  {:.1e}", worst / largest);
            // of the traction on the cell
            assert!(worst < 1e-10, "contrast {contrast:e} depth {depth}: {worst:e} of {largest:e}");
        }
        println!("{line}");
    }
}

/// An operator that is moved works in memory that other depths have written, one or several threads at a time.
#[test]
fn a_moved_operator_gives_the_bits_of_a_new_one_in_any_number_of_threads() {
    let half_space = body(&[(5.0, 0.25, 0.4)], Some((1.0, 0.3)));
    let grid = SurfaceGrid::new([40, 40], [0.05; 2]).unwrap();
    let fields = [1, 2, 3].map(|seed| random_field(seed, [40, 40]));
    let shear = || Some([fields[1].view(), fields[2].view()]);
    let points = depth_points(&half_space, &[0.0, 0.3, 0.9, 0.4, 0.1]).unwrap();
    let fresh: Vec<StressField> = points
        .iter()
        .map(|&point| {
            stress(&half_space, point, &grid, Periodicity::NONE, &fields[0], Some([&fields[1], &fields[2]]))
        })
        .collect();
    for threads in [1, 2, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut operator =
                DepthOperator::new(&half_space, points[0], &grid, Periodicity::NONE, true, true).unwrap();
            let mut field = StressField::zeros([40, 40]);
            for (point, fresh) in points.iter().zip(&fresh) {
                operator.move_to(*point).unwrap();
                operator.stress_into(&Tractions { pressure: fields[0].view(), shear: shear() }, &mut field);
                assert_eq!(operator.point(), *point);
                assert!(&field == fresh, "{threads} threads, {point:?}");
            }
        });
    }
}

/// The tension behind a sliding sphere has a cusp at the rim: `(1 - 2 nu)/3 + pi mu (4 + nu)/8` of the largest pressure (Hamilton 1983).
#[test]
fn the_tension_behind_a_slider_is_found_at_the_rim() {
    let mut finest = Vec::new();
    // grids that end two, three and many cells beyond the rim, which falls anywhere between their cells
    for (cells, size) in [
        (48, 2.2),
        (50, 2.2),
        (48, 2.3),
        (64, 2.4),
        (64, 2.6),
        (64, 3.0),
        (72, 3.0),
        (80, 3.0),
        (88, 2.2),
        (128, 3.0),
        (144, 3.0),
        (256, 3.0),
    ] {
        for (poisson, friction) in [(0.3, 0.25), (0.45, 0.9)] {
            let [at_centres, at_rim, place] = tension_behind_a_slider(cells, size, poisson, friction);
            let side = size / cells as f64;
            println!(
                "{cells} cells on {size}, nu {poisson}, mu {friction}: {at_centres:+.3} at centres, {at_rim:+.4} at the rim, x = {place:.4}"
            );
            // Shear along +x on the body pulls at its rear, where x is negative. The rim is known to a fifth of a cell, and that of a row
            // of cells beside the middle lies less than half a cell nearer. Along the rim the tension falls with the cosine of the angle: what is
            // known to two per cent may be the largest that far from the middle.
            assert!((place.abs() - 1.0).abs() < 0.6 * side + 0.02, "{cells}: {place}");
            assert!(at_centres < -0.05, "the cusp lies between the centres");
            // 21 cells in the radius: two per cent; less from there on.
            assert!(at_rim.abs() < 0.02, "{cells} {size} {poisson}: {at_rim}");
            if cells == 256 {
                finest.push(at_rim.abs());
            }
        }
    }
    assert!(finest.iter().all(|error| *error < 0.015), "{finest:?}");
}

/// The same behind a sliding cylinder: `2 mu p0`, with a cusp whose root is twice as steep. On every third grid the rim lies a sixth of a
/// cell before the centre of the last cell, which carries next to nothing.
#[test]
fn the_tension_behind_a_sliding_cylinder_is_found_wherever_its_rim_falls() {
    for cells in [64, 72, 80, 96, 112, 128, 144, 160, 192, 208, 256] {
        let (poisson, friction, size) = (0.3, 0.5, 3.0);
        // a = sqrt(4 P R/(pi E*)) = 1
        let (radius, modulus) = (10.0, 0.5 / (1.0 - poisson * poisson));
        let force = PI * modulus / (4.0 * radius);
        let both = format!("substrate = {{ young = 1.0, poisson = {poisson} }}");
        let history = solved(&format!(
            "[grid]\ncells = {cells}\nsize = {size:?}\n[upper]\n{both}\n[lower]\n{both}\n[profile.cylinder]\nradius = {radius:?}\n\
             axis = \"y\"\n[friction]\ncoefficient = {friction}\n[[load]]\nnormal_force = {force:?}\nincrements = 1\n[[load]]\n\
             shift = [0.3, 0.0]\nincrements = 1\n[solver]\ntolerance = 1e-9\n{}",
            keeping(1)
        ));
        assert_eq!(history.steps[1].stick_cells, 0);
        let kept = &history.fields[1];
        let (pressure, shear) = (kept.pressure.as_ref().unwrap(), &kept.shear.as_ref().unwrap()[0]);
        let none = Array2::zeros((cells, 1));
        let surface = DepthPoint { depth: 0.0, layer: 0 };
        let field = stress(
            &body(&[], Some((1.0, poisson))),
            surface,
            &history.grid,
            Periodicity::NONE,
            pressure,
            Some([shear, &none]),
        );
        let mut found = Vec::new();
        look(&mut found, &field, surface, false, 0, Some(pressure));
        let tension = found.iter().find(|largest| largest.measure == Measure::Tension).unwrap();
        let peak = 2.0 * force / PI;
        let error = tension.value / (2.0 * friction * peak) - 1.0;
        println!("{cells} cells: {error:+.4} at {:?}", tension.off);
        // 21 cells in the half-width and more: first order in the cell.
        assert!(error.abs() < 0.03 * 64.0 / cells as f64 + 0.005, "{cells}: {error}");
        assert!(tension.off[0] != 0.0, "{cells}: at the centre of a cell");
    }
}

/// Errors of the largest tension of the cells and of the rims behind a sliding sphere of contact radius 1, relative, and the place of the
/// latter along the slide.
fn tension_behind_a_slider(cells: usize, size: f64, poisson: f64, friction: f64) -> [f64; 3] {
    let exact = (1.0 - 2.0 * poisson) / 3.0 + PI * friction * (4.0 + poisson) / 8.0;
    let sphere = Sphere { cells, size, poisson, identical: true, friction, ..Sphere::default() };
    let slide = "[[load]]\nshift = [0.15, 0.0]\nincrements = 1\n";
    let history = solved(&(sphere.pressed(1.0, 1, "linear") + slide + &keeping(1)));
    assert_eq!(history.steps[1].stick_cells, 0);
    let (grid, peak) = (history.grid, sphere.max_pressure());
    let kept = &history.fields[1];
    let pressure = kept.pressure.as_ref().unwrap().mapv(|p| p / peak);
    let shear = kept.shear.as_ref().unwrap()[0].mapv(|q| q / peak);
    let none = Array2::zeros((cells, cells));
    let surface = DepthPoint { depth: 0.0, layer: 0 };
    let half_space = body(&[], Some((1.0, poisson)));
    let field = stress(&half_space, surface, &grid, Periodicity::NONE, &pressure, Some([&shear, &none]));
    let largest = |pressure: Option<&Array2<f64>>| {
        let mut found = Vec::new();
        look(&mut found, &field, surface, false, 0, pressure);
        *found.iter().find(|largest| largest.measure == Measure::Tension).unwrap()
    };
    let (at_centres, at_rim) = (largest(None), largest(Some(&pressure)));
    let place = grid.centre(0, at_rim.cell[0]) + at_rim.off[0] * grid.spacing()[0];
    [at_centres.value / exact - 1.0, at_rim.value / exact - 1.0, place]
}
