#include "lascaux/io/stream_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <string>

#include "io/temporary_folder.h"
#include "lascaux/io/output_file.h"

namespace lascaux {
namespace {

TEST(StreamFile, SendsWhatWasWrittenAsOftenAsItIsAsked) {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += std::to_string(i);  // more than a piece
  const StreamFile stream;
  const auto path = stream.path();
  ASSERT_TRUE(path.ok());
  ASSERT_TRUE(WriteBytes(*path, text).empty());
  for (const char* name : {"a", "b"}) {
    const int file = open((folder / name).c_str(), O_WRONLY | O_CREAT, 0600);
    EXPECT_TRUE(stream.SendTo(file).empty());
    close(file);
    EXPECT_TRUE(Contents(folder / name) == text);
  }
}

TEST(StreamFile, AFullDiskAndAReaderThatWentAwayAreErrors) {
  const StreamFile stream;
  ASSERT_TRUE(WriteBytes(*stream.path(), "text").empty());
  const int full = open("/dev/full", O_WRONLY);
  const Diagnostics no_room = stream.SendTo(full);
  close(full);
  ASSERT_EQ(no_room.size(), 1U);
  EXPECT_EQ(no_room[0].code, "cannot-write");
  EXPECT_NE(no_room[0].message.find("standard output"), std::string::npos);
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  const auto handler = std::signal(SIGPIPE, SIG_IGN);
  const Diagnostics gone = stream.SendTo(ends[1]);
  std::signal(SIGPIPE, handler);
  close(ends[1]);
  ASSERT_EQ(gone.size(), 1U);
  EXPECT_NE(gone[0].message.find("stopped before the end"), std::string::npos);
}

}  // namespace
}  // namespace lascaux
