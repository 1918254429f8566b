#include "keyline/numeric/instruction_set.h"

#include <gtest/gtest.h>

#include "keyline/core/error.h"

namespace keyline::numeric {
namespace {

TEST(InstructionSet, IsChosenByItsName) {
  for (const InstructionSet set : instruction_sets())
    EXPECT_EQ(chosen_instruction_set(instruction_set_name(set)), set);
  EXPECT_EQ(instruction_sets().front(), InstructionSet::scalar);
}

TEST(InstructionSet, IsTheBestWhereNoneIsNamed) {
  EXPECT_EQ(chosen_instruction_set(""), instruction_sets().back());
}

TEST(InstructionSet, RefusesWhatTheProcessorHasNot) {
  try {
    chosen_instruction_set("avx9");
    FAIL() << "avx9 was taken";
  } catch (const core::InvalidInput& e) {
    const std::string said = e.what();
    EXPECT_NE(said.find("avx9"), std::string::npos) << said;
    EXPECT_NE(said.find("scalar"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace keyline::numeric
