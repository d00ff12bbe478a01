#pragma once

#include <algorithm>

namespace lascaux {

/// What speaks for a role: measures and their limits. The role holds if all of them do.
///
/// The score is the clearance of the weakest one, from -1 to 1: how far the measure is beyond its
/// limit, as a share of the larger of both. 0 is the limit itself, 0.5 is twice or half of it, so
/// measures of all units can be compared, and a change of a limit by a fifth turns no role whose
/// score is 0.2 or more.
class Evidence {
 public:
  /// Both arguments at least 0; a measure below 0 counts as 0.
  Evidence& AtLeast(double measure, double limit) {
    score_ = std::min(score_, Clearance(measure, limit));
    return *this;
  }
  Evidence& AtMost(double measure, double limit) {
    score_ = std::min(score_, -Clearance(measure, limit));
    return *this;
  }
  /// Another score that has to hold, too.
  Evidence& And(double score) {
    score_ = std::min(score_, score);
    return *this;
  }

  double Score() const { return score_; }
  bool Holds() const { return score_ >= 0; }

 private:
  static double Clearance(double measure, double limit) {
    const double larger = std::max(measure, limit);
    return larger > 0 ? (std::max(measure, 0.0) - limit) / larger : 0;
  }

  double score_ = 1;
};

}  // namespace lascaux
