#include "heart/heart_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace ostia::phantom {
namespace {

constexpr double place_degree = std::numbers::pi / 180.0;
using Table = std::array<std::pair<double, double>, 6>;

/// Linear between the rows, the ends' beyond.
double looked_up(const Table& table, double x) {
  if (x <= table.front().first) return table.front().second;
  for (std::size_t i = 1; i < table.size(); ++i) {
    const auto& [from, low] = table[i - 1];
    const auto& [to, high] = table[i];
    if (x <= to) return low + (high - low) * (x - from) / (to - from);
  }
  return table.back().second;
}

// As coronary_courses.cpp draws them: of the LAD by depth, of the groove between atria and ventricles by the
// angle in degrees (the right coronary artery's way on from the acute margin, then the circumflex artery's).
constexpr Table anterior_turn{
    {{0.12, 4.0}, {0.24, 1.0}, {0.42, -2.0}, {0.6, -3.0}, {0.8, -5.0}, {0.95, -7.0}}};
constexpr Table anterior_height{{{0.12, 5.0}, {0.24, 4.2}, {0.42, 3.6}, {0.6, 3.2}, {0.8, 2.8}, {0.95, 2.3}}};
constexpr Table posterior_height{
    {{0.05, 3.8}, {0.16, 3.4}, {0.34, 2.8}, {0.52, 2.5}, {0.7, 2.2}, {0.9, 2.0}}};
constexpr Table surface_height{{{0.0, 4.2}, {0.16, 3.3}, {0.32, 2.7}, {0.45, 2.4}, {0.66, 2.2}, {0.9, 2.0}}};
constexpr Table ring_depth{
    {{-160.0, -0.01}, {-100.0, 0.02}, {-58.0, 0.01}, {10.0, -0.01}, {42.0, -0.03}, {60.0, -0.03}}};
constexpr Table ring_height{
    {{-100.0, 4.0}, {-58.0, 4.2}, {-22.0, 4.4}, {10.0, 4.6}, {30.0, 5.4}, {42.0, 6.5}}};
constexpr Table left_depth{
    {{18.0, 0.03}, {24.0, 0.02}, {40.0, -0.02}, {62.0, -0.02}, {84.0, -0.01}, {104.0, 0.0}}};
constexpr Table left_height{{{18.0, 5.5}, {24.0, 5.5}, {40.0, 5.0}, {62.0, 4.6}, {84.0, 4.2}, {104.0, 4.0}}};

double turned_to(double angle, double about) {
  return about + std::remainder(angle - about, 2.0 * std::numbers::pi);
}

/// On the left of the heart: an angle beyond the anterior groove.
bool on_the_left(const HeartShape& heart, double phi_rad, double& beyond_deg) {
  beyond_deg = turned_to(phi_rad - heart.anterior_groove_rad, 60.0 * place_degree) / place_degree;
  return beyond_deg > 0.0 && beyond_deg < 130.0;
}

}  // namespace

HeartPlace heart_place(const HeartShape& heart, const Vec3& point) {
  Vec3 on = point;
  HeartPlace place;
  for (int i = 0; i < 12; ++i) {
    const Vec3 d = on - heart.base;
    const Vec3 unit = Vec3(d.dot(heart.right) / heart.half_width_right_mm,
                           d.dot(heart.up) / heart.half_width_up_mm, d.dot(heart.long_axis) / heart.length_mm)
                          .normalized();
    place.phi_rad = std::atan2(unit.y(), unit.x());
    place.depth = std::clamp(unit.z(), -0.999, 0.999);
    const Vec3 normal = heart.epicardial_normal(place.phi_rad, place.depth);
    place.outwards_mm = (point - heart.epicardium(place.phi_rad, place.depth)).dot(normal);
    on = point - place.outwards_mm * normal;
  }
  return place;
}

Groove groove_of(const std::string& vessel) {
  if (vessel == "LAD") return Groove::anterior;
  if (vessel == "PDA") return Groove::posterior;
  if (vessel == "RCA" || vessel == "LCX") return Groove::atrioventricular;
  if (vessel.starts_with("S") && vessel != "SVG") return Groove::within;
  return Groove::none;
}

HeartPlace in_groove(const HeartShape& heart, Groove groove, const HeartPlace& place) {
  HeartPlace out = place;
  if (groove == Groove::anterior)
    out.phi_rad = turned_to(heart.anterior_groove_rad + place_degree * looked_up(anterior_turn, place.depth),
                            place.phi_rad);
  if (groove == Groove::posterior) out.phi_rad = turned_to(heart.posterior_groove_rad, place.phi_rad);
  if (groove == Groove::atrioventricular) {
    double beyond = 0.0;
    out.depth =
        on_the_left(heart, place.phi_rad, beyond)
            ? looked_up(left_depth, beyond)
            : looked_up(ring_depth, std::remainder(place.phi_rad, 2.0 * std::numbers::pi) / place_degree);
  }
  return out;
}

double usual_height_mm(const HeartShape& heart, Groove groove, const HeartPlace& place) {
  if (groove == Groove::anterior) return looked_up(anterior_height, place.depth);
  if (groove == Groove::posterior) return looked_up(posterior_height, place.depth);
  if (groove == Groove::none) return looked_up(surface_height, place.depth);
  double beyond = 0.0;
  if (on_the_left(heart, place.phi_rad, beyond)) return looked_up(left_height, beyond);
  return looked_up(ring_height, std::remainder(place.phi_rad, 2.0 * std::numbers::pi) / place_degree);
}

}  // namespace ostia::phantom
