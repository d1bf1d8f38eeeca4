// Lungs, airways, spine, ribs, sternum, muscles, fat, skin, and what lies below the diaphragm.
#include "body_organs.h"

#include "ostia/phantom/noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

using geometry::Centerline;

constexpr double pi = std::numbers::pi;
constexpr double chest_x = -4.0, chest_y = 16.0;     // the middle of the chest about the heart's base
constexpr double pleura_x = 132.0, pleura_y = 98.0;  // semi-axes of the chest's inside
constexpr double vertebra_pitch_mm = 25.0, disc_mm = 5.0;

Material material(Label label, float hu) {
  return {label, hu};
}

/// Twigs that fork again and again from a hilum outwards.
class Twigs {
 public:
  explicit Twigs(std::uint64_t seed) : seed_(seed) {}
  void grow(const Vec3& from, const Vec3& direction, double radius_mm, int generations) {
    if (generations == 0 || radius_mm < 0.35) return;
    const double length = 7.0 + 5.5 * std::sqrt(radius_mm) * (0.7 + 0.6 * draw());
    const Vec3 bend = from + 0.5 * length * direction + 0.12 * length * random_vector();
    const Vec3 to = from + length * direction + 0.15 * length * random_vector();
    lines.push_back(curve({from, bend, to}, {radius_mm, 0.95 * radius_mm, 0.88 * radius_mm}));
    const Vec3 aside = direction.cross(random_vector()).normalized();
    const double share = 0.55 + 0.35 * draw();
    const double big = 0.88 * radius_mm * std::cbrt(share) * 0.98,
                 small = 0.88 * radius_mm * std::cbrt(1.0 - share);
    grow(to, (direction + 0.42 * aside).normalized(), big, generations - 1);
    grow(to, (direction - 0.85 * aside).normalized(), small, generations - 1);
  }
  std::vector<Centerline> lines;

 private:
  double draw() { return uniform(seed_, 0x4c554e4700000000 + index_++); }
  Vec3 random_vector() { return Vec3(draw() - 0.5, draw() - 0.5, draw() - 0.5) * 2.0; }
  std::uint64_t seed_, index_ = 0;
};

Distance lungs() {
  const Distance pleura = column(chest_x, chest_y, pleura_x, pleura_y);
  const Distance behind = column(2.0, 98.0, 30.0, 40.0);   // spine and what lies before it
  const Distance middle = column(2.0, 62.0, 30.0, 34.0);   // descending aorta, oesophagus
  const Distance front = column(-6.0, -78.0, 16.0, 12.0);  // behind the sternum
  const Distance above = both(column(0.0, 10.0, 40.0, 70.0), half_space(Vec3(0, 0, 46), Vec3(0, 0, -1)));
  const Distance right_dome = ellipsoid(Vec3(-62, 8, -128), Vec3(88, 92, 62));
  const Distance left_dome = ellipsoid(Vec3(62, 14, -140), Vec3(80, 88, 62));
  return without(pleura, either({behind, middle, front, above, right_dome, left_dome}));
}

