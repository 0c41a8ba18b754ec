//! The page `docs/performance.md`, and the picture beside it.

use std::fmt::Write as _;

use reference::cost::plot::{self, Place, Plot, Point, Shape};

use super::bars::{self, Bar};
use super::pictures::{self, WHOLE_THREADS};
use super::rays::NAMES;
use super::report::Report;
use super::scenes::SIZE;
use super::search::{self, Library, SHOWN};
use super::{effects, small};

/// The page, in Markdown; `picture` is the file name of what [`growth`] draws.
pub fn page(report: &Report, picture: &str) -> String {
    let mut out = head(report);
    out += &bar_table(&bars::bars(report));
    out += &report.pictures.as_deref().map_or_else(String::new, rendering);
    out += &report.search.as_deref().map_or_else(String::new, |rows| searching(rows, picture));
    out += &report.small.as_deref().map_or_else(String::new, commands);
    out += &report.effects.as_deref().map_or_else(String::new, uncalled);
    out.trim_end().to_owned() + "\n"
}

fn head(report: &Report) -> String {
    let machine = &report.machine;
    format!(
        "# Speed, beside others\n\nMade by `cargo run --release -p tests --bin performance -- \
            --out docs/performance.md`, which installs the others (`tests/peers/renderers`); do \
            not edit.\nMeasured on: {}, {} threads, {}, {:.0} GiB, {}; medians of {} rounds in \
            which all take turns{}.\n\n\
         A ratio counts only where both do the same work. A renderer that does less (it lacks a \
         feature, or follows one branch\n\
         of a path where this reference follows two) is marked in its row, and its ratio counts \
         for no bar. A renderer that casts\n\
         more rays for the same picture is compared in rays a second as well, and the smaller \
         ratio counts: a ray that need not be\n\
         cast is saved work, but no speed. This reference computes in f64 and decides every \
         triangle watertight; where it computes\nin f32, the row says so.\n\n",
        machine.processor,
        machine.n_threads,
        if machine.vectors.is_empty() {
            "no wide vectors".to_owned()
        } else {
            machine.vectors.join(" and ")
        },
        machine.memory_gib,
        machine.system,
        report.n_rounds,
        if machine.load > 0.5 {
            format!(" (**on a busy machine**: load {:.1} at the beginning)", machine.load)
        } else {
            String::new()
        },
    )
}

fn bar_table(bars: &[Bar]) -> String {
    let n_met = bars.iter().filter(|bar| bar.is_met).count();
    let mut out = format!(
        "## Bars\n\n{n_met} of {} are met.\n\n| bar | figure | met | why not |\n\
            |---|---:|---|---|\n",
        bars.len()
    );
    for bar in bars {
        let _ = writeln!(
            out,
            "| {} | {} | {} | {} |",
            bar.asked,
            bar.figure,
            if bar.is_met { "yes" } else { "**no**" },
            bar.why
        );
    }
    out + "\n"
}

fn rendering(rows: &[pictures::Row]) -> String {
    let (width, height) = SIZE;
    let mut out = format!(
        "## Whole scenes\n\n{width}×{height} pixels, one ray each; `performance --scenes DIR` \
            writes the scenes. whitted: three spheres (mirror, glass, dull) on a checkered floor \
            of triangles, one light, depth 5. spheres: 1,000 stretched, turned and\n\
            moved spheres, a point and a directional light. mesh: a stone of 81,920 or 1,310,720 \
            triangles, smooth normals, one light. glass: the smaller stone of glass, reflection \
            and refraction to depth 8.\n\n\
         Rendering alone: CPU seconds on one thread, without start, reading and building trees; \
         Tachyon tells seconds by the clock. Mitsuba renders in a warm process, the others once \
         in a cold one. Whole: from start to PNG on disk, by the clock,\n\
         {WHOLE_THREADS} threads. Times: how many times as fast this reference is. Rays in \
         thousands: eye + shadow + reflected + refracted, as the renderer counts them (~: as they \
         follow from how it works).\n\n\
         | scene | renderer | | render s | times | reading s | whole s | times | rays | less \
         work, counts for no bar |\n|---|---|---|---:|---:|---:|---:|---:|---:|---|\n"
    );
    for row in rows {
        let rays = row.rays.map_or("unknown".to_owned(), |rays| {
            let sign = if row.is_counted { "" } else { "~" };
            sign.to_owned() + &rays.map(|n| format!("{:.0}", n as f64 / 1e3)).join(" + ")
        });
        let _ = writeln!(
            out,
            "| {} | {} | {} | {} | {} | {} | {} | {} | {rays} | {} |",
            row.scene,
            row.renderer,
            row.precision,
            figure(Some(row.render_s)),
            figure(row.times),
            figure(row.read_s),
            figure(row.whole_s),
            figure(row.whole_times),
            row.easier.unwrap_or_default(),
        );
    }
    out + "\n"
}

