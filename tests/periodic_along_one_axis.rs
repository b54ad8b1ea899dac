//! Contacts that repeat along one axis: against line contacts, against single ones, against closed forms of rows and waves.

use std::f64::consts::PI;

use fret_core::history::History;
use fret_core::model::{Axis, Base, Coating, ElasticMaterial, HalfSpace, Periodicity, SurfaceGrid};
use fret_core::subsurface::{DepthOperator, DepthPoint, StressField, Tractions};
use fret_validation::limit::limit;
use fret_validation::run;
use ndarray::{Array2, s};

/// Euler's constant, and the sum of all `1/n^3`.
const EULER: f64 = 0.577_215_664_901_532_9;
const APERY: f64 = 1.202_056_903_159_594_3;

/// A case of one body of modulus 1 under a rigid one.
fn text(grid: &str, [coating, profile, friction]: [&str; 3], loads: &str) -> String {
    format!(
        "[grid]\n{grid}\n[upper]\nrigid = true\n[lower]\n{coating}substrate = {{ young = 1.0, poisson = 0.3 }}\n{profile}\n\
         [friction]\ncoefficient = {friction}\n[solver]\ntolerance = 1e-12\n[output]\nfields = [\"pressure\", \"shear\", \"zone\"]\n{loads}"
    )
}

const COATING: &str = "coatings = [{ thickness = 0.05, young = 4.0, poisson = 0.25 }]\n";

fn largest(field: &Array2<f64>) -> f64 {
    field.iter().fold(0.0, |most, value| most.max(value.abs()))
}

/// A cylinder that repeats along its axis is the line contact of the same cylinder: of each cell of a period, force and all else per unit
/// length. Pressed, pulled across and along, coated and coupled; whatever the period and the cells in it.
#[test]
fn a_cylinder_is_a_line_contact() {
    let cylinder = "[profile.cylinder]\nradius = 1.0\naxis = \"y\"";
    let loads = |length: f64| {
        format!(
            "[[load]]\nnormal_force = {:e}\nincrements = 2\n[[load]]\ntangential_force = [{:e}, {:e}]\nincrements = 2\n",
            0.01 * length,
            0.001 * length,
            0.0005 * length
        )
    };
    for coating in ["", COATING] {
        // so much that a part sticks while it is pressed: else nothing tells the shift
        let scene = [coating, cylinder, "0.6"];
        let line = text("cells = 60\nsize = 0.4\ndatum = 3.0", scene, &loads(1.0));
        let line = run(&line).unwrap();
        for (length, cells) in [(0.05, 6), (0.9, 8)] {
            let grid =
                format!("cells = [60, {cells}]\nsize = [0.4, {length}]\nperiodic = \"y\"\ndatum = 3.0");
            let found = run(&text(&grid, scene, &loads(length))).unwrap();
            for (found, exact) in found.steps.iter().zip(&line.steps) {
                // the tolerance of both runs
                let near = |found: f64, exact: f64, scale: f64| {
                    assert!((found - exact).abs() < 1e-9 * scale, "{length}: {found} {exact}");
                };
                near(found.normal_force / length, exact.normal_force, exact.normal_force);
                near(found.max_pressure, exact.max_pressure, exact.max_pressure);
                near(found.contact_area / length, exact.contact_area, exact.contact_area);
                near(found.approach, exact.approach, exact.approach);
                for axis in 0..2 {
                    near(found.shift[axis], exact.shift[axis], exact.approach);
                }
            }
            let (found, exact) = (&found.state, &line.state);
            for (found, exact) in [
                (&found.pressure, &exact.pressure),
                (&found.shear[0], &exact.shear[0]),
                (&found.shear[1], &exact.shear[1]),
            ] {
                let scale = largest(&exact.to_owned()).max(1e-3);
                for ((i, _), value) in found.indexed_iter() {
                    assert!((value - exact[[i, 0]]).abs() < 1e-8 * scale);
                }
            }
        }
    }
}

