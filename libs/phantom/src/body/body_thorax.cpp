#include "body/body_organs.h"

#include "ostia/phantom/noise.h"

#include <algorithm>
#include <cmath>

namespace ostia::phantom {
namespace {

constexpr double middle_x = -8.0;  // of the chest: the heart's base lies a little to the left of it
constexpr double middle_y = 16.0;
constexpr double cavity_x = 120.0, cavity_y = 87.5;  // semi-axes of the inside of the ribs
constexpr double spine_y = 84.0;
constexpr double level_mm = 26.0;  // a vertebra and its disc

/// Vertebral bodies with waists; `shrink_mm` less all round.
Distance vertebrae(double shrink_mm) {
  return [=](const Vec3& p) {
    const double z = std::remainder(p.z() + 4.0, level_mm);
    const double waist = 1.8 * (1.0 - std::pow(std::min(1.0, std::abs(z) / 10.5), 2.0));
    const double u = (p.x() - middle_x) / 17.5, v = (p.y() - spine_y) / 15.5;
    const double side = 15.5 * (std::sqrt(u * u + v * v) - 1.0) + waist + shrink_mm;
    return std::max(side, std::abs(z) - 10.8 + shrink_mm) / 1.4;
  };
}

void add_spine(Organs& organs, const TissueHu& hu) {
  const Texture trabecular{38.0f, 2.2f, 0.0f};
  organs.push_back({{Label::fat, 20.0f}, {}, column(middle_x, spine_y + 23.0, 9.5, 7.5), {}});  // canal
  organs.push_back({{Label::marrow, hu.marrow}, trabecular, vertebrae(1.3), {}});
  organs.push_back({{Label::bone, hu.bone}, {60.0f, 4.0f, 0.0f}, vertebrae(0.0), {}});
  organs.push_back({{Label::muscle, 85.0f}, {8.0f, 5.0f, 0.0f}, column(middle_x, spine_y, 16.0, 14.0), {}});
  // The arch about the canal, transverse and spinous processes at every level.
  const Distance levels = [](const Vec3& p) { return std::abs(std::remainder(p.z() + 8.0, level_mm)) - 7.5; };
  const Distance arch = both(column(middle_x, spine_y + 24.0, 15.0, 12.5), levels);
  const Distance processes =
      both(either({column(middle_x, spine_y + 42.0, 4.0, 14.0), column(middle_x, spine_y + 29.0, 32.0, 6.0)}),
           levels);
  const Distance both_parts = either({arch, processes});
  organs.push_back({{Label::marrow, hu.marrow + 60.0f}, trabecular, grown(both_parts, -1.5), {}});
  organs.push_back({{Label::bone, hu.bone + 60.0f}, {60.0f, 4.0f, 0.0f}, both_parts, {}});
}

/// Ribs fall from the spine to the front; the last third is cartilage that rises towards the sternum.
void add_ribs(Organs& organs, const TissueHu& hu) {
  Capsules bone, cartilage;
  for (int side = -1; side <= 1; side += 2) {
    for (int rib = -6; rib <= 6; ++rib) {
      std::vector<Vec3> way, front;
      for (int k = 0; k <= 14; ++k) {
        const double a = (170.0 - 11.0 * k) * M_PI / 180.0;  // from the back to the front
        const double fall = 62.0 * std::pow(k / 14.0, 1.3);
        const Vec3 p(middle_x + side * (cavity_x + 6.5) * std::sin(a),
                     middle_y - (cavity_y + 6.0) * std::cos(a),
                     27.0 * rib + 48.0 - fall + (k > 11 ? 7.0 * (k - 11) : 0.0));
        if (k <= 11) way.push_back(p);
        if (k >= 11) front.push_back(p);
      }
      append(bone, tube(way, std::vector<double>(way.size(), 5.6), 3.0));
      append(cartilage, tube(front, std::vector<double>(front.size(), 5.6), 3.0));
    }
  }
  organs.push_back({{Label::marrow, hu.marrow + 20.0f}, {40.0f, 2.5f, 0.0f}, {}, grown(bone, -1.5)});
  organs.push_back({{Label::bone, hu.bone + 40.0f}, {70.0f, 5.0f, 0.0f}, {}, bone});
  organs.push_back({{Label::muscle, 110.0f}, {14.0f, 4.0f, 0.0f}, {}, cartilage});
}

constexpr double sternum_y = middle_y - cavity_y - 6.5;
constexpr double sternum_x_mm = 17.5, sternum_y_mm = 5.9;  // semi-axes

void add_sternum(Organs& organs, const TissueHu& hu) {
  organs.push_back(
      {{Label::marrow, hu.marrow - 50.0f}, {35.0f, 2.5f, 0.0f}, column(middle_x, sternum_y, 16.3, 4.6), {}});
  organs.push_back({{Label::bone, hu.bone - 60.0f},
                    {60.0f, 5.0f, 0.0f},
                    column(middle_x, sternum_y, sternum_x_mm, sternum_y_mm),
                    {}});
}

}  // namespace

Capsules sternal_wire(double height_mm) {
  constexpr double radius = 0.4, clear = 0.7;
  constexpr int pieces = 36;
  const auto at = [&](int n) {
    const double a = 2.0 * M_PI * n / pieces;
    return Vec3(middle_x + (sternum_x_mm + clear) * std::sin(a),
                sternum_y - (sternum_y_mm + clear) * std::cos(a), height_mm);
  };
  Capsules out;
  for (int n = 0; n < pieces; ++n) out.push_back({at(n), at(n + 1), radius, radius});
  const Vec3 knot = at(0);
  out.push_back({knot, knot + Vec3(1.2, -0.9, 5.0), 2.0 * radius, 1.6 * radius});
  return out;
}

Vec3 mammary_bed(double height_mm) {
  return {middle_x + sternum_x_mm + 5.0, sternum_y + sternum_y_mm + 3.0, height_mm};
}

void add_bones(Organs& organs, const TissueHu& hu) {
  add_spine(organs, hu);
  add_sternum(organs, hu);
  add_ribs(organs, hu);
}

void add_mediastinum(Organs& organs, const TissueHu& hu, const Noise& noise) {
  const Texture soft{7.0f, 6.0f, 0.0f};
  // Oesophagus between left atrium and spine, collapsed about a little air.
  organs.push_back({{Label::airway, -700.0f},
                    {140.0f, 3.0f, 0.0f},
                    both(column(4.0, 59.0, 2.6, 1.3), ellipsoid({4, 59, 34}, Vec3(9, 9, 19))),
                    {}});
  organs.push_back({{Label::oesophagus, 48.0f}, soft, column(4.0, 59.0, 8.5, 4.6), {}});
  Capsules azygos = tube({{-13, 68, -150}, {-14, 67, 0}, {-16, 64, 150}}, {3.6, 4.0, 4.4}, 6.0);
  organs.push_back({{Label::vein, 130.0f}, {8.0f, 6.0f, 0.0f}, {}, azygos});
  Capsules nodes;
  for (const Vec3& p :
       {Vec3(-4, 40, 47), Vec3(8, 38, 40), Vec3(-28, 34, 40), Vec3(26, 30, 47), Vec3(-22, 6, 60)})
    nodes.push_back({p, p + Vec3(3, 2, 4), 3.6, 3.0});
  organs.push_back({{Label::muscle, 85.0f}, soft, {}, nodes});
  // Right and left main bronchus; the trachea divides above.
  Capsules bronchi = tube({{-6, 40, 72}, {-26, 37, 54}, {-46, 32, 36}, {-56, 38, 16}}, {7.0, 6.5, 5.5, 3.8});
  append(bronchi, tube({{-6, 40, 72}, {14, 38, 56}, {36, 36, 42}, {52, 42, 22}}, {7.0, 6.0, 5.4, 3.8}));
  append(bronchi, tube({{-4, 36, 150}, {-6, 40, 72}}, {8.5, 8.0}));
  organs.push_back({{Label::airway, -985.0f}, {}, {}, bronchi});
  organs.push_back({{Label::muscle, 10.0f}, {}, {}, grown(bronchi, 1.3)});
  // Liver under the right dome of the diaphragm, stomach with its air under the left one.
  const Distance dome = uneven(ellipsoid({-54, 8, -106}, Vec3(86, 84, 76)), 0.7, 24.0, noise);
  organs.push_back({{Label::liver, hu.liver}, {8.0f, 6.0f, 0.0f}, dome, {}});
  const Distance left_dome = uneven(ellipsoid({56, 16, -117}, Vec3(74, 76, 70)), 0.7, 24.0, noise);
  const Distance gas = both(ellipsoid({60, 6, -84}, Vec3(24, 30, 17)), half_space({0, 4, 0}, Vec3::UnitY()));
  organs.push_back({{Label::airway, -960.0f}, {}, gas, {}});
  organs.push_back(
      {{Label::muscle, 60.0f}, {10.0f, 5.0f, 0.0f}, ellipsoid({60, 6, -86}, Vec3(30, 37, 24)), {}});
  organs.push_back(
      {{Label::fat, hu.fat + 6.0f}, {12.0f, 6.0f, 0.0f}, ellipsoid({56, 16, -117}, Vec3(71, 73, 67)), {}});
  const Distance diaphragm = either({left_dome, ellipsoid({-54, 8, -106}, Vec3(89, 87, 79))});
  organs.push_back({{Label::muscle, hu.muscle}, soft, diaphragm, {}});
  // Fat between the lungs: about the great vessels, the gullet, the aorta and the spine; before the heart to
  // the sternum, and in the corners between heart and diaphragm.
  const Distance upper =
      both(ellipsoid({-5, 8, 70}, Vec3(40, 58, 66)), half_space({0, 0, 20}, -Vec3::UnitZ()));
  const Distance back =
      either({column(2.0, 57.0, 15.0, 13.0), column(16.0, 72.0, 14.5, 14.0), column(-8.0, 86.0, 22.5, 19.5)});
  const Distance front =
      either({ellipsoid({-3, -62, 10}, Vec3(12, 28, 75)), ellipsoid({-6, -74, 10}, Vec3(24, 11, 90))});
  const Distance apron = ellipsoid({22, -58, -52}, Vec3(44, 19, 17));
  const Distance corner = ellipsoid({-26, -36, -48}, Vec3(28, 26, 17));
  organs.push_back({{Label::fat, hu.fat},
                    {9.0f, 6.0f, 0.0f},
                    uneven(either({upper, back, front, apron, corner}), 1.0, 13.0, noise),
                    {}});
}

void add_chest_wall(Organs& organs, const TissueHu& hu, std::uint64_t seed) {
  const Texture soft{9.0f, 5.0f, 0.0f};
  // Intercostal fat and muscle, the muscles of breast and back, then fat and skin.
  organs.push_back({{Label::fat, hu.fat + 10.0f},
                    {22.0f, 5.0f, 0.0f},
                    column(middle_x, middle_y, cavity_x + 3.0, cavity_y + 2.2),
                    {}});
  organs.push_back({{Label::muscle, hu.muscle - 10.0f},
                    {26.0f, 5.0f, 0.0f},
                    column(middle_x, middle_y, cavity_x + 13.0, cavity_y + 14.5),
                    {}});
  const Distance back = either({column(middle_x - 30.0, spine_y + 42.0, 27.0, 15.0),
                                column(middle_x + 30.0, spine_y + 42.0, 27.0, 15.0)});
  const Distance pectoral =
      either({both(column(52, -68, 48, 20), half_space({0, 0, -28}, -Vec3(0, 0.3, 1))),
              both(column(-68, -68, 48, 20), half_space({0, 0, -28}, -Vec3(0, 0.3, 1)))});
  organs.push_back({{Label::muscle, hu.muscle}, {16.0f, 4.0f, 0.0f}, either({back, pectoral}), {}});
  const double thick = 10.0 + 11.0 * uniform(seed, 0x464154);
  const double breast = 14.0 + 18.0 * uniform(seed, 0x425245);
  const Distance trunk = column(middle_x, middle_y + 3.0, cavity_x + 18.0 + thick, cavity_y + 14.0 + thick);
  const double front_y = middle_y - cavity_y - 4.0 - thick;
  const Distance body =
      either({trunk, ellipsoid({middle_x + 72, front_y + 22.0, -40}, Vec3(52, 22.0 + breast, 48)),
              ellipsoid({middle_x - 72, front_y + 22.0, -40}, Vec3(52, 22.0 + breast, 48))});
  organs.push_back({{Label::fat, hu.fat - 4.0f}, {11.0f, 7.0f, 0.0f}, grown(body, -1.8), {}});
  organs.push_back({{Label::skin, 15.0f}, soft, body, {}});
  // The table: a shell of fibre about foam.
  const double table_y = middle_y + 3.0 + cavity_y + 14.0 + thick;
  const Distance table =
      both(half_space({0, table_y, 0}, -Vec3::UnitY()), half_space({0, table_y + 30, 0}, Vec3::UnitY()));
  organs.push_back({{Label::outside_air, -930.0f}, {}, grown(table, -2.0), {}});
  organs.push_back({{Label::outside_air, -250.0f}, {}, table, {}});
}

}  // namespace ostia::phantom
