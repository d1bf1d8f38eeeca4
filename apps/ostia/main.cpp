// The command line program.

#include "cli.h"

#include "ostia/core/program.h"

#include <string>
#include <vector>

int main(int argc, char** argv) {
  return ostia::core::run_program("ostia", [&](const ostia::core::TaskContext& task) {
    return ostia::app::run(std::vector<std::string>(argv + 1, argv + argc), task);
  });
}