/// A ball in a row: pressed as one alone, plus what its neighbours do, `u = P/(pi E*) Sum 1/|r - n L|`: a constant, known relative to the
/// datum, and to the next order a quadratic form that makes the gap curve less or more.
fn row_of_balls(length: f64, size: f64) -> [History; 2] {
    let scene = ["", "[profile.sphere]\nradius = 1.0", "0.0"];
    let loads = "[[load]]\nnormal_force = 1e-3\nincrements = 1\n";
    let grid = |more: &str, width: f64, cells: usize| {
        format!("cells = [64, {cells}]\nsize = [{size:e}, {width:e}]\n{more}")
    };
    let along = 64.0 * length / size;
    [
        run(&text(&grid("periodic = \"y\"\ndatum = 7.0", length, along as usize), scene, loads)).unwrap(),
        run(&text(&grid("", size, 64), scene, loads)).unwrap(),
    ]
}

#[test]
fn balls_in_a_wide_row_feel_their_neighbours_as_points() {
    let (modulus, shear): (f64, f64) = (1.0 / 0.91, 1.0 / 2.6);
    let force: f64 = 1e-3;
    let radius = (0.75 * force / modulus).cbrt();
    let size = 3.0 * radius;
    for periods in [2.0, 4.0] {
        let length = periods * size;
        let [row, alone] = row_of_balls(length, size);
        let [row, alone] = [&row.steps[0], &alone.steps[0]];
        // largest pressure by the mean curvature to the power 2/3; the next order is (a/L)^5
        let curving = force * APERY / (PI * modulus * length.powi(3));
        let exact = 2.0 / 3.0 * curving;
        let found = row.max_pressure / alone.max_pressure - 1.0;
        assert!((found - exact).abs() < 0.06 * exact, "{periods}: {found} {exact}");
        // approach of a point load in a row less that of a line load at the datum, whose row is at the distance 2 L exp(-gamma)
        let datum: f64 = 7.0;
        let constant =
            0.7 * force / (PI * shear * length) * ((datum / (2.0 * length)).ln() + EULER - 1.0 / (2.0 * 0.7));
        let found = row.approach - alone.approach;
        // neighbours of finite size, and the curvature: (a/L)^2 of the next term
        let bound = 2.0 * radius * radius / (length * length) * force / (modulus * length);
        assert!((found - constant).abs() < bound, "{periods}: {found} {constant} {bound:e}");
    }
}

/// A ball's results to the tolerance of the runs, whichever axis repeats; pulled aslant, coated and coupled.
#[test]
fn the_axes_are_alike() {
    let loads = |[x, y]: [f64; 2]| {
        format!(
            "[[load]]\nnormal_force = 1e-3\nincrements = 2\n[[load]]\ntangential_force = [{x:e}, {y:e}]\nincrements = 2\n"
        )
    };
    let scene = [COATING, "[profile.ellipsoid]\nradius_x = RX\nradius_y = RY", "0.3"];
    let of = |cells: &str, size: &str, axis: &str, [rx, ry]: [&str; 2], pull: [f64; 2]| {
        let grid = format!("cells = {cells}\nsize = {size}\nperiodic = \"{axis}\"");
        run(&text(&grid, scene, &loads(pull)).replace("RX", rx).replace("RY", ry)).unwrap()
    };
    let y = of("[40, 28]", "[0.4, 0.28]", "y", ["1.0", "2.0"], [1e-4, 0.5e-4]);
    let x = of("[28, 40]", "[0.28, 0.4]", "x", ["2.0", "1.0"], [0.5e-4, 1e-4]);
    let scale = largest(&y.state.pressure);
    let near = |one: &Array2<f64>, other: &Array2<f64>| {
        for ((i, j), value) in one.indexed_iter() {
            assert!((value - other[[j, i]]).abs() < 1e-9 * scale, "({i}, {j})");
        }
    };
    near(&y.state.pressure, &x.state.pressure);
    near(&y.state.shear[0], &x.state.shear[1]);
    near(&y.state.shear[1], &x.state.shear[0]);
    assert!((y.state.approach - x.state.approach).abs() < 1e-10 * x.state.approach);
}

