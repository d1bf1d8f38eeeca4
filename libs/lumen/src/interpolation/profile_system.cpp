#include "interpolation/profile_system.h"

#include "ostia/core/error.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

namespace ostia::lumen {
namespace {

using Eigen::Index;

constexpr std::size_t block_size = 24;
constexpr double largest_bytes = 2.0 * (1ULL << 30);
constexpr double same_factor = 1e-12;  // entries of L are at most 1
constexpr double negligible = 1e-13;   // of the largest entry of a right-hand side
constexpr double enough_profile_mm = 1e-11, profile_tolerance_mm = 1e-7;
constexpr int profile_refinements = 6;
constexpr double profile_told_mm = 1e-6;
constexpr double profile_unit_mm = 10.0;  // of the polynomial's terms

[[noreturn]] void not_definite(double s_mm) {
  throw NumericalError("the system of the wall is not positive definite near " + std::to_string(s_mm) +
                       " mm along the vessel: samples are too near to each other for the support radius; "
                       "remove some or reduce it");
}

}  // namespace

// Rows as they were before a change.
struct ProfileSystem::Journal {
  std::map<std::size_t, Row> rows;                            // with a and l: assembled or factored anew
  std::vector<std::pair<Matrix, Eigen::VectorXd>> solutions;  // of all rows
  Eigen::Vector4d q;
  double residual = 0.0;
};

ProfileSystem::ProfileSystem(const std::vector<Constraint>& constraints, const InterpolationOptions& options)
    : options_(options) {
  for (const Constraint& c : constraints) centre_ += c.place / static_cast<double>(constraints.size());
  for (std::size_t first = 0; first < constraints.size();) {
    std::size_t end = std::min(first + block_size, constraints.size());
    while (end < constraints.size() && constraints[end].s_mm == constraints[end - 1].s_mm) ++end;
    if (first > 0) cuts_.push_back(constraints[first].s_mm);
    Row row;
    set_members(row, {constraints.begin() + static_cast<std::ptrdiff_t>(first),
                      constraints.begin() + static_cast<std::ptrdiff_t>(end)});
    first_largest_ = std::max(first_largest_, end - first);
    rows_.push_back(std::move(row));
    first = end;
  }
  number_rows();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    rows_[i].first = i;
    for (std::size_t j = 0; j < i; ++j) {
      if (!coupled(rows_[i], rows_[j])) continue;
      rows_[i].first = j;
      break;
    }
  }
  refuse_what_does_not_fit();
  for (std::size_t i = 0; i < rows_.size(); ++i) assemble(i);
  for (std::size_t i = 0; i < rows_.size(); ++i) factor_row(i);
  refine(std::vector<char>(rows_.size(), 1));
}

std::size_t ProfileSystem::block_of(double s_mm) const {
  return static_cast<std::size_t>(std::upper_bound(cuts_.begin(), cuts_.end(), s_mm) - cuts_.begin());
}

void ProfileSystem::set_members(Row& row, std::vector<Constraint> members) const {
  const bool linear = options_.far_field == FarField::linear;
  const auto n = static_cast<Index>(members.size());
  row.box.setEmpty();
  row.right.resize(n, linear ? 5 : 1);
  for (Index i = 0; i < n; ++i) {
    const Constraint& c = members[static_cast<std::size_t>(i)];
    row.box.extend(c.place);
    const Vec3 p = (c.place - centre_) / profile_unit_mm;
    if (linear)
      row.right.row(i) << c.value, 1.0, p.x(), p.y(), p.z();
    else
      row.right(i, 0) = c.value - options_.offset_mm;
  }
  // Of the solution what stays is kept; what comes begins with nothing.
  Matrix x = Matrix::Zero(n, row.right.cols());
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(n);
  std::size_t old = 0;
  for (Index i = 0; i < n; ++i) {
    const Constraint& c = members[static_cast<std::size_t>(i)];
    while (old < row.members.size() && constraint_order(row.members[old], c)) ++old;
    if (old == row.members.size() || row.members[old].key != c.key || row.members[old].place != c.place)
      continue;
    x.row(i) = row.x.row(static_cast<Index>(old));
    weights[i] = row.weights[static_cast<Index>(old)];
  }
  row.x = std::move(x);
  row.weights = std::move(weights);
  row.members = std::move(members);
}

bool ProfileSystem::coupled(const Row& a, const Row& b) const {
  const double reach2 = options_.support_radius_mm * options_.support_radius_mm;
  if (a.members.empty() || b.members.empty() || !(a.box.squaredExteriorDistance(b.box) < reach2))
    return false;
  for (const Constraint& c : a.members) {
    if (!(b.box.squaredExteriorDistance(c.place) < reach2)) continue;
    for (const Constraint& d : b.members)
      if ((c.place - d.place).squaredNorm() < reach2) return true;
  }
  return false;
}