/// Vertebral bodies with discs between them, pedicles, arch and spinous process.
void add_spine(Organs& organs, const BodyOptions& options) {
  const Distance body = column(1.0, 99.0, 18.0, 14.0);
  const auto between = [](const Vec3& p) {  // positive within the discs
    const double z = p.z() / vertebra_pitch_mm;
    return 0.5 * disc_mm - std::abs(z - std::round(z)) * vertebra_pitch_mm;
  };
  const Distance bone = [=](const Vec3& p) { return std::max(body(p), between(p)); };
  const Distance canal = column(1.0, 122.0, 9.0, 8.0);
  const Distance arch = [=](const Vec3& p) {
    const double z = p.z() / vertebra_pitch_mm;
    const double low = std::abs(z - std::round(z) - 0.1) * vertebra_pitch_mm - 8.0;
    const double ring = std::max(std::abs(std::hypot(p.x() - 1.0, p.y() - 122.0) - 12.5) - 3.5, low);
    const double spine = std::max({std::abs(p.x() - 1.0) - 3.0, std::abs(p.y() - 146.0) - 14.0, low - 2.0});
    const double wings =
        std::max({std::abs(std::abs(p.x() - 1.0) - 26.0) - 14.0, std::abs(p.y() - 122.0) - 5.0, low + 2.0});
    return std::min({ring, spine, wings});
  };
  organs.push_back({material(Label::muscle, 35.0f), canal, {3.0f, 6.0f}, 1.0, false});
  const auto bony = [&](const Distance& shape, double shell_mm) {
    organs.push_back(
        {material(Label::marrow, options.hu.marrow), grown(shape, -shell_mm), {55.0f, 1.6f}, 1.0, false});
    organs.push_back({material(Label::bone, options.hu.bone), shape, {40.0f, 3.0f}, 1.0, false});
  };
  bony(bone, 1.3);
  bony(arch, 1.8);
  organs.push_back({material(Label::muscle, 75.0f), body, {5.0f, 5.0f}, 1.0, false});  // discs
}

void add_ribs(Organs& organs, const BodyOptions& options) {
  std::vector<Centerline> bones, cartilages;
  for (int rib = -5; rib <= 6; ++rib) {
    for (const double side : {-1.0, 1.0}) {
      std::vector<Vec3> points;
      std::vector<double> radii;
      for (int i = 0; i <= 12; ++i) {
        const double t = i / 12.0,
                     angle = pi / 2 - side * (0.2 + t * (pi - 0.55));  // from the spine forwards
        points.push_back({chest_x + (pleura_x + 6.5) * std::cos(angle),
                          chest_y + (pleura_y + 6.5) * std::sin(angle),
                          26.0 * rib + 22.0 - 62.0 * std::sin(0.5 * pi * t)});
        radii.push_back(5.2 + 1.0 * std::sin(pi * t));
      }
      bones.push_back(curve(points, radii, 2.0));
      const Vec3 end = points.back();
      cartilages.push_back(curve({end, 0.5 * (end + Vec3(chest_x + 12 * side, -87, end.z() + 14)),
                                  Vec3(chest_x + 12 * side, -86, end.z() + 24)},
                                 {6.0, 6.0, 5.0}, 2.0));
    }
  }
  const Distance ribs = tubes(bones);
  const Distance sternum = either({column(chest_x, -88.0, 17.0, 6.5)});
  organs.push_back({material(Label::marrow, 110.0f), grown(ribs, -1.5), {45.0f, 2.0f}, 1.1, false});
  organs.push_back({material(Label::bone, options.hu.bone + 60.0f), ribs, {50.0f, 3.0f}, 1.1, false});
  organs.push_back({material(Label::marrow, 105.0f), grown(sternum, -1.3), {40.0f, 2.0f}, 1.0, false});
  organs.push_back({material(Label::bone, options.hu.bone - 120.0f), sternum, {50.0f, 3.0f}, 1.0, false});
  organs.push_back({material(Label::muscle, 105.0f), tubes(cartilages), {10.0f, 4.0f}, 1.1, false});
}

