#include "ostia/experiments/simulated_reader.h"

#include "lumen/wall_on_ray.h"

#include "ostia/core/error.h"
#include "ostia/evaluation/contour_surface.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/phantom/noise.h"
#include "ostia/reformat/curved_reformation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace ostia::experiments {
namespace {

using geometry::AxisCurve;
using geometry::Vec2;

using std::numbers::pi;
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
constexpr double farthest_mm = farthest_wall_mm;
constexpr double beyond_mm = 1.5;      // a stroke that reaches an end of the overlay runs on so far
constexpr double clear_mm = 0.2;       // a stroke stays so far from the axis, which is in the picture too
constexpr double joined_gap_mm = 3.0;  // disagreements nearer to each other are mended by one stroke
constexpr double follow_mm = 0.02;     // a stroke follows the overlay so closely, if its points suffice
constexpr int section_angles = 24;
constexpr int never_again = 30;  // a gain is halved for each time that a stroke was drawn there
constexpr double least_gain = 1e-3;

/// The wall across the axis.
double wall_across(const lumen::ScalarField& wall, const AxisCurve& axis, double s, double theta) {
  const Vec3 foot = axis.point(s);
  return wall_on_ray(wall, foot, axis.place(s, theta, 1.0) - foot);
}

/// Cubic through the chosen places (Fritsch-Carlson would be as good): how a person sees a line through
/// points.
double between(const std::vector<std::pair<double, double>>& chosen, double s) {
  const auto upper = std::upper_bound(chosen.begin(), chosen.end(), s,
                                      [](double value, const auto& point) { return value < point.first; });
  const auto i = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(upper - chosen.begin(), 1, static_cast<std::ptrdiff_t>(chosen.size()) - 1));
  const auto slope = [&](std::size_t k) {
    const std::size_t a = k == 0 ? 0 : k - 1, b = std::min(chosen.size() - 1, k + 1);
    return (chosen[b].second - chosen[a].second) / (chosen[b].first - chosen[a].first);
  };
  const double h = chosen[i].first - chosen[i - 1].first, t = (s - chosen[i - 1].first) / h, u = 1.0 - t;
  return u * u * (1.0 + 2.0 * t) * chosen[i - 1].second + t * t * (3.0 - 2.0 * t) * chosen[i].second +
         h * t * u * (u * slope(i - 1) - t * slope(i));
}

}  // namespace

void validate(const ReaderOptions& options) {
  if (options.picture_px < 64 || options.picture_px > 4096)
    throw InvalidInput("a reader's picture has 64 to 4096 pixels a side");
  if (!(options.pointing_sigma_mm >= 0.0)) throw InvalidInput("the pointing error must not be negative");
  if (options.points < 4) throw InvalidInput("a reader's stroke needs at least 4 points");
  if (options.lines_deg.empty()) throw InvalidInput("a reader looks at one reformation at least");
  if (!(options.row_mm > 0.0) || !(options.section_step_mm > 0.0))
    throw InvalidInput("the distances at which a reader compares must be positive");
  if (!(options.visible_px > 0.0)) throw InvalidInput("the visible disagreement must be positive");
  if (!(options.section_share >= 0.0) || options.section_share > 1.0)
    throw InvalidInput("the share of strokes on cross-sections lies between 0 and 1");
}

struct SimulatedReader::Impl {
  std::shared_ptr<const AxisCurve> axis;
  std::int32_t vessel = 0;
  ReaderOptions options;
  double from_mm = 0.0, to_mm = 0.0, pixel_mm = 0.0;
  std::vector<double> rows, sections;
  std::vector<double> angles;             // of the wall lines: both sides of each view
  std::vector<std::vector<double>> line;  // overlay's distance from the axis, [angle][row]
  std::vector<std::vector<double>> ring;  // [section][angle]
  int tried = 0, strokes = 0, section_strokes = 0;
  std::uint64_t clicks = 0;
  double last_view = -1.0;
  std::string why;
  std::map<std::pair<int, int>, int> drawn;  // how often a stroke began about here on a line
  std::pair<int, int> last_drawn{-2, 0};
  bool last_on_section = false;

