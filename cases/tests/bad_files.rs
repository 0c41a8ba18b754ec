//! Every file in `bad/` is refused with the text that stands beside it. With `UPDATE_EXPECTED=1` in the environment the
//! texts are written anew, to be read before they are committed; the run then fails, so that it cannot pass for a test.

use std::path::{Path, PathBuf};

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

fn check(folder: &Path, name: &str) -> Result<(), String> {
    let found = match cases::scene::load(&folder.join(name)) {
        Ok(_) => return Err(format!("{name} was accepted")),
        Err(problems) => problems.to_string().replace(&format!("{}/", folder.display()), "") + "\n",
    };
    let beside: PathBuf = folder.join(format!("{name}.expected"));
    if std::env::var_os("UPDATE_EXPECTED").is_some() {
        std::fs::write(&beside, found).unwrap();
        return Err(format!("{name}: written; read it, then run without UPDATE_EXPECTED"));
    }
    let expected = std::fs::read_to_string(&beside).map_err(|why| format!("{}: {why}", beside.display()))?;
    if found == expected { Ok(()) } else { Err(format!("{name}: expected\n{expected}\nfound\n{found}")) }
}
