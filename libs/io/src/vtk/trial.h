#pragma once
/// \file VTK's readers, tried first in a process that may die.

#include "surface_formats.h"

#include "ostia/core/error.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>
#include <vtkCallbackCommand.h>
#include <vtkErrorCode.h>
#include <vtkLogger.h>
#include <vtkNew.h>

#include <filesystem>
#include <string>
#include <utility>

namespace ostia::io {

/// Collects what VTK's reader says instead of letting it go to the terminal.
class Complaints {
 public:
  explicit Complaints(vtkObject& reader) {
    callback_->SetClientData(this);
    callback_->SetCallback([](vtkObject*, unsigned long, void* self, void* text) {
      std::string& first = static_cast<Complaints*>(self)->first_;
      if (first.empty() && text) first = static_cast<const char*>(text);
    });
    reader.AddObserver(vtkCommand::ErrorEvent, callback_);
    reader.AddObserver(vtkCommand::WarningEvent, callback_);
  }
  std::string text() const {
    std::string one_line = first_.substr(0, 300);
    for (char& c : one_line) c = c == '\n' ? ' ' : c;
    const std::size_t colon = one_line.find("): ");
    return colon == std::string::npos ? one_line : one_line.substr(colon + 3);
  }
  bool any() const { return !first_.empty(); }

 private:
  vtkNew<vtkCallbackCommand> callback_;
  std::string first_;
};

/// Limits this process's memory to what reading a file may take.
void limit_memory(const std::filesystem::path& path);
/// What the child wrote, and its end.
std::pair<std::string, int> outcome_of(pid_t child, int pipe);

template <class Reader>
std::string what_is_wrong(Reader& reader, const Complaints& complaints) {
  if (complaints.any()) return complaints.text();
  // Where there is no memory for all, VTK has nothing, and no word about it.
  if (reader.GetOutput() == nullptr || reader.GetOutput()->GetNumberOfPoints() == 0)
    return "it has no points";
  return reader.GetErrorCode() == vtkErrorCode::NoError
             ? ""
             : vtkErrorCode::GetStringFromErrorCode(reader.GetErrorCode());
}

/// VTK's readers end the process over some damaged files (a type that does not exist, a text without its end,
/// an array that cannot be unpacked), and only complain where there is no memory for a count that is too
/// large. A child with little memory tries first; when it dies or complains, this process has lost nothing.
template <class Reader>
void survive_reading(const std::filesystem::path& path) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw ResourceError("cannot read " + path.string() + ": no more files");
  const pid_t child = ::fork();
  if (child < 0) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw ResourceError("cannot read " + path.string() + ": no memory for a second process");
  }
  if (child == 0) {
    for (const int number : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGINT, SIGTERM})
      ::signal(number, SIG_DFL);
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    ::alarm(600);  // a lock that another thread held at the fork must not hold the parent for ever
    try {
      limit_memory(path);
      vtkNew<Reader> reader;
      reader->SetFileName(path.c_str());
      const Complaints complaints(*reader);
      reader->Update();
      const std::string wrong = what_is_wrong(*reader, complaints);
      ::_exit(!wrong.empty() && ::write(ends[1], wrong.data(), wrong.size()) != 0 ? 2 : 0);
    } catch (...) {
      ::_exit(1);
    }
  }
  ::close(ends[1]);
  const auto [said, status] = outcome_of(child, ends[0]);
  if (!said.empty()) refuse(path, said);
  if (status != 0) refuse(path, "it is damaged (VTK's reader breaks down over it)");
}

/// Runs a reader. Throws InvalidInput for a file over which it dies or complains.
template <class Reader>
void run(Reader& reader, const std::filesystem::path& path) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // what it has to say is in the refusal
  survive_reading<Reader>(path);
  const Complaints complaints(reader);
  reader.SetFileName(path.c_str());
  reader.Update();
  const std::string wrong = what_is_wrong(reader, complaints);
  if (!wrong.empty()) refuse(path, wrong);
}

}  // namespace ostia::io
