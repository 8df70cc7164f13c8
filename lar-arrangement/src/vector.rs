//! Vectors of three `f64`.

pub(crate) fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    let minor = |u: usize, v: usize| a[u] * b[v] - a[v] * b[u];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

pub(crate) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    dot(minus(a, b), minus(a, b)).sqrt()
}

/// Not shorter than the vector.
pub(crate) fn size(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x.abs()).sum()
}
