#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lascaux {

/// A ZIP archive in memory, where it cannot fail half-way. The same entries give the same bytes:
/// all have the earliest date that the format can say.
class ZipWriter {
 public:
  ZipWriter();
  ~ZipWriter();
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;

  /// Adds a file, deflated. `name` has forward slashes and is not in the archive yet.
  void Add(const std::string& name, std::string_view content);

  /// Ends the archive and returns its bytes; empty when it is too large for the format's numbers.
  std::optional<std::string> Finish();

 private:
  std::string bytes_;
  std::size_t position_ = 0;
  void* archive_ = nullptr;
  bool good_ = true;

  struct Callbacks;
};

}  // namespace lascaux
