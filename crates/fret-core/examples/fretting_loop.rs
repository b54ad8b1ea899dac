//! One fretting cycle of a coated contact, followed increment by increment by an observer that could also stop it.
//!
//! Expected: a closed loop; the dissipated energy of the cycle is the area that the loop encloses, to the rounding of its corners.
//!
//! ```sh
//! cargo run --release -p fretting --example fretting_loop
//! ```

use std::error::Error;
use std::ops::ControlFlow;

use fretting::case::Case;
use fretting::history::{KeptFields, StepRecord};
use fretting::model::MirroredState;
use fretting::plan::Plan;
use fretting::run::{Observer, Simulation};

const CASE: &str = r#"
grid = { cells = [32, 32], size = "auto" }
upper.rigid = true
lower.coatings = [{ thickness = 50e-6, young = 420e9, poisson = 0.3 }]
lower.substrate = { young = 210e9, poisson = 0.3 }
profile.sphere.radius = 10e-3
friction.coefficient = 0.3

[[load]]
name = "press"
normal_force = 12.0
increments = 8
ramp = "cubic"

[[load]]
name = "fretting"
tangential_force = [2.5, 0.0]
cycles = 2
increments = 24
"#;

/// Draws the loop as it grows: displacement and force of every increment.
#[derive(Default)]
struct Loop(Vec<[f64; 2]>);

impl Observer for Loop {
    fn solved(&mut self, step: &StepRecord, _: MirroredState<'_>, _: Option<&KeptFields>) -> ControlFlow<()> {
        self.0.push([step.shift[0], step.tangential_force[0]]);
        ControlFlow::Continue(()) // Break would end the run here, with all that is solved
    }
}

#[expect(clippy::print_stdout, reason = "an example tells what it found")]
fn main() -> Result<(), Box<dyn Error>> {
    let plan = Plan::new(Case::from_toml(CASE, "fretting loop")?)?;
    let mut heard = Loop::default();
    let history = Simulation::new(&plan).run(&mut heard)?;
    let cycle = history.cycles.last().ok_or("no cycle")?;
    let points = &heard.0[cycle.first_increment - 1..=cycle.last_increment];
    let enclosed: f64 =
        points.windows(2).map(|pair| 0.5 * (pair[0][1] + pair[1][1]) * (pair[1][0] - pair[0][0])).sum();
    println!("increments            {}", heard.0.len());
    println!("dissipated energy     {:.4e}", cycle.dissipated_energy);
    println!("area of the loop      {enclosed:.4e}");
    // The work of the external force is dissipated but for what the elastic bodies hold more than at the start of the cycle.
    if (enclosed / cycle.dissipated_energy - 1.0).abs() > 0.15 {
        return Err("the loop does not enclose the dissipated energy".into());
    }
    Ok(())
}
