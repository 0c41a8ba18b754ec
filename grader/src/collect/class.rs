//! Joins the hand-ins of an export to the students of a roster, and decides which hand-in of a
//! student counts.

use std::collections::{BTreeMap, BTreeSet};

use clap::ValueEnum;

use super::hand_in::{HandIn, Mark};
use super::lateness::{Lateness, deduction, due, lateness};
use super::matching::Index;
use super::moment::{Clock, Moment};
use super::policy::Policy;
use super::roll::{Decision, Member, NotCounted, Roll, SCHEMA, Standing};
use super::roster::{Roster, Student};

/// The hand-in that counts if a student has several.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Count {
    /// The last one
    Latest,
    /// The one with the most points, after the deduction
    Best,
}

/// The score of a hand-in, in thousandths of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Score {
    /// The points that it earned.
    pub earned: u64,
    /// The points that it could earn.
    pub possible: u64,
}

/// Students with their hand-ins.
#[derive(Debug)]
pub struct Class {
    roster: Roster,
    policy: Option<Policy>,
    count: Count,
    hand_ins: Vec<HandIn>,
    /// The hand-ins of each student that can count, by the student's place in the roster.
    of: Vec<Vec<usize>>,
    decisions: Vec<Decision>,
    not_counted: BTreeMap<usize, NotCounted>,
}

impl Class {
    /// Joins the hand-ins to the students.
    pub fn new(
        roster: Roster,
        hand_ins: Vec<HandIn>,
        policy: Option<Policy>,
        count: Count,
    ) -> Self {
        let of = vec![vec![]; roster.students.len()];
        let (decisions, not_counted) = (vec![], BTreeMap::new());
        let mut class = Self { roster, policy, count, hand_ins, of, decisions, not_counted };
        class.join();
        class.set_files_aside();
        if count == Count::Latest {
            class.keep_the_latest();
        }
        class
    }

    /// Lists hand-ins that the export names and does not hold, so that nobody seems to have handed
    /// in nothing.
    pub fn note_missing(&mut self, missing: &[HandIn]) {
        let index = Index::new(&self.roster);
        for one in missing {
            let found = one.claims.iter().filter_map(|claim| index.find(claim, &self.roster).ok());
            let owners: BTreeSet<usize> = found.flatten().collect();
            let why = "the export names this hand-in, but its folder is missing: unpack it again";
            self.decisions.push(Decision {
                hand_ins: vec![one.name.clone()],
                students: ids(&self.roster, owners.iter()),
                why: why.to_owned(),
            });
        }
    }

    /// Returns which hand-ins are to be graded: all except those that do not count anyway.
    pub fn is_graded(&self) -> Vec<bool> {
        (0..self.hand_ins.len()).map(|n| !self.not_counted.contains_key(&n)).collect()
    }

    fn join(&mut self) {
        let index = Index::new(&self.roster);
        for n in 0..self.hand_ins.len() {
            let hand_in = &self.hand_ins[n];
            let mut owners = BTreeSet::new();
            if hand_in.claims.is_empty() {
                let why = "the export does not say whose hand-in it is".to_owned();
                let hand_ins = vec![hand_in.name.clone()];
                self.decisions.push(Decision { hand_ins, students: vec![], why });
            }
            for claim in &hand_in.claims {
                match index.find(claim, &self.roster) {
                    Ok(found) => owners.extend(found),
                    Err(doubt) => {
                        let why = format!("{}: {}", claim.shown(), doubt.why);
                        let students = ids(&self.roster, doubt.candidates.iter());
                        let hand_ins = vec![hand_in.name.clone()];
                        self.decisions.push(Decision { hand_ins, students, why });
                    }
                }
            }
            let with_partners: BTreeSet<usize> =
                owners.iter().flat_map(|owner| index.partners(*owner, &self.roster)).collect();
            with_partners.into_iter().for_each(|owner| self.of[owner].push(n));
        }
    }

    /// Sets aside single files of students who also handed in a folder or an archive: a report
    /// beside the program.
    fn set_files_aside(&mut self) {
        for own in &mut self.of {
            if own.iter().any(|n| self.hand_ins[*n].is_whole) {
                own.retain(|n| self.hand_ins[*n].is_whole);
            }
        }
        let used: BTreeSet<usize> = self.of.iter().flatten().copied().collect();
        let why = "a single file beside a folder or an archive of the same student";
        self.note_unused(&used, |_| why.to_owned());
    }

