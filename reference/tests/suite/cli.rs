//! Tests of the program from outside: exit codes, messages, files.

use cases::{Course, film, stage};
use reference::expect::students_picture;
use reference::rules::Rules;
use reference::rules::misconceptions;

use crate::common::program::{SCENE, check, expect, folder, run};

#[test]
fn renders_to_every_kind_of_file_and_to_the_stream() {
    let folder = folder();
    for (out, magic) in
        [("a.png", &b"\x89PNG"[..]), ("a.pfm", b"PF\n8 6\n"), ("a.exr", b"\x76\x2f\x31\x01")]
    {
        expect(&run(folder.path(), &["render", "scene.toml", "-o", out], ""), 0, "");
        assert!(std::fs::read(folder.path().join(out)).unwrap().starts_with(magic), "{out}");
    }
    let streamed = run(folder.path(), &["render", "scene.toml", "-o", "-"], "");
    assert_eq!(streamed.stdout, std::fs::read(folder.path().join("a.png")).unwrap());
    expect(&run(folder.path(), &["render", "scene.toml", "positional.png"], ""), 0, "");
    assert_eq!(streamed.stdout, std::fs::read(folder.path().join("positional.png")).unwrap());
}

#[test]
fn known_mistakes_are_made_together() {
    let folder = folder();
    let picture = |mistakes: &[&str]| {
        let args = [&["render", "scene.toml", "a.pfm"], mistakes].concat();
        expect(&run(folder.path(), &args, ""), 0, "");
        std::fs::read(folder.path().join("a.pfm")).unwrap()
    };
    let path = folder.path().join("scene.toml");
    let scene = stage::load_scene(&path, &Course::default()).unwrap();
    let mut rules = Rules::LECTURE;
    for wrong in misconceptions::of(&Rules::LECTURE) {
        if ["horizontal_fov", "pixel_corner"].contains(&wrong.id) {
            (wrong.apply)(&mut rules);
        }
    }
    let both = picture(&["--mistakes", "horizontal_fov,pixel_corner"]);
    let expected = students_picture(&scene, &rules.plain());
    assert_eq!(both, film::encode(film::Kind::Pfm, &expected).unwrap());
    assert_ne!(both, picture(&["--mistakes", "horizontal_fov"]));
    let refused = |mistakes: &str, says: &str| {
        let args = ["render", "scene.toml", "a.pfm", "--mistakes", mistakes];
        expect(&run(folder.path(), &args, ""), 2, says);
    };
    refused("no_ambiemt", "did you mean `no_ambient`?");
    refused("no_ambient,ambient_in_shadow", "mistakes of the same decision");
}

#[test]
fn stats_count_rays() {
    let folder = folder();
    let output = run(
        folder.path(),
        &["render", "scene.toml", "a.png", "--samples", "2", "--stats", "json"],
        "",
    );
    let stats: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(stats["rays"]["eye"], 8 * 6 * 4);
    assert_eq!(stats["rays"]["reflected"], 0);
}

#[test]
fn a_greater_depth_calls_for_what_the_file_does_not_within_the_stage() {
    let folder = folder();
    // Two objects: from a lone square, a reflected ray could only miss, and would not be cast.
    let other = "[[scene.objects]]\nsphere = { center = [0, 0, 9] }\nmaterial = \"m\"\n";
    let mirror =
        SCENE.replace("max_depth = 1", "max_depth = 0").replace("m = {", "m = { kr = [1, 1, 1],")
            + other;
    std::fs::write(folder.path().join("mirror.toml"), &mirror).unwrap();
    let head = "title = \"t\"\nabout = \"a\"\nrules = [3]\npoints = 2\n";
    std::fs::write(folder.path().join("stages/01_one/mirror.toml"), format!("{head}{mirror}"))
        .unwrap();
    let n_reflected = |args: &[&str]| {
        let output =
            run(folder.path(), &[&["render"], args, &["a.png", "--stats", "json"]].concat(), "");
        let stats: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        stats["rays"]["reflected"].as_u64().unwrap()
    };
    assert_eq!(n_reflected(&["mirror.toml"]), 0);
    assert!(n_reflected(&["mirror.toml", "--max-depth", "1"]) > 0);
    // The stage allows no reflection.
    assert_eq!(n_reflected(&["stages/01_one/mirror.toml", "--max-depth", "1"]), 0);
}

