#include "keyline/classa/deviation.h"

#include "keyline/curve/chain_deviation.h"
#include "keyline/curve/part_bound.h"

namespace keyline::classa {

double deviation_bound(std::span<const curve::Bezier2> row, const curve::Bezier2& q,
                       double wanted) {
  return curve::deviation_bound({{row.begin(), row.end()}, 0}, {{q}, 0}, wanted);
}

double deviation_bound(const curve::Bezier3& c, const curve::Bezier3& q, double wanted) {
  return curve::part_bound(c, q, 0, 1, wanted);
}

}  // namespace keyline::classa
