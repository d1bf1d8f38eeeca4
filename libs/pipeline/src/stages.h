#pragma once
/// \file Stages of a long job, named and timed.

#include "ostia/core/log.h"
#include "ostia/core/task_context.h"
#include "ostia/pipeline/model.h"

#include <chrono>
#include <string>
#include <vector>

namespace ostia::pipeline {

/// Runs stages one after another, names and times them.
class Stages {
 public:
  explicit Stages(std::vector<StageTime>& times, const core::TaskContext& task)
      : times_(times), task_(task) {}

  template <class Work>
  auto run(const std::string& name, double from, double to, const Work& work) {
    task_.throw_if_cancelled();
    task_.set_stage(name);
    const auto start = std::chrono::steady_clock::now();
    const core::TaskContext part = task_.sub(from, to);
    auto result = work(part);
    part.set_progress(1.0);
    times_.push_back({name, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()});
    core::log_debug(name + " took " + std::to_string(times_.back().seconds) + " s");
    return result;
  }

 private:
  std::vector<StageTime>& times_;
  const core::TaskContext& task_;
};

inline void append(std::vector<std::string>& to, const std::vector<std::string>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace ostia::pipeline
