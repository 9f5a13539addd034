//! A scene that starts with surfaces passing through each other, and was not run: every place, as a list and as a picture.

use super::number::{counted, few, grouped, time};
use super::page::document;
use super::printable;
use maud::{Markup, html};
use selvedge::glam::DVec3;
use selvedge_cloth::{Crossing, Simulation, Tangled, Untangled};
use serde_json::{Value, json};
use std::fmt::Write;

/// Rows of the page's table; JSON has all.
const MOST_ROWS: usize = 500;
/// Vertices in a picture, evenly taken from all.
const MOST_DOTS: usize = 20_000;
/// Of a picture, in its own unit.
const WIDTH: f64 = 480.0;

/// One document: `selvedge simulate --json` of a scene that starts tangled. Vertices count from 0, the cloth's first, then the bodies'.
#[must_use]
pub fn tangled_start_json(scene: &str, tangled: &Tangled) -> Value {
    let crossing = |crossing: &Crossing| {
        json!({
            "edge": crossing.edge,
            "face": crossing.face,
            "point": crossing.point.to_array(),
            "body": body(tangled, crossing),
        })
    };
    json!({
        "scene": scene,
        "tangled_start": {
            "message": tangled.to_string(),
            "crossings": tangled.crossings.iter().map(crossing).collect::<Vec<_>>(),
            "untangled": tangled.untangled.as_ref().map(untangled_json),
        },
    })
}

/// What untangling did. Lengths are in m, stretch is over lengths in the scene.
pub(super) fn untangled_json(untangled: &Untangled) -> Value {
    json!({
        "crossings": untangled.crossings,
        "left": untangled.left,
        "steps": untangled.steps,
        "edge_stretch": {"percentile_99": untangled.stretch.percentile_99, "largest": untangled.stretch.largest},
        "farthest": untangled.farthest,
        "seconds": untangled.seconds,
    })
}

/// What became of a tangled start, if the simulation's was: that it was untangled, or that it still is tangled.
#[must_use]
pub fn start_sentences(simulation: &Simulation) -> Vec<String> {
    let left = simulation.crossings().len();
    let left = (left > 0).then(|| format!("Edges still pass through faces at {}.", counted(left as u64, "place")));
    simulation
        .untangled()
        .map(untangled_sentence)
        .into_iter()
        .chain(left)
        .collect()
}

fn untangled_sentence(untangled: &Untangled) -> String {
    format!(
        "Untangled before the first step: edges met faces at {}, and were pulled apart in {} and {}, by {} mm at most; 99 % of the edges are \
         then at most {:.3} times as long as in the scene, the longest {:.3}.",
        counted(untangled.crossings as u64, "place"),
        counted(u64::from(untangled.steps), "step"),
        time(untangled.seconds),
        few(1e3 * untangled.farthest),
        untangled.stretch.percentile_99,
        untangled.stretch.largest,
    )
}

/// A page that needs nothing else: what is wrong, what to do, where it is from three sides, and a table.
#[must_use]
pub fn tangled_start_html(scene: &str, tangled: &Tangled) -> String {
    let all = tangled.crossings.len();
    let point = |crossing: &Crossing| crossing.point.to_array().map(|x| format!("{x:.4}"));
    let body = html! {
        header {
            p.kicker { "selvedge simulate" }
            h1 { (printable(scene)) }
            p.lead { "This scene starts tangled, and was not run." }
        }
        main {
            p.remark role="note" { (tangled.to_string()) }
            section {
                h2 { "Where" }
                p { "The cloth's vertices in grey, in red where an edge meets a face." }
                div.pairs {
                    @for (name, axes) in [("along z", [0, 1]), ("along y", [0, 2]), ("along x", [1, 2])] {
                        figure { (picture(tangled, axes)) figcaption { (name) } }
                    }
                }
            }
            section {
                h2 { "All places" }
                @if all > MOST_ROWS { p { "The first " (grouped(MOST_ROWS)) " of " (grouped(all)) "; all are in the JSON." } }
                table {
                    thead { tr { th scope="col" { "edge" } th scope="col" { "face" } th scope="col" { "with" }
                        @for axis in ["x, m", "y, m", "z, m"] { th scope="col" { (axis) } } } }
                    tbody {
                        @for crossing in tangled.crossings.iter().take(MOST_ROWS) {
                            tr {
                                th scope="row" { (numbers(&crossing.edge)) }
                                td { (numbers(&crossing.face)) }
                                td { (body(tangled, crossing).map_or_else(|| "itself".to_owned(), printable)) }
                                @for x in point(crossing) { td { (x) } }
                            }
                        }
                    }
                }
            }
        }
        footer { p { "Written by selvedge " (env!("CARGO_PKG_VERSION")) ". This file is complete in itself: it loads nothing." } }
    };
    document(&printable(scene), &body)
}

