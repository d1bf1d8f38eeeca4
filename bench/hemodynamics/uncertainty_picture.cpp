// The pullback along one way of a drawn tree with its band: uncertainty_picture FILE.png

#include "ten_vessels.h"

#include "ostia/figure/plot.h"
#include "ostia/hemodynamics/uncertainty.h"

#include <cstdio>
#include <limits>
#include <string>
#include <vector>

using namespace ostia;

namespace {

constexpr std::size_t way[] = {0, 1, 3, 5, 7};  // left main and LAD

struct Course {
  figure::Series told{"as drawn"}, median{"median of 1,000 trees"}, band{"95 % of them"}, high{""};
};

Course course_of(const hemodynamics::Network& network, const hemodynamics::TreeReadings& nominal,
                 const hemodynamics::PressureUncertainty& found) {
  Course out;
  double gone = 0.0;
  for (const std::size_t b : way) {
    const auto& stations = network.branches[b].stations;
    for (std::size_t i = 0; i < stations.size(); ++i) {
      const double s = gone + stations[i].s_mm;
      for (auto* one : {&out.told, &out.median, &out.band, &out.high}) one->x.push_back(s);
      out.told.y.push_back(nominal.ratio(b, i));
      out.median.y.push_back(found.stations[b][i].median);
      out.band.y.push_back(found.stations[b][i].low);
      out.high.y.push_back(found.stations[b][i].high);
    }
    gone += stations.back().s_mm;
  }
  return out;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("usage: uncertainty_picture FILE.png\n", stderr);
    return 2;
  }
  hemodynamics::Network network = bench::ten_vessels();
  for (std::size_t b = 0; b < network.branches.size(); ++b)
    network.branches[b].vessel = static_cast<std::int32_t>(b);
  const hemodynamics::Conditions conditions;
  hemodynamics::FlowModel model;
  model.from_rest = true;
  const std::vector<hemodynamics::LesionPlace> lesions = {{"S1", {1, 7.5}, {1, 12.5}, {1, 17.5}}};
  const hemodynamics::PreparedNetwork prepared(network, hemodynamics::flow_model_of(conditions, model));
  const auto state = hemodynamics::flow_state(
      prepared, conditions, hemodynamics::resting_flow(network, conditions), hemodynamics::State::hyperaemia);
  const auto found = hemodynamics::pressure_uncertainty(network, conditions, lesions, model);
  Course course = course_of(network, hemodynamics::read_tree(prepared, state, lesions), found);
  course.band.style = course.high.style = figure::LineStyle::dashed;
  course.band.color = course.high.color = figure::Color{0.55, 0.55, 0.55};
  // One series, so that the legend has one line: a value that is none parts the two.
  course.band.x.push_back(course.band.x.back());
  course.band.y.push_back(std::numeric_limits<double>::quiet_NaN());
  course.band.x.insert(course.band.x.end(), course.high.x.begin(), course.high.x.end());
  course.band.y.insert(course.band.y.end(), course.high.y.begin(), course.high.y.end());
  figure::PlotOptions how;
  how.title = "FFR along left main and LAD, and how sure it is";
  how.x_label = "from the aorta, mm";
  how.y_label = "Pd/Pa";
  how.y_range = {{0.5, 1.0}};
  how.references = {{figure::ReferenceLine::Along::y, 0.80, "0.80"}};
  figure::line_plot({course.told, course.median, course.band}, how).write_png(arguments[1]);
  const auto& lesion = found.lesions[0];
  std::printf("S1: median %.3f, 95 %% %.3f to %.3f, at or below 0.80 in %.0f %%\n", lesion.ratio.median,
              lesion.ratio.low, lesion.ratio.high, 100.0 * lesion.ratio.probability);
  for (std::size_t g = 0; g < hemodynamics::input_groups; ++g)
    std::printf("  %-11s first %.3f, total %.3f\n",
                std::string(hemodynamics::name_of(static_cast<hemodynamics::InputGroup>(g))).c_str(),
                lesion.indices.first[g], lesion.indices.total[g]);
  return 0;
}
