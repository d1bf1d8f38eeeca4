// The folder of a comparison.

#include "ostia/core/files.h"
#include "ostia/core/parallel_invoke.h"
#include "ostia/session/comparison.h"

#include <chrono>

namespace ostia::session {
namespace fs = std::filesystem;

void write_comparison(const fs::path& folder, const Comparison& made, const pipeline::JobKey& job,
                      ExitCode code, double seconds_before, const core::TaskContext& task) {
  const auto start = std::chrono::steady_clock::now();
  pipeline::require_free_folder(folder);
  task.throw_if_cancelled();
  task.set_stage("writing");
  core::StagedFolder staged(folder);
  const fs::path& out = staged.temporary();
  const std::vector<KeyImage> images = comparison_images(made);
  fs::create_directory(out / "images");
  for (const KeyImage& image : images) {
    task.throw_if_cancelled();
    image.picture.write_png(out / "images" / (image.name + ".png"), 2.0);
  }
  core::parallel_invoke([&] { core::write_file(out / "comparison.pdf", comparison_pdf(made, images)); },
                        [&] {
                          core::write_file(out / "comparison.html", comparison_html(made, images));
                          core::write_file(out / "comparison.json", comparison_json(made));
                          core::write_file(out / "comparison.csv", comparison_csv(made));
                        });
  task.throw_if_cancelled();
  const double seconds =
      seconds_before + std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  pipeline::write_manifest(out, {job, code, seconds, made.warnings, "{}"});
  staged.commit();
  task.set_progress(1.0);
}

}  // namespace ostia::session