fn searching(rows: &[search::Row], picture: &str) -> String {
    let mut out = format!(
        "## What a ray meets\n\nMillion rays a second on one thread, the same rays for all, read \
            from a file: those through the pixels; from what they meet to the light (anything in \
            the way ends the search); from there in random directions; and from anywhere to \
            anywhere\nin a box about the mesh. Different: answers that are not ours (met or \
            missed, or a distance by more than a thousandth), of all sets. Building: CPU \
            milliseconds on one thread. Bytes a triangle: tree, corners and what else the library \
            keeps. Packets hold\nprimary rays through 4 × 4 pixels; other rays come 16 at a time \
            as they stand in the file, to this reference one by one.\n\n\
         | mesh | | {} | different | of | building ms | bytes a triangle |\n\
         |---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n",
        NAMES.join(" | "),
    );
    for row in rows.iter().filter(|row| SHOWN.contains(&row.mesh)) {
        let _ = writeln!(
            out,
            "| {} | {} | {} | {} | {} | {} | {} |",
            row.mesh,
            row.name,
            row.mrays.map(|mrays| format!("{mrays:.2}")).join(" | "),
            row.n_different.iter().sum::<usize>(),
            row.n_rays.iter().sum::<usize>(),
            figure(Some(row.build_s * 1e3)),
            row.bytes.map_or("–".to_owned(), |bytes| format!(
                "{:.0}",
                bytes as f64 / row.n_triangles as f64
            )),
        );
    }
    let _ = write!(
        out,
        "\n## How cost grows\n\n![Building and searching, from a thousand to a million \
            triangles]({picture})\n\n"
    );
    out += "The exponents p of n^p that fit best over these sizes; n log n itself is fitted the \
        same way. Larger meshes do not fit the caches of the processor, which no tree makes up \
        for.\n\n";
    out += "| | exponent |\n|---|---:|\n";
    for (name, p) in bars::exponents(rows) {
        let _ = writeln!(out, "| {name} | {p:.2} |");
    }
    out + "\n"
}

/// Building and searching against the number of triangles, as SVG.
pub fn growth(rows: &[search::Row]) -> String {
    let exponents = bars::exponents(rows);
    let series = |shape: Shape, which: usize, of: &dyn Fn(&search::Row) -> f64| {
        let most = rows.iter().map(|row| row.n_triangles).max();
        let point = |row: &search::Row| Point {
            x: row.n_triangles as f64,
            spread: (row.n_triangles as f64, row.n_triangles as f64),
            y: of(row),
            shape,
            is_hollow: row.library != Library::Ours,
            is_on_front: row.library == Library::Ours && Some(row.n_triangles) == most,
            label: format!("n^{:.2}", exponents[which].1),
            hover: format!(
                "{}, {} triangles: {}",
                row.name,
                row.n_triangles,
                figure(Some(of(row)))
            ),
        };
        let shown =
            rows.iter().filter(|row| matches!(row.library, Library::Ours | Library::EmbreeRobust));
        shown.map(point).collect::<Vec<_>>()
    };
    let x = || "triangles".to_owned();
    let hollow = (Shape::Circle, true, "hollow: Embree 4 robust, f32");
    let build = Plot {
        title: "Building the tree".to_owned(),
        x: x(),
        y: "milliseconds, one thread".to_owned(),
        line: None,
        key: vec![(Shape::Circle, false, "this reference"), hollow],
        points: series(Shape::Circle, 0, &|row| row.build_s * 1e3),
    };
    let shapes = [Shape::Circle, Shape::Triangle, Shape::Square, Shape::Diamond];
    let rays = Plot {
        title: "What a ray meets".to_owned(),
        x: x(),
        y: "nanoseconds a ray, one thread".to_owned(),
        line: None,
        key: shapes
            .into_iter()
            .zip(NAMES)
            .map(|(shape, name)| (shape, false, name))
            .chain([hollow])
            .collect(),
        points: (0..4).flat_map(|k| series(shapes[k], k + 1, &|row| 1e3 / row.mrays[k])).collect(),
    };
    plot::stack(&[build, rays], Place::File)
}

fn commands(rows: &[small::Row]) -> String {
    let mut out = "## Whole commands\n\nAs processes, from start to end.\n\n\
        | | | CPU ms | ms by the clock | |\n|---|---|---:|---:|---|\n"
        .to_owned();
    for row in rows {
        let (cpu, wall) = (figure(Some(row.cpu_s * 1e3)), figure(Some(row.wall_s * 1e3)));
        let _ = writeln!(
            out,
            "| {} | {} | {cpu} | {wall} | {} |",
            row.what,
            row.who,
            row.note.unwrap_or_default()
        );
    }
    out + "\n"
}

