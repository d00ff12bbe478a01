#include "exit_code.h"

#include <gtest/gtest.h>

#include <array>

namespace lascaux {
namespace {

constexpr std::array kWorstFirst = {1, 130, 5, 6, 3, 4, 2, 0};

TEST(ExitCode, TheWorseOfTwoIsTheFirstInTheList) {
  for (std::size_t i = 0; i < kWorstFirst.size(); ++i)
    for (std::size_t j = i; j < kWorstFirst.size(); ++j) {
      const auto a = static_cast<ExitCode>(kWorstFirst[i]);
      const auto b = static_cast<ExitCode>(kWorstFirst[j]);
      EXPECT_EQ(Worse(a, b), a);
      EXPECT_EQ(Worse(b, a), a);
    }
}

TEST(ExitCode, EachKindOfFailureHasItsNumber) {
  const auto number = [](FailureKind kind) { return static_cast<int>(ExitCodeOf(kind)); };
  EXPECT_EQ(number(FailureKind::kBug), 1);
  EXPECT_EQ(number(FailureKind::kUsage), 2);
  EXPECT_EQ(number(FailureKind::kInput), 3);
  EXPECT_EQ(number(FailureKind::kUnderstanding), 4);
  EXPECT_EQ(number(FailureKind::kOutput), 5);
  EXPECT_EQ(number(FailureKind::kMesh), 6);
  EXPECT_EQ(number(FailureKind::kInterrupted), 130);
}

TEST(ExitCode, WarningsDoNotCount) {
  EXPECT_EQ(ExitCodeOf(Diagnostics{Warning("a-warning", "Hm.")}), ExitCode::kSuccess);
  EXPECT_EQ(ExitCodeOf(Diagnostics{Error(FailureKind::kUsage, "a", "A."),
                                   Error(FailureKind::kMesh, "b", "B.")}),
            ExitCode::kMesh);
}

}  // namespace
}  // namespace lascaux
