//! Tests of courses: the committed file, illegal values, and the search for a course.

use std::path::Path;

use cases::Course;
use cases::course::{self, Air, DECISIONS, DepthTest, Legal, TwoSided};

fn parse(text: &str) -> Course {
    course::parse("course.toml", text).unwrap_or_else(|problems| panic!("{text}: {problems}"))
}

#[test]
fn the_committed_course_says_everything_and_is_the_lecture() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("course.toml");
    let text = std::fs::read_to_string(path).unwrap();
    assert_eq!(parse(&text), Course::default());
    let lines = text.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
    let expected =
        DECISIONS.iter().map(|decision| format!("{} = {}", decision.key, decision.legal.lecture()));
    assert_eq!(lines.collect::<Vec<_>>(), expected.collect::<Vec<_>>());
}

#[test]
fn every_legal_value_is_read_and_said_as_it_is_written() {
    let mut n_values = 0;
    for (n, decision) in DECISIONS.iter().enumerate() {
        let values: Vec<String> = match decision.legal {
            Legal::Effects => {
                ["[]", "[\"shadows\"]", "[\"shadows\", \"reflection\"]"].map(str::to_owned).to_vec()
            }
            Legal::OneOf(values) => values.iter().map(|(value, _)| (*value).to_owned()).collect(),
            Legal::Range { least, most, lecture } => {
                [least, most, lecture].map(|value| format!("{value:e}")).to_vec()
            }
        };
        for value in values {
            let course = parse(&format!("{} = {value}", decision.key));
            assert_eq!(course.written()[n], value, "{}", decision.key);
            let n_changed = course
                .written()
                .iter()
                .zip(Course::default().written())
                .filter(|(new, old)| *new != old)
                .count();
            assert_eq!(
                n_changed,
                usize::from(value != decision.legal.lecture()),
                "{} = {value}",
                decision.key
            );
            n_values += 1;
        }
    }
    assert!(n_values > 35, "{n_values}");
    assert_eq!(parse("index_of_air = 1").index_of_air, Air::Vacuum);
    assert_eq!(parse("depth = '<='\ntwo_sided = \"always\"").two_sided, TwoSided::Always);
}

#[test]
fn what_no_course_decides_is_refused_with_its_place_and_a_way_out() {
    let table = [
        (
            "highlight = \"pong\"",
            (1, 13),
            "did you mean `\"phong\"`? legal values are `\"blinn\"` and `\"phong\"`",
        ),
        ("\ndepht = \"<=\"", (2, 1), "did you mean `depth`?"),
        ("gamma = 2.2", (1, 1), "its keys are `pixel`, `row_0`"),
        ("index_of_air = 1.3", (1, 16), "`index_of_air` cannot be 1.3"),
        ("index_of_air = nan", (1, 16), "this number cannot be used"),
        ("depth = true", (1, 9), "this is true or false, not one of `\"<\"` and `\"<=\"`"),
        ("depth = 1", (1, 9), "`depth` cannot be 1.0"),
        ("epsilon = 1e-9", (1, 11), "expected a number from 1e-6 to 1e-3"),
        ("epsilon = 0.01", (1, 11), "expected a number from 1e-6 to 1e-3"),
        ("epsilon = \"small\"", (1, 11), "this is a text, not a number from 1e-6 to 1e-3"),
    ];
    for (text, place, said) in table {
        let problems = course::parse("course.toml", text).expect_err(text);
        let all: Vec<_> = problems.iter().collect();
        assert_eq!(all.len(), 1, "{text}: {problems}");
        assert_eq!(all[0].line_column(), Some(place), "{text}: {problems}");
        assert!(problems.to_string().contains(said), "{text}: {problems}");
    }
    let two = course::parse("course.toml", "pixel = \"center\"\ntint = \"twice\"").unwrap_err();
    assert_eq!(two.iter().count(), 2, "{two}");
}

#[test]
fn the_course_of_a_case_lies_in_the_folder_of_its_stages_or_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let stage = folder.path().join("mine/stages/01_one");
    std::fs::create_dir_all(&stage).unwrap();
    for name in ["stage.toml", "card.toml"] {
        std::fs::write(stage.join(name), "").unwrap();
    }
    let (stages, case) = (folder.path().join("mine/stages"), stage.join("card.toml"));
    let depths = || {
        [course::course_of(&stages), course::course_at(&case)].map(|course| course.unwrap().depth)
    };
    assert_eq!(depths(), [DepthTest::Less; 2], "the lecture's course, without a file");
    let file = folder.path().join("mine/course.toml");
    std::fs::write(&file, "depth = \"<=\"").unwrap();
    assert_eq!(depths(), [DepthTest::LessOrEqual; 2]);
    assert_eq!(course::course_of(&stages.join("01_one/..")).unwrap().depth, DepthTest::LessOrEqual);
    let inside = stages.join("course.toml");
    std::fs::write(&inside, "depth = \"<\"").unwrap();
    assert_eq!(depths(), [DepthTest::Less; 2], "the file in the folder, as in a varied set");
    std::fs::remove_file(&inside).unwrap();
    let elsewhere = folder.path().join("mine/scene.toml");
    std::fs::write(&elsewhere, "").unwrap();
    assert_eq!(
        course::course_at(&elsewhere).unwrap(),
        Course::default(),
        "a scene outside any stage"
    );
    std::fs::write(&file, "depth = \"<<\"").unwrap();
    assert!(course::course_of(&stages).unwrap_err().to_string().contains("mine/course.toml:1:9"));
}
