#include "lascaux/io/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
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

/// One output. `backup` is the old file's second name while targets are being replaced, empty where
/// there was none.
struct Entry {
  fs::path target;
  fs::path temporary;
  fs::path backup;
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

/// Creates the empty temporary file of an entry; an error number, 0 for done.
int Create(Entry& entry, mode_t rights) {
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
    for (const Entry& entry : entries) unlink(entry.temporary.c_str());
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
  Entry entry{fs::weakly_canonical(target, ignored), {}, {}, false};
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
    if (const int error = KeepOld(entry); error != 0) return fail(entry, error);
  }
  for (Entry& entry : state->entries) {
    if (rename(entry.temporary.c_str(), entry.target.c_str()) != 0) return fail(entry, errno);
    entry.replaced = true;
  }
  for (Entry& entry : state->entries) {
    if (!entry.backup.empty()) unlink(entry.backup.c_str());
  }
  // Their names are free now: another set may use them.
  state->entries.clear();
  return {};
}

}  // namespace lascaux
