//! Running the built binary in a folder of its own.

#![allow(dead_code, reason = "each test binary uses its own part of this module")]

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

/// A square with rounded corners on one side and a wave, in two layers.
pub(crate) const DRAWING: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
  width="100mm" height="50mm" viewBox="0 0 200 100">
  <g id="first" inkscape:groupmode="layer" inkscape:label="outlines">
    <path id="blob" d="M 20,50 C 20,20 80,20 80,50 C 80,80 20,80 20,50 Z"/>
  </g>
  <g id="second" inkscape:groupmode="layer" inkscape:label="lines">
    <path id="wave" d="M 110,50 C 130,10 160,90 180,50"/>
  </g>
</svg>
"#;

/// A temporary folder to run in.
pub(crate) struct Place {
    folder: TempDir,
}

/// What a run left.
pub(crate) struct Ran {
    /// Exit code.
    pub(crate) code: i32,
    /// Standard output.
    pub(crate) out: String,
    /// Standard error.
    pub(crate) err: String,
}

impl Place {
    /// An empty folder.
    pub(crate) fn new() -> Self {
        Self { folder: tempfile::tempdir().expect("a temporary folder") }
    }

    /// A folder with `drawing.svg` in it.
    pub(crate) fn with_drawing() -> Self {
        let place = Self::new();
        place.put("drawing.svg", DRAWING);
        place
    }

    /// The path of a file in the folder.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Writes a file.
    pub(crate) fn put(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).expect("written");
    }

    /// Reads a file.
    pub(crate) fn get(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// The names of all files, sorted.
    pub(crate) fn files(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.folder.path()).expect("the folder is there");
        let mut names: Vec<_> =
            entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// Runs `fsample` with these arguments, split at blanks.
    pub(crate) fn run(&self, arguments: &str) -> Ran {
        self.run_with(&arguments.split_whitespace().collect::<Vec<_>>(), "")
    }

    /// Runs `fsample` with these arguments and this standard input.
    pub(crate) fn run_with(&self, arguments: &[&str], input: &str) -> Ran {
        let mut child = command(self.folder.path())
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("fsample starts");
        let mut stdin = child.stdin.take().expect("a pipe");
        // A run that ends before it reads closes the pipe: no fault of the test.
        drop(stdin.write_all(input.as_bytes()));
        drop(stdin);
        Ran::from(child.wait_with_output().expect("fsample ends"))
    }

    /// Runs and expects success; answers standard output.
    pub(crate) fn ok(&self, arguments: &str) -> String {
        let ran = self.run(arguments);
        assert_eq!(ran.code, 0, "fsample {arguments}: {}", ran.err);
        ran.out
    }

    /// Runs and expects one line of error and this exit code; no file may appear.
    pub(crate) fn fails(&self, arguments: &str, code: i32, words: &[&str]) {
        let before = self.files();
        let ran = self.run(arguments);
        assert_eq!(ran.code, code, "fsample {arguments}: {}", ran.err);
        let errors: Vec<_> = ran.err.lines().filter(|line| !line.starts_with("fsample: warning: ")).collect();
        assert_eq!(errors.len(), 1, "fsample {arguments}: one line, not: {}", ran.err);
        assert!(errors[0].starts_with("fsample: error: "), "fsample {arguments}: {}", ran.err);
        for word in words {
            assert!(errors[0].contains(word), "fsample {arguments}: “{word}” is missing from: {}", errors[0]);
        }
        assert!(ran.out.is_empty(), "fsample {arguments}: nothing on standard output, not: {}", ran.out);
        assert_eq!(self.files(), before, "fsample {arguments}: nothing is left");
    }
}

impl From<Output> for Ran {
    fn from(output: Output) -> Self {
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
        Self {
            // Without a code a signal ended it: that is a crash.
            code: output.status.code().expect("fsample is not killed"),
            out: text(output.stdout),
            err: text(output.stderr),
        }
    }
}

/// The binary, to run in a folder.
pub(crate) fn command(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_fsample"));
    command.current_dir(folder);
    command
}

/// The drawings that ship, by absolute path.
pub(crate) fn shipped_drawings() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../drawings");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .expect("drawings ship with the repository")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "svg"))
        .collect();
    files.sort();
    assert!(!files.is_empty(), "drawings ship with the repository");
    files
}

/// The rows of a CSV as fields, without the header, which has to be this one.
pub(crate) fn table(text: &str, header: &str) -> Vec<Vec<String>> {
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some(header), "the header");
    lines.map(|line| line.split(',').map(str::to_owned).collect()).collect()
}
