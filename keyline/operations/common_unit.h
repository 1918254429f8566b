#pragma once

#include <string>

#include "keyline/core/error.h"

/// The unit of what several files hold.
namespace keyline::operations {

/// Files of one command that tell a unit tell the same; one without is in that of the others.
class CommonUnit {
 public:
  /// Fails: bad_input, naming the file, where it is in another unit than one before it.
  core::Result<void> take(const std::string& unit, const std::string& file);
  /// Empty where no file tells one.
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  std::string told_by_;  ///< the file
};

}  // namespace keyline::operations
