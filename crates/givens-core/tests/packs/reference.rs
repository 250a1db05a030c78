//! The values that `reference.py` has computed in 60 digits.

/// f(x, y) = hi + lo.
pub struct Point {
    pub x: f64,
    pub y: f64,
    pub hi: f64,
    pub lo: f64,
}

/// The points of a function: rows of `name,x,y,hi,lo`, the numbers as patterns of bits.
pub fn points(function: &str) -> Vec<Point> {
    let number = |field: &str| f64::from_bits(u64::from_str_radix(field, 16).unwrap());
    let rows =
        include_str!("reference.csv").lines().filter_map(|row| row.strip_prefix(function)?.strip_prefix(','));
    rows.map(|row| {
        let mut fields = row.split(',').map(number);
        let mut next = || fields.next().unwrap();
        Point { x: next(), y: next(), hi: next(), lo: next() }
    })
    .collect()
}
