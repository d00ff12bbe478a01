#include "skeleton/check_creature.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace lascaux {
namespace {

/// Collects findings about one creature.
class CreatureChecker {
 public:
  CreatureChecker(const Parts& parts, const Creature& creature)
      : parts_(parts), creature_(creature) {}

  Diagnostics Run() {
    for (std::size_t i = 0; i < creature_.parts.size(); ++i) {
      const CreaturePart& part = creature_.parts[i];
      where_ = fmt::format("part {}", part.part);
      CheckLinks(part, static_cast<int>(i));
      if (part.chains.empty()) Report("has no disc");
      CheckDiscs("chain", part.chains);
      CheckDiscs("axis", part.axis);
    }
    return std::move(found_);
  }

 private:
  void Report(const std::string& what) {
    found_.push_back(Error(FailureKind::kBug, "bad-primitive",
                           where_ + " " + what + "; leave it out or give it a proper size"));
  }

  void CheckLinks(const CreaturePart& part, int index) {
    if (part.part < 0 || part.part >= static_cast<int>(parts_.parts.size())) {
      Report(fmt::format("is not among the {} parts of the drawing", parts_.parts.size()));
    }
    if (part.parent && (*part.parent < 0 || *part.parent >= index)) {
      Report("has a parent that is not an earlier part");
    }
  }

  void CheckDiscs(const char* name, const std::vector<Chain>& chains) {
    for (std::size_t c = 0; c < chains.size(); ++c) {
      if (chains[c].vertices.empty()) Report(fmt::format("has no disc in {} {}", name, c));
      for (std::size_t k = 0; k < chains[c].vertices.size(); ++k) {
        const SkeletonVertex& disc = chains[c].vertices[k];
        if (disc.position.allFinite() && std::isfinite(disc.radius) && disc.radius > 0) continue;
        Report(fmt::format("has a disc ({} {}, number {}) at ({}, {}) with a radius of {}", name, c,
                           k, disc.position.x(), disc.position.y(), disc.radius));
      }
    }
  }

  const Parts& parts_;
  const Creature& creature_;
  std::string where_;
  Diagnostics found_;
};

}  // namespace

Diagnostics CheckCreature(const Parts& parts, const Creature& creature) {
  return CreatureChecker(parts, creature).Run();
}

}  // namespace lascaux
