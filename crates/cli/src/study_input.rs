//! What the reconstruction experiments read beside drawings: sample sets, perhaps compressed by xz, and folders of images.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use fsample_experiments::silhouette::Outline;
use fsample_experiments::study::GivenSets;
use lineart::text_in;

use crate::errors::Failure;

/// The first bytes of an xz file.
const XZ: [u8; 6] = [0xfd, b'7', b'z', b'X', b'Z', 0];

/// Sample sets; a file in xz form is told by its first bytes.
pub(crate) fn sets(file: &Path) -> Result<GivenSets, Failure> {
    let name = file.display().to_string();
    let mut bytes = Vec::new();
    let opened = fs::File::open(file).and_then(|file| file.take(text_in::MAX_BYTES).read_to_end(&mut bytes));
    opened.map_err(|error| Failure::input(&name, format!("cannot be read: {error}")))?;
    let text = if bytes.starts_with(&XZ) {
        text_in::read(lzma_rust2::XzReader::new(bytes.as_slice(), true))
    } else {
        text_in::read(bytes.as_slice())
    };
    let text = text.map_err(|error| Failure::input(&name, error))?;
    GivenSets::read(&text, &name).map_err(Failure::read)
}

/// Outlines of PNG images, and of those in folders, by name.
pub(crate) fn masks(places: &[PathBuf]) -> Result<Vec<Outline>, Failure> {
    let mut files = Vec::new();
    for place in places {
        let failure = |error| Failure::input(&place.display().to_string(), format!("cannot be read: {error}"));
        if !place.is_dir() {
            files.push(place.clone());
            continue;
        }
        let entries = fs::read_dir(place).and_then(Iterator::collect::<Result<Vec<_>, _>>).map_err(failure)?;
        let mut found: Vec<PathBuf> = entries.iter().map(fs::DirEntry::path).filter(|path| is_png(path)).collect();
        if found.is_empty() {
            return Err(Failure::input(&place.display().to_string(), "there is no .png file in this folder"));
        }
        found.sort();
        files.append(&mut found);
    }
    let outline = |file: &PathBuf| {
        let name = file.display().to_string();
        let bytes = fs::read(file).map_err(|error| Failure::input(&name, format!("cannot be read: {error}")))?;
        Outline::of_png(&bytes, &name).map_err(Failure::read)
    };
    files.iter().map(outline).collect()
}

fn is_png(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"))
}
