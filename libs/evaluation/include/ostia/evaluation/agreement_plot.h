#pragma once
/// \file The plot of Bland and Altman.

#include "ostia/figure/picture.h"

#include <string>
#include <vector>

namespace ostia::evaluation {

struct AgreementPlotOptions {
  std::string title{};
  std::string unit = "mm";
  int width_px = 720, height_px = 420;
};

/// Difference (result - reference) against the mean of both, one dot a pair, with lines at the bias and the
/// limits of agreement, their values, and the regression line where its slope is more than two standard
/// errors from 0. Throws as bland_altman does.
figure::Picture agreement_plot(const std::vector<double>& reference, const std::vector<double>& result,
                               const AgreementPlotOptions& options = {});

}  // namespace ostia::evaluation
