//! Tests of attacks on the machine and on the grader, `tests/attacks/NAME`.
//!
//! Each attack runs without layers and with wide limits first, where it has to work: without this
//! control, the test would prove nothing. Then it runs under each layer that stops it, alone, and
//! under all layers. A layer that this machine lacks cannot be tested; `REQUIRE_LAYERS=1` makes
//! this a failure.
//!
//! After each run no process of the attack is left, its folder is gone, and the next submission
//! gets the record that it gets on a machine that was never attacked.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::net::{TcpListener, UdpSocket};
use std::os::linux::net::SocketAddrExt;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::net::{SocketAddr, UnixListener};
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::time::Duration;

use grader::build::{BuildError, Workshop, build};
use grader::grade::{Bench, Options, Silent, grade};
use grader::sandbox::{Call, Folder, Layers, Limits, Outcome, Turn, available, interpreters, run};
use grader::submission;
use serde::Deserialize;
use tempfile::TempDir;
use tests::workspace;

/// Limits that no attack exceeds.
const WIDE: Limits = Limits {
    cpu: Duration::from_secs(60),
    idle: Duration::from_secs(60),
    wall: Duration::from_secs(120),
    memory: 4 << 30,
    file_size: 64 << 20,
    folder_size: 256 << 20,
    output: 64 << 20,
    processes: 200,
};

