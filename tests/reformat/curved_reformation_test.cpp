#include "curved_axes.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::reformat {
namespace {

using namespace testing;

TEST(CurvedReformation, RowsAreAbscissasAndColumnsDistancesAtAnAngle) {
  const Axis axis = helix();
  const CurvedReformation view(axis, options(CurvedMode::straightened, 35.0));
  for (double s : {0.0, 2.125, 40.0, 71.3}) {
    for (double rho : {-4.0, -0.5, 0.0, 3.3}) {
      const Vec2 px(50.5 + rho / 0.25, (s + 3.0) / 0.25);
      EXPECT_LT((view.world(px) - axis->place(s, 35.0 * pi / 180.0, rho)).norm(), 1e-12);
      EXPECT_NEAR(view.abscissa_at_row(px.y()), s, 1e-12);
      EXPECT_NEAR(view.row_at_abscissa(s), px.y(), 1e-12);
    }
  }
}

TEST(CurvedReformation, TheWorldOfAPictureProjectsBackToIt) {
  for (const Axis& axis : {helix(), coronary(), straight(), hairpin(6.0)}) {
    for (const CurvedMode mode : both) {
      for (const double theta : {0.0, 35.0, 90.0, -120.0}) {
        const CurvedReformation view(axis, options(mode, theta));
        for (double y = 0.3; y < 240.0; y += 7.9) {
          for (double x = 30.5; x <= 70.5; x += 4.7) {  // within 5 mm of the middle
            const Vec2 px(x, y);
            const Vec3 place = view.world(px);
            const auto seen = view.project(place, view.abscissa_at_row(y));
            ASSERT_TRUE(seen);
            EXPECT_LT((seen->picture_px - px).norm() * 0.25, 1e-6) << "theta " << theta << " at " << px;
            EXPECT_LT(std::abs(seen->out_mm), 1e-8);
            // Without a word of the row it may be another one, but the place is the same.
            const auto any = view.project(place);
            ASSERT_TRUE(any);
            EXPECT_LT((view.world(any->picture_px) - place).norm(), 1e-6);
          }
        }
      }
    }
  }
}

TEST(CurvedReformation, HoldsInABendTighterThanTheDistance) {
  // Radius of curvature 2 mm; pictures 5 mm to either side fold over on its inside.
  const Axis axis = hairpin(2.0);
  for (const double theta : {0.0, 90.0, 180.0, 270.0, 45.0}) {
    const CurvedReformation view(axis, options(CurvedMode::straightened, theta));
    for (double s = 9.0; s < 21.0; s += 0.37) {
      for (double rho = -5.0; rho <= 5.0; rho += 0.45) {
        const Vec2 px(50.5 + rho / 0.25, view.row_at_abscissa(s));
        const Vec3 place = view.world(px);
        const auto seen = view.project(place, s);
        ASSERT_TRUE(seen);
        EXPECT_LT((seen->picture_px - px).norm() * 0.25, 1e-5) << theta << " " << s << " " << rho;
        EXPECT_LT((view.world(view.project(place)->picture_px) - place).norm(), 1e-6);
      }
    }
  }
}

TEST(CurvedReformation, ChoosesTheFootThatIsAskedFor) {
  const Axis axis = hairpin(3.0);  // legs 6 mm apart in the view's plane
  CurvedReformation view(axis, options(CurvedMode::straightened, 0.0));
  const Vec3 between(1.0, -8.0, 0.0);  // 2 mm from the first leg, 4 mm from the second
  if (std::abs(view.project(between, 4.0)->out_mm) > 1.0) view = view.twin();
  const double far = axis->length() - 4.0;
  EXPECT_NEAR(view.project(between, 4.0)->s_mm, 4.0, 1e-4);
  EXPECT_NEAR(view.project(between, far)->s_mm, far, 1e-4);
  EXPECT_NEAR(std::abs(view.project(between, far)->picture_px.x() - 50.5) * 0.25, 4.0, 1e-4);
  EXPECT_NEAR(view.project(between)->s_mm, 4.0, 1e-4);  // on the view at both: the nearer
}

TEST(CurvedReformation, TellsHowFarOutOfTheViewAPlaceLies) {
  const Axis axis = coronary();
  const CurvedReformation view(axis, options(CurvedMode::straightened, 20.0));
  const Vec3 place = axis->place(15.0, 110.0 * pi / 180.0, 1.5);
  const auto seen = view.project(place, 15.0);
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->s_mm, 15.0, 1e-7);
  EXPECT_NEAR(seen->out_mm, 1.5, 1e-7);
  EXPECT_NEAR(seen->picture_px.x(), 50.5, 1e-6);
  const CurvedReformation stretched(axis, options(CurvedMode::stretched, 20.0));
  const CurvedReformation::Row row = stretched.row(90.0);
  const Vec3 off = stretched.world({44.0, 90.0}) + 0.8 * row.across;
  const auto back = stretched.project(off, stretched.abscissa_at_row(90.0));
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->out_mm, 0.8, 1e-6);
  EXPECT_LT((back->picture_px - Vec2(44.0, 90.0)).norm(), 1e-5);
}

