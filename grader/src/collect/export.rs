//! Reads the names of files and folders as platforms write them.

use std::collections::{BTreeMap, BTreeSet};

use cases::problem::Problems;
use clap::ValueEnum;

use super::gradescope::Submission;
use super::hand_in::{Claim, HandIn, Mark};
use crate::submission::without_ending;

/// The platform that a folder was exported from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Export {
    /// What the names in the folder say
    Auto,
    /// assignment_N_export with its submission_metadata.yml
    Gradescope,
    /// name_LATE_id_id_file.zip
    Canvas,
    /// Name_id_assignsubmission_file_
    Moodle,
    /// GitHub Classroom: a repository for each student, ASSIGNMENT-login
    Github,
    /// Folders and archives named by id, login, e-mail address, full name or group
    Folders,
}

/// A file or folder of an export.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The name.
    pub name: String,
    /// Whether it is a folder.
    pub is_folder: bool,
}

/// A folder that was exported.
#[derive(Clone, Copy, Debug)]
pub struct Exported<'a> {
    /// The name of the folder.
    pub folder: &'a str,
    /// The hand-ins in it.
    pub entries: &'a [Entry],
    /// What Gradescope's metadata say, by the name of the folder.
    pub metadata: Option<&'a BTreeMap<String, Submission>>,
}

/// Returns the platform that wrote the folder.
pub fn detected(exported: Exported<'_>) -> Export {
    let names = || exported.entries.iter().map(|entry| &*entry.name);
    match () {
        () if exported.metadata.is_some() => Export::Gradescope,
        () if names().any(|name| name.contains(MOODLE)) => Export::Moodle,
        () if names().any(|name| canvas(name).is_some()) => Export::Canvas,
        () if exported.folder.ends_with(CLONED) => Export::Github,
        () => Export::Folders,
    }
}

/// Returns the hand-ins, in the order of the entries.
///
/// # Errors
/// The metadata of Gradescope are missing, or the name of the assignment of GitHub Classroom is
/// not clear.
pub fn hand_ins(export: Export, exported: Exported<'_>) -> Result<Vec<HandIn>, Problems> {
    let export = if export == Export::Auto { detected(exported) } else { export };
    let entries = exported.entries.iter();
    match export {
        Export::Gradescope => {
            let Some(metadata) = exported.metadata else {
                return Err(Problems::of_file(
                    exported.folder,
                    format!("there is no {} in the folder", super::gradescope::FILE),
                    Some("unpack the whole export, and name its folder".to_owned()),
                ));
            };
            Ok(entries.map(|entry| of_gradescope(entry, metadata)).collect())
        }
        Export::Canvas => Ok(entries.map(of_canvas).collect()),
        Export::Moodle => Ok(entries.map(of_moodle).collect()),
        Export::Github => {
            let prefix = assignment(exported)?;
            Ok(entries.map(|entry| of_github(entry, &prefix)).collect())
        }
        Export::Folders | Export::Auto => Ok(entries.map(of_folder).collect()),
    }
}

/// Returns the hand-ins that the metadata of Gradescope name and that the folder lacks.
pub fn missing(exported: Exported<'_>) -> Vec<HandIn> {
    let entries = exported.entries.iter();
    let names: BTreeSet<String> = entries
        .flat_map(|entry| [entry.name.clone(), plain(entry, vec![], &entry.name).stem])
        .collect();
    let absent = exported.metadata.into_iter().flatten().filter(|(key, _)| !names.contains(*key));
    let hand_in = |(key, one): (&String, &Submission)| {
        let entry = Entry { name: key.clone(), is_folder: true };
        HandIn { handed_in: one.created_at, ..plain(&entry, one.submitters.clone(), key) }
    };
    absent.map(hand_in).collect()
}

