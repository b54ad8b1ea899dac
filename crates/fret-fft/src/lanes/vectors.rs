//! Lanes on the vectors of `pulp`, whatever the instruction set.

use pulp::NullaryFnOnce;

use super::simd::{Lanes, Task};

/// A task waiting to be called inside its instruction set.
pub struct Entered<L, T>(pub L, pub T);

impl<L: Lanes, T: Task<L>> NullaryFnOnce for Entered<L, T> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.1.run(self.0);
    }
}

/// Lanes on the vectors of one instruction set: how to reach its operations, and their names.
macro_rules! lanes {
    ($lanes:ty, |$self:ident| $set:expr, $number:ty, $width:literal, $vector:ty, $transpose:ident,
     [$splat:ident, $add:ident, $sub:ident, $mul:ident, $mul_add:ident, $negate_mul_add:ident]) => {
        impl Lanes for $lanes {
            const WIDTH: usize = $width;
            type Number = $number;
            type Reals = $vector;
            type Block = [$vector; $width];

            #[inline(always)]
            fn enter<T: Task<Self>>($self, task: T) {
                $set.vectorize(Entered($self, task));
            }

            #[inline(always)]
            fn splat($self, value: $number) -> $vector {
                $set.$splat(value)
            }

            #[inline(always)]
            fn block($self, value: $vector) -> Self::Block {
                [value; $width]
            }

            #[inline(always)]
            fn add($self, a: $vector, b: $vector) -> $vector {
                $set.$add(a, b)
            }

            #[inline(always)]
            fn sub($self, a: $vector, b: $vector) -> $vector {
                $set.$sub(a, b)
            }

            #[inline(always)]
            fn mul($self, a: $vector, b: $vector) -> $vector {
                $set.$mul(a, b)
            }

            #[inline(always)]
            fn mul_add($self, a: $vector, b: $vector, c: $vector) -> $vector {
                $set.$mul_add(a, b, c)
            }

            #[inline(always)]
            fn negate_mul_add($self, a: $vector, b: $vector, c: $vector) -> $vector {
                $set.$negate_mul_add(a, b, c)
            }

            #[inline(always)]
            fn transpose($self, block: &mut Self::Block) {
                $transpose($set, block);
            }
        }
    };
}
pub(super) use lanes;
