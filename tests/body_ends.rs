//! Bodies that end at the edge of the grid.

use fret_core::history::{Concern, History};
use fret_core::run::RunError;
use fret_validation::{run, solved_with};
use ndarray::{Array2, s};

/// A rough pad on a half-space, of heights that are no symmetric pattern.
fn rough(cells: [usize; 2]) -> Array2<f64> {
    Array2::from_shape_fn(cells, |(i, j)| {
        let (x, y) = (i as f64, j as f64);
        0.3 * ((0.9 * x + 0.4 * y).sin() + (0.37 * x - 1.1 * y).cos() + 0.5 * (1.7 * x * y).sin())
    })
}

fn pressed(grid: &str, gap: &Array2<f64>) -> History {
    let text = format!(
        "[grid]\n{grid}\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
         [profile.heights]\nvalues = {{ array = 0 }}\nof = \"gap\"\n[friction]\ncoefficient = 0.3\n[solver]\ntolerance = 1e-10\n\
         [[load]]\nnormal_force = 14.0\nincrements = 1\n[[load]]\ntangential_force = [1.5, 0.6]\nincrements = 2\n"
    );
    solved_with(&text, std::slice::from_ref(gap))
}

/// The same pad with two rings of cells around it whose surface is out of reach: what was the way out before a body could end.
#[test]
fn a_body_that_ends_is_one_whose_surroundings_are_out_of_reach() {
    let cells = [24, 20];
    let gap = rough(cells);
    let ends = pressed("cells = [24, 20]\nsize = [24.0, 20.0]\nbeyond = \"no body\"", &gap);
    let mut surrounded = Array2::from_elem([28, 24], 1e3);
    surrounded.slice_mut(s![2..26, 2..22]).assign(&gap);
    let far = pressed("cells = [28, 24]\nsize = [28.0, 24.0]", &surrounded);
    let [found, expected] = [&ends, &far].map(|history| history.fields.last().unwrap());
    let edge = found.pressure.as_ref().unwrap();
    let is_at_edge = |i: usize, j: usize| i == 0 || i == 23 || j == 0 || j == 19;
    let at_edge = edge.indexed_iter().filter(|((i, j), p)| is_at_edge(*i, *j) && **p > 0.0).count();
    assert!(at_edge > 3, "the contact reaches the edge at {at_edge} cells");
    let inside = |field: &Array2<f64>| field.slice(s![2..26, 2..22]).to_owned();
    let apart = |a: &Array2<f64>, b: &Array2<f64>| {
        let largest = b.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        (a - b).iter().fold(0.0_f64, |most, value| most.max(value.abs())) / largest
    };
    // Both to a residual of 1e-10 in the gap, whose pressures may be some thousand times as far apart at cells that just touch.
    let pressure = apart(edge, &inside(expected.pressure.as_ref().unwrap()));
    let shear = apart(&found.shear.as_ref().unwrap()[0], &inside(&expected.shear.as_ref().unwrap()[0]));
    assert!(pressure < 1e-7 && shear < 1e-7, "{pressure:e} {shear:e}");
    for (one, other) in ends.steps.iter().zip(&far.steps) {
        assert_eq!(one.contact_cells, other.contact_cells);
        for (one, other) in [
            (one.approach, other.approach),
            (one.shift[0], other.shift[0]),
            (one.elastic_energy, other.elastic_energy),
        ] {
            assert!((one / other - 1.0).abs() < 1e-8, "{one:e} {other:e}");
        }
    }
    assert!(ends.warnings.iter().all(|warning| warning.name != Concern::ContactNearEdge));
}

/// A flat pad touches all over: its contact area is the grid, its friction carries `mu P`, and mirrors leave it as it is.
#[test]
fn a_flat_pad_touches_to_its_edge() {
    let text = |beyond: &str| {
        format!(
            "[grid]\ncells = [16, 12]\nsize = [4.0, 3.0]\n{beyond}\n[upper]\nrigid = true\n[lower]\nsubstrate = {{ young = 1.0, poisson = 0.3 }}\n\
             [profile.heights]\nvalues = {:?}\n[friction]\ncoefficient = 0.3\n[[load]]\nnormal_force = 0.1\nincrements = 1\n\
             [[load]]\nshift = [100.0, 0.0]\nincrements = 2\n",
            [[0.0; 12]; 16]
        )
    };
    let history = run(&text("beyond = \"no body\"")).unwrap();
    let end = history.steps.last().unwrap();
    assert_eq!((end.contact_cells, end.contact_area), (192, 12.0));
    // Slip turns aside by the displacement across over the shift, here 2e-5, and the force is short by half its square.
    assert!((end.tangential_force[0] / 0.03 - 1.0).abs() < 1e-7, "{:?}", end.tangential_force);
    let refused = run(&text("")).unwrap_err();
    assert!(matches!(refused, RunError::ContactAtEdge { .. }));
    assert!(refused.to_string().contains("grid.beyond = \"no body\""), "{refused}");
}

/// A cylinder on a pad that is narrower than the contact would be, as a line contact: far from the corners a punch with parallel sides.
/// Under full contact the pressure at the edges is above that in the middle, as under any punch with sharp edges.
#[test]
fn a_line_contact_may_end_with_its_grid() {
    let text = "[grid]\ncells = 64\nsize = 0.1\nbeyond = \"no body\"\n[upper]\nrigid = true\n[lower]\n\
                substrate = { young = 1.0, poisson = 0.3 }\n[profile.cylinder]\nradius = 1.0\naxis = \"y\"\n\
                [[load]]\nnormal_force = 0.02\nincrements = 1\n";
    let history = run(text).unwrap();
    let pressure = history.fields[0].pressure.as_ref().unwrap();
    assert_eq!(history.steps[0].contact_cells, 64);
    // p = [E*(b^2/2 - x^2)/(2R) + P/pi] / sqrt(b^2 - x^2): of a punch of half-width b, full contact (Johnson, 1985, section 2.8).
    let (b, modulus) = (0.05_f64, 1.0 / 0.91);
    let exact = |x: f64| {
        (modulus * (0.5 * b * b - x * x) / 2.0 + 0.02 / std::f64::consts::PI) / (b * b - x * x).sqrt()
    };
    for (i, found) in pressure.column(0).iter().enumerate().skip(4).take(56) {
        let x = (i as f64 + 0.5) * 0.1 / 64.0 - b;
        // Cells near a singular edge: first order, 3 % at the fifth cell.
        assert!((found / exact(x) - 1.0).abs() < 0.03, "{x}: {found} {}", exact(x));
    }
}
