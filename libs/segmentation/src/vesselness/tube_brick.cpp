#include "vesselness/tube_brick.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace ostia::segmentation::detail {
namespace {

constexpr std::int64_t kMostReach = 64;  // voxels
constexpr std::int64_t kMargin = 2;      // of the differences

/// Weights of the discrete Gaussian (T. Lindeberg, IEEE Trans. Pattern Anal. Mach. Intell. 12:234-254, 1990),
/// exp(-t) I_n(t), from the centre on: its variance is t voxels^2 whatever t. The integral is of a periodic
/// function, to round-off.
std::vector<float> gaussian_weights(double t) {
  constexpr int kSteps = 512;
  std::vector<double> weights;
  double sum = 0.0;
  for (int n = 0; n < kSteps / 2; ++n) {
    double w = 0.0;
    for (int k = 0; k < kSteps; ++k) {
      const double angle = 2.0 * M_PI * k / kSteps;
      w += std::exp(t * (std::cos(angle) - 1.0)) * std::cos(n * angle);
    }
    w /= kSteps;
    if (n > 0 && w < 2e-5 * weights[0]) break;
    weights.push_back(w);
    sum += n == 0 ? w : 2.0 * w;
  }
  std::vector<float> result;
  for (const double w : weights) result.push_back(static_cast<float>(w / sum));
  return result;
}

/// The part of a voxel's row that lies in a ball about the origin: how much of its middle, and how long.
struct RowOfBall {
  double middle = 0.0;  // [0, 1]
  double voxels = 0.0;
};

RowOfBall row_of_ball(double radius, const geometry::Vec3& spacing, std::int64_t y, std::int64_t z) {
  constexpr int kParts = 8;  // chords along y and z in a voxel
  RowOfBall row;
  for (int a = 0; a < kParts; ++a) {
    for (int b = 0; b < kParts; ++b) {
      const double dy = (static_cast<double>(y) + (a + 0.5) / kParts - 0.5) * spacing[1];
      const double dz = (static_cast<double>(z) + (b + 0.5) / kParts - 0.5) * spacing[2];
      const double half2 = radius * radius - dy * dy - dz * dz;
      if (half2 <= 0.0) continue;
      const double chord = 2.0 * std::sqrt(half2) / spacing[0];
      row.middle += std::min(chord, 1.0) / (kParts * kParts);
      row.voxels += chord / (kParts * kParts);
    }
  }
  return row;
}

Index ball_reach(double radius, const geometry::Vec3& spacing) {
  Index reach{};
  for (int d = 0; d < 3; ++d)
    reach[static_cast<std::size_t>(d)] = static_cast<std::int64_t>(std::ceil(radius / spacing[d] + 0.5));
  return reach;
}

/// A ball with the voxels at its surface in part, as two runs a row whose mean is as long as the row's part.
std::vector<std::vector<BallRun>> ball_runs(double radius, const geometry::Vec3& spacing) {
  const Index reach = ball_reach(radius, spacing);
  std::vector<std::vector<BallRun>> planes(static_cast<std::size_t>(reach[2] + 1));
  double sum = 0.0;
  for (std::int64_t z = 0; z <= reach[2]; ++z) {
    for (std::int64_t y = -reach[1]; y <= reach[1]; ++y) {
      const RowOfBall row = row_of_ball(radius, spacing, y, z);
      if (row.voxels < 1e-3) continue;
      const double half = 0.5 * (std::max(row.voxels / row.middle, 1.0) - 1.0);
      const auto whole = static_cast<std::int64_t>(half);
      const double part = half - static_cast<double>(whole);
      for (const auto& [n, share] : {std::pair(whole, 1.0 - part), std::pair(whole + 1, part)}) {
        if (share < 1e-3) continue;
        planes[static_cast<std::size_t>(z)].push_back({y, n, static_cast<float>(row.middle * share)});
        sum += row.middle * share * static_cast<double>(2 * n + 1) * (z == 0 ? 1.0 : 2.0);
      }
    }
  }
  while (planes.back().empty()) planes.pop_back();
  for (auto& plane : planes)
    for (BallRun& run : plane) run.weight = static_cast<float>(run.weight / sum);
  return planes;
}

std::int64_t radius_of(const std::vector<float>& weights) {
  return static_cast<std::int64_t>(weights.size()) - 1;
}

std::size_t whole_packs(std::int64_t count) {
  return static_cast<std::size_t>((count + 7) / 8 * 8);
}

}  // namespace

