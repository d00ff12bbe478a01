#pragma once

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

#include "io/file_writer.h"

namespace lascaux {

/// Gathers text and numbers and hands them on in pieces of about a megabyte.
class TextBatch {
 public:
  explicit TextBatch(FileWriter& file) : file_(file) { text_.reserve(kBatchBytes + 4096); }

  TextBatch& operator<<(std::string_view text) {
    text_ += text;
    if (text_.size() > kBatchBytes) Flush();
    return *this;
  }
  TextBatch& operator<<(const char* text) { return *this << std::string_view(text); }
  TextBatch& operator<<(char character) { return *this << std::string_view(&character, 1); }

  /// The shortest digits that read back as the same number.
  template <typename Number>
  requires std::is_arithmetic_v<Number> TextBatch& operator<<(Number number) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, number);
    return *this << std::string_view(digits, static_cast<std::size_t>(end.ptr - digits));
  }

  void Flush() {
    file_.Write(text_);
    text_.clear();
  }

 private:
  static constexpr std::size_t kBatchBytes = std::size_t{1} << 20;

  FileWriter& file_;
  std::string text_;
};

}  // namespace lascaux
