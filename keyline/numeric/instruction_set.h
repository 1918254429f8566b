#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Which of the kernels' instruction sets runs: found when it is first asked for, so that one
/// binary serves every processor of its family.
namespace keyline::numeric {

enum class InstructionSet {
  scalar,    ///< plain doubles, every processor
  baseline,  ///< what every processor of this build's family has: SSE2 on amd64, NEON on arm64
  avx2,      ///< AVX2 with FMA, amd64 alone
  avx512,    ///< AVX-512 F, CD, DQ and BW beside these; what has no kernel for it runs as avx2
};

/// "scalar", "sse2" or "neon", "avx2", "avx512".
std::string_view instruction_set_name(InstructionSet set);

/// Those this processor and its system can run, the best one last.
std::vector<InstructionSet> instruction_sets();

/// The one of that name; the best one where the name is empty.
/// Throws: InvalidInput where this processor has none of that name.
InstructionSet chosen_instruction_set(std::string_view name);

/// The one that runs: the best, or what the environment's KEYLINE_SIMD names (for tests: answers
/// differ by rounding). Read once.
/// Throws: InvalidInput as above.
InstructionSet instruction_set();

}  // namespace keyline::numeric
