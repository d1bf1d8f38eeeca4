// What patients carry: how many, where, and that nothing else changes.

#include "ostia/phantom/carried.h"

#include "ostia/core/error.h"
#include "ostia/phantom/body.h"
#include "ostia/phantom/scan.h"
#include "ostia/phantom/vessel_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace ostia::phantom {
namespace {

struct Patient {
  explicit Patient(std::uint64_t seed, Anatomy anatomy = Anatomy::usual)
      : heart(draw_heart(seed)),
        tree(draw_coronaries(heart, {.seed = seed, .anatomy = anatomy})),
        body(heart, tree, draw_body(seed)) {}
  std::vector<CarriedThing> carries(const ScanRealism& realism, std::uint64_t seed = 1) const {
    return carried_things({heart, tree, nullptr, body}, realism, seed);
  }
  HeartShape heart;
  CoronaryTree tree;
  Body body;
};

const Patient& patient() {
  static const Patient made(1);
  return made;
}

ScanRealism with(int wires, int clips, int electrodes, int leads) {
  ScanRealism out;
  out.sternal_wires = wires;
  out.clips = clips;
  out.ecg_leads = electrodes;
  out.pacemaker_leads = leads;
  return out;
}

/// From a place to the nearest one of a label, at most 6 mm.
double distance_to(const Body& body, const Vec3& p, Label label) {
  for (double r = 0.0; r <= 6.0; r += 0.5) {
    for (int a = 0; a < 16; ++a) {
      for (int b = -4; b <= 4; ++b) {
        const double phi = a * std::numbers::pi / 8.0, z = b / 4.0, w = std::sqrt(1.0 - z * z);
        if (body.at(p + r * Vec3(w * std::cos(phi), w * std::sin(phi), z)).label == label) return r;
      }
    }
  }
  return 1e9;
}

TEST(Carried, NothingIsCarriedUnlessAskedFor) {
  EXPECT_TRUE(patient().carries({}).empty());
}

TEST(Carried, AsManyAsAskedForAndOthersForAnotherSeed) {
  const auto things = patient().carries(with(6, 9, 4, 2));
  const auto count = [&](ThingKind kind) {
    return std::count_if(things.begin(), things.end(), [&](const CarriedThing& t) { return t.kind == kind; });
  };
  EXPECT_EQ(count(ThingKind::sternal_wire), 6);
  EXPECT_EQ(count(ThingKind::clip), 9);
  EXPECT_EQ(count(ThingKind::ecg_lead), 4);
  EXPECT_EQ(count(ThingKind::pacemaker_lead), 2);
  EXPECT_EQ(patient().carries(with(6, 9, 4, 2))[7].pieces[0].from, things[7].pieces[0].from);
  EXPECT_NE(patient().carries(with(6, 9, 4, 2), 2)[7].pieces[0].from, things[7].pieces[0].from);
}

TEST(Carried, WiresGoRoundTheSternumOneAboveTheOther) {
  std::vector<double> heights;
  for (const CarriedThing& wire : patient().carries(with(6, 0, 0, 0))) {
    const Vec3 centre = 0.5 * (wire.pieces[0].from + wire.pieces[18].from);
    const auto angle_at = [&](const Vec3& p) { return std::atan2((p - centre).y(), (p - centre).x()); };
    double turned = 0.0;
    for (std::size_t i = 0; i + 1 < wire.pieces.size(); ++i) {  // the last one is the knot
      const MetalPiece& piece = wire.pieces[i];
      EXPECT_NEAR((piece.from - wire.pieces[0].from).z(), 0.0, 1e-9);
      EXPECT_LT(distance_to(patient().body, piece.from, Label::bone), 2.1);
      EXPECT_NE(patient().body.at(piece.from).label, Label::bone);
      turned += std::remainder(angle_at(piece.to) - angle_at(piece.from), 2.0 * std::numbers::pi);
    }
    EXPECT_NEAR(std::abs(turned), 2.0 * std::numbers::pi, 1e-6);
    heights.push_back(wire.pieces[0].from.z());
  }
  for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
    EXPECT_GT(heights[i + 1] - heights[i], 15.0);
    EXPECT_LT(heights[i + 1] - heights[i], 35.0);
  }
}