TubePlan::TubePlan(const imaging::ImageVolume& volume, const VesselnessOptions& choice)
    : image(volume), options(choice), scales(choice, volume.geometry.spacing) {
  const geometry::Vec3& h = volume.geometry.spacing;
  const bool flux = options.method == TubeMethod::flux;
  for (const TubeScale& s : scales.list()) {
    Scale made;
    Index most = flux ? ball_reach(s.ball_mm, h) : Index{0, 0, 0};
    if (*std::max_element(most.begin(), most.end()) <= kMostReach && flux)
      made.ball = ball_runs(s.ball_mm, h);
    for (std::size_t d = 0; d < 3; ++d) {
      const double spacing = h[static_cast<int>(d)];
      const double t = s.sigma_mm * s.sigma_mm / (spacing * spacing);
      // The voxels in part at a ball's surface are a blur of their own, of variance 1/12.
      const auto weights = gaussian_weights(std::min(flux ? std::max(t - 1.0 / 12.0, 0.0) : t, 400.0));
      most[d] += radius_of(weights);
      (flux ? blur : made.blur)[d] = weights;
      reach[d] = std::max(reach[d], most[d] + kMargin);
      made.pure[d] = static_cast<float>(s.factor / (12.0 * spacing * spacing));
    }
    made.mixed = {static_cast<float>(s.factor / (144.0 * h[0] * h[1])),
                  static_cast<float>(s.factor / (144.0 * h[0] * h[2])),
                  static_cast<float>(s.factor / (144.0 * h[1] * h[2]))};
    per_scale.push_back(std::move(made));
  }
  const std::int64_t most = *std::max_element(reach.begin(), reach.end());
  if (most > kMostReach) {
    throw InvalidInput("vesselness: tubes of " + std::to_string(scales.list().back().radius_mm) +
                       " mm radius reach over " + std::to_string(most) + " voxels of the image, more than " +
                       std::to_string(kMostReach) + "; ask for thinner tubes or resample the image");
  }
}

/// What a block held before stays in it: only places that are not used are read before they are written.
void Block::shape(const Index& new_size) {
  if (size == new_size) return;
  size = new_size;
  pitch = (size[0] + 15) / 8 * 8;
  values.assign(static_cast<std::size_t>(pitch * size[1] * size[2] + 16), 0.0F);
}

void TubeBrick::work_out(const Box& box, const std::vector<std::uint8_t>& wanted,
                         const core::TaskContext& task) {
  box_ = box;
  for (std::size_t d = 0; d < 3; ++d) size_[d] = box.upper[d] - box.lower[d];
  find_spans(wanted);
  gather();
  const auto cells = static_cast<std::size_t>(kPitch * size_[1] * size_[2]);
  answers_.resize(cells * plan_.per_scale.size());
  if (plan_.options.axes == TubeAxes::computed) {
    best_.assign(cells, 0.0F);
    for (auto& component : axis_) component.assign(cells, 0.0F);
  }
  field_.shape({kLength + 2 * kMargin, size_[1] + 2 * kMargin, size_[2] + 2 * kMargin});
  if (plan_.options.method == TubeMethod::flux) {
    Box valid{{0, 0, 0}, source_.size};
    blur(source_, first_, 0, plan_.blur[0], valid);
    blur(first_, second_, 1, plan_.blur[1], valid);
    blur(second_, first_, 2, plan_.blur[2], valid);
    sum_rows(valid);
  }
  for (std::size_t s = 0; s < plan_.per_scale.size(); ++s) {
    task.throw_if_cancelled();
    if (plan_.options.method == TubeMethod::flux)
      ball_means(plan_.per_scale[s]);
    else
      gaussian(plan_.per_scale[s]);
    answers(plan_.per_scale[s], s);
  }
}

void TubeBrick::find_spans(const std::vector<std::uint8_t>& wanted) {
  const auto rows = static_cast<std::size_t>(size_[1] * size_[2]);
  spans_.assign(rows, {});
  for (std::size_t row = 0; row < rows; ++row) {
    const std::uint8_t* at = wanted.data() + row * static_cast<std::size_t>(size_[0]);
    Span s{0, size_[0]};
    while (!s.empty() && at[s.lower] == 0) ++s.lower;
    while (!s.empty() && at[s.upper - 1] == 0) --s.upper;
    spans_[row] = s;
  }
  around_.clear();
  for (std::int64_t z = 0; z < size_[2] + 2 * kMargin; ++z)
    for (std::int64_t y = 0; y < size_[1] + 2 * kMargin; ++y) around_.push_back(around(y, z));
}

