#include "keyline/numeric/instruction_set.h"

#include <cstdlib>

#include "keyline/core/error.h"
#include "keyline/numeric/lanes.h"

namespace keyline::numeric {
namespace {

constexpr bool kHasBaseline = !std::is_same_v<simd::BaselineArch, simd::ScalarArch>;

/// xsimd 8.1's own detection asks neither whether the system keeps the wide registers nor, on
/// processors without XSAVE, for SSE2.
bool has_avx2() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

bool has_avx512() {
#if defined(__x86_64__)
  return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
#else
  return false;
#endif
}

}  // namespace

std::string_view instruction_set_name(InstructionSet set) {
  if (set == InstructionSet::scalar) return "scalar";
  if (set == InstructionSet::avx2) return "avx2";
  if (set == InstructionSet::avx512) return "avx512";
#if defined(__aarch64__)
  return "neon";
#else
  return "sse2";
#endif
}

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets{InstructionSet::scalar};
  if (kHasBaseline) sets.push_back(InstructionSet::baseline);
  if (has_avx2()) sets.push_back(InstructionSet::avx2);
  if (has_avx512()) sets.push_back(InstructionSet::avx512);
  return sets;
}

InstructionSet chosen_instruction_set(std::string_view name) {
  const std::vector<InstructionSet> sets = instruction_sets();
  if (name.empty()) return sets.back();
  std::string known;
  for (const InstructionSet set : sets) {
    if (instruction_set_name(set) == name) return set;
    known.append(known.empty() ? "" : ", ").append(instruction_set_name(set));
  }
  throw core::InvalidInput("KEYLINE_SIMD names \"" + std::string(name) + "\", this processor has " +
                           known);
}

InstructionSet instruction_set() {
  static const InstructionSet set = [] {
    const char* const wanted = std::getenv("KEYLINE_SIMD");
    return chosen_instruction_set(wanted ? wanted : "");
  }();
  return set;
}

}  // namespace keyline::numeric
