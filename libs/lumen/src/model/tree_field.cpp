#include "ostia/lumen/tree_field.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace ostia::lumen {
namespace {

// Places that are asked together: few enough to lie near one another, and to be one task of a branch's.
constexpr std::size_t batch = 128;
// Fewer places than this are not worth a thread of their own (who follows a wall asks for few at a time).
constexpr std::size_t field_places_per_task = 32 * batch;

// S of the header: how much of the fillet is taken, by the cosine between the walls' directions.
double share(double cosine) {
  const double t = std::clamp(1.0 - cosine, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}
double share_slope(double cosine) {
  const double t = std::clamp(1.0 - cosine, 0.0, 1.0);
  return -6.0 * t * (1.0 - t);
}

double cosine_between(const Vec3& a, const Vec3& b) {
  const double lengths = std::sqrt(a.squaredNorm() * b.squaredNorm());
  return lengths > 1e-12 ? std::clamp(a.dot(b) / lengths, -1.0, 1.0) : 1.0;
}

double arc(double a, double b, double width) {
  return width - std::hypot(width - a, width - b);
}

// How far out a branch's values tell the distance from its wall. A vessel's function that is a constant far
// from its samples does not rise above that, and waves a little about it.
double reach_of(const ScalarField& branch) {
  const auto* vessel = dynamic_cast<const ImplicitSurface*>(&branch);
  if (vessel == nullptr) return std::numeric_limits<double>::infinity();
  const auto& q = vessel->coefficients().polynomial;
  const bool constant = q[1] == 0.0 && q[2] == 0.0 && q[3] == 0.0;
  return constant ? 0.8 * std::max(q[0], 0.0) : std::numeric_limits<double>::infinity();
}

std::vector<std::shared_ptr<const ScalarField>> as_fields(
    const std::vector<std::shared_ptr<const ImplicitSurface>>& branches) {
  return {branches.begin(), branches.end()};
}

}  // namespace

double field_function(double f, double width_mm) {
  return std::clamp(0.5 * f / width_mm - 0.5, -1.0, 0.0);
}

/// The branches whose value at a place is below w, in the tree's order, and what the tree's is from these.
class TreeField::Near {
 public:
  Near(const TreeField& tree, const Vec3& place) : tree_(tree), place_(place) {}

  void add(std::size_t branch, double f) {
    if (!(f < tree_.blend_.width_mm)) {
      if (std::isnan(f)) value_ = f;
      return;
    }
    if (count_++ == 0)
      first_found_ = {branch, f};
    else
      others_.push_back({branch, f});
    value_ = std::min(value_, f);
  }

  // In mm, in [-w, w].
  double blended() {
    const double width = tree_.blend_.width_mm;
    if (std::isnan(value_)) return value_;
    value_ = std::min(value_, width);
    if (tree_.blend_.joints == JointShape::smooth && count_ > 1 && value_ > -width) blend_pairs();
    return std::max(value_, -width);
  }

  // Of blended(), per mm; to be called after it.
  Vec3 gradient() const {
    const double width = tree_.blend_.width_mm;
    if (count_ == 0 || !(value_ > -width)) return Vec3::Zero();
    if (first_ != second_) return pair_gradient(found(first_), found(second_));
    std::size_t least = 0;
    for (std::size_t i = 1; i < count_; ++i)
      if (found(i).f < found(least).f) least = i;
    return tree_.branches_[found(least).index]->gradient(place_);
  }

 private:
  struct Branch {
    std::size_t index = 0;
    double f = 0.0;
  };
  const Branch& found(std::size_t i) const { return i == 0 ? first_found_ : others_[i - 1]; }

  // The radius of the arc between two walls.
  double radius(const Branch& a, const Branch& b) const {
    return std::min(tree_.radii_[a.index], tree_.radii_[b.index]);
  }

