//! Writes the page `docs/performance.md`, and the picture beside it.

use std::fmt::Write as _;

use pages::figures::figure;
use reference::cost::plot::{self, Place, Plot, Point, Shape};

use super::bars::{self, Bar};
use super::pictures::{self, WHOLE_THREADS};
use super::rays::NAMES;
use super::report::Report;
use super::scenes::SIZE;
use super::search::{self, Library, SHOWN};
use super::{effects, small};

/// The paragraph on the ratios that count.
const RATIOS: &str = "\
A ratio counts only if both do the same work. A renderer that does less work (it lacks a feature, or
follows one branch of a path where this reference follows two) is marked in its row, and its ratio
counts for no bar. A renderer that casts more rays for the same picture is compared in rays per
second as well, and the smaller ratio counts: a ray that need not be cast is saved work, but not
speed. This reference computes in f64 and intersects every triangle watertight. Where it computes in
f32, the row says so.

";

/// Returns the page in Markdown. `picture` is the file name of the picture from [`growth`].
pub fn page(report: &Report, picture: &str) -> String {
    let mut out = head(report);
    out += &bar_table(&bars::bars(report));
    out += RATIOS;
    out += &report.pictures.as_deref().map_or_else(String::new, rendering);
    out += &report.search.as_deref().map_or_else(String::new, |rows| searching(rows, picture));
    out += &report.small.as_deref().map_or_else(String::new, commands);
    out += &report.effects.as_deref().map_or_else(String::new, uncalled);
    out.trim_end().to_owned() + "\n"
}

fn head(report: &Report) -> String {
    let machine = &report.machine;
    format!(
        "# Speed beside other renderers\n\nMade by `cargo run --release -p tests --bin performance \
         -- --out docs/performance.md`,\nwhich installs the others (`tests/peers/renderers`); do \
         not edit.\n\nMeasured on: {}, {} threads, {}, {:.0} GiB, {}; medians of {} rounds in \
         which all take turns{}.{}\n\n",
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
        report.measured_on.as_deref().map_or_else(String::new, dated),
    )
}

/// Returns the sentence that names the code and cases of a measurement.
fn dated(digest: &str) -> String {
    format!(" Code and cases: `{digest}`.")
}

fn bar_table(bars: &[Bar]) -> String {
    let n_reached = bars.iter().filter(|bar| bar.is_reached).count();
    let mut out = format!(
        "## Bars\n\n{n_reached} of {} bars are reached.\n\n| bar | figure | reached | reason |\n\
         |---|---:|---|---|\n",
        bars.len()
    );
    for bar in bars {
        let _ = writeln!(
            out,
            "| {} | {} | {} | {} |",
            bar.requirement,
            bar.figure,
            if bar.is_reached { "yes" } else { "**no**" },
            bar.reason
        );
    }
    out + "\n"
}

fn rendering(rows: &[pictures::Row]) -> String {
    let (width, height) = SIZE;
    let mut out = format!(
        "\
## Whole scenes

All pictures have {width}×{height} pixels, with one ray each. `performance --scenes DIR` writes the
scenes:

- whitted: three spheres (mirror, glass, dull) on a checkered floor of triangles, one light, depth 5
- spheres: 1,000 stretched, turned and moved spheres, a point and a directional light
- mesh: a stone of 81,920 or 1,310,720 triangles with smooth normals, one light
- glass: the smaller stone of glass, reflection and refraction to depth 8

The columns are:

- *render s*: CPU seconds of rendering alone on one thread, without start, reading and building
  trees. Tachyon reports wall time. Mitsuba renders in a warm process, the others once in a cold
  one.
- *times*: how many times as fast this reference is.
- *whole s*: wall time from start to PNG on disk, on {WHOLE_THREADS} threads.
- *rays*: eye + shadow + reflected + refracted rays in thousands, as the renderer counts them
  (~: as they follow from its algorithm).

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
            measured(Some(row.render_s)),
            measured(row.times),
            measured(row.read_s),
            measured(row.whole_s),
            measured(row.whole_times),
            row.easier.unwrap_or_default(),
        );
    }
    out + "\n"
}