#[test]
fn a_threshold_ends_paths_and_what_it_leaves_out_is_bounded() {
    let folder = folder();
    let mirrors = SCENE
        .replace("max_depth = 1", "max_depth = 6")
        .replace("m = {", "m = { ke = [1, 1, 1], kr = [0.5, 0.5, 0.5],");
    let inside = mirrors
        .replace("eye = [0, 0, 4]", "eye = [0, 0, 0.1]")
        .replace("kd = [0.5, 0.5, 0.5]", "kd = [0, 0, 0]");
    std::fs::write(folder.path().join("mirrors.toml"), &inside).unwrap();
    let head = "title = \"t\"\nabout = \"a\"\nrules = [3]\npoints = 2\n";
    std::fs::write(folder.path().join("stages/01_one/mirrors.toml"), format!("{head}{inside}"))
        .unwrap();
    let stats = |args: &[&str]| {
        let args = [&["render", "mirrors.toml", "a.png", "--stats", "json"], args].concat();
        let stats: serde_json::Value =
            serde_json::from_slice(&run(folder.path(), &args, "").stdout).unwrap();
        (stats["rays"]["reflected"].as_u64().unwrap(), stats["left_out_at_most"].as_f64().unwrap())
    };
    // From inside, every ray hits the ball, which emits 1 and reflects half. A ray of weight w that
    // is left out would add 2 w.
    assert_eq!(stats(&[]), (8 * 6 * 6, 2.0 * 0.5 * 0.5 * 0.5 * 0.5 * 0.5 * 0.5 * 0.5));
    assert_eq!(stats(&["--threshold", "1/4"]), (8 * 6 * 3, 2.0 * 0.5 * 0.5 * 0.5 * 0.5));
    assert_eq!(stats(&["--threshold", "0"]).0, 8 * 6 * 6);
    assert_eq!(stats(&["--max-depth", "0"]), (0, 2.0 * 0.5));
    let render = |args: &[&str]| {
        run(folder.path(), &[&["render"], args, &["a.png", "--stats"]].concat(), "")
    };
    expect(
        &render(&["stages/01_one/mirrors.toml", "--threshold", "0.1"]),
        2,
        "does not allow adaptive_depth",
    );
    expect(
        &render(&["stages/01_one/mirrors.toml", "--threshold", "0.1", "--effects", "all"]),
        0,
        "",
    );
    expect(&render(&["mirrors.toml", "--threshold", "2"]), 2, "from 0 to 1");
    let said = render(&["mirrors.toml"]).stdout;
    assert!(
        String::from_utf8_lossy(&said)
            .contains("darken no pixel by more than 3.98 levels (proven)"),
        "2/128 of 255"
    );
}

#[test]
fn what_is_left_out_and_why_is_said() {
    let folder = folder();
    let near = "point = { position = [0, 0, 2], attenuation = { quadratic = 1 }";
    let lamp = SCENE.replace("directional = { direction = [0, 0, -1]", near);
    std::fs::write(folder.path().join("lamp.toml"), &lamp).unwrap();
    let say = |args: &[&str]| {
        let output =
            run(folder.path(), &[&["render", "lamp.toml", "a.png", "--stats"], args].concat(), "");
        String::from_utf8(output.stdout).unwrap()
    };
    let whole = say(&[]);
    assert!(whole.contains(" attenuations computed: lights[0] weakens with distance"), "{whole}");
    assert!(
        whole.contains("  reflection      not called for: no object's material has kr > 0"),
        "{whole}"
    );
    assert!(whole.contains("left out   nothing, for depth, threshold or light cutoff"), "{whole}");
    let none = say(&["--effects", "none"]);
    assert!(none.contains("  attenuation     left out, though called for: lights[0]"), "{none}");
    // No lamp gives as much light as the cutoff of 1.
    let cut = say(&["--light-cutoff", "1"]);
    assert!(
        cut.contains(" lights too weak to be followed") && cut.contains("levels (proven)"),
        "{cut}"
    );
    expect(
        &run(folder.path(), &["render", "lamp.toml", "a.png", "--light-cutoff", "2"], ""),
        2,
        "from 0 to 1",
    );
}

