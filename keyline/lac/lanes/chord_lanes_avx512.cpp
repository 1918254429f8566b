// Compiled with AVX-512 (see CMakeLists.txt); only templates of that instruction set here.
#ifdef __x86_64__
#include "keyline/lac/lanes/batch_lanes_body.h"

namespace keyline::lac::detail {

template void BatchKernel::operator()<xsimd::avx512dq>(xsimd::avx512dq, ChordBlock*,
                                                       std::size_t) const;

template void AngleKernel::operator()<xsimd::avx512dq>(xsimd::avx512dq, const double*,
                                                       const double*, double*, std::size_t) const;

}  // namespace keyline::lac::detail
#endif