void add_lungs(Organs& organs, const BodyOptions& options) {
  const Distance air = lungs();
  Twigs twigs(options.seed);
  const auto hilum = [&](const Vec3& at, double radius, const std::vector<Vec3>& directions) {
    for (const Vec3& d : directions) twigs.grow(at, d.normalized(), radius, 9);
  };
  hilum({56, 38, 46}, 4.2,
        {{0.8, -0.5, 0.3}, {0.7, 0.5, -0.2}, {0.5, 0.4, -0.8}, {0.5, -0.7, -0.3}, {0.5, 0.3, 0.9}});
  hilum({-50, 26, 46}, 4.4,
        {{-0.8, -0.5, 0.3}, {-0.7, 0.5, -0.2}, {-0.5, 0.4, -0.8}, {-0.5, -0.7, -0.3}, {-0.5, 0.3, 0.9}});
  hilum({66, 52, 14}, 3.6, {{0.8, 0.2, -0.4}, {0.5, -0.5, -0.7}, {0.4, 0.7, -0.6}});
  hilum({-60, 46, 8}, 3.6, {{-0.8, 0.2, -0.4}, {-0.5, -0.6, -0.6}, {-0.4, 0.7, -0.6}});
  Twigs airways(options.seed + 77);
  airways.grow({50, 44, 44}, Vec3(0.75, 0.4, -0.5).normalized(), 3.6, 5);
  airways.grow({-46, 38, 44}, Vec3(-0.75, 0.4, -0.5).normalized(), 3.6, 5);
  airways.lines.push_back(curve({{2, 34, 120}, {2, 36, 85}, {22, 40, 66}, {50, 44, 44}}, {8, 8, 6, 4}));
  airways.lines.push_back(curve({{2, 36, 85}, {-18, 38, 66}, {-46, 38, 44}}, {7, 6.5, 4}));
  const Distance bronchi = tubes(airways.lines);
  organs.push_back({material(Label::airway, -960.0f), bronchi, {}, 1.1, true});
  organs.push_back({material(Label::muscle, 10.0f), grown(bronchi, 0.9), {}, 1.1, true});
  organs.push_back({material(Label::pulmonary_vessel, options.hu.pulmonary - 10.0f),
                    both(air, tubes(twigs.lines)),
                    {8.0f, 8.0f},
                    1.1,
                    true});
  organs.push_back({material(Label::lung, options.hu.lung), air, {22.0f, 3.5f}, 1.0, false});
}

}  // namespace

void add_thorax(Organs& organs, const BodyOptions& options) {
  const Distance gullet =
      tube({{8, 58, 120}, {6, 60, 40}, {10, 58, -20}, {16, 54, -70}, {22, 48, -120}}, {7.5, 7.5, 8, 8, 9});
  const Distance bubble = tube({{8.5, 57, 60}, {7, 59, 30}}, {2.2, 1.6});
  organs.push_back({material(Label::airway, -900.0f), bubble, {}, 1.1, true});
  organs.push_back({material(Label::oesophagus, 45.0f), gullet, {7.0f, 4.0f}, 1.1, false});
  add_spine(organs, options);
  add_lungs(organs, options);
  const Distance pleura = column(chest_x, chest_y, pleura_x, pleura_y);
  const Distance liver = both(pleura, ellipsoid(Vec3(-55, 8, -130), Vec3(95, 88, 60)));
  const Distance stomach = both(pleura, ellipsoid(Vec3(66, 30, -145), Vec3(52, 52, 52)));
  organs.push_back({material(Label::liver, options.hu.liver), liver, {6.0f, 7.0f}, 1.0, false});
  organs.push_back({material(Label::muscle, 40.0f), stomach, {5.0f, 7.0f}, 1.0, false});
  add_ribs(organs, options);
  organs.push_back({material(Label::fat, options.hu.fat), pleura, {9.0f, 6.0f}, 1.0, false});  // mediastinum
  const Distance wall = column(chest_x, chest_y + 4.0, pleura_x + 24.0, pleura_y + 27.0);
  const Distance back = either({column(-34.0, 136.0, 26.0, 17.0), column(36.0, 136.0, 26.0, 17.0)});
  organs.push_back({material(Label::muscle, options.hu.muscle),
                    both(either({column(chest_x, chest_y, pleura_x + 14.0, pleura_y + 13.0), back}), wall),
                    {14.0f, 4.0f},
                    1.0,
                    false});
  const Distance skin = column(chest_x, chest_y + 6.0, pleura_x + 44.0, pleura_y + 42.0);
  organs.push_back(
      {material(Label::fat, options.hu.fat - 6.0f), grown(skin, -2.0), {8.0f, 7.0f}, 1.0, false});
  organs.push_back({material(Label::skin, 40.0f), skin, {}, 1.0, false});
}

}  // namespace ostia::phantom
