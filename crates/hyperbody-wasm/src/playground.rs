//! The playground: the scene that runs, and messages to it. Everything here runs natively too, where it is tested.

use hyperbody_scene::{BUILT_IN, Scene, SceneError, built_in};
use serde_json::{Value, json};

use crate::commands::Done;
use crate::frame::Buffers;
use crate::locate::locate;
use crate::message::{Message, Refusal, Reply, Report, SceneDescription};
use crate::running::Running;

/// A scene of any dimension that runs.
trait Run {
    fn step(&mut self);
    fn draw(&mut self, buffers: &mut Buffers);
    fn handle(&mut self, message: Message) -> Result<Done, Refusal>;
    fn describe(&self) -> SceneDescription;
    fn report(&mut self) -> Report;
    fn show(&mut self, ghosts: Option<f64>, wires: bool);
}

macro_rules! run {
    ($($n:literal)*) => {
        $(impl Run for Running<$n> {
            fn step(&mut self) {
                Self::step(self);
            }
            fn draw(&mut self, buffers: &mut Buffers) {
                Self::draw(self, buffers);
            }
            fn handle(&mut self, message: Message) -> Result<Done, Refusal> {
                Self::handle(self, message)
            }
            fn describe(&self) -> SceneDescription {
                Self::describe(self)
            }
            fn report(&mut self) -> Report {
                Self::report(self)
            }
            fn show(&mut self, ghosts: Option<f64>, wires: bool) {
                self.ghosts = ghosts;
                self.wires = wires;
            }
        })*

        /// Starts a scene. The dimensions stand here, because how a section is cut down differs with them.
        fn start(scene: Scene) -> Result<Box<dyn Run>, SceneError> {
            match scene.dimension {
                $($n => Ok(Box::new(Running::<$n>::new(scene)?)),)*
                // Refused by the scene crate. `AnyWorld` would refuse it too, but bring every engine a second time.
                _ => Ok(Box::new(Running::<2>::new(scene)?)),
            }
        }
    };
}

run!(2 3 4 5 6);

/// What the page loads: a scene that runs, or none yet.
#[derive(Default)]
pub struct Playground {
    running: Option<Box<dyn Run>>,
    /// What runs, as it was loaded.
    loaded: Option<(Option<String>, Scene)>,
    /// What the page has asked to see, which goes for the next scene too.
    ghosts: Option<f64>,
    wires: bool,
    buffers: Buffers,
    /// The last file that was asked for.
    file: Vec<u8>,
}

impl Playground {
    /// One without a scene.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The built-in scenes, as the protocol's `BuiltIn`.
    #[must_use]
    pub fn builtins() -> Value {
        let told = BUILT_IN.iter().map(|builtin| {
            let scene = builtin.scene();
            json!({
                "name": builtin.name,
                "title": title(builtin.name),
                "dimension": scene.dimension,
                "group": group(builtin.name),
                "sentence": scene.description,
                "bodies": scene.bodies.len(),
            })
        });
        told.collect()
    }

    /// Obeys a message.
    pub fn handle(&mut self, message: Message) -> Reply {
        let outcome = match message {
            Message::Load { text } => self.load_text(&text),
            Message::LoadBuiltin { name } => self.load_builtin(&name),
            Message::Reset {} => self.reset(),
            other => return self.obey(other),
        };
        match outcome {
            Ok(scene) => Reply {
                answer: serde_json::to_value(&scene).ok(),
                scene: Some(scene),
                loaded: true,
                ..Reply::default()
            },
            Err(refusal) => Reply { refused: Some(refusal), ..Reply::default() },
        }
    }

    /// Obeys a message in JSON, and replies in JSON.
    pub fn handle_text(&mut self, message: &str) -> String {
        let reply = match serde_json::from_str(message) {
            Ok(message) => self.handle(message),
            Err(error) => {
                let refusal = Refusal::new(format!("the engine does not understand this message: {error}"));
                Reply { refused: Some(refusal), ..Reply::default() }
            }
        };
        serde_json::to_string(&reply).unwrap_or_default()
    }

