#pragma once

#include <memory>
#include <string>
#include <vector>

#include "keyline/core/describe.h"
#include "keyline/core/error.h"
#include "keyline/core/progress.h"

/// Every capability once: a function from a typed request to a typed result, both described once
/// (core/describe.h). The command line, batch, the HTTP server and Python all go through perform;
/// docs/contract.md lists the names. docs/adding.md tells how to add one.
namespace keyline::operations {

/// How a request is served; nothing in it changes a result.
struct Context {
  int threads = 0;  ///< 0: all of the machine's
  core::Progress progress;
  /// Whether the file "-" means standard input and output; false where those carry requests.
  bool standard_streams = false;
};

struct Operation {
  std::string name = {};
  std::string summary = {};
  std::vector<std::string> examples = {};  ///< requests that succeed, as JSON without "op"
  bool long_running = false;               ///< may pass 200 ms: reports progress, can be cancelled
  bool reads_files = false;
  bool writes_files = false;

  const core::Type* request = nullptr;
  const core::Type* result = nullptr;
  /// Precondition: `request` points to a valid record of the request's type. Returns a record of
  /// the result's type.
  core::Result<std::shared_ptr<void>> (*run)(const void* request, const Context& context) = nullptr;
};

namespace detail {

template <class F>
struct Signature;
template <class Request_, class Result_>
struct Signature<core::Result<Result_> (*)(const Request_&, const Context&)> {
  using Request = Request_;
  using Answer = Result_;
};

}  // namespace detail

/// The operation that runs `Run`, a function core::Result<Answer>(const Request&, const Context&)
/// of described structs. `facts` gives the rest: declare<run>({.name = "lac.segment", …}).
template <auto Run>
Operation declare(Operation facts) {
  using Of = detail::Signature<decltype(Run)>;
  facts.request = &core::type_of<typename Of::Request>();
  facts.result = &core::type_of<typename Of::Answer>();
  facts.run = [](const void* request,
                 const Context& context) -> core::Result<std::shared_ptr<void>> {
    auto answer = Run(*static_cast<const typename Of::Request*>(request), context);
    if (!answer) return std::unexpected(std::move(answer.error()));
    return std::make_shared<typename Of::Answer>(std::move(*answer));
  };
  return facts;
}

/// All of them, by name. Built once, on first use.
const std::vector<Operation>& operations();

/// Null where there is no such name.
const Operation* find_operation(const std::string& name);

}  // namespace keyline::operations
