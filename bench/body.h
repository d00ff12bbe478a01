#pragma once

#include <string>

#include "lascaux/field/field.h"

/// How the parts of a benchmark's body are put together.
enum class BodyBlend {
  kParts,    ///< each blends with the first, as a creature's limbs do with its body
  kPlainSum  ///< one sum of all segments: what the peers can do, too
};

/// A body from a file: a line "ax ay az ra  bx by bz rb  part" a segment. Without parts when there
/// is no such file.
lascaux::Field ReadBody(const std::string& path, BodyBlend blend);
