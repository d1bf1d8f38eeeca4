#pragma once
/// \file How a centerline does against a reference, as the Rotterdam challenge scores it (Schaap et al.,
/// Medical Image Analysis 13:701-714, 2009).

#include "ostia/core/task_context.h"
#include "ostia/geometry/vec.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/io/rotterdam_file.h"

#include <cstddef>
#include <string>
#include <vector>

namespace ostia::evaluation {

/// Which end of the candidate is taken as the proximal one.
enum class LineDirection {
  nearest_ends,  ///< turned round where its ends then lie nearer to the reference's ends (in sum)
  as_given       ///< the challenge's rule: a line written from its distal end loses
};

/// How OF and OT are read where the paper's words leave room. OV and AI are the same by both.
enum class OverlapRules {
  /// As the challenge's own program counts. OF: the points of the reference before the one at which a pair
  /// fails first, be it a pair of a candidate that strays and comes back, or that goes on beyond the end. OT:
  /// the pairs up to the first one that reaches the last point that is wide enough; what else the candidate
  /// has there or beyond does not count.
  challenge,
  /// The paper's words. OF: the points before the first one none of whose pairs counts. OT: all pairs of the
  /// points up to the last one that is wide enough.
  paper
};

struct CenterlineScoreOptions {
  double least_radius_mm = 0.75;  ///< OT goes to the last reference point that is no thinner, > 0
  double free_start_mm = 0.0;     ///< OF overlooks failing points this near the start (the challenge: 5 mm)
  bool clip = true;               ///< cut the line with a disc at the reference's first point
  LineDirection direction = LineDirection::nearest_ends;
  OverlapRules rules = OverlapRules::challenge;
};
void validate(const CenterlineScoreOptions& options);

/// A pair of points that the dynamic programme brings together.
struct PointPair {
  std::size_t reference = 0, candidate = 0;  ///< indices; the candidate's into CenterlineScores::line
  double distance_mm = 0.0;
  bool counts = false;  ///< no longer than the reference's radius there
};

struct CenterlineScores {
  double ov = 0.0;     ///< overlap, in [0, 1]
  double of = 0.0;     ///< share of the reference's points that are matched before the first failure
  double ot = 0.0;     ///< overlap of what is 1.5 mm wide and more; NaN where the vessel is nowhere so wide
  double ai_mm = 0.0;  ///< mean length of the pairs that count; NaN where none does
  double ai_score = 0.0;        ///< mean over the pairs that count of `distance_score`; NaN where none does
  std::size_t tpr = 0, fn = 0;  ///< points of the reference that are matched, and missed
  std::size_t tpm = 0, fp = 0;  ///< points of the candidate that match, and do not
  bool resampled = false;       ///< the candidate's spacing was not the reference's
  bool turned = false;          ///< the candidate ran from its distal to its proximal end
  std::size_t clipped_points = 0;    ///< cut off at the start, after resampling
  std::vector<geometry::Vec3> line;  ///< the candidate as it was scored: turned, resampled, clipped
  std::vector<PointPair> pairs;      ///< from the first points to the last ones
};

/// The two lines are paired by the monotone path (a step goes on by one point in one of them) of least summed
/// distance. Before that the candidate is resampled to the reference's mean spacing where it is off by more
/// than 0.1 %, and what lies before its first passage through the disc (normal to the reference's first step,
/// of twice its first radius) is cut off. A point is matched where one of its pairs counts. Points of the
/// reference that repeat the one before are points like others. Memory: one bit for each pair of points.
/// Throws InvalidInput for lines of fewer than two points, points that are not finite, radii that are not
/// positive, and a candidate more than 50 times as long as the reference (other units).
CenterlineScores score_centerline(const io::RotterdamReference& reference,
                                  const std::vector<geometry::Vec3>& candidate,
                                  const CenterlineScoreOptions& options = {},
                                  const core::TaskContext& task = core::no_task());

/// What happens along the reference, for plots.
struct ReferencePointScore {
  double s_mm = 0.0;         ///< along the reference from its first point
  double distance_mm = 0.0;  ///< the shortest of the point's pairs
  bool matched = false;      ///< true positive; else missed
};
/// One for each point of the reference.
std::vector<ReferencePointScore> along_reference(const io::RotterdamReference& reference,
                                                 const CenterlineScores& scores);

/// A line that may be the one asked for.
struct NamedLine {
  std::string name;
  std::vector<geometry::Vec3> points;
};
/// The lines of a tree that may stand for a vessel: the path from the root to each end, named after the
/// vessel that ends there ("end 7" without one), then the axes of vessels that are no such path.
std::vector<NamedLine> lines_of(const geometry::VesselTree& tree);

struct BestLine {
  std::size_t index = 0;  ///< into the candidates
  CenterlineScores scores;
};
/// The candidate of the largest OV (of equal ones the smaller AI, then the earlier). An upper bound of each
/// candidate's OV spares the pairing of those that cannot win. Throws InvalidInput as score_centerline does,
/// and where there is no candidate.
BestLine score_best_line(const io::RotterdamReference& reference, const std::vector<NamedLine>& candidates,
                         const CenterlineScoreOptions& options = {},
                         const core::TaskContext& task = core::no_task());

/// Averages over vessels, each of the same weight; of OT, AI and the AI score over those that have one.
struct MeanCenterlineScores {
  std::size_t vessels = 0;
  std::size_t missed = 0;  ///< vessels without a pair that counts: OV = 0
  double ov = 0.0, of = 0.0, ot = 0.0, ai_mm = 0.0, ai_score = 0.0;
};
/// Throws InvalidInput without vessels.
MeanCenterlineScores mean_scores(const std::vector<CenterlineScores>& vessels);

/// 50 O / O_obs up to the observer's overlap, 50 + 50 (O - O_obs) / (1 - O_obs) above it; 100 from 99.95 %
/// on. Throws InvalidInput for overlaps outside [0, 1].
double overlap_score(double overlap, double observer_overlap);
/// 100 - 50 d / io where d <= io, 50 io / d above. Throws InvalidInput for negative lengths or NaN.
double distance_score(double distance_mm, double observer_spread_mm);

}  // namespace ostia::evaluation
