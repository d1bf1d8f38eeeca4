#include "errors.h"
#include "rooms.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/core/parallel.h"
#include "ostia/core/version.h"
#include "ostia/core/worker_program.h"

#include <pybind11/stl/filesystem.h>

namespace ostia::python {

void bind_core(py::module_& m) {
  py::register_exception_translator(&translate);
  // Warnings go to Python's logging instead (call.h); what else the libraries say is for programs.
  core::set_log(core::LogFormat::text, core::LogLevel::off);
  m.def("version", &core::version, "Version of the libraries, 'major.minor.patch'.");
  m.def(
      "set_threads",
      [](int threads) {
        if (threads < 0 || threads > 1024) throw InvalidInput("threads: 0 (all cores) to 1024");
        core::set_max_threads(threads);
      },
      py::arg("threads"),
      "Threads that parallel loops use from now on; 0: all cores. Results do not depend on it.");
  m.def("threads", &core::max_threads, "Upper bound on the threads of parallel loops.");
  m.def("_set_worker_program", &core::set_worker_program, py::arg("program"));
}

}  // namespace ostia::python
