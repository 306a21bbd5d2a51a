//! `hyperbody render` with ffmpeg, without it, on full disks, and when it is stopped: what it says, and what it leaves behind.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::common::{file, hyperbody, json_of};

/// An empty folder of this name.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("render-failures").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn place(name: &str) -> PathBuf {
    folder(name.split('.').next().unwrap_or(name)).join(name)
}

/// What lies in a folder.
fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect()
}

/// The program with nothing but these folders on its PATH.
fn with_path(path: &str, arguments: &[&str]) -> std::process::Output {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_hyperbody"));
    command.args(arguments).env("PATH", path).output().expect("the program was built for this test")
}

const SHORT: [&str; 8] = ["--seconds", "0.1", "--frame-rate", "20", "--width", "64", "--height", "48"];

#[test]
fn without_ffmpeg_an_apng_is_written_beside() {
    let mp4 = place("beside.mp4");
    let output = with_path("", &[&["render", "dice4d", "-o", mp4.to_str().unwrap()], &SHORT[..]].concat());
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    assert!(said.contains("ffmpeg") && said.contains("beside.apng"), "{said}");
    assert_eq!(names(mp4.parent().unwrap()), ["beside.apng"]);
    let apng = mp4.with_extension("apng");
    let bytes = std::fs::read(&apng).unwrap();
    assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
    // A second time it is there already, and nobody named it.
    let output = with_path("", &[&["render", "dice4d", "-o", mp4.to_str().unwrap(), "--at", "1"], &SHORT[..]].concat());
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("beside.apng is there already") && said.contains("--output"), "{said}");
    assert_eq!(std::fs::read(&apng).unwrap(), bytes, "it stays as it was");
}

/// A folder with a program called ffmpeg: a script.
#[cfg(unix)]
fn fake_ffmpeg(name: &str, script: &str) -> String {
    use std::os::unix::fs::PermissionsExt;
    let folder = place(name);
    std::fs::create_dir_all(&folder).unwrap();
    let program = folder.join("ffmpeg");
    std::fs::write(&program, format!("#!/bin/sh\n[ \"$1\" = -version ] && exit 0\n{script}\n")).unwrap();
    std::fs::set_permissions(&program, std::fs::Permissions::from_mode(0o755)).unwrap();
    format!("{}:/usr/bin:/bin", folder.display())
}

#[cfg(unix)]
#[test]
fn ffmpeg_is_given_every_picture() {
    // In place of an encoder: what it was told, and the pictures as they came, into the last argument.
    let path = fake_ffmpeg("takes", "for last; do :; done\necho \"$@\" > \"$last\"\ncat >> \"$last\"");
    let mp4 = place("film.mp4");
    let output = with_path(&path, &[&["render", "dice4d", "-o", mp4.to_str().unwrap()], &SHORT[..]].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let bytes = std::fs::read(&mp4).unwrap();
    let end = bytes.iter().position(|&byte| byte == b'\n').unwrap();
    let told = String::from_utf8_lossy(&bytes[..end]).into_owned();
    for words in ["-video_size 64x48", "-framerate 20", "rgb24", "libx264", "yuv420p", "+faststart", "-xerror"] {
        assert!(told.contains(words), "{told}");
    }
    assert_eq!(bytes.len() - end - 1, 2 * 3 * 64 * 48, "two pictures");
}

#[cfg(unix)]
#[test]
fn what_ffmpeg_complains_of_is_passed_on_and_leaves_no_file() {
    let path =
        fake_ffmpeg("fails", "for last; do :; done\necho half > \"$last\"\necho 'Unknown encoder libx264' >&2\nexit 1");
    let folder = folder("failed-film");
    let mp4 = folder.join("film.mp4");
    let output = with_path(&path, &[&["render", "dice4d", "-o", mp4.to_str().unwrap()], &SHORT[..]].concat());
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("film.mp4: cannot be written: ffmpeg: Unknown encoder libx264"), "{said}");
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0, "no half-written film");
}

