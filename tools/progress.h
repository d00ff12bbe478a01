#pragma once

#include <cstdio>
#include <functional>
#include <string>
#include <string_view>

namespace lascaux {

/// One line on a terminal that says what is going on. Writes nothing to a pipe or a file.
class ProgressLine {
 public:
  /// Shows progress on `stream` when it is a terminal that can move its cursor; nullptr: never.
  explicit ProgressLine(std::FILE* stream);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// A callback for Execution::progress that writes "name: stage"; empty when there is nothing to
  /// show it on. It must not outlive this object.
  std::function<void(std::string_view, double)> Callback(std::string name);

  /// Wipes the line, so that a message can be written in its place.
  void Clear();

 private:
  std::FILE* stream_;
  bool shown_ = false;
  bool dirty_ = false;
};

}  // namespace lascaux