TEST(CurvedReformation, RunsOnStraightBeyondTheEnds) {
  const Axis axis = coronary();
  const CurvedReformation view(axis, options(CurvedMode::straightened, 20.0));
  const geometry::Frame start = axis->frame(0.0), end = axis->frame(axis->length());
  EXPECT_LT((view.world({50.5, 0.0}) - (axis->point(0.0) - 3.0 * start.tangent)).norm(), 1e-12);
  const double row = view.row_at_abscissa(axis->length() + 2.0);
  EXPECT_LT((view.world({50.5, row}) - (axis->point(axis->length()) + 2.0 * end.tangent)).norm(), 1e-10);
  EXPECT_NEAR(view.project(view.world({42.0, row}))->s_mm, axis->length() + 2.0, 1e-9);
  EXPECT_NEAR(view.project(view.world({42.0, 1.0}))->s_mm, -2.75, 1e-9);
  for (const Vec2& px : view.axis_px()) {
    EXPECT_GE(px.y(), 12.0);
    EXPECT_LE(px.y(), view.row_at_abscissa(axis->length()));
  }
}

TEST(CurvedReformation, TheTwinLooksFromTheSideAndHalfATurnMirrors) {
  for (const CurvedMode mode : both) {
    const CurvedReformation view(coronary(), options(mode, 15.0));
    EXPECT_DOUBLE_EQ(view.twin().options().theta_deg, 105.0);
    const CurvedReformation other = view.rotated(195.0);
    for (double y = 1.0; y < 240.0; y += 13.0) {
      if (mode == CurvedMode::straightened) {
        EXPECT_NEAR((view.row(y).across - view.twin().row(y).along).norm(), 0.0, 1e-12);
      }
      EXPECT_LT((view.world({20.0, y}) - other.world({81.0, y})).norm(), 1e-9);
    }
  }
}

TEST(StretchedReformation, IsIsometric) {
  for (const Axis& axis : {coronary(), helix(), hairpin(6.0)}) {
    const CurvedReformation view(axis, options(CurvedMode::stretched, 25.0));
    const double h = 0.002;  // mm
    for (double y = 0.0; y < 240.0; y += 5.3) {
      for (const double angle : {0.0, 0.8, 1.5707963, 2.5}) {
        const Vec2 at(33.0, y), step(std::cos(angle) * h / 0.25, std::sin(angle) * h / 0.25);
        EXPECT_NEAR((view.world(at + step) - view.world(at - step)).norm(), 2.0 * h, 2e-4 * h);
      }
    }
  }
}

TEST(StretchedReformation, HoldsTheAxis) {
  const Axis axis = coronary();
  for (const double theta : {0.0, 60.0, 90.0}) {
    const CurvedReformation view(axis, options(CurvedMode::stretched, theta));
    const std::vector<Vec2> line = view.axis_px();
    EXPECT_GT(line.size(), 180U);
    double left = 1e9, right = -1e9;
    for (const Vec2& px : line) {
      EXPECT_LT((view.world(px) - axis->point(view.abscissa_at_row(px.y()))).norm(), 1e-3);
      left = std::min(left, px.x());
      right = std::max(right, px.x());
    }
    EXPECT_GT(left, 0.0);
    EXPECT_LT(right, 101.0);
    EXPECT_GT(right - left, 10.0);  // its bends are seen
  }
}

/// Along x, up along y by 6 mm, on along x, and down again: seen along y both steps are single rows.
Axis bridge() {
  geometry::Centerline line;
  const auto corner = [&](const Vec3& centre, double from, double to) {
    for (int i = 1; i <= 20; ++i) {
      const double a = from + (to - from) * i / 20.0;
      line.points.emplace_back(centre + 1.5 * Vec3(std::cos(a), std::sin(a), 0.0));
    }
  };
  const auto leg = [&](const Vec3& from, const Vec3& to) {
    for (int i = 1; i <= 50; ++i) line.points.emplace_back(from + (to - from) * i / 50.0);
  };
  line.points.emplace_back(-12.0, 0.0, 0.0);
  leg({-12.0, 0.0, 0.0}, {-6.5, 0.0, 0.0});
  corner({-6.5, 1.5, 0.0}, -0.5 * pi, 0.0);
  leg({-5.0, 1.5, 0.0}, {-5.0, 6.0, 0.0});
  corner({-3.5, 6.0, 0.0}, pi, 0.5 * pi);
  leg({-3.5, 7.5, 0.0}, {3.5, 7.5, 0.0});
  corner({3.5, 6.0, 0.0}, 0.5 * pi, 0.0);
  leg({5.0, 6.0, 0.0}, {5.0, 1.5, 0.0});
  corner({6.5, 1.5, 0.0}, pi, 1.5 * pi);
  leg({6.5, 0.0, 0.0}, {12.0, 0.0, 0.0});
  return curve(line);
}

