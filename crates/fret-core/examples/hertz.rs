//! A rigid ball on steel, compared with Hertz (1881): maximum contact pressure and approach.
//!
//! Expected: both within 0.2 % of the closed form on 48 x 48 cells.
//!
//! ```sh
//! cargo run --release -p fretting --example hertz
//! ```

use std::error::Error;

use fretting::analytic::{EffectiveModuli, Hertz};
use fretting::case::Case;
use fretting::model::ElasticMaterial;
use fretting::plan::Plan;
use fretting::run::{Silent, Simulation};

const CASE: &str = r#"
grid = { cells = [48, 48], size = "auto" }
upper.rigid = true
lower.substrate = { young = 210e9, poisson = 0.3 }
profile.sphere.radius = 10e-3
load = [{ normal_force = 12.0, increments = 1 }]
"#;

#[expect(clippy::print_stdout, reason = "an example tells what it found")]
fn main() -> Result<(), Box<dyn Error>> {
    let plan = Plan::new(Case::from_toml(CASE, "hertz")?)?;
    let history = Simulation::new(&plan).run(&mut Silent)?;
    let end = history.steps.last().ok_or("no increment")?;
    let modulus = EffectiveModuli::rigid_on(&ElasticMaterial::new(210e9, 0.3)?).normal;
    let hertz = Hertz::sphere(10e-3, 12.0, modulus)?;
    for (name, found, exact) in [
        ("maximum contact pressure", end.max_pressure, hertz.max_pressure),
        ("approach", end.approach, hertz.approach),
    ] {
        println!(
            "{name:<26} {found:.5e}  Hertz {exact:.5e}  relative difference {:.1e}",
            found / exact - 1.0
        );
        if (found / exact - 1.0).abs() > 2e-3 {
            return Err(format!("{name} is not Hertz's").into());
        }
    }
    Ok(())
}
