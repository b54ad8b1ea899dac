//! Line contacts in plane strain: cylinders against closed forms, against each other, and against periodic cases.

use fret_core::analytic::{CattaneoLine, EffectiveModuli, HertzLine, SlidingCylinder};
use fret_core::case::Case;
use fret_core::history::{History, KeptFields};
use fret_core::model::{ElasticMaterial, HalfSpace, Periodicity};
use fret_core::plan::Plan;
use fret_core::study::{ClosedForm, Quantity};
use fret_core::subsurface::largest::look;
use fret_core::subsurface::{EvenStress, LoadedSurface, Measure, depth_points, survey};
use fret_validation::run;

/// A cylinder of radius 1 on a half-space of modulus 1.
struct Cylinder {
    cells: usize,
    size: f64,
    poisson: f64,
    identical: bool,
    friction: f64,
    force: f64,
}

impl Cylinder {
    fn text(&self, grid: &str, loads: &str) -> String {
        let Self { poisson, friction, .. } = self;
        let body = format!("substrate = {{ young = 1.0, poisson = {poisson} }}");
        let upper = if self.identical { &body } else { "rigid = true" };
        format!(
            "[grid]\n{grid}\n[upper]\n{upper}\n[lower]\n{body}\n[profile.cylinder]\nradius = 1.0\naxis = \"y\"\n\
             [friction]\ncoefficient = {friction}\n[solver]\ntolerance = 1e-10\n[output]\nfields = [\"pressure\", \"shear\", \"zone\"]\n{loads}"
        )
    }

    fn run(&self, loads: &str) -> History {
        let grid = format!("cells = {}\nsize = {:e}", self.cells, self.size);
        run(&self.text(&grid, loads)).unwrap()
    }

    fn pressed(&self, increments: usize) -> String {
        format!("[[load]]\nnormal_force = {:e}\nincrements = {increments}\nramp = \"cubic\"\n", self.force)
    }

    fn moduli(&self) -> EffectiveModuli {
        let material = ElasticMaterial::new(1.0, self.poisson).unwrap();
        if self.identical {
            EffectiveModuli::of_pair(&material, &material)
        } else {
            EffectiveModuli::rigid_on(&material)
        }
    }

    fn hertz(&self) -> HertzLine {
        HertzLine::cylinder(1.0, self.force, self.moduli().normal).unwrap()
    }

    /// Coordinates of the cells' middles.
    fn places(&self) -> Vec<f64> {
        let width = self.size / self.cells as f64;
        (0..self.cells).map(|i| (i as f64 + 0.5) * width - 0.5 * self.size).collect()
    }
}

/// Bodies of one elasticity, with the contact over about 0.8 of the grid.
fn like_bodies(cells: usize) -> Cylinder {
    let cylinder = Cylinder { cells, size: 0.0, poisson: 0.3, identical: true, friction: 0.5, force: 1e-4 };
    Cylinder { size: 2.4 * cylinder.hertz().half_width, ..cylinder }
}

fn last(history: &History) -> &KeptFields {
    history.fields.last().unwrap()
}

/// `|found - exact|` over `|exact|`, in the mean.
fn apart(found: &[f64], exact: &[f64]) -> f64 {
    let difference: f64 = found.iter().zip(exact).map(|(found, exact)| (found - exact).abs()).sum();
    difference / exact.iter().map(|exact| exact.abs()).sum::<f64>()
}