#[test]
fn a_case_is_rendered_by_its_course_unless_another_is_given() {
    let folder = folder();
    let render = |args: &[&str]| {
        expect(&run(folder.path(), &[&["render"], args, &["a.pfm"]].concat(), ""), 0, "");
        std::fs::read(folder.path().join("a.pfm")).unwrap()
    };
    let lecture = render(&["cases/stages/01_one/card.toml"]);
    std::fs::write(folder.path().join("cases/course.toml"), "pixel = \"corner\"").unwrap();
    std::fs::write(folder.path().join("lecture.toml"), "pixel = \"centre\"").unwrap();
    let by_course = render(&["01_one/card"]);
    assert!(by_course != lecture, "half a pixel to the left and up");
    assert_eq!(render(&["cases/stages/01_one/card.toml"]), by_course);
    assert_eq!(render(&["01_one/card", "--course", "lecture.toml"]), lecture);
    assert_eq!(
        render(&["stages/01_one/card.toml"]),
        lecture,
        "there is no course.toml beside those stages"
    );
    let scene = SCENE.replace("sphere = {}", "square = {}");
    std::fs::write(folder.path().join("card.toml"), scene).unwrap();
    assert_eq!(render(&["card.toml"]), lecture, "a scene of no stage");
    assert_eq!(render(&["card.toml", "--course", "cases/course.toml"]), by_course);
}

#[test]
fn probe_and_explain_follow_the_course() {
    let folder = folder();
    std::fs::write(folder.path().join("one.toml"), "index_of_air = 1").unwrap();
    let question = "{\"id\":\"a\",\"fn\":\"indices\",\"inside\":false,\"index\":1.5}\n";
    for (args, eta_i) in [(&["probe"][..], "1.0003"), (&["probe", "--course", "one.toml"], "1.0")] {
        let output = run(folder.path(), args, question);
        let said = String::from_utf8(output.stdout).unwrap();
        assert!(said.contains(&format!("\"eta_i\":{eta_i},")), "{args:?}: {said}");
    }
    std::fs::write(folder.path().join("corner.toml"), "pixel = \"corner\"").unwrap();
    let explain = |args: &[&str]| {
        run(folder.path(), &[&["explain", "scene.toml", "4", "3"], args].concat(), "").stdout
    };
    assert_ne!(explain(&[]), explain(&["--course", "corner.toml"]));
    std::fs::write(folder.path().join("bad.toml"), "index_of_air = 2").unwrap();
    expect(&run(folder.path(), &["probe", "--course", "bad.toml"], ""), 2, "bad.toml:1:16");
    expect(&run(folder.path(), &["course"], ""), 2, "cases/course.toml");
    let page = run(folder.path(), &["course", "--course", "one.toml"], "");
    let page = String::from_utf8(page.stdout).unwrap();
    assert!(page.contains("| `1.0`: that of a vacuum (not as in the lecture) | 9 |"), "{page}");
    assert!(page.contains("One decision differs"), "{page}");
}

#[test]
fn what_cannot_be_read_or_named_is_2() {
    let folder = folder();
    let render = |args: &[&str]| run(folder.path(), &[&["render"], args].concat(), "");
    expect(&render(&["none.toml", "a.png"]), 2, "there is no file `none.toml`");
    expect(&render(&["01_one/cart", "a.png"]), 2, "did you mean `01_one/card`?");
    expect(&render(&["scene.toml", "a.bmp"]), 2, ".png, .pfm or .exr");
    expect(&render(&["scene.toml", "a.png", "--effects", "shadow"]), 2, "the effects are shadows,");
    expect(&render(&["scene.toml", "a.png", "--size", "0x9"]), 2, "such as 640x480");
    expect(&render(&["scene.toml"]), 2, "required");
    expect(
        &render(&["scene.toml", "no/such/folder/a.png"]),
        2,
        "there is no folder `no/such/folder`",
    );
    std::fs::write(folder.path().join("bad.toml"), SCENE.replace("fov_y_deg", "fov_deg")).unwrap();
    let bad = render(&["bad.toml", "a.png"]);
    expect(&bad, 2, "bad.toml:9:1");
    assert!(!bad.stderr.contains(&0x1b), "no colours without a terminal");
    assert!(!folder.path().join("a.png").exists(), "nothing was rendered");
}

