//! Journals that are cut off, changed, and of other runs.

use super::{HEAD, Journal, JournalError, TITLE};
use std::fs;
use std::path::{Path, PathBuf};

type Entry = (u32, Vec<f64>);

fn path(name: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("givens-journal-{name}-{}", std::process::id()));
    let _ = fs::remove_file(&path);
    path
}

fn identity(data: &str) -> Vec<(String, String)> {
    vec![("model".into(), "7".into()), ("data".into(), data.into())]
}

fn open(path: &Path) -> Result<(Journal, Vec<Entry>), JournalError> {
    Journal::open(path, &identity("1"))
}

fn bits(entries: &[Entry]) -> Vec<Vec<u64>> {
    entries.iter().map(|(_, x)| x.iter().map(|x| x.to_bits()).collect()).collect()
}

/// Three entries, written in two sittings.
fn written(path: &Path) -> Vec<Entry> {
    let entries = vec![(1, vec![0.1, f64::NAN]), (2, vec![-0.0, f64::MIN_POSITIVE / 4.0]), (3, vec![])];
    let (mut journal, none) = open(path).unwrap();
    assert!(none.is_empty());
    journal.append(&entries[0]).unwrap();
    journal.settle().unwrap();
    drop(journal);
    let (mut journal, one) = open(path).unwrap();
    assert_eq!(bits(&one), bits(&entries[..1]));
    entries[1..].iter().for_each(|entry| journal.append(entry).unwrap());
    journal.settle().unwrap();
    entries
}

#[test]
fn entries_come_back_to_the_bit() {
    let path = path("bits");
    let entries = written(&path);
    let (journal, found) = open(&path).unwrap();
    assert_eq!(bits(&found), bits(&entries));
    journal.remove().unwrap();
    assert!(!path.exists());
}

#[test]
fn one_entry_takes_the_place_of_all() {
    let path = path("replaced");
    let entries = written(&path);
    let (mut journal, _) = open(&path).unwrap();
    journal.replace(&identity("1"), &entries[1]).unwrap();
    journal.append(&entries[0]).unwrap();
    journal.settle().unwrap();
    drop(journal);
    let (journal, found) = open(&path).unwrap();
    assert_eq!(bits(&found), bits(&[entries[1].clone(), entries[0].clone()]));
    journal.remove().unwrap();
}

#[test]
fn whatever_is_cut_off_leaves_the_entries_before() {
    let path = path("cut");
    let entries = written(&path);
    let bytes = fs::read(&path).unwrap();
    for length in 0..bytes.len() {
        fs::write(&path, &bytes[..length]).unwrap();
        let (mut journal, found) = open(&path).unwrap();
        assert_eq!(bits(&found), bits(&entries[..found.len()]), "{length}");
        // and it goes on behind them
        journal.append(&entries[0]).unwrap();
        journal.settle().unwrap();
        assert!(open(&path).unwrap_err().to_string().contains("another run is at work with it"));
        drop(journal);
        assert_eq!(open(&path).unwrap().1.len(), found.len() + 1, "{length}");
    }
    fs::remove_file(&path).unwrap();
}

#[test]
fn a_byte_that_has_changed_is_refused_wherever_it_is() {
    let path = path("damaged");
    written(&path);
    let bytes = fs::read(&path).unwrap();
    for k in 0..bytes.len() {
        let mut wrong = bytes.clone();
        wrong[k] ^= 4;
        fs::write(&path, &wrong).unwrap();
        let error = open(&path).unwrap_err().to_string();
        let word = if k < TITLE.len() { "checkpoint" } else { "of the checkpoint is damaged" };
        assert!(error.contains(word), "{k}: {error}");
        assert_eq!(fs::read(&path).unwrap(), wrong, "{k}: it is left as it was");
    }
    assert!(bytes.len() > TITLE.len() + 4 * HEAD);
    fs::remove_file(&path).unwrap();
}

#[test]
fn another_run_is_told_by_what_differs() {
    let path = path("other");
    written(&path);
    let error = Journal::open::<Entry>(&path, &identity("2")).unwrap_err();
    assert!(error.to_string().ends_with("of another run: its data differs"), "{error}");
    fs::write(&path, "givens checkpoint 2\n").unwrap();
    assert!(open(&path).unwrap_err().to_string().ends_with("of another version of givens"));
    fs::write(&path, "time,x\n").unwrap();
    assert!(open(&path).unwrap_err().to_string().ends_with("this is no checkpoint"));
    fs::remove_file(&path).unwrap();
}
