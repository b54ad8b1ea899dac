use super::{Axis, Shape};
use crate::case::check::tests::{BALL, read, refused};

const SPHERE: &str = "[profile.sphere]\nradius = 100.0";

fn shapes(profile: &str) -> Vec<Shape> {
    read(BALL, &[(SPHERE, profile), ("[3.0, 3.0]", "[3.0, 3.0]\nperiodic = true")]).profile.shapes
}

#[test]
fn every_shape_is_read_as_it_is_written() {
    for (profile, shape) in [
        ("sphere]\nradius = 7.0", Shape::Sphere { radius: 7.0 }),
        ("ellipsoid]\nradius_x = 7.0\nradius_y = 8.0", Shape::Ellipsoid { radius_x: 7.0, radius_y: 8.0 }),
        (
            "cylinder]\naxis = \"x\"\nradius = 7.0",
            Shape::Cylinder { radius: 7.0, axis: Axis::X, length: None },
        ),
        (
            "cylinder]\naxis = \"y\"\nradius = 7.0\nlength = 2.0",
            Shape::Cylinder { radius: 7.0, axis: Axis::Y, length: Some(2.0) },
        ),
        (
            "rounded_punch]\nflat_radius = 1.0\nedge_radius = 2.0",
            Shape::RoundedPunch { flat_radius: 1.0, edge_radius: 2.0 },
        ),
        ("flat_punch]\nradius = 1.0", Shape::FlatPunch { radius: 1.0 }),
        ("cone]\nslope = 0.25", Shape::Cone { slope: 0.25 }),
        (
            "wave]\namplitude = 0.5\nwavelength_x = 1.5",
            Shape::Wave { amplitude: 0.5, wavelengths: [Some(1.5), None] },
        ),
        (
            "wave]\namplitude = 0.5\nwavelength_y = 1.5",
            Shape::Wave { amplitude: 0.5, wavelengths: [None, Some(1.5)] },
        ),
    ] {
        assert_eq!(shapes(&format!("[profile.{profile}")), [shape]);
        // in the profile of a body, too; and two are one behind the other
        let both = format!("[upper.profile.{profile}\n[lower.profile.{profile}");
        assert_eq!(shapes(&both), [shape, shape]);
    }
}

#[test]
fn lengths_of_shapes_are_positive() {
    for value in ["0.0", "-7.0", "nan", "inf"] {
        for (profile, words) in [
            ("sphere]\nradius = ?", "profile.sphere.radius"),
            ("ellipsoid]\nradius_x = 1.0\nradius_y = ?", "profile.ellipsoid.radius_y"),
            ("cylinder]\naxis = \"x\"\nradius = ?", "profile.cylinder.radius"),
            ("cylinder]\naxis = \"x\"\nradius = 1.0\nlength = ?", "profile.cylinder.length"),
            ("rounded_punch]\nflat_radius = 1.0\nedge_radius = ?", "profile.rounded_punch.edge_radius"),
            ("flat_punch]\nradius = ?", "profile.flat_punch.radius"),
            ("cone]\nslope = ?", "profile.cone.slope"),
            ("wave]\namplitude = ?\nwavelength_x = 1.5", "profile.wave.amplitude"),
            ("wave]\namplitude = 1.0\nwavelength_x = 1.5\nwavelength_y = ?", "profile.wave.wavelength_y"),
            ("heights]\nvalues = [[1.0]]\nunit = ?", "profile.heights.unit"),
        ] {
            let profile = format!("[profile.{profile}").replace('?', value);
            let kind = if words.ends_with("slope") { "number" } else { "length" };
            let words = format!("{words} = {}", if value == "nan" { "NaN" } else { value });
            refused(
                BALL,
                &[(SPHERE, &profile)],
                &format!("{words}: must be a positive finite {kind}"),
                value,
            );
        }
    }
    let bare = "[profile.wave]\namplitude = 1.0\n";
    let text = BALL.replacen(SPHERE, bare, 1);
    assert!(
        crate::case::Case::from_toml(&text, "case.toml")
            .unwrap_err()
            .to_string()
            .contains("neither wavelength_x")
    );
}

#[test]
fn a_body_may_be_hollow_when_the_gap_still_opens() {
    let bodies = |lower: &str| format!("[upper.profile.sphere]\nradius = 1.0\n[lower.profile.{lower}");
    assert_eq!(
        shapes(&bodies("sphere]\nradius = -2.0")),
        [Shape::Sphere { radius: 1.0 }, Shape::Sphere { radius: -2.0 }]
    );
    // straight along one axis is open enough, flat along both is not
    assert_eq!(shapes(&bodies("ellipsoid]\nradius_x = -1.0\nradius_y = -2.0")).len(), 2);
    assert_eq!(shapes(&bodies("ellipsoid]\nradius_x = -2.0\nradius_y = -1.0")).len(), 2);
    for hollow in [
        "sphere]\nradius = -1.0",
        "sphere]\nradius = -0.5",
        "ellipsoid]\nradius_x = -0.8\nradius_y = -20.0",
        "ellipsoid]\nradius_x = -20.0\nradius_y = -0.8",
    ] {
        let error = crate::case::Case::from_toml(&BALL.replacen(SPHERE, &bodies(hollow), 1), "case.toml")
            .unwrap_err();
        assert!(error.to_string().contains("it must open away from the middle"), "{error}");
        assert_eq!(error.mistakes().len(), 1);
    }
    // one that is hollow by itself
    let alone = BALL.replacen(SPHERE, "[lower.profile.sphere]\nradius = -2.0", 1);
    let error = crate::case::Case::from_toml(&alone, "case.toml").unwrap_err();
    assert!(error.to_string().contains("it must open away from the middle"), "{error}");
    for wrong in ["0.0", "nan", "inf"] {
        refused(
            BALL,
            &[(SPHERE, &bodies(&format!("sphere]\nradius = {wrong}")))],
            "lower.profile.sphere",
            wrong,
        );
    }
    // the gap itself has no hollows
    refused(BALL, &[(SPHERE, "[profile.sphere]\nradius = -3.5")], "must be a positive finite length", "-3.5");
}