/// Where a row of the field is needed, in its own voxels.
TubeBrick::Span TubeBrick::around(std::int64_t y, std::int64_t z) {
  Span all{kLength + 2 * kMargin, 0};
  for (std::int64_t k = std::max<std::int64_t>(z - 2 * kMargin, 0); k <= std::min(z, size_[2] - 1); ++k) {
    for (std::int64_t j = std::max<std::int64_t>(y - 2 * kMargin, 0); j <= std::min(y, size_[1] - 1); ++j) {
      const Span& s = span(j, k);
      if (s.empty()) continue;
      all.lower = std::min(all.lower, s.lower);
      all.upper = std::max(all.upper, s.upper + 2 * kMargin);
    }
  }
  return all;
}

/// The image about the brick as floats, its border repeated.
void TubeBrick::gather() {
  const Index& reach = plan_.reach;
  // All of the row's lattice cell, so that running sums do not depend on the region.
  source_.shape({kLength + 2 * reach[0], size_[1] + 2 * reach[1], size_[2] + 2 * reach[2]});
  first_.shape(source_.size);
  second_.shape(source_.size);
  const auto& g = plan_.image.geometry;
  const auto low = static_cast<float>(plan_.options.least_hu),
             high = static_cast<float>(plan_.options.most_hu);
  const auto inside = [&](std::int64_t at, std::size_t d) {
    return std::clamp<std::int64_t>(at, 0, g.size[d] - 1);
  };
  const std::int64_t from = box_.lower[0] - reach[0];
  const std::int64_t first = std::clamp<std::int64_t>(-from, 0, source_.size[0]);
  const std::int64_t last = std::clamp<std::int64_t>(g.size[0] - from, first, source_.size[0]);
  for (std::int64_t z = 0; z < source_.size[2]; ++z) {
    for (std::int64_t y = 0; y < source_.size[1]; ++y) {
      const std::int16_t* in =
          plan_.image.voxels.data() +
          g.offset(0, inside(box_.lower[1] + y - reach[1], 1), inside(box_.lower[2] + z - reach[2], 2));
      float* out = source_.row(y, z);
      const auto value = [&](std::int64_t x) { return std::clamp(static_cast<float>(in[x]), low, high); };
      std::fill(out, out + first, value(0));
      for (std::int64_t x = first; x < last; ++x) out[x] = value(from + x);
      std::fill(out + last, out + source_.size[0], value(g.size[0] - 1));
    }
  }
}

/// One pass; `box` is where `in` is valid, and then where `out` is.
void TubeBrick::blur(Block& in, Block& out, int axis, const std::vector<float>& weights, Box& box) {
  const std::int64_t radius = radius_of(weights);
  const auto d = static_cast<std::size_t>(axis);
  box.lower[d] += radius;
  box.upper[d] -= radius;
  const std::ptrdiff_t stride = axis == 0 ? 1 : axis == 1 ? in.pitch : in.plane();
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z) {
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y) {
      tube_loops().blur(in.row(y, z) + box.lower[0], stride, weights.data(), static_cast<int>(radius),
                        out.row(y, z) + box.lower[0], whole_packs(box.upper[0] - box.lower[0]));
    }
  }
}

/// second_[x] = sum of first_ before x, along each row.
void TubeBrick::sum_rows(const Box& box) {
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z) {
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y) {
      const float* in = first_.row(y, z);
      float* out = second_.row(y, z);
      double sum = 0.0;
      for (std::int64_t x = box.lower[0]; x < box.upper[0]; ++x) {
        out[x] = static_cast<float>(sum);
        sum += static_cast<double>(in[x]);
      }
      out[box.upper[0]] = static_cast<float>(sum);
    }
  }
}

void TubeBrick::ball_means(const TubePlan::Scale& scale) {
  taps_.clear();
  plane_.shape({second_.size[0], second_.size[1], 1});
  for (const auto& plane : scale.ball) {
    taps_.emplace_back();
    for (const BallRun& run : plane) {
      const std::ptrdiff_t row = run.y * second_.pitch;
      taps_.back().push_back({row + run.reach + 1, row - run.reach, run.weight});
    }
  }
  for (std::int64_t z = 0; z < field_.size[2]; ++z) ball_means_of_plane(scale, z);
}

