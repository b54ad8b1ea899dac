//! How the command was compiled.

use object::{Object, ObjectSymbol};

/// Loops of wide numbers are compiled for the widest instructions of the processor only where all that they call is compiled into them. A closure
/// that is given to `map` or `from_fn` of an array stays outside when it is long: each operation becomes a call, with its numbers in memory. That
/// once took a third of the time of most cases, and no test of numbers sees it.
#[test]
fn no_operation_on_wide_numbers_is_a_call() {
    let program = std::fs::read(env!("CARGO_BIN_EXE_fret")).unwrap();
    let file = object::File::parse(&*program).unwrap();
    let names: Vec<&str> = file.symbols().filter_map(|symbol| symbol.name().ok()).collect();
    // it has its names, so that the next line can fail
    assert!(names.iter().any(|name| name.contains("fretting")));
    let is_wide =
        |name: &&&str| name.contains("core_arch") && ["_mm256_", "_mm512_"].iter().any(|w| name.contains(w));
    let calls: Vec<_> = names.iter().filter(is_wide).collect();
    assert!(calls.is_empty(), "{calls:?}");
}
