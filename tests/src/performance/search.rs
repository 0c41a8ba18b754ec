//! Measures ray queries in a mesh by several libraries, each on one thread. All read the same rays
//! from a file.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use serde::{Deserialize, Serialize};

use super::bench::{Bench, made};
use super::rays::{self, Set};
use super::series::median;
use super::{child, scenes, stone};

/// The number of timed passes over each set in a process, after one that is not timed.
const N_PASSES: usize = 2;

/// A library with its mode of query.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[allow(missing_docs, reason = "their names say it")]
pub enum Library {
    Ours,
    OursPackets,
    Embree,
    EmbreeRobust,
    EmbreePackets,
    Obvhs,
    Parry3d,
    Bvh,
}

impl Library {
    const ALL: [Self; 8] = [
        Self::Ours,
        Self::OursPackets,
        Self::Embree,
        Self::EmbreeRobust,
        Self::EmbreePackets,
        Self::Obvhs,
        Self::Parry3d,
        Self::Bvh,
    ];

    /// Returns the name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ours => "this reference, f64",
            Self::OursPackets => "this reference, primary rays by packets of 16, f64",
            Self::Embree => "Embree 4, f32",
            Self::EmbreeRobust => "Embree 4 robust, f32",
            Self::EmbreePackets => "Embree 4, packets of 16, f32",
            Self::Obvhs => "crate obvhs, f32",
            Self::Parry3d => "crate parry3d, f32",
            Self::Bvh => "crate bvh, f32",
        }
    }

    /// Returns whether the library is measured on the mesh of that name. Libraries that show how
    /// cost grows run on all sizes, the slowest one on a single size.
    fn is_measured(self, mesh: &str) -> bool {
        match self {
            Self::Ours | Self::EmbreeRobust => true,
            Self::OursPackets
            | Self::Embree
            | Self::EmbreePackets
            | Self::Obvhs
            | Self::Parry3d => SHOWN.contains(&mesh),
            Self::Bvh => mesh == SHOWN[0],
        }
    }

    fn command(self, bench: &Bench) -> Result<Command, String> {
        let with = |program: &str, word: &str| {
            let mut command = Command::new(bench.peers.join(program));
            command.arg(word);
            command
        };
        let ourselves = |job: &str| {
            let mut command = Command::new(std::env::current_exe().map_err(|why| why.to_string())?);
            command.args(["--worker", job]);
            Ok::<_, String>(command)
        };
        Ok(match self {
            Self::Ours => ourselves("search")?,
            Self::OursPackets => ourselves("search-together")?,
            Self::Embree => with("embree", "default"),
            Self::EmbreeRobust => with("embree", "robust"),
            Self::EmbreePackets => with("embree", "packets"),
            Self::Obvhs => with("crates/release/crates", "obvhs"),
            Self::Parry3d => with("crates/release/crates", "parry3d"),
            Self::Bvh => with("crates/release/crates", "bvh"),
        })
    }
}

/// The meshes of the table.
pub const SHOWN: [&str; 2] = ["82k", "1m"];

/// The output of a process.
#[derive(Deserialize)]
struct Output {
    build_s: f64,
    bytes: Option<u64>,
    /// The seconds of each pass over each set.
    seconds: [Vec<f64>; 4],
}

/// A library and a mesh, with medians over the rounds.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The name of the mesh, one of [`scenes::STONES`].
    pub mesh: &'static str,
    /// The number of triangles of the mesh.
    pub n_triangles: usize,
    /// The library.
    #[serde(skip)]
    pub library: Library,
    /// The name of the library for people.
    pub name: &'static str,
    /// The CPU seconds of building the tree.
    pub build_s: f64,
    /// The bytes of the tree and the data that it refers to, as the library reports them.
    pub bytes: Option<u64>,
    /// Millions of rays per second, for each of [`rays::NAMES`].
    pub mrays: [f64; 4],
    /// The number of rays in each set.
    pub n_rays: [usize; 4],
    /// The number of answers in each set that differ from ours.
    pub n_different: [usize; 4],
}

