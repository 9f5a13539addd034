//! Writers of random valid files of each text format: all that the format allows, and its readers see in the wild.

use super::random::Numbers;
use selvedge_files::mesh::{FileFormat, PlyEncoding};
use std::fmt::Write;

#[derive(Clone, Copy)]
pub(crate) struct Format {
    pub(crate) format: FileFormat,
    pub(crate) write: fn(&mut Numbers) -> Drawn,
}

pub(crate) const FORMATS: &[Format] = &[
    Format {
        format: FileFormat::Stl,
        write: stl,
    },
    Format {
        format: FileFormat::Off,
        write: off,
    },
    Format {
        format: FileFormat::Obj,
        write: obj,
    },
    Format {
        format: FileFormat::Ply(PlyEncoding::Ascii),
        write: ply,
    },
    #[cfg(feature = "gltf")]
    Format {
        format: FileFormat::Gltf,
        write: gltf,
    },
];

/// What may stand after a word.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum After {
    /// White space on the same line.
    Space,
    /// A line end.
    End,
    /// Any white space.
    Any,
    /// Anything, or nothing.
    Nothing,
}

/// A file as words, and the triangles that it holds.
pub(crate) struct Drawn {
    pub(crate) words: Vec<(String, After)>,
    pub(crate) triangles: Vec<[[f64; 3]; 3]>,
    /// The comments that may stand before a line end.
    comments: bool,
    /// Lines that may stand between others. They belong to no face.
    lines: &'static [&'static str],
    /// A backslash may join lines.
    continues: bool,
}

impl Drawn {
    fn new(comments: bool, lines: &'static [&'static str]) -> Self {
        Self {
            words: Vec::new(),
            triangles: Vec::new(),
            comments,
            lines,
            continues: false,
        }
    }

    fn put(&mut self, word: &str, after: After) {
        self.words.push((word.to_owned(), after));
    }

    /// Adds the words of a line.
    fn line(&mut self, text: &str, end: After) {
        let words: Vec<&str> = text.split(' ').collect();
        for word in &words {
            self.put(word, if end == After::Any { After::Any } else { After::Space });
        }
        if let Some(last) = self.words.last_mut() {
            last.1 = end;
        }
    }

    /// Returns the bytes, with another word before the word of that number.
    pub(crate) fn file(&self, numbers: &mut Numbers, stray: Option<(usize, &str)>) -> Vec<u8> {
        let mut text = String::new();
        let line_end = numbers.pick(&["\n", "\r", "\r\n"]);
        for (index, (word, after)) in self.words.iter().enumerate() {
            if let Some((_, word)) = stray.filter(|&(place, _)| place == index) {
                text += word;
                text += if numbers.coin() { " " } else { line_end };
            }
            text += word;
            let after = match after {
                After::Any if numbers.below(3) > 0 => After::Space,
                After::Any => After::End,
                After::Nothing if numbers.below(3) > 0 => continue,
                After::Nothing => After::End,
                &after => after,
            };
            match after {
                After::Space if self.continues && numbers.below(20) == 0 => text += &format!(" \\{line_end}"),
                After::Space => text += numbers.pick(&[" ", "\t", "   "]),
                _ => {
                    text += numbers.pick(&["", " ", "\t"]);
                    if self.comments && numbers.below(5) == 0 {
                        text += numbers.pick(&["# made by hand", "#x", "# f 1 2 3"]);
                    }
                    text += line_end;
                    while !self.lines.is_empty() && numbers.below(8) == 0 {
                        text += numbers.pick(self.lines);
                        text += line_end;
                    }
                }
            }
        }
        if let Some((_, word)) = stray.filter(|&(place, _)| place == self.words.len()) {
            text += word;
        }
        text.into_bytes()
    }
}

fn coordinate(numbers: &mut Numbers) -> (f64, String) {
    let value = (numbers.below(2_001) as f64 - 1_000.0) / numbers.pick(&[1.0, 8.0, 1_000.0]);
    let text = match numbers.below(4) {
        0 => format!("{value:?}"),
        1 => format!("{value:e}"),
        2 => format!("{value:+}"),
        _ => format!("{value}"),
    };
    (value, text)
}

/// Draws vertices, with their texts, and triangles.
struct Shape {
    positions: Vec<[f64; 3]>,
    texts: Vec<[String; 3]>,
    triangles: Vec<[usize; 3]>,
}

