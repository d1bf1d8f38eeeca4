#pragma once
/// \file Where the worker is: the program that runs what may crash on foreign data.

#include <filesystem>

namespace ostia::core {

/// The worker program, the first that there is of
/// - $OSTIA_WORKER (taken as it is, also where nothing stands there),
/// - `ostia-worker` beside the running program, as in a build folder,
/// - `ostia/ostia-worker` in the folder for such programs of the installed tree that the running program
///   belongs to,
/// - what set_worker_program was told.
/// Where there is none, the place beside the running program, so that a refusal names it.
std::filesystem::path worker_program();

/// Tells where the worker is when the running program is not part of Ostia's own tree. A program linked by
/// `find_package(Ostia)` has told it before main begins. Not thread-safe.
void set_worker_program(const std::filesystem::path& program);

}  // namespace ostia::core
