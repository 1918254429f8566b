// Compiled with AVX2 and FMA (see CMakeLists.txt); only templates of that instruction set here.
#ifdef __x86_64__
#include "keyline/lac/lanes/batch_lanes_body.h"

namespace keyline::lac::detail {

template PanelSums PanelKernel::operator()<xsimd::fma3<xsimd::avx2>>(xsimd::fma3<xsimd::avx2>,
                                                                     double, double, double, double,
                                                                     double, double,
                                                                     const GaussNodes*, int) const;

template void BatchKernel::operator()<xsimd::fma3<xsimd::avx2>>(xsimd::fma3<xsimd::avx2>,
                                                                ChordBlock*, std::size_t) const;

template void AngleKernel::operator()<xsimd::fma3<xsimd::avx2>>(xsimd::fma3<xsimd::avx2>,
                                                                const double*, const double*,
                                                                double*, std::size_t) const;

}  // namespace keyline::lac::detail
#endif