fn searching(rows: &[search::Row], picture: &str) -> String {
    let mut out = format!(
        "\
## Ray queries

The table gives millions of rays per second on one thread. All libraries trace the same rays, which
are read from a file. Primary rays go through the pixels. Shadow rays go from their hits to the
light, and any hit ends the search. Diffuse rays start there in random directions. Random rays run
between random points of a box about the mesh. *Different* counts answers that differ from ours (hit
or miss, or a distance by more than a thousandth) over all sets. Building time is in CPU
milliseconds on one thread. Bytes a triangle are those of the tree, the corners and whatever else
the library keeps. Packets hold primary rays through 4 × 4 pixels. Other rays are passed in the
order of the file, 16 at a time; to this reference, one by one.

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
            measured(Some(row.build_s * 1e3)),
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
    out += "\
The table has the exponents p of n^p that fit best over these sizes; n log n is fitted in the same
way. Larger meshes do not fit the caches of the processor, which no tree can compensate.

";
    out += "| | exponent |\n|---|---:|\n";
    for (name, p) in bars::exponents(rows) {
        let _ = writeln!(out, "| {name} | {p:.2} |");
    }
    out + "\n"
}

/// Returns the SVG of the times for building and searching against the number of triangles.
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
            is_own: false,
            is_pick: false,
            link: None,
            label: format!("n^{:.2}", exponents[which].1),
            hover: format!(
                "{}, {} triangles: {}",
                row.name,
                row.n_triangles,
                measured(Some(of(row)))
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
        title: "Ray queries".to_owned(),
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
    let mut out = "## Whole commands\n\nEach command is measured as a process, from start to \
        end.\n\n| | | CPU ms | wall ms | |\n|---|---|---:|---:|---|\n"
        .to_owned();
    for row in rows {
        let (cpu, wall) = (measured(Some(row.cpu_s * 1e3)), measured(Some(row.wall_s * 1e3)));
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

fn uncalled(rows: &[effects::UncalledRow]) -> String {
    let mut out = "\
## Effects that are not called for

Each scene is rendered by three kernels: one from which every effect that it does not call for is
deleted, the one that is chosen for it, and one that can do everything. Times are CPU milliseconds
on one thread. The pictures are the same. docs/decisions/006-kernels.md has the counts of
instructions, which have less noise.

| scene | not called for | deleted | chosen | can do everything | chosen / deleted | \
everything / deleted |
|---|---|---:|---:|---:|---:|---:|
"
    .to_owned();
    for row in rows {
        let deleted = row.deleted.iter().map(|effect| effect.name()).collect::<Vec<_>>().join(", ");
        let [exact, chosen, able] = [row.deleted_s, row.chosen_s, row.able_s]
            .map(|times| measured(Some(times.median * 1e3)));
        let _ = writeln!(
            out,
            "| {} | {deleted} | {exact} | {chosen} | {able} | {:.3} | {:.3} |",
            row.scene, row.chosen_ratio, row.able_ratio
        );
    }
    out + "\n"
}

/// Formats a measured number: a dash for `None`, and `?` if it is not finite.
fn measured(x: Option<f64>) -> String {
    match x {
        None => "–".to_owned(),
        Some(x) if !x.is_finite() => "?".to_owned(),
        Some(x) => figure(x),
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
            measured_on: Some("0123456789abcdef".to_owned()),
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
            " at the beginning). Code and cases: `0123456789abcdef`.\n",
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
    fn what_was_not_measured_is_no_number() {
        for (x, text) in [(Some(12.34), "12.3"), (Some(f64::NAN), "?"), (None, "–")] {
            assert_eq!(measured(x), text);
        }
    }
}
