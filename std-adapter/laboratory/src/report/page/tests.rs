use super::*;
use crate::report::number::ABSENT;
use crate::report::{About, Knob, MeasureKind, RecordedPart, Recorder};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use proptest::prelude::*;
use scraper::{Html, Selector};
use selvedge_core::glam::DVec3;
use serde_json::Value;

/// Parses a page as a browser does; its markup must have no error.
fn parsed(html: &str) -> Html {
    let page = Html::parse_document(html);
    assert!(page.errors.is_empty(), "{:?}", page.errors);
    page
}

fn all<'a>(page: &'a Html, selector: &str) -> Vec<scraper::ElementRef<'a>> {
    page.select(&Selector::parse(selector).unwrap()).collect()
}

fn text(page: &Html, selector: &str) -> String {
    let found = all(page, selector);
    assert_eq!(found.len(), 1, "{selector}");
    found[0].text().collect()
}

fn numbers<const N: usize, T>(page: &Html, block: &str, from: fn([u8; N]) -> T) -> Vec<T> {
    let bytes = STANDARD.decode(text(page, &format!("script#{block}"))).unwrap();
    assert_eq!(bytes.len() % N, 0);
    bytes.chunks(N).map(|chunk| from(chunk.try_into().unwrap())).collect()
}

fn recording(frames: &[Vec<DVec3>], series: &[(&str, SeriesKind)]) -> Recording {
    let about = About {
        name: "a <scene> & \"more\"".to_owned(),
        scene: "# </script><b>\nlimit = 3 & 4\n".to_owned(),
        knobs: vec![Knob::new("time step", "1 ms")],
        ..About::test("", DVec3::Y, 0.001)
    };
    let vertices = frames[0].len();
    let parts = vec![
        RecordedPart::new("cloth", PartKind::Cloth, vertices - 3, vec![[0, 1, 2]]),
        RecordedPart::new("</script>", PartKind::Body, 3, vec![[2, 1, 0]]),
    ];
    let readings = vec![0.0; series.len()];
    let mut recorder = Recorder::new(about, parts, series, &readings);
    recorder.frame(0, &frames[0]).unwrap();
    for (index, frame) in frames.iter().enumerate().skip(1) {
        let reading = |(k, _)| (index * (k + 1)) as f64;
        recorder.step(&series.iter().enumerate().map(reading).collect::<Vec<_>>());
        recorder.frame(index as u64, frame).unwrap();
    }
    recorder.finish(Some(0.5))
}

const EVERY_KIND: [(&str, SeriesKind); 6] = [
    ("boxes <1>", SeriesKind::Pairs),
    ("filter", SeriesKind::Pairs),
    ("held", SeriesKind::Events),
    ("gravity", SeriesKind::Effect),
    ("certificates", SeriesKind::Stage),
    ("strain", SeriesKind::Gauge("%")),
];

fn two_frames() -> [Vec<DVec3>; 2] {
    let start: Vec<DVec3> = (0..7).map(|i| DVec3::new(f64::from(i), 1.0, -2.0)).collect();
    let end = start.iter().map(|p| *p * 1.5).collect();
    [start, end]
}

fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![-1.0..1.0, -1e4..1e4, Just(0.0), -1e-30..1e-30]
}

