use super::*;

/// A field of 5 rows that depends on the column.
fn columns(count: usize, of: impl Fn(f64) -> f64) -> Array2<f64> {
    Array2::from_shape_fn((5, count), |(_, j)| of(j as f64))
}

/// The field, and the same turned over along both axes and with its axes exchanged.
fn turned(field: &Array2<f64>) -> [Array2<f64>; 4] {
    let back = |field: &Array2<f64>| {
        let (nx, ny) = field.dim();
        Array2::from_shape_fn((nx, ny), |(i, j)| field[[nx - 1 - i, ny - 1 - j]])
    };
    let across = field.t().to_owned();
    [field.clone(), back(field), across.clone(), back(&across)]
}

#[test]
fn the_power_with_which_pressure_rises_is_read_off_its_edges() {
    for (power, expected) in
        [(1.0, 1.0), (1.25, 1.25), (1.5, 1.5), (1.9, 1.9), (2.0, 2.0), (0.7, 1.0), (2.6, 2.0)]
    {
        // Rows of a contact of other lengths, and more rows whose pressure does not rise from its edge in order: these do not count.
        let row = |i: usize, x: f64| {
            let rising = (5.3 + 0.1 * i as f64 - x).max(0.0);
            match (i % 5, x as usize) {
                (0, _) => libm::pow(rising, 1.0 / power),
                // Even up to its edge; higher at the edge; up and down; a single cell.
                (1, 0..=4) | (2 | 4, 5) => 1.0,
                (1 | 3, 5) | (2, 0..=3) => 0.5,
                (2, 4) => 0.8,
                (3, 0..=3) => 0.6,
                (3, 4) => 0.4,
                _ => 0.0,
            }
        };
        let pressure = Array2::from_shape_fn((15, 10), |(i, j)| row(i, j as f64));
        for (kind, pressure) in turned(&pressure).iter().enumerate() {
            // Without what neighbouring rows of another kind make of the other axis.
            let lone = |keep: usize| {
                Array2::from_shape_fn(pressure.dim(), |(i, j)| {
                    let row = if kind < 2 { i } else { j };
                    let row = if kind % 2 == 0 { row } else { 14 - row };
                    if row % 5 == keep || row % 5 == 0 { pressure[[i, j]] } else { 0.0 }
                })
            };
            for keep in 0..5 {
                let found = Rise::of(&lone(keep).view(), [Ends::Open; 2]).power;
                // Twenty halvings of the interval from 1 to 2.
                assert!((found - expected).abs() < 2e-6, "{power}, turned {kind}, {keep}: {found}");
            }
        }
    }
    assert_eq!(Rise::of(&Array2::zeros((4, 4)).view(), [Ends::Open; 2]), Rise::ROOT);
}

#[test]
fn levels_are_linear_in_the_distance_between_foundations_and_half_spaces() {
    for (power, of_gap, offset) in [(1.0, 1.0, 0.0), (1.5, 5.0 / 6.0, 0.012), (2.0, 2.0 / 3.0, 0.024)] {
        let rise = Rise { power, steeper: 1.0 };
        for distance in [0.3_f64, 1.0, 2.7] {
            let inside = rise.inside(distance.powf(1.0 / power));
            let outside = rise.outside(distance.powf(1.0 / of_gap));
            assert!((inside / distance - 1.0).abs() < 1e-14, "{power}: {inside} {distance}");
            assert!((outside / distance - 1.0).abs() < 1e-14, "{power}: {outside} {distance}");
        }
        assert!((rise.offset() - offset).abs() < 1e-16);
    }
}