#[test]
fn something_has_a_shape() {
    let error = |text: String| crate::case::Case::from_toml(&text, "case.toml").unwrap_err().to_string();
    assert!(error(BALL.replacen(SPHERE, "", 1)).contains("nothing says what shape the bodies have"));
    assert!(error(BALL.replacen(SPHERE, "[profile]", 1)).contains("profile: empty"));
    assert!(error(BALL.replacen(SPHERE, "[upper.profile]", 1)).contains("upper.profile: empty"));
}

/// Depths below the highest point, of 4 by 5 cells; the height of a cell is `10 i + j`.
fn depths(words: &str, rows_along_y: bool) -> Vec<f64> {
    let (rows, columns) = if rows_along_y { (5, 4) } else { (4, 5) };
    let height = |row: usize, column: usize| if rows_along_y { 10 * column + row } else { 10 * row + column };
    let values: Vec<Vec<f64>> =
        (0..rows).map(|row| (0..columns).map(|column| height(row, column) as f64).collect()).collect();
    let profile = format!("[profile.heights]\nvalues = {values:?}\n{words}");
    let case = read(BALL, &[(SPHERE, &profile), ("[16, 32]", "[4, 5]")]);
    case.profile.heights[0].depths().iter().copied().collect()
}

#[test]
fn heights_are_surfaces_or_gaps_in_any_unit() {
    let cells = || (0..4).flat_map(|i| (0..5).map(move |j| f64::from(10 * i + j)));
    let below: Vec<f64> = cells().map(|height| 34.0 - height).collect();
    assert_eq!(depths("", false), below);
    assert_eq!(depths("of = \"surface\"\nrows = \"x\"", false), below);
    assert_eq!(depths("rows = \"y\"", true), below);
    let tenths: Vec<f64> = cells().map(|height| 34.0 * 0.5 - 0.5 * height).collect();
    assert_eq!(depths("unit = 0.5", false), tenths);
    // the lowest point of a gap touches first
    assert_eq!(depths("of = \"gap\"", false), cells().collect::<Vec<f64>>());
    assert_eq!(depths("detrend = \"mean\"", false), below);
    // a plane without its trend is flat, up to rounding of numbers of 34
    assert!(depths("detrend = \"plane\"", false).iter().all(|depth| depth.abs() < 1e-13));
}

#[test]
fn heights_that_are_none_are_refused() {
    let heights = |words: &str| format!("[profile.heights]\n{words}");
    let four = ("[16, 32]", "[4, 5]");
    for (words, message, place) in [
        ("values = [[1.0, 2.0], [3.0]]", "row 1 has 1 numbers, row 0 has 2", "[[1.0, 2.0], [3.0]]"),
        ("values = [[1.0, 2.0]]", "1 x 2 numbers, but the grid has 4 x 5 cells", "[[1.0, 2.0]]"),
        ("file = \"none.npy\"", "profile.heights.file = \"none.npy\"", "\"none.npy\""),
        ("file = \"none.npy\"\nvalues = [[1.0]]", "file and values, both at once", "[[1.0]]"),
    ] {
        refused(BALL, &[(SPHERE, &heights(words)), four], message, place);
    }
    let turned = [[1.0; 4]; 5];
    let text =
        BALL.replacen(SPHERE, &heights(&format!("values = {turned:?}")), 1).replacen(four.0, four.1, 1);
    let error = crate::case::Case::from_toml(&text, "case.toml").unwrap_err().to_string();
    assert!(error.contains("its rows seem to run along y"), "{error}");
    let other = text.replacen("[4, 5]", "[4, 6]", 1);
    let error = crate::case::Case::from_toml(&other, "case.toml").unwrap_err().to_string();
    assert!(error.contains("5 x 4 numbers") && !error.contains("seem to run along y"), "{error}");
    let of_body = format!("[lower.profile.heights]\nof = \"gap\"\nvalues = {:?}", [[1.0; 5]; 4]);
    refused(BALL, &[(SPHERE, &of_body), four], "a body has a surface, a gap lies between two", "\"gap\"");
    let missing = format!("values = {:?}", [[1.0; 5]; 4]).replacen("1.0", "nan", 1);
    let text = BALL.replacen(SPHERE, &heights(&missing), 1).replacen(four.0, four.1, 1);
    let error = crate::case::Case::from_toml(&text, "case.toml").unwrap_err().to_string();
    assert!(error.contains("must be finite"), "{error}");
}