void ProfileSystem::number_rows() {
  start_.assign(rows_.size() + 1, 0);
  for (std::size_t i = 0; i < rows_.size(); ++i)
    start_[i + 1] = start_[i] + static_cast<Index>(rows_[i].members.size());
}

void ProfileSystem::refuse_what_does_not_fit() const {
  double bytes = 0.0;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    bytes += 16.0 * static_cast<double>(rows_[i].members.size()) *
             static_cast<double>(start_[i + 1] - start_[rows_[i].first]);
  if (bytes <= largest_bytes) return;
  throw ResourceError("the system of a wall with " + std::to_string(start_.back()) +
                      " constraints fills up: with a support radius of " +
                      std::to_string(options_.support_radius_mm) + " mm it takes " +
                      std::to_string(static_cast<long long>(bytes / (1 << 20))) + " MiB, more than " +
                      std::to_string(static_cast<long long>(largest_bytes / (1 << 20))) +
                      " MiB; reduce the support radius or the number of samples");
}

void ProfileSystem::assemble(std::size_t i) {
  Row& row = rows_[i];
  const double scale = 1.0 / options_.support_radius_mm;
  row.a.resize(static_cast<Index>(row.members.size()), start_[i + 1] - start_[row.first]);
  for (std::size_t j = row.first; j <= i; ++j) {
    Index column = offset(i, j);
    for (const Constraint& d : rows_[j].members) {
      double* out = row.a.col(column++).data();
      for (const Constraint& c : row.members) {
        const double x2 = (c.place - d.place).squaredNorm() * scale * scale;
        *out++ = x2 < 1.0 ? phi(options_.kernel, std::sqrt(x2)) : 0.0;
      }
    }
  }
}

void ProfileSystem::factor_row(std::size_t i) {
  Row& row = rows_[i];
  row.l = row.a;
  const Index n = row.l.rows();
  if (n == 0) return;
  for (std::size_t j = row.first; j < i; ++j) {
    const Row& other = rows_[j];
    const Index m = other.l.rows();
    if (m == 0) continue;
    auto part = row.l.middleCols(offset(i, j), m);
    const std::size_t from = std::max(row.first, other.first);
    const Index width = start_[j] - start_[from];
    if (width > 0)
      part.noalias() -=
          row.l.middleCols(offset(i, from), width) * other.l.middleCols(offset(j, from), width).transpose();
    other.l.rightCols(m).triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(part);
  }
  auto own = row.l.rightCols(n);
  const Index width = start_[i] - start_[row.first];
  if (width > 0) own.selfadjointView<Eigen::Lower>().rankUpdate(row.l.leftCols(width), -1.0);
  Matrix diagonal = own;
  const Eigen::LLT<Eigen::Ref<Matrix>> factored(diagonal);
  if (factored.info() != Eigen::Success) not_definite(row.members.front().s_mm);
  own = diagonal.triangularView<Eigen::Lower>();
}

// Rows with an entry in a column of the given ones.
std::vector<char> ProfileSystem::coupled_with(const std::vector<char>& rows) const {
  std::vector<char> out = rows;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    for (std::size_t j = rows_[i].first; j < i; ++j) {
      if (rows[j] != 0) out[i] = 1;
      if (rows[i] != 0) out[j] = 1;
    }
  }
  return out;
}

// right - A x of the given rows.
void ProfileSystem::measure(const std::vector<char>& rows) {
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (rows[i] != 0) rows_[i].rest = rows_[i].right;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Row& row = rows_[i];
    for (std::size_t j = row.first; j <= i; ++j) {
      const auto part = row.a.middleCols(offset(i, j), rows_[j].a.rows());
      if (rows[i] != 0) row.rest.noalias() -= part * rows_[j].x;
      if (j < i && rows[j] != 0) rows_[j].rest.noalias() -= part.transpose() * row.x;
    }
  }
}

