//! The guide: the three tasks of `docs/mechanics.md`, with the commands of the page.

use crate::program::{root, run};
use std::fs;
use tempfile::TempDir;

/// The tasks: their sections of the page.
fn tasks() -> Vec<String> {
    let page = fs::read_to_string(root().join("docs/mechanics.md")).unwrap();
    let sections = page.split("\n## ").filter(|section| section.starts_with("Task "));
    sections.map(str::to_string).collect()
}

/// The text of the fenced block with this language.
fn block<'s>(section: &'s str, kind: &str) -> &'s str {
    let (_, rest) = section.split_once(&format!("```{kind}\n")).unwrap();
    rest.split_once("```").unwrap().0
}

/// The problem file of a task, and its commands, split into words.
fn file_and_commands(section: &str) -> (String, Vec<Vec<String>>) {
    let commands: Vec<Vec<String>> = (block(section, "sh").lines())
        .map(|line| line.strip_prefix("affinor ").unwrap())
        .map(|line| line.split_whitespace().map(str::to_string).collect())
        .collect();
    let words = commands.iter().flatten();
    let mut files: Vec<String> = words.filter(|word| word.ends_with(".toml")).cloned().collect();
    files.dedup();
    assert_eq!(files.len(), 1, "{section}");
    (files.remove(0), commands)
}

/// Runs the commands of a task in a folder with its file only, after an optional edit. Returns the
/// standard errors and the folder.
fn done(section: &str, edit: impl Fn(&str) -> String) -> (Vec<String>, TempDir) {
    let (file, commands) = file_and_commands(section);
    let folder = TempDir::new().unwrap();
    let copy = folder.path().join(&file);
    fs::create_dir_all(copy.parent().unwrap()).unwrap();
    fs::write(copy, edit(&fs::read_to_string(root().join(&file)).unwrap())).unwrap();
    let run = |command: &Vec<String>| {
        let outcome = run(folder.path(), command, b"");
        assert_eq!(outcome.status, 0, "{command:?}: {}", outcome.err);
        let output = folder.path().join(command.last().unwrap());
        assert!(fs::metadata(&output).unwrap().len() > 100, "{command:?}");
        outcome.err
    };
    (commands.iter().map(run).collect(), folder)
}

/// The number after a word of a text.
fn after(text: &str, word: &str) -> f64 {
    let (_, rest) = text.split_once(word).unwrap_or_else(|| panic!("{word}: {text}"));
    rest.split_whitespace().next().unwrap().parse().unwrap()
}

/// A column of a CSV file.
fn column(folder: &TempDir, file: &str, name: &str) -> Vec<f64> {
    let mut reader = csv::Reader::from_path(folder.path().join(file)).unwrap();
    let at = reader.headers().unwrap().iter().position(|head| head == name).unwrap();
    reader.records().map(|record| record.unwrap()[at].parse().unwrap()).collect()
}

#[test]
fn each_task_takes_one_file_and_at_most_five_commands() {
    let tasks = tasks();
    assert_eq!(tasks.len(), 3);
    for task in &tasks {
        let (file, commands) = file_and_commands(task);
        assert!((1..=5).contains(&commands.len()), "{file}");
        assert!(task.contains(&format!("(../{file})")), "{file} is not linked");
        let text = fs::read_to_string(root().join(&file)).unwrap();
        let (_, problem) = text.split_once('\n').unwrap();
        assert_eq!(block(task, "toml"), problem, "{file}");
    }
}

#[test]
fn the_satellite_is_quiet_when_the_page_says() {
    let (said, folder) = done(&tasks()[0], str::to_string);
    let [weak, strong] = [&said[0], &said[said.len() - 1]].map(|text| after(text, "quiet at t = "));
    assert_eq!([weak, strong].map(f64::round), [215.0, 138.0]);
    assert!(((weak - 60.0) / (strong - 60.0) - 2.0).abs() < 0.02);
    let second = column(&folder, "satellite.csv", "Omega2");
    assert!(second[..30].iter().any(|rate| *rate < -0.2), "it turns over");
}

#[test]
fn the_top_precesses_once_in_its_film() {
    let (_, folder) = done(&tasks()[1], str::to_string);
    for file in ["top.csv", "slow.csv"] {
        for name in ["g33", "energy", "h3"] {
            let values = column(&folder, file, name);
            assert!(values.iter().all(|value| (value - values[0]).abs() < 1e-9), "{file} {name}");
        }
        let (x, y) = (column(&folder, file, "g13"), column(&folder, file, "g23"));
        // the curve has gone around once at the end, but not before
        let angles: Vec<f64> = x.iter().zip(&y).map(|(x, y)| x.atan2(-y)).collect();
        assert!(
            angles[60].abs() > 3.1 && angles[120].abs() < 1e-6 && angles.len() == 121,
            "{file}"
        );
    }
    let film = fs::read_to_string(folder.path().join("top.svg")).unwrap();
    assert!(film.contains("<animate") || film.contains("@keyframes"), "a film moves");
}

/// With a fiftieth and a fivehundredth of the steps: errors that grow with time are already
/// visible.
#[test]
fn the_methods_keep_the_energy_as_the_page_says() {
    let task = &tasks()[2];
    let changes = [2000, 20000].map(|steps| {
        let (said, _) = done(task, |text| text.replace("= 1000000", &format!("= {steps}")));
        let of = |method: &str| {
            let said = said.iter().find(|text| text.contains(&format!("method {method}"))).unwrap();
            let (_, energy) = said.split_once("\n energy ").unwrap();
            energy.split_whitespace().nth(2).unwrap().parse::<f64>().unwrap()
        };
        [of("kick4"), of("rkmk4")]
    });
    let [[kick, rkmk], [later_kick, later_rkmk]] = changes;
    assert!(kick < 1e-8 && (later_kick / kick - 1.0).abs() < 0.1, "{changes:?}");
    assert!(rkmk < 1e-3 && (later_rkmk / rkmk - 10.0).abs() < 2.0, "{changes:?}");
    assert!(
        task.contains("| `kick4` | 4 | 3.7e-9 | 3.8e-9 |") && later_kick < 3.85e-9,
        "{changes:?}"
    );
}
