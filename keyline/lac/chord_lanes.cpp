#include "keyline/lac/chord_lanes_body.h"

namespace keyline::lac::detail {

// The instruction set every machine of this build has.
template PanelSums PanelKernel::operator()<xsimd::default_arch>(xsimd::default_arch, double, double,
                                                                double, double, double, double,
                                                                const GaussNodes*, int) const;

#ifdef KEYLINE_LAC_AVX2
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

}  // namespace keyline::lac::detail
