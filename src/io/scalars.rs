//! Binary arrays of numbers: scalar types, byte orders, and columns of either kind of number.

/// The type of the numbers of an array in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    /// Signed integers of 1, 2, 4 or 8 bytes.
    Signed(usize),
    /// Unsigned integers of 1, 2, 4 or 8 bytes.
    Unsigned(usize),
    /// IEEE numbers of 4 or 8 bytes.
    Float(usize),
}

impl Scalar {
    /// Bytes of a number.
    pub fn size(self) -> usize {
        match self {
            Self::Signed(size) | Self::Unsigned(size) | Self::Float(size) => size,
        }
    }

    /// The type with a name of VTK's XML formats, such as `UInt8`.
    pub fn from_xml_name(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"Int8" => Self::Signed(1),
            b"Int16" => Self::Signed(2),
            b"Int32" => Self::Signed(4),
            b"Int64" => Self::Signed(8),
            b"UInt8" => Self::Unsigned(1),
            b"UInt16" => Self::Unsigned(2),
            b"UInt32" => Self::Unsigned(4),
            b"UInt64" => Self::Unsigned(8),
            b"Float32" => Self::Float(4),
            b"Float64" => Self::Float(8),
            _ => return None,
        })
    }

    /// The type with a name of VTK's legacy format, such as `unsigned_char`. `long` has 8 bytes, as
    /// where VTK is built today (Windows apart, whose VTK writes `vtktypeint64`).
    pub fn from_legacy_name(name: &[u8]) -> Option<Self> {
        Some(match name.to_ascii_lowercase().as_slice() {
            b"char" | b"signed_char" | b"vtktypeint8" => Self::Signed(1),
            b"short" | b"vtktypeint16" => Self::Signed(2),
            b"int" | b"vtktypeint32" => Self::Signed(4),
            b"long" | b"vtktypeint64" | b"vtkidtype" => Self::Signed(8),
            b"unsigned_char" | b"vtktypeuint8" => Self::Unsigned(1),
            b"unsigned_short" | b"vtktypeuint16" => Self::Unsigned(2),
            b"unsigned_int" | b"vtktypeuint32" => Self::Unsigned(4),
            b"unsigned_long" | b"vtktypeuint64" => Self::Unsigned(8),
            b"float" => Self::Float(4),
            b"double" => Self::Float(8),
            _ => return None,
        })
    }

    /// The numbers in `bytes`; a part of a number at the end is left out.
    pub fn decode(self, bytes: &[u8], order: ByteOrder) -> Column {
        /// `$from_le`, `$from_be` of each chunk, turned into `$target`.
        macro_rules! numbers {
            ($type:ty as $target:ty) => {
                bytes
                    .chunks_exact(size_of::<$type>())
                    .map(|chunk| {
                        let chunk = chunk.try_into().expect("chunks have the size of the type");
                        (match order {
                            ByteOrder::Little => <$type>::from_le_bytes(chunk),
                            ByteOrder::Big => <$type>::from_be_bytes(chunk),
                        }) as $target
                    })
                    .collect()
            };
        }
        match self {
            Self::Signed(1) => Column::Integers(numbers!(i8 as i64)),
            Self::Signed(2) => Column::Integers(numbers!(i16 as i64)),
            Self::Signed(4) => Column::Integers(numbers!(i32 as i64)),
            Self::Signed(_) => Column::Integers(numbers!(i64 as i64)),
            Self::Unsigned(1) => Column::Integers(numbers!(u8 as i64)),
            Self::Unsigned(2) => Column::Integers(numbers!(u16 as i64)),
            Self::Unsigned(4) => Column::Integers(numbers!(u32 as i64)),
            // Ids and counts beyond 2^63 wrap to negative ones, which every reader refuses.
            Self::Unsigned(_) => Column::Integers(numbers!(u64 as i64)),
            Self::Float(4) => Column::Floats(numbers!(f32 as f64)),
            Self::Float(_) => Column::Floats(numbers!(f64 as f64)),
        }
    }
}

/// The order of the bytes of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ByteOrder {
    /// Least significant byte first.
    Little,
    /// Most significant byte first.
    Big,
}

/// The numbers of an array.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Column {
    /// Whole numbers.
    Integers(Vec<i64>),
    /// Real numbers.
    Floats(Vec<f64>),
}

impl Column {
    /// Number of numbers.
    pub fn len(&self) -> usize {
        match self {
            Self::Integers(values) => values.len(),
            Self::Floats(values) => values.len(),
        }
    }

    /// The numbers as real ones.
    pub fn into_floats(self) -> Vec<f64> {
        match self {
            Self::Integers(values) => values.into_iter().map(|v| v as f64).collect(),
            Self::Floats(values) => values,
        }
    }

    /// The numbers as whole ones, or `None` if one of them is not whole.
    pub fn into_integers(self) -> Option<Vec<i64>> {
        /// Below this, every whole f64 is an i64 and the conversion is exact.
        const LIMIT: f64 = 9.007_199_254_740_992e15;
        match self {
            Self::Integers(values) => Some(values),
            Self::Floats(values) => {
                values.into_iter().map(|v| (v.abs() <= LIMIT && v.trunc() == v).then_some(v as i64)).collect()
            }
        }
    }
}
