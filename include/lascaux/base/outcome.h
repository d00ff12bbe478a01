#pragma once

#include <cassert>
#include <iterator>
#include <optional>
#include <utility>

#include "lascaux/base/diagnostic.h"

/// @file
/// The result of a stage: a value, if there is one, with the diagnostics found on the way.

namespace lascaux {

/// Either a value (diagnostics hold notes and warnings) or none (they hold at least one error).
///
/// Bad input is an outcome, never an exception; a broken precondition is an assert.
template <typename T>
class [[nodiscard]] Outcome {
 public:
  /// A result, with what was noticed while making it.
  Outcome(T value, Diagnostics diagnostics = {})  // NOLINT(google-explicit-constructor)
      : value_(std::move(value)), diagnostics_(std::move(diagnostics)) {}

  /// No result, and why.
  static Outcome Failure(Diagnostics diagnostics) {
    assert(HasError(diagnostics));
    return Outcome(std::nullopt, std::move(diagnostics));
  }
  static Outcome Failure(Diagnostic error) { return Failure(Diagnostics{std::move(error)}); }

  bool ok() const noexcept { return value_.has_value(); }
  explicit operator bool() const noexcept { return ok(); }

  const T& operator*() const& { return assert(ok()), *value_; }
  T& operator*() & { return assert(ok()), *value_; }
  T&& operator*() && { return assert(ok()), std::move(*value_); }
  const T* operator->() const { return assert(ok()), &*value_; }
  T* operator->() { return assert(ok()), &*value_; }

  const Diagnostics& diagnostics() const noexcept { return diagnostics_; }

  /// The value, if there is one; the diagnostics are moved to the end of `log`.
  std::optional<T> MoveInto(Diagnostics& log) && {
    log.insert(log.end(), std::make_move_iterator(diagnostics_.begin()),
               std::make_move_iterator(diagnostics_.end()));
    return std::move(value_);
  }

 private:
  Outcome(std::nullopt_t, Diagnostics diagnostics) : diagnostics_(std::move(diagnostics)) {}

  std::optional<T> value_;
  Diagnostics diagnostics_;
};

}  // namespace lascaux
