#pragma once
/// \file One synthetic patient scanned twice: another pose, phase, contrast and noise; where each place of
/// the first scan lies in the second is known.

#include "ostia/phantom/moving_case.h"
#include "ostia/registration/register.h"

#include <cmath>
#include <vector>

namespace phantom_pair {

using ostia::geometry::Mat3;
using ostia::geometry::Vec3;

struct PairOptions {
  ostia::phantom::Preset preset = ostia::phantom::Preset::small;
  std::uint64_t seed = 1;
  double voxel_mm = 0.0;  ///< cubes instead of the preset's; 0: these
  double turn_deg = 15.0, shift_mm = 20.0;
  double percent = 82.0;  ///< phase of the second scan; the first is at rest, at 75
  double first_contrast_hu = 420.0, second_contrast_hu = 340.0;
  double first_noise_hu = 25.0, second_noise_hu = 35.0;
};

class PhantomPair {
 public:
  explicit PhantomPair(const PairOptions& options) {
    using namespace ostia::phantom;
    turn_ = Eigen::AngleAxisd(options.turn_deg * M_PI / 180.0, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    CasePlan first = plan_of(options, options.first_contrast_hu, options.first_noise_hu);
    tree_ = vessel_tree(first.tree);
    heart_ = first.heart;
    fixed = scan_case(first).image;
    CasePlan second = plan_of(options, options.second_contrast_hu, options.second_noise_hu);
    // The patient is turned against the scanner: the grid is against the patient, and forgets it afterwards.
    ostia::imaging::Geometry& grid = second.options.scan.grid;
    const Vec3 middle = grid.world(half_of(grid));
    grid.direction = turn_;
    grid.origin += middle - grid.world(half_of(grid));
    second.options.scan.psf_fwhm_mm *= 1.2;
    phase_ = heartbeat_of(second).phase(options.percent);
    const Body body(second.heart, second.tree, body_of(second.options));
    moving = scan_phase(second, body, phase_).image;
    middle_ = middle;
    moving.geometry.direction = Mat3::Identity();
    shift_ = options.shift_mm * Vec3(2, -1, 2).normalized();
    moving.geometry.origin += middle + shift_ - moving.geometry.world(half_of(moving.geometry));
  }

  /// Where a place of the first scan's heart is in the second.
  Vec3 there(const Vec3& fixed_mm) const {
    return turn_.transpose() * (phase_.at(fixed_mm) - middle_) + middle_ + shift_;
  }

  const ostia::geometry::VesselTree& tree() const { return tree_; }  ///< of the first scan

  /// On the axes, every mm or so.
  std::vector<Vec3> axes() const {
    std::vector<Vec3> points;
    for (const ostia::geometry::TreeSegment& segment : tree_.segments)
      for (std::size_t i = 0; i < segment.axis.points.size(); i += 10)
        if (fixed.geometry.contains(segment.axis.points[i])) points.push_back(segment.axis.points[i]);
    return points;
  }
  /// Ostia and forks, as two readers would set them: each off by `error_mm` in some direction.
  std::vector<ostia::registration::LandmarkPair> landmarks(double error_mm = 1.0) const {
    std::vector<ostia::registration::LandmarkPair> pairs;
    for (const ostia::geometry::TreeNode& node : tree_.nodes) {
      const double n = static_cast<double>(pairs.size());
      const Vec3 off =
          error_mm * Vec3(std::sin(12.0 * n), std::cos(7.0 * n), std::sin(5.0 * n + 1.0)).normalized();
      if (fixed.geometry.contains(node.position))
        pairs.push_back({"node", node.position, there(node.position) + off});
    }
    return pairs;
  }
  /// Over the epicardium of the left ventricle, and half way in.
  std::vector<Vec3> heart_points() const {
    std::vector<Vec3> points;
    for (int turn = 0; turn < 12; ++turn)
      for (int depth = 1; depth <= 5; ++depth)
        for (const double inwards_mm : {0.0, 8.0}) {
          const Vec3 p = heart_.epicardium(2.0 * M_PI * turn / 12.0, 0.17 * depth, -inwards_mm);
          if (fixed.geometry.contains(p)) points.push_back(p);
        }
    return points;
  }
  double mean_error_mm(const ostia::registration::Transform& found, const std::vector<Vec3>& points) const {
    double sum = 0.0;
    for (const Vec3& p : points) sum += (found(p) - there(p)).norm();
    return sum / static_cast<double>(points.size());
  }

  ostia::imaging::ImageVolume fixed, moving;

 private:
  static Vec3 half_of(const ostia::imaging::Geometry& grid) {
    return 0.5 * Vec3(static_cast<double>(grid.size[0] - 1), static_cast<double>(grid.size[1] - 1),
                      static_cast<double>(grid.size[2] - 1));
  }
  static ostia::phantom::CasePlan plan_of(const PairOptions& options, double contrast_hu, double noise_hu) {
    ostia::phantom::CaseOptions chosen;
    chosen.seed = options.seed;
    chosen.preset = options.preset;
    chosen.variant.contrast_hu = contrast_hu;
    chosen.scan.noise_hu = noise_hu;
    ostia::phantom::CasePlan plan = ostia::phantom::plan_case(chosen);
    ostia::phantom::ScanOptions& scan = plan.options.scan;
    if (options.voxel_mm > 0.0) {
      for (std::size_t a = 0; a < 3; ++a)
        scan.grid.size[a] =
            static_cast<std::int64_t>(static_cast<double>(scan.grid.size[a]) *
                                      scan.grid.spacing[static_cast<Eigen::Index>(a)] / options.voxel_mm);
      scan.grid.spacing.setConstant(options.voxel_mm);
      scan.psf_fwhm_mm = scan.psf_fwhm_z_mm = options.voxel_mm;
      scan.noise_peak_per_mm = 0.0;
    }
    return plan;
  }

  Mat3 turn_ = Mat3::Identity();
  Vec3 middle_ = Vec3::Zero(), shift_ = Vec3::Zero();
  ostia::phantom::BeatPhase phase_;
  ostia::phantom::HeartShape heart_;
  ostia::geometry::VesselTree tree_;
};

}  // namespace phantom_pair
