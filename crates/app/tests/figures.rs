//! `eyebeam figures`: the files are there, and their numbers show what the figures claim. Measured times are not judged.

use std::collections::HashMap;
use std::path::Path;
use std::process::{Command, Output};
use std::{fs, io};

fn figures(output: &Path) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_eyebeam"));
    command.args(["figures", "paper", "--quick", "-o"]).arg(output).output().unwrap()
}

/// Rows of a CSV file, each from column to cell.
fn read_csv(path: &Path) -> Vec<HashMap<String, String>> {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let header = lines.next().unwrap();
    lines
        .map(|cells| {
            assert_eq!(cells.len(), header.len(), "{}", path.display());
            header.iter().cloned().zip(cells).collect()
        })
        .collect()
}

fn number(row: &HashMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column}: `{}` is no number", row[column]))
}

fn assert_increasing(what: &str, values: &[f64]) {
    assert!(values.len() > 1 && values.windows(2).all(|w| w[0] < w[1]), "{what}: {values:?}");
}

#[test]
fn paper() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("made/when missing");
    let done = figures(&output);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    assert!(done.stdout.is_empty());
    for name in ["samples", "depth", "roughness", "complexity"] {
        check_png(&output.join(name).with_extension("png"));
        check_csv(&output.join(name).with_extension("csv"));
    }
    check_samples(&read_csv(&output.join("samples.csv")));
    check_depth(&read_csv(&output.join("depth.csv")));
    check_roughness(&read_csv(&output.join("roughness.csv")));
}

fn check_png(path: &Path) {
    let file = io::BufReader::new(fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert!((200..2000).contains(&info.width) && (150..2000).contains(&info.height), "{}: {info:?}", path.display());
    assert!(pixels.iter().any(|&c| c < 64) && pixels.contains(&255), "{}: ink on white", path.display());
}

/// Cells are finite numbers, but for names in columns of names and gaps.
fn check_csv(path: &Path) {
    let names = ["region", "roughness", "variable", "scene"];
    let rows = read_csv(path);
    assert!(!rows.is_empty());
    for (column, cell) in rows.iter().flatten().filter(|(column, _)| !names.contains(&column.as_str())) {
        assert!(cell.is_empty() || cell.parse::<f64>().is_ok_and(f64::is_finite), "{column}: `{cell}`");
    }
}

/// Independent samples: the error falls as n^(-1/2).
fn check_samples(rows: &[HashMap<String, String>]) {
    let slope = number(&rows[0], "slope");
    assert!((slope + 0.5).abs() < 0.05, "slope {slope}");
    let errors: Vec<_> = rows.iter().rev().map(|row| number(row, "rmse")).collect();
    assert_increasing("error with fewer samples", &errors);
}

fn check_depth(rows: &[HashMap<String, String>]) {
    let series = |region: &str, column: &str| -> Vec<(f64, f64)> {
        let of_region = rows.iter().filter(|row| row["region"] == region && !row[column].is_empty());
        of_region.map(|row| (number(row, "max_depth"), number(row, column))).collect()
    };
    let at = |region, column, depth| series(region, column).iter().find(|(d, _)| *d == depth).unwrap().1;

    assert_eq!(at("all_surfaces", "luminance", 1.0), 0.0, "surfaces are black at d = 1");
    assert!(at("sky", "luminance", 1.0) > 0.5, "the sky is not");
    assert_eq!(at("sky", "luminance", 1.0), at("sky", "luminance", 50.0), "and has no depth");

    let shadow = |region| series(region, "luminance").iter().map(|(_, l)| *l).collect::<Vec<_>>();
    assert_increasing("the yellow sphere's shadow with d", &shadow("ground_below_yellow"));
    // Seen in a mirror, it is black until paths have three edges.
    assert_increasing("the other sphere's shadow with d", &shadow("ground_below_other_mirrored")[1..]);

    let yellowness = |depth| at("ground_below_yellow", "relative_yellowness", depth);
    assert!(yellowness(50.0) > 1.2 * yellowness(2.0), "{} after {}", yellowness(50.0), yellowness(2.0));
}

/// The mirrored horizon widens with roughness, and the sphere becomes more even up to the lambertian.
fn check_roughness(rows: &[HashMap<String, String>]) {
    assert_eq!(rows.len(), 5);
    let widths: Vec<_> = rows[..4].iter().map(|row| number(row, "horizon_width")).collect();
    assert_increasing("width of the horizon with roughness", &widths);
    let deviations: Vec<_> = rows.iter().rev().map(|row| number(row, "deviation_of_luminance")).collect();
    assert_increasing("deviation with less roughness", &deviations);
}

#[test]
fn unwritable_folder_is_exit_code_4() {
    let file = tempfile::NamedTempFile::new().unwrap();
    let done = figures(file.path());
    assert_eq!(done.status.code(), Some(4));
    assert!(String::from_utf8_lossy(&done.stderr).starts_with("error: cannot write"));
}