/// Pressure and gap of half-spaces at a straight edge: the level is the distance to it, times a number, for two cells outside.
#[test]
fn the_level_goes_on_evenly_outside() {
    let edge = 4.3;
    let pressure = columns(9, |x| 3.0 * (edge - x).max(0.0).sqrt());
    let gap = columns(9, |x| 7.0 * (x - edge).max(0.0).powf(1.5));
    let expected = columns(9, |x| 9.0 * (edge - x.min(6.0)));
    for ((pressure, gap), expected) in turned(&pressure).iter().zip(turned(&gap)).zip(turned(&expected)) {
        let level = level_function(&pressure.view(), &gap.view()).unwrap();
        for (found, expected) in level.iter().zip(&expected) {
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
    }
    // Where a body has ended nothing is read off: such a cell lies as low as the lowest.
    let mut ended = gap.clone();
    ended[[2, 5]] = 1e3;
    let near = near_the_contact(&pressure.view(), [Ends::Open; 2]);
    let level = |gap: &Array2<f64>, beyond: f64| {
        level_of(Rise::ROOT, (&pressure.view(), &gap.view()), &near, beyond, [Ends::Open; 2])
    };
    let (level_of_ended, _) = level(&ended, 999.0).unwrap();
    for ((i, j), found) in level_of_ended.indexed_iter() {
        let expected = if (i, j) == (2, 5) { expected[[2, 6]] } else { expected[[i, j]] };
        assert!((found - expected).abs() < 1e-12, "{i} {j}: {found} {expected}");
    }
    for full in [columns(9, |_| 1.0), columns(9, |_| 0.0)] {
        assert_eq!(level_function(&full.view(), &gap.view()), None);
    }
    // All gaps too wide: no slope outside.
    assert_eq!(level(&gap, 1.0), None);
}

#[test]
fn cells_are_near_within_two_of_a_loaded_one() {
    for (i, j) in [(4, 5), (0, 0), (8, 10), (3, 10), (8, 1), (1, 0)] {
        let mut pressure = Array2::zeros((9, 11));
        pressure[[i, j]] = 1.0;
        let near = near_the_contact(&pressure.view(), [Ends::Open; 2]);
        let is_near = |cell: &usize| (cell / 11).abs_diff(i) <= 2 && (cell % 11).abs_diff(j) <= 2;
        assert_eq!(near, (0..99).filter(is_near).collect::<Vec<_>>(), "{i} {j}");
    }
}

#[test]
fn slopes_want_two_cells_on_both_sides() {
    let ratio = |fours: &[[f64; 4]]| {
        let mut slopes = Slopes::default();
        for four in fours {
            slopes.read(*four);
        }
        slopes.ratio()
    };
    assert_eq!(ratio(&[[5.0, 2.0, -1.0, -1.5]]), Some(6.0));
    assert_eq!(ratio(&[[-1.5, -1.0, 2.0, 5.0]]), Some(6.0));
    // The median of each side; the upper one of two.
    let three = [[5.0, 2.0, -1.0, -1.5], [9.0, 1.0, -1.0, -3.0], [5.0, 4.0, 0.0, -1.0]];
    assert_eq!(ratio(&three), Some(3.0));
    assert_eq!(ratio(&three[..2]), Some(4.0));
    for told_nothing in [
        [5.0, -2.0, -1.0, -1.5],
        [5.0, 4.0, 2.0, -1.5],
        [5.0, 4.0, 2.0, 1.5],
        [-5.0, -4.0, -2.0, -1.5],
        [5.0, 2.0, f64::NEG_INFINITY, -1.0],
        [5.0, 2.0, -1.0, f64::NEG_INFINITY],
        [2.0, 2.0, -1.0, -2.0],
        [3.0, 2.0, -1.0, -1.0],
    ] {
        assert_eq!(ratio(&[told_nothing]), None, "{told_nothing:?}");
    }
}

/// What a straight edge leaves of a cell: along the axes exactly, on the diagonal as far as quarters of a cell show it.
#[test]
fn a_cell_is_filled_up_to_its_edge() {
    let share = |level: &dyn Fn(f64, f64) -> f64, offset: f64| {
        filled(&from_fn(|place| level((place / 3) as f64 - 1.0, (place % 3) as f64 - 1.0)), offset)
    };
    for at in [-0.45, -0.2, 0.0, 0.1, 0.3, 0.47] {
        assert!((share(&|x, _| 3.0 * (at - x), 0.0) - (0.5 + at)).abs() < 1e-14);
        assert!((share(&|x, _| 0.2 * (x - at), 0.0) - (0.5 - at)).abs() < 1e-14);
        assert!((share(&|_, y| 5.0 * (at - y), 0.0) - (0.5 + at)).abs() < 1e-14);
        assert!((share(&|_, y| y - at, 0.0) - (0.5 - at)).abs() < 1e-14);
        // The edge lies farther out by the offset, as long as it is in the cell.
        assert!((share(&|x, _| at - x, 0.02) - (0.52 + at)).abs() < 1e-14);
        // x + y < 2 at: a corner is left out or in.
        let corner = |side: f64| 0.5 * side * side;
        let exact = if at < 0.0 { corner(1.0 + 2.0 * at) } else { 1.0 - corner(1.0 - 2.0 * at) };
        let found = share(&|x, y| 2.0 * at - x - y, 0.0);
        // Of a quarter cell cut askew up to 0.06 is miscounted, of seven of sixteen in part.
        assert!((found - exact).abs() < 0.02, "{at}: {found} {exact}");
    }
    assert_eq!(share(&|_, _| 1.0, 0.0), 1.0);
    assert_eq!(share(&|_, _| -1.0, 0.1), 0.0);
}

#[test]
fn areas_of_straight_strips_are_exact() {
    let edge = 4.3;
    // Half-spaces, whose zero line lies 0.024 cells inside; foundations.
    for (rise, gap_power, offset) in [(0.5, 1.5, 0.024), (1.0, 1.0, 0.0)] {
        let pressure = columns(9, |x| 3.0 * (edge - x).max(0.0).powf(rise));
        let gap = columns(9, |x| 7.0 * (x - edge).max(0.0).powf(gap_power));
        for (pressure, gap) in turned(&pressure).iter().zip(turned(&gap)) {
            let area = contact_cells(&pressure.view(), &gap.view(), f64::INFINITY, [Ends::Open; 2]);
            assert!((area - 5.0 * (edge + 0.5 + offset)).abs() < 1e-5, "{rise}: {area}");
        }
    }
    // A body that ends behind the seventh column: contact up to the border of its cells.
    let edge = 2.3;
    let pressure = columns(9, |x| if x < 6.5 { (x - edge).max(0.0).sqrt() } else { 0.0 });
    let gap = columns(9, |x| if x < 6.5 { (edge - x).max(0.0).powf(1.5) } else { 1e3 });
    for (pressure, gap) in turned(&pressure).iter().zip(turned(&gap)) {
        let area = contact_cells(&pressure.view(), &gap.view(), 999.0, [Ends::Open; 2]);
        assert!((area - 5.0 * (6.5 - edge + 0.024)).abs() < 1e-5, "{area}");
    }
    // Without an edge cells are counted.
    let full = columns(9, |_| 1.0);
    assert_eq!(
        contact_cells(&full.view(), &columns(9, |_| 0.0).view(), f64::INFINITY, [Ends::Open; 2]),
        45.0
    );
    assert_eq!(contact_cells(&columns(9, |_| 0.0).view(), &full.view(), f64::INFINITY, [Ends::Open; 2]), 0.0);
}

/// A round contact off the middles of the cells, whole and cut by the end of a body: to 0.05 cells along its edge.
#[test]
fn areas_of_discs_and_of_their_segments_are_near() {
    let (radius, middle) = (12.3_f64, [16.2_f64, 15.7_f64]);
    let ratio = |i: usize, j: usize| (i as f64 - middle[0]).hypot(j as f64 - middle[1]) / radius;
    // A sphere on a half-space (Johnson, Contact Mechanics, sec. 3.4, up to factors) and on a foundation.
    let pressures: [fn(f64) -> f64; 2] = [|r| (1.0 - r * r).max(0.0).sqrt(), |r| (1.0 - r * r).max(0.0)];
    let gaps: [fn(f64) -> f64; 2] = [
        |r| if r > 1.0 { (r * r - 2.0) * (1.0 / r).acos() + (r * r - 1.0).sqrt() } else { 0.0 },
        |r| (r * r - 1.0).max(0.0),
    ];
    for (rise, (of_pressure, of_gap)) in pressures.into_iter().zip(gaps).enumerate() {
        let pressure = Array2::from_shape_fn((33, 32), |(i, j)| of_pressure(ratio(i, j)));
        let gap = Array2::from_shape_fn((33, 32), |(i, j)| of_gap(ratio(i, j)));
        let area = contact_cells(&pressure.view(), &gap.view(), f64::INFINITY, [Ends::Open; 2]);
        let off = (area - std::f64::consts::PI * radius * radius) / (std::f64::consts::TAU * radius);
        println!("{rise}: {off:.3} cells");
        assert!(off.abs() < 0.05, "{rise}: {off}");
        // The body ends behind column 20, at 20.5.
        let ends = |field: &Array2<f64>, value: f64| {
            Array2::from_shape_fn((33, 32), |(i, j)| if j > 20 { value } else { field[[i, j]] })
        };
        let [cut, open] = [ends(&pressure, 0.0), ends(&gap, 1e3)];
        let chord = 20.5 - middle[1];
        let whole =
            radius * radius * (-chord / radius).acos() + chord * (radius * radius - chord * chord).sqrt();
        for (pressure, gap) in turned(&cut).iter().zip(turned(&open)) {
            let area = contact_cells(&pressure.view(), &gap.view(), 999.0, [Ends::Open; 2]);
            let off = (area - whole) / (std::f64::consts::TAU * radius);
            println!("{rise}, cut: {off:.3} cells");
            assert!(off.abs() < 0.05, "{rise}, cut: {off}");
        }
    }
}

#[test]
fn a_median_is_the_upper_of_two() {
    assert_eq!(median(&mut []), None);
    assert_eq!(median(&mut [3.0]), Some(3.0));
    assert_eq!(median(&mut [3.0, 1.0]), Some(3.0));
    assert_eq!(median(&mut [3.0, 1.0, 2.0]), Some(2.0));
}

/// Even pressure, pressure that rises to its edge (a punch), and hardly falling pressure over a gap that opens at once: cells are
/// counted, in all directions of the grid. Half-spaces of three cells' radius, the worst place of the edge, are not.
#[test]
fn pressure_that_ends_in_a_step_is_counted_by_cells() {
    let radius: f64 = 7.3;
    let disc = |of: &dyn Fn(f64) -> f64| {
        let at = |i: usize, j: usize| (i as f64 - 10.0).hypot(j as f64 - 10.0);
        let pressure =
            Array2::from_shape_fn((21, 21), |(i, j)| if at(i, j) < radius { of(at(i, j)) } else { 0.0 });
        let gap = Array2::from_shape_fn((21, 21), |(i, j)| 0.1 * (at(i, j) - radius).max(0.0));
        let cells = pressure.iter().filter(|p| **p > 0.0).count() as f64;
        (contact_cells(&pressure.view(), &gap.view(), f64::INFINITY, [Ends::Open; 2]), cells)
    };
    for of in [&|_: f64| 1.0_f64, &|r: f64| 1.0 - 0.001 * r, &|r: f64| 1.0 / (64.0 - r * r).sqrt()]
        as [&dyn Fn(f64) -> f64; 3]
    {
        let (found, cells) = disc(of);
        assert_eq!(found, cells);
    }
    let hertz = |r: f64| (radius * radius - r * r).sqrt();
    let (found, cells) = disc(&hertz);
    assert!(
        found != cells && (found / (std::f64::consts::PI * radius * radius) - 1.0).abs() < 0.02,
        "{found}"
    );
}

/// Under a sphere a foundation's pressure is a parabola: power and area are found of round contacts anywhere on the cells, whole or in front of
/// mirrors.
#[test]
fn areas_of_parabolas_are_met_on_few_cells() {
    for (radius, off) in [(5.3, [0.0, 0.0]), (6.1, [0.3, -0.2]), (8.4, [0.45, 0.1]), (15.2, [0.2, 0.3])] {
        let level = Array2::from_shape_fn((40, 40), |(i, j)| {
            let [x, y] = [i as f64 - 19.5 - off[0], j as f64 - 19.5 - off[1]];
            radius * radius - x * x - y * y
        });
        let [pressure, gap] = [1.0, -1.0].map(|sign| level.mapv(|level| f64::max(sign * level, 0.0)));
        let area = contact_cells(&pressure.view(), &gap.view(), f64::INFINITY, [Ends::Open; 2]);
        let error = (area / std::f64::consts::PI).sqrt() - radius;
        assert!(error.abs() < 0.01, "{radius}: {error}");
        if off == [0.0; 2] {
            let [pressure, gap] = [&pressure, &gap].map(|field| field.slice(ndarray::s![20.., 20..]));
            let quarter = contact_cells(&pressure, &gap, f64::INFINITY, [Ends::Mirror; 2]);
            assert!((4.0 * quarter / area - 1.0).abs() < 1e-12, "{area} {quarter}");
        }
    }
}

/// A period of uneven contacts that reach over its ends: its area is the same wherever the period is cut, since the same is read off it; where it
/// mirrors itself half of it has half of the area, the contacts at both mirrors with it.
#[test]
fn the_area_of_a_period_does_not_depend_on_where_it_is_cut() {
    let (nx, ny) = (24, 30);
    let wave = |cell: usize, cells: usize, waves: f64| {
        (std::f64::consts::TAU * waves * (cell as f64 + 0.5) / cells as f64).cos()
    };
    for depth in [-0.6, -0.1, 0.3, 0.9] {
        for odd in [0.0, 0.4] {
            let level = Array2::from_shape_fn((nx, ny), |(i, j)| {
                let sine =
                    |cell: usize, cells: usize| (std::f64::consts::TAU * cell as f64 / cells as f64).sin();
                let even =
                    wave(i, nx, 1.0) + 0.7 * wave(j, ny, 2.0) + 0.3 * wave(i, nx, 2.0) * wave(j, ny, 1.0);
                even + depth + odd * sine(i, nx) * sine(j, ny)
            });
            for (rise, gap_power) in [(0.5, 1.5), (1.0, 1.0)] {
                let pressure = level.mapv(|level| level.max(0.0).powf(rise));
                let gap = level.mapv(|level| (-level).max(0.0).powf(gap_power));
                let area = |from: [usize; 2], cells: [usize; 2], ends: Ends| {
                    let part = |field: &Array2<f64>| {
                        Array2::from_shape_fn(cells, |(i, j)| field[[(i + from[0]) % nx, (j + from[1]) % ny]])
                    };
                    contact_cells(&part(&pressure).view(), &part(&gap).view(), f64::INFINITY, [ends; 2])
                };
                let whole = area([0, 0], [nx, ny], Ends::Period);
                let by_cells = pressure.iter().filter(|pressure| **pressure > 0.0).count() as f64;
                assert!(whole != by_cells && (whole / by_cells - 1.0).abs() < 0.1, "{whole} {by_cells}");
                for from in [[1, 0], [0, 7], [5, 11], [12, 15], [23, 29]] {
                    let cut = area(from, [nx, ny], Ends::Period);
                    // the same cells summed in another order
                    assert!((cut / whole - 1.0).abs() < 1e-12, "{depth} {odd} {from:?}: {cut} {whole}");
                }
                if odd == 0.0 {
                    let quarter = area([0, 0], [nx / 2, ny / 2], Ends::Mirrors);
                    // images are the same but for the rounding of a cosine
                    assert!((4.0 * quarter / whole - 1.0).abs() < 1e-10, "{depth}: {quarter} {whole}");
                }
            }
        }
    }
}

/// Ellipses whose middles lie on both mirrors, of two to nine cells' radius, so that lines of few cells cross a mirror: the part in front
/// of the mirrors has its share of the area to the last digits, whatever rounding makes of the images.
#[test]
fn a_part_in_front_of_mirrors_has_its_share_of_the_area() {
    for step in 0..60 {
        let [a, b] = [2.0 + 0.117 * f64::from(step), 2.3 + 0.083 * f64::from(step)];
        let rounding = |i: usize, j: usize| 1.0 + 1e-9 * ((7 * i + 3 * j) % 11) as f64;
        let off = |i: usize, j: usize| ((i as f64 - 11.5) / a).powi(2) + ((j as f64 - 11.5) / b).powi(2);
        for power in [0.5, 0.8] {
            let pressure = Array2::from_shape_fn((24, 24), |(i, j)| {
                (1.0 - off(i, j)).max(0.0).powf(power) * rounding(i, j)
            });
            let gap = Array2::from_shape_fn((24, 24), |(i, j)| {
                (off(i, j) - 1.0).max(0.0).powf(1.5) * rounding(j, i)
            });
            let area = |[x, y]: [usize; 2]| {
                let part = |field: &Array2<f64>| field.slice(ndarray::s![x.., y..]).to_owned();
                let (pressure, gap) = (part(&pressure), part(&gap));
                let ends = [x, y].map(|first| Ends::of(first > 0, false));
                contact_cells(&pressure.view(), &gap.view(), f64::INFINITY, ends)
            };
            let whole = area([0, 0]);
            for (first, copies) in [([12, 0], 2.0), ([0, 12], 2.0), ([12, 12], 4.0)] {
                let part = copies * area(first);
                // pressures and gaps of images differ by up to 1e-8 of themselves
                assert!((part / whole - 1.0).abs() < 1e-7, "{a} {b} {power} {first:?}: {part} {whole}");
            }
        }
    }
}