  struct Candidate {
    double gain = 0.0, worst_mm = 0.0;
    int line = -1, section = -1;      // one of them
    std::size_t first = 0, last = 0;  // rows
  };

  double click(double sigma) { return sigma * phantom::normal(options.seed, clicks++); }

  Candidate worst_line(const lumen::ScalarField& wall) const {
    const double visible = options.visible_px * pixel_mm;
    Candidate best;
    for (std::size_t k = 0; k < angles.size(); ++k) {
      std::vector<double> off(rows.size(), 0.0);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (std::isnan(line[k][i])) continue;
        const double rho = wall_across(wall, *axis, rows[i], angles[k]);
        off[i] = std::isnan(rho) ? farthest_mm : std::abs(rho - line[k][i]);
      }
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (off[i] <= visible) continue;
        Candidate one;
        one.line = static_cast<int>(k);
        one.first = i;
        std::size_t j = i;
        for (one.last = i; j < rows.size() && rows[j] - rows[one.last] <= joined_gap_mm; ++j)
          if (off[j] > visible) one.last = j;
        for (std::size_t m = one.first; m <= one.last; ++m) {
          one.gain += std::min(off[m], 2.0) * options.row_mm;
          one.worst_mm = std::max(one.worst_mm, off[m]);
        }
        const auto before = drawn.find({one.line, static_cast<int>(rows[one.first] / 4.0)});
        if (before != drawn.end()) one.gain /= static_cast<double>(1 << before->second);
        if (one.gain > best.gain) best = one;
        i = one.last;
      }
    }
    return best;
  }

  Candidate worst_section(const lumen::ScalarField& wall) const {
    const double visible = options.visible_px * pixel_mm;
    Candidate best;
    for (std::size_t k = 0; k < sections.size(); ++k) {
      double sum = 0.0, worst = 0.0;
      for (int a = 0; a < section_angles; ++a) {
        const double overlay = ring[k][static_cast<std::size_t>(a)];
        if (std::isnan(overlay)) continue;
        const double rho = wall_across(wall, *axis, sections[k], 2.0 * pi * a / section_angles);
        const double off = std::isnan(rho) ? farthest_mm : std::abs(rho - overlay);
        sum += std::min(off, 2.0);
        worst = std::max(worst, off);
      }
      if (worst <= visible) continue;
      Candidate one;
      one.section = static_cast<int>(k);
      one.worst_mm = worst;
      // A contour mends all around, a stroke on a reformation one line of so many.
      one.gain = sum / section_angles * static_cast<double>(angles.size()) * options.eps_mm;
      const auto before = drawn.find({-1, one.section});
      if (before != drawn.end()) one.gain /= static_cast<double>(1 << before->second);
      if (one.gain > best.gain) best = one;
    }
    return best;
  }

  /// Places on a line of the overlay, as few as follow it and no more than a stroke has.
  std::vector<std::pair<double, double>> points_of_line(const Candidate& c) const {
    std::size_t first = c.first, last = c.last;
    const auto known = [&](std::size_t i) { return !std::isnan(line[static_cast<std::size_t>(c.line)][i]); };
    const auto margin = static_cast<std::size_t>(1.0 / options.row_mm);
    for (std::size_t n = 0; n < margin && first > 0 && known(first - 1); ++n) --first;
    for (std::size_t n = 0; n < margin && last + 1 < rows.size() && known(last + 1); ++n) ++last;
    while (last < first + 2 && last + 1 < rows.size() && known(last + 1)) ++last;
    while (last < first + 2 && first > 0 && known(first - 1)) --first;
    const std::vector<double>& rho = line[static_cast<std::size_t>(c.line)];
    std::vector<std::pair<double, double>> chosen{{rows[first], rho[first]}, {rows[last], rho[last]}};
    const bool at_start = first == 0, at_end = last + 1 == rows.size();
    const auto most = static_cast<std::size_t>(options.points - (at_start ? 1 : 0) - (at_end ? 1 : 0));
    while (chosen.size() < most) {
      double worst = follow_mm;
      std::size_t where = 0;
      for (std::size_t i = first + 1; i < last; ++i) {
        const double off = known(i) ? std::abs(between(chosen, rows[i]) - rho[i]) : 0.0;
        if (off > worst) {
          worst = off;
          where = i;
        }
      }
      if (where == 0) break;
      chosen.emplace_back(rows[where], rho[where]);
      std::sort(chosen.begin(), chosen.end());
    }
    // Where the overlay ends the wall goes on; a person draws a little past the end.
    if (at_start) chosen.insert(chosen.begin(), {std::max(0.0, rows[first] - beyond_mm), rho[first]});
    if (at_end) chosen.emplace_back(std::min(axis->length(), rows[last] + beyond_mm), rho[last]);
    return chosen;
  }

  /// A click that missed to the axis or beyond it is taken back and made on the wall's side.
  Vec3 off_axis(const Vec3& place, double s, double theta) const {
    const Vec3 foot = axis->point(s), direction = axis->place(s, theta, 1.0) - foot;
    return place + std::max(0.0, clear_mm - direction.dot(place - foot)) * direction;
  }

  ReaderStroke draw_line(const Candidate& c) {
    const double theta = angles[static_cast<std::size_t>(c.line)];
    reformat::CurvedOptions view;
    view.theta_deg = theta * 180.0 / pi;
    view.pixel_mm = pixel_mm;
    view.width = view.height = options.picture_px;
    view.s_start_mm = 0.5 * (from_mm + to_mm) - 0.5 * pixel_mm * options.picture_px;
    const reformat::CurvedReformation reformation(axis, view);
    lumen::CprStroke stroke;
    stroke.vessel = vessel;
    stroke.theta_deg = view.theta_deg;
    stroke.beta_deg = options.beta_deg;
    const double sigma_px = std::max(1.0, options.pointing_sigma_mm / pixel_mm);
    for (const auto& [s, rho] : points_of_line(c)) {
      const auto seen = reformation.project(axis->place(s, theta, rho), s);
      if (!seen) continue;
      const Vec2 hit = seen->picture_px + Vec2(click(sigma_px), click(sigma_px));
      stroke.points.push_back(off_axis(reformation.world(hit), s, theta));
    }
    ReaderStroke out;
    out.seconds = seconds(view.theta_deg, stroke.points.size());
    out.edit = std::move(stroke);
    return out;
  }

  ReaderStroke draw_section(const Candidate& c) {
    const double s = sections[static_cast<std::size_t>(c.section)];
    const std::vector<double>& rho = ring[static_cast<std::size_t>(c.section)];
    lumen::SectionContour contour;
    contour.vessel = vessel;
    contour.s_mm = s;
    contour.eps_mm = options.eps_mm;
    contour.closed = true;
    const geometry::Frame frame = axis->frame(s);
    for (int i = 0; i < options.points; ++i) {
      const auto a = static_cast<std::size_t>(i * section_angles / options.points);
      if (std::isnan(rho[a])) continue;
      const double theta = 2.0 * pi * static_cast<double>(a) / section_angles;
      const Vec3 error =
          click(options.pointing_sigma_mm) * frame.normal + click(options.pointing_sigma_mm) * frame.binormal;
      contour.points.push_back(off_axis(axis->place(s, theta, rho[a]) + error, s, theta));
    }
    ReaderStroke out;
    out.on_section = true;
    out.seconds = seconds(1000.0 + s, contour.points.size());
    out.edit = std::move(contour);
    return out;
  }

  double seconds(double view, std::size_t points) {
    const double change = view == last_view ? 0.0 : options.seconds_a_view;
    last_view = view;
    return change + options.seconds_a_stroke + options.seconds_a_point * static_cast<double>(points);
  }
};

