//! The only file that chooses between `std` and `libm`.

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("feature-sampling needs the feature `std` or the feature `libm` for square roots");

/// √x of a double, correctly rounded.
#[cfg(feature = "std")]
#[inline]
pub(super) fn sqrt_f64(x: f64) -> f64 {
    x.sqrt()
}

/// √x of a float, correctly rounded.
#[cfg(feature = "std")]
#[inline]
pub(super) fn sqrt_f32(x: f32) -> f32 {
    x.sqrt()
}

/// √x of a double, correctly rounded.
#[cfg(all(feature = "libm", not(feature = "std")))]
#[inline]
pub(super) fn sqrt_f64(x: f64) -> f64 {
    libm::sqrt(x)
}

/// √x of a float, correctly rounded.
#[cfg(all(feature = "libm", not(feature = "std")))]
#[inline]
pub(super) fn sqrt_f32(x: f32) -> f32 {
    libm::sqrtf(x)
}
