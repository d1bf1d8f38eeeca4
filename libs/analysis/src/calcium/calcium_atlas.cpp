// Usual courses about the heart's bulk, in its radii from its centre (left, back, up), read off a synthetic
// heart (docs/methods/calcium-score.md).

#include "calcium/calcium_heart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace ostia::analysis {
namespace {

struct UsualCourse {
  CalciumPlace place;
  double thick;  // what is nearer lies in it
  std::vector<Vec3> points;
};

const std::vector<UsualCourse>& usual_courses() {
  static const std::vector<UsualCourse> courses{
      {CalciumPlace::left_main, 0.0, {{-0.33, 0.35, 0.86}, {-0.03, 0.32, 1.05}}},
      {CalciumPlace::lad,
       0.0,
       {{-0.03, 0.30, 1.05},
        {0.24, 0.12, 1.17},
        {0.49, -0.05, 0.96},
        {0.65, -0.26, 0.72},
        {0.80, -0.47, 0.46},
        {0.97, -0.62, 0.18},
        {1.06, -0.74, -0.15}}},
      {CalciumPlace::lad,
       0.0,
       {{0.24, 0.12, 1.17}, {0.51, 0.08, 0.95}, {0.73, -0.04, 0.69}, {0.96, -0.12, 0.41}}},
      {CalciumPlace::lcx,
       0.0,
       {{-0.03, 0.35, 1.05}, {0.20, 0.60, 1.20}, {0.26, 0.93, 1.11}, {0.29, 1.19, 0.87}, {0.28, 1.34, 0.53}}},
      {CalciumPlace::lcx,
       0.0,
       {{0.20, 0.60, 1.19}, {0.43, 0.72, 0.94}, {0.65, 0.71, 0.66}, {0.85, 0.57, 0.39}}},
      {CalciumPlace::rca,
       0.0,
       {{-0.72, -0.11, 0.65},
        {-0.94, -0.39, 0.70},
        {-1.21, -0.52, 0.60},
        {-1.31, -0.47, 0.26},
        {-1.39, -0.32, -0.06},
        {-1.40, -0.06, -0.31},
        {-1.30, 0.24, -0.50},
        {-1.06, 0.46, -0.66},
        {-0.87, 0.76, -0.66},
        {-0.67, 1.05, -0.56},
        {-0.39, 1.22, -0.42}}},
      {CalciumPlace::rca,
       0.0,
       {{-0.67, 1.05, -0.56}, {-0.41, 0.88, -0.67}, {-0.14, 0.67, -0.79}, {0.37, 0.17, -0.94}}},
      {CalciumPlace::aorta,
       0.30,
       {{-0.66, 0.23, 0.80}, {-0.79, 0.14, 1.22}, {-0.87, 0.11, 1.75}, {-0.87, 0.11, 2.50}}},
      {CalciumPlace::aorta, 0.30, {{-0.17, 2.18, -1.4}, {-0.06, 2.18, 0.7}, {0.0, 2.23, 2.5}}},
      {CalciumPlace::valve, 0.25, {{-0.57, 0.29, 0.43}, {-0.62, 0.26, 0.58}}},  // the aortic one
      {CalciumPlace::valve, 0.30, {{0.0, 0.75, 0.55}}}};                        // the mitral one
  return courses;
}

constexpr double spread = 0.2;        // hearts differ, in radii
constexpr double off_course = 0.5;    // farther from all courses lies something else
constexpr double chest_wall = -0.95;  // in front of that, where no course is near

double segment_distance(const Vec3& at, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((at - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (at - a - t * along).norm();
}

double course_distance(const Vec3& at, const UsualCourse& course) {
  double nearest = (at - course.points.front()).norm();
  for (std::size_t i = 1; i < course.points.size(); ++i)
    nearest = std::min(nearest, segment_distance(at, course.points[i - 1], course.points[i]));
  return std::max(0.0, nearest - course.thick);
}

double likelihood(double distance) {
  return std::exp(-0.5 * distance * distance / (spread * spread));
}

}  // namespace

PlaceGuess guess_place(const Vec3& at) {
  std::array<double, calcium_places> distance{};
  distance.fill(1e9);
  for (const UsualCourse& course : usual_courses()) {
    double& d = distance[static_cast<std::size_t>(course.place)];
    d = std::min(d, course_distance(at, course));
  }
  std::array<double, calcium_places> weight{};
  double sum = 0.0;
  for (std::size_t n = 0; n < calcium_places; ++n) {
    const bool elsewhere = static_cast<CalciumPlace>(n) == CalciumPlace::other;
    weight[n] = likelihood(elsewhere ? off_course : distance[n]);
    sum += weight[n];
  }
  PlaceGuess guess;
  const auto best = std::max_element(weight.begin(), weight.end());
  guess.place = static_cast<CalciumPlace>(best - weight.begin());
  guess.confidence = *best / sum;
  if (guess.place == CalciumPlace::other && at.y() < chest_wall) guess.place = CalciumPlace::bone;
  return guess;
}

}  // namespace ostia::analysis
