#include "measurements.h"

#include <GLFW/glfw3.h>
#include <nlohmann/json.hpp>

namespace ostia::live {
namespace {

using nlohmann::json;

json spread_json(const Spread& spread) {
  return {{"p50", spread.p50}, {"p95", spread.p95}, {"max", spread.max}, {"count", spread.count}};
}

}  // namespace

std::string measurements_json(const Viewer& viewer, const FrameMeter& meter, const StartTimes& times,
                              int width, int height, int screenshots) {
  const Playback& play = viewer.playback();
  const Shown& shown = viewer.shown();
  json result{{"renderer", glview::renderer_name()},
              {"width_px", width},
              {"height_px", height},
              {"first_picture_s", times.first_picture_s},
              {"prepared_s", times.prepared_s},
              {"frames", meter.frames()},
              {"frames_per_second", meter.frames_per_second()},
              {"frame_ms", spread_json(meter.frame_ms())},
              {"phase", play.phase()},
              {"paused", play.paused()},
              {"speed", play.speed()},
              {"state", play.state().text},
              {"follows_ecg", play.follows_ecg()},
              {"view",
               {{"lao_deg", shown.camera.angles.lao_deg},
                {"cranial_deg", shown.camera.angles.cranial_deg},
                {"half_height_mm", shown.camera.half_height_mm},
                {"x_ray", shown.camera.projection == glview::Projection::x_ray}}},
              {"value", glview::title(shown.value)},
              {"panels", shown.panels},
              {"help", shown.help},
              {"screenshots", screenshots}};
  if (const EcgFeed* feed = play.feed()) {
    result["sample_to_picture_ms"] = spread_json(meter.latency_ms());
    result["signal"] = play.signal().text;
    result["stream_s"] = play.stream_s();
    result["beats"] = feed->peaks().size();
  }
  return result.dump(2);
}

void finish_drawing() {
  using Finish = void (*)();
  static const auto finish = reinterpret_cast<Finish>(glfwGetProcAddress("glFinish"));
  if (finish != nullptr) finish();
}

}  // namespace ostia::live