    fn obey(&mut self, message: Message) -> Reply {
        match message {
            Message::Ghosts { on, reach } => self.ghosts = on.then_some(reach),
            Message::Wires { on } => self.wires = on,
            _ => {}
        }
        let Some(running) = &mut self.running else {
            let refusal = Refusal::new("no scene is loaded");
            return Reply { refused: Some(refusal), ..Reply::default() };
        };
        match running.handle(message) {
            Ok(done) => {
                if let Some(bytes) = done.bytes {
                    self.file = bytes;
                }
                let scene = done.bodies_changed.then(|| self.describe()).flatten();
                Reply { answer: done.answer, scene, ..Reply::default() }
            }
            Err(refusal) => Reply { refused: Some(refusal), ..Reply::default() },
        }
    }

    fn load_text(&mut self, text: &str) -> Result<SceneDescription, Refusal> {
        let refuse = |error: SceneError| {
            let place = locate(text, error.place());
            Refusal {
                message: error.to_string(),
                code: None,
                line: place.map(|(line, _)| line),
                column: place.map(|(_, column)| column),
            }
        };
        let scene = Scene::from_json(text).map_err(refuse)?;
        self.run(None, scene).map_err(refuse)
    }

    fn load_builtin(&mut self, name: &str) -> Result<SceneDescription, Refusal> {
        let scene = built_in(name).map_err(|nearest| {
            Refusal::new(format!("no built-in scene is called \"{name}\"; the nearest is \"{nearest}\""))
        })?;
        Ok(self.run(Some(name.to_owned()), scene)?)
    }

    fn reset(&mut self) -> Result<SceneDescription, Refusal> {
        let (builtin, scene) = self.loaded.clone().ok_or_else(|| Refusal::new("no scene is loaded"))?;
        Ok(self.run(builtin, scene)?)
    }

    /// Replaces the running scene, if the new one can be built.
    fn run(&mut self, builtin: Option<String>, scene: Scene) -> Result<SceneDescription, SceneError> {
        let mut running = start(scene.clone())?;
        running.show(self.ghosts, self.wires);
        let mut description = running.describe();
        if let Some(name) = &builtin {
            description.title = title(name);
            description.builtin = Some(name.clone());
        }
        self.running = Some(running);
        self.loaded = Some((builtin, scene));
        Ok(description)
    }

    fn describe(&self) -> Option<SceneDescription> {
        let mut description = self.running.as_ref()?.describe();
        if let Some((Some(name), _)) = &self.loaded {
            description.title = title(name);
            description.builtin = Some(name.clone());
        }
        Some(description)
    }

    /// One step, unless the past is shown or nothing is loaded.
    pub fn step(&mut self) {
        if let Some(running) = &mut self.running {
            running.step();
        }
    }

    /// Cuts everything with the slice; see [`Playground::buffers`].
    pub fn draw(&mut self) {
        if let Some(running) = &mut self.running {
            running.draw(&mut self.buffers);
        }
    }

    /// The arrays of the last [`Playground::draw`].
    #[must_use]
    pub fn buffers(&self) -> &Buffers {
        &self.buffers
    }

    /// What a frame tells beside its arrays; impacts are told once.
    pub fn report(&mut self) -> Option<Report> {
        Some(self.running.as_mut()?.report())
    }

    /// The file that the last export made.
    #[must_use]
    pub fn file(&self) -> &[u8] {
        &self.file
    }
}

/// "pit4d" is "Pit 4D".
fn title(name: &str) -> String {
    let words = name.replace('_', " ");
    let split = words.find(|c: char| c.is_ascii_digit()).unwrap_or(words.len());
    let (words, dimension) = words.split_at(split);
    let mut letters = words.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string()).unwrap_or_default();
    format!("{first}{} {}", letters.as_str(), dimension.to_uppercase()).trim().to_owned()
}

/// The sort of scene, by its name.
fn group(name: &str) -> &'static str {
    let stem = name.trim_end_matches('d').trim_end_matches(|c: char| c.is_ascii_digit());
    match stem {
        "stack" | "pyramid" | "embedded" => "stacks",
        "pit" | "dice" | "balls" | "capsules" | "rounded" | "ells" => "piles",
        "ramp" | "conveyor" => "friction",
        "bounce" | "clouds" => "bounces",
        "wing_nut" | "tumble" | "gyroscope" => "spins",
        "dominoes" | "bowling" | "wrecking_ball" => "games",
        "cradle" | "chain" | "pendulum" | "seesaw" | "car" | "door" | "mixer" => "joints",
        _ => "more",
    }
}