  void blend_pairs() {
    std::vector<std::optional<Vec3>> slopes(count_);
    const auto slope = [&](std::size_t i) -> const Vec3& {
      if (!slopes[i]) slopes[i] = tree_.branches_[found(i).index]->gradient(place_);
      return *slopes[i];
    };
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t j = i + 1; j < count_; ++j) {
        const double width = radius(found(i), found(j));
        if (!(std::max(found(i).f, found(j).f) < width)) continue;
        const double m = std::min(found(i).f, found(j).f);
        const double r = arc(found(i).f, found(j).f, width);
        const double g = m - share(cosine_between(slope(i), slope(j))) * (m - r);
        if (!(g < value_)) continue;
        value_ = g;
        first_ = i;
        second_ = j;
      }
    }
  }

  Vec3 pair_gradient(const Branch& a, const Branch& b) const {
    const ScalarField &fa = *tree_.branches_[a.index], &fb = *tree_.branches_[b.index];
    const double width = radius(a, b), u = width - a.f, v = width - b.f;
    const Vec3 da = fa.gradient(place_), db = fb.gradient(place_);
    const double cosine = cosine_between(da, db), s = share(cosine), m = std::min(a.f, b.f);
    const Vec3 of_arc = (u * da + v * db) / std::max(std::hypot(u, v), 1e-12);
    const Vec3 of_least = a.f <= b.f ? da : db;
    Vec3 of_cosine = Vec3::Zero();
    const double slope = share_slope(cosine), step = 1e-4;
    if (slope != 0.0) {
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 aside = step * Vec3::Unit(axis);
        const double ahead = cosine_between(fa.gradient(place_ + aside), fb.gradient(place_ + aside));
        const double behind = cosine_between(fa.gradient(place_ - aside), fb.gradient(place_ - aside));
        of_cosine[axis] = (ahead - behind) / (2.0 * step);
      }
    }
    return (1.0 - s) * of_least + s * of_arc - (m - arc(a.f, b.f, width)) * slope * of_cosine;
  }

  const TreeField& tree_;
  const Vec3& place_;
  // Most places are near one branch or none: then nothing is allocated.
  std::size_t count_ = 0;
  Branch first_found_;
  std::vector<Branch> others_;
  double value_ = std::numeric_limits<double>::infinity();
  std::size_t first_ = 0, second_ = 0;  // the pair whose fillet it is; equal where it is one branch's wall
};

TreeField::TreeField(std::vector<std::shared_ptr<const ScalarField>> branches, const BlendOptions& blend)
    : branches_(std::move(branches)), blend_(blend) {
  if (branches_.empty()) throw InvalidInput("a tree's field needs at least one branch");
  if (!(blend.width_mm > 0.0 && blend.width_mm <= 2.0))
    throw InvalidInput("the blending width is " + std::to_string(blend.width_mm) +
                       " mm; give one above 0 and up to 2 mm");
  for (const auto& branch : branches_) {
    if (!branch) throw InvalidInput("a branch of the tree's field is missing");
    boxes_.push_back(branch->box());
    radii_.push_back(std::min(blend.width_mm, reach_of(*branch)));
  }
}

TreeField::TreeField(const std::vector<std::shared_ptr<const ImplicitSurface>>& branches,
                     const BlendOptions& blend)
    : TreeField(as_fields(branches), blend) {}

double TreeField::value(const Vec3& place) const {
  Near near(*this, place);
  for (std::size_t b = 0; b < branches_.size(); ++b)
    if (boxes_[b].contains(place)) near.add(b, branches_[b]->value(place));
  return near.blended() / (2.0 * blend_.width_mm);
}

Vec3 TreeField::gradient(const Vec3& place) const {
  Near near(*this, place);
  for (std::size_t b = 0; b < branches_.size(); ++b)
    if (boxes_[b].contains(place)) near.add(b, branches_[b]->value(place));
  near.blended();
  return near.gradient() / (2.0 * blend_.width_mm);
}

void TreeField::values(std::span<const Vec3> places, std::span<double> out) const {
  core::parallel_chunks(places.size(), field_places_per_task, [&](std::size_t first, std::size_t last) {
    for (std::size_t from = first; from < last; from += batch) {
      const std::size_t count = std::min(batch, last - from);
      batch_values(places.subspan(from, count), out.subspan(from, count));
    }
  });
}

void TreeField::batch_values(std::span<const Vec3> places, std::span<double> out) const {
  std::vector<Near> near;
  near.reserve(places.size());
  for (const Vec3& place : places) near.emplace_back(*this, place);
  std::vector<std::size_t> which;
  std::vector<Vec3> asked;
  std::vector<double> answers;
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    which.clear();
    asked.clear();
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!boxes_[b].contains(places[i])) continue;
      which.push_back(i);
      asked.push_back(places[i]);
    }
    if (asked.empty()) continue;
    answers.resize(asked.size());
    branches_[b]->values(asked, answers);
    for (std::size_t k = 0; k < which.size(); ++k) near[which[k]].add(b, answers[k]);
  }
  for (std::size_t i = 0; i < places.size(); ++i) out[i] = near[i].blended() / (2.0 * blend_.width_mm);
}

Box3 TreeField::box() const {
  Box3 all;
  for (const Box3& box : boxes_) all.extend(box);
  return all;
}

}  // namespace ostia::lumen
