//! Asking memory for what comes next.
//!
//! Contacts and bodies of a large pile do not fit the second-level cache, and what a stage works on next it finds through two or
//! three pointers, each of which is waited for: a processor that looks a few hundred instructions ahead does not get that far.
//! Stages that know whom they come to soon say so, and find it at hand. Without effect on what is computed.

/// Whether anything comes of asking: elsewhere there is no such hint, or none that stable Rust knows.
pub(crate) const IS_HEARD: bool = cfg!(target_arch = "x86_64");

/// Bytes that come together.
const LINE: usize = 64;

/// Lines that the points of a contact take, at most, up to 5D.
const FEW: usize = 8;

/// Asks for the first `bytes` of a value.
#[inline(always)]
pub(crate) fn fetch<T>(value: &T, bytes: usize) {
    lines(std::ptr::from_ref(value).cast(), bytes.min(size_of::<T>()));
}

/// Asks for all of a slice.
#[inline(always)]
pub(crate) fn fetch_all<T>(values: &[T]) {
    if !values.is_empty() {
        lines(values.as_ptr().cast(), size_of_val(values));
    }
}

#[inline(always)]
fn lines(start: *const i8, bytes: usize) {
    let (mut offset, last) = (0, bytes.saturating_sub(1));
    // The first few one by one: a loop of any length is laid out for many turns, and to find the way into it takes longer than them.
    while offset < last && offset < FEW * LINE {
        hint(start.wrapping_add(offset));
        offset += LINE;
    }
    while offset < last {
        hint(start.wrapping_add(offset));
        offset += LINE;
    }
    // It may lie in a line of its own.
    hint(start.wrapping_add(last));
}

#[inline(always)]
fn hint(address: *const i8) {
    #[cfg(target_arch = "x86_64")]
    #[expect(
        unsafe_code,
        reason = "there is no safe form of this hint, which a measurement asks for: docs/performance.md"
    )]
    // SAFETY: prefetching changes neither memory nor registers and raises no fault, whatever the address.
    unsafe {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        _mm_prefetch::<_MM_HINT_T0>(address);
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = address;
}
