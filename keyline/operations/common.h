#pragma once

#include <span>

#include "keyline/operations/json_form.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/operation.h"

/// What requests have beside an operation's own fields. For .cpp files of this room only.
namespace keyline::operations::detail {

/// What every operation takes.
struct Common {
  int threads = 0;
  static constexpr auto describe() {
    return core::fields(core::field<&Common::threads>(
                            "how many to use, 0 for all; the result does not depend on it")
                            .within(core::from_to(0, 1024)));
  }
};

/// Members of a request that are no field of any record: its operation, and what comes back with
/// it.
inline constexpr std::string_view kEnvelope[] = {"op", "id"};

/// A request with everything in it.
struct Whole {
  std::shared_ptr<void> own;  ///< the operation's request
  Common common;
  Forms forms;

  explicit Whole(const Operation& operation)
      : own(operation.request->make()), with_forms(holds_made_curve(*operation.result)) {}
  std::vector<Part> parts(const Operation& operation) {
    std::vector<Part> all{{operation.request, own.get()}, {&core::type_of<Common>(), &common}};
    if (with_forms) all.push_back({&core::type_of<Forms>(), &forms});
    return all;
  }

  bool with_forms;
};

}  // namespace keyline::operations::detail
