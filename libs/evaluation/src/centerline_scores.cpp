#include "ostia/evaluation/centerline_scores.h"

#include "centerline_overlaps.h"

#include "ostia/core/error.h"
#include "ostia/geometry/kd_tree.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace ostia::evaluation {
namespace {

using geometry::Vec3;

constexpr double spacing_tolerance = 1e-3;
constexpr double most_times_longer = 50.0;
constexpr double no_score = std::numeric_limits<double>::quiet_NaN();

void require_line(const std::vector<Vec3>& points, const char* what) {
  if (points.size() < 2)
    throw InvalidInput(std::string(what) + " has " + std::to_string(points.size()) +
                       " points; a line needs at least two");
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].allFinite())
      throw InvalidInput(std::string("point ") + std::to_string(i) + " of " + what + " is not finite");
  if (!(geometry::length(points) > 0.0)) throw InvalidInput(std::string(what) + " has no length");
}

void require_reference(const io::RotterdamReference& reference) {
  require_line(reference.points, "the reference");
  if (reference.radius.size() != reference.points.size())
    throw InvalidInput("the reference has " + std::to_string(reference.radius.size()) + " radii for " +
                       std::to_string(reference.points.size()) + " points");
  for (const double r : reference.radius)
    if (!(r > 0.0) || !std::isfinite(r)) throw InvalidInput("a radius of the reference is not positive");
  if (!reference.observer_spread.empty() && reference.observer_spread.size() != reference.points.size())
    throw InvalidInput("the reference's observer spreads and points differ in number");
}

double mean_spacing(const std::vector<Vec3>& points) {
  return geometry::length(points) / static_cast<double>(points.size() - 1);
}

/// Points at equal steps as near to `spacing` as a whole number of them allows, both ends kept.
std::vector<Vec3> resampled(const std::vector<Vec3>& points, double spacing) {
  const std::vector<double> s = geometry::abscissas(points);
  const auto steps = static_cast<std::size_t>(std::max(1.0, std::round(s.back() / spacing)));
  std::vector<Vec3> out;
  std::size_t piece = 0;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double at = s.back() * static_cast<double>(i) / static_cast<double>(steps);
    while (piece + 2 < points.size() && s[piece + 1] < at) ++piece;
    const double length = s[piece + 1] - s[piece];
    const double t = length > 0.0 ? std::clamp((at - s[piece]) / length, 0.0, 1.0) : 0.0;
    out.push_back(points[piece] + t * (points[piece + 1] - points[piece]));
  }
  return out;
}

/// The first point behind the first passage through the disc at the reference's start; 0 without a passage.
std::size_t first_behind_disc(const std::vector<Vec3>& points, const io::RotterdamReference& reference) {
  const Vec3 centre = reference.points[0];
  const auto next = std::find_if(reference.points.begin(), reference.points.end(),
                                 [&](const Vec3& p) { return (p - centre).norm() > 0.0; });
  const Vec3 normal = (*next - centre).normalized();
  const double radius = 2.0 * reference.radius[0];
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double a = (points[i] - centre).dot(normal), b = (points[i + 1] - centre).dot(normal);
    if (!((a < 0.0 && b >= 0.0) || (a > 0.0 && b <= 0.0))) continue;
    const Vec3 passage = points[i] + a / (a - b) * (points[i + 1] - points[i]);
    if ((passage - centre).norm() <= radius) return i + 1;
  }
  return 0;
}

bool runs_backwards(const std::vector<Vec3>& points, const std::vector<Vec3>& reference) {
  const auto gap = [](const Vec3& a, const Vec3& b) { return (a - b).norm(); };
  return gap(points.front(), reference.back()) + gap(points.back(), reference.front()) <
         gap(points.front(), reference.front()) + gap(points.back(), reference.back());
}

void require_comparable_length(const std::vector<Vec3>& reference, const std::vector<Vec3>& candidate) {
  const double a = geometry::length(reference), b = geometry::length(candidate);
  if (b <= most_times_longer * a) return;
  throw InvalidInput(
      "the centerline is " + std::to_string(b) + " mm long, the reference " + std::to_string(a) +
      " mm, more than 50 times shorter: one of them seems to be in another unit; give both in mm");
}

/// The candidate turned, resampled and clipped, without pairs yet.
CenterlineScores prepared(const io::RotterdamReference& reference, const std::vector<Vec3>& candidate,
                          const CenterlineScoreOptions& options) {
  require_line(candidate, "the centerline");
  require_comparable_length(reference.points, candidate);
  CenterlineScores out;
  out.line = candidate;
  out.turned =
      options.direction == LineDirection::nearest_ends && runs_backwards(candidate, reference.points);
  if (out.turned) std::reverse(out.line.begin(), out.line.end());
  const double spacing = mean_spacing(reference.points);
  out.resampled = std::abs(mean_spacing(out.line) - spacing) > spacing_tolerance * spacing;
  if (out.resampled) out.line = resampled(out.line, spacing);
  if (options.clip) out.clipped_points = first_behind_disc(out.line, reference);
  out.line.erase(out.line.begin(), out.line.begin() + static_cast<std::ptrdiff_t>(out.clipped_points));
  return out;
}