fn shape(numbers: &mut Numbers) -> Shape {
    let mut shape = Shape {
        positions: Vec::new(),
        texts: Vec::new(),
        triangles: Vec::new(),
    };
    for _ in 0..3 + numbers.below(4) {
        let all = [0; 3].map(|_| coordinate(numbers));
        shape.positions.push([all[0].0, all[1].0, all[2].0]);
        shape.texts.push(all.map(|(_, text)| text));
    }
    for _ in 0..1 + numbers.below(4) {
        let first = numbers.below(shape.positions.len() - 2);
        let mut corners = [first, first + 1, first + 2];
        corners.rotate_left(numbers.below(3));
        shape.triangles.push(corners);
    }
    shape
}

impl Shape {
    fn corners(&self) -> Vec<[[f64; 3]; 3]> {
        let corners = |triangle: &[usize; 3]| triangle.map(|vertex| self.positions[vertex]);
        self.triangles.iter().map(corners).collect()
    }
}

fn stl(numbers: &mut Numbers) -> Drawn {
    let mut drawn = Drawn::new(false, &["", "  ", "# made by hand"]);
    for _ in 0..1 + numbers.below(2) {
        let shape = shape(numbers);
        let name = numbers.pick(&["", " part", " a facet of it", " made by hand (1)"]);
        let case = numbers.coin();
        let key = |word: &str| if case { word.to_uppercase() } else { word.to_owned() };
        drawn.line(&format!("{}{name}", key("solid")), After::End);
        if numbers.below(4) == 0 {
            drawn.line(numbers.pick(&["color 0.5 0.5 0.5", "COLOR 1 0 0 1"]), After::End);
        }
        for triangle in &shape.triangles {
            // A name ends before these two words.
            drawn.put(&key("facet"), After::Space);
            drawn.put(&key("normal"), After::Any);
            drawn.line(numbers.pick(&["0 0 1", "nan nan nan", "-1e-3 .5 -nan(ind)"]), After::Any);
            drawn.line(&format!("{} {}", key("outer"), key("loop")), After::Any);
            for &vertex in triangle {
                drawn.line(&format!("{} {}", key("vertex"), shape.texts[vertex].join(" ")), After::Any);
            }
            drawn.line(&format!("{} {}", key("endloop"), key("endfacet")), After::Any);
        }
        let end = numbers.pick(&["", name]);
        // Another solid may follow on the line if the name is repeated.
        let after = if end == name { After::Any } else { After::End };
        for word in format!("{}{end}", key("endsolid")).split(' ') {
            drawn.put(word, After::Space);
        }
        drawn.words.last_mut().unwrap().1 = after;
        drawn.triangles.extend(shape.corners());
    }
    drawn
}

fn off(numbers: &mut Numbers) -> Drawn {
    let shape = shape(numbers);
    let mut drawn = Drawn::new(true, &["", "  ", "# 3 0 1 2"]);
    drawn.triangles = shape.corners();
    let [vertex_lines, face_lines] = [numbers.coin(), numbers.coin()];
    let end = |has_lines: bool| if has_lines { After::End } else { After::Any };
    let (vertices, faces) = (shape.positions.len(), shape.triangles.len());
    let (kind, behind) = match numbers.below(3) {
        0 => ("COFF", " 0.5 0 0 1"),
        1 => ("NOFF", " 0 0 1"),
        _ => ("OFF", if vertex_lines && numbers.coin() { " 255 0 0" } else { "" }),
    };
    let counts = if numbers.coin() && vertex_lines {
        drawn.put(kind, After::Any);
        drawn.line(&format!("{vertices} {faces}"), After::Space);
        After::End
    } else {
        drawn.put(kind, After::Any);
        drawn.line(&format!("{vertices} {faces} 0"), After::Any);
        end(vertex_lines)
    };
    drawn.words.last_mut().unwrap().1 = counts;
    for texts in &shape.texts {
        drawn.line(&format!("{}{behind}", texts.join(" ")), end(vertex_lines));
    }
    // The first face may begin on the line of the last vertex, unless that line may hold more.
    let colour = if face_lines {
        numbers.pick(&["", " 7", " 1 0 0", " 0.5 0 0 1"])
    } else {
        ""
    };
    for [a, b, c] in &shape.triangles {
        drawn.line(&format!("3 {a} {b} {c}{colour}"), end(face_lines));
    }
    if face_lines {
        let first = drawn.words.len() - faces * (4 + colour.split(' ').count() - 1);
        for word in &mut drawn.words[first..] {
            if word.1 == After::Any {
                word.1 = After::Space;
            }
        }
    }
    drawn
}

