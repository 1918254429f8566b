#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/document/document.h"

#include "cad_fixture.h"
#include "step_text.h"

/// What the entities of a STEP file mean, by ISO 10303-42.
namespace keyline::exchange {
namespace {

using document::Document;
using testing::ElementsAre;
using testing::HasSubstr;

class CadStep : public CadTest {
 protected:
  Document read(const std::string& curves, const std::string& body) const {
    return read_sound("d.step", step_curves(curves, body));
  }
};

TEST_F(CadStep, UnboundedLinesAreToldAndTheOthersRead) {
  const Document d =
      read("#21,#22", "#21=LINE('',#15,#23);\n#23=VECTOR('',#19,1.);\n" +
                          trimmed_text(22, "#24", 0, 1) + "#24=CIRCLE('',#14,2.);\n");
  EXPECT_EQ(d.paths.size(), 1U);
  EXPECT_THAT(d.skipped, ElementsAre(HasSubstr("an unbounded curve")));
}

}  // namespace
}  // namespace keyline::exchange
