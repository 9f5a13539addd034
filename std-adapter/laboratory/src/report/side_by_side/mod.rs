//! Compares two simulations on one page, which needs no scripts.
//!
//! The page has pictures of both at the same times from the same place, and the differences of their scenes. Numbers have ratios;
//! charts show energy, stretch and loads.

mod chart;
mod rows;
#[cfg(test)]
mod tests;

use super::number::moment;
use super::page::document;
use super::recording::Recording;
use super::still::{self, StillError};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{Markup, html};

const PICTURE: [u32; 2] = [640, 400];
/// The times of the pictures, relative to the shorter simulation's duration.
const TIMES: [f64; 3] = [1.0 / 3.0, 2.0 / 3.0, 1.0];

/// Returns the whole page. The first simulation is on the left, and has solid lines; the second has dashed ones.
///
/// # Errors
/// Returns an error if a picture cannot be written as PNG.
pub fn html(first: &Recording, second: &Recording) -> Result<String, StillError> {
    let both = [first, second];
    let names = names(both);
    let body = html! {
        header {
            p.kicker { "selvedge simulate --against" }
            h1 { (names[0]) " beside " (names[1]) }
            p.lead { "Both ran one after the other on the same machine." }
        }
        main {
            @for (recording, name) in both.into_iter().zip(&names) {
                @for remark in &recording.remarks { p.remark role="note" { (name) ": " (remark) } }
            }
            (pictures(both, &names)?)
            section {
                h2 { "Numbers" }
                (rows::table(&names, &rows::figures(both)))
            }
            (chart::sections(both, &names))
            @let different = rows::different_settings(both);
            @if !different.is_empty() {
                section {
                    h2 { "Settings that differ" }
                    (rows::table(&names, &different))
                }
            }
            (scenes(both, &names))
        }
        footer { p { "Written by selvedge " (env!("CARGO_PKG_VERSION")) ". This file is self-contained: it loads nothing." } }
    };
    Ok(document(&format!("{} beside {}", names[0], names[1]), &body))
}

/// Returns the scenes' names, made different if they are equal.
fn names([first, second]: [&Recording; 2]) -> [String; 2] {
    let [one, other] = [first, second].map(|recording| recording.about.name.clone());
    if one == other {
        [format!("{one} (first)"), format!("{other} (second)")]
    } else {
        [one, other]
    }
}

fn pictures(both: [&Recording; 2], names: &[String; 2]) -> Result<Markup, StillError> {
    let end = |recording: &Recording| recording.frames.last().map_or(0.0, |last| recording.time(last));
    let shorter = end(both[0]).min(end(both[1]));
    let mut pictures = Vec::new();
    for share in TIMES {
        for (recording, name) in both.into_iter().zip(names) {
            let frame = recording.frame_at(share * shorter);
            let png = still::png_among(recording, frame, PICTURE, &both)?;
            let when = moment(recording.time(&recording.frames[frame]));
            pictures.push((
                format!("{name}, {when}"),
                format!("data:image/png;base64,{}", STANDARD.encode(png)),
            ));
        }
    }
    Ok(html! {
        section.pairs {
            @for (caption, picture) in &pictures {
                figure { img src=(picture) alt=(caption) width=(PICTURE[0]) height=(PICTURE[1]); figcaption { (caption) } }
            }
        }
    })
}

/// Returns both scene files, and marks the lines that the other lacks.
fn scenes(both: [&Recording; 2], names: &[String; 2]) -> Markup {
    let [first, second] = both.map(|recording| recording.about.scene.lines().collect::<Vec<_>>());
    let columns = [(&names[0], &first, &second), (&names[1], &second, &first)];
    html! {
        @if !first.is_empty() && !second.is_empty() {
            section {
                h2 { "Scenes" }
                div.pairs {
                    @for (name, own, other) in columns {
                        pre tabindex="0" aria-label=(name) { code {
                            @for line in own {
                                @if other.contains(line) { (line) } @else { mark { (line) } }
                                "\n"
                            }
                        } }
                    }
                }
            }
        }
    }
}
