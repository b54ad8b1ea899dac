//! Keys with distributions, and the samples that are drawn from them.

use std::ops::Range;

use fret_core::uncertainty::{Distribution, SampleDesign};
use serde::Deserialize;
use toml::Value;

/// Words that begin a distribution.
pub const KINDS: [&str; 5] = ["uniform", "normal", "lognormal", "triangular", "weibull"];

/// What a sweep file says about samples.
#[derive(Debug, Default)]
pub struct Drawn {
    keys: Vec<String>,
    distributions: Vec<Distribution>,
    settings: Option<Samples>,
    /// Where the distributions stand.
    pub span: Option<Range<usize>>,
    /// Where the number of samples stands.
    pub samples: Option<Range<usize>>,
}

/// The table `[samples]`.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct Samples {
    count: usize,
    #[serde(default)]
    seed: u32,
    #[serde(default)]
    indices: bool,
}

/// Keys, the rows of their values, and how they were drawn.
type Rows = (Vec<String>, Vec<Vec<Value>>, SampleDesign);

impl Drawn {
    /// Adds the distribution of a key.
    pub fn add(&mut self, key: String, value: Value) -> Result<(), String> {
        let read = value.try_into::<Distribution>().map_err(|error| error.message().to_owned());
        let checked = read.and_then(|read| read.checked().map_err(|error| error.to_string()));
        self.distributions.push(checked.map_err(|why| format!("distributions: `{key}`: {why}"))?);
        self.keys.push(key);
        Ok(())
    }

    /// Takes the table of samples.
    pub fn count(&mut self, value: Value) -> Result<(), String> {
        let read = value.try_into::<Samples>();
        self.settings = Some(read.map_err(|error| format!("samples: {}", error.message()))?);
        Ok(())
    }

    /// Draws.
    pub fn rows(&self) -> Result<Rows, String> {
        let Some(Samples { count, seed, indices }) = self.settings else {
            return Err("samples: nothing says how many are drawn".to_owned());
        };
        let design = SampleDesign { distributions: self.distributions.clone(), count, seed, indices };
        let rows = design.rows().map_err(|error| format!("samples: {error}"))?;
        let rows = rows.into_iter().map(|row| row.into_iter().map(Value::Float).collect()).collect();
        Ok((self.keys.clone(), rows, design))
    }
}
