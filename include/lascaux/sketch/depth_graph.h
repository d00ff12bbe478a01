#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/sketch/parts.h"

/// @file
/// Which part is the body, which are pairs, and which lies over which.
///
/// Source: Entem et al. 2015, sections 5.1 and 5.2.

namespace lascaux {

/// How many of a part are built: the body and sagittal parts one in the plane; foreground parts and
/// islands two, the drawn one and its mirror image; background parts none of their own. kNone:
/// ignored (a fold line's crumb, a void).
enum class PartRole : std::uint8_t {
  kBody,
  kForeground,
  kBackground,
  kSagittal,
  kIsland,
  kIgnored
};

/// A part's relation to its parent.
enum class Relation : std::uint8_t { kNone, kOver, kUnder, kAdjacent, kOverIn };

/// How well a part's role is borne out, and what it would be otherwise. A score is the clearance of
/// the weakest evidence (Part::score), below 0 if that does not hold; a role that needs none, as to
/// lie in the plane or to be left in its parent, has 0. The body has 1, the next best candidate its
/// share of the body's score.
struct RoleChoice {
  double score = 0;
  PartRole runner_up = PartRole::kSagittal;
  double runner_up_score = 0;

  double Margin() const { return score - runner_up_score; }
  bool operator==(const RoleChoice&) const = default;
};

/// One node of the depth graph; node i belongs to Parts::parts[i].
struct DepthNode {
  PartRole role = PartRole::kSagittal;
  std::optional<int>
      parent;  ///< the part that it is placed by; none for the body and ignored parts
  Relation relation = Relation::kNone;
  std::optional<int>
      pair;  ///< foreground: its drawn far part, if any; background: its near partner
  /// Background parts that are hidden in between show in several pieces: all but the first name the
  /// first here, and are no part by themselves.
  std::optional<int> piece_of;
  bool flat = false;  ///< thinner than wide; only options.overrides say so
  /// None for islands, ignored parts, and roles that options.overrides gave.
  std::optional<RoleChoice> choice;
  std::string name;  ///< "body", "limb-1", "limb-1-far", "eye-6", "part-5": unique

  bool operator==(const DepthNode&) const = default;
};

/// The depth graph: a tree towards the body, plus pairs. `order` lists the parts so that parents
/// come first.
struct DepthGraph {
  std::vector<DepthNode> nodes;
  int body = 0;
  double body_margin = 0;  ///< score of the body over the next best candidate, relative, 0 to 1
  std::vector<int> order;

  bool operator==(const DepthGraph&) const = default;
};

/// A part by its id, or the smallest part around a point in sketch units.
using PartReference = std::variant<int, Eigen::Vector2d>;

/// What a part is, when the rules are wrong about it.
struct PartOverride {
  PartReference part;
  std::optional<PartRole> role;       ///< foreground, background, sagittal or ignored
  std::optional<PartReference> near;  ///< for background: the foreground part that it belongs to
  bool flat = false;                  ///< thinner than wide: a wing, a fin, an ear

  bool operator==(const PartOverride&) const = default;
};

struct OrderByDepthOptions {
  std::optional<Eigen::Vector2d>
      body;  ///< a point in the torso, in sketch units, when the automatic choice is wrong
  std::optional<int> body_part;         ///< the torso by its id instead
  std::vector<PartOverride> overrides;  ///< applied in this order, after the rules

  bool operator==(const OrderByDepthOptions&) const = default;
};

/// Finds the body, the pairs and the relations between parts (docs/structure.md has the rules).
///
/// Errors: "no-body" (understanding), when nothing can be one; "body-not-there" (understanding),
/// when options.body or body_part is no part that could be one; "override-not-there"
/// (understanding), when an override names no part, the body, or a near side that is not in the
/// foreground.
Outcome<DepthGraph> OrderByDepth(const PlanarMap& map, const Parts& parts,
                                 const OrderByDepthOptions& options = {},
                                 const Execution& execution = {});

/// "body", "foreground", "background", "sagittal", "island", "ignored".
const char* Name(PartRole role) noexcept;
/// "over", "under", "adjacent", "over-in"; "none" for the body.
const char* Name(Relation relation) noexcept;

}  // namespace lascaux