TEST(Carried, ClipsLieBesideAGraftWhereThereIsOne) {
  const Patient grafted(1, Anatomy::bypass);
  const VesselField field(grafted.tree);
  for (const CarriedThing& clip : grafted.carries(with(0, 8, 0, 0))) {
    ASSERT_EQ(clip.pieces.size(), 2u);
    const Vec3 middle = 0.5 * (clip.pieces[0].from + clip.pieces[0].to);
    const double away = field.value(Boundary::wall, middle, 10.0);
    EXPECT_GT(away, 0.2);
    EXPECT_LT(away, 4.0);
    EXPECT_NEAR((clip.pieces[0].to - clip.pieces[0].from).norm(), 5.0, 0.2);
  }
  for (const CarriedThing& clip : patient().carries(with(0, 8, 0, 0))) {
    EXPECT_LT(clip.pieces[0].from.y(), -55.0);  // behind the sternum
    EXPECT_GT(clip.pieces[0].from.y(), -85.0);
  }
}

TEST(Carried, ElectrodesLieOnTheSkin) {
  for (const CarriedThing& lead : patient().carries(with(0, 0, 6, 0))) {
    ASSERT_GT(lead.pieces.size(), 4u);
    for (const MetalPiece& piece : lead.pieces) {
      EXPECT_EQ(patient().body.at(piece.to).label, Label::outside_air);
      EXPECT_LT(distance_to(patient().body, piece.to, Label::skin), 5.5);
    }
  }
}

TEST(Carried, PacemakerLeadsEndInTheirChambers) {
  const auto leads = patient().carries(with(0, 0, 0, 2));
  std::vector<std::set<Label>> met;
  for (const CarriedThing& lead : leads) {
    std::set<Label>& labels = met.emplace_back();
    for (const MetalPiece& piece : lead.pieces) labels.insert(patient().body.at(piece.to).label);
    EXPECT_TRUE(labels.count(Label::vein) == 1);
    EXPECT_TRUE(labels.count(Label::right_atrium) == 1);
    EXPECT_TRUE(labels.count(Label::left_ventricle) + labels.count(Label::aorta) +
                    labels.count(Label::left_atrium) + labels.count(Label::lung) ==
                0);
  }
  EXPECT_EQ(met[0].count(Label::right_ventricle), 1u);
  EXPECT_EQ(met[1].count(Label::right_ventricle), 0u);
  const Label tip = patient().body.at(leads[1].pieces.back().to).label;
  EXPECT_TRUE(tip == Label::right_atrium || tip == Label::myocardium) << static_cast<int>(tip);
}

TEST(Carried, TheSceneHasMetalWhereThingsLieAndElseTheSame) {
  const Patient grafted(1, Anatomy::bypass);
  const auto things = grafted.carries(with(3, 6, 2, 1));
  const CarriedScene scene(grafted.body, things);
  ScanOptions options;
  options.grid.size = {64, 64, 40};
  options.grid.spacing = {0.7, 0.7, 0.9};
  const Vec3 middle = things[3].pieces[0].from;  // a clip
  options.grid.origin = middle - Vec3(22, 22, 18);
  options.noise_hu = 0.0;
  const Scan plain = acquire(grafted.body, options), carried = acquire(scene, options);
  std::size_t metal = 0, other = 0, lumen = 0;
  for (std::size_t v = 0; v < plain.labels.voxels.size(); ++v) {
    if (plain.labels.voxels[v] == carried.labels.voxels[v]) {
      lumen += plain.labels.voxels[v] == static_cast<std::uint8_t>(Label::coronary_lumen);
      continue;
    }
    (carried.labels.voxels[v] == static_cast<std::uint8_t>(Label::metal) ? metal : other) += 1;
    EXPECT_NE(plain.labels.voxels[v], static_cast<std::uint8_t>(Label::coronary_lumen));
  }
  EXPECT_GT(metal, 3u);
  EXPECT_EQ(other, 0u);
  EXPECT_GT(lumen, 100u);
  EXPECT_GT(*std::max_element(carried.image.voxels.begin(), carried.image.voxels.end()), 1200);
}

