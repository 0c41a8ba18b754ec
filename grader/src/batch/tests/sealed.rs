//! Results that somebody has changed, and submissions that are alike.

use super::*;

#[test]
fn submissions_that_are_alike_are_listed_without_a_verdict() {
    let class = Class::new(&THREE);
    let alone = |class: &Class| fs::read_to_string(class.out("alike.csv")).unwrap();
    let before = class.run(&Fake::new("1", ALL), 1);
    assert_eq!((before.n_alike, alone(&class).lines().count()), (0, 1));
    let (table, source) =
        (class.shown(), include_str!("../../../../tests/solution/src/triangle.rs"));
    let copied = source.replace("ray", "beam");
    for (name, text) in [("alice", source), ("carol", &*copied)] {
        fs::write(class.place.path().join("in").join(name).join("source"), text).unwrap();
    }
    let summary = class.run(&Fake::new("1", ALL), 1);
    assert_eq!((summary.n_alike, summary.n_graded), (1, 0));
    assert_eq!(alone(&class).lines().nth(1), Some("alice,alice,carol,carol,1.000"));
    assert_eq!(class.shown()["class.csv"], table["class.csv"], "no points depend on it");
    let page = fs::read_to_string(class.out("class.html")).unwrap();
    assert!(page.contains("Submissions that are alike: 1"), "{page}");
}

/// The folders of the results, by the name in their record.
fn results(class: &Class) -> BTreeMap<String, PathBuf> {
    let folders = fs::read_dir(class.out("results")).unwrap().map(|entry| entry.unwrap().path());
    let name = |folder: &PathBuf| {
        let text = fs::read(folder.join("record.json")).unwrap();
        serde_json::from_slice::<Record>(&text).unwrap().submission.path
    };
    folders.map(|folder| (name(&folder), folder)).collect()
}

/// Changes the folders of results, which have the names of their submissions.
type Change = fn(&BTreeMap<String, PathBuf>);

#[test]
fn a_result_that_the_grader_did_not_write_is_refused() {
    let changes: [(&str, Change); 5] = [
        ("a record", |results| {
            let path = results["alice"].join("record.json");
            let text = fs::read_to_string(&path).unwrap();
            let better = text.replace("\"earned\": 1000,", "\"earned\": 14000,");
            assert_ne!(better, text);
            fs::write(path, better).unwrap();
        }),
        ("a report", |results| fs::write(results["alice"].join("report.html"), "").unwrap()),
        ("no seal", |results| fs::remove_file(results["alice"].join("seal")).unwrap()),
        ("another seal", |results| {
            fs::copy(results["bob"].join("seal"), results["alice"].join("seal")).map(drop).unwrap()
        }),
        ("another result", |results| {
            fs::remove_dir_all(&results["alice"]).unwrap();
            fs::rename(&results["bob"], &results["alice"]).unwrap();
        }),
    ];
    for (what, change) in changes {
        let class = Class::new(&THREE);
        class.run(&Fake::new("1", ALL), 1);
        let before = class.shown();
        change(&results(&class));
        let again = Fake::new("1", ALL);
        class.run(&again, 1);
        assert!(again.graded().contains(&"alice".to_owned()), "{what}: {:?}", again.graded());
        assert!(!again.graded().contains(&"carol".to_owned()), "{what}");
        assert_eq!(class.shown(), before, "{what}");
    }
}

#[test]
fn a_result_under_another_key_is_refused() {
    let class = Class::new(&THREE);
    class.run(&Fake::new("1", ALL), 1);
    fs::remove_file(class.place.path().join("key")).unwrap();
    let again = Fake::new("1", ALL);
    class.run(&again, 1);
    assert_eq!(again.graded(), ["alice", "bob", "carol"]);
}