/// Lets every library trace the rays of each mesh, round by round, ours first.
///
/// # Errors
/// Returns an error if a library is missing or fails.
pub fn measure(bench: &Bench) -> Result<Vec<Row>, String> {
    let mut rows = vec![];
    for (n_divisions, mesh) in scenes::STONES {
        let scene = cases::stage::load_scene(
            &bench.scenes.join(format!("mesh_{mesh}.toml")),
            &cases::Course::default(),
        )
        .map_err(|why| why.to_string())?;
        let sets = rays::sets(&scene);
        let folder = bench.folder(mesh, "search");
        let file = made(&folder)?.join("rays");
        fs::write(&file, rays::encode(&sets))
            .map_err(|why| format!("{}: {why}", file.display()))?;
        let asked = || Library::ALL.into_iter().filter(|library| library.is_measured(mesh));
        let mut told: BTreeMap<Library, Vec<Output>> = BTreeMap::new();
        for round in 0..bench.n_rounds {
            for library in asked() {
                bench.say(&format!("rays in {mesh}, round {}: {}", round + 1, library.name()));
                told.entry(library).or_default().push(run(bench, library, mesh, &folder)?);
            }
        }
        let ours = answers(&folder, Library::Ours)?;
        for (library, told) in told {
            let n_different = different(&sets, &ours, &answers(&folder, library)?);
            rows.push(row(
                mesh,
                stone::n_triangles(n_divisions),
                library,
                &sets,
                &told,
                n_different,
            ));
        }
    }
    Ok(rows)
}

fn run(bench: &Bench, library: Library, mesh: &str, folder: &Path) -> Result<Output, String> {
    let mut command = library.command(bench)?;
    let mesh = bench.scenes.join(format!("mesh_{mesh}.ply"));
    command
        .arg(mesh)
        .arg(folder.join("rays"))
        .arg(answers_at(folder, library))
        .arg(N_PASSES.to_string());
    let spent = child::run(&mut command, folder)?;
    let last = spent.said.lines().last().unwrap_or_default();
    serde_json::from_str(last).map_err(|why| format!("{}: {why}: {}", library.name(), spent.said))
}

fn answers_at(folder: &Path, library: Library) -> std::path::PathBuf {
    folder.join(format!("answers_{library:?}"))
}

fn answers(folder: &Path, library: Library) -> Result<Vec<f32>, String> {
    let path = answers_at(folder, library);
    let bytes = fs::read(&path).map_err(|why| format!("{}: {why}", path.display()))?;
    Ok(bytes.as_chunks().0.iter().map(|four| f32::from_le_bytes(*four)).collect())
}

/// Returns the number of answers that differ in each set. Both lists hold the sets one after the
/// other.
fn different(sets: &[Set; 4], ours: &[f32], theirs: &[f32]) -> [usize; 4] {
    let mut first = 0;
    sets.each_ref().map(|set| {
        let span = first..first + set.rays.len();
        first = span.end;
        let part = |all: &'_ [f32]| all.get(span.clone()).unwrap_or_default().to_vec();
        rays::n_different(set, &part(ours), &part(theirs))
    })
}

fn row(
    mesh: &'static str,
    n_triangles: usize,
    library: Library,
    sets: &[Set; 4],
    told: &[Output],
    n_different: [usize; 4],
) -> Row {
    let n_rays = sets.each_ref().map(|set| set.rays.len());
    let seconds =
        |k: usize| median(&told.iter().flat_map(|one| one.seconds[k].clone()).collect::<Vec<_>>());
    Row {
        mesh,
        n_triangles,
        library,
        name: library.name(),
        build_s: median(&told.iter().map(|one| one.build_s).collect::<Vec<_>>()),
        bytes: told[0].bytes,
        mrays: std::array::from_fn(|k| n_rays[k] as f64 / seconds(k) * 1e-6),
        n_rays,
        n_different,
    }
}

/// Returns the row of a library and a mesh, if it was measured.
pub fn find<'a>(rows: &'a [Row], library: Library, mesh: &str) -> Option<&'a Row> {
    rows.iter().find(|row| row.library == library && row.mesh == mesh)
}
