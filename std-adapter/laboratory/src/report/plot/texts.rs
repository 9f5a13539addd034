//! Reads texts of pictures, for tests.

use roxmltree::{Document, Node};

/// Returns all texts of an SVG document, in order.
pub(super) fn texts(svg: &str) -> Vec<String> {
    placed_texts(svg).into_iter().map(|(_, text)| text).collect()
}

/// Returns all texts with their places in their panels.
pub(super) fn placed_texts(svg: &str) -> Vec<([f64; 2], String)> {
    let document = Document::parse(svg).unwrap();
    let number = |node: &Node<'_, '_>, name: &str| node.attribute(name).unwrap().parse().unwrap();
    let texts = document.descendants().filter(|node| node.has_tag_name("text"));
    texts
        .map(|node| {
            let place = ["x", "y"].map(|name| number(&node, name));
            (place, node.text().unwrap_or_default().to_owned())
        })
        .collect()
}