    /// Notes the hand-ins that have students and that none of them uses.
    fn note_unused(&mut self, used: &BTreeSet<usize>, why: impl Fn(usize) -> String) {
        let index = Index::new(&self.roster);
        for n in (0..self.hand_ins.len()).filter(|n| !used.contains(n)) {
            let hand_in = &self.hand_ins[n];
            let found = hand_in.claims.iter().map(|claim| index.find(claim, &self.roster));
            let found: Option<Vec<BTreeSet<usize>>> = found.map(Result::ok).collect();
            let owners: BTreeSet<usize> = found.into_iter().flatten().flatten().collect();
            if owners.is_empty() || self.not_counted.contains_key(&n) {
                continue;
            }
            let students = ids(&self.roster, owners.iter());
            let (hand_in, why) = (hand_in.name.clone(), why(n));
            self.not_counted.insert(n, NotCounted { hand_in, students, why });
        }
    }

    fn keep_the_latest(&mut self) {
        for student in 0..self.of.len() {
            if self.of[student].len() < 2 {
                continue;
            }
            let own: Vec<(usize, &HandIn)> =
                self.of[student].iter().map(|n| (*n, &self.hand_ins[*n])).collect();
            match latest(&own) {
                Some(n) => self.of[student] = vec![n],
                None => self.decisions.push(Decision {
                    hand_ins: own.iter().map(|(_, one)| one.name.clone()).collect(),
                    students: vec![self.roster.students[student].id.clone()],
                    why: "several hand-ins, and nothing says which one is the latest".to_owned(),
                }),
            }
        }
        let used: BTreeSet<usize> = self.of.iter().flatten().copied().collect();
        self.note_unused(&used, |_| "a later hand-in counts".to_owned());
    }

    /// Returns the roll, from the score of each hand-in and the id of its submission. `None` stands
    /// for a hand-in without a record.
    pub fn settle(&self, scores: &[Option<Score>], submissions: &[String]) -> Roll {
        let mut roll = Roll {
            schema: SCHEMA,
            deadline: self.policy.map(|policy| policy.deadline.to_string()),
            decisions: self.decisions.clone(),
            not_counted: self.not_counted.values().cloned().collect(),
            ..Roll::default()
        };
        for (student, own) in self.roster.students.iter().zip(&self.of) {
            let results: Vec<Member> = own
                .iter()
                .map(|n| {
                    // The moment in the roster is that of one hand-in: the one that counts.
                    let moment = student.handed_in.filter(|_| own.len() == 1);
                    let moment = self.hand_ins[*n].handed_in.or(moment);
                    self.member(student, (*n, moment), scores[*n], &submissions[*n])
                })
                .collect();
            let member = self.counted(student, own, results, &mut roll);
            roll.members.push(member);
        }
        roll
    }

    /// Returns the row of a student, from the rows that each of the student's hand-ins would give.
    fn counted(
        &self,
        student: &Student,
        own: &[usize],
        results: Vec<Member>,
        roll: &mut Roll,
    ) -> Member {
        let is_clear = self.count == Count::Best || own.len() == 1;
        let timeless = results.iter().any(|one| one.earned.is_some() && one.total.is_none());
        let hand_ins = || own.iter().map(|n| self.hand_ins[*n].name.clone()).collect();
        let mut decide = |why: &str| {
            let students = vec![student.id.clone()];
            roll.decisions.push(Decision { hand_ins: hand_ins(), students, why: why.to_owned() });
        };
        if results.is_empty() {
            return of_student(student, Standing::Nothing);
        }
        if timeless && is_clear {
            decide(
                "the moment of the hand-in is not known, so neither is the deduction: give it in \
                 the column handed_in of the roster",
            );
        }
        if results.len() == 1 {
            return results.into_iter().next().unwrap_or_default();
        }
        if !is_clear || timeless {
            return of_student(student, Standing::Undecided);
        }
        if results.iter().any(|one| one.total.is_none()) {
            decide("one of several hand-ins could not be graded, so the best one is not known");
            return of_student(student, Standing::Undecided);
        }
        // Of equally good ones, the first in the export counts.
        let best = (0..results.len()).rev().max_by_key(|n| results[*n].total).unwrap_or(0);
        for (n, result) in results.iter().enumerate().filter(|(n, _)| *n != best) {
            roll.not_counted.push(NotCounted {
                hand_in: self.hand_ins[own[n]].name.clone(),
                students: vec![student.id.clone()],
                why: match result.total == results[best].total {
                    true => "another hand-in has as many points".to_owned(),
                    false => "another hand-in has more points".to_owned(),
                },
            });
        }
        results.into_iter().nth(best).unwrap_or_default()
    }