/// A cylinder with waves along it, long enough and with enough pressed in that the contact is full in the middle: there pressure is that of the
/// cylinder without waves plus that which flattens a wave, `C(k)^-1 A cos(k y)`, but for `exp(-k x)` from the edge of contact. In two
/// periods, whose middle is half a wave off, as in one.
#[test]
fn waves_along_a_cylinder_are_flattened_where_contact_is_full() {
    let (side, cells, amplitude) = (0.02, 8, 2e-5);
    let wave = side * f64::from(cells);
    let of = |periods: i32, waves: bool| {
        let length = wave * f64::from(periods);
        let grid = format!(
            "cells = [120, {}]\nsize = [{}, {length:e}]\nperiodic = \"y\"",
            cells * periods,
            120.0 * side
        );
        let cylinder = "[profile.cylinder]\nradius = 20.0\naxis = \"y\"";
        let waves = if waves {
            format!("{cylinder}\n[profile.wave]\namplitude = {amplitude:e}\nwavelength_y = {wave:e}")
        } else {
            cylinder.to_owned()
        };
        let loads = format!("[[load]]\nnormal_force = {:e}\nincrements = 1\n", 0.04 * length);
        run(&text(&grid, ["", &waves, "0.0"], &loads)).unwrap()
    };
    let [smooth, one, two] = [of(1, false), of(1, true), of(2, true)];
    // the displacement of a cosine whose values are those of cells: alternating in the aliases, by repeated means of partial sums
    let modulus = 1.0 / 0.91;
    let term = |l: i32| {
        let k = 2.0 * PI * (1.0 / wave + f64::from(l) / side);
        let half = 0.5 * k * side;
        2.0 / (modulus * k.abs()) * half.sin() / half
    };
    let mut sums = vec![term(0)];
    for l in 1..40 {
        sums.push(sums[l - 1] + term(l as i32) + term(-(l as i32)));
    }
    while sums.len() > 1 {
        sums = sums.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
    }
    let [smooth, one, two] = [&smooth, &one, &two].map(|history| &history.state.pressure);
    let mean = |i: usize| one.row(i).sum() / f64::from(cells);
    for i in [58, 59, 60] {
        let swing = (0..cells as usize).map(|j| one[[i, j]] - mean(i));
        let found = swing.enumerate().fold((0.0, 0.0), |(c, s), (j, p)| {
            let phase = 2.0 * PI * (j as f64 + 0.5) / f64::from(cells);
            (c + p * phase.cos() * 2.0 / f64::from(cells), s + p * phase.sin() * 2.0 / f64::from(cells))
        });
        let found = found.0.hypot(found.1);
        // contact ends three waves and more from the middle: exp(-2 pi 3) of what happens there
        let exact = amplitude / sums[0];
        assert!((found / exact - 1.0).abs() < 1e-5, "{i}: {found:e} {exact:e}");
        assert!((mean(i) / smooth[[i, 0]] - 1.0).abs() < 1e-3);
    }
    let scale = largest(one);
    for ((i, j), value) in two.indexed_iter() {
        assert!((value - one[[i, (j + 4) % cells as usize]]).abs() < 1e-8 * scale, "({i}, {j})");
    }
}

/// A flat of wavy profile whose body ends across the waves: in the middle the contact of a wave at the mean pressure there (Westergaard 1939,
/// J. Appl. Mech. 6, 49; Johnson 1985, *Contact Mechanics*, 13.2): `p0 = 2 p/sin(pi a/wave)`, `sin^2 = p/p*`, `p* = pi E* A/wave`.
#[test]
fn a_wavy_flat_touches_as_westergaard_says() {
    let (wave, cells, amplitude) = (0.5, 64, 1e-3);
    let grid = format!("cells = [48, {cells}]\nsize = [6.0, {wave}]\nperiodic = \"y\"\nbeyond = \"no body\"");
    let profile = format!("[profile.wave]\namplitude = {amplitude}\nwavelength_y = {wave}");
    let loads = "[[load]]\nnormal_force = 8e-3\nincrements = 1\n";
    let found = run(&text(&grid, ["", &profile, "0.0"], loads)).unwrap();
    let row = found.state.pressure.row(24);
    let mean = row.sum() / f64::from(cells);
    let full = PI / 0.91 * amplitude / wave;
    let sine = (mean / full).sqrt();
    assert!(sine > 0.5 && sine < 0.9, "{sine}: partial contact");
    let largest = row.iter().fold(0.0_f64, |most, pressure| most.max(*pressure));
    // a hundredth: the mean pressure changes across the waves, cells see the edge to a part of one
    assert!((largest / (2.0 * mean / sine) - 1.0).abs() < 0.01, "{largest} {}", 2.0 * mean / sine);
    let touching = row.iter().filter(|pressure| **pressure > 0.0).count() as f64 / f64::from(cells);
    assert!((touching - 2.0 / PI * sine.asin()).abs() < 1.5 / f64::from(cells), "{touching}");
}

