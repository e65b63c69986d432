//! The workspace as its manifests describe it.

use std::path::{Path, PathBuf};

use toml::Table;
use xshell::{Shell, cmd};

/// Root, crates and files of the tree we stand in.
pub(crate) struct Workspace {
    pub(crate) root: PathBuf,
    /// The members of `crates/`, sorted by folder.
    pub(crate) crates: Vec<Member>,
}

/// One crate below `crates/`.
pub(crate) struct Member {
    /// `kinematics`
    pub(crate) folder: String,
    /// `piola-kinematics`
    pub(crate) name: String,
    pub(crate) path: PathBuf,
    pub(crate) manifest: Table,
}

impl Member {
    pub(crate) fn is_published(&self) -> bool {
        let publish = self.manifest.get("package").and_then(|package| package.get("publish"));
        publish.and_then(toml::Value::as_bool) != Some(false)
    }

    /// The names of its own features, sorted, without `default`.
    pub(crate) fn features(&self) -> Vec<String> {
        let features = self.manifest.get("features").and_then(toml::Value::as_table);
        features.into_iter().flatten().map(|(name, _)| name.clone()).filter(|name| name != "default").collect()
    }
}

impl Workspace {
    pub(crate) fn open(shell: &Shell) -> Result<Self, String> {
        let manifest = cmd!(shell, "cargo locate-project --workspace --message-format plain").quiet().read();
        let manifest = PathBuf::from(manifest.map_err(|error| error.to_string())?);
        let root = manifest.parent().ok_or("the workspace has no root folder")?.to_path_buf();
        let mut crates = Vec::new();
        let folder = root.join("crates");
        for entry in std::fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))? {
            let path = entry.map_err(|error| error.to_string())?.path();
            if path.join("Cargo.toml").is_file() {
                crates.push(Member::read(path)?);
            }
        }
        crates.sort_by(|a, b| a.folder.cmp(&b.folder));
        Ok(Self { root, crates })
    }

    pub(crate) fn member(&self, folder: &str) -> Option<&Member> {
        self.crates.iter().find(|member| member.folder == folder)
    }

    /// Where cargo builds, which the environment may have moved.
    pub(crate) fn target(shell: &Shell) -> Result<PathBuf, String> {
        let text = cmd!(shell, "cargo metadata --no-deps --format-version 1").quiet().read();
        let metadata: serde_json::Value =
            serde_json::from_str(&text.map_err(|error| error.to_string())?).map_err(|error| error.to_string())?;
        Ok(PathBuf::from(metadata["target_directory"].as_str().ok_or("cargo named no target directory")?))
    }

    /// Every file of the tree that a person wrote, sorted: no build output, no version control.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        let mut files = Vec::new();
        collect(&self.root, &self.root, &mut files);
        files.sort();
        files
    }

    /// `path` from the root, for messages.
    pub(crate) fn relative<'p>(&self, path: &'p Path) -> std::path::Display<'p> {
        path.strip_prefix(&self.root).unwrap_or(path).display()
    }
}

impl Member {
    fn read(path: PathBuf) -> Result<Self, String> {
        let manifest: Table = read(&path.join("Cargo.toml"))?
            .parse()
            .map_err(|error: toml::de::Error| format!("{}/Cargo.toml: {error}", path.display()))?;
        let folder = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let name = manifest.get("package").and_then(|package| package.get("name")).and_then(toml::Value::as_str);
        let name = name.ok_or_else(|| format!("{}/Cargo.toml names no package", path.display()))?.to_owned();
        Ok(Self { folder, name, path, manifest })
    }
}

/// The text of a file, with its path in the error.
pub(crate) fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

fn collect(root: &Path, folder: &Path, files: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for path in entries.filter_map(|entry| entry.ok().map(|entry| entry.path())) {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() {
            // Build output of cargo, of mdBook and of runs; each of these only at the root of what it belongs to.
            let is_output = (folder == root && matches!(&*name, "target" | "out")) || name == "book";
            if name != ".git" && !is_output && !path.is_symlink() {
                collect(root, &path, files);
            }
        } else {
            files.push(path);
        }
    }
}
