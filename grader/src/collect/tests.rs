//! Tests of whole classes: rosters, exports and policies become rolls.

use proptest::prelude::*;

use super::class::{Class, Count, Score};
use super::export::{Entry, Export, Exported, hand_ins};
use super::gradescope;
use super::policy::Policy;
use super::roll::{Member, Roll, Standing};
use super::roster::Roster;

const POLICY: &str = "deadline = 2026-10-05T23:59:00+02:00\ngrace = \"10 min\"\n\
    deduct = \"10 %\"\nper = \"day\"\n";

fn roster(text: &str) -> Roster {
    Roster::parse("roster.csv", text.as_bytes()).unwrap_or_else(|why| panic!("{why}"))
}

fn policy(text: &str) -> Policy {
    Policy::parse("late.toml", text.as_bytes()).unwrap_or_else(|why| panic!("{why}"))
}

/// An export, and the points of each hand-in, which are `None` where the grader failed. Names of
/// folders end in `/`.
struct Case<'a> {
    roster: &'a str,
    policy: Option<&'a str>,
    count: Count,
    metadata: Option<&'a str>,
    files: &'a [(&'a str, Option<u64>)],
}

impl Case<'_> {
    fn class(&self) -> Class {
        let entry = |(name, _): &(&str, Option<u64>)| Entry {
            name: name.trim_end_matches('/').to_owned(),
            is_folder: name.ends_with('/'),
        };
        let entries: Vec<Entry> = self.files.iter().map(entry).collect();
        let metadata =
            self.metadata.map(|text| gradescope::parse("metadata", text.as_bytes()).unwrap());
        let exported =
            Exported { folder: "handins", entries: &entries, metadata: metadata.as_ref() };
        let hand_ins = hand_ins(Export::Auto, exported).unwrap();
        Class::new(roster(self.roster), hand_ins, self.policy.map(policy), self.count)
    }

    fn roll(&self) -> Roll {
        let score = |(_, earned): &(&str, Option<u64>)| {
            earned.map(|earned| Score { earned, possible: 50_000 })
        };
        let scores: Vec<Option<Score>> = self.files.iter().map(score).collect();
        let ids: Vec<String> = self.files.iter().map(|(name, _)| (*name).to_owned()).collect();
        self.class().settle(&scores, &ids)
    }
}

/// Returns what a row says in short: the standing, the hand-in, the deduction and the total.
fn short(member: &Member) -> (Standing, &str, Option<u64>, Option<u64>) {
    let hand_in = member.submission.as_deref().unwrap_or("");
    (member.standing, hand_in, member.deduction, member.total)
}

const CLASS: &str = "id,name,extension,handed_in\n1,Ann Lee,,\n2,Bo Day,2 days,\n3,Cy Fox,,\n";

#[test]
fn gradescope_gives_students_and_moments() {
    let one = |folder: &str, names: &[(&str, &str)], moment: &str| {
        let submitters: String = names
            .iter()
            .map(|(id, name)| format!("  - :name: {name}\n    :sid: '{id}'\n    :email: ''\n"))
            .collect();
        format!("{folder}:\n  :submitters:\n{submitters}  :created_at: {moment}\n")
    };
    let metadata = [
        one("submission_1", &[("1", "Ann Lee"), ("9", "Eve")], "2026-10-06 22:00:00 Z"),
        one("submission_2", &[("2", "Bo Day")], "2026-10-06 22:00:00 Z"),
        one("submission_4", &[("8", "Cy Fox")], "2026-10-05 20:00:00 Z"),
    ]
    .concat();
    let files = [
        ("submission_1/", Some(40_005)),
        ("submission_2/", Some(50_000)),
        ("submission_3/", Some(1)),
        ("submission_4/", Some(2)),
    ];
    let case = Case {
        roster: CLASS,
        policy: Some(POLICY),
        count: Count::Latest,
        metadata: Some(&metadata),
        files: &files,
    };
    let roll = case.roll();
    // Ann is late by one minute more than a day, so two days have started.
    assert_eq!(
        short(&roll.members[0]),
        (Standing::Graded, "submission_1/", Some(8_001), Some(32_004))
    );
    assert_eq!(roll.members[0].handed_in.as_deref(), Some("2026-10-07 00:00:00 +02:00"));
    assert_eq!(roll.members[0].late_s, Some(86_460));
    assert_eq!(short(&roll.members[1]), (Standing::Graded, "submission_2/", Some(0), Some(50_000)));
    assert_eq!(short(&roll.members[2]), (Standing::Nothing, "", None, None));
    let decisions: Vec<(&str, &str)> =
        roll.decisions.iter().map(|one| (&*one.hand_ins[0], &*one.why)).collect();
    assert_eq!(
        decisions,
        [
            ("submission_1", "Eve, 9: no student has this id or e-mail address"),
            ("submission_3", "the export does not say whose hand-in it is"),
            ("submission_4", "Cy Fox, 8: no student has this id or e-mail address"),
        ]
    );
    assert_eq!(roll.decisions[2].students, ["3"]);
}

