#pragma once
/// \file Zeros of a function along an edge, asked for one place at a time so that many edges share a batch.

#include <algorithm>
#include <cmath>

namespace ostia::lumen {

/// The two ends of a stretch of an edge, t from 0 to 1 along it, with opposite signs.
struct Bracket {
  double t0 = 0.0, f0 = 0.0, t1 = 1.0, f1 = 0.0;
};

inline bool inside(double f) {
  return f < 0.0;
}

/// Inverse quadratic interpolation kept within a bracket, with bisection where that does not shrink it
/// (Brent 1973 in other words).
class RootFinder {
 public:
  static constexpr double enough = 1e-7;  // |f| that is zero

  explicit RootFinder(const Bracket& bracket)
      : a_(bracket.t0), fa_(bracket.f0), b_(bracket.t1), fb_(bracket.f1), width_(b_ - a_) {
    if (std::abs(fa_) <= enough)
      finish(a_, fa_);
    else if (std::abs(fb_) <= enough)
      finish(b_, fb_);
  }
  bool done() const { return done_; }
  double root() const { return t_; }
  double residual() const { return f_; }

  double next() {
    const double width = b_ - a_;
    double t = a_ - fa_ * (width / (fb_ - fa_));
    if (steps_ > 0 && fc_ != fa_ && fc_ != fb_) {
      const double q = a_ * fb_ * fc_ / ((fa_ - fb_) * (fa_ - fc_)) +
                       b_ * fa_ * fc_ / ((fb_ - fa_) * (fb_ - fc_)) +
                       c_ * fa_ * fb_ / ((fc_ - fa_) * (fc_ - fb_));
      if (q > a_ && q < b_) t = q;
    }
    if (steps_ > 0 && steps_ % 3 == 0) {
      if (width > 0.25 * width_) t = 0.5 * (a_ + b_);
      width_ = width;
    }
    const double margin = 1e-4 * width;
    asked_ = std::clamp(t, a_ + margin, b_ - margin);
    return asked_;
  }

  void take(double f) {
    ++steps_;
    if (std::abs(f) <= enough) return finish(asked_, f);
    if (inside(f) == inside(fa_)) {
      c_ = a_, fc_ = fa_;
      a_ = asked_, fa_ = f;
    } else {
      c_ = b_, fc_ = fb_;
      b_ = asked_, fb_ = f;
    }
    if (b_ - a_ > least_width && steps_ < most_steps) return;
    if (std::abs(fa_) < std::abs(fb_))
      finish(a_, fa_);
    else
      finish(b_, fb_);
  }

 private:
  static constexpr double least_width = 1e-13;
  static constexpr int most_steps = 120;
  void finish(double t, double f) {
    done_ = true;
    t_ = t;
    f_ = f;
  }
  double a_, fa_, b_, fb_, c_ = 0.0, fc_ = 0.0, width_, asked_ = 0.0, t_ = 0.0, f_ = 0.0;
  int steps_ = 0;
  bool done_ = false;
};

/// Looks for a pair of zeros between two ends of the same sign: a lumen, or a gap, thinner than the edge.
/// For what is about a distance (slope times length), the middle of such a pair is where the distances from
/// both ends leave it.
class DipProbe {
 public:
  DipProbe() = default;
  /// `rise`: how much f may change along the whole edge, its slope times its length.
  DipProbe(double f0, double f1, double rise) : a_{0.0, f0}, b_{1.0, f1}, rise_(rise) {
    done_ = !possible(a_, b_, 1.2);
  }
  bool done() const { return done_; }
  bool found() const { return found_; }
  Bracket first() const { return {0.0, begin_, asked_, f_}; }
  Bracket second() const { return {asked_, f_, 1.0, end_}; }

  double next() {
    if (steps_ == 0) begin_ = a_.f, end_ = b_.f;
    const double width = b_.t - a_.t;
    const double middle = 0.5 + 0.5 * (std::abs(a_.f) - std::abs(b_.f)) / (rise_ * width);
    asked_ = a_.t + width * std::clamp(middle, 0.1, 0.9);
    return asked_;
  }
  void take(double f) {
    ++steps_;
    f_ = f;
    if (inside(f) != inside(a_.f)) {
      done_ = found_ = true;
      return;
    }
    const double share = (asked_ - a_.t) / (b_.t - a_.t);
    const double straight = std::abs(a_.f) + share * (std::abs(b_.f) - std::abs(a_.f));
    const End middle{asked_, f};
    const bool left = possible(a_, middle, 1.0), right = possible(middle, b_, 1.0);
    if (std::abs(f) > 0.85 * straight || steps_ == most_steps || !(left || right)) {
      done_ = true;
    } else if (!right || (left && slack(a_, middle) > slack(middle, b_))) {
      b_ = middle;
    } else {
      a_ = middle;
    }
  }

 private:
  static constexpr int most_steps = 4;
  struct End {
    double t = 0.0, f = 0.0;
  };
  bool possible(const End& p, const End& q, double margin) const {
    return std::abs(p.f) + std::abs(q.f) < margin * rise_ * (q.t - p.t);
  }
  double slack(const End& p, const End& q) const {
    return rise_ * (q.t - p.t) - std::abs(p.f) - std::abs(q.f);
  }
  End a_, b_;
  double rise_ = 0.0, asked_ = 0.0, f_ = 0.0, begin_ = 0.0, end_ = 0.0;
  int steps_ = 0;
  bool done_ = true, found_ = false;
};

}  // namespace ostia::lumen