proptest! {
    #[test]
    fn positions_decode_to_what_was_recorded_within_half_a_quantum(
        frames in prop::collection::vec(prop::collection::vec(prop::array::uniform3(coordinate()), 7), 1..5)
    ) {
        let frames: Vec<Vec<DVec3>> = frames.into_iter().map(|f| f.into_iter().map(DVec3::from).collect()).collect();
        let recording = recording(&frames, &EVERY_KIND);
        let blocks = data::blocks(&recording).into_string();
        let page = parsed(&format!("<!DOCTYPE html>{blocks}"));
        let bounds = numbers(&page, "bounds", f32::from_le_bytes);
        let positions = numbers(&page, "positions", u16::from_le_bytes);
        prop_assert_eq!(bounds.len(), 6 * frames.len());
        prop_assert_eq!(positions.len(), 21 * frames.len());
        for (k, frame) in recording.frames.iter().enumerate() {
            for (vertex, position) in frame.positions.iter().enumerate() {
                for axis in 0..3 {
                    let [least, extent] = [bounds[6 * k + axis], bounds[6 * k + 3 + axis]].map(f64::from);
                    let share = f64::from(positions[21 * k + 3 * vertex + axis]) / 65535.0;
                    let decoded = least + share * extent;
                    // The extent is an f32, rounded by a 2²⁴th at most, or by the spacing of numbers below all normal ones.
                    let allowed = extent * (0.5 / 65535.0 + 0.5_f64.powi(23)) + 2e-45;
                    prop_assert!((decoded - f64::from(position[axis])).abs() <= allowed);
                }
            }
        }
    }
}

#[test]
fn values_triangles_and_header_decode_to_what_was_recorded() {
    let recording = recording(&two_frames(), &EVERY_KIND);
    let page = parsed(&html(&recording));
    let values = numbers(&page, "values", f32::from_le_bytes);
    let recorded: Vec<f32> = recording.series.iter().flat_map(|series| series.values.clone()).collect();
    assert_eq!(values, recorded);
    assert_eq!(numbers(&page, "triangles", u32::from_le_bytes), [0, 1, 2, 6, 5, 4]);
    let header: Value = serde_json::from_str(&text(&page, "script#recording")).unwrap();
    assert_eq!(header["frameSteps"], serde_json::json!([0, 1]));
    assert_eq!(header["parts"][1]["name"], "</script>");
    assert_eq!(header["parts"][1]["firstVertex"], 4);
    assert_eq!(header["series"][0]["name"], "boxes <1>");
    assert_eq!(header["series"][5]["unit"], "%");
    assert_eq!(header["up"], serde_json::json!([0.0, 1.0, 0.0]));
    assert_eq!((&header["steps"], &header["vertices"]), (&1.into(), &7.into()));
}

#[test]
fn names_and_the_scene_are_shown_as_they_are() {
    let mut recording = recording(&two_frames(), &EVERY_KIND);
    recording.remarks.push("blocked <here>".to_owned());
    let page = parsed(&html(&recording));
    assert_eq!(text(&page, "h1"), recording.about.name);
    assert_eq!(text(&page, "pre"), recording.about.scene);
    assert_eq!(text(&page, ".remark"), "blocked <here>");
    assert_eq!(text(&page, ".knobs tbody"), "time step1 ms");
    let names: Vec<String> = all(&page, "tbody th[scope=row]")
        .iter()
        .map(|cell| cell.text().collect())
        .collect();
    for series in &recording.series {
        assert!(names.contains(&series.name), "{}", series.name);
    }
}

#[test]
fn an_effect_that_acts_in_the_solve_alone_has_no_time() {
    let effects = ["gravity", "friction"].map(|name| (name, SeriesKind::Effect));
    let mut recording = recording(&two_frames(), &effects);
    (recording.series[1].total, recording.series[1].largest) = (0.0, 0.0);
    let page = parsed(&html(&recording));
    let rows = all(&page, "section tbody tr");
    let row = |name: &str| {
        let mut texts = rows.iter().map(|row| row.text().collect::<String>());
        texts.find(|text| text.starts_with(name)).unwrap()
    };
    assert_eq!(row("friction"), format!("friction{}", ABSENT.repeat(4)));
    assert!(!row("gravity").contains(ABSENT), "{}", row("gravity"));
    assert!(text(&page, "p.note").starts_with("An effect without a time"));
}

