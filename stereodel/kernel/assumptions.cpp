// What every error bound of the kernel takes for granted about compiler and machine; a build that breaks it stops here.
//
// Source: IEEE 754 as C++17 describes it in <cfloat> and <limits>.

#include <cfloat>
#include <limits>

#ifdef __FAST_MATH__
#error "The kernel's signs are exact only without -ffast-math: sums must be rounded in the order in which they stand."
#endif

namespace stereodel {

static_assert(std::numeric_limits<double>::is_iec559 && DBL_MANT_DIG == 53, "double must be IEEE 754 binary64");
static_assert(std::numeric_limits<double>::has_denorm == std::denorm_present, "tiny differences must not become zero");
static_assert(FLT_EVAL_METHOD == 0, "each operation must round to double; on 32-bit x86: -msse2 -mfpmath=sse");

}  // namespace stereodel
