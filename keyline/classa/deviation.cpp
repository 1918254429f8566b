#include "keyline/classa/deviation.h"

#include "keyline/curve/chain_deviation.h"

namespace keyline::classa {

double deviation_bound(std::span<const curve::Bezier2> row, const curve::Bezier2& q,
                       double wanted) {
  return curve::deviation_bound({{row.begin(), row.end()}, 0}, {{q}, 0}, wanted);
}

}  // namespace keyline::classa
