//! Runs a scene by the command and reads its results.

use lariat_scene::run::Summary;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn lariat(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_lariat")).args(arguments).output().unwrap()
}

pub fn asset(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../assets/scenes/{name}.toml"))
}

/// The results of a run.
pub struct Results {
    pub folder: tempfile::TempDir,
    pub output: Output,
}

impl Results {
    /// Runs a scene file with overrides.
    pub fn of(command: &str, file: &Path, sets: &[&str]) -> Results {
        let folder = tempfile::tempdir().unwrap();
        let mut arguments = vec![command, file.to_str().unwrap(), "--out", folder.path().to_str().unwrap()];
        sets.iter().for_each(|set| arguments.extend(["--set", set]));
        let output = lariat(&arguments);
        Results { folder, output }
    }

    /// Runs the text of a scene.
    pub fn of_text(command: &str, text: &str) -> Results {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("scene.toml");
        fs::write(&file, text).unwrap();
        Results::of(command, &file, &[])
    }

    pub fn done(self) -> Results {
        assert!(self.output.status.success(), "{}", String::from_utf8_lossy(&self.output.stderr));
        self
    }

    pub fn rows(&self, probe: &str) -> Vec<Vec<f64>> {
        let text = fs::read_to_string(self.folder.path().join(format!("probes/{probe}.csv"))).unwrap();
        text.lines().skip(1).map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect()
    }

    /// The last row of a probe.
    pub fn last(&self, probe: &str) -> Vec<f64> {
        self.rows(probe).pop().unwrap()
    }

    pub fn summary(&self) -> Summary {
        serde_json::from_str(&fs::read_to_string(self.folder.path().join("summary.json")).unwrap()).unwrap()
    }
}

/// Returns a scene of 1 s without gravity, with one body and a light cable far away that is not attached to it.
pub fn free(body: &str, rest: &str) -> String {
    format!(
        "duration = 1.0\ngravity = [0.0, 0.0, 0.0]\n[[body]]\nname = \"b\"\n{body}\n[[cable]]\nname = \"c\"\n\
         points = [[50.0, 0.0, 0.0], [51.0, 0.0, 0.0]]\nsection = {{ round = 0.001 }}\ndensity = 1000.0\n\
         youngs_modulus = 1e6\n{rest}\n[[probe]]\nname = \"b\"\nbody = \"b\"\n[[probe]]\nname = \"energy\"\nenergy = \"all\"\n\
         [[probe]]\nname = \"momentum\"\nmomentum = \"all\"\n"
    )
}
