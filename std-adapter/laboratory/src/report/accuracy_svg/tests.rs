use super::*;
use crate::study::{AccuracyOptions, AccuracyRow, BackendTime, MeasuredFilter};
use roxmltree::{Document, Node};

/// A set of 100,000 pairs of which 90,000 can be culled; every filter takes 3 ns in lanes and keeps `kept` of them.
fn set(scalar: &'static str, cullable: usize, kept: usize) -> AccuracySet {
    let rows = MeasuredFilter::ALL.map(|filter| AccuracyRow {
        filter,
        culled: cullable - kept,
        kept_cullable: kept,
        culled_beyond_exact: if filter.decides_by_whole_step() && filter.is_certified() {
            0
        } else {
            1234
        },
        times: [("one", 8.0), ("avx2", 3.0)]
            .map(|(backend, nanoseconds)| BackendTime { backend, nanoseconds })
            .to_vec(),
        in_first_cache: None,
    });
    AccuracySet {
        name: "some pairs".to_owned(),
        scalar,
        vertex_face: 40_000,
        edge_edge: 60_000,
        drawn_from: 100_000,
        timed: 50_000,
        cullable,
        rows: rows.to_vec(),
    }
}

fn plot(sets: Vec<AccuracySet>) -> String {
    let options = AccuracyOptions {
        pairs: 100_000,
        repeat: 1,
        seed: 1,
        separation: 0.0,
    };
    accuracy_svg(&Accuracy { options, sets })
}

fn texts<'a>(document: &'a Document<'_>) -> Vec<(f64, f64, &'a str)> {
    let number = |node: &Node<'_, '_>, name: &str| node.attribute(name).unwrap().parse().unwrap();
    let texts = document.descendants().filter(|node| node.has_tag_name("text"));
    texts
        .map(|node| {
            let content = node.text().unwrap_or_default().trim();
            (number(&node, "x"), number(&node, "y"), content)
        })
        .collect()
}

#[test]
fn every_filter_is_named_with_its_time_and_unsafe_ones_with_their_false_culls() {
    let svg = plot(vec![set("f32", 90_000, 9), set("f64", 90_000, 0)]);
    let document = Document::parse(&svg).unwrap();
    let texts = texts(&document);
    for label in [
        "some pairs, f32",
        "some pairs, f64",
        "100,000 pairs, of which exact arithmetic culls 90.0\u{a0}%",
        "permanent: 3.00 ns",
        "permanent, one by one: 8.00 ns",
        "exact: 3.00 ns",
        "subdivided 4: 3.00 ns, +1.2\u{a0}%",
        "as computed: 3.00 ns, 1,234 false",
        "paper: 3.00 ns, 1,234 false",
    ] {
        assert!(texts.iter().any(|text| text.2 == label), "{label}: {texts:?}");
    }
}

#[test]
fn names_never_overlap() {
    let svg = plot(vec![set("f32", 90_000, 9)]);
    let document = Document::parse(&svg).unwrap();
    let mut names: Vec<f64> = texts(&document)
        .into_iter()
        .filter(|text| text.2.contains(".00 ns"))
        .map(|text| text.1)
        .collect();
    names.sort_by(f64::total_cmp);
    // Eleven filters, and the permanent's second time.
    assert_eq!(names.len(), 12);
    for pair in names.windows(2) {
        assert!(pair[1] - pair[0] > 15.0, "{names:?}");
    }
}

#[test]
fn a_set_of_which_nothing_can_be_culled_says_so() {
    let svg = plot(vec![set("f32", 0, 0)]);
    assert!(svg.contains("exact arithmetic culls none of them"));
    assert!(!svg.contains("NaN"));
}

#[test]
fn a_plot_of_nothing_is_a_picture() {
    assert!(Document::parse(&plot(Vec::new())).is_ok());
}
