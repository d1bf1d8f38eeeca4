#pragma once
/// \file Edits that a model must refuse, and those that it takes.

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

/// The outcome is sound, the same when it is done again, and the model is what it was.
inline EditOutcome applied(const LumenModel& model, const Edit& edit) {
  const std::string before = digest(model);
  EditOutcome outcome = apply(model, edit);
  EXPECT_EQ(digest(model), before);
  EXPECT_EQ(find_fault(outcome.model), std::nullopt);
  EXPECT_EQ(digest(apply(model, edit).model), digest(outcome.model));
  return outcome;
}

}  // namespace ostia::lumen::testing