/// Returns a hand-in without anything that a platform says.
fn plain(entry: &Entry, claims: Vec<Claim>, file: &str) -> HandIn {
    let stem = without_ending(file.as_bytes());
    let is_archive = stem.len() < file.len();
    // A name is cut between characters, since the endings of archives are ASCII.
    let stem = if entry.is_folder { file } else { &file[..stem.len()] };
    let stem = match stem.rsplit_once('.') {
        Some((before, _)) if !entry.is_folder && !is_archive => before,
        _ => stem,
    };
    HandIn {
        name: entry.name.clone(),
        claims,
        handed_in: None,
        mark: Mark::None,
        stem: stem.to_owned(),
        attempt: 0,
        is_whole: entry.is_folder || is_archive,
    }
}

fn of_folder(entry: &Entry) -> HandIn {
    let hand_in = plain(entry, vec![], &entry.name);
    HandIn { claims: vec![Claim::Any(hand_in.stem.clone())], ..hand_in }
}

fn of_gradescope(entry: &Entry, metadata: &BTreeMap<String, Submission>) -> HandIn {
    let hand_in = plain(entry, vec![], &entry.name);
    match metadata.get(&entry.name).or_else(|| metadata.get(&hand_in.stem)) {
        Some(one) => {
            HandIn { claims: one.submitters.clone(), handed_in: one.created_at, ..hand_in }
        }
        None => hand_in,
    }
}

/// The parts of a name that Canvas gives to a file.
struct CanvasName<'a> {
    name: &'a str,
    account: &'a str,
    is_late: bool,
    file: &'a str,
}

/// Splits `name_LATE_id_id_file`, in which the name has no `_`.
fn canvas(text: &str) -> Option<CanvasName<'_>> {
    let (name, rest) = text.split_once('_')?;
    let (is_late, rest) = match rest.strip_prefix("LATE_") {
        Some(rest) => (true, rest),
        None => (false, rest),
    };
    let (account, rest) = rest.split_once('_')?;
    let (attachment, file) = rest.split_once('_')?;
    let is_right = !name.is_empty() && is_digits(account) && is_digits(attachment);
    (is_right && !file.is_empty()).then_some(CanvasName { name, account, is_late, file })
}

