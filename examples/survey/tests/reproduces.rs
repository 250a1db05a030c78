//! The committed tables are what the program makes.

use std::path::Path;
use std::process::Command;

#[test]
fn the_program_reproduces_its_tables_byte_for_byte() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let run = Command::new(env!("CARGO_BIN_EXE_survey-example")).arg(folder).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let read = |folder: &Path, name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    for name in ["fixes.csv", "circles.csv"] {
        let committed = read(Path::new(env!("CARGO_MANIFEST_DIR")), name);
        assert!(
            read(folder, name) == committed,
            "{name} differs; `cargo run -p survey-example` writes it anew"
        );
    }
}
