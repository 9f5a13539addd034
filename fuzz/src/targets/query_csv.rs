use super::message;
use rug::{Integer, Rational};
use selvedge::PairKind;
use selvedge::glam::DVec3;
use selvedge_laboratory::queries::{Query, QueryFile, read_from};
use std::fmt::Write;
use std::path::Path;

/// A file of queries is refused with a readable message, or every coordinate is the double nearest to its ratio, and the
/// ratios that are no double are counted; printed as ratios the queries are read back bit for bit.
pub fn query_csv(data: &[u8]) {
    let file = match read(data) {
        Ok(file) => file,
        Err(error) => return message::check(&error),
    };
    let read: Vec<f64> = file.queries.iter().flat_map(coordinates).collect();
    let ratios = ratios(data);
    assert_eq!(read.len(), ratios.len());
    let mut inexact = 0;
    for (&value, ratio) in read.iter().zip(&ratios) {
        assert_nearest(value, ratio);
        inexact += usize::from(Rational::from_f64(value).as_ref() != Some(ratio));
    }
    assert_eq!(file.inexact, inexact);

    let again = read_again(&file);
    assert_eq!(again.inexact, 0);
    assert_eq!(again.queries.len(), file.queries.len());
    for (query, again) in file.queries.iter().zip(&again.queries) {
        assert_eq!(again.collides, query.collides);
        assert!(bits(query).eq(bits(again)), "{query:?} became {again:?}");
    }

    check_single_precision(&file, &read);
}

fn read(data: &[u8]) -> Result<QueryFile, selvedge_laboratory::queries::QueryError> {
    read_from(data, Path::new("fuzz.csv"), PairKind::VertexFace)
}

/// In the order of the file.
fn points(query: &Query) -> impl Iterator<Item = DVec3> {
    let motions = query.pair.motions;
    let start = motions.into_iter().map(|motion| motion.start);
    start.chain(motions.into_iter().map(|motion| motion.end))
}

fn coordinates(query: &Query) -> impl Iterator<Item = f64> {
    points(query).flat_map(|point| point.to_array())
}

fn bits(query: &Query) -> impl Iterator<Item = u64> {
    coordinates(query).map(f64::to_bits)
}

/// The ratios of a file that was accepted.
fn ratios(data: &[u8]) -> Vec<Rational> {
    let text = std::str::from_utf8(data).expect("digits, commas and white space");
    let rows = text.lines().filter(|row| !row.trim().is_empty());
    let integers = rows.flat_map(|row| row.split(',').take(6).map(integer));
    let integers: Vec<Integer> = integers.collect();
    let pairs = integers.chunks_exact(2);
    pairs.map(|pair| Rational::from((pair[0].clone(), pair[1].clone()))).collect()
}

fn integer(field: &str) -> Integer {
    field.trim().parse().expect("an integer was accepted")
}

/// No other double is nearer; of two that are as near, it is the even one.
fn assert_nearest(value: f64, ratio: &Rational) {
    let distance = |x: f64| Rational::from_f64(x).map(|x| Rational::from(&x - ratio).into_numer_denom());
    let distance = |x: f64| {
        let (numerator, denominator) = distance(x)?;
        Some(Rational::from((numerator.abs(), denominator)))
    };
    let own = distance(value).expect("coordinates are finite");
    for neighbour in [value.next_down(), value.next_up()] {
        // An infinite neighbour stands for the double that would come next, which is never nearer than an accepted one.
        if let Some(other) = distance(neighbour) {
            assert!(own <= other, "{value:e} for {ratio}");
            assert!(own < other || value.to_bits() & 1 == 0, "{value:e} is odd");
        }
    }
}

fn read_again(file: &QueryFile) -> QueryFile {
    let mut text = String::new();
    for query in &file.queries {
        for point in points(query) {
            let fields = point.to_array().map(|x| {
                let ratio = Rational::from_f64(x).expect("finite");
                format!("{},{}", ratio.numer(), ratio.denom())
            });
            text += &fields.join(",");
            if let Some(collides) = query.collides {
                write!(text, ",{}", u8::from(collides)).expect("memory");
            }
            text.push('\n');
        }
    }
    read(text.as_bytes()).expect("ratios of doubles")
}

/// Each coordinate is the nearest single, and those that change are counted; or one of them is too large.
fn check_single_precision(file: &QueryFile, read: &[f64]) {
    let overflows = read.iter().any(|&x| (x as f32).is_infinite());
    match file.to_f32() {
        Ok(single) => {
            assert!(!overflows);
            let changed = read.iter().filter(|&&x| f64::from(x as f32) != x).count();
            assert_eq!(single.rounded, changed);
            assert_eq!(single.queries.len(), file.queries.len());
        }
        Err(error) => {
            message::check(&error);
            assert!(overflows, "{error}");
        }
    }
}
