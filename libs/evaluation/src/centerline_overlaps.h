#pragma once
/// \file Overlaps of two lines whose points are paired already.

#include "ostia/evaluation/centerline_scores.h"

namespace ostia::evaluation {

struct OverlapCounts {
  std::size_t tpr = 0, fn = 0;  ///< points of the reference that are matched, and missed
  std::size_t tpm = 0, fp = 0;  ///< points of the candidate that match, and do not
  double overlap() const;       ///< 0 without points
};

/// Which points of either line have a pair that counts among the first `count` pairs.
OverlapCounts overlap_counts(const std::vector<PointPair>& pairs, std::size_t count);

/// OF: the share of the reference before the first failure, by the rules of `options`.
double overlap_until_first_failure(const io::RotterdamReference& reference, const CenterlineScores& scores,
                                   const CenterlineScoreOptions& options);

/// OT: the overlap up to the last point of the reference that is wide enough; NaN where none is.
double overlap_where_wide(const io::RotterdamReference& reference, const std::vector<PointPair>& pairs,
                          const CenterlineScoreOptions& options);

}  // namespace ostia::evaluation
