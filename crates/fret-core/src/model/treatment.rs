//! What was done to measured heights before they became a part of the gap, for the record of a run.

use serde::{Deserialize, Serialize};

/// What was done to measured heights, in its order: filled, cut, levelled, filtered, resampled to the grid.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Treatment {
    /// Who read the file, in words, where the program did not read it itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub read_by: Option<String>,
    /// Numbers of measured points along x and y.
    pub points: [usize; 2],
    /// Side lengths of the scan [length], as many spacings of its points as points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size: Option<[f64; 2]>,
    /// Points without a measurement.
    pub holes: usize,
    /// How they were filled.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fill: Option<String>,
    /// The part that was kept, from and to along x and y [length].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cut: Option<Vec<[f64; 2]>>,
    /// Shortest wavelength that was kept [length].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub short_cutoff: Option<f64>,
    /// Longest wavelength that was kept [length].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub long_cutoff: Option<f64>,
    /// How the points became heights of the cells.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resample: Option<String>,
}

impl Treatment {
    /// What was done, as sentences of a summary are: parts without a full stop. `unit` stands behind every length, with a space before it.
    pub fn words(&self, unit: &str) -> Vec<String> {
        let [nx, ny] = self.points;
        let mut words = vec![if ny == 1 { format!("{nx} points") } else { format!("{nx} x {ny} points") }];
        words.extend(self.read_by.iter().map(|reader| format!("read by {reader}")));
        match (self.holes, &self.fill) {
            (0, _) | (_, None) => {}
            (1, Some(fill)) => words.push(format!("1 point without a measurement filled ({fill})")),
            (holes, Some(fill)) => {
                words.push(format!("{holes} points without a measurement filled ({fill})"));
            }
        }
        if let Some(cut) = &self.cut {
            let parts: Vec<String> = cut.iter().map(|[from, to]| format!("{from} to {to}{unit}")).collect();
            words.push(format!("cut to {}", parts.join(", ")));
        }
        words.extend(self.short_cutoff.map(|length| format!("waves shorter than {length}{unit} taken off")));
        words.extend(self.long_cutoff.map(|length| format!("waves longer than {length}{unit} taken off")));
        words.extend(self.resample.as_ref().map(|how| format!("resampled to the grid ({how})")));
        words
    }
}