// x += (L L^T)^-1 rest, where it is not negligible; tells the rows where x changed.
std::vector<char> ProfileSystem::correct() {
  std::vector<Matrix> step;
  double most = 0.0;
  for (const Row& row : rows_) {
    step.push_back(row.rest);
    if (row.rest.size() > 0) most = std::max(most, row.rest.cwiseAbs().maxCoeff());
  }
  std::vector<char> there(rows_.size(), 0);
  const auto is_there = [&](const Matrix& part) {
    return part.size() > 0 && !(part.cwiseAbs().maxCoeff() <= negligible * most);
  };
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    for (std::size_t j = row.first; j < i; ++j)
      if (there[j] != 0) step[i].noalias() -= row.l.middleCols(offset(i, j), rows_[j].l.rows()) * step[j];
    if (!is_there(step[i])) continue;
    row.l.rightCols(row.l.rows()).triangularView<Eigen::Lower>().solveInPlace(step[i]);
    there[i] = 1;
  }
  std::vector<char> moved(rows_.size(), 0);
  for (std::size_t i = rows_.size(); i-- > 0;) {
    Row& row = rows_[i];
    if (!is_there(step[i])) continue;
    moved[i] = 1;
    row.l.rightCols(row.l.rows()).triangularView<Eigen::Lower>().transpose().solveInPlace(step[i]);
    row.x += step[i];
    for (std::size_t j = row.first; j < i; ++j)
      step[j].noalias() -= row.l.middleCols(offset(i, j), rows_[j].l.rows()).transpose() * step[i];
  }
  return moved;
}

void ProfileSystem::refine(std::vector<char> stale) {
  double former = std::numeric_limits<double>::infinity();
  for (int round = 0;; ++round) {
    measure(stale);
    residual_ = 0.0;
    for (const Row& row : rows_)
      if (row.rest.size() > 0)
        residual_ = std::max(residual_, row.rest.allFinite() ? row.rest.cwiseAbs().maxCoeff() : 1e300);
    if (residual_ <= enough_profile_mm || round == profile_refinements || !(residual_ < 0.5 * former)) break;
    former = residual_;
    stale = coupled_with(correct());
  }
  if (!(residual_ <= profile_tolerance_mm))
    throw NumericalError("the wall misses its samples by " + std::to_string(residual_) +
                         " mm: samples contradict each other or lie too near; remove some");
  set_weights();
}

// The linear polynomial by the Schur complement P^T A^-1 P.
void ProfileSystem::set_weights() {
  if (options_.far_field == FarField::constant) {
    for (Row& row : rows_) row.weights = row.x.col(0);
    return;
  }
  Eigen::Matrix4d schur = Eigen::Matrix4d::Zero();
  Eigen::Vector4d side = Eigen::Vector4d::Zero();
  for (const Row& row : rows_) {
    schur += row.right.rightCols(4).transpose() * row.x.rightCols(4);
    side += row.right.rightCols(4).transpose() * row.x.col(0);
  }
  const Eigen::LLT<Eigen::Matrix4d> factored(schur);
  if (factored.info() != Eigen::Success)
    throw NumericalError(
        "the linear far field of a wall is not determined: its samples lie in a plane; choose "
        "the constant far field");
  q_ = factored.solve(side);
  for (Row& row : rows_) row.weights = row.x.col(0) - row.x.rightCols(4) * q_;
}

bool ProfileSystem::overgrown() const {
  return std::any_of(rows_.begin(), rows_.end(),
                     [&](const Row& row) { return row.members.size() > 3 * first_largest_; });
}

// Tells the blocks whose constraints changed.
std::vector<char> ProfileSystem::apply(const ConstraintSet::Difference& difference, Journal& journal,
                                       Change& report) {
  std::map<std::size_t, std::pair<std::vector<Constraint>, std::vector<Constraint>>> by_block;
  for (const Constraint& c : difference.removed) by_block[block_of(c.s_mm)].first.push_back(c);
  for (const Constraint& c : difference.added) by_block[block_of(c.s_mm)].second.push_back(c);
  std::vector<char> changed(rows_.size(), 0);
  for (const auto& [k, lists] : by_block) {
    changed[k] = 1;
    journal.rows.emplace(k, rows_[k]);
    std::vector<Constraint> kept, members;
    std::set_difference(rows_[k].members.begin(), rows_[k].members.end(), lists.first.begin(),
                        lists.first.end(), std::back_inserter(kept), constraint_order);
    std::merge(kept.begin(), kept.end(), lists.second.begin(), lists.second.end(),
               std::back_inserter(members), constraint_order);
    set_members(rows_[k], std::move(members));
  }
  // A former reach stays, so that it is found without a look at all pairs.
  std::vector<std::size_t> first(rows_.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    first[i] = rows_[i].first;
    for (std::size_t j = 0; j < first[i]; ++j) {
      if (!(changed[i] || changed[j]) || !coupled(rows_[i], rows_[j])) continue;
      first[i] = j;
      break;
    }
  }
  number_rows();
  std::vector<char> other(rows_.size(), 0);  // L is not what it was
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    bool again = first[i] != rows_[i].first, depends = false;
    for (std::size_t j = first[i]; j <= i; ++j) {
      again = again || changed[j];
      depends = depends || other[j];
    }
    if (!again && !depends) continue;
    const auto saved = journal.rows.emplace(i, rows_[i]).first;
    rows_[i].first = first[i];
    if (again) assemble(i);
    factor_row(i);
    report.rows_formed += static_cast<int>(rows_[i].members.size());
    const Matrix& before = saved->second.l;
    const bool same =
        !again && (rows_[i].l.size() == 0 || (rows_[i].l - before).cwiseAbs().maxCoeff() <= same_factor);
    if (same) rows_[i].l = before;
    other[i] = same ? 0 : 1;
  }
  return changed;
}