TEST(Carried, StrutsCoverAShareOfTheStentAndLeaveTheLumenBetweenThem) {
  CoronaryTree tree = patient().tree;
  CoronaryVessel& lad = *std::find_if(tree.vessels.begin(), tree.vessels.end(),
                                      [](const CoronaryVessel& v) { return v.name == "LAD"; });
  add_stent(lad, 25.0, 18.0, true);
  const VesselField field(tree);
  std::size_t metal = 0, lumen = 0, deeper = 0;
  for (double s = 25.5; s < 42.5; s += 0.02) {
    const auto i = static_cast<std::size_t>(s / 0.1);
    const geometry::Frame& f = lad.axis.frames[i];
    const double along = s - 0.1 * static_cast<double>(i);
    for (int a = 0; a < 240; ++a) {
      const double theta = 2.0 * std::numbers::pi * a / 240;
      const Vec3 out = std::cos(theta) * f.normal + std::sin(theta) * f.binormal;
      const Vec3 axis = lad.axis.points[i] + along * f.tangent;
      const double radius = lad.lumen.at(s, theta);
      const auto at = field.material(axis + (radius - 0.05) * out);
      if (!at) continue;
      metal += at->label == Label::metal;
      lumen += at->label == Label::coronary_lumen;
      const auto within = field.material(axis + (radius - 0.3) * out);
      deeper += within && within->label == Label::metal;
    }
  }
  const double share = static_cast<double>(metal) / static_cast<double>(metal + lumen);
  EXPECT_GT(share, 0.10);
  EXPECT_LT(share, 0.30);
  EXPECT_LT(static_cast<double>(deeper), 0.005 * static_cast<double>(metal + lumen));
}

TEST(Carried, BadlyMixedContrastLiesBetweenBloodAndTheBrightest) {
  BodyOptions options = draw_body(1);
  options.hu.superior_vena_cava = 1200.0f;
  options.texture = 0.0;
  const auto cava = [&](double mixing) {
    options.mixing = mixing;
    const Body body(patient().heart, patient().tree, options);
    double sum = 0.0, square = 0.0, n = 0.0, most = 0.0;
    for (double z = 40.0; z < 80.0; z += 1.0) {
      for (double x = -6.0; x <= 6.0; x += 1.0) {
        for (double y = -6.0; y <= 6.0; y += 1.0) {
          const Material m = body.at({-35 + x, -1 + y, z});
          if (m.label != Label::vein) continue;
          sum += m.hu;
          square += m.hu * m.hu;
          most = std::max(most, static_cast<double>(m.hu));
          n += 1.0;
        }
      }
    }
    return std::array<double, 3>{sum / n, std::sqrt(square / n - sum / n * sum / n), most};
  };
  const auto even = cava(0.0), half = cava(0.5), full = cava(1.0);
  EXPECT_NEAR(even[0], 1200.0, 1e-3);
  EXPECT_NEAR(even[1], 0.0, 0.5);
  EXPECT_NEAR(half[1], 0.5 * full[1], 0.02 * full[1]);
  EXPECT_GT(full[1], 200.0);
  EXPECT_LE(full[2], 1200.01);
  EXPECT_LT(full[0], 900.0);
  options.mixing = 1.5;
  EXPECT_THROW(Body(patient().heart, patient().tree, options), InvalidInput);
}

}  // namespace
}  // namespace ostia::phantom
