// One synthetic patient scanned twice: its tree carried, and what is no pair refused. The figures that are
// printed stand in docs/methods/carry.md.

#include "phantom_pair.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/pipeline/image_walls.h"
#include "ostia/session/carry.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>

namespace ostia::session {
namespace {

using geometry::Vec3;
using phantom_pair::PhantomPair;
using ::testing::HasSubstr;

/// What a person has checked in the first scan: the true axes with the walls that the scan shows.
lumen::LumenModel checked_model(const PhantomPair& pair) {
  return lumen::model_of_walls(pair.tree(),
                               pipeline::walls_from_image(pair.tree(), pair.fixed, core::no_task()));
}

const PhantomPair& scanned_pair() {
  static const PhantomPair pair([] {
    phantom_pair::PairOptions options;
    options.preset = phantom::Preset::small;
    return options;
  }());
  return pair;
}
const lumen::LumenModel& checked_tree() {
  static const lumen::LumenModel model = checked_model(scanned_pair());
  return model;
}

/// The true axes in the later scan.
std::vector<std::vector<Vec3>> true_axes(const PhantomPair& pair) {
  std::vector<std::vector<Vec3>> axes;
  for (const geometry::TreeSegment& segment : pair.tree().segments) {
    axes.emplace_back();
    for (const Vec3& point : segment.axis.points) axes.back().push_back(pair.there(point));
  }
  return axes;
}
double off_mm(const std::vector<std::vector<Vec3>>& axes, const Vec3& place) {
  double least = 1e9;
  for (const auto& axis : axes)
    least = std::min(least, (geometry::closest(axis, place).point - place).norm());
  return least;
}

struct Offsets {
  double mapped_mm = 0.0, places_mm = 0.0, pulled_mm = 0.0, forks_mm = 0.0, largest_fork_mm = 0.0;
};
Offsets offsets_of(const PhantomPair& pair, const CarriedCase& made) {
  const auto axes = true_axes(pair);
  Offsets out;
  double points = 0.0, forks = 0.0, mapped = 0.0;
  for (const Vec3& point : pair.axes()) {
    out.places_mm += (made.registration.transform(point) - pair.there(point)).norm();
    out.mapped_mm += off_mm(axes, made.registration.transform(point));
    ++mapped;
  }
  for (const geometry::TreeSegment& segment : made.carried.model.tree.segments)
    for (std::size_t i = 0; i < segment.axis.size(); i += 4, ++points)
      out.pulled_mm += off_mm(axes, segment.axis.points[i]);
  for (const geometry::TreeNode& node : pair.tree().nodes) {
    const auto branches = std::ranges::count(pair.tree().segments, node.id, &geometry::TreeSegment::from);
    const auto carried = std::ranges::find(made.carried.model.tree.nodes, node.id, &geometry::TreeNode::id);
    if (branches < 2 || carried == made.carried.model.tree.nodes.end()) continue;
    const double off = (carried->position - pair.there(node.position)).norm();
    out.forks_mm += off;
    out.largest_fork_mm = std::max(out.largest_fork_mm, off);
    ++forks;
  }
  out.mapped_mm /= mapped, out.places_mm /= mapped, out.pulled_mm /= points, out.forks_mm /= forks;
  return out;
}

TEST(CarriedPair, TheTreeLiesInTheLaterScansVessels) {
  const lumen::LumenModel& before = checked_tree();
  const auto start = std::chrono::steady_clock::now();
  const CarriedCase made = carry_case(before, {}, scanned_pair().fixed, scanned_pair().moving);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Offsets off = offsets_of(scanned_pair(), made);
  std::printf(
      "axes %.3f mm off before the image is asked (places %.3f), %.3f after; forks %.3f, at most %.3f; "
      "%.1f %% followed; verdict %s; %.1f s\n",
      off.mapped_mm, off.places_mm, off.pulled_mm, off.forks_mm, off.largest_fork_mm,
      100.0 * made.carried.followed_share, registration::name_of(made.registration.quality.verdict), seconds);
  for (const CarriedVessel& one : made.carried.vessels) {
    std::printf("%-6s %-9s %5.1f of %5.1f mm, pulled %.2f, at most %.2f, wall kept %.2f", one.name.c_str(),
                to_string(one.how).c_str(), one.after_mm, one.before_mm, one.shift_mm, one.largest_shift_mm,
                one.wall_kept_share);
    for (const std::string& note : one.notes) std::printf("; %s", note.c_str());
    std::printf("\n");
  }
  for (const CameVessel& one : made.came)
    std::printf("came: %s %.1f mm (%.2f)\n", one.name.c_str(), one.length_mm, one.probability);
  for (const std::string& warning : made.warnings) std::printf("warning: %s\n", warning.c_str());
  EXPECT_LE(off.places_mm, 1.0);
  EXPECT_LE(off.pulled_mm, 0.15);
  EXPECT_LE(off.forks_mm, 1.0);
  EXPECT_GT(made.carried.followed_share, 0.9);
  EXPECT_TRUE(made.another_patient.empty()) << made.another_patient;
}

void expect_refused(const imaging::ImageVolume& after, const std::string& why) {
  try {
    carry_case(checked_tree(), {}, scanned_pair().fixed, after);
    ADD_FAILURE() << "carried: " << why;
  } catch (const InvalidInput& error) {
    std::printf("%s: %s\n", why.c_str(), error.what());
  }
}

TEST(CarriedPair, AnotherPatientIsRefusedUnlessAsked) {
  phantom_pair::PairOptions options;
  options.seed = 2;
  const PhantomPair other(options);
  expect_refused(other.moving, "another patient");
  CarryOptions anyway;
  anyway.anyway = true;
  const CarriedCase made = carry_case(checked_tree(), {}, scanned_pair().fixed, other.moving, anyway);
  EXPECT_FALSE(made.another_patient.empty());
  EXPECT_FALSE(made.well());
}

TEST(CarriedPair, WhatIsNoLaterScanIsRefused) {
  imaging::ImageVolume mirrored = scanned_pair().moving;
  const auto& size = mirrored.geometry.size;
  for (std::int64_t row = 0; row < size[1] * size[2]; ++row)
    std::reverse(mirrored.voxels.begin() + row * size[0], mirrored.voxels.begin() + (row + 1) * size[0]);
  expect_refused(mirrored, "mirrored");
  imaging::ImageVolume plain = scanned_pair().moving;
  for (std::int16_t& value : plain.voxels) value = std::min<std::int16_t>(value, 45);
  expect_refused(plain, "without contrast");
  imaging::ImageVolume away = scanned_pair().moving;
  away.geometry.size[2] = 24;  // the lowest slices alone
  away.voxels.resize(static_cast<std::size_t>(away.geometry.voxels()));
  expect_refused(away, "another part of the body");
}

}  // namespace
}  // namespace ostia::session
