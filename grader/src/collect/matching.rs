//! Finds the student of a hand-in. What is not certain is left to a person.

use std::collections::{BTreeMap, BTreeSet};

use super::hand_in::Claim;
use super::roster::{Roster, Student};
use super::table::plain_key;

/// The reason why a claim has no certain student.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Doubt {
    /// The students that come into question, by their place in the roster.
    pub candidates: BTreeSet<usize>,
    /// The reason.
    pub why: &'static str,
}

/// The students of a roster by everything that can name them, without regard to case.
#[derive(Debug, Default)]
pub struct Index {
    ids: BTreeMap<String, usize>,
    emails: BTreeMap<String, usize>,
    accounts: BTreeMap<String, usize>,
    /// Students by the letters and digits of their name, the first name first.
    names: BTreeMap<String, BTreeSet<usize>>,
    /// Students by the letters and digits of their name, in any rotation of its words.
    squeezed: BTreeMap<String, BTreeSet<usize>>,
    /// The members of each group.
    groups: BTreeMap<String, BTreeSet<usize>>,
}

impl Index {
    /// Returns the index of a roster.
    pub fn new(roster: &Roster) -> Self {
        let mut index = Self::default();
        for (n, student) in roster.students.iter().enumerate() {
            let keys = [
                (&mut index.ids, &student.id),
                (&mut index.emails, &student.email),
                (&mut index.accounts, &student.account),
            ];
            for (map, key) in keys {
                if !key.is_empty() {
                    map.insert(key.to_lowercase(), n);
                }
            }
            if !student.group.is_empty() {
                index.groups.entry(student.group.to_lowercase()).or_default().insert(n);
            }
            index.add_name(n, &student.name);
        }
        index
    }

    fn add_name(&mut self, n: usize, name: &str) {
        let in_order = match name.split_once(',') {
            Some((last, first)) => format!("{first} {last}"),
            None => name.to_owned(),
        };
        let words: Vec<&str> = in_order.split_whitespace().collect();
        for at in 0..words.len() {
            let key = plain_key(&[&words[at..], &words[..at]].concat().concat());
            if at == 0 && !key.is_empty() {
                self.names.entry(key.clone()).or_default().insert(n);
            }
            if !key.is_empty() {
                self.squeezed.entry(key).or_default().insert(n);
            }
        }
    }

    /// Returns the students who handed in together with `student`, who is one of them.
    pub fn partners(&self, student: usize, roster: &Roster) -> BTreeSet<usize> {
        let group = roster.students[student].group.to_lowercase();
        self.groups.get(&group).cloned().unwrap_or_else(|| BTreeSet::from([student]))
    }

    /// Returns the students that a claim names.
    ///
    /// # Errors
    /// The claim names no student, more than one, or contradicts itself or the roster.
    pub fn find(&self, claim: &Claim, roster: &Roster) -> Result<BTreeSet<usize>, Doubt> {
        match claim {
            Claim::Person { id, email, name } => self.person(id, email, name, &roster.students),
            Claim::Numbered { account, name, is_squeezed } => {
                self.numbered(account, self.named(name, *is_squeezed))
            }
            Claim::Account(login) => match self.accounts.get(&login.to_lowercase()) {
                Some(n) => Ok(BTreeSet::from([*n])),
                None => {
                    Err(Doubt { candidates: BTreeSet::new(), why: "no student has this account" })
                }
            },
            Claim::Any(text) => self.any(text),
        }
    }

    fn named(&self, name: &str, is_squeezed: bool) -> BTreeSet<usize> {
        let map = if is_squeezed { &self.squeezed } else { &self.names };
        map.get(&plain_key(name)).cloned().unwrap_or_default()
    }

    fn person(
        &self,
        id: &str,
        email: &str,
        name: &str,
        students: &[Student],
    ) -> Result<BTreeSet<usize>, Doubt> {
        let by_id = self.ids.get(&id.to_lowercase()).copied();
        let by_email = self.emails.get(&email.to_lowercase()).copied();
        match (by_id, by_email) {
            (Some(a), Some(b)) if a != b => Err(Doubt {
                candidates: BTreeSet::from([a, b]),
                why: "the id and the e-mail address are those of two students",
            }),
            (Some(n), _) => Ok(BTreeSet::from([n])),
            (None, Some(n)) if id.is_empty() || students[n].id.is_empty() => {
                Ok(BTreeSet::from([n]))
            }
            (None, Some(n)) => Err(Doubt {
                candidates: BTreeSet::from([n]),
                why: "the e-mail address is that of a student with another id",
            }),
            (None, None) => Err(Doubt {
                candidates: self.named(name, false),
                why: "no student has this id or e-mail address",
            }),
        }
    }

