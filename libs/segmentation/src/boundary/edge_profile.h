#pragma once
/// \file What a ray across a blurred vessel looks like: lumen, wall and what lies behind it, and how probable
/// the samples of a ray are for every place of the boundary.

#include "boundary/edge_loops.h"
#include "outer_wall/disc_table.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace ostia::segmentation {

/// Share of a disc of radius R in a Gaussian blur's weight at a distance rho from the disc's centre: the
/// picture of a long straight vessel across it. Tends to Phi((R - rho) / sigma) for large R.
double blurred_disc(double radius_mm, double rho_mm, double sigma_mm);
/// The same at rho = 0, step_mm, ...: `count` of them.
std::vector<double> blurred_disc(double radius_mm, double step_mm, int count, double sigma_mm);

/// The defaults suit a blur of 0.3 mm; `sample_step_mm`, `noise_length_mm` and `radius_step_mm` grow with it.
struct EdgeProfileOptions {
  double blur_sigma_mm = 0.3;
  double noise_hu = 25.0;
  double noise_length_mm = 0.6;  ///< of the noise's Gaussian correlation
  double lumen_spread_hu = 12.0;
  double wall_hu = 50.0, wall_spread_hu = 25.0;
  double sample_step_mm = 0.2;  ///< of the rays
  double first_mm = 0.2, radius_step_mm = 0.05;
  int radii = 0;
};

/// Negative logarithm of the probability of a ray's samples near the boundary, for each candidate radius, all
/// levels of intensity and thicknesses of layers integrated out: each hypothesis (lumen, wall of a thickness,
/// fat or muscle or blood behind it; plaque; calcium) is a normal distribution of the samples.
class EdgeProfile {
 public:
  static constexpr int samples = detail::edge_samples;

  explicit EdgeProfile(const EdgeProfileOptions& options);
  /// Candidates lie that near to where the window was put.
  double reach_mm() const { return 2.5 * options_.sample_step_mm; }
  /// First sample of the window about a radius.
  int window(double radius_mm) const;
  /// Candidates about a radius: [first, last].
  void candidates(double radius_mm, int& first, int& last) const;
  /// Before `energy` of the candidates about these radii: it works out what is not known of them yet.
  void prepare(const std::vector<double>& radius_mm);
  /// `ray` points to the sample at rho = 0; `start` comes from `window`; `calcium_odds` multiply what is
  /// thought of calcium beforehand.
  double energy(const float* ray, int start, int candidate, double lumen_hu, double calcium_odds) const;
  double radius(int candidate) const { return options_.first_mm + candidate * options_.radius_step_mm; }

 private:
  double window_mm() const { return 5.0 * options_.sample_step_mm; }  ///< to either side
  /// What the rays at a candidate may look like, for each start of the window.
  struct Candidate {
    std::vector<float> lumen;                  ///< [start][sample]
    std::vector<detail::EdgeNormals> normals;  ///< [start][group of hypotheses]
  };
  EdgeProfileOptions options_;
  int starts_ = 0, hypotheses_ = 0, groups_ = 0;
  std::vector<char> calcium_;  ///< one a hypothesis
  std::shared_ptr<const DiscTable> discs_;
  std::vector<Candidate> candidates_;  ///< empty where not prepared
  int lowest_start(int candidate) const;
  double disc(double radius_mm, int sample) const;
  struct Build;  ///< what makes the table
};

}  // namespace ostia::segmentation
