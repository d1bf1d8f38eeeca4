#include "input/seeds.h"
#include "options/model_options.h"
#include "options/validators.h"
#include "output/outputs.h"
#include "output/refusal.h"
#include "tree/skeleton.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/io/centerline_file.h"
#include "ostia/pipeline/skeleton.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace ostia::app {
namespace {

pipeline::SkeletonOptions options_of(const SkeletonCommand& o, const imaging::Geometry& grid) {
  pipeline::SkeletonOptions how;
  how.fill_cavities = !o.keep_cavities;
  how.prune.length_mm = o.prune_mm;
  how.open_loops = o.no_loops;
  how.gaps.distance_mm = o.gap_mm;
  how.sections.sigma_mm = o.sigma_mm;
  how.sections.image_blur_mm = o.blur_mm;
  how.smooth->knot_spacing_mm = o.knots_mm;
  how.smooth->step_mm = o.step_mm;
  how.step_mm = o.step_mm;
  const SeedFrame frame{o.input.coords, &grid};
  const auto add = [&](const std::vector<std::string>& texts, std::vector<geometry::Vec3>& to) {
    for (const std::string& text : texts) {
      const std::vector<geometry::Vec3> places = seed_points(text, frame);
      to.insert(to.end(), places.begin(), places.end());
    }
  };
  add(o.inlets, how.inlets);
  add(o.cuts, how.commands.cuts);
  add(o.removals, how.commands.removals);
  for (const std::string& text : o.connections) {
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos)
      throw InvalidInput("--connect " + text + ": give two places, as x,y,z:x,y,z");
    how.commands.connections.emplace_back(seed_point("--connect", text.substr(0, colon), frame),
                                          seed_point("--connect", text.substr(colon + 1), frame));
  }
  return how;
}

pipeline::Source load_mask(const SkeletonCommand& o, const core::TaskContext& task) {
  pipeline::Source source = pipeline::load(o.input.input, source_options(o.input), task);
  for (const std::string& warning : source.warnings) core::log_warning(warning);
  if (!source.mask)
    throw InvalidInput("cannot thin " + o.input.input.string() + ": it is " + with_article(source.kind) +
                       " and no mask; a mask has two values or a few, such as 0 and 1");
  return source;
}

void print(const pipeline::SkeletonResult& result, bool as_json) {
  const auto edges = static_cast<std::int64_t>(result.skeleton.graph.edges.size());
  if (!as_json) {
    std::printf("%lld lines, %.1f mm, %lld part(s), %lld loop(s), %zu vessels\n",
                static_cast<long long>(edges), result.length_mm, static_cast<long long>(result.components),
                static_cast<long long>(result.loops), result.tree.tree.vessels.size());
    return;
  }
  const nlohmann::json facts{{"v", 1},
                             {"kind", "skeleton"},
                             {"object_voxels", result.object_voxels},
                             {"skeleton_voxels", result.skeleton_voxels},
                             {"lines", edges},
                             {"length_mm", result.length_mm},
                             {"components", result.components},
                             {"loops", result.loops},
                             {"opened_loops", result.tree.opened_edges.size()},
                             {"vessels", result.tree.tree.vessels.size()},
                             {"interpolated_points", result.skeleton.interpolated},
                             {"warnings", result.warnings}};
  std::puts(facts.dump(2).c_str());
}

}  // namespace

ExitCode run_skeleton(const SkeletonCommand& o, const core::TaskContext& task) {
  require_output(o.output, line_outputs);
  require_output(o.sections, {".csv"});
  task.set_stage("reading");
  const pipeline::Source source = load_mask(o, task.sub(0.0, 0.1));
  pipeline::Source grey;
  if (!o.image.empty()) grey = pipeline::load_ct(o.image, {}, task.sub(0.1, 0.2));
  const pipeline::SkeletonOptions how = options_of(o, source.mask->geometry);
  const pipeline::SkeletonResult result = naming(o.input.input, [&] {
    return pipeline::skeleton_of(*source.mask, grey.image.get(), how, task.sub(0.2, 0.95));
  });
  for (const std::string& warning : result.warnings) core::log_warning(warning);
  task.throw_if_cancelled();
  io::write_centerlines(o.output, result.tree.tree);
  if (!o.sections.empty()) core::write_file(o.sections, pipeline::sections_csv(result.skeleton));
  task.set_progress(1.0);
  print(result, o.json);
  return ExitCode::ok;
}

void define_skeleton(CLI::App& app, SkeletonCommand& c,
                     std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* skeleton = app.add_subcommand(
      "skeleton", "Centerlines of a mask by thinning, with loops seen and radii of circles and ellipses");
  skeleton->footer("Example:\n  ostia skeleton vessels.nrrd -o lines.vtp --inlet 8,-187,675");
  skeleton->fallthrough();
  skeleton->add_option("INPUT", c.input.input, "Mask: 0 outside, else inside")->required();
  skeleton->add_option("-o,--output", c.output, ".vtp, .csv or .mrk.json")->required();
  skeleton->add_option("--image", c.image,
                       "The CT that the mask was made of, for the radii; left out: the mask's edges");
  skeleton->add_option("--sections", c.sections, "Also a table of circles and ellipses: .csv");
  skeleton
      ->add_option("--inlet", c.inlets,
                   "Where flow begins, x,y,z, or a file of points; repeat; left out: the widest ends")
      ->allow_extra_args(false);
  skeleton->add_option("--cut", c.cuts, "The line is cut at this place, x,y,z, or a file of places; repeat")
      ->allow_extra_args(false);
  skeleton
      ->add_option("--remove", c.removals,
                   "The line nearest to this place goes, x,y,z, or a file of places; repeat")
      ->allow_extra_args(false);
  skeleton
      ->add_option(
          "--connect", c.connections,
          "A straight line between two places of lines, x,y,z:x,y,z; repeat; after cuts and removals")
      ->allow_extra_args(false);
  skeleton->add_option("--coords", c.input.coords, "Frame of the points given: lps or ras (mm), ijk (voxels)")
      ->check(CLI::IsMember({"lps", "ras", "ijk"}));
  skeleton->add_option("--prune", c.prune_mm, "Leaves shorter than this go, mm")->check(zero_or_above());
  skeleton->add_flag("--no-loops", c.no_loops, "Of each loop the thinnest line goes: vessels that touch");
  skeleton->add_option("--gap", c.gap_mm, "Gaps up to this are closed, mm")->check(zero_or_above());
  skeleton->add_option("--sigma", c.sigma_mm, "Of the Gaussian that the walls are found with, mm")
      ->check(above_zero());
  skeleton->add_option("--blur", c.blur_mm, "Standard deviation of the image's own blur, mm")
      ->check(zero_or_above());
  skeleton->add_option("--knots", c.knots_mm, "Distance between the knots of the smooth lines, mm")
      ->check(above_zero());
  skeleton->add_option("--step", c.step_mm, "Distance between the points of the lines, mm")
      ->check(above_zero());
  skeleton->add_flag("--keep-cavities", c.keep_cavities,
                     "Cavities inside the object are not filled; one is then refused");
  skeleton->add_flag("--json", c.json, "One JSON object on standard output");
  skeleton->callback([&] { run = [&](const core::TaskContext& task) { return run_skeleton(c, task); }; });
}

}  // namespace ostia::app
