#include "lascaux/io/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <string>
#include <utility>
#include <vector>

#include "io/output_error.h"

namespace lascaux {
namespace {

namespace fs = std::filesystem;

/// One output.
struct Entry {
  fs::path target;
  fs::path temporary;   ///< what to write to
  int descriptor = -1;  ///< of a temporary file that has no name; -1 when it has one
  fs::path backup;      ///< the old file's second name while targets are being replaced
  bool replaced = false;
};

/// A name beside `target` that nobody else uses: short, since the target's own may be as long as
/// names can be.
fs::path NameBeside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  return target.parent_path() /
         (".lascaux-" + std::to_string(getpid()) + "-" + std::to_string(counter++) + ".tmp");
}

/// What stands in the way of writing to `target` as an error number; 0 for nothing, with the rights
/// in `status` if it exists.
int Obstacle(const fs::path& target, struct stat& status) {
  status = {};
  if (stat(target.c_str(), &status) != 0) {
    status.st_mode = 0;
    return errno == ENOENT ? 0 : errno;
  }
  if (S_ISDIR(status.st_mode)) return EISDIR;
  // Renaming over /dev/null would replace the device.
  if (!S_ISREG(status.st_mode)) return ENOTSUP;
  return access(target.c_str(), W_OK) == 0 ? 0 : errno;
}

/// Creates a temporary file without a name in the target's folder, which is gone when the program
/// is, even when it is killed. False where the file system has none.
bool CreateNameless(Entry& entry, mode_t rights) {
  const fs::path folder = entry.target.has_parent_path() ? entry.target.parent_path() : ".";
  const int descriptor = open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0) return false;
  if (rights != 0) static_cast<void>(fchmod(descriptor, rights));
  entry.temporary = "/proc/self/fd/" + std::to_string(descriptor);
  if (access(entry.temporary.c_str(), W_OK) != 0) {  // there is no /proc
    close(descriptor);
    return false;
  }
  entry.descriptor = descriptor;
  return true;
}

/// Creates the empty temporary file of an entry; an error number, 0 for done.
int Create(Entry& entry, mode_t rights) {
  if (CreateNameless(entry, rights)) return 0;
  for (;;) {
    entry.temporary = NameBeside(entry.target);
    const int descriptor =
        open(entry.temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    // A killed run with our process id may have left one.
    if (descriptor < 0 && errno == EEXIST) continue;
    if (descriptor < 0) return errno;
    // Best effort: on file systems without rights the file is right as it is.
    if (rights != 0) static_cast<void>(fchmod(descriptor, rights));
    return close(descriptor) == 0 ? 0 : errno;
  }
}

/// Gives a complete temporary file a name, if it has none; an error number, 0 for done.
int GiveName(Entry& entry) {
  while (entry.descriptor >= 0) {
    const fs::path name = NameBeside(entry.target);
    if (linkat(AT_FDCWD, entry.temporary.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) {
      close(std::exchange(entry.descriptor, -1));
      entry.temporary = name;
    } else if (errno != EEXIST) {
      return errno;
    }
  }
  return 0;
}

/// Gives the old file at the target a second name; an error number, 0 for done or for nothing
/// there.
int KeepOld(Entry& entry) {
  struct stat status;
  if (const int error = Obstacle(entry.target, status); error != 0) return error;
  if (status.st_mode == 0) return 0;
  fs::path backup = NameBeside(entry.target);
  // File systems without hard links have to do without the old file for a moment.
  if (link(entry.target.c_str(), backup.c_str()) != 0 &&
      rename(entry.target.c_str(), backup.c_str()) != 0) {
    return errno;
  }
  entry.backup = std::move(backup);
  return 0;
}

void PutBack(const Entry& entry) {
  if (!entry.backup.empty()) {
    // Where both names are links to one file rename() does nothing and leaves both.
    rename(entry.backup.c_str(), entry.target.c_str());
    unlink(entry.backup.c_str());
  } else if (entry.replaced) {
    unlink(entry.target.c_str());
  }
}

}  // namespace

struct OutputSet::State {
  std::vector<Entry> entries;

  ~State() {
    for (const Entry& entry : entries) {
      if (entry.descriptor >= 0)
        close(entry.descriptor);
      else
        unlink(entry.temporary.c_str());
    }
  }
};

OutputSet::OutputSet() : state_(std::make_unique<State>()) {}
OutputSet::~OutputSet() = default;
OutputSet::OutputSet(OutputSet&&) noexcept = default;
OutputSet& OutputSet::operator=(OutputSet&&) noexcept = default;

Outcome<fs::path> OutputSet::Add(const fs::path& target) {
  using Result = Outcome<fs::path>;
  struct stat status;
  if (const int error = Obstacle(target, status); error != 0) {
    return Result::Failure(CannotWrite(target, error));
  }
  // The file behind a link is replaced, not the link; and one file by two names is one target.
  std::error_code ignored;
  Entry entry{fs::weakly_canonical(target, ignored), {}, -1, {}, false};
  if (entry.target.empty()) entry.target = target;
  const auto same = [&](const Entry& other) { return other.target == entry.target; };
  if (std::any_of(state_->entries.begin(), state_->entries.end(), same)) {
    return Result::Failure(CannotWrite(target, EEXIST));
  }
  if (const int error = Create(entry, status.st_mode & 0777); error != 0) {
    return Result::Failure(CannotWrite(target, error));
  }
  state_->entries.push_back(std::move(entry));
  return state_->entries.back().temporary;
}

Diagnostics OutputSet::Commit() {
  const std::unique_ptr<State> state = std::exchange(state_, std::make_unique<State>());
  const auto fail = [&](const Entry& entry, int error) {
    for (const Entry& each : state->entries) PutBack(each);
    return Diagnostics{CannotWrite(entry.target, error)};
  };
  for (Entry& entry : state->entries) {
    if (const int error = GiveName(entry); error != 0) return fail(entry, error);
  }
  for (Entry& entry : state->entries) {
    if (const int error = KeepOld(entry); error != 0) return fail(entry, error);
  }
  for (Entry& entry : state->entries) {
    if (rename(entry.temporary.c_str(), entry.target.c_str()) != 0) return fail(entry, errno);
    entry.replaced = true;
  }
  // Side by side: to drop a large file's pages takes longer than to write many a small one.
  tbb::parallel_for(std::size_t{0}, state->entries.size(), [&](std::size_t i) {
    const fs::path& backup = state->entries[i].backup;
    if (!backup.empty()) unlink(backup.c_str());
  });
  // Their names are free now: another set may use them.
  state->entries.clear();
  return {};
}

Diagnostics InNameOf(const fs::path& target, const fs::path& written, Diagnostics found) {
  for (Diagnostic& diagnostic : found) {
    std::string& text = diagnostic.message;
    if (const std::size_t at = text.find(written.string()); at != std::string::npos)
      text.replace(at, written.string().size(), target.string());
  }
  return found;
}

}  // namespace lascaux