/// Stresses below: those of tractions repeated over more and more periods on an infinite half-space, whose error is a series of odd powers of one
/// over their number. In the coating, at its surface, in the substrate; along either axis.
#[test]
fn stresses_below_are_those_of_tractions_repeated_without_end() {
    let material = |young, nu| ElasticMaterial::new(young, nu).unwrap();
    let coating = Coating::new(material(3.0, 0.25), 0.4).unwrap();
    let body = HalfSpace::new(vec![coating], Base::Elastic(material(1.0, 0.3))).unwrap();
    let (across, period, spacing) = (7, 5, [0.2, 0.25]);
    let loads = [1.0, 2.0, 3.0].map(|seed: f64| {
        Array2::from_shape_fn((across, period), |(i, j)| ((3 * i + 5 * j) as f64 * seed).sin() + 0.5 * seed)
    });
    let stress = |grid: &SurfaceGrid, point: DepthPoint, periodic: Periodicity, loads: &[Array2<f64>; 3]| {
        let mut operator = DepthOperator::new(&body, point, grid, periodic, true, false).unwrap();
        let [pressure, x, y] = loads.each_ref().map(|load| load.view());
        operator.stress(&Tractions { pressure, shear: Some([x, y]) })
    };
    let grid = SurfaceGrid::new([across, period], spacing).unwrap();
    for (depth, layer) in [(0.0, 0), (0.13, 0), (0.4, 1), (0.9, 1)] {
        let point = DepthPoint { depth, layer };
        let found: StressField = stress(&grid, point, Periodicity::Along(Axis::Y), &loads);
        let ends = [16, 32, 64, 128, 256, 512];
        let alone = ends.map(|images: usize| {
            let count = 2 * images + 1;
            let grid = SurfaceGrid::new([across, count * period], spacing).unwrap();
            let loads = loads
                .each_ref()
                .map(|load| Array2::from_shape_fn((across, count * period), |(i, j)| load[[i, j % period]]));
            let all = stress(&grid, point, Periodicity::NONE, &loads);
            let middle = images * period;
            all.components.map(|field| field.slice(s![.., middle..middle + period]).to_owned())
        });
        for component in 0..6 {
            for i in 0..across {
                for j in 0..period {
                    let partial = |end: usize| {
                        let number = ends.iter().position(|images| *images == end).unwrap();
                        alone[number][component][[i, j]]
                    };
                    let exact = limit(&ends, &[1, 2, 3, 4, 5], partial);
                    let value = found.components[component][[i, j]];
                    // what extrapolation leaves, of tractions up to 4
                    assert!((value - exact).abs() < 1e-9, "{depth} {component} ({i}, {j}): {value} {exact}");
                }
            }
        }
        // with the axes exchanged, components and shears exchanged
        let turned = SurfaceGrid::new([period, across], [spacing[1], spacing[0]]).unwrap();
        let [pressure, x, y] = loads.each_ref().map(|load| load.t().as_standard_layout().into_owned());
        let other = stress(&turned, point, Periodicity::Along(Axis::X), &[pressure, y, x]);
        for (component, partner) in [1, 0, 2, 3, 5, 4].into_iter().enumerate() {
            for ((i, j), value) in found.components[component].indexed_iter() {
                assert!((value - other.components[partner][[j, i]]).abs() < 1e-13);
            }
        }
    }
}
