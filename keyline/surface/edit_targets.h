#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/surface/edit.h"
#include "keyline/surface/edit_curve.h"
#include "keyline/surface/one_matrix.h"

/// Internals of room surface: the nets an edit may take a patch to.
namespace keyline::surface::detail {

struct Target {
  std::string name;
  Net net;
};

/// The targets that were found and why others were not.
struct TargetSet {
  std::vector<Target> targets;
  std::vector<MissedTarget> missed;
};

/// Which way edges are to grow: away from b00 where the start is kept, else as they do.
struct Sense {
  bool rows_from_end = false;
  bool columns_from_end = false;
};
Sense sense_of(const Net& net, Keep keep);
/// Of a curve that is to come out the same whatever patch it is seen from: as its edges grow.
Sense own_sense(const NetworkCurve& c);

/// A patch to be edited, with what is asked of each of its network curves.
struct EditTask {
  const Net& net;
  const EditOptions& options;
  std::vector<CurveCondition> conditions;  ///< in the order of network_curves

  /// Place of a curve in that order.
  std::size_t index_of(const NetworkCurve& c) const {
    return static_cast<std::size_t>(c.is_row ? c.index : net.rows + c.index);
  }
  CurveTask curve(const NetworkCurve& c, const Sense& sense) const;
};

/// All targets of edit() that exist for this net, exact ones only. They may still miss a condition.
TargetSet edit_targets(const EditTask& task);

/// Whether the net has at least as many freedoms as there are equations.
bool solvable(const Net& net);

/// How the points of the net may move where the start or the corners are kept.
std::vector<Freedom> freedom_of(const EditTask& task);

/// "conditions": the nearest net in which the curves with ranges or branches have one matrix each,
/// within these; nothing is asked of the others. Only added where it meets them.
void add_conditions(const EditTask& task, TargetSet& set);

/// "one matrix", "towards least energy", "least energy" (one_matrix.h), where the net is
/// solvable.
void add_solved(const EditTask& task, TargetSet& set);

/// The net nearest to this one, boundary held, all of whose curves have one matrix; its boundary
/// curves have to have theirs. Empty where none is found.
std::optional<Net> solved_inside(const EditTask& task, const Net& net);

}  // namespace keyline::surface::detail