    /// The platform's number decides if the roster has it. A name alone decides only if it is that
    /// of one student, and the roster has no numbers.
    fn numbered(&self, account: &str, named: BTreeSet<usize>) -> Result<BTreeSet<usize>, Doubt> {
        let doubt = |candidates, why| Err(Doubt { candidates, why });
        if !self.accounts.is_empty() {
            return match self.accounts.get(account) {
                Some(n) if named.is_empty() || named.contains(n) => Ok(BTreeSet::from([*n])),
                Some(n) => {
                    let candidates = named.into_iter().chain([*n]).collect();
                    doubt(candidates, "the number and the name are those of two students")
                }
                None => doubt(named, "no student has this number of the platform"),
            };
        }
        match (named.len(), self.ids.get(account)) {
            (0, None) => doubt(named, "no student has this name"),
            (0, Some(n)) => {
                doubt(BTreeSet::from([*n]), "the number is an id of the roster, but not the name")
            }
            (_, Some(n)) if named.contains(n) => Ok(BTreeSet::from([*n])),
            (1, None) => Ok(named),
            (_, None) => doubt(named, "several students have this name"),
            (_, Some(n)) => {
                let candidates = named.into_iter().chain([*n]).collect();
                doubt(candidates, "the number is the id of a student with another name")
            }
        }
    }