ProfileSystem::Change ProfileSystem::change(const ConstraintSet::Difference& difference) {
  Change report;
  Journal journal;
  journal.q = q_;
  journal.residual = residual_;
  for (const Row& row : rows_) journal.solutions.emplace_back(row.x, row.weights);
  try {
    refine(coupled_with(apply(difference, journal, report)));
  } catch (...) {
    for (auto& [k, row] : journal.rows) rows_[k] = std::move(row);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      rows_[k].x = std::move(journal.solutions[k].first);
      rows_[k].weights = std::move(journal.solutions[k].second);
    }
    q_ = journal.q;
    residual_ = journal.residual;
    number_rows();
    measure(std::vector<char>(rows_.size(), 1));
    throw;
  }
  report.residual = residual_;
  report.extent = extent_since(journal);
  return report;
}

ImplicitCoefficients ProfileSystem::coefficients() const {
  ImplicitCoefficients out;
  out.kernel = options_.kernel;
  out.support_radius_mm = options_.support_radius_mm;
  for (const Row& row : rows_) {
    for (const Constraint& c : row.members) out.centres.push_back(c.place);
    out.weights.insert(out.weights.end(), row.weights.begin(), row.weights.end());
  }
  const Vec3 slope = q_.tail<3>() / profile_unit_mm;
  if (options_.far_field == FarField::linear)
    out.polynomial = {q_[0] - slope.dot(centre_), slope.x(), slope.y(), slope.z()};
  else
    out.polynomial = {options_.offset_mm, 0.0, 0.0, 0.0};
  return out;
}

// Weights of the same centre before and now; centres that came or went.
std::vector<WeightChange> ProfileSystem::weight_changes(const Journal& journal) const {
  std::vector<WeightChange> changes;
  const auto note = [&](const Constraint& c, double by) {
    if (by != 0.0) changes.push_back({c.place, by, c.s_mm});
  };
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const Row& row = rows_[k];
    const auto saved = journal.rows.find(k);
    const std::vector<Constraint>& old = saved != journal.rows.end() ? saved->second.members : row.members;
    const Eigen::VectorXd& weights = journal.solutions[k].second;
    std::size_t i = 0, j = 0;
    while (i < old.size() || j < row.members.size()) {
      const double before = i < old.size() ? weights[static_cast<Index>(i)] : 0.0;
      const double now = j < row.members.size() ? row.weights[static_cast<Index>(j)] : 0.0;
      if (j == row.members.size() || (i < old.size() && constraint_order(old[i], row.members[j]))) {
        note(old[i++], -before);
      } else if (i == old.size() || constraint_order(row.members[j], old[i])) {
        note(row.members[j++], now);
      } else {
        if (old[i].place == row.members[j].place) {
          note(old[i], now - before);
        } else {
          note(old[i], -before);
          note(row.members[j], now);
        }
        ++i, ++j;
      }
    }
  }
  return changes;
}

ChangeExtent ProfileSystem::extent_since(const Journal& journal) const {
  std::vector<WeightChange> changes = weight_changes(journal);
  geometry::Box3 all;
  for (const Row& row : rows_) all.extend(row.box);
  const Vec3 half = 0.5 * all.sizes() + Vec3::Constant(options_.support_radius_mm);
  const Eigen::Vector4d moved = q_ - journal.q;
  if (std::abs(moved[0]) +
          moved.tail<3>().cwiseAbs().dot(half + (all.center() - centre_).cwiseAbs()) / profile_unit_mm <=
      0.1 * profile_told_mm)
    return extent_of(changes, options_.kernel, options_.support_radius_mm);
  // The polynomial has changed, and f with it wherever there is anything.
  ChangeExtent extent;
  extent.box = geometry::Box3(all.center() - half, all.center() + half);
  for (const WeightChange& change : changes) {
    const Vec3 reach = Vec3::Constant(options_.support_radius_mm);
    extent.box.extend(Vec3(change.place - reach));
    extent.box.extend(Vec3(change.place + reach));
  }
  extent.from_mm = rows_.front().members.empty() ? cuts_.front() : rows_.front().members.front().s_mm;
  extent.to_mm = rows_.back().members.empty() ? cuts_.back() : rows_.back().members.back().s_mm;
  return extent;
}

}  // namespace ostia::lumen
