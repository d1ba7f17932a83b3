//! Every command in the documentation that renders a scene of the repository does what it says.

use std::fs;
use std::path::Path;

use crate::Place;

/// What follows `eyebeam` in the commands of a text; redirections and other programs' options stand before it.
fn commands(text: &str) -> impl Iterator<Item = &str> {
    let starts = ["eyebeam render scenes/", "cargo run --release -- render scenes/"];
    text.lines().filter_map(move |line| starts.iter().find_map(|start| line.find(start).map(|at| &line[at..])))
}

#[test]
fn commands_of_the_documentation_run() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut count = 0;
    for name in ["README.md", "docs/formats/pictures.md", "docs/formats/scene.md", "docs/performance.md"] {
        for command in commands(&fs::read_to_string(root.join(name)).unwrap()) {
            let place = Place::new();
            let (_, args) = command.split_once("render ").unwrap();
            // Small, and with its output here: what an option says last does not count twice, so theirs go.
            let mut kept = Vec::new();
            let mut output = "out.png".to_owned();
            let mut words = args.split_whitespace();
            while let Some(word) = words.next() {
                match word {
                    "-r" | "--spp" => drop(words.next()),
                    "-o" => output = format!("out.{}", words.next().unwrap().rsplit('.').next().unwrap()),
                    _ => kept.push(word.replace("scenes/", &format!("{}/scenes/", root.display()))),
                }
            }
            let run = place.run(&format!("render {} -o {output} -r 16x9 --spp 1", kept.join(" ")));
            assert_eq!(run.code, Some(0), "{name}: {command}\n{}", run.stderr);
            assert!(place.path(&output).exists());
            count += 1;
        }
    }
    assert!(count >= 4, "only {count} commands were found");
}
