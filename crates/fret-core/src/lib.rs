//! Fretting contact of coated elastic bodies: pressure, shear, stick and slip through the whole loading history.
//!
//! Theory, with the symbols used here: `docs/theory` of the repository. Units are the caller's own, any consistent set. Tractions act
//! on the lower body; pressure is positive in compression; the slip is that of the upper body relative to the lower.
//!
//! # A run
//!
//! A [`Case`] is the written question. A [`Plan`] is the same made numerical, before any work: sizes, memory, what can be left out. A
//! [`Simulation`] solves it, increment by increment, and a [`History`] is what it leaves behind.
//!
//! ```
//! use fretting::{Case, Plan, Silent, Simulation};
//!
//! let text = r#"
//! [grid]
//! cells = [48, 48]
//! size = [240e-6, 240e-6]
//!
//! [upper]
//! rigid = true
//!
//! [lower]
//! substrate = { young = 210e9, poisson = 0.3 }
//!
//! [profile.sphere]
//! radius = 10e-3
//!
//! [friction]
//! coefficient = 0.3
//!
//! [[load]]
//! name = "press"
//! normal_force = 12.0
//! increments = 1
//!
//! [[load]]
//! name = "fret"
//! tangential_force = [1.8, 0.0]
//! cycles = 1
//! increments = 8
//! "#;
//! let case = Case::from_toml(text, "case.toml")?;
//! let plan = Plan::new(case)?;
//! let history = Simulation::new(&plan).run(&mut Silent)?;
//!
//! let last = history.steps.last().expect("nine increments");
//! assert!((last.normal_force / 12.0 - 1.0).abs() < 1e-6); // the tolerance of the solver
//! assert!(history.cycles[0].dissipated_energy > 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! An [`Observer`] hears of every iteration and increment and may stop the run; a [`Checkpoint`] lets it go on later with the same
//! bits; a [`Start`] lets another history begin where one ended. What may mislead is a [`Warning`] in the history, see
//! [`run::plausibility`].
//!
//! # Refusals and failures
//!
//! A case is refused as a whole, with the place of every mistake; a run that fails says in which increment.
//!
//! ```
//! use fretting::Case;
//!
//! let refused = Case::from_toml("[profile.sphere]\nraduis = 10e-3", "case.toml").unwrap_err();
//! assert!(refused.to_string().contains("did you mean `radius`?"));
//! ```
//!
//! # The parts by themselves
//!
//! [`kernel`] says how a surface responds to a unit traction, for any stack of layers; [`compliance`] makes an operator of it;
//! [`ContactSolver`] solves single increments. This is Hertz's contact without a case:
//!
//! ```
//! use std::ops::ControlFlow;
//!
//! use fretting::analytic::Hertz;
//! use fretting::compliance::SurfaceResponse;
//! use fretting::kernel::{Components, influence_coefficients};
//! use fretting::model::{Control, Shape};
//! use fretting::solver::{Coupling, SolverSettings};
//! use fretting::{
//!     Body, ContactPair, ContactSolver, ContactState, CoulombFriction, ElasticMaterial, HalfSpace, LoadStep, Profile, SurfaceGrid,
//! };
//!
//! let steel = HalfSpace::homogeneous(ElasticMaterial::new(210e9, 0.3)?);
//! let pair = ContactPair::new(Body::Rigid, Body::Elastic(steel))?;
//! let grid = SurfaceGrid::new([64, 64], [4e-6, 4e-6])?;
//! let sphere = Profile::from(Shape::Sphere { radius: 10e-3 }.checked()?);
//! let coefficients = influence_coefficients(&pair, grid.cells(), grid.spacing(), Components::NORMAL);
//! let (friction, response) = (CoulombFriction::NONE, SurfaceResponse::FreeSpace(coefficients));
//! let settings = SolverSettings::new(1e-8);
//! let mut solver =
//!     ContactSolver::new(grid, sphere.gap(&grid), &friction, Coupling::Frictionless, response, settings, true);
//!
//! let untouched = ContactState::untouched(grid.cells());
//! let load = LoadStep { normal: Control::Force(12.0), ..LoadStep::FREE };
//! let pressed = solver.step(&untouched, &load, &mut |_, _| ControlFlow::Continue(())).expect("a solved increment").state;
//!
//! let exact = Hertz::sphere(10e-3, 12.0, 210e9 / (1.0 - 0.3 * 0.3))?;
//! assert!((pressed.approach / exact.approach - 1.0).abs() < 1e-3); // eighteen cells in the contact radius
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`analytic`] has closed-form solutions to compare with, [`subsurface`] the stresses below the surface and what engineers judge them
//! by, [`study`] error bars and convergence studies; [`identify`] finds the constants of a model in measured fretting loops,
//! and numbers of a case in a measured indentation.
//!
//! # Where things are
//!
//! The modules stand in layers, and import lower layers only: `ARCHITECTURE.md` has the table. What a new profile, friction law or
//! column of the results takes is told in `docs/developers/extend.md`.

pub mod analytic;
pub mod case;
pub mod compliance;
pub mod conduction;
mod document;
mod fields;
mod heights;
pub mod history;
pub mod identify;
pub mod kernel;
#[cfg(test)]
#[path = "../../../tests/limit.rs"]
mod limit;
pub mod machine;
pub mod measured;
pub mod model;
pub mod numbers;
pub mod plan;
#[cfg(test)]
#[path = "../../../tests/random.rs"]
mod random;
pub mod run;
pub mod scar;
pub mod sensitivity;
pub mod solver;
pub mod study;
pub mod subsurface;
mod topography;
pub mod uncertainty;
pub mod units;

pub use case::{Case, CaseError};
pub use history::{CycleRecord, History, KeptFields, Start, StepRecord, Warning};
pub use model::{
    Body, Coating, ContactPair, ContactState, CoulombFriction, ElasticMaterial, HalfSpace, LoadStep,
    MirroredState, Profile, SurfaceGrid, Zone,
};
pub use plan::Plan;
pub use run::{Checkpoint, Iteration, Observer, RunError, Silent, Simulation};
pub use solver::ContactSolver;
