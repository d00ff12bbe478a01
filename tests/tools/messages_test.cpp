#include "messages.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>

namespace lascaux {
namespace {

std::string Printed(const Diagnostics& diagnostics, Verbosity verbosity) {
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), std::fclose);
  PrintMessages(file.get(), "cat.svg", diagnostics, verbosity);
  std::rewind(file.get());
  std::array<char, 1000> text{};
  return {text.data(), std::fread(text.data(), 1, text.size(), file.get())};
}

TEST(Messages, ALineHasFileStrokeSeverityCodeAndSentence) {
  EXPECT_EQ(MessageLine("cat.svg", OnStroke(Warning("gap-closed", "A gap of 2.5."), 3)),
            "cat.svg:3: warning: gap-closed: A gap of 2.5.");
  EXPECT_EQ(MessageLine("cat.svg", Error(FailureKind::kInput, "not-svg", "No.")),
            "cat.svg: error: not-svg: No.");
}

TEST(Messages, OneMessageIsOneLineWhateverIsInIt) {
  EXPECT_EQ(MessageLine("a\nb", Note("c", "d\x1b[31m\r\n")), "a?b: note: c: d?[31m??");
}

TEST(Messages, QuietSilencesNotesAlone) {
  const Diagnostics all = {Note("a", "A."), Warning("b", "B."),
                           Error(FailureKind::kInput, "c", "C.")};
  EXPECT_EQ(Printed(all, Verbosity::kQuiet), "cat.svg: warning: b: B.\ncat.svg: error: c: C.\n");
  EXPECT_EQ(Printed({Note("a", "A.")}, Verbosity::kAll), "cat.svg: note: a: A.\n");
}

TEST(Messages, ManyOfOneKindAreCountedAndErrorsAreNot) {
  Diagnostics all = {Warning("a", "A.")};
  for (int i = 0; i < 7; ++i) all.push_back(At(OnStroke(Note("b", "B."), i), {0, 0}));
  for (int i = 0; i < 7; ++i) all.push_back(Error(FailureKind::kInput, "c", "C."));
  all.push_back(Warning("a", "A."));
  const std::vector<Listed> list = ListBriefly(all);
  ASSERT_EQ(list.size(), 1 + kMostAlike + 7 + 1);
  EXPECT_EQ(list[kMostAlike - 1].diagnostic, all[kMostAlike - 1]);
  EXPECT_EQ(list[kMostAlike].number, kMostAlike + 1);
  EXPECT_EQ(list[kMostAlike].diagnostic.message.substr(0, 6), "4 more");
  EXPECT_FALSE(list[kMostAlike].diagnostic.stroke);
  EXPECT_EQ(list.back().number, all.size());
}

}  // namespace
}  // namespace lascaux
