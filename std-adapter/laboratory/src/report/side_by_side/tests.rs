use super::*;
use crate::report::{About, Knob, MeasureKind, PartKind, RecordedPart, Recorder, SeriesKind};
use scraper::{Html, Selector};
use selvedge_core::glam::DVec3;

fn recording(name: &str, scene: &str, thickness: &str, measures: &[(&str, MeasureKind)]) -> Recording {
    let about = About {
        scene: scene.to_owned(),
        fabric: vec![Knob::new("weight", "150 g/m²")],
        knobs: vec![Knob::new("self-collision: thickness", thickness)],
        ..About::test(name, DVec3::Z, 0.1)
    };
    let series = [("self_collision", SeriesKind::Effect), ("whole step", SeriesKind::Step)];
    let parts = vec![RecordedPart::new("cloth", PartKind::Cloth, 3, vec![[0, 1, 2]])];
    let mut recorder = Recorder::new(about, parts, &series, &[0.0; 2]).with_measures(measures);
    for step in 0..3 {
        if step > 0 {
            recorder.step(&[0.001 * step as f64, 0.004]);
        }
        recorder
            .frame(step, &[DVec3::ZERO, DVec3::X, DVec3::Y + DVec3::Z * step as f64])
            .unwrap();
        recorder.measure(step, &vec![step as f64; measures.len()]);
    }
    recorder.finish(Some(0.01))
}

const ENERGY: (&str, MeasureKind) = ("kinetic", MeasureKind::Energy);

fn parsed(html: &str) -> Html {
    let page = Html::parse_document(html);
    assert!(page.errors.is_empty(), "{:?}", page.errors);
    page
}

fn texts(page: &Html, selector: &str) -> Vec<String> {
    let selector = Selector::parse(selector).unwrap();
    let found = page.select(&selector);
    found.map(|element| element.text().collect()).collect()
}

#[test]
fn pictures_charts_and_figures_of_both_are_on_the_page_and_nothing_is_loaded() {
    let [first, second] = ["<one>", "two"].map(|name| recording(name, "limit = 1\n", "3 mm", &[ENERGY]));
    let page = html(&first, &second).unwrap();
    assert!(!page.contains("<script") && !page.contains("://"));
    let page = parsed(&page);
    assert_eq!(texts(&page, "h1"), ["<one> beside two"]);
    assert_eq!(
        texts(&page, "figcaption"),
        [
            "<one>, 0.1 s",
            "two, 0.1 s",
            "<one>, 0.1 s",
            "two, 0.1 s",
            "<one>, 0.2 s",
            "two, 0.2 s"
        ]
    );
    assert_eq!(texts(&page, "path").len(), 2);
    let rows = texts(&page, "tbody tr");
    assert!(rows.contains(&"self-collision, a step1.00 ms1.00 ms1".to_owned()), "{rows:?}");
    assert!(rows.contains(&"kinetic energy at the end2 J2 J1".to_owned()), "{rows:?}");
}

#[test]
fn only_what_differs_is_marked() {
    let same = "step = 1\n[cloth]\n";
    let first = recording("sheet", &format!("{same}limit = 1.05\n"), "3 mm", &[ENERGY]);
    let second = recording("sheet", &format!("{same}limit = 1.10\n"), "2 mm", &[]);
    let page = parsed(&html(&first, &second).unwrap());
    assert_eq!(texts(&page, "h1"), ["sheet (first) beside sheet (second)"]);
    assert_eq!(texts(&page, "mark"), ["limit = 1.05", "limit = 1.10"]);
    let rows = texts(&page, "tbody tr");
    assert!(rows.contains(&"self-collision: thickness3 mm2 mm".to_owned()), "{rows:?}");
    assert!(!rows.iter().any(|row| row.starts_with("weight")));
    // A dash stands for a value that one of them lacks.
    assert!(rows.contains(&"kinetic energy at the end2 J––".to_owned()), "{rows:?}");
}