#[test]
fn attempts_of_canvas_are_counted_as_stated() {
    let files = [
        ("leeann_11_101_hw.zip", Some(30_000)),
        ("leeann_11_102_hw-1.zip", Some(20_000)),
        ("leeann_11_103_report.pdf", None),
        ("daybo_LATE_12_104_hw.zip", Some(40_000)),
        ("foxcy_13_105_a.zip", Some(1)),
        ("foxcy_13_106_b.zip", Some(2)),
    ];
    let case = |count, policy| Case { roster: CLASS, policy, count, metadata: None, files: &files };
    let roll = case(Count::Latest, None).roll();
    let latest: Vec<_> = roll.members.iter().map(short).collect();
    assert_eq!(
        latest,
        [
            (Standing::Graded, "leeann_11_102_hw-1.zip", None, Some(20_000)),
            (Standing::Graded, "daybo_LATE_12_104_hw.zip", None, Some(40_000)),
            (Standing::Undecided, "", None, None),
        ]
    );
    assert_eq!(roll.decisions.len(), 1, "{:?}", roll.decisions);
    assert_eq!(roll.decisions[0].hand_ins, ["foxcy_13_105_a.zip", "foxcy_13_106_b.zip"]);
    let unused: Vec<&str> = roll.not_counted.iter().map(|one| &*one.hand_in).collect();
    assert_eq!(unused, ["leeann_11_101_hw.zip", "leeann_11_103_report.pdf"]);
    let graded = case(Count::Latest, None).class().is_graded();
    assert_eq!(graded, [false, true, false, true, true, true]);
    let roll = case(Count::Best, None).roll();
    let best: Vec<_> = roll.members.iter().map(|one| short(one).1).collect();
    let expected = ["leeann_11_101_hw.zip", "daybo_LATE_12_104_hw.zip", "foxcy_13_106_b.zip"];
    assert_eq!(best, expected);
    let roll = case(Count::Latest, Some(POLICY)).roll();
    assert_eq!(short(&roll.members[0]).2, Some(0), "Canvas does not mark it as late");
    let (standing, _, deduction, total) = short(&roll.members[1]);
    assert_eq!((standing, deduction, total), (Standing::Graded, None, None));
    assert!(roll.decisions.iter().any(|one| one.why.contains("handed_in")), "{roll:?}");
}

#[test]
fn a_moment_in_the_roster_serves_an_export_without_one() {
    let roster = CLASS.replace("2,Bo Day,2 days,", "2,Bo Day,2 days,2026-10-08 00:20 +02:00");
    let files = [("daybo_LATE_12_104_hw.zip", Some(40_000))];
    let case = Case {
        roster: &roster,
        policy: Some(POLICY),
        count: Count::Latest,
        metadata: None,
        files: &files,
    };
    let roll = case.roll();
    assert_eq!(short(&roll.members[1]).2, Some(4_000));
    assert_eq!(roll.members[1].late_s, Some(21 * 60));
    assert_eq!(roll.decisions, []);
}

#[test]
fn a_group_shares_its_hand_ins() {
    let files = [("red.zip", Some(30_000)), ("3/", None), ("4.zip", Some(10)), ("4/", Some(20))];
    let case = Case {
        roster: "id,name,group\n1,Ann Lee,red\n2,Bo Day,Red\n3,Cy Fox,\n4,Di Gray,\n",
        policy: None,
        count: Count::Latest,
        metadata: None,
        files: &files,
    };
    let roll = case.roll();
    let found: Vec<_> = roll.members.iter().map(short).collect();
    assert_eq!(
        found,
        [
            (Standing::Graded, "red.zip", None, Some(30_000)),
            (Standing::Graded, "red.zip", None, Some(30_000)),
            (Standing::NotGraded, "3/", None, None),
            (Standing::Undecided, "", None, None),
        ]
    );
}

#[test]
fn the_best_is_not_known_if_one_could_not_be_graded() {
    let files = [("1.zip", Some(30_000)), ("1/", None), ("2.zip", Some(5)), ("2/", Some(5))];
    let case =
        Case { roster: CLASS, policy: None, count: Count::Best, metadata: None, files: &files };
    let roll = case.roll();
    assert_eq!(short(&roll.members[0]), (Standing::Undecided, "", None, None));
    assert_eq!(short(&roll.members[1]), (Standing::Graded, "2.zip", None, Some(5)));
    assert_eq!(roll.decisions.len(), 1);
    assert_eq!(roll.not_counted.len(), 1);
}

proptest! {
    /// Every student has a row, and every hand-in is counted, set aside, or up for a decision.
    #[test]
    fn nothing_is_lost(
        names in proptest::collection::btree_set(
            "(1|2|3|Ann Lee|ann|leeann_11_101_hw|leeann_11_102_hw-1|\u{202e}|=1)(\\.zip|\\.pdf|/)",
            1..8,
        ),
        is_best in any::<bool>(),
    ) {
        let files: Vec<(&str, Option<u64>)> =
            names.iter().map(|name| (&**name, Some(name.len() as u64))).collect();
        let count = if is_best { Count::Best } else { Count::Latest };
        let case = Case { roster: CLASS, policy: None, count, metadata: None, files: &files };
        let roll = case.roll();
        prop_assert_eq!(roll.members.len(), 3);
        for name in &names {
            let shown = name.trim_end_matches('/').to_owned();
            let is_counted =
                roll.members.iter().any(|one| one.submission.as_deref() == Some(&**name));
            let is_decided = roll.decisions.iter().any(|one| one.hand_ins.contains(&shown));
            let is_aside = roll.not_counted.iter().any(|one| one.hand_in == shown);
            prop_assert!(is_counted || is_decided || is_aside, "{} in {:?}", name, roll);
        }
        for (one, other) in [(0, 1), (0, 2), (1, 2)] {
            let (one, other) = (&roll.members[one].submission, &roll.members[other].submission);
            prop_assert!(one.is_none() || one != other, "two students share {:?}", one);
        }
    }
}