/// Planes of the ball as far above as below have the same weights: their sums are added first.
void TubeBrick::ball_means_of_plane(const TubePlan::Scale& scale, std::int64_t z) {
  const Span* spans = around_.data() + field_.size[1] * z;
  Span rows{0, field_.size[1]};
  while (!rows.empty() && spans[rows.lower].empty()) ++rows.lower;
  while (!rows.empty() && spans[rows.upper - 1].empty()) --rows.upper;
  if (rows.empty()) return;
  for (std::int64_t y = rows.lower; y < rows.upper; ++y) std::fill_n(field_.row(y, z), field_.pitch, 0.0F);
  const Index& reach = plan_.reach;
  const std::int64_t zero = z + reach[2] - kMargin;
  std::int64_t ball = 0;  // along y
  for (const BallRun& run : scale.ball.front()) ball = std::max(ball, run.y);
  for (std::int64_t dz = 0; dz < static_cast<std::int64_t>(scale.ball.size()); ++dz) {
    Block& from = dz == 0 ? second_ : plane_;
    for (std::int64_t y = rows.lower - ball; dz > 0 && y < rows.upper + ball; ++y) {
      const std::int64_t at = y + reach[1] - kMargin;
      tube_loops().add(second_.row(at, zero - dz), second_.row(at, zero + dz), plane_.row(at, 0),
                       static_cast<std::size_t>(plane_.pitch));
    }
    const auto& taps = taps_[static_cast<std::size_t>(dz)];
    for (std::int64_t y = rows.lower; y < rows.upper; ++y) {
      const Span s = spans[y];
      if (s.empty()) continue;
      const float* sums = from.row(y + reach[1] - kMargin, dz == 0 ? zero : 0) + reach[0] - kMargin + s.lower;
      tube_loops().runs(sums, taps.data(), taps.size(), field_.row(y, z) + s.lower,
                        whole_packs(s.upper - s.lower));
    }
  }
}

void TubeBrick::gaussian(const TubePlan::Scale& scale) {
  const Index& reach = plan_.reach;
  Box box;
  for (std::size_t d = 0; d < 3; ++d) {
    const std::int64_t around = kMargin + radius_of(scale.blur[d]);
    box.lower[d] = reach[d] - around;
    box.upper[d] = source_.size[d] - reach[d] + around;
  }
  blur(source_, first_, 0, scale.blur[0], box);
  blur(first_, second_, 1, scale.blur[1], box);
  std::size_t number = 0;
  for (std::int64_t z = 0; z < field_.size[2]; ++z) {
    for (std::int64_t y = 0; y < field_.size[1]; ++y) {
      const Span s = around_[number++];
      if (s.empty()) continue;
      const float* in = second_.row(y + reach[1] - kMargin, z + reach[2] - kMargin) + reach[0] - kMargin;
      tube_loops().blur(in + s.lower, second_.plane(), scale.blur[2].data(),
                        static_cast<int>(radius_of(scale.blur[2])), field_.row(y, z) + s.lower,
                        whole_packs(s.upper - s.lower));
    }
  }
}

void TubeBrick::answers(const TubePlan::Scale& scale, std::size_t number) {
  const std::ptrdiff_t cells = kPitch * size_[1] * size_[2];
  TubeRow row;
  row.y = field_.pitch;
  row.z = field_.plane();
  for (std::size_t d = 0; d < 3; ++d) {
    row.pure[d] = scale.pure[d];
    row.mixed[d] = scale.mixed[d];
  }
  row.gap_weight = static_cast<float>(plan_.options.gap_weight);
  for (std::int64_t z = 0; z < size_[2]; ++z) {
    for (std::int64_t y = 0; y < size_[1]; ++y) {
      const Span s = span(y, z);
      if (s.empty()) continue;
      const std::ptrdiff_t at = place(s.lower, y, z);
      row.values = field_.row(y + kMargin, z + kMargin) + kMargin + s.lower;
      row.answer = answers_.data() + static_cast<std::ptrdiff_t>(number) * cells + at;
      if (plan_.options.axes == TubeAxes::computed) {
        row.best = best_.data() + at;
        for (std::size_t d = 0; d < 3; ++d) row.axis[d] = axis_[d].data() + at;
      }
      tube_loops().tube(row, whole_packs(s.upper - s.lower));
    }
  }
}

TubeScales::Peak TubeBrick::peak(std::int64_t x, std::int64_t y, std::int64_t z) const {
  return plan_.scales.peak(answers_.data() + place(x, y, z), kPitch * size_[1] * size_[2]);
}

std::array<float, 3> TubeBrick::axis(std::int64_t x, std::int64_t y, std::int64_t z) const {
  const auto at = static_cast<std::size_t>(place(x, y, z));
  return {axis_[0][at], axis_[1][at], axis_[2][at]};
}

}  // namespace ostia::segmentation::detail
