#include "patient_of_phantom.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"
#include "ostia/phantom/patient_heart.h"
#include "ostia/phantom/vessel_field.h"
#include "ostia/session/patient_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::phantom {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

CoronaryOptions mask_options() {
  CoronaryOptions options;
  options.seed = 3;
  options.disease = 0.0;
  return options;
}

const CoronaryTree& own_tree() {
  static const CoronaryTree tree = draw_coronaries(draw_heart(3), mask_options());
  return tree;
}

/// Voxels whose centres lie in the lumen, or no more than `rim_mm` outside it.
imaging::MaskVolume mask_with(double rim_mm, double spacing_mm = 0.6) {
  const VesselField field(own_tree());
  const geometry::Box3 box = field.box();
  imaging::MaskVolume mask;
  mask.geometry.spacing = Vec3::Constant(spacing_mm);
  mask.geometry.origin = box.min() - Vec3::Constant(3.0);
  for (int a = 0; a < 3; ++a)
    mask.geometry.size[static_cast<std::size_t>(a)] =
        static_cast<std::int64_t>((box.sizes()[a] + 6.0) / spacing_mm);
  mask.voxels.assign(static_cast<std::size_t>(mask.geometry.voxels()), 0);
  for (std::int64_t k = 0; k < mask.geometry.size[2]; ++k)
    for (std::int64_t j = 0; j < mask.geometry.size[1]; ++j)
      for (std::int64_t i = 0; i < mask.geometry.size[0]; ++i) {
        const Vec3 p =
            mask.geometry.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        if (field.value(Boundary::lumen, p, rim_mm + 0.1) < rim_mm) mask(i, j, k) = 1;
      }
  return mask;
}
const imaging::MaskVolume& exact_mask() {
  static const imaging::MaskVolume mask = mask_with(0.0);
  return mask;
}

const PatientVessel* patient_named(const PatientTree& tree, const std::string& name) {
  const auto at = std::ranges::find(tree.vessels, name, &PatientVessel::name);
  return at == tree.vessels.end() ? nullptr : &*at;
}

/// The mask in a mirror, along some of its axes.
imaging::MaskVolume flipped(const imaging::MaskVolume& mask, bool x, bool y, bool z) {
  imaging::MaskVolume out = mask;
  const auto& n = mask.geometry.size;
  for (std::int64_t k = 0; k < n[2]; ++k)
    for (std::int64_t j = 0; j < n[1]; ++j)
      for (std::int64_t i = 0; i < n[0]; ++i)
        out(i, j, k) = mask(x ? n[0] - 1 - i : i, y ? n[1] - 1 - j : j, z ? n[2] - 1 - k : k);
  return out;
}

struct Deviation {
  double axis_mm = 0.0, radius_mm = 0.0;
};
/// Of the three main vessels, away from their ends: of the patient's axis from the true one, of its calibre.
Deviation deviation(const PatientHeart& built) {
  Deviation sum;
  double n = 0.0;
  for (const char* name : {"LAD", "LCX", "RCA"}) {
    const auto is = [&](const CoronaryVessel& vessel) { return vessel.name == name; };
    const CoronaryVessel& back = *std::ranges::find_if(built.tree.vessels, is);
    const CoronaryVessel& own = *std::ranges::find_if(own_tree().vessels, is);
    for (double s = own.s_free_mm + 4.0; s < 0.8 * own.axis.abscissa.back(); s += 1.0) {
      const auto i = static_cast<std::size_t>(s / 0.1);
      const Vec3 placed = built.record.rotation * own.axis.points[i] + built.record.shift_mm;
      const auto foot = geometry::closest(back.axis.points, placed);
      sum.axis_mm += (foot.point - placed).norm();
      sum.radius_mm += std::abs(back.axis.radius[foot.segment] - own.healthy_radius_mm[i]);
      n += 1.0;
    }
  }
  return {sum.axis_mm / n, sum.radius_mm / n};
}

TEST(PatientMask, ATreeOfVoxelsComesBack) {
  const PatientTree tree = session::patient_of_mask(exact_mask(), 3);
  for (const char* name : {"LAD", "LCX", "RCA", "PDA"}) EXPECT_NE(patient_named(tree, name), nullptr) << name;
  EXPECT_EQ(tree.dominance, own_tree().dominance);
  const Deviation off = deviation(patient_heart(tree, draw_heart(3), mask_options()));
  EXPECT_LT(off.axis_mm, 0.3);
  EXPECT_LT(off.radius_mm, 0.12);
}

TEST(PatientMask, TheRimOfALabelThatIsTooThickIsTakenOff) {
  PatientTree tree = session::patient_of_mask(mask_with(0.35), 3);
  tree.rim_mm = 0.35;
  const Deviation off = deviation(patient_heart(tree, draw_heart(3), mask_options()));
  EXPECT_LT(off.axis_mm, 0.35);
  EXPECT_LT(off.radius_mm, 0.14);
}

TEST(PatientMask, OneThatIsMirroredOrOnItsHeadIsTurnedAndThatIsTold) {
  struct Flip {
    bool x, y, z;
    const char* told;
  };
  const imaging::MaskVolume coarse = mask_with(0.0, 1.1);  // eight ways are tried
  for (const Flip& flip : {Flip{true, false, false, "mirrored"}, Flip{false, true, true, "turned"}}) {
    const PatientTree tree = session::patient_of_mask(flipped(coarse, flip.x, flip.y, flip.z), 3);
    EXPECT_THAT(tree.remarks, Contains(HasSubstr(flip.told)));
    EXPECT_THAT(tree.remarks, Contains(HasSubstr("probability")));
    EXPECT_NE(patient_named(tree, "LAD"), nullptr);
    EXPECT_LT(patient_heart(tree, draw_heart(3), mask_options()).record.height_left_mm, 1.5);
  }
}

TEST(PatientMask, AGapIsJoinedAndAnEmptyOneRefused) {
  imaging::MaskVolume cut = exact_mask();
  const auto is_lad = [](const CoronaryVessel& vessel) { return vessel.name == "LAD"; };
  const geometry::Centerline& lad = std::ranges::find_if(own_tree().vessels, is_lad)->axis;
  const Vec3 gap = lad.points[700];
  for (std::size_t n = 0; n < cut.voxels.size(); ++n) {
    const auto v = static_cast<std::int64_t>(n);
    const Vec3 p =
        cut.geometry.world(Vec3(static_cast<double>(v % cut.geometry.size[0]),
                                static_cast<double>(v / cut.geometry.size[0] % cut.geometry.size[1]),
                                static_cast<double>(v / (cut.geometry.size[0] * cut.geometry.size[1]))));
    if ((p - gap).norm() < 3.0) cut.voxels[n] = 0;
  }
  const PatientTree joined = session::patient_of_mask(cut, 3);
  EXPECT_THAT(joined.remarks, Contains(HasSubstr("bridged")));
  EXPECT_GT(geometry::length(patient_named(joined, "LAD")->points), 90.0);

  imaging::MaskVolume empty = exact_mask();
  std::ranges::fill(empty.voxels, std::uint8_t{0});
  EXPECT_THAT([&] { session::patient_of_mask(empty); }, ThrowsMessage<InvalidInput>(HasSubstr("mpty")));
}

}  // namespace
}  // namespace ostia::phantom