/// A device that is always full stands for the disk.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_clear_error() {
    for name in ["full.png", "full.gif", "full.apng"] {
        let path = place(name);
        let _ = std::fs::remove_file(&path);
        std::os::unix::fs::symlink("/dev/full", &path).unwrap();
        let mut arguments = vec!["render", "dice4d", "-o", path.to_str().unwrap(), "--width", "96"];
        if !name.ends_with("png") || name.ends_with("apng") {
            arguments.extend(["--seconds", "0.1"]);
        }
        let output = hyperbody(&arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{name}: {said}");
        assert!(said.contains(name) && said.contains("cannot be written: No space left"), "{said}");
    }
}

/// Where files may not grow beyond so many blocks, what was there stays, and nothing is left beside it: pictures, sheets and
/// films, whether the system's signal is ignored or left to end the program.
#[cfg(unix)]
#[test]
fn what_finds_the_disk_full_leaves_the_old_file() {
    let path = fake_ffmpeg("ffmpeg-full", "for last; do :; done\ncat > \"$last\" || exit 1");
    let program = env!("CARGO_BIN_EXE_hyperbody");
    for (name, options) in [
        ("still.png", "--at 0"),
        ("sheet.png", "--at 0 --sheet w=-1..1,4"),
        ("film.gif", "--seconds 0.4"),
        ("film.apng", "--seconds 0.4"),
        ("film.mp4", "--seconds 0.4"),
    ] {
        for trap in ["trap '' XFSZ;", ""] {
            let folder = folder("kept");
            let old = folder.join(name);
            std::fs::write(&old, "old").unwrap();
            let line = format!("{trap} ulimit -f 8; exec {program} render pit4d -o {} {options}", old.display());
            let output = std::process::Command::new("sh").args(["-c", &line]).env("PATH", &path).output().unwrap();
            let said = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{name}: {said}");
            assert!(said.contains(&format!("{name}: cannot be written: ")), "{said}");
            assert_eq!(std::fs::read(&old).unwrap(), b"old");
            assert_eq!(names(&folder), [name]);
        }
    }
}

/// An ffmpeg that says it is done and has written nothing: no file, or an empty one.
#[cfg(unix)]
#[test]
fn an_empty_film_is_an_error() {
    for (name, end) in [("idle", ": > \"$last\""), ("lazy", "exit 0")] {
        let folder = folder("empty-film");
        let path = fake_ffmpeg(name, &format!("for last; do :; done\ncat > /dev/null\n{end}"));
        let mp4 = folder.join("film.mp4");
        let output = with_path(&path, &[&["render", "dice4d", "-o", mp4.to_str().unwrap()], &SHORT[..]].concat());
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("film.mp4: cannot be written: ffmpeg says that it is done"), "{said}");
        assert_eq!(names(&folder), Vec::<String>::new());
    }
}