#[test]
fn hertz_and_cattaneo_are_met_with_second_order() {
    let errors: Vec<[f64; 3]> = [128, 512]
        .into_iter()
        .map(|cells| {
            let cylinder = like_bodies(cells);
            let (hertz, force) = (cylinder.hertz(), 0.6 * 0.5 * cylinder.force);
            let pull = format!(
                "{}[[load]]\ntangential_force = [{force:e}, 0.0]\nincrements = 4\n",
                cylinder.pressed(1)
            );
            let history = cylinder.run(&pull);
            let exact = CattaneoLine::new(&hertz, 0.5, cylinder.moduli().normal, force, 0.0).unwrap();
            let places = cylinder.places();
            let end = history.steps.last().unwrap();
            let cell = cylinder.size / cells as f64;
            let stick = end.stick_cells as f64 * cell;
            assert!((stick - 2.0 * exact.stick_half_width).abs() < 2.0 * cell, "{stick}"); // a cell at either end
            assert!((end.contact_area - 2.0 * hertz.half_width).abs() < 0.4 * cell); // 0.15 cells at either end
            let kept = last(&history);
            let of = |formula: &dyn Fn(f64) -> f64| places.iter().map(|x| formula(*x)).collect::<Vec<f64>>();
            let field = |name: &str| kept.field(name).unwrap().iter().copied().collect::<Vec<f64>>();
            [
                (end.max_pressure / hertz.max_pressure - 1.0).abs(),
                apart(&field("pressure"), &of(&|x| hertz.pressure(x))),
                apart(&field("shear_x"), &of(&|x| exact.shear(x))),
            ]
        })
        .collect();
    // Root at the edge, met in one cell of n: errors of fields fall with n^-3/2, so by 8 from 128 to 512 cells; half of that is asked.
    let [coarse, fine] = [errors[0], errors[1]];
    assert!(coarse[0] < 5e-4 && fine[0] < 5e-5, "{coarse:?} {fine:?}");
    for field in [1, 2] {
        assert!(fine[field] < 1.5e-3 && fine[field] < coarse[field] / 4.0, "{coarse:?} {fine:?}");
    }
}

#[test]
fn approach_and_shift_are_relative_to_the_datum() {
    // Johnson (1985), 5.57, for one body relative to a point at the depth d: P (1 - nu^2)/(pi E) [2 log(2 d/a) - nu/(1 - nu)];
    // under a shear that sticks everywhere and is a Hertz shear: the tangential kernel differs in sign of the constant, 2 log(2d/a) + 1/(1-nu) + 1
    let cylinder = like_bodies(512);
    let cylinder = Cylinder { identical: false, friction: 0.0, ..cylinder };
    let a = cylinder.hertz().half_width;
    let cylinder = Cylinder { size: 2.4 * a, ..cylinder };
    for datum in [1.0, 30.0] {
        let grid = format!("cells = 512\nsize = {:e}\ndatum = {datum}", cylinder.size);
        let history = run(&cylinder.text(&grid, &cylinder.pressed(1))).unwrap();
        let (nu, found) = (cylinder.poisson, history.steps[0].approach);
        let exact = cylinder.force * (1.0 - nu * nu) / std::f64::consts::PI
            * (2.0 * (2.0 * datum / a).ln() - nu / (1.0 - nu));
        assert!((found / exact - 1.0).abs() < 2e-6, "{found} {exact}"); // the grid's error
    }
}

#[test]
fn a_pull_along_the_line_sticks_as_one_across_does() {
    // antiplane shear has the same logarithm: c = a sqrt(1 - Q/mu P), for any Poisson's ratio
    let cylinder = like_bodies(512);
    let force = 0.6 * 0.5 * cylinder.force;
    let pull =
        format!("{}[[load]]\ntangential_force = [0.0, {force:e}]\nincrements = 4\n", cylinder.pressed(1));
    let history = cylinder.run(&pull);
    let end = history.steps.last().unwrap();
    let cell = cylinder.size / 512.0;
    let exact = 2.0 * cylinder.hertz().half_width * 0.4_f64.sqrt();
    assert!((end.stick_cells as f64 * cell - exact).abs() < 2.0 * cell);
    assert!(last(&history).field("shear_x").unwrap().iter().all(|shear| *shear == 0.0));
}