fn is_digits(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

fn of_canvas(entry: &Entry) -> HandIn {
    let Some(CanvasName { name, account, is_late, file }) = canvas(&entry.name) else {
        return of_folder(entry);
    };
    let claim =
        Claim::Numbered { account: account.to_owned(), name: name.to_owned(), is_squeezed: true };
    let hand_in = plain(entry, vec![claim], file);
    let (stem, attempt) = attempt(&hand_in.stem);
    let mark = if is_late { Mark::Late } else { Mark::InTime };
    HandIn { mark, stem: stem.to_owned(), attempt, ..hand_in }
}

/// Splits the number of the attempt off a name such as `project-2`.
fn attempt(stem: &str) -> (&str, u32) {
    let split = stem.rsplit_once('-').filter(|(before, number)| {
        !before.is_empty() && is_digits(number) && number.len() <= 3 && !number.starts_with('0')
    });
    match split.and_then(|(before, number)| Some((before, number.parse().ok()?))) {
        Some((before, number)) => (before, number),
        None => (stem, 0),
    }
}

/// The part of a name that Moodle writes behind the student.
const MOODLE: &str = "_assignsubmission_file_";

fn of_moodle(entry: &Entry) -> HandIn {
    let parts: Vec<&str> = entry.name.split(MOODLE).collect();
    // A name with two such parts could be read in two ways.
    let [student, file] = parts[..] else { return unclaimed(entry) };
    match student.rsplit_once('_') {
        Some((name, account)) if is_digits(account) && !name.is_empty() => {
            let (account, name) = (account.to_owned(), name.to_owned());
            plain(entry, vec![Claim::Numbered { account, name, is_squeezed: false }], file)
        }
        _ => unclaimed(entry),
    }
}

fn unclaimed(entry: &Entry) -> HandIn {
    plain(entry, vec![], &entry.name)
}

/// The end of the name of a folder that `gh classroom clone student-repos` makes.
const CLONED: &str = "-submissions";

/// Returns what stands before the login in the name of each repository.
///
/// # Errors
/// The repositories have several such beginnings in common, or none.
fn assignment(exported: Exported<'_>) -> Result<String, Problems> {
    if let Some(assignment) = exported.folder.strip_suffix(CLONED) {
        return Ok(format!("{assignment}-"));
    }
    let names: Vec<&str> = exported.entries.iter().map(|entry| &*entry.name).collect();
    let first = names.first().copied().unwrap_or_default();
    let ends = first.match_indices('-').map(|(at, _)| &first[..=at]);
    let common: Vec<&str> =
        ends.filter(|start| names.iter().all(|name| name.starts_with(start))).collect();
    match common[..] {
        [one] => Ok(one.to_owned()),
        _ => {
            let message = match common[..] {
                [] => "the repositories do not begin with the name of one assignment".to_owned(),
                _ => format!("the name of the assignment may be {}", common.join(" or ")),
            };
            let help = "name the folder ASSIGNMENT-submissions, as `gh classroom clone` does";
            Err(Problems::of_file(exported.folder, message, Some(help.to_owned())))
        }
    }
}

fn of_github(entry: &Entry, prefix: &str) -> HandIn {
    let hand_in = plain(entry, vec![], &entry.name);
    let login = hand_in.stem.strip_prefix(prefix).filter(|login| !login.is_empty());
    let claims = login.map(|login| Claim::Account(login.to_owned()));
    HandIn { claims: claims.into_iter().collect(), ..hand_in }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn entries(names: &[&str]) -> Vec<Entry> {
        let entry = |name: &&str| Entry {
            name: name.trim_end_matches('/').to_owned(),
            is_folder: name.ends_with('/'),
        };
        names.iter().map(entry).collect()
    }

    fn read(export: Export, folder: &str, names: &[&str]) -> Vec<HandIn> {
        let entries = entries(names);
        let exported = Exported { folder, entries: &entries, metadata: None };
        hand_ins(export, exported).unwrap_or_else(|why| panic!("{why}"))
    }

    fn one(export: Export, name: &str) -> HandIn {
        read(export, "x", &[name]).remove(0)
    }

    fn numbered(account: &str, name: &str, is_squeezed: bool) -> Claim {
        Claim::Numbered { account: account.to_owned(), name: name.to_owned(), is_squeezed }
    }

    #[test]
    fn names_of_canvas_are_split() {
        for (name, claim, mark, stem, attempt) in [
            ("leeann_12_345_hw.zip", ("12", "leeann"), Mark::InTime, "hw", 0),
            ("leeann_LATE_12_345_hw-2.tar.gz", ("12", "leeann"), Mark::Late, "hw", 2),
            ("o-hara_12_345_a_1_2_b.zip", ("12", "o-hara"), Mark::InTime, "a_1_2_b", 0),
            ("leeann_12_345_x_LATE_9_9_y.zip", ("12", "leeann"), Mark::InTime, "x_LATE_9_9_y", 0),
            ("leeann_12_345_report-10.pdf", ("12", "leeann"), Mark::InTime, "report", 10),
            ("leeann_12_345_hw-2024.zip", ("12", "leeann"), Mark::InTime, "hw-2024", 0),
        ] {
            let found = one(Export::Canvas, name);
            assert_eq!(found.claims, [numbered(claim.0, claim.1, true)], "{name}");
            assert_eq!((found.mark, &*found.stem, found.attempt), (mark, stem, attempt), "{name}");
        }
        for name in ["leeann.zip", "_1_2_a.zip", "a_b_2_c.zip", "a_LATE_2_c.zip", "a_1_2_"] {
            let found = one(Export::Canvas, name);
            assert!(matches!(&found.claims[..], [Claim::Any(_)]), "{name}: {found:?}");
        }
    }

    #[test]
    fn names_of_moodle_are_split() {
        let found = one(Export::Moodle, "Ann_x Lee_4711_assignsubmission_file_/");
        assert_eq!(found.claims, [numbered("4711", "Ann_x Lee", false)]);
        let found = one(Export::Moodle, "Ann Lee_4711_assignsubmission_file_my_hw.zip");
        assert_eq!(
            (&found.claims[..], &*found.stem),
            (&[numbered("4711", "Ann Lee", false)][..], "my_hw")
        );
        for name in [
            "Ann Lee_4711_assignsubmission_onlinetext_/",
            "Bo_1_assignsubmission_file__2_assignsubmission_file_/",
            "Ann Lee_assignsubmission_file_/",
            "_1_assignsubmission_file_/",
        ] {
            assert_eq!(one(Export::Moodle, name).claims, [], "{name}");
        }
    }

    #[test]
    fn repositories_are_named_by_their_login() {
        let logins = |folder: &str, names: &[&str]| -> Vec<String> {
            let found = read(Export::Github, folder, names);
            found.iter().map(|one| one.claims.iter().map(Claim::shown).collect()).collect()
        };
        assert_eq!(logins("x", &["hw-1-ann/", "hw-bo/"]), ["1-ann", "bo"]);
        assert_eq!(
            logins("hw-1-submissions", &["hw-1-ann/", "hw-1-b-o/", "notes/"]),
            ["ann", "b-o", ""]
        );
        for names in [&["hw-1-ann/", "hw-1-bo/"][..], &["ann/", "bo/"], &["hw-jane-doe/"]] {
            let entries = entries(names);
            let exported = Exported { folder: "x", entries: &entries, metadata: None };
            assert!(hand_ins(Export::Github, exported).is_err(), "{names:?}");
        }
    }

    #[test]
    fn the_platform_is_recognised() {
        let metadata = BTreeMap::new();
        for (folder, name, metadata, expected) in [
            ("x", "submission_1/", Some(&metadata), Export::Gradescope),
            ("x", "leeann_12_345_hw.zip", None, Export::Canvas),
            ("x", "Ann Lee_12_assignsubmission_file_/", None, Export::Moodle),
            ("hw-submissions", "hw-ann/", None, Export::Github),
            ("x", "hw-ann/", None, Export::Folders),
        ] {
            let entries = entries(&[name]);
            assert_eq!(
                detected(Exported { folder, entries: &entries, metadata }),
                expected,
                "{name}"
            );
        }
        let entries = entries(&["submission_1/"]);
        let exported = Exported { folder: "x", entries: &entries, metadata: None };
        assert!(hand_ins(Export::Gradescope, exported).is_err());
    }

    #[test]
    fn folders_are_named_by_their_student() {
        for (name, stem, is_whole) in [
            ("ann.lee.tar.gz", "ann.lee", true),
            ("ann.lee/", "ann.lee", true),
            ("ann.pdf", "ann", false),
            ("é.zip", "é", true),
        ] {
            let found = one(Export::Folders, name);
            assert_eq!(found.claims, [Claim::Any(stem.to_owned())], "{name}");
            assert_eq!(found.is_whole, is_whole, "{name}");
        }
    }

    proptest! {
        #[test]
        fn any_names_are_read(
            names in proptest::collection::vec(
                "(_|-|\\.|LATE|12|é|hw|\u{202e}|_assignsubmission_file_|\\.zip|/){1,10}", 1..5,
            ),
        ) {
            let entries: Vec<Entry> = names
                .iter()
                .map(|name| Entry { name: name.clone(), is_folder: name.len() % 2 == 0 })
                .collect();
            let exported = Exported { folder: &names[0], entries: &entries, metadata: None };
            for export in Export::value_variants() {
                if let Ok(found) = hand_ins(*export, exported) {
                    prop_assert_eq!(found.len(), entries.len());
                }
            }
        }
    }
}
