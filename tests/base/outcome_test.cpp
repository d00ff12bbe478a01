#include "lascaux/base/outcome.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace lascaux {
namespace {

Diagnostic AnError() { return Error(FailureKind::kInput, "an-error", "No."); }

TEST(Outcome, AValueKeepsWhatWasNoticedOnTheWay) {
  const Outcome<int> outcome(3, {Warning("a-warning", "Hm.")});
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(*outcome, 3);
  ASSERT_EQ(outcome.diagnostics().size(), 1u);
  EXPECT_EQ(outcome.diagnostics()[0].code, "a-warning");
}

TEST(Outcome, AFailureHasNoValueAndSaysWhy) {
  const auto outcome = Outcome<std::string>::Failure(AnError());
  EXPECT_FALSE(outcome);
  EXPECT_TRUE(HasError(outcome.diagnostics()));
}

TEST(Outcome, MovingItOutAppendsToTheLog) {
  Diagnostics log = {Note("first", "1.")};
  const std::optional<int> value = Outcome<int>(5, {Note("second", "2.")}).MoveInto(log);
  EXPECT_EQ(value, 5);
  EXPECT_EQ(Outcome<int>::Failure(AnError()).MoveInto(log), std::nullopt);
  ASSERT_EQ(log.size(), 3u);
  EXPECT_EQ(log[0].code, "first");
  EXPECT_EQ(log[1].code, "second");
  EXPECT_EQ(log[2].code, "an-error");
}

TEST(Outcome, ValuesThatCannotBeCopiedAreMoved) {
  Diagnostics log;
  auto value = Outcome<std::unique_ptr<int>>(std::make_unique<int>(4)).MoveInto(log);
  ASSERT_TRUE(value);
  EXPECT_EQ(**value, 4);
}

}  // namespace
}  // namespace lascaux
