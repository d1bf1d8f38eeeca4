// Makes the picture of docs/methods/lumen-model.md: model_picture OUT.png
// f across a stenosed vessel and along its wall, for each kernel, beside what is exact.
#include "picture.h"
#include "tube_samples.h"

#include "ostia/figure/plot.h"
#include "ostia/figure/scene.h"
#include "ostia/geometry/zero_crossing.h"

#include <cstdio>

namespace {

using namespace ostia;
using namespace ostia::lumen;

constexpr double length_mm = 25.0, throat_mm = 12.5, spacing_mm = 0.9, theta = 0.4;

double wall(double s, double) {
  return 1.5 * (1.0 - 0.65 * std::exp(-std::pow((s - throat_mm) / 3.0, 2)));
}

struct Solved {
  const char* name;
  figure::Color color;
  ImplicitSurface f;
};

std::vector<Solved> solved(VesselLumen vessel) {
  std::vector<Solved> out;
  const auto add = [&](const char* name, const figure::Color& color, Kernel kernel, FarField far_field) {
    vessel.interpolation.kernel = kernel;
    vessel.interpolation.far_field = far_field;
    out.push_back({name, color, solve(vessel)});
  };
  add("Morse C0", {0.90, 0.62, 0.00}, Kernel::morse_c0, FarField::constant);
  add("Wendland C2", {0.00, 0.45, 0.70}, Kernel::wendland_c2, FarField::constant);
  add("Wendland C4", {0.00, 0.62, 0.45}, Kernel::wendland_c4, FarField::constant);
  add("C2, linear far field", {0.80, 0.47, 0.65}, Kernel::wendland_c2, FarField::linear);
  return out;
}

figure::PlotOptions plot(const char* title, const char* x, const char* y) {
  figure::PlotOptions options;
  options.title = title;
  options.x_label = x;
  options.y_label = y;
  options.width_px = 720;
  options.height_px = 400;
  return options;
}

/// f on a line across the vessel.
figure::Picture across(const std::vector<Solved>& fields, const geometry::AxisCurve& axis, double s,
                       const char* title) {
  std::vector<figure::Series> series;
  for (const Solved& one : fields) {
    figure::Series line{.name = one.name, .x = {}, .y = {}, .color = one.color};
    for (double x = -8.0; x <= 8.0; x += 0.05) {
      line.x.push_back(x);
      line.y.push_back(one.f.value(axis.place(s, theta, x)));
    }
    series.push_back(std::move(line));
  }
  series.push_back(figure::Series{.name = "the wall",
                                  .x = {-wall(s, 0.0), wall(s, 0.0)},
                                  .y = {0.0, 0.0},
                                  .color = figure::Color{0.1, 0.1, 0.1},
                                  .style = figure::LineStyle::points,
                                  .width_px = 5.0});
  return figure::line_plot(series, plot(title, "mm across the vessel", "f (mm)"));
}

/// A quantity of each field along a line of the wall.
template <class Quantity>
figure::Picture along(const std::vector<Solved>& fields, const char* title, const char* label,
                      const Quantity& quantity) {
  std::vector<figure::Series> series;
  for (const Solved& one : fields) {
    figure::Series line{.name = one.name, .x = {}, .y = {}, .color = one.color};
    for (double s = 3.0; s <= length_mm - 3.0; s += 0.05) {
      line.x.push_back(s);
      line.y.push_back(quantity(one.f, s));
    }
    series.push_back(std::move(line));
  }
  return figure::line_plot(series, plot(title, "mm along the vessel", label));
}

/// Of f's zero from the exact wall along a ray, micrometres.
double offset_um(const ImplicitSurface& f, const geometry::AxisCurve& axis, double s) {
  const double r = wall(s, 0.0), span = std::min(0.3, 0.6 * r);
  const double t = geometry::zero_crossing(
      [&](double u) { return f.value(axis.place(s, theta, r - span + 2.0 * span * u)); },
      {.value = 1e-9, .bracket = 1e-7, .most_iterations = 60});
  return 1e3 * (2.0 * t - 1.0) * span;
}

void make(const std::string& file) {
  const auto axis = testing::bent_axis(length_mm);
  const std::vector<Solved> fields = solved(testing::tube_vessel(axis, wall, spacing_mm));
  figure::grid({across(fields, *axis, 4.0, "f across the vessel at 4 mm"),
                across(fields, *axis, throat_mm, "f across the throat, a stenosis of 65 %"),
                along(fields, "The wall beside the exact one", "micrometres",
                      [&](const ImplicitSurface& f, double s) { return offset_um(f, *axis, s); }),
                along(fields, "Slope of f on the wall; 1 is a distance", "length of the gradient",
                      [&](const ImplicitSurface& f, double s) {
                        return f.gradient(axis->place(s, theta, wall(s, 0.0))).norm();
                      })},
               {.columns = 2, .look = figure::Look::light})
      .write(file);
}

}  // namespace

int main(int argc, char** argv) {
  return ostia::bench::make_picture(argc, argv, "OUTPUT.png", 1,
                                    [](const std::vector<std::string>& given) { make(given[0]); });
}
