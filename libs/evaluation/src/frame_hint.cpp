#include "ostia/evaluation/frame_hint.h"

#include "ostia/core/error.h"

#include <cmath>

namespace ostia::evaluation {
namespace {

using geometry::Box3;
using geometry::Vec3;

Box3 box_of(const std::vector<Vec3>& points, const char* what) {
  Box3 box;
  for (const Vec3& p : points) {
    if (!p.allFinite()) throw InvalidInput(std::string(what) + " has a point that is not finite");
    box.extend(p);
  }
  return box;
}

/// Shared length over joint length, averaged over the axes: 1 for equal boxes, 0 or less for distant ones.
double likeness(const Box3& a, const Box3& b) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double shared = std::min(a.max()[axis], b.max()[axis]) - std::max(a.min()[axis], b.min()[axis]);
    const double joint = std::max(a.max()[axis], b.max()[axis]) - std::min(a.min()[axis], b.min()[axis]);
    sum += joint > 0.0 ? shared / joint : 1.0;
  }
  return sum / 3.0;
}

Box3 mapped(const Box3& box, const Vec3& factors) {
  Box3 out;
  out.extend(Vec3(box.min().cwiseProduct(factors)));
  out.extend(Vec3(box.max().cwiseProduct(factors)));
  return out;
}

Box3 swapped(const Box3& box, int a, int b) {
  Vec3 low = box.min(), high = box.max();
  std::swap(low[a], low[b]);
  std::swap(high[a], high[b]);
  return {low, high};
}

}  // namespace

std::string hint_of_other_frame(const std::vector<Vec3>& reference, const std::vector<Vec3>& result) {
  if (reference.empty() || result.empty()) return {};
  const Box3 a = box_of(reference, "the reference"), b = box_of(result, "the result");
  constexpr double close = 0.5;  // the boxes of two results for one vessel share far more
  double best = std::max(likeness(a, b), 0.0);
  if (best > close) return {};
  std::string hint;
  const auto consider = [&](const Box3& tried, const std::string& text) {
    const double value = likeness(a, tried);
    if (value > close && value > best + 0.2) {
      best = value;
      hint = text;
    }
  };
  const struct {
    double factor;
    const char* unit;
  } units[] = {{10.0, "centimetre"}, {1000.0, "metre"}};
  for (const auto& [factor, unit] : units) {
    consider(mapped(b, Vec3::Constant(factor)), "the result is " + std::to_string(static_cast<int>(factor)) +
                                                    " times too small: its unit seems to be the " + unit);
    consider(mapped(b, Vec3::Constant(1.0 / factor)),
             "the result is " + std::to_string(static_cast<int>(factor)) +
                 " times too large: the reference's unit seems to be the " + unit);
  }
  consider(mapped(b, Vec3(-1.0, -1.0, 1.0)),
           "the two fit once x and y change sign: one is in RAS, the other in LPS");
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 factors = Vec3::Ones();
    factors[axis] = -1.0;
    consider(mapped(b, factors),
             std::string("the two fit once ") + "xyz"[axis] + " changes sign: one is mirrored");
    consider(swapped(b, axis, (axis + 1) % 3), std::string("the two fit once ") + "xyz"[axis] + " and " +
                                                   "xyz"[(axis + 1) % 3] + " are swapped");
  }
  return hint;
}

}  // namespace ostia::evaluation
