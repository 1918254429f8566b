#include "keyline/exchange/format/format.h"

#include <gtest/gtest.h>

namespace keyline::exchange {
namespace {

TEST(FormatOf, MeshesAreKnownBehindCommentsAndEmptyLines) {
  for (const char* head :
       {"v 1 2 3\n", "# made by hand\nv 1 2 3\n", "#\n# of a\n\n  \r\n# b\nvn 0 0 1",
        "\n\nmtllib all.mtl\nv 1 2 3\n", "o hull\n", "f 1 2 3\n"})
    EXPECT_EQ(format_of("-", head), Format::mesh) << head;
  for (const char* head :
       {"1 2 3\n", "# v 1 2 3\n", "#\n#\n1 2\n", "v\n", "vertex 1 2 3\n", "\n\n"})
    EXPECT_EQ(format_of("-", head), Format::points) << head;
  EXPECT_EQ(format_of("a.svg", "v 1 2 3\n"), Format::svg);
}

}  // namespace
}  // namespace keyline::exchange