SimulatedReader::SimulatedReader(const geometry::ContourSection& overlay,
                                 std::shared_ptr<const AxisCurve> axis, std::int32_t vessel,
                                 const ReaderOptions& options, const Hidden& hidden)
    : impl_(std::make_unique<Impl>()) {
  validate(options);
  if (const auto fault = geometry::find_fault(overlay))
    throw InvalidInput("section " + overlay.section + ": " + *fault);
  Impl& m = *impl_;
  m.axis = std::move(axis);
  m.vessel = vessel;
  m.options = options;
  const auto foot = [&](const geometry::Contour& contour) {
    return m.axis->nearest_foot(geometry::contour_centroid(contour));
  };
  const geometry::AxisFoot first = foot(overlay.contours.front()), last = foot(overlay.contours.back());
  if (!(first.s_mm < last.s_mm) || first.rho_mm > farthest_mm || last.rho_mm > farthest_mm)
    throw InvalidInput("section " + overlay.section +
                       " does not lie along the axis that it is to be edited on");
  m.from_mm = first.s_mm;
  m.to_mm = last.s_mm;
  m.pixel_mm =
      std::max(options.pointing_sigma_mm, (m.to_mm - m.from_mm + 2.0 * beyond_mm) / options.picture_px);

  const geometry::AabbTree surface(evaluation::surface_of(overlay));
  const auto seen = [&](double s, double theta) {
    const Vec3 origin = m.axis->point(s), direction = m.axis->place(s, theta, 1.0) - origin;
    const auto hit = surface.first_hit(origin, direction);
    if (!hit || hit->t > farthest_mm || (hidden && hidden(origin + hit->t * direction))) return nowhere;
    return std::max(hit->t, clear_mm);
  };
  // The first and the last row lie just inside the ends, where a ray still meets the overlay.
  const double inset = 0.05;
  const auto pieces = static_cast<int>(std::ceil((m.to_mm - m.from_mm - 2.0 * inset) / options.row_mm));
  for (int i = 0; i <= pieces; ++i)
    m.rows.push_back(m.from_mm + inset + (m.to_mm - m.from_mm - 2.0 * inset) * i / std::max(1, pieces));
  for (double s = m.from_mm + 0.5; s <= m.to_mm - 0.5; s += options.section_step_mm) m.sections.push_back(s);
  for (const double degrees : options.lines_deg) {
    m.angles.push_back(degrees * pi / 180.0);
    m.angles.push_back(degrees * pi / 180.0 + pi);
  }
  for (const double theta : m.angles) {
    m.line.emplace_back();
    for (const double s : m.rows) m.line.back().push_back(seen(s, theta));
  }
  for (const double s : m.sections) {
    m.ring.emplace_back();
    for (int a = 0; a < section_angles; ++a) m.ring.back().push_back(seen(s, 2.0 * pi * a / section_angles));
  }
}

