//! Tests that every file in `bad/` is refused with the text beside it. With `UPDATE_EXPECTED=1` in
//! the environment the texts are written again, to be read before they are committed. The run then
//! fails, so that it cannot pass for a test.

use std::path::{Path, PathBuf};

use cases::problem::Problems;

#[test]
fn bad_files_are_refused_with_these_words() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad");
    let mut names: Vec<String> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| !name.ends_with(".expected"))
        .collect();
    names.sort();
    assert!(!names.is_empty());
    let failed: Vec<String> = names.iter().filter_map(|name| check(&folder, name).err()).collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn a_bad_folder_of_stages_is_refused_for_all_its_files_at_once() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_stages");
    let found = cases::stage::load_all(&folder, &cases::Course::default())
        .map(|_| ())
        .expect_err("bad stages were accepted");
    compare(&folder, "stages", &found).unwrap_or_else(|why| panic!("{why}"));
}

fn check(folder: &Path, name: &str) -> Result<(), String> {
    match cases::stage::load_scene(&folder.join(name), &cases::Course::default()) {
        Ok(_) => Err(format!("{name} was accepted")),
        Err(problems) => compare(folder, name, &problems),
    }
}

fn compare(folder: &Path, name: &str, problems: &Problems) -> Result<(), String> {
    let found = problems.to_string().replace(&format!("{}/", folder.display()), "") + "\n";
    let beside = folder.join(format!("{name}.expected"));
    if std::env::var_os("UPDATE_EXPECTED").is_some() {
        std::fs::write(&beside, found).unwrap();
        return Err(format!("{name}: written; read it, then run without UPDATE_EXPECTED"));
    }
    let expected =
        std::fs::read_to_string(&beside).map_err(|why| format!("{}: {why}", beside.display()))?;
    if found == expected {
        Ok(())
    } else {
        Err(format!("{name}: expected\n{expected}\nfound\n{found}"))
    }
}

#[test]
fn what_is_no_file_of_sensible_size_is_refused_unread() {
    let folder = tempfile::tempdir().unwrap();
    let huge = folder.path().join("huge.toml");
    std::fs::File::create(&huge).unwrap().set_len(100_000_000).unwrap();
    let table = [
        (huge, "it has 100000000 bytes; at most 16777216 are read"),
        (folder.path().join("missing.toml"), "there is no such file"),
        (folder.path().to_path_buf(), "it is a folder"),
        (PathBuf::from("/dev/zero"), "it is not a regular file"),
    ];
    for (path, why) in table {
        let problems =
            cases::stage::load_scene(&path, &cases::Course::default()).expect_err("accepted");
        assert_eq!(problems.iter().count(), 1);
        assert!(problems.to_string().contains(why), "{problems}");
    }
}

#[test]
fn a_file_with_very_many_problems_is_not_reported_to_its_end() {
    let text = (0..5000).map(|i| format!("key{i} = 1\n")).collect::<String>();
    let problems =
        cases::scene::parse("many.toml", &text, Path::new(""), &cases::Course::default())
            .expect_err("accepted");
    assert_eq!(problems.iter().count(), cases::problem::MAX_PROBLEMS);
}

#[test]
fn a_word_of_any_length_makes_a_message_that_people_can_read() {
    let word = "x".repeat(100_000);
    let texts =
        [format!("{word} = 1\n"), format!("[scene.materials]\na = {{ kd = \"{word}\" }}\n"), word];
    for text in texts {
        let read =
            cases::scene::parse("long.toml", &text, Path::new(""), &cases::Course::default());
        let said = read.expect_err("accepted").render(false);
        assert!(said.len() < 5000, "{} bytes: {said:.300}", said.len());
    }
}

#[test]
fn escape_codes_are_printed_only_on_request() {
    let problems = cases::scene::parse("x.toml", "a = 1", Path::new(""), &cases::Course::default())
        .expect_err("accepted");
    assert!(problems.render(true).contains('\u{1b}'));
    assert!(!problems.render(false).contains('\u{1b}'));
}
