// How near the outer wall and the plaque within it come to the truth, on phantom cases: rays about the true
// axis of every annotated section, lumen found in the image or, with --true-lumen, given. Makes each case in
// memory (about 160 MB and 50 s of processor time at the preset `full`) unless a suite with
// the same seeds is given.
//   outer_wall_accuracy [--cases N] [--first SEED] [--preset tiny|small|full] [--suite FOLDER]
//                       [--blur SIGMA] [--wall HU] [--true-lumen] [--no-unmixing]

#include "ostia/analysis/plaque.h"
#include "ostia/core/error.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/imaging/image_file.h"
#include "ostia/imaging/sampling.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/segmentation/outer_wall.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace ostia;

struct Arguments {
  int cases = 1, first = 1;
  phantom::Preset preset = phantom::Preset::full;
  std::filesystem::path suite;
  bool true_lumen = false, unmixing = true;
  segmentation::LumenBoundaryOptions boundary;
  segmentation::OuterWallOptions wall;
};

Arguments parsed(int argc, char** argv) {
  Arguments out;
  for (int n = 1; n < argc; ++n) {
    const std::string_view name = argv[n];
    if (name == "--true-lumen") {
      out.true_lumen = true;
      continue;
    }
    if (name == "--no-unmixing") {
      out.unmixing = false;
      continue;
    }
    if (n + 1 == argc) throw UsageError("outer_wall_accuracy: " + std::string(name) + " needs a value");
    const std::string value = argv[++n];
    if (name == "--cases") {
      out.cases = std::stoi(value);
    } else if (name == "--first") {
      out.first = std::stoi(value);
    } else if (name == "--suite") {
      out.suite = value;
    } else if (name == "--blur") {
      out.boundary.blur_sigma_mm = out.wall.blur_sigma_mm = std::stod(value);
    } else if (name == "--wall") {
      out.boundary.wall_hu = out.wall.wall_hu = std::stod(value);
    } else if (name == "--preset") {
      out.preset = value == "tiny"    ? phantom::Preset::tiny
                   : value == "small" ? phantom::Preset::small
                                      : phantom::Preset::full;
    } else {
      throw UsageError("outer_wall_accuracy: unknown option " + std::string(name));
    }
  }
  return out;
}

/// Differences of the outer radius, found minus true.
struct Differences {
  double sum = 0.0, absolute = 0.0, square = 0.0, largest = 0.0;
  int count = 0;
  void add(double off) {
    ++count;
    sum += off;
    absolute += std::abs(off);
    square += off * off;
    largest = std::max(largest, std::abs(off));
  }
  void add(const Differences& other) {
    count += other.count;
    sum += other.sum;
    absolute += other.absolute;
    square += other.square;
    largest = std::max(largest, other.largest);
  }
  void print(const char* what) const {
    const double n = std::max(1, count);
    std::printf("  %-28s %7d rays: mean %+.3f, mean absolute %.3f, RMS %.3f, largest %.2f mm\n", what, count,
                sum / n, absolute / n, std::sqrt(square / n), largest);
  }
};

struct Score {
  Differences seen, bridged;
  analysis::PlaqueVolumes truth, found;
};

void add(analysis::PlaqueVolumes& sum, const analysis::PlaqueVolumes& one) {
  sum.length_mm += one.length_mm;
  sum.lumen_mm3 += one.lumen_mm3;
  sum.vessel_mm3 += one.vessel_mm3;
  sum.thin_wall_mm3 += one.thin_wall_mm3;
  for (std::size_t n = 0; n < analysis::plaque_classes; ++n) sum.class_mm3[n] += one.class_mm3[n];
}

void print(const char* name, const analysis::PlaqueVolumes& v) {
  std::printf("  %-6s %6.1f mm: lumen %7.1f, vessel %7.1f mm3, wall %4.1f %%; thin wall %6.1f;", name,
              v.length_mm, v.lumen_mm3, v.vessel_mm3, v.wall_percent(), v.thin_wall_mm3);
  for (std::size_t n = 0; n < analysis::plaque_classes; ++n)
    std::printf(" %s %.1f,", to_string(static_cast<analysis::PlaqueClass>(n)).c_str(), v.class_mm3[n]);
  std::printf(" plaque %.1f mm3\n", v.plaque_mm3());
}

void print(const char* health, const Score& score) {
  std::printf("%s\n", health);
  score.seen.print("where fat is seen");
  score.bridged.print("bridged");
  print("truth", score.truth);
  print("found", score.found);
}

segmentation::LumenBoundary true_lumen(const phantom::CoronaryVessel& vessel, double from, double to) {
  segmentation::LumenBoundary out;
  const int rows = 1 + static_cast<int>(std::lround((to - from) / 0.5));
  out.from_mm = from;
  out.step_mm = (to - from) / (rows - 1);
  out.around = 32;
  for (int r = 0; r < rows; ++r)
    for (int a = 0; a < out.around; ++a)
      out.radius_mm.push_back(
          vessel.lumen.at(from + r * out.step_mm, 2.0 * std::numbers::pi * a / out.around));
  out.confidence.assign(out.radius_mm.size(), 1.0F);
  return out;
}