/// One bit a cell: whether the best way there came from the reference's point before.
class Ways {
 public:
  Ways(std::size_t rows, std::size_t columns)
      : words_((columns + 63) / 64), bits_(rows * words_, std::uint64_t{0}) {}
  std::uint64_t* row(std::size_t i) { return bits_.data() + i * words_; }
  bool get(std::size_t i, std::size_t j) const { return (bits_[i * words_ + j / 64] >> (j % 64)) & 1u; }

 private:
  std::size_t words_;
  std::vector<std::uint64_t> bits_;
};

/// From the costs of the row before to those of this one; a tie goes on along the candidate.
void add_row(const std::vector<double>& distance, std::vector<double>& cost, std::uint64_t* from_above) {
  const std::size_t m = cost.size();
  double left = std::numeric_limits<double>::infinity();
  for (std::size_t first = 0; first < m; first += 64) {
    std::uint64_t bits = 0;
    const std::size_t last = std::min(m, first + 64);
    for (std::size_t j = first; j < last; ++j) {
      const double above = cost[j];
      bits |= std::uint64_t{above < left} << (j - first);
      left = std::min(above, left) + distance[j];
      cost[j] = left;
    }
    from_above[first / 64] = bits;
  }
}

std::vector<PointPair> paired(const std::vector<Vec3>& a, const std::vector<Vec3>& b,
                              const core::TaskContext& task) {
  const std::size_t n = a.size(), m = b.size();
  Ways from_above(n, m);
  std::vector<double> x(m), y(m), z(m), distance(m);
  std::vector<double> cost(m, std::numeric_limits<double>::infinity());
  cost[0] = 0.0;  // the way enters above the first cell
  for (std::size_t j = 0; j < m; ++j) {
    x[j] = b[j].x();
    y[j] = b[j].y();
    z[j] = b[j].z();
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (i % 64 == 0) {
      task.throw_if_cancelled();
      task.set_progress(static_cast<double>(i) / static_cast<double>(n));
    }
    const double ax = a[i].x(), ay = a[i].y(), az = a[i].z();
    for (std::size_t j = 0; j < m; ++j) {
      const double dx = x[j] - ax, dy = y[j] - ay, dz = z[j] - az;
      distance[j] = std::sqrt(dx * dx + dy * dy + dz * dz);
    }
    add_row(distance, cost, from_above.row(i));
  }
  std::vector<PointPair> pairs;
  std::size_t i = n - 1, j = m - 1;
  for (;;) {
    pairs.push_back({i, j, (a[i] - b[j]).norm(), false});
    if (i == 0 && j == 0) break;
    if (from_above.get(i, j)) {
      --i;
    } else {
      --j;
    }
  }
  std::reverse(pairs.begin(), pairs.end());
  return pairs;
}

void add_accuracy(const io::RotterdamReference& reference, CenterlineScores& scores) {
  double sum = 0.0, score = 0.0;
  std::size_t count = 0;
  for (const PointPair& p : scores.pairs) {
    if (!p.counts) continue;
    sum += p.distance_mm;
    if (!reference.observer_spread.empty())
      score += distance_score(p.distance_mm, reference.observer_spread[p.reference]);
    ++count;
  }
  scores.ai_mm = count > 0 ? sum / static_cast<double>(count) : no_score;
  scores.ai_score =
      count > 0 && !reference.observer_spread.empty() ? score / static_cast<double>(count) : no_score;
}

/// The OV that a line could have were each of its points free to choose its partner.
class OverlapBound {
 public:
  explicit OverlapBound(const io::RotterdamReference& reference)
      : reference_(reference),
        tree_(reference.points),
        widest_mm_(*std::max_element(reference.radius.begin(), reference.radius.end())) {}
  double of(const std::vector<Vec3>& line) const {
    const geometry::KdTree points(line);
    std::size_t matches = 0;
    for (std::size_t i = 0; i < reference_.points.size(); ++i)
      matches += nearest(points, reference_.points[i]) <= reference_.radius[i];
    for (const Vec3& p : line) matches += nearest(tree_, p) <= widest_mm_;
    return static_cast<double>(matches) / static_cast<double>(reference_.points.size() + line.size());
  }

 private:
  static double nearest(const geometry::KdTree& tree, const Vec3& p) {
    return (tree.points()[static_cast<std::size_t>(tree.nearest(p))] - p).norm();
  }
  const io::RotterdamReference& reference_;
  geometry::KdTree tree_;
  double widest_mm_;
};

bool better(const CenterlineScores& a, const CenterlineScores& b) {
  if (a.ov != b.ov) return a.ov > b.ov;
  return a.ai_mm < b.ai_mm;  // false where there is none
}

