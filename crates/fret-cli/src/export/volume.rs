//! Volumes for `ParaView`: rectilinear grids of the VTK XML format (`.vtr`), filled depth by depth.
//!
//! Raw appended data, little-endian, in single precision: pictures, not results. At an interface two planes of points lie at the
//! same depth, one for each side. z counts downward from the surface, as everywhere; turn the view.
//! Format: VTK File Formats, <https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html>.

use std::fs::{self, File};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use fret_core::model::SurfaceGrid;
use fret_core::units::Units;

use super::vtk::data_array_end;
use crate::failure::Unwritten;
use fret_results::{new_file, part_of};

/// A volume of named scalar fields while it is filled.
#[derive(Debug)]
pub struct Volume {
    path: PathBuf,
    part: PathBuf,
    file: File,
    /// Place of the first number.
    start: u64,
    cells: [usize; 2],
    depths: usize,
    fields: Vec<Field>,
}

/// Name of a scalar field, and the kind of its unit.
pub type Field = (&'static str, &'static str);

impl Volume {
    /// Opens a volume over the cell centres and the given depths.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn create(
        path: &Path,
        grid: &SurfaceGrid,
        depths: &[f64],
        fields: &[Field],
        units: Option<&Units>,
    ) -> Result<Self, Unwritten> {
        let part = part_of(path);
        let cells = grid.cells();
        let (file, start) = begin(&part, grid, depths, fields, units).map_err(Unwritten::at(path))?;
        Ok(Self {
            path: path.to_owned(),
            part,
            file,
            start,
            cells,
            depths: depths.len(),
            fields: fields.to_vec(),
        })
    }

    /// Writes one field at one depth; `value` by cell.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn plane(
        &mut self,
        name: &str,
        depth: usize,
        value: impl Fn(usize, usize) -> f64,
    ) -> Result<(), Unwritten> {
        let [nx, ny] = self.cells;
        let Some(array) = self.fields.iter().position(|(known, _)| *known == name) else { return Ok(()) };
        let array_bytes = header(self.cells, self.depths);
        let place = self.start + array as u64 * (8 + array_bytes) + 8 + (depth * nx * ny * 4) as u64;
        let mut bytes = Vec::with_capacity(nx * ny * 4);
        for j in 0..ny {
            for i in 0..nx {
                bytes.extend_from_slice(&(value(i, j) as f32).to_le_bytes());
            }
        }
        self.file
            .seek(SeekFrom::Start(place))
            .and_then(|_| self.file.write_all(&bytes))
            .map_err(Unwritten::at(&self.path))
    }

    /// Ends the work on a volume that will not be whole.
    pub fn abandon(self) {
        // A part that stays behind is only litter.
        let _ = fs::remove_file(&self.part);
    }

    /// Ends the file and puts it in its place.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn close(mut self) -> Result<(), Unwritten> {
        let end = self.start + self.fields.len() as u64 * (8 + header(self.cells, self.depths));
        self.file
            .seek(SeekFrom::Start(end))
            .and_then(|_| self.file.write_all(b"\n  </AppendedData>\n</VTKFile>\n"))
            .and_then(|()| self.file.sync_all())
            .and_then(|()| fs::rename(&self.part, &self.path))
            .map_err(Unwritten::at(&self.path))
    }
}

/// Bytes of one array.
fn header(cells: [usize; 2], depths: usize) -> u64 {
    (cells[0] * cells[1] * depths * 4) as u64
}

fn begin(
    part: &Path,
    grid: &SurfaceGrid,
    depths: &[f64],
    fields: &[Field],
    units: Option<&Units>,
) -> io::Result<(File, u64)> {
    let [nx, ny] = grid.cells();
    let extent = format!("0 {} 0 {} 0 {}", nx - 1, ny - 1, depths.len() - 1);
    let bytes = header([nx, ny], depths.len());
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"RectilinearGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n",
    );
    text += &format!(
        "  <RectilinearGrid WholeExtent=\"{extent}\">\n    <Piece Extent=\"{extent}\">\n      <PointData>\n"
    );
    for (number, (name, kind)) in fields.iter().enumerate() {
        let end = data_array_end(units, kind);
        let offset = number as u64 * (8 + bytes);
        text += &format!(
            "        <DataArray type=\"Float32\" Name=\"{name}\" format=\"appended\" offset=\"{offset}\"{end}\n"
        );
    }
    text += "      </PointData>\n      <Coordinates>\n";
    let (x, y) = (grid.centres(0), grid.centres(1));
    for (name, values) in [("x", x.to_vec()), ("y", y.to_vec()), ("z", depths.to_vec())] {
        let numbers: Vec<String> = values.iter().map(|value| format!("{value:e}")).collect();
        text += &format!(
            "        <DataArray type=\"Float64\" Name=\"{name}\" format=\"ascii\">{}</DataArray>\n",
            numbers.join(" ")
        );
    }
    text +=
        "      </Coordinates>\n    </Piece>\n  </RectilinearGrid>\n  <AppendedData encoding=\"raw\">\n    _";
    let mut file = new_file(part)?;
    file.write_all(text.as_bytes())?;
    let start = text.len() as u64;
    for number in 0..fields.len() as u64 {
        file.seek(SeekFrom::Start(start + number * (8 + bytes)))?;
        file.write_all(&bytes.to_le_bytes())?;
    }
    Ok((file, start))
}
