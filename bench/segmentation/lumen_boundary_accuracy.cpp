// How near the automatic lumen boundary comes to the truth, on phantom cases: rays about the true axis of
// every annotated section, mean surface distance by case. Makes each case in memory (about 160 MB and 50 s of
// processor time at the preset `full`), and keeps none.
//   lumen_boundary_accuracy [--cases N] [--first SEED] [--preset tiny|small|full] [--axis-error MM]
//                           [--blur SIGMA] [--wall HU] [--noise HU] [--sections]

#include "ostia/core/error.h"
#include "ostia/evaluation/contour_surface.h"
#include "ostia/evaluation/lumen_scores.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/segmentation/lumen_boundary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace ostia;

struct Arguments {
  int cases = 18, first = 1;
  phantom::Preset preset = phantom::Preset::full;
  double axis_error_mm = 0.0, noise_hu = 25.0;
  bool sections = false;
  segmentation::LumenBoundaryOptions boundary;
};

Arguments parsed(int argc, char** argv) {
  Arguments out;
  for (int n = 1; n < argc; ++n) {
    const std::string_view name = argv[n];
    if (name == "--sections") {
      out.sections = true;
      continue;
    }
    if (n + 1 == argc) throw UsageError("lumen_boundary_accuracy: " + std::string(name) + " needs a value");
    const std::string value = argv[++n];
    if (name == "--cases") {
      out.cases = std::stoi(value);
    } else if (name == "--first") {
      out.first = std::stoi(value);
    } else if (name == "--axis-error") {
      out.axis_error_mm = std::stod(value);
    } else if (name == "--blur") {
      out.boundary.blur_sigma_mm = std::stod(value);
    } else if (name == "--wall") {
      out.boundary.wall_hu = std::stod(value);
    } else if (name == "--noise") {
      out.noise_hu = std::stod(value);
    } else if (name == "--preset") {
      out.preset = value == "tiny"    ? phantom::Preset::tiny
                   : value == "small" ? phantom::Preset::small
                                      : phantom::Preset::full;
    } else {
      throw UsageError("lumen_boundary_accuracy: unknown option " + std::string(name));
    }
  }
  return out;
}

/// The true axis, or one that winds about it.
geometry::AxisCurve axis_of(const phantom::CoronaryVessel& vessel, double error_mm) {
  geometry::Centerline line = vessel.axis;
  if (error_mm == 0.0) return geometry::AxisCurve(line);
  for (std::size_t n = 0; n < line.size(); ++n) {
    const double turn = line.abscissa[n] / 5.0;
    line.points[n] +=
        error_mm * (std::cos(turn) * line.frames[n].normal + std::sin(turn) * line.frames[n].binormal);
  }
  geometry::complete(line);
  return geometry::AxisCurve(line);
}

/// Contours of a found boundary over a stretch, drawn out by a millimetre at both ends.
geometry::ContourSection contours(const segmentation::LumenBoundary& found, const geometry::AxisCurve& axis,
                                  double from_mm, double to_mm) {
  geometry::ContourSection out;
  const double first = std::max(found.from_mm, from_mm - 1.0);
  const double last = std::min(found.from_mm + (found.rows() - 1) * found.step_mm, to_mm + 1.0);
  const int count = std::max(2, static_cast<int>(std::ceil((last - first) / 0.5)) + 1);
  for (int i = 0; i < count; ++i) {
    geometry::Contour contour;
    contour.s_mm = first + (last - first) * i / (count - 1);
    for (int n = 0; n < 64; ++n) {
      const double theta = 2.0 * std::numbers::pi * n / 64.0;
      contour.points.push_back(axis.place(contour.s_mm, theta, found.at(contour.s_mm, theta)));
    }
    out.contours.push_back(contour);
  }
  return out;
}

struct Sum {
  double length_mm = 0.0, msd = 0.0, offset = 0.0, dice = 0.0, largest = 0.0;
  int sections = 0;
  void add(const evaluation::SectionScore& score) {
    ++sections;
    length_mm += score.length_mm;
    msd += score.length_mm * score.msd_mm;
    offset += score.length_mm * score.signed_mean_mm;
    dice += score.length_mm * score.dice;
    largest = std::max(largest, score.max_sd_mm);
  }
  void add(const Sum& other) {
    sections += other.sections;
    length_mm += other.length_mm;
    msd += other.msd;
    offset += other.offset;
    dice += other.dice;
    largest = std::max(largest, other.largest);
  }
  void print() const {
    if (sections == 0) {
      std::printf(" |   |     |       |       |       |      ");
      return;
    }
    std::printf(" | %d | %4.0f | %.3f | %+.3f | %.3f | %.2f", sections, length_mm, msd / length_mm,
                offset / length_mm, dice / length_mm, largest);
  }
};