    /// Returns the row of a student if this hand-in counts.
    fn member(
        &self,
        student: &Student,
        (hand_in, moment): (usize, Option<Moment>),
        score: Option<Score>,
        submission: &str,
    ) -> Member {
        let mark = self.hand_ins[hand_in].mark;
        let clock = self.policy.map_or(Clock { moment: EPOCH, offset_s: 0 }, |one| one.deadline);
        let late = self.policy.map(|policy| late(&policy, student, mark, moment));
        let standing = if score.is_some() { Standing::Graded } else { Standing::NotGraded };
        let mut member = Member {
            submission: Some(submission.to_owned()),
            earned: score.map(|score| score.earned),
            possible: score.map(|score| score.possible),
            handed_in: moment.map(|moment| clock.of(moment).to_string()),
            late_s: late.flatten().map(|late| late.late_s),
            ..of_student(student, standing)
        };
        let (policy, Some(score)) = (self.policy, score) else { return member };
        member.deduction = match (policy, late) {
            (Some(policy), Some(Some(late))) => {
                Some(deduction(&policy, late, score.earned, score.possible))
            }
            _ => None,
        };
        member.total = match (policy, member.deduction) {
            (None, _) => Some(score.earned),
            (Some(_), deduction) => {
                deduction.map(|deduction| score.earned.saturating_sub(deduction))
            }
        };
        member
    }
}

const EPOCH: Moment = Moment { unix_s: 0 };

fn ids<'a>(roster: &Roster, students: impl Iterator<Item = &'a usize>) -> Vec<String> {
    students.map(|n| roster.students[*n].id.clone()).collect()
}

fn of_student(student: &Student, standing: Standing) -> Member {
    Member {
        id: student.id.clone(),
        name: student.name.clone(),
        email: student.email.clone(),
        account: student.account.clone(),
        section: student.section.clone(),
        group: student.group.clone(),
        standing,
        ..Member::default()
    }
}

/// Returns the lateness; `None` if the moment is not known and the platform does not say either
/// that the hand-in was in time.
fn late(
    policy: &Policy,
    student: &Student,
    mark: Mark,
    moment: Option<Moment>,
) -> Option<Lateness> {
    match (moment, mark) {
        (Some(moment), _) => Some(lateness(policy, due(policy, student.extension), moment)),
        (None, Mark::InTime) => Some(Lateness::NONE),
        (None, Mark::Late | Mark::None) => None,
    }
}

/// Returns the latest of several hand-ins by their moments, or by the numbers of their attempts.
/// `None` if neither puts them in order.
fn latest(own: &[(usize, &HandIn)]) -> Option<usize> {
    let moments: Option<BTreeSet<Moment>> = own.iter().map(|(_, one)| one.handed_in).collect();
    if let Some(moments) = moments {
        let last = moments.last()?;
        let mut lasts = own.iter().filter(|(_, one)| one.handed_in == Some(*last));
        return lasts.next().map(|(n, _)| *n).filter(|_| lasts.next().is_none());
    }
    let stem = &own.first()?.1.stem;
    let last = own.iter().map(|(_, one)| one.attempt).max()?;
    let mut lasts = own.iter().filter(|(_, one)| one.attempt == last);
    let first = lasts.next().map(|(n, _)| *n);
    let is_certain = lasts.next().is_none() && own.iter().all(|(_, one)| one.stem == *stem);
    first.filter(|_| is_certain)
}