SimulatedReader::~SimulatedReader() = default;

std::optional<ReaderStroke> SimulatedReader::next(const lumen::ScalarField& wall) {
  Impl& m = *impl_;
  if (m.tried >= m.options.most_strokes) {
    m.why = "gave up after " + std::to_string(m.tried) + " strokes";
    return {};
  }
  const Impl::Candidate on_line = m.worst_line(wall), on_section = m.worst_section(wall);
  const bool section_allowed = m.section_strokes + 1 <= m.options.section_share * (m.strokes + 1);
  const bool take_section = section_allowed && on_section.gain > on_line.gain;
  const Impl::Candidate& chosen = take_section ? on_section : on_line;
  if (!(chosen.gain > least_gain)) {
    m.why = on_section.gain > least_gain ? "what is still seen lies on cross-sections, whose share is used up"
                                         : "no visible disagreement";
    return {};
  }
  ReaderStroke stroke = take_section ? m.draw_section(chosen) : m.draw_line(chosen);
  stroke.worst_mm = chosen.worst_mm;
  ++m.tried;
  ++m.strokes;
  m.section_strokes += take_section ? 1 : 0;
  m.last_drawn = take_section ? std::pair(-1, chosen.section)
                              : std::pair(chosen.line, static_cast<int>(m.rows[chosen.first] / 4.0));
  m.last_on_section = take_section;
  ++m.drawn[m.last_drawn];
  return stroke;
}

void SimulatedReader::refused() {
  impl_->drawn[impl_->last_drawn] = never_again;
  --impl_->strokes;
  impl_->section_strokes -= impl_->last_on_section ? 1 : 0;
}

std::string SimulatedReader::why_stopped() const {
  return impl_->why;
}
double SimulatedReader::pixel_mm() const {
  return impl_->pixel_mm;
}
double SimulatedReader::from_mm() const {
  return impl_->from_mm;
}
double SimulatedReader::to_mm() const {
  return impl_->to_mm;
}

}  // namespace ostia::experiments
