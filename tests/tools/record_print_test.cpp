#include "record_print.h"

#include <gtest/gtest.h>

namespace lascaux {
namespace {

TEST(DescribeChanges, WarnsOfWallsThatStayedThin) {
  PrintRecord record;
  record.thickened = {{"limb-1", {.thickness = 0.4}}};
  PrintOptions options;
  options.min_wall = 1;
  EXPECT_EQ(DescribeChanges(record, options).size(), 1);
  record.changes.still_thin = {{.thickness = 0.9}, {.thickness = 0.75, .middle = {1, 2, 3}}};
  Lift(record, 4);
  const Diagnostics log = DescribeChanges(record, options);
  ASSERT_EQ(log.size(), 2);
  EXPECT_EQ(log[1].code, "wall-still-thin");
  EXPECT_NE(log[1].message.find("0.75 mm thick at (1.0, 6.0, 3.0), not 1:"), std::string::npos);
}

}  // namespace
}  // namespace lascaux
