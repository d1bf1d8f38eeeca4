#pragma once
/// \file What a ray through a blurred vessel wall looks like, the lumen being known: how probable its samples
/// are for every place of the wall's outer border.

#include "boundary/boundary_fit.h"
#include "boundary/star_surface.h"
#include "outer_wall/disc_table.h"
#include "outer_wall/wall_loops.h"

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace ostia::segmentation {

/// blurred_disc(R, i step) for many R.
class BlurredDiscs {
 public:
  BlurredDiscs(double largest_radius_mm, double reach_mm, double step_mm, double sigma_mm);
  /// Share of a disc of radius R in sample i of a ray from its centre; the last sample's beyond the table.
  double at(double radius_mm, int sample) const;
  int samples() const { return samples_; }
  int radii() const { return radii_; }
  double share(int radius, int sample) const;  ///< of the table, the last sample's beyond it
  double place(double radius_mm) const;        ///< in the table, of its radii

 private:
  int samples_ = 0, radii_ = 0;
  std::shared_ptr<const DiscTable> table_;
};

struct WallProfileOptions {
  double blur_sigma_mm = 0.3;
  double noise_hu = 25.0;
  double wall_hu = 50.0;
  double least_thickness_mm = 0.1;
  double sample_step_mm = 0.2;
  RadiusGrid grid;  ///< of the candidates
};

/// A ray of which the lumen's edge and the levels on both sides are known.
struct WallRay {
  const float* hu = nullptr;  ///< samples from rho = 0
  int count = 0;
  double lumen_mm = 0.0, lumen_hu = 0.0, fat_hu = 0.0;
};

/// Negative logarithm of the probability of a ray's samples for each candidate radius of the outer border:
/// wall, soft or fibrous plaque or calcium within it, fat beyond; levels of intensity and the lumen's own
/// place are integrated out. One hypothesis knows of no border, so that rays which show none are flat.
class WallProfile {
 public:
  static constexpr int samples = detail::wall_samples;

  explicit WallProfile(const WallProfileOptions& options);
  /// Of the candidates within 0.5 mm of a radius (coarser blur: more).
  RayEnergy energy(const WallRay& ray, double about_mm) const;
  /// The same candidates of a ray that says nothing.
  RayEnergy no_energy(const WallRay& ray, double about_mm) const;

 private:
  using Samples = std::array<double, samples>;
  /// A part of the wall between lumen (0) and outer border (1).
  struct Layer {
    double from = 0.0, to = 1.0;
    double hu = 0.0, spread_hu = 0.0;
  };
  struct Hypothesis {
    double prior = 1.0;
    bool healthy = false;   ///< as thick as a healthy wall
    double least_mm = 0.0;  ///< thinner is not thought of
    detail::WallMixture mixture;
    int fat = 0;            ///< the direction whose level is the fat's
    double first_hu = 0.0;  ///< of the layer next to the lumen
  };
  void add_hypothesis(double prior, bool healthy, double least_mm, const std::vector<Layer>& layers,
                      bool something_beyond);
  int start_of(double about_mm) const;
  Samples whitened(const Samples& values) const;
  /// A blurred disc's whitened samples from `start` on.
  Samples white_disc(double radius_mm, int start) const;
  void fill(const WallRay& ray, int start, int first, int count, detail::WallSamples& out) const;
  double anything_square(const WallRay& ray, int start) const;

  WallProfileOptions options_;
  BlurredDiscs discs_;
  std::array<std::array<double, samples>, samples> whitening_{}, anything_{};
  double anything_weight_ = 0.0;  // of the hypothesis that knows of no border
  std::vector<Samples> white_;    // [start][radius of discs_]
  std::vector<Hypothesis> hypotheses_;
};

}  // namespace ostia::segmentation