#[test]
fn a_rigid_cylinder_slides_as_bufler_says() {
    for (poisson, friction) in [(0.0, 0.5), (0.3, 0.8)] {
        let cylinder = Cylinder { cells: 1024, size: 0.0, poisson, identical: false, friction, force: 1e-4 };
        let moduli = cylinder.moduli();
        let exact =
            SlidingCylinder::new(1.0, cylinder.force, moduli.normal, moduli.coupling, friction).unwrap();
        let cylinder = Cylinder { size: 2.5 * exact.half_width, ..cylinder };
        for sign in [1.0, -1.0] {
            let slide =
                format!("{}[[load]]\nshift = [{:e}, 0.0]\nincrements = 4\n", cylinder.pressed(1), sign * 0.1);
            let history = cylinder.run(&slide);
            let end = history.steps.last().unwrap();
            assert_eq!(end.stick_cells, 0);
            let pressure: Vec<f64> = last(&history).field("pressure").unwrap().iter().copied().collect();
            let places = cylinder.places();
            let contact = || places.iter().zip(&pressure).filter(|(_, p)| **p > 0.0).map(|(x, _)| *x);
            let cell = cylinder.size / 1024.0;
            let [low, high] =
                [contact().next().unwrap() - 0.5 * cell, contact().next_back().unwrap() + 0.5 * cell];
            let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
            // a cell of 1024 is 1.2e-3 of the half-width: both within that
            assert!((middle - sign * exact.offset).abs() < cell, "{middle} {}", exact.offset);
            assert!((half - exact.half_width).abs() < cell, "{half} {}", exact.half_width);
            assert!((0.5 * end.contact_area / exact.half_width - 1.0).abs() < 1e-3);
            assert!((end.max_pressure / exact.max_pressure - 1.0).abs() < 1e-3);
            let formula: Vec<f64> =
                places.iter().map(|x| exact.pressure(sign * (x - sign * exact.offset))).collect();
            let error = apart(&pressure, &formula);
            assert!(error < 1e-3, "nu {poisson}, mu {friction}: {error:.1e}"); // edges of other powers than the root's
        }
    }
}

#[test]
fn pressing_with_coupling_is_that_of_a_dense_program() {
    // a rigid cylinder pressed in 120 steps, by a dense program of 320 cells, good to 0.004: c/a, a/a_Hertz, tangential resultant of a
    // half over mu P/2, p(0)/p_Hertz
    for (poisson, stick, width, half, peak) in
        [(0.3, 0.686, 0.9765, 0.664, 1.079), (0.0, 0.178, 0.957, 0.906, 1.305)]
    {
        let cylinder =
            Cylinder { cells: 640, size: 0.0, poisson, identical: false, friction: 0.3, force: 1e-4 };
        let hertz = cylinder.hertz();
        let cylinder = Cylinder { size: 2.4 * hertz.half_width, ..cylinder };
        let history = cylinder.run(&cylinder.pressed(120));
        let end = history.steps.last().unwrap();
        let shear: Vec<f64> = last(&history).field("shear_x").unwrap().iter().copied().collect();
        let cell = cylinder.size / 640.0;
        let resultant: f64 = shear[..320].iter().sum::<f64>() * cell;
        let found = [
            end.stick_cells as f64 / end.contact_cells as f64,
            0.5 * end.contact_area / hertz.half_width,
            resultant.abs() / (0.5 * 0.3 * cylinder.force),
            end.max_pressure / hertz.max_pressure,
        ];
        for (found, exact) in found.into_iter().zip([stick, width, half, peak]) {
            assert!((found - exact).abs() < 6e-3, "nu {poisson}: {found} {exact}"); // theirs, and the increments' 2e-3
        }
    }
}

