#include "body/body_organs.h"

#include "ostia/phantom/noise.h"

#include <algorithm>
#include <cmath>

namespace ostia::phantom {
namespace {

/// A tree of vessels that fork into the lung: the radius falls by Murray's law with unequal children.
class LungTree {
 public:
  LungTree(std::uint64_t seed, std::uint64_t stream) : seed_(seed), index_(stream << 32) {}

  void grow(const Vec3& from, const Vec3& direction, double radius, int depth) {
    const double length = 5.0 + 6.0 * std::sqrt(radius) * (0.7 + 0.6 * draw());
    const Vec3 bend = 0.25 * any_direction();
    const Vec3 middle = from + 0.5 * length * (direction + 0.5 * bend).normalized();
    const Vec3 ahead = (direction + bend).normalized();
    const Vec3 to = middle + 0.5 * length * ahead;
    pieces_.push_back({from, middle, radius, 0.96 * radius});
    pieces_.push_back({middle, to, 0.96 * radius, 0.9 * radius});
    const double share = 0.25 + 0.4 * draw();
    Vec3 aside = any_direction();
    aside = (aside - ahead * ahead.dot(aside)).normalized();
    const double minor = 0.9 * radius * std::cbrt(share), major = 0.9 * radius * std::cbrt(1.0 - share);
    if (depth <= 0) return;
    if (major > least_mm) grow(to, (ahead - 0.35 * aside).normalized(), major, depth - 1);
    if (minor > least_mm) grow(to, (0.75 * ahead + 0.75 * aside).normalized(), minor, depth - 1);
  }
  const Capsules& pieces() const { return pieces_; }

 private:
  static constexpr double least_mm = 0.42;
  double draw() { return uniform(seed_, index_++); }
  Vec3 any_direction() {
    const double z = 2.0 * draw() - 1.0, a = 2.0 * M_PI * draw();
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
    return {r * std::cos(a), r * std::sin(a), z};
  }
  std::uint64_t seed_, index_;
  Capsules pieces_;
};

}  // namespace

void add_lungs(Organs& organs, const TissueHu& hu, std::uint64_t seed) {
  // Hila, and where their branches go: to the front, the side, the back, up and down.
  Capsules vessels, airways;
  std::uint64_t stream = 0x4c00;
  for (const double side : {-1.0, 1.0}) {
    const Vec3 hilum = side < 0 ? Vec3(-54, 26, 24) : Vec3(53, 32, 28);
    const Vec3 ways[] = {{side, -0.9, 0.1},        {side, -0.2, 0.5},       {side, 0.2, -0.2},
                         {0.7 * side, 0.9, -0.2},  {0.5 * side, 0.5, -1.0}, {0.5 * side, -0.1, -1.0},
                         {0.6 * side, -0.7, -0.6}, {0.4 * side, 0.3, 1.0},  {0.3 * side, -0.8, 0.8},
                         {0.6 * side, 0.7, 0.6},   {0.2 * side, 0.8, -0.8}, {side, -0.5, -0.4}};
    for (const Vec3& way : ways) {
      LungTree tree(seed, stream++);
      const Vec3 direction = way.normalized();
      tree.grow(hilum + 2.0 * direction, direction, 3.2, 12);
      append(vessels, tree.pieces());
    }
    // The lower lobe's branches leave farther down and back.
    const Vec3 lower = hilum + Vec3(4.0 * side, 14.0, -24.0);
    for (const Vec3& way : {Vec3(side, -0.8, -0.7), Vec3(side, 0.1, -0.6), Vec3(0.4 * side, 0.8, -0.6),
                            Vec3(0.3 * side, 0.0, -1.0), Vec3(0.8 * side, 0.6, 0.1),
                            Vec3(0.5 * side, -0.5, -1.0), Vec3(0.8 * side, -1.0, 0.0)}) {
      LungTree tree(seed, stream++);
      tree.grow(lower, way.normalized(), 2.9, 12);
      append(vessels, tree.pieces());
    }
    const Vec3 airway_from = side < 0 ? Vec3(-56, 38, 16) : Vec3(52, 42, 22);
    for (const Vec3& way : {Vec3(0.5 * side, 0.5, -1.0), Vec3(side, -0.6, 0.0), Vec3(0.6 * side, 0.5, 0.5),
                            Vec3(0.7 * side, -0.4, -0.7)}) {
      LungTree tree(seed, stream++);
      tree.grow(airway_from, way.normalized(), 2.6, 5);
      append(airways, tree.pieces());
    }
  }
  organs.push_back({{Label::airway, -960.0f}, {}, {}, airways});
  organs.push_back({{Label::pulmonary_vessel, hu.pulmonary - 40.0f}, {}, {}, vessels});
  organs.push_back({{Label::lung, -420.0f}, {}, {}, grown(airways, 0.8)});
  // Between ribs and mediastinum; flat where it meets the diaphragm, which comes before.
  organs.push_back({{Label::lung, hu.lung}, {26.0f, 2.6f, 0.45f}, column(-8.0, 16.0, 120.0, 87.5), {}});
}

}  // namespace ostia::phantom
