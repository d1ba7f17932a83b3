//! Every command in the documentation that renders a scene of the repository does what it says.

use std::fs;
use std::path::Path;

use crate::Place;

/// What follows `eyebeam` in the commands of a text; redirections and other programs' options stand before it.
fn commands(text: &str) -> impl Iterator<Item = &str> {
    let of_line = |line: &'_ str| {
        let after = ["eyebeam ", "cargo run --release -- "].iter().find_map(|start| Some(line.split_once(start)?.1))?;
        let (command, file) = after.split_once(' ')?;
        let is_known = ["render", "info", "convert", "turntable"].contains(&command);
        (is_known && file.starts_with("scenes/")).then_some(after.len())
    };
    text.lines().filter_map(move |line| Some(&line[line.len() - of_line(line)?..]))
}

#[test]
fn commands_of_the_documentation_run() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut count = 0;
    for name in ["README.md", "docs/formats/pictures.md", "docs/formats/scene.md", "docs/performance.md"] {
        for command in commands(&fs::read_to_string(root.join(name)).unwrap()) {
            let place = Place::new();
            // Small, and with its output here: what an option says last does not count twice, so theirs go.
            let mut kept = Vec::new();
            let mut output = None;
            let mut words = command.split_whitespace();
            while let Some(word) = words.next() {
                match word {
                    "-r" | "--spp" | "-n" => drop(words.next()),
                    "-o" => output = words.next(),
                    _ => kept.push(word.replace("scenes/", &format!("{}/scenes/", root.display()))),
                }
            }
            let kept = kept.join(" ");
            let args = match (kept.split(' ').next(), output) {
                (Some("render"), output) => {
                    let ending = output.and_then(|name| name.rsplit('.').next()).unwrap_or("png");
                    format!("{kept} -o out.{ending} -r 16x9 --spp 1")
                }
                (Some("turntable"), Some(output)) => format!("{kept} -o {output} -n 2 -r 16x9 --spp 1"),
                _ => kept,
            };
            let run = place.run(&args);
            assert_eq!(run.code, Some(0), "{name}: {command}\n{}", run.stderr);
            // The scene that every place has, and what was made, if it is no text.
            assert!(place.files().len() > 1 || !run.stdout.is_empty(), "{name}: {command}");
            count += 1;
        }
    }
    assert!(count >= 7, "only {count} commands were found");
}