#[test]
fn a_long_period_comes_to_the_same() {
    // Between periodic neighbours at a distance L pressure and shear of elastically similar bodies differ by (a/L)^2, 1e-3 at 16 grids; the periodic
    // operator is the waves' own, not the cells', so that on the same cells both differ by their error: a quarter on four times
    // the cells (roots at the edges: 4^-3/2, and cells that change zone).
    let difference = |cells: usize| {
        let cylinder =
            Cylinder { cells, size: 0.0, poisson: 0.3, identical: true, friction: 0.3, force: 1e-4 };
        let cylinder = Cylinder { size: 3.0 * cylinder.hertz().half_width, ..cylinder };
        let coating = "coatings = [{ thickness = 0.01, young = 3.0, poisson = 0.25 }]\nsubstrate";
        let text = |grid: &str, unit: f64| {
            let (force, pull) = (cylinder.force * unit, 0.15 * cylinder.force * unit);
            let loads = format!(
                "[[load]]\nnormal_force = {force:e}\nincrements = 1\n[[load]]\ntangential_force = [{pull:e}, 0.0]\nincrements = 3\n"
            );
            cylinder.text(grid, &loads).replace("substrate", coating)
        };
        let line = run(&text(&format!("cells = {cells}\nsize = {:e}", cylinder.size), 1.0)).unwrap();
        let (width, size) = (cylinder.size / cells as f64, 16.0 * cylinder.size);
        let grid =
            format!("cells = [{}, 4]\nsize = [{size:e}, {:e}]\nperiodic = true", 16 * cells, 4.0 * width);
        let period = run(&text(&grid, 4.0 * width)).unwrap();
        let first = 15 * cells / 2;
        ["pressure", "shear_x"].map(|name| {
            let exact: Vec<f64> = last(&line).field(name).unwrap().iter().copied().collect();
            let field = last(&period).field(name).unwrap();
            let found: Vec<f64> = (first..first + cells).map(|i| field[[i, 1]]).collect();
            apart(&found, &exact)
        })
    };
    let [coarse, fine] = [96, 384].map(difference);
    for field in 0..2 {
        assert!(fine[field] < 2.5e-3 && coarse[field] > 2.5 * fine[field], "{coarse:?} {fine:?}");
    }
}

#[test]
fn other_units_change_nothing() {
    let text = |length: f64, modulus: f64| {
        let force = 1e-4 * length * modulus;
        format!(
            "[grid]\ncells = 200\nsize = {:e}\n[upper]\nrigid = true\n[lower]\ncoatings = [{{ thickness = {:e}, young = {:e}, poisson = 0.2 }}]\n\
             substrate = {{ young = {modulus:e}, poisson = 0.3 }}\n[profile.cylinder]\nradius = {length:e}\naxis = \"y\"\n\
             [friction]\ncoefficient = 0.4\n[[load]]\nnormal_force = {force:e}\nincrements = 3\n\
             [[load]]\ntangential_force = [{:e}, {:e}]\nincrements = 3\n",
            0.05 * length,
            0.01 * length,
            4.0 * modulus,
            0.2 * force,
            0.1 * force
        )
    };
    let one = run(&text(1.0, 1.0)).unwrap();
    let (length, modulus) = (2.0_f64.powi(-20), 2.0_f64.powi(40));
    let other = run(&text(length, modulus)).unwrap();
    for (a, b) in one.steps.iter().zip(&other.steps) {
        // the sides are decimals that round differently
        assert!((b.approach / length / a.approach - 1.0).abs() < 1e-7);
        assert!((b.max_pressure / modulus / a.max_pressure - 1.0).abs() < 1e-7);
        assert_eq!((a.stick_cells, a.contact_cells), (b.stick_cells, b.contact_cells));
    }
}

