#include "shell/main_window_walks.h"

#include "measuring/lesions.h"
#include "qa/walk_player.h"
#include "qa/walk_recorder.h"
#include "shell/main_window.h"
#include "vessels/evaluability.h"
#include "vessels/fat.h"
#include "vessels/outer_walls.h"

#include "ostia/session/case_file.h"

#include <utility>

namespace ostia::workstation {
namespace {

/// What a walk may expect: figures of the case and of the tables beside it.
WalkPlayer::Counts counts_of(MainWindow& window) {
  session::Workbench& bench = window.bench();
  const auto of_case = [&bench](const auto& count) {
    return [&bench, count] {
      return bench.has_case() ? static_cast<double>(count(bench.session().file())) : 0.0;
    };
  };
  WalkPlayer::Counts counts;
  counts["cases"] = [&bench] { return bench.has_case() ? 1.0 : 0.0; };
  counts["vessels"] = [&bench] {
    return bench.has_case() ? static_cast<double>(bench.model()->tree.vessels.size()) : 0.0;
  };
  counts["edits"] = of_case([](const session::CaseFile& file) { return file.edits().size(); });
  counts["measurements"] =
      of_case([](const session::CaseFile& file) { return file.annotations()->measurements.size(); });
  counts["lesions"] = [&window] { return static_cast<double>(window.lesions().list().topLevelItemCount()); };
  return counts;
}

}  // namespace

void record_walk(MainWindow& window, const std::filesystem::path& file) {
  new WalkRecorder(window.commands(), file, &window);
}

void begin_walk(MainWindow& window, const std::filesystem::path& file, const std::filesystem::path& folder,
                std::function<void(const QString& failure)> ended) {
  WalkPlayer::Stage stage;
  stage.window = &window;
  stage.bench = &window.bench();
  stage.commands = &window.commands();
  stage.idle = [&window] {
    return !window.jobs().any() && window.evaluability().idle() && window.lesions().idle() &&
           window.outer_walls().idle() && window.fat().idle();
  };
  stage.counts = counts_of(window);
  stage.folder = folder;
  auto* player = new WalkPlayer(std::move(stage), read_walk(file), &window);
  QObject::connect(player, &WalkPlayer::ended, &window,
                   [player, ended = std::move(ended)] { ended(player->failure()); });
  player->start();
}

}  // namespace ostia::workstation