struct CaseScore {
  Sum healthy, diseased;
  double seconds = 0.0, traced_mm = 0.0;
};

CaseScore score_case(const Arguments& arguments, int seed) {
  phantom::CaseOptions options;
  options.seed = static_cast<std::uint64_t>(seed);
  options.preset = arguments.preset;
  options.scan.noise_hu = arguments.noise_hu;
  const phantom::CasePlan plan = phantom::plan_case(options);
  const phantom::Scan scan = phantom::scan_case(plan);
  const geometry::ContourSet truth =
      phantom::annotate(plan.tree, plan.sections.sections, plan.options.contours, plan.options.observers);
  CaseScore out;
  for (const phantom::AnnotatedSection& section : plan.sections.sections) {
    const phantom::CoronaryVessel& vessel = phantom::vessel_of(plan.tree, section.vessel);
    const geometry::AxisCurve axis = axis_of(vessel, arguments.axis_error_mm);
    // More of the vessel than is judged, as a workstation would: its brightness is known from there.
    const auto inside = [&](double s) { return scan.image.geometry.contains(axis.point(s)); };
    double from = std::max(0.0, section.s_from_mm - 15.0);
    double to = std::min(axis.length(), section.s_to_mm + 15.0);
    while (from < section.s_from_mm && !inside(from)) from += 0.5;
    while (to > section.s_to_mm && !inside(to)) to -= 0.5;
    const std::clock_t start = std::clock();
    const segmentation::LumenBoundary found =
        segmentation::lumen_boundary(scan.image, axis, from, to, arguments.boundary);
    out.seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    out.traced_mm += to - from;
    // A winding axis is longer: what is scored lies between the truth's own planes all the same.
    const double more = arguments.axis_error_mm == 0.0 ? 0.0 : 0.03 * section.s_to_mm + 2.0;
    const evaluation::LumenResult surface(
        evaluation::surface_of(contours(found, axis, section.s_from_mm - more, section.s_to_mm + more)));
    for (const geometry::ContourSection& reference : truth.sections) {
      if (reference.section != section.key || reference.observer != "truth" || reference.boundary != "lumen")
        continue;
      const evaluation::SectionScore score = surface.score(reference);
      if (!score.found) throw GeometryError("case " + std::to_string(seed) + ": no result in " + section.key);
      (section.health == geometry::Health::healthy ? out.healthy : out.diseased).add(score);
      if (!arguments.sections) continue;
      std::printf(
          "  %s %-4s %s %5.1f mm: MSD %.3f, largest %.2f, signed %+.3f, Dice %.3f, lumen %.0f HU, "
          "deviation %.1f HU\n",
          section.key.c_str(), vessel.name.c_str(),
          section.health == geometry::Health::healthy ? "healthy " : "diseased", score.length_mm,
          score.msd_mm, score.max_sd_mm, score.signed_mean_mm, score.dice, found.lumen_hu,
          found.lumen_sigma_hu);
    }
  }
  return out;
}

void run(const Arguments& arguments) {
  std::printf(
      "| case | healthy: sections | mm | MSD, mm | signed, mm | Dice | largest, mm "
      "| diseased: sections | mm | MSD, mm | signed, mm | Dice | largest, mm |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  CaseScore all;
  for (int seed = arguments.first; seed < arguments.first + arguments.cases; ++seed) {
    const CaseScore score = score_case(arguments, seed);
    std::printf("| %d", seed);
    score.healthy.print();
    score.diseased.print();
    std::printf(" |\n");
    std::fflush(stdout);
    all.healthy.add(score.healthy);
    all.diseased.add(score.diseased);
    all.seconds += score.seconds;
    all.traced_mm += score.traced_mm;
  }
  std::printf("| all");
  all.healthy.print();
  all.diseased.print();
  std::printf(" |\nprocessor time: %.2f s for 100 mm of vessel\n", 100.0 * all.seconds / all.traced_mm);
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
    std::fprintf(stderr, "lumen_boundary_accuracy: %s\n", error.what());
    return 2;
  }
}
