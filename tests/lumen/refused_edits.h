#pragma once
/// \file Edits that a model must refuse.

#include "ostia/core/error.h"
#include "ostia/lumen/edit.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

namespace ostia::lumen::testing {

/// The message must hold each of the words, and the model be what it was.
inline void expect_refused(const LumenModel& model, const Edit& edit,
                           std::initializer_list<const char*> words) {
  const std::string before = digest(model);
  try {
    apply(model, edit);
    FAIL() << "not refused: " << *words.begin();
  } catch (const InvalidInput& error) {
    for (const char* word : words)
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos)
          << word << " is not in: " << error.what();
  }
  EXPECT_EQ(digest(model), before);
}

}  // namespace ostia::lumen::testing