#[test]
fn what_has_no_meaning_in_a_line_contact_is_refused_with_its_place() {
    let good = like_bodies(64).text("cells = 64\nsize = 0.1", &like_bodies(64).pressed(1));
    assert!(Case::from_toml(&good, "case.toml").is_ok());
    for (from, to, words) in [
        ("size = 0.1", "size = [0.1, 0.1]", "a single number of cells, which makes a line contact"),
        ("cells = 64", "cells = [64, 64]", "one length, but two numbers of cells"),
        ("cells = 64", "cells = 3", "a line contact needs between 4 and"),
        ("size = 0.1", "size = -0.1", "must be a length between"),
        ("size = 0.1", "size = 0.1\nperiodic = true", "a line contact, which is not periodic"),
        ("size = 0.1", "size = 0.1\ndatum = 0.0", "grid.datum = 0.0: must lie between"),
        ("axis = \"y\"", "axis = \"x\"", "profile.cylinder, across y or with ends,"),
        ("axis = \"y\"", "axis = \"y\"\nlength = 1.0", "profile.cylinder, across y or with ends,"),
        (
            "cylinder]\nradius = 1.0\naxis = \"y\"",
            "sphere]\nradius = 1.0",
            "profile.sphere in a line contact",
        ),
        ("increments = 1", "twist = 0.1\nincrements = 1", "twist in a line contact: its strips cannot turn"),
    ] {
        let text = good.replacen(from, to, 1);
        assert_ne!(text, good, "{from}");
        let error = Case::from_toml(&text, "case.toml").unwrap_err();
        assert!(error.to_string().contains(words), "{to}: {error}");
        assert!(error.mistakes().iter().all(|mistake| error.place(mistake).is_some()), "{to}: {error}");
    }
    let three = good.replace("cells = 64\nsize = 0.1", "cells = [64, 64]\nsize = [0.1, 0.1]\ndatum = 1.0");
    let error = Case::from_toml(&three, "case.toml").unwrap_err();
    assert!(error.to_string().contains("only a line contact needs one"), "{error}");
}

#[test]
fn stress_under_a_sliding_cylinder_follows_muskhelishvili() {
    // Hertz pressure with shear mu p, full sliding of elastically similar bodies: Johnson (1985), 4.45 and 7.2, with m and n of McEwen (1949); at the
    // surface sigma_xx = -p0 [sqrt(1 - x^2/a^2) + 2 mu x/a] inside, and 2 mu p0 behind the trailing edge
    let cylinder = like_bodies(512);
    let (mu, hertz) = (0.5, cylinder.hertz());
    let slide = format!("{}[[load]]\nshift = [1.0, 0.0]\nincrements = 4\n", cylinder.pressed(1));
    let history = cylinder.run(&slide);
    assert_eq!(history.steps.last().unwrap().stick_cells, 0);
    let kept = last(&history);
    let half_space = HalfSpace::homogeneous(ElasticMaterial::new(1.0, 0.3).unwrap());
    let (a, p0) = (hertz.half_width, hertz.max_pressure);
    let depths = [0.0, 0.1 * a, 0.5 * a, 1.5 * a];
    let points = depth_points(&half_space, &depths).unwrap();
    let [x, y] = kept.shear.clone().unwrap();
    let surface = LoadedSurface {
        even: EvenStress::default(),
        increment: 0,
        pressure: kept.pressure.clone().unwrap(),
        shear: Some([x, y]),
        slip: None,
    };
    let places = cylinder.places();
    let mut worst = [0.0_f64; 4];
    survey(&half_space, &history.grid, Periodicity::NONE, &points, &[surface], |point, _, field| {
        let z = depths[point];
        for (i, x) in places.iter().enumerate() {
            // near the edges at the surface the roots are met in cells
            if z == 0.0 && ((x.abs() - a) / a).abs() < 0.05 {
                continue;
            }
            let (s, square) = (a * a - x * x + z * z, 4.0 * x * x * z * z);
            let m = (0.5 * ((s * s + square).sqrt() + s)).sqrt();
            let n = (0.5 * ((s * s + square).sqrt() - s).max(0.0)).sqrt() * x.signum();
            let sum = m * m + n * n;
            let ratio = (z * z + n * n) / sum;
            let (xx, zz, xz) = if sum == 0.0 {
                (0.0, 0.0, 0.0)
            } else {
                (
                    -p0 / a * (m * (1.0 + ratio) - 2.0 * z),
                    -p0 / a * m * (1.0 - ratio),
                    p0 / a * n * (m * m - z * z) / sum,
                )
            };
            // by shear: sigma_xx = (mu p0/a) [n (2 - (z^2 - m^2)/(m^2 + n^2)) - 2 x], sigma_zz = mu tau_xz, tau_xz = mu sigma_xx of pressure
            let along = mu * p0 / a * (n * (2.0 - (z * z - m * m) / sum) - 2.0 * x);
            let exact = [xx + along, zz - mu * xz, -xz + mu * xx];
            let found = [0, 2, 4].map(|component| field.components[component][[i, 0]]);
            for (found, exact) in found.into_iter().zip(exact) {
                worst[point] = worst[point].max((found - exact).abs() / p0);
            }
            let plane_strain = 0.3 * (found[0] + found[1]);
            assert!((field.components[1][[i, 0]] - plane_strain).abs() < 1e-11 * p0);
        }
        true
    })
    .unwrap();
    assert!(worst[0] < 5e-3 && worst[1..].iter().all(|error| *error < 1e-4), "{worst:?}");
}

