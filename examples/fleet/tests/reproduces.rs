//! The committed table is what the program makes.

use std::path::Path;
use std::process::Command;

#[test]
fn the_program_reproduces_its_table_byte_for_byte() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let run = Command::new(env!("CARGO_BIN_EXE_fleet-example")).arg(folder).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let read = |folder: &Path| std::fs::read_to_string(folder.join("reports.csv")).unwrap();
    let committed = read(Path::new(env!("CARGO_MANIFEST_DIR")));
    assert!(read(folder) == committed, "reports.csv differs; `cargo run -p fleet-example` writes it anew");
}
