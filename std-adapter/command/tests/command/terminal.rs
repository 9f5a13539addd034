//! Tests the output in terminals and pipes.

use crate::support::{Run, Workplace};
use std::process::Stdio;

/// Returns lines of more than 80 columns.
fn wide_lines(text: &str) -> Vec<&str> {
    text.lines().filter(|line| line.chars().count() > 80).collect()
}

#[test]
fn every_table_fits_80_columns() {
    let place = Workplace::with_step();
    place.write("q-vf.csv", "0,1,0,1,0,1,1\n".repeat(8));
    for arguments in [
        &["cull", "start.obj", "end.obj", "--threads", "2"][..],
        &["compare", "--steps", "1", "--rounds", "1"],
        &["queries", "q-vf.csv"],
        &["scaling", "--sizes", "1,4"],
    ] {
        let text = place.stdout(arguments);
        assert_eq!(wide_lines(&text), [""; 0], "{arguments:?}");
    }
    assert_eq!(wide_lines(&Run::of_accuracy().text), [""; 0]);
}

#[test]
fn a_reader_that_closes_early_is_no_error() {
    let place = Workplace::with_step();
    for arguments in [
        &["cull", "start.obj", "end.obj", "--pairs", "out.csv"][..],
        &["compare", "start.obj", "end.obj", "--json"],
        &["--help"],
    ] {
        let mut child = place
            .command(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{message}");
        assert!(!message.contains("panicked"), "{message}");
    }
    assert!(place.read("out.csv").starts_with("kind,"));
}

#[test]
fn no_progress_is_drawn_where_nobody_watches() {
    let notes = &Run::of_main_job().notes;
    assert!(notes.lines().all(|line| line.starts_with("wrote ")), "{notes}");
}

#[test]
fn help_names_every_subcommand_and_the_exit_status() {
    let text = Workplace::new().stdout(&["--help"]);
    for part in [
        "cull",
        "compare",
        "queries",
        "scaling",
        "accuracy",
        "truths",
        "arm",
        "Exit status: 0 done",
    ] {
        assert!(text.contains(part), "{part}");
    }
    for command in ["cull", "compare", "queries", "scaling", "accuracy", "truths", "arm"] {
        let text = Workplace::new().stdout(&[command, "--help"]);
        assert!(text.contains("Example"), "{command}");
        assert!(text.contains(&format!("  selvedge {command} ")), "{command}");
    }
}