/// Rows never go back, all is finite, the map has its inverse, and all of the axis is shown.
void expect_sound(const CurvedReformation& view) {
  double before = -1e9;
  for (double y = 0.0; y < view.options().height; y += 0.5) {
    const double s = view.abscissa_at_row(y);
    EXPECT_GE(s, before);
    before = s;
    const Vec3 place = view.world({40.0, y});
    ASSERT_TRUE(place.allFinite());
    EXPECT_LT((view.world(view.project(place)->picture_px) - place).norm(), 1e-6);
  }
  for (double s = 0.0; s <= view.axis().length(); s += 0.37) {
    const auto seen = view.project(view.axis().point(s), s);
    ASSERT_TRUE(seen);
    EXPECT_LT(std::abs(seen->out_mm), 2e-3) << s;
  }
}

TEST(StretchedReformation, StallsWhereTheAxisRunsAlongTheDirection) {
  const Axis axis = bridge();
  int stalls = 0;
  for (const double theta : {0.0, 90.0}) {
    CurvedOptions o = options(CurvedMode::stretched, theta, 0.1);
    o.height = 500;
    const CurvedReformation view(axis, o);
    expect_sound(view);
    for (int y = 0; y < o.height; ++y)
      stalls += view.abscissa_at_row(y + 1.0) - view.abscissa_at_row(y) > 4.0 ? 1 : 0;
  }
  EXPECT_EQ(stalls, 2);  // both steps, in the view along y alone
}

TEST(StretchedReformation, TurnsBackWithTheAxis) {
  // Five quarters of a half circle: the projection comes to rest where the tangent is the direction.
  geometry::Centerline line;
  for (int i = 0; i <= 300; ++i) {
    const double a = 1.25 * pi * i / 300.0 - 0.125 * pi;
    line.points.emplace_back(10.0 * std::cos(a), 10.0 * std::sin(a), 0.0);
  }
  const Axis axis = curve(line);
  for (const double theta : {0.0, 90.0, 40.0}) {
    CurvedOptions o = options(CurvedMode::stretched, theta, 0.1);
    o.height = 500;
    expect_sound(CurvedReformation(axis, o));
  }
}

TEST(CurvedReformation, RefusesWhatCannotBePictured) {
  const Axis axis = straight();
  const auto with = [&](auto change) {
    CurvedOptions o;
    change(o);
    return CurvedReformation(axis, o);
  };
  EXPECT_THROW(with([](CurvedOptions& o) { o.pixel_mm = 0.0; }), InvalidInput);
  EXPECT_THROW(with([](CurvedOptions& o) { o.pixel_mm = NAN; }), InvalidInput);
  EXPECT_THROW(with([](CurvedOptions& o) { o.theta_deg = INFINITY; }), InvalidInput);
  EXPECT_THROW(with([](CurvedOptions& o) { o.s_start_mm = NAN; }), InvalidInput);
  EXPECT_THROW(with([](CurvedOptions& o) { o.width = 0; }), InvalidInput);
  EXPECT_THROW(with([](CurvedOptions& o) { o.height = 40000; }), InvalidInput);
  EXPECT_THROW(with([](CurvedOptions& o) { o.slab = Slab::mean; }), InvalidInput);
  EXPECT_THROW(CurvedReformation(nullptr, CurvedOptions{}), InvalidInput);
  EXPECT_FALSE(CurvedReformation(axis, CurvedOptions{}).project(Vec3(NAN, 0, 0)));
  EXPECT_THROW(reformatted(imaging::ImageVolume{}, CurvedReformation(axis, CurvedOptions{})), InvalidInput);
}

TEST(CrossSection, HasThetaZeroToTheRightAndNinetyUp) {
  const Axis axis = coronary();
  const Plane plane = cross_section_plane(*axis, 17.3, 20.0, 0.1);
  const auto at = [&](double theta) { return project(plane, axis->place(17.3, theta, 3.0)); };
  EXPECT_LT((at(0.0).picture_px - Vec2(130.0, 100.0)).norm(), 1e-9);
  EXPECT_LT((at(0.5 * pi).picture_px - Vec2(100.0, 70.0)).norm(), 1e-9);
  EXPECT_NEAR(at(1.0).distance_mm, 0.0, 1e-12);
  EXPECT_GT(plane.normal().dot(axis->frame(17.3).tangent), 1.0 - 1e-12);  // seen looking distally
  EXPECT_THROW(cross_section_plane(*axis, NAN, 20.0, 0.1), InvalidInput);
  EXPECT_THROW(cross_section_plane(*axis, 3.0, 0.0, 0.1), InvalidInput);
}

}  // namespace
}  // namespace ostia::reformat