#[test]
fn what_is_not_recorded_is_not_on_the_page() {
    let sections = |series: &[(&str, SeriesKind)]| {
        let page = parsed(&html(&recording(&two_frames(), series)));
        let charts = all(&page, ".chart");
        let kinds = charts.iter().map(|chart| chart.value().attr("data-kind").unwrap().to_owned());
        (kinds.collect::<Vec<_>>(), all(&page, "table").len())
    };
    // The table of settings is always there.
    assert_eq!(sections(&[]), (vec![], 1));
    assert_eq!(sections(&EVERY_KIND[3..4]), (vec!["effect".to_owned()], 2));
    let every = ["pairs", "events", "effect", "stage", "gauge"].map(str::to_owned);
    assert_eq!(sections(&EVERY_KIND), (every.to_vec(), 5));

    let without_steps = recording(&two_frames()[..1], &EVERY_KIND);
    assert!(all(&parsed(&html(&without_steps)), ".chart").is_empty());
}

/// Checks every place where a page can name something outside itself.
#[test]
fn the_page_asks_for_nothing_from_outside() {
    let html = html(&recording(&two_frames(), &EVERY_KIND));
    let page = parsed(&html);
    for attribute in ["src", "href", "srcset", "action", "poster", "data"] {
        for element in all(&page, &format!("[{attribute}]")) {
            let value = element.value().attr(attribute).unwrap();
            assert!(value.starts_with("data:"), "{attribute} is {value}");
        }
    }
    // The only name with a protocol is that of a namespace, which nothing fetches.
    let known = "\"http://www.w3.org/2000/svg\"";
    assert_eq!(html.matches("://").count(), html.matches(known).count());
    for word in ["fetch(", "XMLHttpRequest", "import(", "@import", "WebSocket", "url(//"] {
        assert!(!html.contains(word), "{word}");
    }
}

#[test]
fn the_same_recording_gives_the_same_bytes() {
    let recording = recording(&two_frames(), &EVERY_KIND);
    assert_eq!(html(&recording), html(&recording.clone()));
}

#[test]
fn measures_at_frames_have_charts_and_rows_and_weight_counts_from_its_least() {
    let mut recording = recording(&two_frames(), &EVERY_KIND);
    let measures = [
        ("kinetic", MeasureKind::Energy, [0.0, 2.0]),
        ("gravitational", MeasureKind::Energy, [-5.0, -9.0]),
        ("self_collision", MeasureKind::EffectEnergy, [0.0, 3.0]),
        ("longest edge", MeasureKind::Stretch, [1.25, 1.0]),
        ("ball", MeasureKind::Load, [0.0, 6.0]),
    ];
    recording.measured_steps = vec![0, 1];
    recording.measures = { measures.into_iter() }
        .map(|(name, kind, values)| Measure {
            name: name.to_owned(),
            kind,
            values: values.to_vec(),
            largest: values[0].max(values[1]),
            largest_step: u64::from(values[1] > values[0]),
        })
        .collect();
    let page = parsed(&html(&recording));
    let kinds = all(&page, ".chart")
        .into_iter()
        .map(|chart| chart.value().attr("data-kind").unwrap().to_owned());
    let kinds: Vec<String> = kinds.collect();
    assert_eq!(kinds[..4], ["energy", "effect-energy", "stretch", "load"]);
    assert_eq!(
        numbers(&page, "measured", f32::from_le_bytes),
        [0.0, 2.0, 4.0, 0.0, 0.0, 3.0, 1.25, 1.0, 0.0, 6.0]
    );
    let header: Value = serde_json::from_str(&text(&page, "script#recording")).unwrap();
    assert_eq!(header["measures"][1]["kind"], "energy");
    assert_eq!(header["measures"][2]["label"], "self-collision");
    let rows: Vec<String> = all(&page, "tbody tr").iter().map(|row| row.text().collect()).collect();
    assert!(rows.contains(&"gravitational440".to_owned()), "{rows:?}");
    assert!(rows.contains(&"longest edge11.250 s".to_owned()), "{rows:?}");
    assert!(rows.contains(&"ball066".to_owned()), "{rows:?}");
}
