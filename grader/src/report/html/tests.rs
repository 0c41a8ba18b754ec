//! Tests of the page: it is complete and self-contained, and a student's text stays text.

use super::*;
use crate::report::sample::{self, HOSTILE};

fn page() -> String {
    render(&sample::graded(HOSTILE))
}

fn has(page: &str, text: &str) {
    assert!(page.contains(text), "the page should contain {text}");
}

#[test]
fn the_page_says_what_the_record_says() {
    let page = page();
    for text in [
        "<title>6.75 / 16 ",
        "Ray casting",
        "timeouts+rlimits",
        "epoch-1",
        "d1935e57",
        "1200 pixels out of tolerance",
    ] {
        has(&page, text);
    }
    has(&page, "worst at column 61, row 60");
    has(&page, "1100 of them side by side");
    has(&page, "7 of them where correct tracers differ");
    has(&page, "earns 37.5 % of its points");
    has(&page, "Correct tracers differ on 0.01 % of the pixels");
    has(&page, "at most 96 pixels may be");
    has(&page, "no picture of yours to show");
    has(&page, "<td class=\"number\">2 of 5, 1 partly</td>");
    has(&page, "<td class=\"number\">1 of 3</td>");
}

#[test]
fn the_page_names_the_mistakes_with_their_rules_and_beside_what_they_explain() {
    let page = page();
    has(&page, "<h2 id=\"mistake-one\"><small>Most likely</small> the one is &lt;wrong&gt;</h2>");
    has(&page, "<h2 id=\"mistake-other\"><small>or</small> the other is &lt;wrong&gt;</h2>");
    has(&page, "<code>sphere.rs, function intersect_sphere</code>");
    has(&page, "<summary>Rule 14: the sphere</summary><pre>    (d·d) t² + 2 (f·d) t");
    has(&page, "It explains 1 of 3 failed pictures and 1 of 1 failed unit check");
    has(
        &page,
        "&#x2f;shifted</a>: 1100 pixels, the largest region in columns 60 to 69 and rows 0 to 119",
    );
    has(&page, "<h2>Unexplained</h2><p>No known mistake explains all of 1 of 3 failed pictures.");
    let beside = page.matches(
        "<p class=\"likely\">Most likely <a href=\"#mistake-one\">the one is \
            &lt;wrong&gt;</a>.</p>",
    );
    assert_eq!(beside.count(), 2);
}

#[test]
fn a_picture_stands_among_the_settings_of_the_reference() {
    let page = page();
    has(&page, "<title>f32 &lt;plain&gt;: 2 ms, 0.50 levels off (RMSE)</title>");
    has(&page, "without error; the reference at best (f64) 4 ms, without error.");
    has(&page, "measured on two &lt;cores&gt;, rendering alone");
    assert_eq!(page.matches("with another version of the reference").count(), 4);
    let mut graded = sample::graded(HOSTILE);
    for pictures in graded.pictures.values_mut() {
        pictures.front.iter_mut().for_each(|front| front.is_old = false);
    }
    assert!(!render(&graded).contains("with another version"), "the points are of this version");
    // There are three settings for each case. The slow one is dominated, so two of three lie on the
    // front. A case without a picture has no plot.
    let (all, on_front) =
        (page.matches("<circle").count(), page.matches("<circle class=\"on\"").count());
    assert_eq!((all, on_front), (12, 8));
}

#[test]
fn only_what_is_not_right_stands_open() {
    let page = page();
    has(&page, "<details class=\"check pass\" id=\"01_ray_casting&#x2f;ball\">");
    has(&page, "<details class=\"check pass flagged\" id=\"01_ray_casting&#x2f;contested\" open>");
    has(&page, "<details class=\"check fail\" id=\"01_ray_casting&#x2f;shifted\" open>");
}

#[test]
fn no_text_of_a_student_becomes_markup() {
    let page = page();
    let scripts = page.matches("<script").count();
    assert_eq!(scripts, 1, "only our own script");
    assert!(!page.contains("<img src=x"), "an element of the student's");
    has(&page, "{{ 7*7 }}");
    has(&page, "&lt;script&gt;document.title=&#x27;owned&#x27;");
    has(&page, "\\u{202e}\\u{1b}[2J\\u{0}&amp;lt;");
    let hidden: Vec<char> =
        page.chars().filter(|c| crate::plain::is_hidden(*c) && *c != '\n').collect();
    assert!(hidden.is_empty(), "{hidden:?}");
}

