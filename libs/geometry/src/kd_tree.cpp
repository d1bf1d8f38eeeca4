#include "ostia/geometry/kd_tree.h"

#include "ostia/core/error.h"

#include <nanoflann.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace ostia::geometry {
namespace {

struct Cloud {
  std::vector<Vec3> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t index, std::size_t dimension) const {
    return points[index][static_cast<Eigen::Index>(dimension)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3, std::uint32_t>;

void check_query(const Vec3& query) {
  if (!query.allFinite())
    throw InvalidInput("k-d tree: the query point has a coordinate that is not a finite number");
}

Cloud checked(std::vector<Vec3> points) {
  if (points.empty()) throw InvalidInput("k-d tree: the point cloud is empty; give it at least one point");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      throw InvalidInput("k-d tree: point " + std::to_string(i) + " of " + std::to_string(points.size()) +
                         " has a coordinate that is not a finite number; remove it first");
    }
  }
  return Cloud{std::move(points)};
}

}  // namespace

struct KdTree::Impl {
  explicit Impl(std::vector<Vec3> points)
      : cloud(checked(std::move(points))), tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(12)) {}
  Cloud cloud;
  Tree tree;
};

KdTree::KdTree(std::vector<Vec3> points) : impl_(std::make_unique<Impl>(std::move(points))) {}
KdTree::~KdTree() = default;
KdTree::KdTree(KdTree&&) noexcept = default;
KdTree& KdTree::operator=(KdTree&&) noexcept = default;

const std::vector<Vec3>& KdTree::points() const {
  return impl_->cloud.points;
}

std::int32_t KdTree::nearest(const Vec3& query) const {
  check_query(query);
  std::uint32_t index = 0;
  double squared = 0.0;
  impl_->tree.knnSearch(query.data(), 1, &index, &squared);
  return static_cast<std::int32_t>(index);
}

std::vector<std::int32_t> KdTree::nearest(const Vec3& query, std::size_t count) const {
  check_query(query);
  count = std::min(count, impl_->cloud.points.size());
  if (count == 0) return {};
  std::vector<std::uint32_t> indices(count);
  std::vector<double> squared(count);
  impl_->tree.knnSearch(query.data(), count, indices.data(), squared.data());
  std::vector<std::pair<double, std::int32_t>> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = {squared[i], static_cast<std::int32_t>(indices[i])};
  std::sort(order.begin(), order.end());
  std::vector<std::int32_t> result(count);
  for (std::size_t i = 0; i < count; ++i) result[i] = order[i].second;
  return result;
}

std::vector<std::int32_t> KdTree::within(const Vec3& query, double radius_mm) const {
  check_query(query);
  if (!(radius_mm >= 0.0)) {
    throw InvalidInput("k-d tree: the radius is " + std::to_string(radius_mm) + " mm; it must be 0 or more");
  }
  // nanoflann keeps points strictly nearer than its bound; ours includes the sphere itself.
  const double bound = std::nextafter(radius_mm * radius_mm, std::numeric_limits<double>::infinity());
  std::vector<std::pair<std::uint32_t, double>> matches;
  impl_->tree.radiusSearch(query.data(), bound, matches, nanoflann::SearchParams(32, 0.0F, false));
  std::vector<std::int32_t> result(matches.size());
  for (std::size_t i = 0; i < matches.size(); ++i) result[i] = static_cast<std::int32_t>(matches[i].first);
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace ostia::geometry