/// An ffmpeg that is there and does not run is no missing one: no film of another kind takes the place of what was asked for.
#[cfg(unix)]
#[test]
fn an_ffmpeg_that_does_not_run_is_told() {
    use std::os::unix::fs::PermissionsExt;

    let complains =
        "#!/bin/sh\necho >&2\necho 'ffmpeg: error while loading shared libraries' >&2\necho more >&2\nexit 127\n";
    for (name, script, mode, words) in [
        ("torn", complains, 0o755, "ffmpeg: error while loading shared libraries;"),
        ("silent", "#!/bin/sh\nexit 3\n", 0o755, "exit status: 3;"),
        ("foreign", "#!/no/such/interpreter\n", 0o755, "No such file"),
        ("plain", "no program", 0o644, "denied"),
    ] {
        let tools = folder(&format!("broken-{name}"));
        let program = tools.join("ffmpeg");
        std::fs::write(&program, script).unwrap();
        std::fs::set_permissions(&program, std::fs::Permissions::from_mode(mode)).unwrap();
        let folder = folder("broken-film");
        let mp4 = folder.join("film.mp4");
        let arguments = [&["render", "dice4d", "-o", mp4.to_str().unwrap()], &SHORT[..]].concat();
        let output = with_path(tools.to_str().unwrap(), &arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{name}: {said}");
        assert!(said.contains("ffmpeg is there but does not run: ") && said.contains(words), "{name}: {said}");
        assert_eq!(said.lines().count(), 1, "{said}");
        assert_eq!(names(&folder), Vec::<String>::new(), "no film in its place");
    }
}

/// Ctrl-C reaches every program of the terminal's group. Whether ffmpeg would end by it or not, the status is that of what was
/// stopped, no file is left, and ffmpeg is gone.
#[cfg(unix)]
#[test]
fn a_film_that_is_stopped_takes_ffmpeg_with_it() {
    use std::os::unix::process::CommandExt;

    for (number, script) in ["cat > /dev/null", "trap '' INT; while :; do sleep 0.05; done"].into_iter().enumerate() {
        let folder = folder("stopped-mp4");
        let start = "for last; do :; done\necho $$ > \"$last.pid\"\necho half > \"$last\"";
        let path = fake_ffmpeg(&format!("stopped{number}"), &format!("{start}\n{script}"));
        let mp4 = folder.join("film.mp4");
        let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_hyperbody"))
            .args(["render", "tumble4d", "--seconds", "60", "--width", "96", "-o", mp4.to_str().unwrap()])
            .env("PATH", &path)
            .process_group(0)
            .spawn()
            .unwrap();
        let start = Instant::now();
        let pid_file = loop {
            let written = names(&folder).into_iter().find(|name| name.ends_with(".pid"));
            match written
                .map(|name| folder.join(name))
                .filter(|file| std::fs::read(file).is_ok_and(|pid| !pid.is_empty()))
            {
                Some(file) => break file,
                None => assert!(start.elapsed() < Duration::from_secs(60), "ffmpeg begins: {:?}", names(&folder)),
            }
            std::thread::sleep(Duration::from_millis(5));
        };
        let ffmpeg = std::fs::read_to_string(&pid_file).unwrap().trim().to_owned();
        std::fs::remove_file(&pid_file).unwrap();
        // To the whole group, as a terminal does.
        let group = format!("-{}", child.id());
        assert!(std::process::Command::new("kill").args(["-INT", "--", &group]).status().unwrap().success());
        assert_eq!(child.wait().unwrap().code(), Some(130), "the status of what was stopped");
        assert_eq!(names(&folder), Vec::<String>::new());
        let there = std::process::Command::new("kill").args(["-0", &ffmpeg]).output().unwrap();
        assert!(!there.status.success(), "ffmpeg is gone");
    }
}

/// A name as long as a file system takes leaves no room for that of a file in the making; one that is longer is refused first.
#[test]
fn long_names_are_written_and_longer_ones_refused() {
    let folder = folder("long");
    let name = format!("{}.png", "ä".repeat(125));
    let picture = folder.join(&name);
    let small = ["--at", "0", "--width", "32", "--quality", "1", "-o"];
    let output = hyperbody(&[&["render", "dice4d"], &small[..], &[picture.to_str().unwrap()]].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(names(&folder), [name]);
    let longer = folder.join(format!("{}.png", "a".repeat(252)));
    let output = hyperbody(&["render", "dice4d", "--at", "3600", "-o", longer.to_str().unwrap()]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("cannot be written: File name too long"), "{said}");
}

/// A scene or recording is never written over by its own picture.
#[test]
fn the_input_is_not_overwritten() {
    let folder = folder("input");
    let film = folder.join("film.gif");
    let recording = film.to_str().unwrap();
    json_of(&["run", "cradle2d", "--steps", "5", "--record", recording, "--json"]);
    let bytes = std::fs::read(&film).unwrap();
    let scene = file("render-failures/input/scene.off", "OFF\n");
    let scene = scene.to_str().unwrap();
    let around = format!("{}/../input/film.gif", folder.display());
    for arguments in
        [["render", recording, "-o", recording], ["render", recording, "-o", &around], ["slice", scene, "-o", scene]]
    {
        let output = hyperbody(&arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("is the input itself"), "{said}");
    }
    assert_eq!(std::fs::read(&film).unwrap(), bytes);
    assert_eq!(std::fs::read(scene).unwrap(), b"OFF\n");
}
