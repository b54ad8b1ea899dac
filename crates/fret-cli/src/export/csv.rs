//! `--csv`: `history.csv` and a file for each kept increment, a row a cell.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use super::{folder, written};
use crate::failure::{Failure, Unwritten};
use fret_core::model::Dimension;
use fret_results::Results;
use ndarray::Array2;

/// Writes the results as CSV into a folder; the files.
pub fn write(results: &Results, path: &Path) -> Result<Vec<PathBuf>, Failure> {
    folder(path, ["history.csv", "fields_#.csv"])?;
    let mut files = vec![path.join("history.csv")];
    written(&files[0], |writer| {
        writer.write_all(results.table.text.as_bytes()).map_err(|error| Unwritten::at(path)(error).into())
    })?;
    let fields = &results.fields;
    for (position, &step) in fields.steps.iter().enumerate() {
        let file = path.join(format!("fields_{step:06}.csv"));
        let columns: Vec<Array2<f64>> =
            fields.names.iter().map(|name| fields.field(name, position)).collect::<Result<_, _>>()?;
        written(&file, |writer| {
            let dimension = fields.grid().dimension();
            let heads = dimension.names().iter().chain(&fields.names).map(|name| results.field_heading(name));
            let mut row = heads.collect::<Vec<_>>().join(",") + "\n";
            for (i, x) in fields.x.iter().enumerate() {
                for (j, y) in fields.y.iter().enumerate() {
                    let _ = match dimension {
                        Dimension::Plane => write!(row, "{x:?},{y:?}"),
                        Dimension::Line => write!(row, "{x:?}"),
                    };
                    for (name, column) in fields.names.iter().zip(&columns) {
                        let value = column[[i, j]];
                        let _ =
                            if *name == "zone" { write!(row, ",{value}") } else { write!(row, ",{value:?}") };
                    }
                    row.push('\n');
                    writer.write_all(row.as_bytes()).map_err(Unwritten::at(&file))?;
                    row.clear();
                }
            }
            Ok(())
        })?;
        files.push(file);
    }
    Ok(files)
}