#[test]
fn the_page_needs_nothing_from_elsewhere() {
    let page = page();
    for (at, _) in page.match_indices("src=\"") {
        assert!(page[at..].starts_with("src=\"data:image/png;base64,"), "{}", &page[at..at + 60]);
    }
    assert!(
        !page.contains("http:") && !page.contains("https:") && !page.contains("url("),
        "a reference to elsewhere"
    );
}

#[test]
fn the_policy_names_the_hashes_of_what_is_inline() {
    use base64::Engine;
    use sha2::Digest;
    let page = page();
    let between = |from: &str, to: &str| {
        page.split(from).nth(1).unwrap().split(to).next().unwrap().to_owned()
    };
    let policy = between("http-equiv=\"Content-Security-Policy\" content=\"", "\">");
    let hash = |text: String| base64::prelude::BASE64_STANDARD.encode(sha2::Sha256::digest(text));
    let inline = [
        ("style-src", hash(between("<style>", "</style>"))),
        ("script-src", hash(between("<script>", "</script>"))),
    ];
    for (what, hash) in inline {
        let escaped = hash.replace('/', "&#x2f;");
        has(&policy, what);
        assert!(
            policy.contains(&hash) || policy.contains(&escaped),
            "{what} {hash} is not in {policy}"
        );
    }
    has(&policy, "default-src &#x27;none&#x27;");
    assert!(!policy.contains("unsafe"));
}

#[test]
fn pictures_are_png_of_the_levels_that_are_judged() {
    let both =
        sample::pictures(true, |i| cases::glam::DVec3::splat(if i == 3 { 0.1 } else { 0.0 }));
    let actual = both.actual.clone().unwrap();
    let marks = decoded(&picture::marks(&both.answer, &actual)).into_luma8();
    let count = |i, mark| (0..120).filter(|j| marks.get_pixel(i, *j).0 == [mark]).count();
    assert_eq!((count(2, 255), count(3, 255), count(4, 255)), (0, 119, 0));
    assert_eq!(
        (count(3, 64), count(3, 0)),
        (1, 0),
        "what is off by 26 levels is right where 212 is allowed"
    );
    let shown = decoded(&picture::colours(&actual)).into_rgb8();
    let pixel = actual.pixel(80, 60).to_array().map(cases::film::byte);
    assert_eq!(shown.get_pixel(80, 60).0, pixel);
    let difference = decoded(&picture::difference(&both.answer.expected, &actual)).into_rgb8();
    assert_eq!(difference.get_pixel(2, 110).0, [0, 0, 0]);
    assert!(
        difference.get_pixel(3, 110).0.iter().all(|level| (96..=108).contains(level)),
        "26 levels or so, times 4"
    );
}

#[test]
fn what_is_allowed_and_what_counts_are_stored_beside() {
    let both = sample::pictures(true, |_| cases::glam::DVec3::ZERO);
    let weight = decoded(&picture::weight(&both.answer).unwrap()).into_luma8();
    assert_eq!((weight.get_pixel(9, 0).0, weight.get_pixel(9, 1).0), ([0], [255]));
    let mut even = both.answer.clone();
    even.weight.fill(7);
    assert_eq!(picture::weight(&even), None);
    let allowed = serde_json::to_value(picture::allowed(&both.answer)).unwrap();
    let plane = |name: &str| decoded(allowed[name].as_str().unwrap()).into_rgb8();
    let expected = both.answer.expected.pixel(3, 5).to_array().map(cases::film::byte);
    let above: Vec<u8> =
        expected.iter().zip(plane("above").get_pixel(3, 5).0).map(|(e, more)| e + more).collect();
    assert_eq!(above, [214; 3], "212 and the slack of 2");
    let light = cases::film::level(both.answer.expected.pixel(80, 60).x);
    let below = f64::from(plane("below").get_pixel(80, 60).0[0]);
    assert_eq!(light.round() - below, light.floor() - 2.0);
}

fn decoded(uri: &str) -> image::DynamicImage {
    use base64::Engine;
    let bytes = base64::prelude::BASE64_STANDARD
        .decode(uri.strip_prefix("data:image/png;base64,").unwrap())
        .unwrap();
    image::load_from_memory(&bytes).unwrap()
}

#[test]
fn the_page_is_written_whole() {
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("report.html");
    write(&path, &sample::graded("alice")).unwrap();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), render(&sample::graded("alice")));
    assert_eq!(std::fs::read_dir(place.path()).unwrap().count(), 1, "no part is left beside it");
    assert!(write(&path.join("below a file.html"), &sample::graded("alice")).is_err());
}