/// A value a row, between rows linear.
std::function<double(double)> along(const segmentation::LumenBoundary& rows, const std::vector<double>& hu) {
  return [&rows, &hu](double s_mm) {
    const double last = static_cast<double>(hu.size() - 1);
    const double x = std::clamp((s_mm - rows.from_mm) / rows.step_mm, 0.0, last);
    const auto i = static_cast<std::size_t>(x);
    const std::size_t j = std::min(i + 1, hu.size() - 1);
    return hu[i] + (x - static_cast<double>(i)) * (hu[j] - hu[i]);
  };
}

void score_section(const Arguments& arguments, const imaging::ImageVolume& image,
                   const phantom::CasePlan& plan, const phantom::AnnotatedSection& section, Score& score) {
  const phantom::CoronaryVessel& vessel = phantom::vessel_of(plan.tree, section.vessel);
  const geometry::AxisCurve axis(vessel.axis);
  const auto inside = [&](double s) { return image.geometry.contains(axis.point(s)); };
  double from = std::max(0.0, section.s_from_mm - 15.0);
  double to = std::min(axis.length(), section.s_to_mm + 15.0);
  while (from < section.s_from_mm && !inside(from)) from += 0.5;
  while (to > section.s_to_mm && !inside(to)) to -= 0.5;
  const segmentation::LumenBoundary lumen =
      arguments.true_lumen ? true_lumen(vessel, from, to)
                           : segmentation::lumen_boundary(image, axis, from, to, arguments.boundary);
  const segmentation::OuterWall found = segmentation::outer_wall(image, axis, lumen, arguments.wall);
  for (int r = 0; r < lumen.rows(); ++r) {
    const double s = lumen.from_mm + r * lumen.step_mm;
    if (s < section.s_from_mm || s > section.s_to_mm) continue;
    for (int a = 0; a < lumen.around; ++a) {
      const auto n = static_cast<std::size_t>(r) * lumen.around + a;
      const double off =
          found.surface.radius_mm[n] - vessel.wall.at(s, 2.0 * std::numbers::pi * a / lumen.around);
      (found.surface.confidence[n] > 0.0F ? score.seen : score.bridged).add(off);
    }
  }
  const phantom::VesselField field(plan.tree);
  analysis::PlaqueOptions exact;
  exact.blur_sigma_mm = 0.0;
  analysis::WallRadii walls{section.s_from_mm,
                            section.s_to_mm,
                            [&](double s, double theta) { return vessel.lumen.at(s, theta); },
                            [&](double s, double theta) { return vessel.wall.at(s, theta); },
                            {},
                            {}};
  const auto material = [&](const geometry::Vec3& place) {
    const auto there = field.material(place);
    return there ? static_cast<double>(there->hu) : 45.0;
  };
  const auto all = [&](const analysis::PlaqueProfile& profile) {
    return analysis::plaque_between(profile, section.s_from_mm, section.s_to_mm);
  };
  add(score.truth, all(analysis::plaque_profile(axis, walls, material, exact)));
  analysis::PlaqueOptions scanned;
  scanned.blur_sigma_mm = arguments.unmixing ? arguments.wall.blur_sigma_mm : 0.0;
  walls.lumen_mm = [&](double s, double theta) { return lumen.at(s, theta); };
  walls.outer_mm = [&](double s, double theta) { return found.surface.at(s, theta); };
  walls.lumen_hu = along(found.surface, found.lumen_hu);
  walls.fat_hu = along(found.surface, found.fat_hu);
  add(score.found,
      all(analysis::plaque_profile(
          axis, walls, [&](const geometry::Vec3& place) { return imaging::sample(image, place); }, scanned)));
}

/// Of the case, made anew or read: datasetNN/imageNN.nrrd, NN one less than the seed.
imaging::ImageVolume image_of(const Arguments& arguments, const phantom::CasePlan& plan, int seed) {
  if (arguments.suite.empty()) return phantom::scan_case(plan).image;
  char number[16];
  std::snprintf(number, sizeof number, "%02d", seed - 1);
  return imaging::read_image(arguments.suite / (std::string("dataset") + number) /
                             (std::string("image") + number + ".nrrd"))
      .volume;
}

void run(const Arguments& arguments) {
  Score healthy, diseased;
  const std::clock_t start = std::clock();
  for (int seed = arguments.first; seed < arguments.first + arguments.cases; ++seed) {
    phantom::CaseOptions options;
    options.seed = static_cast<std::uint64_t>(seed);
    options.preset = arguments.preset;
    const phantom::CasePlan plan = phantom::plan_case(options);
    const imaging::ImageVolume image = image_of(arguments, plan, seed);
    for (const phantom::AnnotatedSection& section : plan.sections.sections)
      score_section(arguments, image, plan, section,
                    section.health == geometry::Health::healthy ? healthy : diseased);
  }
  print("healthy", healthy);
  print("diseased", diseased);
  std::printf("processor time, with making the cases: %.1f s\n",
              static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parsed(argc, argv));
    return 0;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.exit_code());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "outer_wall_accuracy: %s\n", error.what());
    return 2;
  }
}
