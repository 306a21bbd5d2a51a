//! The scene: a world's settings, its bodies and its joints.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use hyperbody::prelude::Material;

use super::{Body, Joint};

/// Length of a step where a scene names none, s.
pub const DEFAULT_DT: f64 = 1.0 / 60.0;

/// Substeps of a step where a scene names none.
pub const DEFAULT_SUBSTEPS: u32 = 4;

/// Gravity where a scene names none: 9.81 m/s² against axis y.
#[must_use]
pub fn default_gravity(dimension: usize) -> Vec<f64> {
    (0..dimension).map(|axis| if axis == 1 { -9.81 } else { 0.0 }).collect()
}

/// A scene of a dimension known at run time: plain data, as a file holds it. [`crate::AnyWorld::new`] says whether it
/// makes sense and builds it. Vectors have one number per axis, in metres and m/s.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// What the scene is called.
    pub name: String,
    /// One sentence that says what to see; may be empty.
    pub description: String,
    /// Number of axes, 2..=6.
    pub dimension: usize,
    /// Acceleration of free fall, m/s².
    pub gravity: Vec<f64>,
    /// Length of a step, s.
    pub dt: f64,
    /// Solver substeps of a step.
    pub substeps: u32,
    /// Whether bodies at rest fall asleep.
    pub sleeping: bool,
    /// Materials by name, in the order of the file; "default" is that of bodies which name none.
    pub materials: Vec<NamedMaterial>,
    /// The bodies, in the order in which they are added to the world.
    pub bodies: Vec<Body>,
    /// What ties bodies together.
    pub joints: Vec<Joint>,
    /// The file that the scene was read from, if any: what messages name, and beside which other files are looked for.
    pub file: Option<PathBuf>,
    /// Texts of files that the scene names, by name: they are taken from here before they are looked for on the disk. Empty
    /// for scenes from files; [`Scene::carry_files`] fills it.
    pub files: BTreeMap<String, String>,
}

/// Where the texts of the files that a scene names come from.
#[derive(Clone, Copy)]
pub(crate) struct Beside<'a> {
    /// Carried along, by name.
    pub(crate) carried: Option<&'a BTreeMap<String, String>>,
    /// The folder in which the others are looked for.
    pub(crate) folder: Option<&'a Path>,
}

/// A material and its name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedMaterial {
    /// What bodies call it.
    pub name: String,
    /// The material.
    pub material: Material,
}

impl Scene {
    /// A scene without bodies: gravity against y, steps of 1/60 s in 4 substeps, sleeping on.
    #[must_use]
    pub fn new(name: impl Into<String>, dimension: usize) -> Self {
        Self {
            name: name.into(),
            description: String::new(),
            dimension,
            gravity: default_gravity(dimension),
            dt: DEFAULT_DT,
            substeps: DEFAULT_SUBSTEPS,
            sleeping: true,
            materials: Vec::new(),
            bodies: Vec::new(),
            joints: Vec::new(),
            file: None,
            files: BTreeMap::new(),
        }
    }

    /// The names of the bodies in order: their own, or "body N" for those that have none.
    #[must_use]
    pub fn body_names(&self) -> Vec<String> {
        let own: BTreeSet<&str> = self.bodies.iter().filter_map(|body| body.name.as_deref()).collect();
        let name = |(index, body): (usize, &Body)| {
            body.name.clone().unwrap_or_else(|| {
                // Primes keep the name apart from that of a body which calls itself so.
                let mut name = format!("body {index}");
                while own.contains(name.as_str()) {
                    name.push('\'');
                }
                name
            })
        };
        self.bodies.iter().enumerate().map(name).collect()
    }

    /// Where the files that the scene names come from.
    pub(crate) fn beside(&self) -> Beside<'_> {
        let folder = self.file.as_deref().and_then(Path::parent);
        let folder = folder.map(|folder| if folder.as_os_str().is_empty() { Path::new(".") } else { folder });
        Beside { carried: Some(&self.files), folder }
    }
}
