#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace lascaux {

/// Names on the command line, and what they stand for.
template <typename T>
using Choices = std::vector<std::pair<std::string, T>>;

/// Adds an option that takes one of some names. (CLI11's own transformers would show the values in
/// the help, those of small enums as control characters.)
template <typename T>
CLI::Option* AddChoice(CLI::App& app, const std::string& name, T& value, const Choices<T>& choices,
                       const std::string& description) {
  const auto set = [name, &value, choices](const std::string& text) {
    const auto found = std::find_if(choices.begin(), choices.end(),
                                    [&text](const auto& choice) { return choice.first == text; });
    if (found == choices.end()) {
      std::string names;
      for (const auto& choice : choices) names += (names.empty() ? "" : ", ") + choice.first;
      throw CLI::ValidationError(name, "'" + text + "' is none of " + names);
    }
    value = found->second;
  };
  return app.add_option_function<std::string>(name, set, description);
}

}  // namespace lascaux
