#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lascaux {

/// The content of one file of a ZIP archive in memory; empty when it is not there, is damaged (its
/// checksum is looked at), is encrypted or unpacks to more than `max_bytes`. Names are compared
/// without regard to case, as the Open Packaging Conventions want it.
std::optional<std::string> Unzip(std::string_view archive, const std::string& name,
                                 std::size_t max_bytes);

}  // namespace lascaux
