//! Which [groups](super::group::Group) of elements a level evaluates.

/// Runs an expression with `$groups` bound to the groups of a level.
#[cfg(target_arch = "x86_64")]
macro_rules! dispatch_groups {
    ($level:expr, $groups:ident => $body:expr) => {
        match $level {
            fearless_simd::Level::Avx512(simd) => crate::simd::with_instructions!(simd => {
                let $groups = crate::system::lanes::group::Lanes { simd, first: 0 };
                $body
            }),
            fearless_simd::Level::Avx2(simd) => crate::simd::with_instructions!(simd => {
                let $groups = crate::system::lanes::group::Lanes { simd, first: 0 };
                $body
            }),
            _ => {
                let $groups = crate::system::lanes::one::One(0);
                $body
            }
        }
    };
}

#[cfg(not(target_arch = "x86_64"))]
macro_rules! dispatch_groups {
    ($level:expr, $groups:ident => $body:expr) => {
        crate::simd::dispatch!($level, simd => {
            let $groups = crate::system::lanes::group::Lanes { simd, first: 0 };
            $body
        })
    };
}

pub(super) use dispatch_groups;
