#include "keyline/presentation/fair_joints.h"

#include <algorithm>

namespace keyline::presentation::detail {
namespace {

/// The names of a curve's first and last piece.
struct Ends {
  std::string first;
  std::string last;
};

std::string between(const std::string& a, const std::string& b) { return a + "\u2013" + b; }

}  // namespace

std::vector<NamedJoint> named_joints(const fairing::FairResult& result) {
  std::vector<NamedJoint> joints;
  std::vector<Ends> ends;
  std::size_t number = 0;
  for (const auto& member : result.curves) {
    const auto* chain = std::get_if<lac::Chain>(&member);
    if (!chain) {
      ends.push_back({"kept", "kept"});
      continue;
    }
    const std::size_t first = number;
    number += chain->pieces.size();
    for (std::size_t i = first; i + 1 < number; ++i)
      joints.push_back({between(std::to_string(i), std::to_string(i + 1)), {}, true});
    if (chain->closed)
      joints.push_back({between(std::to_string(number - 1), std::to_string(first)), {}, true});
    ends.push_back({std::to_string(first), std::to_string(number - 1)});
  }
  if (ends.size() > 1) {
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
      joints.push_back({between(ends[i].last, ends[i + 1].first), {}, false});
    if (result.closed) joints.push_back({between(ends.back().last, ends.front().first), {}, false});
  }
  joints.resize(std::min(joints.size(), result.joints.size()));
  for (std::size_t i = 0; i < joints.size(); ++i) joints[i].joint = result.joints[i];
  return joints;
}

std::vector<NamedJoint> chain_joints(const fairing::FairResult& result) {
  std::vector<NamedJoint> joints = named_joints(result);
  std::erase_if(joints, [](const NamedJoint& joint) { return !joint.inside_chain; });
  return joints;
}

}  // namespace keyline::presentation::detail
