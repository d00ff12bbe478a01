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

}  // namespace
}  // namespace lascaux
