#include "lascaux/io/read_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <random>
#include <string>

#include "io/temporary_folder.h"
#include "lascaux/io/content_hash.h"
#include "lascaux/io/output_file.h"

namespace lascaux {
namespace {

void ExpectCannotRead(const Outcome<std::string>& bytes, const std::string& part) {
  ASSERT_FALSE(bytes.ok());
  const Diagnostic& diagnostic = bytes.diagnostics().at(0);
  EXPECT_EQ(diagnostic.code, "cannot-read");
  EXPECT_EQ(diagnostic.failure, FailureKind::kInput);
  EXPECT_NE(diagnostic.message.find(part), std::string::npos) << diagnostic.message;
}

std::string RandomBytes(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random() & 0xff);
  return bytes;
}

/// Puts a file in the place of standard input for a while.
class StandardInput {
 public:
  explicit StandardInput(int descriptor) : saved_(dup(STDIN_FILENO)) {
    dup2(descriptor, STDIN_FILENO);
  }
  ~StandardInput() {
    dup2(saved_, STDIN_FILENO);
    close(saved_);
  }
  StandardInput(const StandardInput&) = delete;
  StandardInput& operator=(const StandardInput&) = delete;

 private:
  int saved_;
};

TEST(ReadBytes, GivesWhatWasWritten) {
  const TemporaryFolder folder;
  for (const std::size_t size : {0U, 1U, 65535U, 65536U, 65537U, 1000000U}) {
    const std::string bytes = RandomBytes(size, 1);
    ASSERT_TRUE(WriteBytes(folder / "a", bytes).empty());
    const auto read = ReadBytes(folder / "a");
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(*read, bytes) << size;
  }
}

TEST(ReadBytes, ADashIsStandardInput) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  ASSERT_EQ(write(ends[1], "<svg/>", 6), 6);
  close(ends[1]);
  const StandardInput input(ends[0]);
  const auto read = ReadBytes("-");
  close(ends[0]);
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(*read, "<svg/>");
}

TEST(ReadBytes, AMissingFileIsAnError) {
  ExpectCannotRead(ReadBytes("/no/such/file"), "check the name");
}

TEST(ReadBytes, AFolderIsAnError) { ExpectCannotRead(ReadBytes("/tmp"), "a file inside it"); }

TEST(ReadBytes, AnUnreadableFileIsAnError) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteBytes(folder / "a", "x").empty());
  ASSERT_EQ(chmod((folder / "a").c_str(), 0), 0);
  const bool root = geteuid() == 0;  // whom nothing is forbidden
  if (root) {
    ASSERT_EQ(seteuid(65534), 0);
  }
  const auto read = ReadBytes(folder / "a");
  if (root) {
    ASSERT_EQ(seteuid(0), 0);
  }
  ExpectCannotRead(read, "Permission denied");
}

TEST(ReadBytes, TooLargeIsAnErrorForFilesAndForEndlessDevices) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteBytes(folder / "a", "12345").empty());
  EXPECT_TRUE(ReadBytes(folder / "a", {.max_bytes = 5}).ok());
  ExpectCannotRead(ReadBytes(folder / "a", {.max_bytes = 4}), "larger than 4 bytes");
  ExpectCannotRead(ReadBytes("/dev/zero", {.max_bytes = 100000}), "larger than 100000 bytes");
}

TEST(ContentHash, EveryBitOfTheContentCounts) {
  const std::string bytes = RandomBytes(100, 2);
  const auto hash = ContentHash(bytes);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string other = bytes;
    other[bit / 8] = static_cast<char>(other[bit / 8] ^ (1 << (bit % 8)));
    const auto changed = ContentHash(other);
    EXPECT_NE(changed[0], hash[0]) << bit;
    EXPECT_NE(changed[1], hash[1]) << bit;
  }
}

TEST(ContentHash, ZerosAtTheEndCount) {
  std::string bytes;
  std::string previous = ContentHashText(bytes);
  for (int i = 0; i < 20; ++i) {
    bytes += '\0';
    const std::string text = ContentHashText(bytes);
    EXPECT_NE(text, previous);
    EXPECT_EQ(text.size(), 32U);
    previous = text;
  }
}

}  // namespace
}  // namespace lascaux
