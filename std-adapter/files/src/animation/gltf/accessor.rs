//! Reads numbers from bytes, and checks every range.

use super::{File, wrong};
use crate::problem::AnimationProblem;
use gltf::accessor::{Accessor, DataType, Dimensions};
use gltf::buffer::View;
use selvedge_core::glam::DVec3;

impl<'a> File<'a> {
    pub(super) fn vectors(
        &self,
        accessor: &Accessor<'a>,
        count: Option<usize>,
        what: &str,
    ) -> Result<Vec<DVec3>, AnimationProblem> {
        let numbers = self.numbers(accessor, Dimensions::Vec3, count, what)?;
        Ok(numbers.chunks_exact(3).map(DVec3::from_slice).collect())
    }

    /// Returns all numbers of an accessor. It must have these dimensions, and `count` elements if that is known.
    pub(super) fn numbers(
        &self,
        accessor: &Accessor<'a>,
        dimensions: Dimensions,
        count: Option<usize>,
        what: &str,
    ) -> Result<Vec<f64>, AnimationProblem> {
        let wrong = |reason: String| wrong(what, reason);
        if accessor.dimensions() != dimensions {
            return Err(wrong(format!(
                "are of type {:?}, but must be of {dimensions:?}",
                accessor.dimensions()
            )));
        }
        if let Some(count) = count.filter(|&count| count != accessor.count()) {
            return Err(wrong(format!("there are {}, but must be {count}", accessor.count())));
        }
        let (data, width) = (accessor.data_type(), dimensions.multiplicity());
        let mut numbers = match accessor.view() {
            Some(view) => {
                let run = self.run(&view, accessor.offset(), view.stride(), accessor.size(), accessor.count());
                read(run.map_err(wrong)?, accessor.count(), data, width)
            }
            // Zeros have no bytes: their number is limited by that of another accessor, or by the size of the whole file.
            None if count.is_some() || accessor.count() <= self.buffers.iter().map(Vec::len).sum() => {
                vec![0.0; accessor.count() * width]
            }
            None => return Err(wrong(format!("are {} zeros, more than the file has bytes", accessor.count()))),
        };
        if let Some(sparse) = accessor.sparse() {
            let (indices, values) = (sparse.indices(), sparse.values());
            let index = match indices.index_type() {
                gltf::accessor::sparse::IndexType::U8 => DataType::U8,
                gltf::accessor::sparse::IndexType::U16 => DataType::U16,
                gltf::accessor::sparse::IndexType::U32 => DataType::U32,
            };
            let (places, count) = (indices.view(), sparse.count());
            let run = self.run(&places, indices.offset(), None, index.size(), count);
            let places = read(run.map_err(wrong)?, count, index, 1);
            let run = self.run(&values.view(), values.offset(), None, accessor.size(), count);
            let values = read(run.map_err(wrong)?, count, data, width);
            for (place, values) in places.into_iter().zip(values.chunks_exact(width)) {
                let own = numbers.get_mut(place as usize * width..(place as usize + 1) * width);
                let own = own.ok_or_else(|| wrong(format!("number {place} is replaced, but there is none")))?;
                own.copy_from_slice(values);
            }
        }
        if accessor.normalized() {
            let largest = match data {
                DataType::I8 => 127.0,
                DataType::U8 => 255.0,
                DataType::I16 => 32767.0,
                DataType::U16 => 65535.0,
                DataType::U32 | DataType::F32 => 1.0,
            };
            numbers.iter_mut().for_each(|number| *number = (*number / largest).max(-1.0));
        }
        match numbers.iter().position(|number| !number.is_finite()) {
            None => Ok(numbers),
            Some(index) => Err(wrong(format!(
                "number {} is {}, but must be finite",
                index / width,
                numbers[index]
            ))),
        }
    }

    /// Returns the bytes of a view from an offset on, with the distance between elements, if all its elements are there.
    fn run(&self, view: &View<'a>, offset: usize, stride: Option<usize>, size: usize, count: usize) -> Result<Run<'_>, String> {
        let stride = stride.unwrap_or(size);
        let buffer = &self.buffers[view.buffer().index()];
        let end = view.offset().checked_add(view.length());
        let bytes = end.and_then(|end| buffer.get(view.offset()..end));
        let needed = count
            .checked_sub(1)
            .map_or(Some(0), |last| last.checked_mul(stride)?.checked_add(size));
        let bytes = bytes
            .and_then(|bytes| bytes.get(offset..))
            .filter(|bytes| needed.is_some_and(|needed| needed <= bytes.len()));
        match bytes {
            Some(bytes) if stride >= size => Ok(Run { bytes, stride }),
            _ => Err(format!(
                "are to be {count}, more than the bytes hold that the file gives them; is it complete?"
            )),
        }
    }
}

/// The bytes of elements, and the distance from one to the next.
#[derive(Clone, Copy)]
struct Run<'a> {
    bytes: &'a [u8],
    stride: usize,
}

fn read(run: Run<'_>, count: usize, data: DataType, width: usize) -> Vec<f64> {
    let size = data.size();
    let mut numbers = Vec::with_capacity(count * width);
    for element in 0..count {
        let element = &run.bytes[element * run.stride..][..width * size];
        numbers.extend(element.chunks_exact(size).map(|bytes| match (data, bytes) {
            (DataType::I8, &[a]) => f64::from(a.cast_signed()),
            (DataType::U8, &[a]) => f64::from(a),
            (DataType::I16, &[a, b]) => f64::from(i16::from_le_bytes([a, b])),
            (DataType::U16, &[a, b]) => f64::from(u16::from_le_bytes([a, b])),
            (DataType::U32, &[a, b, c, d]) => f64::from(u32::from_le_bytes([a, b, c, d])),
            (DataType::F32, &[a, b, c, d]) => f64::from(f32::from_le_bytes([a, b, c, d])),
            // Chunks have the type's size.
            _ => f64::NAN,
        }));
    }
    numbers
}
