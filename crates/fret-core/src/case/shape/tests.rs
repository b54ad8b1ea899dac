use ndarray::Array2;

use super::{Axis, Shape};
use crate::case::check::tests::{BALL, read, refused};
use crate::case::{Attachments, Case, Scan};
use crate::model::Treatment;

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
        ("sphero_cone]\nradius = 3.0\nslope = 0.25", Shape::SpheroCone { radius: 3.0, slope: 0.25 }),
        (
            "worn_sphere]\nradius = 3.0\nflat_radius = 0.5",
            Shape::WornSphere { radius: 3.0, flat_radius: 0.5 },
        ),
        (
            "pyramid]\nindenter = \"vickers\"\nhalf_angle = 45.0",
            Shape::Pyramid { sides: 4, slope: 45.0_f64.to_radians().tan().recip() },
        ),
        (
            "rectangular_punch]\nlength_x = 1.0\nlength_y = 2.0",
            Shape::RectangularPunch { lengths: [1.0, 2.0], edge_radius: None },
        ),
        (
            "rectangular_punch]\nlength_x = 1.0\nlength_y = 2.0\nedge_radius = 3.0",
            Shape::RectangularPunch { lengths: [1.0, 2.0], edge_radius: Some(3.0) },
        ),
        (
            "crowned_roller]\nradius = 7.0\naxis = \"x\"\nlength = 2.0\ncrown_radius = 90.0",
            Shape::CrownedRoller {
                radius: 7.0,
                axis: Axis::X,
                length: 2.0,
                flat_length: 0.0,
                crown_radius: 90.0,
            },
        ),
        (
            "wave]\namplitude = 0.5\nwavelength_x = 1.5",
            Shape::Wave { amplitude: 0.5, wavelengths: [Some(1.5), None] },
        ),
        (
            "wave]\namplitude = 0.5\nwavelength_y = 1.5",
            Shape::Wave { amplitude: 0.5, wavelengths: [None, Some(1.5)] },
        ),
    ] {
        assert_eq!(shapes(&format!("[profile.{profile}")), std::slice::from_ref(&shape));
        // in the profile of a body, too; and two are one behind the other
        let both = format!("[upper.profile.{profile}\n[lower.profile.{profile}");
        assert_eq!(shapes(&both), [shape.clone(), shape]);
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

/// A case of 4 by 4 cells on 2 by 2, in mm, whose lower body has the heights of a file.
fn scanned(words: &str, file: &[u8], scan: Option<&Scan>) -> Result<Case, String> {
    let text = format!(
        "[units]\nlength = \"mm\"\nforce = \"N\"\n{}",
        BALL.replacen(SPHERE, &format!("[profile.heights]\nfile = \"scan\"\n{words}"), 1)
            .replacen("[16, 32]", "[4, 4]", 1)
            .replacen("[3.0, 3.0]", "[2.0, 2.0]", 1)
    );
    let bytes = |_: &str| Ok(file.to_vec());
    let read = |_: &str, channel: Option<&str>| {
        assert!(channel.is_none_or(|channel| channel == "Z"));
        scan.cloned().ok_or_else(|| "not known".to_owned())
    };
    let attachments = Attachments::files(&bytes).reading_scans(scan.is_some().then_some(&read));
    Case::from_toml_with(&text, "case.toml", attachments).map_err(|error| error.to_string())
}

fn treatment(case: &Case) -> Treatment {
    case.profile.heights[0].treatment().expect("a record").clone()
}

/// A ball of radius 50 um on 8 by 8 points of 2.5 mm, in um.
fn ball() -> Scan {
    let height = |i: usize, j: usize| {
        let at = |index: usize| (index as f64 - 3.5) * 312.5;
        -(at(i).powi(2) + at(j).powi(2)) / (2.0 * 50e3)
    };
    Scan {
        heights: Array2::from_shape_fn((8, 8), |(i, j)| height(i, j)),
        size: Some([2500.0, 2500.0]),
        places: None,
        unit: Some("um".to_owned()),
        read_by: "a test".to_owned(),
    }
}

#[test]
fn a_scan_carries_its_units_and_is_resampled_to_the_middle() {
    let case = scanned("resample = \"linear\"", b"\x00\x01", Some(&ball())).unwrap();
    let depths = case.profile.heights[0].depths();
    // the ball in mm at the cells, which are 0.5 mm wide, and the means over the cells of the linear surface: those lie below the
    // paraboloid by at most its sagitta over a spacing and a cell, (0.3125^2 + 0.5^2) / (8 R) along each axis
    for ((i, j), depth) in depths.indexed_iter() {
        let at = |index: usize| (index as f64 - 1.5) * 0.5;
        let right = (at(i).powi(2) + at(j).powi(2) - 2.0 * at(1).powi(2)) / 100.0;
        assert!((depth - right).abs() < 2.0 * 0.35 / 400.0, "{i} {j}: {depth} {right}");
    }
    assert!((depths[[0, 1]] - depths[[3, 2]]).abs() < 1e-15); // rounding
    let record = treatment(&case);
    assert_eq!((record.points, record.resample.as_deref(), record.holes), ([8, 8], Some("linear"), 0));
    assert_eq!(record.size, Some([2.5, 2.5]));
    assert_eq!(record.read_by.as_deref(), Some("a test"));
    // cut to points that are the cells: those themselves, in mm
    let cut = "cut = [[0.0, 1.25], [1.25, 2.5]]\nresample = \"none\"";
    let error = scanned(cut, b"\x00\x01", Some(&ball())).unwrap_err();
    assert!(error.contains("the scan is 1.25 x 1.25, and the grid 2 x 2"), "{error}");
}

#[test]
fn holes_are_refused_and_filled_on_request() {
    let mut scan = ball();
    let whole = scanned("resample = \"linear\"\nchannel = \"Z\"", b"\x00\x01", Some(&scan)).unwrap();
    scan.heights[[2, 5]] = f64::NAN;
    let error = scanned("resample = \"linear\"", b"\x00\x01", Some(&scan)).unwrap_err();
    assert!(error.contains("1 of 64 points have no measurement, the first at [2, 5]"), "{error}");
    assert!(error.contains("fill = \"harmonic\""), "{error}");
    let filled = scanned("fill = \"harmonic\"\nresample = \"linear\"", b"\x00\x01", Some(&scan)).unwrap();
    assert_eq!((treatment(&filled).holes, treatment(&filled).fill.as_deref()), (1, Some("harmonic")));
    // the mean of the four neighbours of a paraboloid lies below it by a spacing squared over 2 R in both directions together
    let below = 0.3125_f64.powi(2) / 50.0;
    let change = filled.profile.heights[0].depths() - whole.profile.heights[0].depths();
    assert!(change.iter().all(|change| (-1e-15..=below).contains(change)) && change.sum() > 0.0, "{change}");
}

#[test]
fn texts_have_holes_heads_and_marks() {
    let rows = |text: &str| {
        scanned("fill = \"harmonic\"", text.as_bytes(), None).map(|case| {
            case.profile.heights[0]
                .depths()
                .iter()
                .map(|depth| 4.0 - depth)
                .map(|height| (height * 1e6).round() / 1e6)
                .collect::<Vec<_>>()
        })
    };
    // one hole in a plane that rises along y: 1 2 3 4 in every row, whose mean of neighbours is the plane
    let right: Vec<f64> = (0..16).map(|cell| f64::from(cell % 4 + 1)).collect();
    for text in [
        "1 2 3 4\n1 nan 3 4\n1 2 3 4\n1 2 3 4\n",
        "Width 10 um\nHeights\n1 2 3 4\n1 No Data 3 4\n1 2 3 4\n1 2 3 4\n",
        "Z [um];;;\n1;2;3;4\n1;;3;4\n1;2;3;4\n1;2;3;4\n",
        "1\t2\t3\t4\n1\t\t3\t4\n1\t2\t3\t4\n1\t2\t3\t4\n",
        "1,0;2,0;3,0;4,0\n1,0;***;3,0;4,0\n1;2;3;4\n1;2;3;4\n",
        "1 2 3 4\n1 -32768 3 4\n1 2 3 4\n1 2 3 4\n",
    ] {
        assert_eq!(rows(text).unwrap(), right, "{text:?}");
    }
    // numbers that stand for no measurement: whatever is done to the heights, in a list of points too
    let marked = b"1 2 3 4\n1 -32768 3 4\n1 2 3 4\n1 2 3 4\n";
    let points: String = (0..16)
        .map(|k| {
            format!(
                "{} {} {}\n",
                0.5 * f64::from(k / 4),
                0.5 * f64::from(k % 4),
                if k == 5 { -9999.0 } else { 1.0 }
            )
        })
        .collect();
    for (words, text) in
        [("size = [2.0, 2.0]\nlong_cutoff = 0.8", &marked[..]), ("resample = \"linear\"", points.as_bytes())]
    {
        let error = scanned(words, text, None).unwrap_err();
        assert!(
            error.contains("1 of 16 points have no measurement, the first at [1, 1]"),
            "{words}: {error}"
        );
    }
    let one = format!("x [mm] y z [um]\n{points}");
    let error = scanned("fill = \"harmonic\"", one.as_bytes(), None).unwrap_err();
    assert!(error.contains("the unit of one coordinate and not that of the other"), "{error}");
    let filled = scanned("fill = \"harmonic\"", points.as_bytes(), None).unwrap();
    assert!(filled.profile.heights[0].depths().iter().all(|depth| depth.abs() < 1e-12));
    let lost = points.replacen("0.5 0.5 -9999", "nan 0.5 1", 1);
    let error = scanned("fill = \"harmonic\"", lost.as_bytes(), None).unwrap_err();
    assert!(error.contains("a point at a place that is no number"), "{error}");
    let error = scanned("", b"1 2 3 4\n1 nan 3 4\n1 2 3 4\n1 2 3 4\n", None).unwrap_err();
    assert!(error.contains("line 2, column 2") && error.contains("fill = \"harmonic\""), "{error}");
    let error = scanned("", b"1 x 3 4\n1 2 3 4\n", None).unwrap_err();
    assert!(error.contains("line 1, column 2: \"x\" is not a number"), "{error}");
}

#[test]
fn what_cannot_be_treated_is_told() {
    let mut bare = ball();
    bare.unit = None;
    let error = |words: &str, scan: Option<&Scan>| scanned(words, b"\x00\x01", scan).unwrap_err();
    for (words, scan, message) in [
        ("", None, "perhaps one of an instrument"),
        ("", None, "pip install 'fretting[instruments]'"),
        ("", Some(&ball()), "8 x 8 points on 2.5 x 2.5, but the grid has 4 x 4 cells"),
        ("unit = 1e-3", Some(&ball()), "unit: the file says it itself"),
        ("rows = \"y\"", Some(&ball()), "the file says itself how its points lie"),
        ("size = [1.0, 1.0]", Some(&ball()), "the file states the size itself"),
        ("", Some(&bare), "the file does not say in which unit"),
        ("unit = 1e-3\nfill = \"harmonic\"", Some(&bare), "8 x 8 points on 2.5 x 2.5"),
        (
            "unit = 1e-6\nresample = \"linear\"",
            Some(&bare),
            "the scan is 0.0025 x 0.0025, and the grid 2 x 2",
        ),
        ("cut = [[0.0, 3.0], [0.0, 1.0]]", Some(&ball()), "from 0 to 3 along x, of a scan of 0 to 2.5"),
        ("cut = [[0.0, 1.0]]", Some(&ball()), "1 pairs of from and to, wanted 2"),
        ("short_cutoff = 0.5\nlong_cutoff = 0.4", Some(&ball()), "short_cutoff is not below long_cutoff"),
        ("short_cutoff = -1.0", Some(&ball()), "must be a positive finite length"),
        ("resample = \"cubic\"", Some(&ball()), "cubic"),
    ] {
        assert!(error(words, scan).contains(message), "{words}: {}", error(words, scan));
    }
    let text = b"1 2 3 4\n1 2 3 4\n1 2 3 4\n1 2 3 5\n";
    for (words, message) in [
        ("short_cutoff = 1.0", "nothing says how large the scan is"),
        ("resample = \"linear\"", "nothing says how large the scan is"),
        ("channel = \"Z\"", "the file has numbers and no channels"),
        ("size = 2.0\nresample = \"linear\"", "of a surface two lengths"),
    ] {
        let error = scanned(words, text, None).unwrap_err();
        assert!(error.contains(message), "{words}: {error}");
    }
    assert!(scanned("size = [2.0, 2.0]\nlong_cutoff = 0.8", text, None).is_ok());
}

#[test]
fn heads_of_texts_carry_units_and_sizes() {
    let head = "# Width: 2000 um\n# Height: 2000 um\n# Value units: m\n";
    let text = format!("{head}0 0 0 0\n0 0 0 0\n0 0 0 0\n0 0 0 3e-6\n");
    let case = scanned("", text.as_bytes(), None).unwrap();
    assert_eq!(case.profile.heights[0].depths()[[0, 0]], 3e-3); // mm
    assert!(case.profile.heights[0].treatment().is_none());
    // a unit in the case goes before
    let given = scanned("unit = 1.0", text.as_bytes(), None).unwrap();
    assert_eq!(given.profile.heights[0].depths()[[0, 0]], 3e-6);
    let sized = scanned("long_cutoff = 1.0", text.as_bytes(), None).unwrap();
    assert_eq!(treatment(&sized).size, Some([2.0, 2.0]));
    let wrong = text.replace("units: m", "units: V");
    let error = scanned("", wrong.as_bytes(), None).unwrap_err();
    assert!(error.contains("say they are in \"V\"") && error.contains("unit = length"), "{error}");
}

/// A plane of 4 x 4 points, in a case in mm: coordinates in um and heights in nm, by every way that heads have units.
#[test]
fn heads_of_lists_of_points_carry_units() {
    for head in [
        "x_um;y_um;z_nm",
        "# X (microns); Y (microns); Height [nm]",
        "X_(µm);Y_(µm);Z_(nm)",
        "x;y;z\num;um;nm",
    ] {
        let rows: String = (0..16)
            .map(|k| (k / 4, k % 4))
            .map(|(i, j)| format!("{};{};{}\n", 500 * i + 250, 500 * j + 250, 100 * (3 * i + j)))
            .collect();
        let text = format!("{head}\n{rows}");
        for words in ["", "fill = \"harmonic\""] {
            let case = scanned(words, text.as_bytes(), None).unwrap();
            let depths = case.profile.heights[0].depths();
            // the highest point, 1200 nm, is 0: slopes of 300 and 100 nm a cell to rounding
            for ((i, j), depth) in depths.indexed_iter() {
                let right = 1e-4 * (12 - (3 * i + j)) as f64;
                assert!((depth - right).abs() < 1e-15, "{head}, {words}: {depth} for {right}");
            }
        }
        // a unit in the case goes before that of the heights
        let given = scanned("unit = 1.0", text.as_bytes(), None).unwrap();
        assert!((given.profile.heights[0].depths()[[0, 0]] - 1200.0).abs() < 1e-9);
        let wrong = text.replacen("nm", "kN", 1);
        let error = scanned("", wrong.as_bytes(), None).unwrap_err();
        assert!(error.contains("say they are in \"kN\""), "{error}");
    }
}

/// Texts that are an instrument's by their names are not taken for plain numbers anywhere: they state units in heads of their own.
#[test]
fn texts_of_instruments_are_read_by_their_reader_alone() {
    let text =
        BALL.replacen(SPHERE, "[profile.heights]\nfile = \"scan.HFM\"", 1).replacen("[16, 32]", "[4, 4]", 1);
    let bytes = |_: &str| Ok(b"1 2 3 4\n1 2 3 4\n1 2 3 4\n1 2 3 4\n".to_vec());
    let error = Case::from_toml_with(&text, "case.toml", Attachments::files(&bytes)).unwrap_err().to_string();
    assert!(error.contains("its name is that of an instrument's file"), "{error}");
    assert!(error.contains("pip install 'fretting[instruments]'"), "{error}");
}

/// Pairs of x and height at uneven places, in any order, with a slope of 2.
#[test]
fn uneven_pairs_lie_in_line_contacts() {
    let text = BALL
        .replacen(SPHERE, "[profile.heights]\nfile = \"scan.txt\"\nresample = \"linear\"", 1)
        .replacen("[16, 32]", "16", 1)
        .replacen("[3.0, 3.0]", "3.2", 1);
    let bytes = |_: &str| Ok(b"x;z\n1,5;3\n0;0\n0,2;0,4\n4;8\n3,1;6,2\n".to_vec());
    let case = Case::from_toml_with(&text, "case.toml", Attachments::files(&bytes)).unwrap();
    for (cell, depth) in case.profile.heights[0].depths().iter().enumerate() {
        assert!((depth - 0.4 * (15.0 - cell as f64)).abs() < 1e-13, "{cell} {depth}");
    }
    // a point without a measurement between points at uneven places has no neighbours at one distance
    for (words, message) in [
        ("", "1 of 5 points have no measurement"),
        ("fill = \"harmonic\"\n", "fill: the points of this line scan are not evenly spaced"),
    ] {
        let text = text.replacen("resample", &format!("{words}resample"), 1);
        let bytes = |_: &str| Ok(b"x;z\n1,5;3\n0;0\n0,2;-9999\n4;8\n3,1;6,2\n".to_vec());
        let error =
            Case::from_toml_with(&text, "case.toml", Attachments::files(&bytes)).unwrap_err().to_string();
        assert!(error.contains(message), "{error}");
    }
}

/// A line scan with uneven points is the same surface as one with even points between which it is linear.
#[test]
fn line_scans_lie_in_line_contacts() {
    let places = [0.0, 0.5, 0.6, 2.0, 3.7, 4.0];
    let text = BALL
        .replacen(SPHERE, "[profile.heights]\nfile = \"scan\"\nresample = \"linear\"", 1)
        .replacen("[16, 32]", "16", 1)
        .replacen("[3.0, 3.0]", "3.2", 1);
    let bytes = |_: &str| Ok(vec![0, 1]);
    let read = |_: &str, _: Option<&str>| {
        Ok(Scan {
            heights: Array2::from_shape_fn((6, 1), |(i, _)| 2.0 * places[i]),
            size: Some([4.0, 4.0]),
            places: Some(places.to_vec()),
            unit: Some("m".to_owned()),
            read_by: String::new(),
        })
    };
    let attachments = Attachments::files(&bytes).reading_scans(Some(&read));
    let case = Case::from_toml_with(&text, "case.toml", attachments).unwrap();
    let depths = case.profile.heights[0].depths();
    assert_eq!(depths.dim(), (16, 1));
    for (cell, depth) in depths.iter().enumerate() {
        assert!((depth - 0.4 * (15.0 - cell as f64)).abs() < 1e-13); // a slope of 2 over cells of 0.2
    }
}
