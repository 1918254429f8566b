#pragma once

#include "keyline/analysis/continuity.h"
#include "keyline/core/describe.h"

/// Joints between curves in results.
namespace keyline::operations {

enum class Order { none = -1, g0, g1, g2, g3 };
constexpr auto choices(const Order*) {
  return core::words<Order>({{Order::none, "none"},
                             {Order::g0, "G0"},
                             {Order::g1, "G1"},
                             {Order::g2, "G2"},
                             {Order::g3, "G3"}});
}

/// Precondition: order is -1 to 3.
constexpr Order order_of(int order) { return static_cast<Order>(order); }

struct Joint {
  analysis::JointContinuity joint;
  Order order = Order::none;
  static constexpr auto describe() {
    return core::fields(core::flattened<&Joint::joint>(),
                        core::field<&Joint::order>("of continuity; none where there is a gap"));
  }
};

inline Joint joint_of(const analysis::JointContinuity& joint) {
  return {joint, order_of(joint.order)};
}

}  // namespace keyline::operations
