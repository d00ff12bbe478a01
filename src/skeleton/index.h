#pragma once

#include <cstddef>

namespace lascaux {

/// Ids and counts are int and containers want std::size_t: the one place where a sign is given up.
constexpr std::size_t Index(int i) noexcept { return static_cast<std::size_t>(i); }

}  // namespace lascaux