const LIMITS: Limits = Limits {
    cpu: Duration::from_secs(2),
    idle: Duration::from_secs(2),
    wall: Duration::from_secs(60),
    memory: 256 << 20,
    file_size: 1 << 20,
    folder_size: 8 << 20,
    output: 1 << 20,
    processes: 40,
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Attack {
    about: String,
    /// Text that the attack prints if it works.
    works: String,
    /// The layers that stop it, each alone. There are none if it does no harm, because the end of
    /// the run undoes what it did.
    stopped_by: Vec<Layer>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Layer {
    /// Limits on time and resources, which are always in force.
    Limits,
    Namespaces,
    Landlock,
    Seccomp,
}

impl Layer {
    fn alone(self) -> (Layers, Limits) {
        let none = Layers::default();
        match self {
            Self::Limits => (none, LIMITS),
            Self::Namespaces => (Layers { namespaces: true, ..none }, WIDE),
            Self::Landlock => (Layers { landlock: true, ..none }, WIDE),
            Self::Seccomp => (Layers { seccomp: true, ..none }, WIDE),
        }
    }

    fn is_here(self) -> bool {
        let Layers { namespaces, landlock, seccomp } = available().layers;
        match self {
            Self::Limits => true,
            Self::Namespaces => namespaces,
            Self::Landlock => landlock,
            Self::Seccomp => seccomp,
        }
    }
}

fn attacks() -> BTreeMap<PathBuf, Attack> {
    let entries = fs::read_dir(workspace().join("tests/attacks")).expect("the folder of attacks");
    let read = |folder: PathBuf| {
        let text = fs::read_to_string(folder.join("attack.toml")).expect("attack.toml");
        let attack = toml::from_str(&text);
        (folder.clone(), attack.unwrap_or_else(|why| panic!("{}: {why}", folder.display())))
    };
    entries.map(|entry| read(entry.expect("an entry").path())).collect()
}

/// What there is to steal, to break and to reach: a file, a program, a process, sockets.
struct Target {
    folder: TempDir,
    victim: Child,
    tcp: TcpListener,
    /// On the port of the other one.
    _udp: UdpSocket,
    _sockets: [UnixListener; 2],
    /// The name of a socket, of a file in shared memory, and of all processes of the attacks.
    name: String,
    /// An address in the memory of this process, which stands for the grader.
    byte: Box<u64>,
}

impl Target {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let program = folder.path().join("reference");
        fs::write(folder.path().join("answers.json"), "the secret of the course").expect("a file");
        fs::write(&program, "#!/bin/sh\necho the picture of the reference\n").expect("a file");
        fs::set_permissions(&program, PermissionsExt::from_mode(0o755)).expect("a mode");
        let victim = Command::new("sleep")
            .arg("600")
            .env("TOKEN", "the secret of the grader")
            .spawn()
            .expect("a process");
        let tcp = TcpListener::bind("127.0.0.1:0").expect("a port");
        let udp = UdpSocket::bind(tcp.local_addr().expect("an address")).expect("its port");
        let port = tcp.local_addr().expect("an address").port();
        let name = format!("attacked-{}-{port}", std::process::id());
        let address = SocketAddr::from_abstract_name(&name).expect("a name");
        let path = folder.path().join("answers.json.socket");
        let sockets = [UnixListener::bind_addr(&address), UnixListener::bind(path)]
            .map(|listener| listener.expect("a socket"));
        fs::write(Path::new("/dev/shm").join(&name), "the secret of a neighbour").expect("a file");
        let byte = Box::new(7);
        Self { folder, victim, tcp, _udp: udp, _sockets: sockets, name, byte }
    }

    fn environment(&self, folder: &Path) -> Vec<(OsString, OsString)> {
        let file = |name: &str| self.folder.path().join(name).into_os_string();
        let port = self.tcp.local_addr().expect("an address").port();
        let all: [(&str, OsString); 9] = [
            ("PATH", search()),
            ("HOME", folder.into()),
            ("SECRET", file("answers.json")),
            ("PROGRAM", file("reference")),
            ("VICTIM", self.victim.id().to_string().into()),
            ("GRADER", std::process::id().to_string().into()),
            ("ADDRESS", format!("{:p}", &raw const *self.byte).into()),
            ("PORT", port.to_string().into()),
            ("SOCKET", self.name.clone().into()),
        ];
        all.map(|(name, value)| (name.into(), value)).to_vec()
    }

    /// Returns what the attack prints under these layers and limits.
    fn attacked(&self, attack: &Path, (layers, limits): (Layers, Limits)) -> String {
        let folder = Folder::new().expect("a folder");
        fs::copy(attack.join("attack.py"), folder.path().join("attack.py")).expect("a copy");
        let call = Call {
            program: "python3".into(),
            args: vec!["attack.py".into()],
            folder: folder.path().to_owned(),
            in_memory: true,
            environment: self.environment(folder.path()),
            stdin: vec![],
            limits,
            layers,
            access: interpreters(&search()),
            needed: 1 << 16,
        };
        let (finished, _) = run(&call, Turn::Shared);
        let said = String::from_utf8_lossy(&finished.stdout).into_owned();
        let is_run = matches!(finished.outcome, Outcome::Exited(_)) || limits == LIMITS;
        let (name, end, stderr) = (attack.display(), &finished.outcome, finished.stderr_text());
        assert!(is_run, "{name}: {end:?}\n{stderr:?}");
        assert_eq!(self.survivors(), [0; 0], "{name} under {layers}: processes are left");
        let path = folder.path().to_owned();
        drop(folder);
        assert!(!path.exists(), "{name}: its folder is left");
        said
    }
}

impl Target {
    /// Returns the processes of attacks that are alive, which their environment shows.
    fn survivors(&self) -> Vec<u32> {
        let entries = fs::read_dir("/proc").expect("/proc").flatten();
        let pid = |entry: fs::DirEntry| entry.file_name().to_str()?.parse::<u32>().ok();
        let is_marked = |pid: &u32| {
            let environment = fs::read(format!("/proc/{pid}/environ")).unwrap_or_default();
            String::from_utf8_lossy(&environment).contains(&self.name)
        };
        entries.filter_map(pid).filter(is_marked).collect()
    }
}

impl Drop for Target {
    fn drop(&mut self) {
        let _ = fs::remove_file(Path::new("/dev/shm").join(&self.name));
        let _ = self.victim.kill();
        let _ = self.victim.wait();
    }
}

fn search() -> OsString {
    std::env::var_os("PATH").unwrap_or_else(|| "/usr/bin:/bin".into())
}

/// Returns the faults of an attack and its layers.
fn faults(target: &Target, folder: &Path, attack: &Attack) -> Vec<String> {
    let name = folder.file_name().expect("a name").to_string_lossy();
    let works = |under| target.attacked(folder, under).contains(&attack.works);
    let mut faults = vec![];
    if !works((Layers::default(), WIDE)) {
        faults.push(format!("{name}: the control does not work, so the test proves nothing"));
    }
    for layer in attack.stopped_by.iter().filter(|layer| layer.is_here()) {
        if works(layer.alone()) {
            faults.push(format!("{name}: {layer:?} does not stop it ({})", attack.about));
        }
    }
    let is_stopped = !works((available().layers, LIMITS));
    if attack.stopped_by.iter().any(|layer| layer.is_here()) && !is_stopped {
        faults.push(format!("{name}: all layers together do not stop it"));
    }
    faults
}

/// Returns the record of an honest submission as JSON, without times and sizes.
fn honest_record(bench: &Bench) -> String {
    let options =
        Options { name: "honest".to_owned(), ..Options::new(workspace().join("tests/runtimes/c")) };
    let mut record = grade(bench, &options, &Silent).expect("a record").record;
    record.build.time_s = 0.0;
    for check in record.stages.iter_mut().flat_map(|stage| &mut stage.checks) {
        (check.time_s, check.cpu_s, check.peak_bytes) = (0.0, None, 0);
    }
    record.to_json()
}

#[test]
fn every_attack_works_without_layers_and_is_stopped_by_each_of_its_own() {
    let target = Target::new();
    let attacks = attacks();
    assert!(attacks.len() >= 29, "{} attacks", attacks.len());
    let mut bench = Bench::open(&workspace().join("tests/exam")).expect("the exam");
    bench.workshop.layers = available().layers;
    let clean = honest_record(&bench);
    let mut all = vec![];
    for (folder, attack) in attacks {
        all.extend(faults(&target, &folder, &attack));
        let after = honest_record(&bench);
        assert_eq!(after, clean, "{} has changed the next record", folder.display());
    }
    assert!(all.is_empty(), "{}", all.join("\n"));
}

#[test]
fn the_layers_that_are_demanded_are_here() {
    if std::env::var_os("REQUIRE_LAYERS").is_some() {
        let missing = &available().missing;
        assert!(missing.is_empty(), "this machine lacks {missing:?}");
    }
}

/// A submission whose source includes a file of the user compiles without layers, and is refused by
/// the compiler with them: the file is not there.
#[test]
fn a_compiler_cannot_quote_a_file_of_the_user() {
    let target = Target::new();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let source = folder.path().join("src");
    fs::create_dir(&source).expect("a folder");
    for path in tests::files("tests/solution/src", "rs") {
        fs::copy(&path, source.join(path.file_name().expect("a name"))).expect("a copy");
    }
    let secret = target.folder.path().join("answers.json");
    let camera = source.join("camera.rs");
    let text = fs::read_to_string(&camera).expect("a source file");
    let line = format!("const _: &str = include_str!({secret:?});\n");
    fs::write(&camera, text + &line).expect("a source file");
    let built = |layers| {
        let mut workshop = Workshop::open(&tests::public_stages()).expect("the workspace");
        workshop.layers = layers;
        let submission = submission::read(folder.path(), &workshop.template).expect("files");
        build(&submission, &workshop, &|_| {})
    };
    let free = built(Layers::default());
    assert!(free.is_ok(), "the control does not compile: {:?}", free.err());
    if available().layers.namespaces || available().layers.landlock {
        match built(available().layers) {
            Err(BuildError::Rejected(why)) => assert!(why.contains("couldn't read"), "{why}"),
            other => panic!("{other:?}"),
        }
    }
}

/// Interpreters and compiled programs run under all layers as they do without.
#[test]
fn honest_programs_run_under_all_layers() {
    let folder = Folder::new().expect("a folder");
    let script = "import concurrent.futures as c, json, os, tempfile\n\
        with c.ThreadPoolExecutor(8) as p: n = sum(p.map(abs, range(-9, 1)))\n\
        with tempfile.TemporaryFile() as f: f.write(b'x')\n\
        open('out', 'w').write(json.dumps([n, os.cpu_count() > 0]))\n";
    let call = |layers| Call {
        program: "python3".into(),
        args: vec!["-c".into(), script.into()],
        folder: folder.path().to_owned(),
        in_memory: true,
        environment: vec![("PATH".into(), search()), ("HOME".into(), folder.path().into())],
        stdin: vec![],
        limits: WIDE,
        layers,
        access: interpreters(&search()),
        needed: 1 << 16,
    };
    for layers in [Layers::default(), available().layers] {
        let (finished, work) = run(&call(layers), Turn::Shared);
        assert_eq!(finished.outcome, Outcome::Exited(0), "{layers}: {:?}", finished.stderr_text());
        let out = fs::read_to_string(work.path().join("out")).expect("a file");
        assert_eq!(out, "[45, true]", "{layers}");
    }
}
