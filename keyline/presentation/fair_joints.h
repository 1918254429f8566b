#pragma once

#include <string>
#include <vector>

#include "keyline/fairing/fair.h"

namespace keyline::presentation::detail {

/// A joint of the result with the pieces it stands between, "2–3"; parts that were kept as they
/// are called "kept".
struct NamedJoint {
  std::string between;
  analysis::JointContinuity joint;
  bool inside_chain = true;
};

/// All joints in the order of FairResult::joints: inside the chains, then between the curves.
std::vector<NamedJoint> named_joints(const fairing::FairResult& result);

/// Those inside chains.
std::vector<NamedJoint> chain_joints(const fairing::FairResult& result);

}  // namespace keyline::presentation::detail
