//! Surface compliance of a coated half-space at wavenumbers, and its influence coefficients: the kernels without a contact problem.
//!
//! Expected: short waves see the coating, long waves the substrate.
//!
//! ```sh
//! cargo run --release -p fretting --example layered_response
//! ```

use std::error::Error;

use fretting::kernel::{Components, FrequencyResponse, influence_coefficients};
use fretting::model::{Base, Body, Coating, ContactPair, ElasticMaterial, HalfSpace};

#[expect(clippy::print_stdout, reason = "an example tells what it found")]
fn main() -> Result<(), Box<dyn Error>> {
    let (coating, substrate) = (ElasticMaterial::new(400.0, 0.2)?, ElasticMaterial::new(100.0, 0.3)?);
    let body = HalfSpace::new(vec![Coating::new(coating, 1.0)?], Base::Elastic(substrate))?;
    let response = FrequencyResponse::new(&body);
    println!("      k      u_z k / p");
    for k in [1e-3, 1e-1, 1.0, 10.0, 100.0] {
        println!("{k:>8}  {:.6e}", response.at(k).zz * k);
    }
    let bare = |material: &ElasticMaterial| 2.0 * (1.0 - material.poisson().powi(2)) / material.young();
    println!("substrate alone {:.6e}, coating alone {:.6e}", bare(&substrate), bare(&coating));
    let short = response.at(100.0).zz * 100.0;
    if (short / bare(&coating) - 1.0).abs() > 1e-9 {
        return Err("short waves do not see the coating".into());
    }
    let pair = ContactPair::new(Body::Rigid, Body::Elastic(body))?;
    let coefficients = influence_coefficients(&pair, [4, 4], [0.25, 0.25], Components::ALL);
    println!("influence coefficients zz:\n{:.4e}", coefficients.zz.ok_or("no zz")?);
    Ok(())
}
