//! What the columns of a table hold, in the types that NumPy has.

use arrow_array::Array;
use arrow_array::cast::AsArray;
use arrow_array::types::{
    ArrowPrimitiveType, Date32Type, Date64Type, Decimal32Type, Decimal64Type, Decimal128Type,
    DurationMicrosecondType, DurationMillisecondType, DurationNanosecondType, DurationSecondType,
    Float16Type, Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type,
    TimestampMicrosecondType, TimestampMillisecondType, TimestampNanosecondType, TimestampSecondType,
    UInt8Type, UInt16Type, UInt32Type, UInt64Type,
};
use arrow_schema::{DataType, TimeUnit};

/// What a column is to us.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// Numbers, and truth values as 0 and 1.
    Number,
    /// Whole numbers, which may name things.
    Whole,
    /// Whole numbers from 0 up to 2⁶⁴ − 1.
    Unsigned,
    /// Dates since 1970, and whether they are in UTC.
    Date(&'static str, bool),
    /// Durations, in this unit.
    Duration(&'static str),
    /// Words.
    Text,
    /// Nothing that we read.
    Other,
}

fn unit(unit: TimeUnit) -> &'static str {
    match unit {
        TimeUnit::Second => "s",
        TimeUnit::Millisecond => "ms",
        TimeUnit::Microsecond => "us",
        TimeUnit::Nanosecond => "ns",
    }
}

/// What a type is to us.
pub fn kind(of: &DataType) -> Kind {
    use DataType as D;
    match of {
        D::Boolean
        | D::Null
        | D::Float16
        | D::Float32
        | D::Float64
        | D::Decimal32(..)
        | D::Decimal64(..)
        | D::Decimal128(..) => Kind::Number,
        D::Int8 | D::Int16 | D::Int32 | D::Int64 | D::UInt8 | D::UInt16 | D::UInt32 => Kind::Whole,
        D::UInt64 => Kind::Unsigned,
        D::Date32 => Kind::Date("D", false),
        D::Date64 => Kind::Date("ms", false),
        D::Timestamp(of, zone) => Kind::Date(unit(*of), zone.is_some()),
        D::Duration(of) => Kind::Duration(unit(*of)),
        D::Utf8 | D::LargeUtf8 | D::Utf8View => Kind::Text,
        D::Dictionary(_, values) => kind(values),
        _ => Kind::Other,
    }
}

/// The values of primitives, and `null` for what is null.
fn each<T: ArrowPrimitiveType, V: Clone>(array: &dyn Array, null: &V, of: impl Fn(T::Native) -> V) -> Vec<V> {
    array.as_primitive::<T>().iter().map(|value| value.map_or_else(|| null.clone(), &of)).collect()
}

/// The entries that a dictionary's keys call for.
fn gathered<V: Clone>(array: &dyn Array, null: &V, read: impl Fn(&dyn Array) -> Vec<V>) -> Vec<V> {
    let dictionary = array.as_any_dictionary();
    let entries = read(dictionary.values());
    if entries.is_empty() {
        return vec![null.clone(); array.len()];
    }
    let keys = dictionary.normalized_keys();
    let entry = |(k, key): (usize, usize)| if array.is_null(k) { null.clone() } else { entries[key].clone() };
    keys.into_iter().enumerate().map(entry).collect()
}

