"""unity_test.py ROOT COMPILER: two sources with the same names to themselves, put together by cmake/unity.py,
compile in another folder, give what they give one by one and name their tests alike. Without its names apart the
compiler refuses them."""

import subprocess
import sys
import tempfile
from pathlib import Path

HEADER = """#pragma once
namespace room { struct Pair { int value = 7; }; int first(); int second(); int shared(int); int shared(Pair);
const char* suite_of_first(); }
#define TOLD_AS(suite) #suite
#define TEST_F(suite, name) const char* suite_of_##name() { return suite{}.step ? "" : TOLD_AS(suite); }
"""
SOURCE = """#include "pair.h"
namespace room {
namespace {
constexpr int kStep = %(step)d;
struct Walk { int step; };
using Number = %(number)s;
room::Pair pair_of(Number x) { return {static_cast<int>(x)}; }
int run(Walk w) { return w.step + pair_of(kStep).value; }
int walk() { return run({kStep}); }
%(more)s}  // namespace
int %(name)s() { return 100 * walk() + static_cast<int>(sizeof(Number)); }
%(shared)s}  // namespace room
"""
FIRST = {"step": 3, "number": "long", "name": "first", "more": "int shared(const Walk& w) { return w.step; }\n",
         "shared": "int shared(int x) { return shared(Walk{x}); }\nnamespace {\nstruct Suite { int step; };\n}\nTEST_F(Suite, first)\n"}  # fmt: skip
SECOND = {"step": 5, "number": "short", "name": "second", "more": "",
          "shared": "int shared(Pair p) { return p.value; }\n"}  # fmt: skip
MAIN = """#include "pair.h"
#include <string_view>
int main() {
  return std::string_view(room::suite_of_first()) == "Suite" && room::first() == 608 && room::second() == 1002 &&
         room::shared(4) == 4 && room::shared(room::Pair{}) == 7 ? 0 : 1;
}
"""


def main():
    root, compiler = Path(sys.argv[1]), sys.argv[2]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "made").mkdir()
        (folder / "pair.h").write_text(HEADER)
        (folder / "first.cpp").write_text(SOURCE % FIRST)
        (folder / "second.cpp").write_text(SOURCE % SECOND)
        (folder / "main.cpp").write_text(MAIN)
        sources = [str(folder / "first.cpp"), str(folder / "second.cpp")]
        subprocess.run([sys.executable, str(root / "cmake" / "unity.py"), str(folder / "made" / "both.cpp"), *sources],
                       check=True)
        (folder / "plain.cpp").write_text("".join(f'#include "{s}"\n' for s in sources))

        def built(*what):
            command = [compiler, "-std=c++20", "-o", str(folder / "program"), str(folder / "main.cpp"), *what]
            return subprocess.run(command, capture_output=True, text=True)

        def runs(*what):
            done = built(*what)
            print(done.stderr, file=sys.stderr)
            return done.returncode == 0 and subprocess.run([folder / "program"]).returncode == 0

        told = {"one by one": runs(*sources), "together": runs(str(folder / "made" / "both.cpp")),
                "refused without": built(str(folder / "plain.cpp")).returncode != 0,
                "the same in every folder": name not in (folder / "made" / "both.cpp").read_text()}  # fmt: skip
    print(told)
    return 0 if all(told.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
