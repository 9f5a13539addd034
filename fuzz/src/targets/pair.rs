//! Primitive pairs from bytes. The first byte chooses the kind of pair, the number format and whether NaN and infinities are
//! allowed. The rest goes to the generator of the property tests.

use selvedge::PairKind;
use selvedge_verification::generator::PairCase;

pub(super) enum Numbers {
    Single(PairCase<f32>),
    Double(PairCase<f64>),
}

pub(super) fn numbers(data: &[u8]) -> Numbers {
    let (&first, rest) = data.split_first().unwrap_or((&0, &[]));
    let kind = if first & 1 == 0 {
        PairKind::VertexFace
    } else {
        PairKind::EdgeEdge
    };
    let any = first & 0b111_0000 == 0b111_0000;
    match (first & 2 == 0, any) {
        (true, false) => Numbers::Double(PairCase::from_bytes(kind, rest)),
        (true, true) => Numbers::Double(PairCase::any_from_bytes(kind, rest)),
        (false, false) => Numbers::Single(PairCase::from_bytes(kind, rest)),
        (false, true) => Numbers::Single(PairCase::any_from_bytes(kind, rest)),
    }
}

/// Returns small integers, straight from the bytes: the start and end of four points.
pub(super) fn whole(data: &[u8]) -> [[[i8; 3]; 2]; 4] {
    let mut bytes = data.iter().skip(1).map(|&byte| byte.cast_signed() / 2);
    let mut next = || bytes.next().unwrap_or(0);
    std::array::from_fn(|_| std::array::from_fn(|_| std::array::from_fn(|_| next())))
}
