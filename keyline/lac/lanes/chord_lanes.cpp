#include <type_traits>

#include "keyline/lac/lanes/batch_lanes_body.h"
#include "keyline/numeric/instruction_set.h"

namespace keyline::lac::detail {

using numeric::InstructionSet;
using numeric::simd::BaselineArch;
using numeric::simd::ScalarArch;

#ifdef __x86_64__
using Avx2 = xsimd::fma3<xsimd::avx2>;
// chord_lanes_avx2.cpp has these.
extern template void AngleKernel::operator()<Avx2>(Avx2, const double*, const double*, double*,
                                                   std::size_t) const;
extern template void BatchKernel::operator()<Avx2>(Avx2, ChordBlock*, std::size_t) const;
extern template PanelSums PanelKernel::operator()<Avx2>(Avx2, double, double, double, double,
                                                        double, double, const GaussNodes*,
                                                        int) const;
using Avx512 = xsimd::avx512dq;
// chord_lanes_avx512.cpp has these.
extern template void AngleKernel::operator()<Avx512>(Avx512, const double*, const double*, double*,
                                                     std::size_t) const;
extern template void BatchKernel::operator()<Avx512>(Avx512, ChordBlock*, std::size_t) const;
#else
using Avx2 = BaselineArch;  // never asked for
using Avx512 = BaselineArch;
#endif

namespace {

/// The kernel on the instruction set that runs.
template <class Kernel, class... Arguments>
auto run(const Kernel& kernel, Arguments... arguments) {
  static const InstructionSet set = numeric::instruction_set();
  switch (set) {
    case InstructionSet::avx512:
      // the few nodes of one panel are no faster in eight lanes
      if constexpr (!std::is_same_v<Kernel, PanelKernel>) return kernel(Avx512{}, arguments...);
      [[fallthrough]];
    case InstructionSet::avx2:
      return kernel(Avx2{}, arguments...);
    case InstructionSet::baseline:
      return kernel(BaselineArch{}, arguments...);
    case InstructionSet::scalar:
      break;
  }
  return kernel(ScalarArch{}, arguments...);
}

}  // namespace

PanelSums panel_sums(const PanelJob& job) {
  return run(PanelKernel{}, job.a, job.b, job.from, job.width, job.scale, job.centre,
             &gauss_nodes(job.nodes), job.nodes);
}

void angles_of_block(const double* y, const double* x, double* angle, std::size_t count) {
  run(AngleKernel{}, y, x, angle, count);
}

void solve_block(ChordBlock& block, std::size_t count) { run(BatchKernel{}, &block, count); }

}  // namespace keyline::lac::detail
