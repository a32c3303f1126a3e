//! `Instructions`, which of the processor's instruction sets a scanner uses.

use super::kernel::{self, Kernel};

/// A set of instructions for the inner loops. All give the same bits; they differ in speed only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instructions {
    /// Those the program was compiled for: SSE2 on x86-64, simd128 on WebAssembly where that is switched on.
    Baseline,
    /// AVX2, four numbers at a time.
    Avx2,
    /// AVX-512, eight numbers at a time.
    Avx512,
}

impl Instructions {
    /// The sets this processor has, slowest first.
    pub fn available() -> Vec<Self> {
        #[allow(unused_mut)]
        let mut sets = vec![Self::Baseline];
        #[cfg(target_arch = "x86_64")]
        {
            if std::arch::is_x86_feature_detected!("avx2") {
                sets.push(Self::Avx2);
            }
            if std::arch::is_x86_feature_detected!("avx512f")
                && std::arch::is_x86_feature_detected!("avx512bw")
                && std::arch::is_x86_feature_detected!("avx512cd")
                && std::arch::is_x86_feature_detected!("avx512dq")
                && std::arch::is_x86_feature_detected!("avx512vl")
            {
                sets.push(Self::Avx512);
            }
        }
        sets
    }

    /// The fastest set this processor has.
    pub fn best() -> Self {
        Self::available().pop().unwrap_or(Self::Baseline)
    }

    pub(super) fn kernel(self) -> Kernel {
        match self {
            Self::Baseline => kernel::baseline::KERNEL,
            Self::Avx2 => kernel::avx2::KERNEL,
            Self::Avx512 => kernel::avx512::KERNEL,
        }
    }
}
