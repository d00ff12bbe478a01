#include "lascaux/base/diagnostic.h"

#include <gtest/gtest.h>

namespace lascaux {
namespace {

TEST(Diagnostic, NamesOfSeveritiesAreThoseOfTheMessages) {
  EXPECT_STREQ(Name(Severity::kNote), "note");
  EXPECT_STREQ(Name(Severity::kWarning), "warning");
  EXPECT_STREQ(Name(Severity::kError), "error");
}

TEST(Diagnostic, NotesAndWarningsAreNoErrors) {
  EXPECT_FALSE(HasError({}));
  EXPECT_FALSE(HasError({Note("a-note", "A."), Warning("a-warning", "B.")}));
  EXPECT_TRUE(HasError({Note("a-note", "A."), Error(FailureKind::kInput, "an-error", "C.")}));
}

TEST(Diagnostic, OnlyErrorsHaveAKindOfFailure) {
  EXPECT_EQ(Note("a-note", "A.").failure, FailureKind::kNone);
  EXPECT_EQ(Warning("a-warning", "A.").failure, FailureKind::kNone);
  EXPECT_EQ(Error(FailureKind::kMesh, "an-error", "A.").failure, FailureKind::kMesh);
}

TEST(Diagnostic, PlaceAndStrokeAreAddedWithoutChangingTheRest) {
  const Diagnostic plain = Warning("gap-closed", "A gap.");
  const Diagnostic placed = OnStroke(At(plain, {3, 4}), 7);
  EXPECT_EQ(placed.at, Eigen::Vector2d(3, 4));
  EXPECT_EQ(placed.stroke, 7);
  EXPECT_EQ(placed.code, plain.code);
  EXPECT_EQ(placed.message, plain.message);
  EXPECT_FALSE(plain.at.has_value());
}

}  // namespace
}  // namespace lascaux
