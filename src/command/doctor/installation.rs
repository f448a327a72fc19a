//! How this ggrade came to this machine, which says who installs what it lacks, and how it is renewed.

use crate::language::Text;
use std::path::{Path, PathBuf};

/// Written into the image by `deploy/container/Containerfile`.
const IMAGE_MARK: &str = "usr/share/ggrade/image";

/// The list of a Debian package's files.
const PACKAGE_LIST: &str = "var/lib/dpkg/info/ggrade.list";

/// How a program was installed.
#[derive(Debug, PartialEq, Eq)]
pub enum Installation {
    /// By the Debian package.
    Package,
    /// In the container image.
    Image,
    /// By `cargo install`, into this folder.
    Cargo(PathBuf),
    /// Not at all: it was built in this source tree.
    Source(PathBuf),
    /// By somebody who copied the program.
    Copy,
}

impl Installation {
    /// That of a program, on a machine whose files are below `root`.
    pub fn of(program: &Path, root: &Path) -> Self {
        let lists = |file: PathBuf, line: &str| {
            std::fs::read_to_string(file).is_ok_and(|text| text.lines().any(|found| found.starts_with(line)))
        };
        if program.starts_with("/usr/bin") {
            if root.join(IMAGE_MARK).exists() {
                return Self::Image;
            }
            if lists(root.join(PACKAGE_LIST), &program.to_string_lossy()) {
                return Self::Package;
            }
        }
        // Cargo keeps a list of what it has installed beside the folder of the programs.
        if let Some(folder) = program.parent().and_then(Path::parent)
            && lists(folder.join(".crates.toml"), "\"ggrade ")
        {
            return Self::Cargo(folder.to_owned());
        }
        let tree = program.ancestors().skip(1).find(|folder| lists(folder.join("Cargo.toml"), "name = \"ggrade\""));
        tree.map_or(Self::Copy, |folder| Self::Source(folder.to_owned()))
    }

    /// What it is, and how it is renewed.
    pub fn description(&self) -> Text {
        match self {
            Self::Package => Text::new(
                "the Debian package; a newer one is installed over it. The service's file is /etc/ggrade/ggrade.toml",
                "Debian パッケージ。新しいパッケージを上からインストールして更新します。サービスの設定は /etc/ggrade/ggrade.toml です",
            ),
            Self::Image => Text::new(
                "the container image; a newer one takes its place. What is kept is in /var/lib/ggrade",
                "コンテナイメージ。新しいイメージに置き換えて更新します。保存されるデータは /var/lib/ggrade にあります",
            ),
            Self::Cargo(folder) => Text::new(
                format!("cargo install, into {}; `cargo install --path` renews it", folder.display()),
                format!("cargo install によるもの ({})。`cargo install --path` で更新します", folder.display()),
            ),
            Self::Source(folder) => Text::new(
                format!("built in the source tree {}; script/build renews it", folder.display()),
                format!("ソースツリー {} でビルドしたもの。script/build で更新します", folder.display()),
            ),
            Self::Copy => Text::new(
                "a program that was copied here; a newer one takes its place",
                "コピーされたプログラム。新しいプログラムに置き換えて更新します",
            ),
        }
    }

    /// What to try where this machine cannot grade.
    pub fn remedy(&self) -> Text {
        match self {
            Self::Package => Text::new(
                "apt-get --fix-broken install installs what the package depends on.",
                "apt-get --fix-broken install で、パッケージに必要なものがインストールされます。",
            ),
            Self::Image => Text::new(
                "The image has all that grading needs: what is missing is taken away by how the container is run, such as a \
                 seccomp profile, a limit of memory or a variable (docs/operations.md).",
                "イメージには採点に必要なものがすべてあります。足りないものは、コンテナの起動方法 (seccomp プロファイル、メモリの制限、\
                 環境変数など) で失われています (docs/operations.md)。",
            ),
            Self::Source(folder) => Text::new(
                format!("{}/script/bootstrap installs what is missing.", folder.display()),
                format!("{}/script/bootstrap で、足りないものがインストールされます。", folder.display()),
            ),
            Self::Cargo(_) | Self::Copy => Text::new(
                "Only the program was installed. On Debian and Ubuntu: apt-get install mesa-vulkan-drivers libvulkan1",
                "インストールされたのはプログラムだけです。Debian / Ubuntu では apt-get install mesa-vulkan-drivers libvulkan1 を実行してください",
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write(root: &Path, file: &str, text: &str) {
        let path = root.join(file);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }

    #[test]
    fn each_place_is_known() {
        let machine = tempfile::tempdir().unwrap();
        let root = machine.path();
        let program = Path::new("/usr/bin/ggrade");
        assert_eq!(Installation::of(program, root), Installation::Copy);
        write(root, PACKAGE_LIST, "/.\n/usr/bin\n/usr/bin/ggrade\n");
        assert_eq!(Installation::of(program, root), Installation::Package);
        assert_eq!(Installation::of(Path::new("/opt/bin/ggrade"), root), Installation::Copy);
        write(root, IMAGE_MARK, "");
        assert_eq!(Installation::of(program, root), Installation::Image);

        let home = root.join("home/.cargo");
        assert_eq!(Installation::of(&home.join("bin/ggrade"), root), Installation::Copy);
        write(root, "home/.cargo/.crates.toml", "[v1]\n\"other 1.0.0 (path)\" = [\"other\"]\n");
        assert_eq!(Installation::of(&home.join("bin/ggrade"), root), Installation::Copy);
        write(root, "home/.cargo/.crates.toml", "[v1]\n\"ggrade 0.1.0 (path+file:///x)\" = [\"ggrade\"]\n");
        assert_eq!(Installation::of(&home.join("bin/ggrade"), root), Installation::Cargo(home));

        let tree = root.join("src/ggrade");
        write(root, "src/ggrade/Cargo.toml", "[package]\nname = \"ggrade\"\n");
        assert_eq!(Installation::of(&tree.join("target/release/ggrade"), root), Installation::Source(tree));
    }
}