#[test]
fn explains_a_pixel() {
    let folder = folder();
    let output = run(folder.path(), &["explain", "scene.toml", "4", "3"], "");
    assert!(String::from_utf8_lossy(&output.stdout).starts_with("eye ray, depth 0\n"));
    let json = run(folder.path(), &["explain", "01_one/card", "4", "3", "--json"], "");
    let tree: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(tree["kind"], "eye");
    expect(&run(folder.path(), &["explain", "scene.toml", "8", "0"], ""), 2, "pixel (8, 0)");
}

#[test]
fn answers_questions_in_order() {
    let folder = folder();
    let questions = concat!(
        r#"{"id":"b","fn":"reflect","direction":[0.6,-0.8,0],"normal":[0,1,0]}"#,
        "\n\n",
        r#"{"id":"a","fn":"sphere","ray":{"origin":[0,0,2],"direction":[0,0,1],"t_min":0,"t_max":"inf"},"center":[0,0,0],"radius":0.5}"#,
        "\n"
    );
    let output = run(folder.path(), &["probe"], questions);
    let lines = String::from_utf8(output.stdout).unwrap();
    assert_eq!(lines, "{\"id\":\"b\",\"vector\":[0.6,0.8,0.0]}\n{\"id\":\"a\",\"miss\":true}\n");
    expect(&run(folder.path(), &["probe"], "{}\n"), 2, "cannot understand the question {}");
}

#[test]
fn writes_answers_once_and_checks_them() {
    let folder = folder();
    let stages = folder.path().join("stages/01_one");
    expect(
        &run(folder.path(), &["expect", "stages", "--check"], ""),
        1,
        "card.answer.exr is missing",
    );
    assert!(!stages.join("card.answer.exr").exists(), "--check writes nothing");
    expect(&run(folder.path(), &["expect", "stages"], ""), 0, "4 written");
    expect(
        &run(folder.path(), &["expect", "stages", "--check"], ""),
        0,
        "4 files as stored, 0 written",
    );
    expect(
        &run(folder.path(), &["expect", "stages/01_one/card.toml"], ""),
        0,
        "3 files as stored, 0 written",
    );
    expect(&run(folder.path(), &["expect"], ""), 0, "4 written");
    expect(&run(folder.path(), &["expect", "01_one/card"], ""), 0, "3 files as stored, 0 written");
    expect(&run(folder.path(), &["expect", "01_one", "--check"], ""), 0, "4 files as stored");
    let stored = std::fs::read(stages.join("card.answer.exr")).unwrap();
    let answer = cases::answer::ImageAnswer::decode(&stored, 8, 6).unwrap();
    assert_eq!((answer.limits.cluster, answer.limits.count), (3, 3));
    std::fs::write(stages.join("card.expected.png"), "x").unwrap();
    expect(
        &run(folder.path(), &["expect", "stages", "--check"], ""),
        1,
        "card.expected.png differs",
    );
    expect(
        &run(folder.path(), &["expect", "nowhere"], ""),
        2,
        "no case, no stage and no folder of stages",
    );
}

#[test]
fn an_answer_on_paper_must_be_right() {
    let folder = folder();
    std::fs::write(folder.path().join("stages/01_one/checks/sphere.toml"), check("1.25")).unwrap();
    let output = run(folder.path(), &["expect", "stages"], "");
    expect(&output, 1, "01_one/sphere/ahead: on paper the answer is");
    assert!(!folder.path().join("stages/01_one/checks.answers.json").exists());
}

#[test]
fn prints_completions_and_pages() {
    let folder = folder();
    for args in [
        &["completions", "bash"][..],
        &["man"],
        &["man", "render"],
        &["render", "--help"],
        &["--version"],
    ] {
        let output = run(folder.path(), args, "");
        expect(&output, 0, "");
        assert!(String::from_utf8_lossy(&output.stdout).contains("reference"), "{args:?}");
    }
    expect(&run(folder.path(), &["man", "dance"], ""), 2, "no command `dance`");
    expect(&run(folder.path(), &["dance"], ""), 2, "dance");
}

#[test]
fn prints_schemas_and_the_format_as_documented() {
    let folder = folder();
    for kind in ["case", "scene-file", "stage", "scene", "probe"] {
        let output = run(folder.path(), &["schema", kind], "");
        let schema: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert!(schema.is_object(), "{kind}");
    }
    let page = run(folder.path(), &["schema", "--markdown"], "");
    let stored =
        std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/scene-format.md")).unwrap();
    assert!(
        page.stdout == stored,
        "docs/scene-format.md is not what `reference schema --markdown` prints"
    );
}