/// Hertz and Cattaneo with Masing's memory as a study knows them: approach, displacement and energy too, relative to the datum.
#[test]
fn the_closed_form_of_a_study_is_met_by_a_cylinder_that_goes_to_and_fro() {
    for axis in 0..2 {
        let cylinder = like_bodies(512);
        let along = |fraction: f64| {
            let mut force = [0.0; 2];
            force[axis] = fraction * cylinder.friction * cylinder.force;
            format!("[[load]]\ntangential_force = [{:e}, {:e}]\nincrements = 4\n", force[0], force[1])
        };
        let loads = cylinder.pressed(1) + &along(0.7) + &along(-0.3);
        let grid = format!("cells = {}\nsize = {:e}\ndatum = 0.3", cylinder.cells, cylinder.size);
        let text = cylinder.text(&grid, &loads);
        let plan = Plan::new(Case::from_toml(&text, "case.toml").unwrap()).unwrap();
        let form = ClosedForm::of(&plan).unwrap();
        assert_eq!(form.name(), "Hertz; Cattaneo");
        let history = run(&text).unwrap();
        for (said, step) in form.ends().iter().zip([0, 4, 8].map(|step| &history.steps[step])) {
            let of = |quantity: Quantity| said.of(quantity).unwrap();
            let near = |found: f64, exact: f64, bound: f64| {
                assert!((found - exact).abs() <= bound * exact.abs(), "axis {axis}: {found} {exact}");
            };
            // the grid's error at 213 cells in the half-width
            near(step.approach, of(Quantity::Approach)[0], 2e-6);
            near(step.max_pressure, of(Quantity::MaxPressure)[0], 1e-4);
            near(step.contact_area, of(Quantity::ContactArea)[0], 5e-3);
            if step.increment > 0 {
                near(step.shift[axis], of(Quantity::Shift)[axis], 1e-4);
                near(step.dissipated_energy, of(Quantity::DissipatedEnergy)[0], 1e-2);
                near(step.stick_area, of(Quantity::StickArea)[0], 1e-2);
            }
        }
    }
}

