#include "lascaux/base/execution.h"

#include <gtest/gtest.h>

#include <string>

namespace lascaux {
namespace {

TEST(Execution, WithoutAFlagIsNeverCancelled) { EXPECT_FALSE(Execution{}.IsCancelled()); }

TEST(Execution, CopiesSeeTheSameFlag) {
  std::atomic<bool> flag = false;
  const Execution one{.threads = 1, .cancel = &flag, .progress = {}};
  const Execution copy = one;
  EXPECT_FALSE(copy.IsCancelled());
  flag = true;
  EXPECT_TRUE(one.IsCancelled());
  EXPECT_TRUE(copy.IsCancelled());
}

TEST(Execution, ProgressIsHeardOrIgnored) {
  Execution{}.Report("a stage", 0.5);
  std::string heard;
  const Execution execution{
      .threads = 0, .cancel = nullptr, .progress = [&](auto stage, double fraction) {
        heard = std::string(stage) + " " + std::to_string(fraction);
      }};
  execution.Report("a stage", 0.5);
  EXPECT_EQ(heard, "a stage 0.500000");
}

}  // namespace
}  // namespace lascaux
