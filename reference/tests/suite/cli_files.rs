//! Tests of outputs that cannot be written: full disks, files that do not fit, devices. The program
//! keeps a file that it cannot replace.

use std::process::Command;

use crate::common::program::{expect, folder, run};

#[test]
fn what_is_no_file_is_written_to_and_a_full_disk_is_3() {
    let folder = folder();
    let render =
        |args: &[&str]| run(folder.path(), &[&["render", "scene.toml", "-o"], args].concat(), "");
    std::os::unix::fs::symlink("/dev/full", folder.path().join("full.pfm")).unwrap();
    for full in ["/dev/full", "full.pfm"] {
        expect(&render(&[full]), 3, &format!("cannot write {full}: No space left"));
    }
    let png = render(&["-"]).stdout;
    assert_eq!(render(&["/proc/self/fd/1"]).stdout, png);
    let with_stats = render(&["-", "--stats"]);
    assert_eq!(with_stats.stdout, png);
    expect(&with_stats, 0, "left out");
}

#[test]
fn a_file_that_does_not_fit_leaves_the_old_one() {
    let folder = folder();
    let picture = folder.path().join("a.pfm");
    std::fs::write(&picture, "old").unwrap();
    // The limit on a file is 512 bytes, and the picture of 64 × 48 pixels is longer.
    let script = "trap '' XFSZ; ulimit -f 1; exec \"$0\" render scene.toml -o a.pfm --size 64x48";
    let program = env!("CARGO_BIN_EXE_reference");
    let output = Command::new("sh")
        .args(["-c", script, program])
        .current_dir(folder.path())
        .output()
        .unwrap();
    expect(&output, 3, "; nothing was changed");
    assert_eq!(std::fs::read_to_string(&picture).unwrap(), "old");
    let names = std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name());
    assert!(
        !names.into_iter().any(|name| name.to_string_lossy().starts_with(".part-")),
        "a partial file is left"
    );
}
