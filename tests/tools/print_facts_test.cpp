#include "print_facts.h"

#include <gtest/gtest.h>

namespace lascaux {
namespace {

Diagnostics WarningsAt(double tilt) {
  PrintFacts facts;
  facts.stability.emplace().margin = -1;
  facts.stability->tilt = tilt;
  return PrintWarnings(facts);
}

TEST(PrintWarnings, AreAsLoudAsItTilts) {
  EXPECT_TRUE(WarningsAt(1).empty());
  ASSERT_EQ(WarningsAt(5).size(), 1);
  EXPECT_EQ(WarningsAt(5)[0].code, "leans");
  EXPECT_EQ(WarningsAt(5)[0].severity, Severity::kNote);
  ASSERT_EQ(WarningsAt(20).size(), 1);
  EXPECT_EQ(WarningsAt(20)[0].code, "falls-over");
  EXPECT_NE(WarningsAt(20)[0].message.find("by 20 degrees;"), std::string::npos);
  EXPECT_NE(WarningsAt(kFarthestTilt)[0].message.find("45 degrees or more"), std::string::npos);
}

}  // namespace
}  // namespace lascaux
