#pragma once

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace keyline::own {

/// The largest error a test has met, told with its result (docs/accuracy.md).
class Worst {
 public:
  explicit Worst(std::string what) : what_(std::move(what)) {}
  ~Worst() {
    char text[32];
    std::snprintf(text, sizeof text, "%.1e", largest_);
    testing::Test::RecordProperty(what_, text);
  }
  void expect_below(double error, double allowed) {
    EXPECT_LT(error, allowed) << what_;
    largest_ = std::max(largest_, error);
  }

 private:
  std::string what_;
  double largest_ = 0;
};

}  // namespace keyline::own