/// Shear `q` of Cattaneo under a tension of the lower body: along the surface `-p + S(x; mu p0, a) - S(x - e; mu p0 c/a, c) + sigma` with
/// `S(x; q0, b) = (2 q0/b) (sign(x) sqrt(x^2 - b^2) - x)`, the root outside only (Johnson 1985, 7.2; Nowell & Hills 1987). Behind the trailing
/// edge, `2 mu p0 {1 - [(a + e) - sqrt((a + e)^2 - c^2)]/a} + sigma` is where cracks start.
#[test]
fn the_tension_at_the_trailing_edge_under_shear_and_bulk_is_the_closed_form() {
    let mut errors = Vec::new();
    for cells in [128, 256, 512, 1024] {
        let cylinder = like_bodies(cells);
        let (mu, hertz) = (0.5, cylinder.hertz());
        let (a, p0) = (hertz.half_width, hertz.max_pressure);
        let pull = 0.36 * mu * cylinder.force;
        let bulk = 4.0 * mu * p0 * 0.1;
        let loads = format!(
            "{}[[load]]\ntangential_force = [{pull:e}, 0.0]\nbulk_stress = {bulk:e}\nincrements = 1\n",
            cylinder.pressed(1)
        );
        let history = cylinder.run(&loads);
        let kept = last(&history);
        let strain = bulk * (1.0 - 0.09);
        let exact = CattaneoLine::new(&hertz, mu, cylinder.moduli().normal, pull, strain).unwrap();
        let (c, e) = (exact.stick_half_width, exact.stick_offset);
        assert!((e / a - 0.1).abs() < 1e-12 && (c / a - 0.8).abs() < 1e-12);
        let semi = |x: f64, peak: f64, half: f64| {
            2.0 * peak / half * (x.signum() * (x * x - half * half).max(0.0).sqrt() - x)
        };
        let half_space = HalfSpace::homogeneous(ElasticMaterial::new(1.0, 0.3).unwrap());
        let points = depth_points(&half_space, &[0.0]).unwrap();
        let pressure = kept.pressure.clone().unwrap();
        let surface = LoadedSurface {
            even: EvenStress { bulk: [bulk, 0.0], ..EvenStress::default() },
            increment: 0,
            pressure: pressure.clone(),
            shear: kept.shear.clone(),
            slip: None,
        };
        let trailing = 2.0 * mu * p0 * (1.0 - ((a + e) - ((a + e).powi(2) - c * c).sqrt()) / a) + bulk;
        let (mut along, mut rim) = (0.0_f64, None);
        survey(&half_space, &history.grid, Periodicity::NONE, &points, &[surface], |_, _, field| {
            for (i, x) in cylinder.places().into_iter().enumerate() {
                let edges = [-a, a, e - c, e + c];
                if edges.iter().any(|edge| ((x - edge) / a).abs() < 0.05) {
                    continue;
                }
                let shear = semi(x, mu * p0, a) - semi(x - e, mu * p0 * c / a, c);
                let expected = shear - hertz.pressure(x) + bulk;
                along = along.max((field.components[0][[i, 0]] - expected).abs() / p0);
            }
            let mut found = Vec::new();
            look(&mut found, field, points[0], false, 0, Some(&pressure));
            rim = found.into_iter().find(|largest| largest.measure == Measure::Tension);
            true
        })
        .unwrap();
        let rim = rim.unwrap();
        let place = history.grid.centre(0, rim.cell[0]) + rim.off[0] * history.grid.spacing()[0];
        println!(
            "{cells} cells: along the surface {along:.1e} p0; trailing edge {:+.4} at x = {:.4} a",
            rim.value / trailing - 1.0,
            place / a
        );
        assert!((place / a + 1.0).abs() < 0.01);
        let cell = history.grid.spacing()[0] / a;
        // the rim is known to a fifth of a cell, and the tension falls from it with the root of the distance
        assert!((rim.value / trailing - 1.0).abs() < 0.6 * cell.sqrt(), "{}", rim.value / trailing);
        errors.push(along);
    }
    // first order: the edges of slip stand in cells
    assert!(errors[3] < 2e-3 && errors[3] < errors[0] / 6.0, "{errors:?}");
}

/// The size of the grid is the depth that an approach is relative to: one of the two has to be said.
#[test]
fn an_approach_without_a_depth_it_is_relative_to_is_refused() {
    let text = |grid: &str| {
        format!(
            "[grid]\ncells = 64\n{grid}\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
             [profile.cylinder]\nradius = 1.0\naxis = \"y\"\n[[load]]\napproach = 1e-4\nincrements = 1\n"
        )
    };
    let error = Case::from_toml(&text("size = \"auto\""), "case.toml").unwrap_err();
    assert!(error.to_string().contains("no datum"), "{error}");
    assert!(Case::from_toml(&text("size = \"auto\"\ndatum = 0.1"), "case.toml").is_ok());
    assert!(Case::from_toml(&text("size = 0.1"), "case.toml").is_ok());
}