fn uncalled(rows: &[effects::Row]) -> String {
    let mut out = "## Effects that are not called for\n\n\
        A scene rendered by a kernel from which every effect that it does not call for is \
        deleted, by the one that is chosen for it, and by one that can do everything; CPU \
        milliseconds on one thread.\nThe pictures are the same. docs/decisions/006-kernels.md has \
        the same in instructions, which do not tremble.\n\n\
        | scene | not called for | deleted | chosen | can do everything | chosen / deleted | \
        everything / deleted |\n|---|---|---:|---:|---:|---:|---:|\n"
        .to_owned();
    for row in rows {
        let deleted = row.deleted.iter().map(|effect| effect.name()).collect::<Vec<_>>().join(", ");
        let [exact, chosen, able] =
            [row.deleted_s, row.chosen_s, row.able_s].map(|times| figure(Some(times.median * 1e3)));
        let _ = writeln!(
            out,
            "| {} | {deleted} | {exact} | {chosen} | {able} | {:.3} | {:.3} |",
            row.scene, row.chosen_ratio, row.able_ratio
        );
    }
    out + "\n"
}

/// With three digits that count; a dash for what is not there.
fn figure(x: Option<f64>) -> String {
    match x {
        None => "–".to_owned(),
        Some(x) if !x.is_finite() => "?".to_owned(),
        Some(x) if x.abs() >= 99.95 => format!("{x:.0}"),
        Some(x) if x.abs() >= 9.995 => format!("{x:.1}"),
        Some(x) if x.abs() >= 0.9995 => format!("{x:.2}"),
        Some(x) => format!("{x:.3}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::performance::report::Machine;

    fn searched(library: Library, mesh: &'static str, n_triangles: usize) -> search::Row {
        let n = n_triangles as f64;
        search::Row {
            mesh,
            n_triangles,
            library,
            name: library.name(),
            build_s: n * 1e-7,
            bytes: Some(100 * n_triangles as u64),
            mrays: [1e6 / n; 4],
            n_rays: [10; 4],
            n_different: [0, 1, 0, 2],
        }
    }

    fn report() -> Report {
        let vectors = vec!["AVX2"];
        let (processor, system) = ("Some 9000".to_owned(), "Some Linux".to_owned());
        let search = [("1k", 1280), ("82k", 81_920), ("1m", 1_310_720)];
        Report {
            schema: 1,
            machine: Machine {
                processor,
                n_threads: 2,
                memory_gib: 8.0,
                load: 3.0,
                system,
                vectors,
            },
            n_rounds: 3,
            pictures: None,
            search: Some(search.map(|(mesh, n)| searched(Library::Ours, mesh, n)).to_vec()),
            small: None,
            effects: None,
        }
    }

    #[test]
    fn a_page_shows_what_was_measured_and_nothing_else() {
        let page = page(&report(), "growth.svg");
        for part in [
            "Some 9000, 2 threads, AVX2, 8 GiB, Some Linux; medians of 3 rounds in which all take \
                turns (**on a busy machine**: load 3.0",
            "| 82k | this reference, f64 | 12.21 | 12.21 | 12.21 | 12.21 | 3 | 40 | 8.19 | 100 |",
            "![Building and searching, from a thousand to a million triangles](growth.svg)",
            "| building the tree | 1.00 |",
            "grows as n log n (n^1.10) or better | n^1.00 | yes |",
        ] {
            assert!(page.contains(part), "no `{part}` in\n{page}");
        }
        assert!(!page.contains("## Whole"), "sections that were not measured are not there");
    }

    #[test]
    fn the_picture_names_the_exponents_of_our_own_series() {
        let mut rows = report().search.expect("it was measured");
        rows.push(searched(Library::EmbreeRobust, "82k", 81_920));
        let picture = growth(&rows);
        assert!(picture.matches("n^1.00</text>").count() >= 2, "building, and rays:\n{picture}");
        assert!(
            picture.contains("Embree 4 robust, f32, 81920 triangles: 8.19")
                && !picture.contains("cheaper")
        );
    }

    #[test]
    fn figures_have_three_digits() {
        for (x, text) in
            [(123.4, "123"), (12.34, "12.3"), (1.234, "1.23"), (0.1234, "0.123"), (f64::NAN, "?")]
        {
            assert_eq!(figure(Some(x)), text);
        }
        assert_eq!(figure(None), "–");
    }
}
