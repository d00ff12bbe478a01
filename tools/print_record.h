#pragma once

#include <string>
#include <vector>

#include "lascaux/volume/print_options.h"

namespace lascaux {

/// A part that was thinner than was asked for.
struct ThickenedPart {
  std::string part;
  Wall thinnest;  ///< as it was
};

/// What was changed for printing, with the parts' names. Model frame.
struct PrintRecord {
  PrintChanges changes;
  std::vector<ThickenedPart> thickened;  ///< the thinnest first
};

}  // namespace lascaux
