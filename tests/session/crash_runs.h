#pragma once
/// \file Sessions of edits that are killed at a random moment, and what must be left of them.

#include "case_tools.h"

#include "ostia/session/replay.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <iostream>
#include <random>
#include <thread>

namespace ostia::session::testing {

/// The i-th annotation: added, marked or deleted; each is one commit.
inline void annotation(CaseFile& file, int i) {
  const auto& measurements = file.annotations()->measurements;
  switch (i / 7 % 4) {
    case 0:
      file.annotate_merged(added(analysis::MeasureKind::distance), i);
      break;
    case 1:
      file.annotate(marked("seen " + std::to_string(i)));
      break;
    case 2:
      file.annotate(added(analysis::MeasureKind::stenosis));
      break;
    default:
      if (!measurements.empty()) file.annotate(MeasureDelete{measurements.front().id});
      break;
  }
}

/// Drags the last measurement on; one step with its making where that was the command before.
inline void dragging(CaseFile& file, int i) {
  const auto& measurements = file.annotations()->measurements;
  if (measurements.empty() || measurements.back().points.empty()) return;
  file.annotate_merged(moved(file, measurements.back().id, 0.1 * i), i - 1);
}

/// The i-th command of a session: edits of the wall and of the name, annotations, some undone, some redone.
inline void command(CaseFile& file, int i) {
  const double s = 4.0 + (i * 7) % 22;
  switch (i % 7) {
    case 0:
      file.apply(ring(s, 1.3 + 0.02 * (i % 20)));
      break;
    case 1:
      file.apply_merged(drag(s, 0.1 + 0.01 * (i % 10)));
      break;
    case 2:
      file.apply(renamed("LAD " + std::to_string(i)));
      break;
    case 3:
      annotation(file, i);
      break;
    case 4:
      dragging(file, i);
      break;
    case 5:
      file.undo();
      break;
    default:
      file.redo();
      break;
  }
}

/// The child makes commands from the case's present state on and tells of each that has returned.
inline void run_session(const fs::path& path, int first, int count, int pipe) {
  try {
    CaseFile file = CaseFile::open(path);
    for (int i = first; i < first + count; ++i) {
      command(file, i);
      const auto journal = static_cast<std::int64_t>(i);
      if (::write(pipe, &journal, sizeof journal) != sizeof journal) ::_exit(3);
    }
  } catch (const std::exception&) {
    ::_exit(2);
  }
  ::_exit(0);
}

/// When a session is killed: so long after so many of its commands have returned.
struct Kill {
  int after = 0;
  std::chrono::microseconds wait{0};
};
/// At a moment drawn from a session of `commands`: within a command or between two of them.
inline Kill random_kill(std::mt19937& random, int commands) {
  return {static_cast<int>(random() % static_cast<unsigned>(commands)),
          std::chrono::microseconds(random() % 1500)};
}

/// One session of `commands`; returns how many had returned before it was killed.
inline int killed_session(const fs::path& path, int commands, const Kill& kill) {
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    run_session(path, 0, commands, ends[1]);
  }
  ::close(ends[1]);
  std::int64_t told = 0;
  int returned = 0;
  const auto read_one = [&] {
    if (::read(ends[0], &told, sizeof told) != sizeof told) return false;
    returned = static_cast<int>(told) + 1;
    return true;
  };
  while (returned < kill.after && read_one()) {
  }
  std::this_thread::sleep_for(kill.wait);
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0) << "the session failed by itself";
  while (read_one()) {
  }
  ::close(ends[0]);
  return returned;
}

/// Kills `kills` sessions of `commands`, each on a new case.
inline void expect_nothing_lost(int kills, int commands) {
  const TempFolder folder;
  { CaseFile::create(folder / "start.ostia", tube_model()); }
  std::mt19937 random(11);
  int complete = 0, in_flight_kept = 0;
  for (int k = 0; k < kills; ++k) {
    const fs::path path = folder / ("case" + std::to_string(k) + ".ostia");
    fs::copy_file(folder / "start.ostia", path);
    const int returned = killed_session(path, commands, random_kill(random, commands));
    complete += returned == commands ? 1 : 0;
    // The same commands without a kill, as far as they had returned, and with the one in flight.
    CaseFile file = CaseFile::open(path);
    const fs::path other = folder / ("other" + std::to_string(k) + ".ostia");
    CaseFile expected = CaseFile::create(other, tube_model());
    for (int i = 0; i < returned; ++i) command(expected, i);
    const auto state = [](const CaseFile& of) {
      return lumen::digest(*of.model()) + text_of(*of.annotations()) + std::to_string(of.journal().size());
    };
    const std::string found = state(file);
    const auto as_expected = [&] { return found == state(expected); };
    bool same = as_expected();
    if (!same && returned < commands) {
      command(expected, returned);
      same = as_expected();
      in_flight_kept += same ? 1 : 0;
    }
    EXPECT_TRUE(same) << "killed after " << returned << " commands";
    EXPECT_TRUE(replay(file).same());
    command(file, 0);  // and it goes on
  }
  EXPECT_LT(complete, kills) << "every session was over before its kill";
  std::cout << kills << " kills: " << complete << " sessions were over, " << in_flight_kept
            << " had committed the command in flight\n";
}

}  // namespace ostia::session::testing
