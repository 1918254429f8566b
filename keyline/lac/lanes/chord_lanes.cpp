#include "keyline/lac/lanes/batch_lanes_body.h"

namespace keyline::lac::detail {

// The instruction set every machine of this build has.
template PanelSums PanelKernel::operator()<xsimd::default_arch>(xsimd::default_arch, double, double,
                                                                double, double, double, double,
                                                                const GaussNodes*, int) const;

template void BatchKernel::operator()<xsimd::default_arch>(xsimd::default_arch, ChordBlock*,
                                                           std::size_t) const;

template void AngleKernel::operator()<xsimd::default_arch>(xsimd::default_arch, const double*,
                                                           const double*, double*,
                                                           std::size_t) const;

#ifdef KEYLINE_LAC_AVX2
extern template void AngleKernel::operator()<xsimd::fma3<xsimd::avx2>>(xsimd::fma3<xsimd::avx2>,
                                                                       const double*, const double*,
                                                                       double*, std::size_t) const;
extern template void BatchKernel::operator()<xsimd::fma3<xsimd::avx2>>(xsimd::fma3<xsimd::avx2>,
                                                                       ChordBlock*,
                                                                       std::size_t) const;
extern template PanelSums PanelKernel::operator()<xsimd::fma3<xsimd::avx2>>(
    xsimd::fma3<xsimd::avx2>, double, double, double, double, double, double, const GaussNodes*,
    int) const;
using Architectures = xsimd::arch_list<xsimd::fma3<xsimd::avx2>, xsimd::default_arch>;
#else
using Architectures = xsimd::arch_list<xsimd::default_arch>;
#endif

PanelSums panel_sums(const PanelJob& job) {
  static auto kernel = xsimd::dispatch<Architectures>(PanelKernel{});
  return kernel(job.a, job.b, job.from, job.width, job.scale, job.centre, &gauss_nodes(job.nodes),
                job.nodes);
}

void angles_of_block(const double* y, const double* x, double* angle, std::size_t count) {
  static auto kernel = xsimd::dispatch<Architectures>(AngleKernel{});
  kernel(y, x, angle, count);
}

void solve_block(ChordBlock& block, std::size_t count) {
  static auto kernel = xsimd::dispatch<Architectures>(BatchKernel{});
  kernel(&block, count);
}

}  // namespace keyline::lac::detail
