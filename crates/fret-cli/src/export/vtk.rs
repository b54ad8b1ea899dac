//! `--vtk`: for `ParaView` and pyvista: a `.vti` image of cells for each kept increment, and `history.pvd` that lists them in time.
//!
//! Shear and slip are vectors, everything else is a scalar; time is the number of the increment. Format:
//! <https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html>, data appended raw.

use std::io::Write;
use std::path::{Path, PathBuf};

use fret_core::units::Units;

use super::{folder, written};
use crate::failure::{Failure, Unwritten};
use fret_results::{Fields, Results, kind_of_field, write_whole};

/// Writes the results as VTK files into a folder; the files, the list of them first.
pub fn write(results: &Results, path: &Path) -> Result<Vec<PathBuf>, Failure> {
    folder(path, ["history.pvd", "fields_#.vti"])?;
    let fields = &results.fields;
    let list = path.join("history.pvd");
    let mut files = vec![list.clone()];
    let mut entries = String::new();
    for (position, &step) in fields.steps.iter().enumerate() {
        let name = format!("fields_{step:06}.vti");
        let file = path.join(&name);
        image(fields, position, &file, results.units())?;
        entries += &format!("    <DataSet timestep=\"{step}\" part=\"0\" file=\"{name}\"/>\n");
        files.push(file);
    }
    let text = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  \
         <Collection>\n{entries}  </Collection>\n</VTKFile>\n"
    );
    write_whole(&list, text.as_bytes())?;
    Ok(files)
}

/// The end of the element of an array of a kind: with its unit, as VTK keeps it, where there is one.
pub fn data_array_end(units: Option<&Units>, kind: &str) -> String {
    match units.filter(|_| !kind.is_empty()) {
        Some(units) => {
            let unit = maud::html! { (units.of(kind)) }.into_string();
            format!(
                "><InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{unit}</InformationKey></DataArray>"
            )
        }
        None => "/>".to_owned(),
    }
}

/// An array of the image.
struct Array {
    name: &'static str,
    kind: &'static str,
    components: usize,
    bytes: Vec<u8>,
}

fn image(fields: &Fields, position: usize, file: &Path, units: Option<&Units>) -> Result<(), Failure> {
    let [nx, ny] = fields.cells();
    let [dx, dy] = fields.spacing();
    let arrays = arrays(fields, position)?;
    let mut described = String::new();
    let mut offset = 0;
    for Array { name, kind, components, bytes } in &arrays {
        let of_a_component =
            if *components == 1 { kind_of_field(name) } else { kind_of_field(&format!("{name}_x")) };
        described += &format!(
            "        <DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
             format=\"appended\" offset=\"{offset}\"{}\n",
            data_array_end(units, of_a_component)
        );
        offset += 8 + bytes.len();
    }
    let scalars = arrays.first().map_or(String::new(), |array| format!(" Scalars=\"{}\"", array.name));
    let (x, y) = (fields.x[0] - 0.5 * dx, fields.y[0] - 0.5 * dy);
    // A flat image needs a spacing along z as well; that of the cells keeps it in scale.
    let head = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt64\">\n  <ImageData WholeExtent=\"0 {nx} 0 {ny} 0 0\" Origin=\"{x:?} {y:?} 0\" \
         Spacing=\"{dx:?} {dy:?} {dx:?}\">\n    <Piece Extent=\"0 {nx} 0 {ny} 0 0\">\n      <CellData{scalars}>\n\
         {described}      </CellData>\n    </Piece>\n  </ImageData>\n  <AppendedData encoding=\"raw\">\n_"
    );
    written(file, |writer| {
        let mut put = |bytes: &[u8]| writer.write_all(bytes).map_err(Unwritten::at(file));
        put(head.as_bytes())?;
        for array in &arrays {
            put(&(array.bytes.len() as u64).to_le_bytes())?;
            put(&array.bytes)?;
        }
        put(b"\n  </AppendedData>\n</VTKFile>\n")?;
        Ok(())
    })
}

fn arrays(fields: &Fields, position: usize) -> Result<Vec<Array>, Failure> {
    let mut arrays = Vec::new();
    for &name in &fields.names {
        let field = fields.field(name, position)?;
        // in the order of VTK x is fastest
        let numbers = field.t();
        let (name, components, bytes) = match name {
            "shear_x" | "slip_x" => {
                let vector = name.trim_end_matches("_x");
                let other = fields.field(&format!("{vector}_y"), position)?;
                let vectors = numbers.iter().zip(other.t()).flat_map(|(x, y)| [*x, *y, 0.0]);
                (vector, 3, vectors.flat_map(f64::to_le_bytes).collect())
            }
            "shear_y" | "slip_y" => continue,
            "zone" => (name, 1, numbers.iter().map(|zone| *zone as u8).collect()),
            _ => (name, 1, numbers.iter().copied().flat_map(f64::to_le_bytes).collect()),
        };
        let kind = if name == "zone" { "UInt8" } else { "Float64" };
        arrays.push(Array { name, kind, components, bytes });
    }
    Ok(arrays)
}
