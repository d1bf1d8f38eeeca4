#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/experiments/certainty.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace ostia::experiments {
namespace {

/// Looks brought to mean 0 and deviation 1, and a one for the constant.
struct StandardLooks {
  Eigen::MatrixXd rows;
  Eigen::VectorXd mean, deviation;
};

StandardLooks standardized(const std::vector<std::vector<double>>& looks) {
  const auto count = static_cast<Eigen::Index>(looks.size());
  const auto width = static_cast<Eigen::Index>(looks.front().size());
  StandardLooks made{Eigen::MatrixXd(count, width + 1), Eigen::VectorXd(width), Eigen::VectorXd(width)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::vector<double>& one = looks[static_cast<std::size_t>(i)];
    if (static_cast<Eigen::Index>(one.size()) != width)
      throw InvalidInput("logistic model: the looks have different lengths");
    for (Eigen::Index j = 0; j < width; ++j) made.rows(i, j) = one[static_cast<std::size_t>(j)];
  }
  for (Eigen::Index j = 0; j < width; ++j) {
    auto column = made.rows.col(j);
    made.mean(j) = column.mean();
    const double deviation = std::sqrt((column.array() - made.mean(j)).square().mean());
    made.deviation(j) = deviation > 0.0 ? deviation : 1.0;
    column = (column.array() - made.mean(j)) / made.deviation(j);
  }
  made.rows.col(width).setOnes();
  return made;
}

double logit_of(const LogisticWeights& weights, const std::vector<double>& looks) {
  double logit = weights.constant;
  for (std::size_t i = 0; i < looks.size(); ++i) logit += weights.weights[i] * looks[i];
  return logit;
}

std::string source_line(const char* name, const LogisticWeights& weights) {
  std::string text = std::string("inline constexpr double ") + name +
                     "_constant = " + core::fixed_text(weights.constant, 4) + ";\n" +
                     "inline constexpr double " + name + "_weights[] = {";
  for (std::size_t i = 0; i < weights.weights.size(); ++i)
    text += (i == 0 ? "" : ", ") + core::fixed_text(weights.weights[i], 4);
  return text + "};\n";
}

}  // namespace

LogisticWeights fitted_logistic(const std::vector<std::vector<double>>& looks,
                                const std::vector<bool>& right) {
  // Half of it for a weight of 1, in units of the log-likelihood: a patient's pieces come several times, by
  // levels of noise and two searches, and say hardly more than once.
  constexpr double penalty = 4.0;
  constexpr int most_steps = 100;
  constexpr double settled = 1e-10;
  const std::ptrdiff_t came = std::count(right.begin(), right.end(), true);
  if (looks.size() != right.size() || came == 0 || came == std::ssize(right))
    throw InvalidInput("logistic model: both outcomes are needed, each with its looks");
  const StandardLooks in = standardized(looks);
  const Eigen::Index width = in.rows.cols();
  Eigen::VectorXd outcome(in.rows.rows());
  for (Eigen::Index i = 0; i < outcome.size(); ++i)
    outcome(i) = right[static_cast<std::size_t>(i)] ? 1.0 : 0.0;
  Eigen::VectorXd penalties = Eigen::VectorXd::Constant(width, penalty);
  penalties(width - 1) = 0.0;
  const auto loss = [&](const Eigen::VectorXd& at) {
    const Eigen::ArrayXd logit = (in.rows * at).array();
    // log(1 + exp(x)) - y x, without overflow
    return (logit.max(0.0) + (-logit.abs()).exp().log1p() - outcome.array() * logit).sum() +
           0.5 * penalties.dot(at.cwiseAbs2());
  };
  Eigen::VectorXd at = Eigen::VectorXd::Zero(width);
  for (int step = 0; step < most_steps; ++step) {
    const Eigen::ArrayXd said = 1.0 / (1.0 + (-(in.rows * at).array()).exp());
    const Eigen::VectorXd slope =
        in.rows.transpose() * (said.matrix() - outcome) + penalties.cwiseProduct(at);
    const Eigen::VectorXd spread = (said * (1.0 - said)).matrix();
    Eigen::MatrixXd curvature = in.rows.transpose() * spread.asDiagonal() * in.rows;
    curvature.diagonal() += penalties;
    curvature.diagonal().array() += settled;
    const Eigen::VectorXd way = curvature.ldlt().solve(slope);
    double share = 1.0;
    while (share > settled && loss(at - share * way) > loss(at)) share *= 0.5;
    at -= share * way;
    if (share * way.norm() < settled) break;
  }
  LogisticWeights made{at(width - 1), std::vector<double>(static_cast<std::size_t>(width - 1))};
  for (Eigen::Index j = 0; j + 1 < width; ++j) {
    made.weights[static_cast<std::size_t>(j)] = at(j) / in.deviation(j);
    made.constant -= at(j) * in.mean(j) / in.deviation(j);
  }
  return made;
}

CertaintyWeights fitted_weights(const CertaintyRuns& runs) {
  const auto fit = [](const std::vector<JudgedPiece>& pieces) {
    std::vector<std::vector<double>> looks;
    std::vector<bool> right;
    for (const JudgedPiece& one : pieces) {
      looks.push_back(one.looks);
      right.push_back(one.right());
    }
    return fitted_logistic(looks, right);
  };
  CertaintyWeights made;
  made.piece = fit(runs.pieces);
  std::vector<JudgedPiece> vessels = runs.vessels;
  for (std::size_t v = 0; v < vessels.size(); ++v) {
    const std::size_t end = v + 1 < vessels.size() ? runs.first_piece[v + 1] : runs.pieces.size();
    std::vector<coronary::VesselPiece> pieces;
    std::vector<double> logits;
    for (std::size_t i = runs.first_piece[v]; i < end; ++i) {
      pieces.emplace_back();
      pieces.back().from_mm = runs.pieces[i].from_mm;
      pieces.back().to_mm = runs.pieces[i].to_mm;
      logits.push_back(logit_of(made.piece, runs.pieces[i].looks));
    }
    const auto looks = coronary::looks_of_vessel(pieces, logits);
    vessels[v].looks.assign(looks.begin(), looks.end());
  }
  made.vessel = fit(vessels);
  return made;
}

std::string source_of(const CertaintyWeights& weights) {
  return "#pragma once\n"
         "/// \\file Made by `ostia experiment certainty`, not by hand (docs/methods/certainty.md).\n\n"
         "namespace ostia::coronary {\n\n" +
         source_line("piece", weights.piece) + source_line("vessel", weights.vessel) +
         "\n}  // namespace ostia::coronary\n";
}

}  // namespace ostia::experiments