/// Pairs the prepared line and counts.
void score(const io::RotterdamReference& reference, const CenterlineScoreOptions& options,
           CenterlineScores& scores, const core::TaskContext& task) {
  scores.pairs = paired(reference.points, scores.line, task);
  for (PointPair& p : scores.pairs) p.counts = p.distance_mm <= reference.radius[p.reference];
  const OverlapCounts all = overlap_counts(scores.pairs, scores.pairs.size());
  scores.tpr = all.tpr;
  scores.fn = all.fn;
  scores.tpm = all.tpm;
  scores.fp = all.fp;
  scores.ov = all.overlap();
  scores.of = overlap_until_first_failure(reference, scores, options);
  scores.ot = overlap_where_wide(reference, scores.pairs, options);
  add_accuracy(reference, scores);
}

}  // namespace

void validate(const CenterlineScoreOptions& options) {
  if (!(options.least_radius_mm > 0.0)) throw InvalidInput("the least radius of OT must be positive");
  if (!(options.free_start_mm >= 0.0)) throw InvalidInput("the start that OF overlooks must not be negative");
}

CenterlineScores score_centerline(const io::RotterdamReference& reference, const std::vector<Vec3>& candidate,
                                  const CenterlineScoreOptions& options, const core::TaskContext& task) {
  validate(options);
  require_reference(reference);
  CenterlineScores scores = prepared(reference, candidate, options);
  score(reference, options, scores, task);
  task.set_progress(1.0);
  return scores;
}

std::vector<ReferencePointScore> along_reference(const io::RotterdamReference& reference,
                                                 const CenterlineScores& scores) {
  const std::vector<double> s = geometry::abscissas(reference.points);
  std::vector<ReferencePointScore> out;
  for (const double at : s) out.push_back({at, std::numeric_limits<double>::infinity(), false});
  for (const PointPair& p : scores.pairs) {
    if (p.reference >= out.size()) throw InvalidInput("the scores are those of another reference");
    ReferencePointScore& point = out[p.reference];
    point.distance_mm = std::min(point.distance_mm, p.distance_mm);
    point.matched = point.matched || p.counts;
  }
  return out;
}

BestLine score_best_line(const io::RotterdamReference& reference, const std::vector<NamedLine>& candidates,
                         const CenterlineScoreOptions& options, const core::TaskContext& task) {
  validate(options);
  require_reference(reference);
  if (candidates.empty()) throw InvalidInput("there is no line to score against the reference");
  struct Prepared {
    std::size_t index;
    double bound;
    CenterlineScores scores;
  };
  std::vector<Prepared> all;
  const OverlapBound bound(reference);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    task.throw_if_cancelled();
    CenterlineScores line = prepared(reference, candidates[i].points, options);
    all.push_back({i, bound.of(line.line), std::move(line)});
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.bound > b.bound; });
  Prepared* best = nullptr;
  for (std::size_t k = 0; k < all.size(); ++k) {
    Prepared& tried = all[k];
    if (best && tried.bound < best->scores.ov) break;
    const auto n = static_cast<double>(all.size()), from = static_cast<double>(k);
    score(reference, options, tried.scores, task.sub(from / n, (from + 1.0) / n));
    if (!best || better(tried.scores, best->scores)) best = &tried;
  }
  task.set_progress(1.0);
  return {best->index, std::move(best->scores)};
}

MeanCenterlineScores mean_scores(const std::vector<CenterlineScores>& vessels) {
  if (vessels.empty()) throw InvalidInput("there is no vessel to average over");
  const auto mean = [&](double CenterlineScores::*score) {
    double sum = 0.0;
    int count = 0;
    for (const CenterlineScores& v : vessels) {
      if (std::isnan(v.*score)) continue;
      sum += v.*score;
      ++count;
    }
    return count > 0 ? sum / count : no_score;
  };
  MeanCenterlineScores out;
  out.vessels = vessels.size();
  for (const CenterlineScores& v : vessels) out.missed += !(v.ov > 0.0);
  out.ov = mean(&CenterlineScores::ov);
  out.of = mean(&CenterlineScores::of);
  out.ot = mean(&CenterlineScores::ot);
  out.ai_mm = mean(&CenterlineScores::ai_mm);
  out.ai_score = mean(&CenterlineScores::ai_score);
  return out;
}

double overlap_score(double overlap, double observer_overlap) {
  for (const double o : {overlap, observer_overlap})
    if (!(o >= 0.0 && o <= 1.0))
      throw InvalidInput("an overlap lies in [0, 1]; " + std::to_string(o) + " does not");
  if (overlap >= 0.9995) return 100.0;
  if (overlap <= observer_overlap) return observer_overlap > 0.0 ? 50.0 * overlap / observer_overlap : 0.0;
  return 50.0 + 50.0 * (overlap - observer_overlap) / (1.0 - observer_overlap);
}

double distance_score(double distance_mm, double observer_spread_mm) {
  if (!(distance_mm >= 0.0) || !(observer_spread_mm >= 0.0))
    throw InvalidInput("a distance and the observers' spread must not be negative (mm)");
  if (distance_mm <= observer_spread_mm)
    return observer_spread_mm > 0.0 ? 100.0 - 50.0 * distance_mm / observer_spread_mm : 100.0;
  return 50.0 * observer_spread_mm / distance_mm;
}

}  // namespace ostia::evaluation