/// As numbers; what is null is NaN.
pub fn floats(array: &dyn Array) -> Vec<f64> {
    use DataType as D;
    let null = f64::NAN;
    match array.data_type() {
        D::Float16 => each::<Float16Type, _>(array, &null, f64::from),
        D::Float32 => each::<Float32Type, _>(array, &null, f64::from),
        D::Float64 => each::<Float64Type, _>(array, &null, |value| value),
        D::Boolean => array
            .as_boolean()
            .iter()
            .map(|value| value.map_or(null, |yes| f64::from(u8::from(yes))))
            .collect(),
        D::Decimal32(_, scale) => {
            each::<Decimal32Type, _>(array, &null, |value| f64::from(value) / ten(*scale))
        }
        D::Decimal64(_, scale) => each::<Decimal64Type, _>(array, &null, |value| value as f64 / ten(*scale)),
        D::Decimal128(_, scale) => {
            each::<Decimal128Type, _>(array, &null, |value| value as f64 / ten(*scale))
        }
        D::UInt64 => each::<UInt64Type, _>(array, &null, |value| value as f64),
        D::Dictionary(..) => gathered(array, &null, floats),
        D::Int8 | D::Int16 | D::Int32 | D::Int64 | D::UInt8 | D::UInt16 | D::UInt32 => {
            integers(array).into_iter().map(|value| value.map_or(null, |value| value as f64)).collect()
        }
        _ => vec![null; array.len()],
    }
}

fn ten(scale: i8) -> f64 {
    10f64.powi(i32::from(scale))
}

/// Whole numbers, and counts of days and seconds; nothing where there is null.
pub fn integers(array: &dyn Array) -> Vec<Option<i64>> {
    use DataType as D;
    let null = None;
    match array.data_type() {
        D::Int8 => each::<Int8Type, _>(array, &null, |value| Some(value.into())),
        D::Int16 => each::<Int16Type, _>(array, &null, |value| Some(value.into())),
        D::Int32 => each::<Int32Type, _>(array, &null, |value| Some(value.into())),
        D::Int64 => each::<Int64Type, _>(array, &null, Some),
        D::UInt8 => each::<UInt8Type, _>(array, &null, |value| Some(value.into())),
        D::UInt16 => each::<UInt16Type, _>(array, &null, |value| Some(value.into())),
        D::UInt32 => each::<UInt32Type, _>(array, &null, |value| Some(value.into())),
        D::Date32 => each::<Date32Type, _>(array, &null, |value| Some(value.into())),
        D::Date64 => each::<Date64Type, _>(array, &null, Some),
        D::Timestamp(TimeUnit::Second, _) => each::<TimestampSecondType, _>(array, &null, Some),
        D::Timestamp(TimeUnit::Millisecond, _) => each::<TimestampMillisecondType, _>(array, &null, Some),
        D::Timestamp(TimeUnit::Microsecond, _) => each::<TimestampMicrosecondType, _>(array, &null, Some),
        D::Timestamp(TimeUnit::Nanosecond, _) => each::<TimestampNanosecondType, _>(array, &null, Some),
        D::Duration(TimeUnit::Second) => each::<DurationSecondType, _>(array, &null, Some),
        D::Duration(TimeUnit::Millisecond) => each::<DurationMillisecondType, _>(array, &null, Some),
        D::Duration(TimeUnit::Microsecond) => each::<DurationMicrosecondType, _>(array, &null, Some),
        D::Duration(TimeUnit::Nanosecond) => each::<DurationNanosecondType, _>(array, &null, Some),
        D::Dictionary(..) => gathered(array, &null, integers),
        _ => vec![null; array.len()],
    }
}

/// Whole numbers from 0 up, of a column without nulls.
pub fn unsigned(array: &dyn Array) -> Vec<u64> {
    match array.data_type() {
        DataType::UInt64 => each::<UInt64Type, _>(array, &0, |value| value),
        DataType::Dictionary(..) => gathered(array, &0, unsigned),
        _ => vec![0; array.len()],
    }
}

/// Words.
pub fn texts(array: &dyn Array) -> Vec<Option<String>> {
    let own = |word: Option<&str>| word.map(str::to_owned);
    match array.data_type() {
        DataType::Utf8 => array.as_string::<i32>().iter().map(own).collect(),
        DataType::LargeUtf8 => array.as_string::<i64>().iter().map(own).collect(),
        DataType::Utf8View => array.as_string_view().iter().map(own).collect(),
        DataType::Dictionary(..) => gathered(array, &None, texts),
        _ => vec![None; array.len()],
    }
}
