#include "lascaux/io/output_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <utility>
#include <vector>

#include "io/temporary_folder.h"

namespace lascaux {
namespace {

using Names = std::vector<std::string>;

void ExpectCannotWrite(const Diagnostics& diagnostics, const std::string& part) {
  ASSERT_EQ(diagnostics.size(), 1U);
  EXPECT_EQ(diagnostics[0].code, "cannot-write");
  EXPECT_EQ(diagnostics[0].failure, FailureKind::kOutput);
  EXPECT_NE(diagnostics[0].message.find(part), std::string::npos) << diagnostics[0].message;
}

/// Adds `target` and writes `text` to its temporary file.
void Put(OutputSet& files, const std::filesystem::path& target, const std::string& text) {
  const auto path = files.Add(target);
  ASSERT_TRUE(path.ok()) << path.diagnostics()[0].message;
  ASSERT_TRUE(WriteBytes(*path, text).empty());
}

TEST(OutputSet, NothingIsAtTheTargetsBeforeCommit) {
  const TemporaryFolder folder;
  OutputSet files;
  Put(files, folder / "a.vdb", "A");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.vdb"));
  EXPECT_TRUE(files.Commit().empty());
  EXPECT_EQ(Contents(folder / "a.vdb"), "A");
  EXPECT_EQ(folder.Names(), Names{"a.vdb"});
}

TEST(OutputSet, ASetThatIsDestroyedLeavesNothingAndChangesNothing) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteBytes(folder / "old.stl", "old").empty());
  {
    OutputSet files;
    Put(files, folder / "old.stl", "new");
    Put(files, folder / "new.vdb", "new");
  }
  EXPECT_EQ(folder.Names(), Names{"old.stl"});
  EXPECT_EQ(Contents(folder / "old.stl"), "old");
}

TEST(OutputSet, ReplacesOldFilesAndKeepsTheirRights) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteBytes(folder / "a", "old").empty());
  ASSERT_EQ(chmod((folder / "a").c_str(), 0640), 0);
  OutputSet files;
  Put(files, folder / "a", "new");
  Put(files, folder / "b", "B");
  EXPECT_TRUE(files.Commit().empty());
  EXPECT_EQ(Contents(folder / "a"), "new");
  EXPECT_EQ(folder.Names(), (Names{"a", "b"}));
  struct stat status;
  ASSERT_EQ(stat((folder / "a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0640U);
}

TEST(OutputSet, IfOneTargetFailsAllStayAsTheyWere) {
  // The last target becomes a folder between Add and Commit; then its own folder is lost.
  for (const bool lose_folder : {false, true}) {
    const TemporaryFolder folder;
    ASSERT_TRUE(WriteBytes(folder / "a", "old").empty());
    std::filesystem::create_directory(folder / "d");
    OutputSet files;
    Put(files, folder / "a", "new");
    Put(files, folder / "b", "B");
    ASSERT_TRUE(files.Add(folder / "d" / "c").ok());
    if (lose_folder) {
      std::filesystem::remove_all(folder / "d");
    } else {
      std::filesystem::create_directory(folder / "d" / "c");
    }
    ExpectCannotWrite(files.Commit(), "/c'");
    EXPECT_EQ(Contents(folder / "a"), "old");
    EXPECT_EQ(folder.Names(), lose_folder ? Names{"a"} : (Names{"a", "d"}));
  }
}

TEST(OutputSet, NothingIsSeenOfFilesThatAreBeingWritten) {
  const TemporaryFolder folder;
  OutputSet files;
  Put(files, folder / "a", "A");
  EXPECT_EQ(folder.Names(), Names{});  // on Linux's own file systems
}

TEST(OutputSet, WritesThroughALink) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteBytes(folder / "real", "old").empty());
  std::filesystem::create_symlink("real", folder / "link");
  OutputSet files;
  Put(files, folder / "link", "new");
  EXPECT_TRUE(files.Commit().empty());
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(Contents(folder / "real"), "new");
}

TEST(OutputSet, AMovedSetStillOwnsItsFiles) {
  const TemporaryFolder folder;
  OutputSet files;
  Put(files, folder / "a", "A");
  OutputSet other = std::move(files);
  EXPECT_TRUE(other.Commit().empty());
  EXPECT_EQ(folder.Names(), Names{"a"});
}

TEST(OutputSet, TakesNamesInTheCurrentFolderAndLongOnes) {
  const TemporaryFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  OutputSet files;
  Put(files, "bare.vdb", "A");
  Put(files, folder / std::string(255, 'x'), "long");
  EXPECT_TRUE(files.Commit().empty());
  std::filesystem::current_path(before);
  EXPECT_EQ(Contents(folder / "bare.vdb"), "A");
  EXPECT_EQ(Contents(folder / std::string(255, 'x')), "long");
}

TEST(OutputSet, RefusesWhatCannotBecomeAFile) {
  const TemporaryFolder folder;
  OutputSet files;
  ExpectCannotWrite(files.Add(folder / "missing/a.vdb").diagnostics(), "make the folder");
  ExpectCannotWrite(files.Add(folder.path()).diagnostics(), "a folder has this name");
  ExpectCannotWrite(files.Add("/dev/null").diagnostics(), "not an ordinary file");
  ExpectCannotWrite(files.Add(folder / std::string(300, 'x')).diagnostics(), "shorter name");
  ASSERT_TRUE(files.Add(folder / "a").ok());
  ExpectCannotWrite(files.Add(folder / "a").diagnostics(), "a name of its own");
  ExpectCannotWrite(files.Add(folder / "./a").diagnostics(), "a name of its own");
}

TEST(OutputSet, RefusesAFolderWithoutPermission) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteBytes(folder / "locked", "old").empty());
  ASSERT_EQ(chmod((folder / "locked").c_str(), 0444), 0);
  ASSERT_EQ(chmod(folder.path().c_str(), 0555), 0);
  const bool root = geteuid() == 0;  // whom nothing is forbidden
  if (root) {
    ASSERT_EQ(seteuid(65534), 0);
  }
  OutputSet files;
  const auto in_folder = files.Add(folder / "a");
  const auto over_file = files.Add(folder / "locked");
  if (root) {
    ASSERT_EQ(seteuid(0), 0);
  }
  chmod(folder.path().c_str(), 0755);
  ExpectCannotWrite(in_folder.diagnostics(), "may write to");
  ExpectCannotWrite(over_file.diagnostics(), "may write to");
}

TEST(WriteBytes, AFullDiskIsAnError) {
  ExpectCannotWrite(WriteBytes("/dev/full", "text"), "make room on the disk");
}

TEST(WriteBytes, ALimitOnFileSizesIsAnError) {
  const TemporaryFolder folder;
  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const Diagnostics diagnostics = WriteBytes(folder / "a", std::string(5000, 'x'));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  ExpectCannotWrite(diagnostics, "limit on file sizes");
}

TEST(WriteBytes, ReplacesWhatWasThere) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteBytes(folder / "a", "a long text").empty());
  ASSERT_TRUE(WriteBytes(folder / "a", "").empty());
  EXPECT_EQ(Contents(folder / "a"), "");
}

}  // namespace
}  // namespace lascaux
