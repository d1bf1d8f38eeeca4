#pragma once
/// \file What a ray through a blurred vessel wall looks like, the lumen being known: how probable its samples
/// are for every place of the wall's outer border.

#include "boundary/boundary_fit.h"
#include "boundary/star_surface.h"

#include <array>
#include <cstddef>
#include <vector>

namespace ostia::segmentation {

/// blurred_disc(R, i step) for many R.
class BlurredDiscs {
 public:
  BlurredDiscs(double largest_radius_mm, double reach_mm, double step_mm, double sigma_mm);
  /// Share of a disc of radius R in sample i of a ray from its centre; the last sample's beyond the table.
  double at(double radius_mm, int sample) const;

 private:
  int samples_ = 0, radii_ = 0;
  std::vector<double> share_;  // [radius][sample]
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
  static constexpr int samples = 11, most_directions = 8;

  explicit WallProfile(const WallProfileOptions& options);
  /// Of the candidates within 0.5 mm of a radius (coarser blur: more).
  RayEnergy energy(const WallRay& ray, double about_mm) const;

 private:
  using Samples = std::array<double, samples>;
  using Directions = std::array<Samples, most_directions>;
  /// A part of the wall between lumen (0) and outer border (1).
  struct Layer {
    double from = 0.0, to = 1.0;
    double hu = 0.0, spread_hu = 0.0;
  };
  struct Hypothesis {
    double prior = 1.0;
    bool healthy = false;   ///< as thick as a healthy wall
    double fat_mm = 0.0;    ///< of the fat beyond, before something else; 0: as far as is looked at
    double least_mm = 0.0;  ///< thinner is not thought of
    std::vector<Layer> layers;
  };
  struct Window;  ///< what does not depend on the candidate
  double hypothesis_energy(const Hypothesis& hypothesis, const Window& window, double outer_mm) const;
  /// Of what the mean leaves over, deviations along `count` directions (whitened here) being normal.
  double marginal_energy(const Samples& residual, Directions& direction, int count) const;
  Samples whitened(const Samples& values) const;
  double anything_energy(const WallRay& ray, int start) const;

  WallProfileOptions options_;
  BlurredDiscs discs_;
  std::array<std::array<double, samples>, samples> whitening_{}, anything_{};
  double anything_offset_ = 0.0;  // logarithms of determinants against the noise's own
  std::vector<Hypothesis> hypotheses_;
};

}  // namespace ostia::segmentation