    fn any(&self, text: &str) -> Result<BTreeSet<usize>, Doubt> {
        let key = text.to_lowercase();
        let exact = [&self.ids, &self.emails, &self.accounts].map(|map| map.get(&key).copied());
        let mut found: BTreeSet<usize> = exact.into_iter().flatten().collect();
        found.extend(self.named(text, false));
        let group = self.groups.get(&key).cloned().unwrap_or_default();
        match (found.len(), group.is_empty()) {
            (0, true) => Err(Doubt {
                candidates: self.named(text, true),
                why: "no student has this id, account, e-mail address or name",
            }),
            (1, true) => Ok(found),
            (0, false) => Ok(group),
            // The id of a student may also be the name of that student's group.
            (1, false) if found.is_subset(&group) => Ok(found),
            (_, _) => {
                found.extend(group);
                Err(Doubt { candidates: found, why: "it names several students" })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const ROSTER: &str = "id,name,email,group\n\
        17,Ann Lee,ann@example.org,\n\
        18,\"Lee, Bo\",bo@example.org,\n\
        19,Thomas James,tj@example.org,red\n\
        20,James Thomas,jt@example.org,red\n\
        21,Ann Lee,ann2@example.org,\n\
        22,Zoë O'Hara,zoe@example.org,\n\
        blue,Maria de la Cruz,maria@example.org,blue\n\
        bo,Li Wu,li@example.org,\n";

    fn roster(text: &str) -> Roster {
        Roster::parse("roster.csv", text.as_bytes()).unwrap_or_else(|why| panic!("{why}"))
    }

    /// Returns the ids of the students, or those of the candidates.
    fn find(roster: &Roster, claim: &Claim) -> Result<Vec<String>, Vec<String>> {
        let ids = |found: BTreeSet<usize>| -> Vec<String> {
            found.into_iter().map(|n| roster.students[n].id.clone()).collect()
        };
        Index::new(roster).find(claim, roster).map(ids).map_err(|doubt| ids(doubt.candidates))
    }

    #[track_caller]
    fn check(roster: &Roster, claim: &Claim, expected: Result<&[&str], &[&str]>) {
        let found = find(roster, claim);
        let owned = |ids: &[&str]| ids.iter().map(|id| (*id).to_owned()).collect::<Vec<_>>();
        assert_eq!(found, expected.map(owned).map_err(owned), "{claim:?}");
    }

    #[test]
    fn a_person_is_found_by_id_and_address() {
        let roster = roster(ROSTER);
        let person = |id: &str, email: &str, name: &str| Claim::Person {
            id: id.to_owned(),
            email: email.to_owned(),
            name: name.to_owned(),
        };
        for (claim, expected) in [
            (person("17", "ann@example.org", "Ann Lee"), Ok(&["17"][..])),
            (person("17", "other@example.org", "Annie"), Ok(&["17"])),
            (person("", "ANN@example.org", "x"), Ok(&["17"])),
            (person("17", "bo@example.org", "Ann Lee"), Err(&["17", "18"][..])),
            (person("99", "bo@example.org", "Bo Lee"), Err(&["18"])),
            (person("99", "", "Bo Lee"), Err(&["18"])),
            (person("", "", "Ann Lee"), Err(&["17", "21"])),
            (person("", "", ""), Err(&[])),
        ] {
            check(&roster, &claim, expected);
        }
    }

    #[test]
    fn a_squeezed_name_decides_only_if_it_is_certain() {
        let roster = roster(ROSTER);
        let claim = |account: &str, name: &str| Claim::Numbered {
            account: account.to_owned(),
            name: name.to_owned(),
            is_squeezed: true,
        };
        for (claim, expected) in [
            (claim("4711", "leebo"), Ok(&["18"][..])),
            (claim("4711", "oharazoë"), Ok(&["22"])),
            (claim("4711", "delacruzmaria"), Ok(&["blue"])),
            (claim("4711", "leeann"), Err(&["17", "21"][..])),
            (claim("21", "leeann"), Ok(&["21"])),
            (claim("17", "leebo"), Err(&["17", "18"])),
            (claim("4711", "jamesthomas"), Err(&["19", "20"])),
            (claim("17", "nobody"), Err(&["17"])),
            (claim("4711", "nobody"), Err(&[])),
            (claim("4711", ""), Err(&[])),
        ] {
            check(&roster, &claim, expected);
        }
    }

    #[test]
    fn a_number_of_the_platform_decides_if_the_roster_has_it() {
        let roster = roster("id,name,account\n1,Ann Lee,11\n2,Bo Day,12\n3,Cy Fox,\n");
        let claim = |account: &str, name: &str| Claim::Numbered {
            account: account.to_owned(),
            name: name.to_owned(),
            is_squeezed: false,
        };
        for (claim, expected) in [
            (claim("11", "Ann Lee"), Ok(&["1"][..])),
            (claim("11", "Annie"), Ok(&["1"])),
            (claim("11", "Bo Day"), Err(&["1", "2"][..])),
            (claim("13", "Cy Fox"), Err(&["3"])),
            (Claim::Account("12".to_owned()), Ok(&["2"])),
            (Claim::Account("2".to_owned()), Err(&[])),
        ] {
            check(&roster, &claim, expected);
        }
    }

    #[test]
    fn the_name_of_a_folder_is_anything_that_names_one_student() {
        let roster = roster(ROSTER);
        for (text, expected) in [
            ("18", Ok(&["18"][..])),
            ("BO@example.org", Ok(&["18"])),
            ("bo lee", Ok(&["18"])),
            ("Bo_Lee", Ok(&["18"])),
            ("James Thomas", Ok(&["20"])),
            ("red", Ok(&["19", "20"])),
            ("blue", Ok(&["blue"])),
            ("bo", Ok(&["bo"])),
            ("Ann Lee", Err(&["17", "21"][..])),
            ("Lee Bo", Err(&["18"])),
            ("18 ", Err(&[])),
            ("", Err(&[])),
            ("\u{202e}18", Err(&[])),
        ] {
            check(&roster, &Claim::Any(text.to_owned()), expected);
        }
    }

    proptest! {
        #[test]
        fn a_name_of_two_students_never_decides(
            name in "[A-C]{1,3} [A-C]{1,3}", other in "[A-C]{1,3} [A-C]{1,3}", number in 10..99_u32,
        ) {
            let roster = roster(&format!("id,name\n1,{name}\n2,{name}\n3,{other}\n"));
            for is_squeezed in [false, true] {
                let (account, name) = (number.to_string(), name.clone());
                let claim = Claim::Numbered { account, name, is_squeezed };
                prop_assert!(find(&roster, &claim).is_err());
            }
            prop_assert!(find(&roster, &Claim::Any(name)).is_err());
        }
    }
}
