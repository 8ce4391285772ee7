//! Files that are there whole or not at all.
//!
//! A result is written to a new file beside its target (the same folder, hence the same file system) and takes the
//! target's name in one step when it is complete and on its way to the disk. If anything fails before that, the new
//! file is removed and whatever stood at the target is untouched.
//!
//! Replacing is wrong for a target that is no ordinary file: renaming onto `/dev/null` or onto a named pipe would
//! remove the device. Such targets are opened and written directly. A symbolic link keeps pointing at the file it
//! points at: the file behind it is replaced. Permissions of a replaced file are kept.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process;

/// Writes a file through `body`, whole or not at all.
///
/// # Errors
/// Whatever the file system or `body` answers. The target is then as it was before.
pub fn write_file(target: &Path, body: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let existing = match fs::metadata(target) {
        Ok(metadata) => Some(metadata),
        Err(error) if error.kind() == ErrorKind::NotFound => None,
        Err(error) => return Err(error),
    };
    match existing {
        Some(metadata) if metadata.is_dir() => Err(io::Error::new(ErrorKind::IsADirectory, "it is a folder")),
        Some(metadata) if !metadata.is_file() => fill(OpenOptions::new().write(true).open(target)?, body).map(drop),
        Some(metadata) => {
            let target = fs::canonicalize(target)?;
            replace(&target, Some(metadata.permissions()), body)
        }
        None => replace(target, None, body),
    }
}

/// Writes beside the target, then renames.
fn replace(
    target: &Path,
    permissions: Option<fs::Permissions>,
    body: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let (file, temporary) = create_beside(target)?;
    let outcome = (|| {
        let file = fill(file, body)?;
        if let Some(permissions) = permissions {
            file.set_permissions(permissions)?;
        }
        file.sync_all()?;
        // Windows does not rename an open file.
        drop(file);
        fs::rename(&temporary, target)
    })();
    if outcome.is_err() {
        // The first error is the one to report; a file that cannot be removed either adds nothing to it.
        drop(fs::remove_file(&temporary));
    }
    outcome
}

/// Runs `body` on a buffered file and hands the file back with everything in it.
fn fill(file: File, body: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<File> {
    let mut out = BufWriter::with_capacity(1 << 16, file);
    body(&mut out)?;
    out.into_inner().map_err(io::IntoInnerError::into_error)
}

/// A new file in the target's folder, hidden, under a name that nothing else has.
fn create_beside(target: &Path) -> io::Result<(File, PathBuf)> {
    let name = target.file_name().ok_or_else(|| io::Error::new(ErrorKind::InvalidInput, "it names no file"))?;
    for attempt in 0..100_u32 {
        let mut hidden = std::ffi::OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{}-{attempt}.tmp", process::id()));
        let temporary = target.with_file_name(hidden);
        match OpenOptions::new().write(true).create_new(true).open(&temporary) {
            Ok(file) => return Ok((file, temporary)),
            // Left by a process of the same number that was killed.
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
    Err(io::Error::new(ErrorKind::AlreadyExists, "no free name for a temporary file"))
}

#[cfg(test)]
mod tests {
    use super::write_file;
    use std::fs;
    use std::io;

    fn names(folder: &std::path::Path) -> Vec<String> {
        fs::read_dir(folder)
            .expect("folder is there")
            .map(|entry| entry.expect("entry").file_name().to_string_lossy().into_owned())
            .collect()
    }

    #[test]
    fn whole_or_not_at_all() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let target = folder.path().join("out.csv");
        write_file(&target, |out| out.write_all(b"one")).expect("written");
        assert_eq!(fs::read(&target).expect("read"), b"one", "new file");

        let failed = write_file(&target, |out| {
            out.write_all(b"half")?;
            Err(io::Error::other("stop"))
        });
        assert!(failed.is_err(), "the error comes back");
        assert_eq!(fs::read(&target).expect("read"), b"one", "the old file stays");
        assert_eq!(names(folder.path()), ["out.csv"], "no temporary file stays");

        write_file(&target, |out| out.write_all(b"two")).expect("written");
        assert_eq!(fs::read(&target).expect("read"), b"two", "replaced");
    }

    #[test]
    fn what_cannot_be_written() {
        let folder = tempfile::tempdir().expect("temporary folder");
        assert!(write_file(folder.path(), |_| Ok(())).is_err(), "a folder");
        assert!(write_file(&folder.path().join("no/such/out.csv"), |_| Ok(())).is_err(), "a missing folder");
        assert!(names(folder.path()).is_empty(), "nothing is left");
    }

    #[cfg(unix)]
    #[test]
    fn links_and_devices() {
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().expect("temporary folder");
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        fs::write(&file, "old").expect("written");
        symlink(&file, &link).expect("linked");
        write_file(&link, |out| out.write_all(b"new")).expect("written");
        assert_eq!(fs::read(&file).expect("read"), b"new", "the file behind the link is replaced");
        assert!(fs::symlink_metadata(&link).expect("there").is_symlink(), "the link stays a link");

        let null = folder.path().join("null");
        symlink("/dev/null", &null).expect("linked");
        write_file(&null, |out| out.write_all(b"gone")).expect("written");
        assert!(!fs::metadata("/dev/null").expect("there").is_file(), "a device stays a device");
    }
}