/// The name of the body that it is with.
fn body<'a>(tangled: &'a Tangled, crossing: &Crossing) -> Option<&'a str> {
    let body = tangled.body_names.get(crossing.body?)?;
    Some(body)
}

fn numbers(vertices: &[u32]) -> String {
    let all: Vec<_> = vertices.iter().map(u32::to_string).collect();
    all.join(", ")
}

/// The cloth along an axis, the other two to the right and up.
fn picture(tangled: &Tangled, [right, up]: [usize; 2]) -> Markup {
    let cloth = tangled
        .mesh
        .triangles
        .iter()
        .flatten()
        .copied()
        .take(3 * tangled.cloth_triangles)
        .max();
    let cloth = &tangled.mesh.positions[..cloth.map_or(0, |last| last as usize + 1)];
    let flat = |point: &DVec3| [point[right], -point[up]];
    let points = || {
        cloth
            .iter()
            .map(flat)
            .chain(tangled.crossings.iter().map(|crossing| flat(&crossing.point)))
    };
    let least = |axis: usize| points().map(|point| point[axis]).fold(f64::INFINITY, f64::min);
    let most = |axis: usize| points().map(|point| point[axis]).fold(f64::NEG_INFINITY, f64::max);
    let corner = [least(0), least(1)];
    let sides = [most(0) - corner[0], most(1) - corner[1]];
    let scale = WIDTH / sides[0].max(sides[1]).max(f64::MIN_POSITIVE);
    let dots = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        points.fold(String::new(), |mut path, [x, y]| {
            let [x, y] = [(x - corner[0]) * scale, (y - corner[1]) * scale];
            // Writing to a text cannot fail.
            let _ = write!(path, "M{x:.1} {y:.1}h0");
            path
        })
    };
    let stride = cloth.len().div_ceil(MOST_DOTS).max(1);
    let view = format!("-6 -6 {:.0} {:.0}", sides[0] * scale + 12.0, sides[1] * scale + 12.0);
    html! {
        svg viewBox=(view) role="img" aria-label="where edges meet faces" fill="none" stroke-linecap="round" {
            path stroke="currentColor" stroke-opacity="0.35" stroke-width="2" d=(dots(&mut cloth.iter().step_by(stride).map(flat))) {}
            path stroke="#d62728" stroke-width="6" d=(dots(&mut tangled.crossings.iter().map(|crossing| flat(&crossing.point)))) {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use selvedge_cloth::effects::{SelfCollision, Thickness};
    use selvedge_cloth::{Cloth, Mesh, Scene, SetupError};

    /// A triangle through which another one goes.
    fn tangled() -> Tangled {
        let positions = [
            [0.0, 0.0, 0.0],
            [0.3, 0.0, 0.0],
            [0.0, 0.3, 0.0],
            [0.1, 0.1, -0.1],
            [0.1, 0.1, 0.1],
            [0.5, 0.5, 0.0],
        ];
        let mesh = Mesh {
            positions: positions.map(DVec3::from).to_vec(),
            triangles: vec![[0, 1, 2], [3, 4, 5]],
        };
        let mut scene = Scene::new(Cloth::from_mesh(mesh, DVec3::X, 0.1).unwrap(), 1e-3);
        scene.add(SelfCollision(Thickness::new(1e-3)));
        match Simulation::new(scene, 1) {
            Err(SetupError::Tangled(tangled)) => *tangled,
            other => panic!("{:?}", other.err()),
        }
    }

    #[test]
    fn every_place_is_in_the_list_and_on_the_page() {
        let tangled = tangled();
        assert!(!tangled.crossings.is_empty());
        let document = tangled_start_json("two <triangles>", &tangled);
        let listed = document["tangled_start"]["crossings"].as_array().unwrap();
        assert_eq!(listed.len(), tangled.crossings.len());
        let through = listed.iter().find(|place| place["edge"] == json!([3, 4])).unwrap();
        assert_eq!(through["face"], json!([0, 1, 2]));
        assert_eq!(through["point"], json!([0.1, 0.1, 0.0]));
        assert!(through["body"].is_null() && document["tangled_start"]["untangled"].is_null());
        let page = tangled_start_html("two <triangles>", &tangled);
        assert!(page.contains("two &lt;triangles&gt;") && page.contains("3, 4") && page.contains("tangled_start = "));
        assert_eq!(page.matches("<svg").count(), 3);
        assert_eq!(page.matches("<tr>").count(), 1 + tangled.crossings.len());
    }
}
