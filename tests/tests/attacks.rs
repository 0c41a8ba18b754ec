//! Tests of attacks on the machine and on the grader, `tests/attacks/NAME`.
//!
//! Each attack runs without layers first, where it has to work: without this control, the test
//! would prove nothing. Then it runs under each layer that stops it, alone, and under all layers.
//! A layer that this machine lacks cannot be tested; `REQUIRE_LAYERS=1` makes this a failure.

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
use grader::sandbox::{Call, Folder, Layers, Limits, Outcome, Turn, available, interpreters, run};
use grader::submission;
use serde::Deserialize;
use tempfile::TempDir;
use tests::workspace;

const LIMITS: Limits = Limits {
    cpu: Duration::from_secs(20),
    idle: Duration::from_secs(20),
    wall: Duration::from_secs(120),
    memory: 1 << 30,
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
    /// The layers that stop it, each alone.
    stopped_by: Vec<Layer>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Layer {
    Namespaces,
    Landlock,
    Seccomp,
}

impl Layer {
    fn alone(self) -> Layers {
        let none = Layers::default();
        match self {
            Self::Namespaces => Layers { namespaces: true, ..none },
            Self::Landlock => Layers { landlock: true, ..none },
            Self::Seccomp => Layers { seccomp: true, ..none },
        }
    }

    fn is_here(self) -> bool {
        let Layers { namespaces, landlock, seccomp } = available().layers;
        match self {
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
    _socket: UnixListener,
    socket: String,
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
        let socket = format!("attacked-{}-{port}", std::process::id());
        let address = SocketAddr::from_abstract_name(&socket).expect("a name");
        let listener = UnixListener::bind_addr(&address).expect("a socket");
        let byte = Box::new(7);
        Self { folder, victim, tcp, _udp: udp, _socket: listener, socket, byte }
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
            ("SOCKET", self.socket.clone().into()),
        ];
        all.map(|(name, value)| (name.into(), value)).to_vec()
    }

    /// Returns what the attack prints under these layers.
    fn attacked(&self, attack: &Path, layers: Layers) -> String {
        let folder = Folder::new().expect("a folder");
        fs::copy(attack.join("attack.py"), folder.path().join("attack.py")).expect("a copy");
        let call = Call {
            program: "python3".into(),
            args: vec!["attack.py".into()],
            folder: folder.path().to_owned(),
            environment: self.environment(folder.path()),
            stdin: vec![],
            limits: LIMITS,
            layers,
            access: interpreters(&search()),
            needed: 1 << 16,
        };
        let finished = run(&call, Turn::Shared);
        let said = String::from_utf8_lossy(&finished.stdout).into_owned();
        let is_run = matches!(finished.outcome, Outcome::Exited(_));
        assert!(
            is_run,
            "{}: {:?}\n{:?}",
            attack.display(),
            finished.outcome,
            finished.stderr_text()
        );
        said
    }
}

impl Drop for Target {
    fn drop(&mut self) {
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
    let works = |layers| target.attacked(folder, layers).contains(&attack.works);
    let mut faults = vec![];
    if !works(Layers::default()) {
        faults.push(format!("{name}: the control does not work, so the test proves nothing"));
    }
    for layer in attack.stopped_by.iter().filter(|layer| layer.is_here()) {
        if works(layer.alone()) {
            faults.push(format!("{name}: {layer:?} does not stop it ({})", attack.about));
        }
    }
    if attack.stopped_by.iter().any(|layer| layer.is_here()) && works(available().layers) {
        faults.push(format!("{name}: all layers together do not stop it"));
    }
    faults
}

#[test]
fn every_attack_works_without_layers_and_is_stopped_by_each_of_its_own() {
    let target = Target::new();
    let attacks = attacks();
    assert!(attacks.len() >= 16, "{} attacks", attacks.len());
    let faults: Vec<String> =
        attacks.iter().flat_map(|(folder, attack)| faults(&target, folder, attack)).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
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
        environment: vec![("PATH".into(), search()), ("HOME".into(), folder.path().into())],
        stdin: vec![],
        limits: LIMITS,
        layers,
        access: interpreters(&search()),
        needed: 1 << 16,
    };
    for layers in [Layers::default(), available().layers] {
        let finished = run(&call(layers), Turn::Shared);
        assert_eq!(finished.outcome, Outcome::Exited(0), "{layers}: {:?}", finished.stderr_text());
        let out = fs::read_to_string(folder.path().join("out")).expect("a file");
        assert_eq!(out, "[45, true]", "{layers}");
        fs::remove_file(folder.path().join("out")).expect("a file");
    }
}