fn obj(numbers: &mut Numbers) -> Drawn {
    const LINES: [&str; 12] = [
        "",
        "  ",
        "# f 1 2 3",
        "o part",
        "g a b",
        "s off",
        "usemtl f",
        "vn 0 0 1",
        "vt .5 nan",
        "vn 0 0 1 # f 1 2 3",
        "mtllib C:\\a\\",
        "vp 1",
    ];
    let shape = shape(numbers);
    let mut drawn = Drawn::new(true, &LINES);
    drawn.continues = true;
    drawn.triangles = shape.corners();
    let behind = numbers.pick(&["", " 1", " .5 .5 .5", " 1 0 0 nan"]);
    for texts in &shape.texts {
        drawn.line(&format!("v {}{behind}", texts.join(" ")), After::End);
    }
    let count = shape.positions.len();
    for triangle in &shape.triangles {
        let mut line = numbers.pick(&["f", "f", "fo"]).to_owned();
        let behind = numbers.pick(&["", "/1", "/1/2", "//2"]);
        for &vertex in triangle {
            let number = vertex as i64 + 1;
            let number = if numbers.coin() { number } else { number - 1 - count as i64 };
            write!(line, " {number}{behind}").unwrap();
        }
        drawn.line(&line, After::End);
    }
    drawn
}

fn ply(numbers: &mut Numbers) -> Drawn {
    let shape = shape(numbers);
    let mut drawn = Drawn::new(false, &[]);
    drawn.triangles = shape.corners();
    let has_colour = numbers.coin();
    let mut line = |text: &str| drawn.line(text, After::End);
    line("ply");
    line("format ascii 1.0");
    let comments = ["comment f 1 2 3", "obj_info x", "comment"];
    if numbers.coin() {
        line(numbers.pick(&comments));
    }
    line(&format!("element vertex {}", shape.positions.len()));
    for axis in ["x", "y", "z"] {
        if has_colour && axis == "z" {
            line("property uchar red");
        }
        line(&format!("property {} {axis}", numbers.pick(&["double", "float64"])));
    }
    let has_flag = numbers.coin();
    line(&format!("element face {}", shape.triangles.len()));
    if has_flag {
        line("property list uchar float uv");
    }
    line(numbers.pick(&[
        "property list uchar int vertex_indices",
        "property list int uint32 vertex_index",
    ]));
    if numbers.coin() {
        line(numbers.pick(&comments));
    }
    line("end_header");
    for [x, y, z] in &shape.texts {
        let red = if has_colour { " 255" } else { "" };
        line(&format!("{x} {y}{red} {z}"));
    }
    for [a, b, c] in &shape.triangles {
        let uv = if has_flag { "2 0 nan " } else { "" };
        line(&format!("{uv}3 {a} {b} {c}"));
    }
    drawn
}

#[cfg(feature = "gltf")]
fn gltf(numbers: &mut Numbers) -> Drawn {
    use base64::Engine;
    let shape = shape(numbers);
    let mut drawn = Drawn::new(false, &["", "  "]);
    let single = |value: f64| f64::from(value as f32);
    let corners = shape.corners().into_iter();
    drawn.triangles = corners.map(|corners| corners.map(|position| position.map(single))).collect();
    let mut bytes: Vec<u8> = shape
        .positions
        .as_flattened()
        .iter()
        .flat_map(|&value| (value as f32).to_le_bytes())
        .collect();
    let begin = bytes.len();
    bytes.extend(
        shape
            .triangles
            .as_flattened()
            .iter()
            .flat_map(|&vertex| (vertex as u16).to_le_bytes()),
    );
    let (length, corners) = (bytes.len() - begin, 3 * shape.triangles.len());
    let data = base64::engine::general_purpose::STANDARD.encode(&bytes);
    let mut members = [
        r#""asset" : { "version" : "2.0" }"#.to_owned(),
        format!(
            r#""buffers" : [ {{ "byteLength" : {} , "uri" : "data:application/octet-stream;base64,{data}" }} ]"#,
            bytes.len()
        ),
        format!(
            r#""bufferViews" : [ {{ "buffer" : 0 , "byteLength" : {begin} }} , {{ "buffer" : 0 , "byteOffset" : {begin} , "byteLength" : {length} }} ]"#
        ),
        format!(
            r#""accessors" : [ {{ "bufferView" : 0 , "componentType" : 5126 , "count" : {} , "type" : "VEC3" }} , {{ "bufferView" : 1 , "componentType" : 5123 , "count" : {corners} , "type" : "SCALAR" }} ]"#,
            shape.positions.len()
        ),
        r#""meshes" : [ { "primitives" : [ { "attributes" : { "POSITION" : 0 } , "indices" : 1 } ] } ]"#.to_owned(),
        r#""nodes" : [ { "mesh" : 0 } ]"#.to_owned(),
    ];
    let turn = numbers.below(members.len());
    members.rotate_left(turn);
    drawn.line(&format!("{{ {} }}", members.join(" , ")), After::Any);
    for (_, after) in &mut drawn.words {
        *after = After::Nothing;
    }
    drawn
}
