#include "ostia/experiments/reading.h"

#include "reading/reading_hand.h"
#include "reading/reading_sight.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <variant>

namespace ostia::experiments {
namespace {

constexpr int most_tries = 3;          // of one fault of the tree
constexpr double wrong_way_mm = 2.0;   // of a new vessel beside every artery: it is taken back
constexpr double beyond_end_mm = 2.0;  // of what counts: there a vessel's end is clicked
constexpr double off_the_end_mm = 0.5;
constexpr int most_pulls = 12;  // at one vessel's axis
constexpr int pulls_at_place = 2;
constexpr double place_mm = 2.0;  // pulls nearer to each other are at the same place
constexpr double least_reach_mm = 5.0, most_reach_mm = 50.0;
constexpr std::size_t least_view_rows = 5;

double astray_of(const ReadingSight& sight) {
  double sum = 0.0;
  for (const SeenVessel& seen : sight.vessels) sum += seen.astray_mm;
  return sum;
}

/// Of a stroke's middle on the true vessel.
double place_of(const ReaderStroke& stroke, const phantom::CoronaryVessel& vessel) {
  const auto middle = [](const std::vector<Vec3>& points) { return points[points.size() / 2]; };
  const Vec3 place = stroke.on_section ? middle(std::get<lumen::SectionContour>(stroke.edit).points)
                                       : middle(std::get<lumen::CprStroke>(stroke.edit).points);
  return geometry::closest(vessel.axis.points, place).abscissa;
}

/// One tree being read.
class TreeReader {
 public:
  TreeReader(const phantom::CoronaryTree& truth, const imaging::ImageVolume& image,
             const std::shared_ptr<const lumen::LumenModel>& start, const ReadingOptions& options,
             const core::TaskContext& task)
      : options_(options),
        task_(task),
        overlay_(truth, options_),
        hand_(image, start, options_, run_.actions) {}

  ReadingRun read() {
    run_.vessels = overlay_.vessels().size();
    run_.before = state_of(overlay_, hand_.live(), options_);
    task_.set_progress(0.1);
    mend_tree();
    task_.set_progress(0.3);
    const auto count = static_cast<double>(overlay_.vessels().size());
    for (std::size_t v = 0; v < overlay_.vessels().size() && hand_.model(); ++v) {
      mend_axis(v);
      mend_walls(v);
      task_.set_progress(0.3 + 0.6 * static_cast<double>(v + 1) / count);
    }
    run_.gave_up = hand_.tired();
    run_.after = state_of(overlay_, hand_.live(), options_);
    if (hand_.model()) run_.digest = lumen::digest(*hand_.model());
    return std::move(run_);
  }

 private:
  const std::string& name_of_counted(std::size_t v) const { return overlay_.vessels()[v].vessel->name; }
  ReadingSight look() const { return look_at(overlay_, hand_.model(), options_); }

  // What vessels there are, how far they go, and what they are called.

  void mend_tree() {
    std::map<std::string, int> tries;
    while (!hand_.tired()) {
      task_.throw_if_cancelled();
      const ReadingSight sight = look();
      const std::vector<ReadingIssue> issues = issues_of(overlay_, sight, hand_.model());
      const auto next = std::find_if(issues.begin(), issues.end(), [&](const ReadingIssue& issue) {
        return tries[issue.key()] < most_tries;
      });
      if (next == issues.end()) {
        for (const ReadingIssue& issue : issues) run_.left.push_back(left_text(issue));
        return;
      }
      mend(*next, sight, tries[next->key()]++);
    }
  }

  static std::string left_text(const ReadingIssue& issue) {
    switch (issue.kind) {
      case ReadingIssueKind::removal:
        return issue.name + " follows no artery, or another vessel's";
      case ReadingIssueKind::trim:
        return issue.name + " runs on beside every artery";
      case ReadingIssueKind::missing:
        return issue.name + " is missing";
      case ReadingIssueKind::short_end:
        return issue.name + " ends at " + core::rounded_text(issue.s_mm, 1) + " mm";
      case ReadingIssueKind::name:
        break;
    }
    return "the name " + issue.name + " is not given";
  }

  void mend(const ReadingIssue& issue, const ReadingSight& sight, int before) {
    switch (issue.kind) {
      case ReadingIssueKind::removal:
        hand_.remove(issue.model_vessel);
        return;
      case ReadingIssueKind::trim:
        hand_.cut_off(issue.model_vessel, issue.s_mm);
        return;
      case ReadingIssueKind::name:
        hand_.rename(issue.model_vessel, issue.name);
        return;
      case ReadingIssueKind::missing:
      case ReadingIssueKind::short_end:
        break;
    }
    add(*issue.counted, issue.kind == ReadingIssueKind::missing ? 0.0 : issue.s_mm, sight, before);
  }

  /// By its distal end; after a failure by a place that is nearer.
  void add(std::size_t v, double there_mm, const ReadingSight& sight, int before) {
    const CountedVessel& counted = overlay_.vessels()[v];
    const phantom::CoronaryVessel& vessel = *counted.vessel;
    const double farthest =
        std::min(vessel.axis.abscissa.back() - off_the_end_mm, counted.to_mm + beyond_end_mm);
    const double from_mm = std::max(there_mm, counted.from_mm);
    const double share = 1.0 - static_cast<double>(before) / most_tries;
    const auto clicked = [&](double s_mm) {
      return hand_.click(axis_place(vessel, s_mm), options_.click_sigma_mm);
    };
    const Vec3 end = clicked(from_mm + share * (farthest - from_mm));
    std::optional<Vec3> from;
    if (!hand_.model() || (vessel.parent < 0 && !sight.rows[v].front().axis))
      from = clicked(std::min(1.0, 0.5 * counted.from_mm));
    const double astray = astray_of(sight);
    if (!hand_.find(vessel.name, from, end, task_.sub(0.0, 0.0))) return;
    if (astray_of(look()) > astray + wrong_way_mm) hand_.undo();
  }

  // Axes.

  void mend_axis(std::size_t v) {
    const CountedVessel& counted = overlay_.vessels()[v];
    std::map<int, int> pulled;
    const auto place = [&](std::size_t row) { return static_cast<int>(counted.rows[row].s_mm / place_mm); };
    for (int pulls = 0; pulls < most_pulls && !hand_.tired(); ++pulls) {
      task_.throw_if_cancelled();
      const ReadingSight sight = look();
      const std::vector<SeenRow>& rows = sight.rows[v];
      std::optional<std::size_t> worst;
      for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].axis && rows[i].off_mm > options_.tolerance_mm && pulled[place(i)] < pulls_at_place &&
            (!worst || rows[i].off_mm > rows[*worst].off_mm))
          worst = i;
      if (!worst) return;
      ++pulled[place(*worst)];
      pull(counted, sight, rows, *worst);
    }
  }

  /// The rows about a place whose axis is off, the place among them.
  std::pair<std::size_t, std::size_t> stretch_off(const std::vector<SeenRow>& rows, std::size_t at,
                                                  double more_than_mm) const {
    std::size_t first = at, last = at;
    const auto off = [&](std::size_t i) {
      return rows[i].axis == rows[at].axis && rows[i].off_mm > more_than_mm;
    };
    while (first > 0 && off(first - 1)) --first;
    while (last + 1 < rows.size() && off(last + 1)) ++last;
    return {first, last};
  }

  /// In the middle of what is about as bad as the worst: with the wall, where that is off the same way; else
  /// beside it.
  void pull(const CountedVessel& counted, const ReadingSight& sight, const std::vector<SeenRow>& rows,
            std::size_t worst) {
    constexpr double as_bad = 0.8;
    const auto [from, to] =
        stretch_off(rows, worst, std::max(options_.tolerance_mm, as_bad * rows[worst].off_mm));
    const std::size_t at = (from + to) / 2;
    const CountedRow& row = counted.rows[at];
    const OwnAxis& own = sight.own[*rows[at].axis];
    const Vec3 foot = geometry::closest(own.points, row.middle).point;
    const Vec3 middle = hand_.click(row.middle, options_.strokes.pointing_sigma_mm);
    const Vec3 wall = wall_shift(row, *hand_.live()->surface(own.vessel));
    if ((wall + row.middle - foot).norm() >= wall.norm()) {
      hand_.put_on_axis(own.vessel, middle);
      return;
    }
    // The pull fades out along the reach: half of it is left at about half the reach.
    const auto [first, last] = stretch_off(rows, at, options_.tolerance_mm);
    const double reach = static_cast<double>(last - first + 1) * reading_row_mm;
    hand_.pull_axis(own.vessel, foot, middle, std::clamp(reach, least_reach_mm, most_reach_mm));
  }

  // Walls.

  void mend_walls(std::size_t v) {
    const ReadingSight sight = look();
    const std::vector<SeenRow>& rows = sight.rows[v];
    const auto most_rows = static_cast<std::size_t>(options_.view_mm / reading_row_mm);
    for (std::size_t first = 0; first < rows.size();) {
      std::size_t end = first + 1;
      while (end < rows.size() && rows[end].axis == rows[first].axis) ++end;
      if (rows[first].axis && end - first >= least_view_rows) {
        const std::int32_t id = sight.own[*rows[first].axis].vessel;
        const std::size_t views = (end - first + most_rows - 1) / most_rows;
        for (std::size_t k = 0; k < views; ++k)
          mend_view(v, id, first + k * (end - first - 1) / views,
                    first + (k + 1) * (end - first - 1) / views);
      }
      first = end;
    }
  }

  void mend_view(std::size_t v, std::int32_t id, std::size_t first, std::size_t last) {
    const CountedVessel& counted = overlay_.vessels()[v];
    const geometry::ContourSection section = ReadingOverlay::section(counted, first, last);
    const auto left = [&](const std::string& why) { run_.left.push_back(section.section + ": " + why); };
    const auto axis = lumen::vessel(*hand_.model(), id).axis;
    ReaderOptions how = options_.strokes;
    how.seed = options_.seed + 1000 * static_cast<std::uint64_t>(v) + first;
    run_.looking_s += static_cast<double>(how.lines_deg.size()) * how.seconds_a_view;
    try {
      how.visible_px = options_.tolerance_mm / SimulatedReader(section, axis, id, how).pixel_mm();
      SimulatedReader reader(section, axis, id, how,
                             [&](const Vec3& place) { return overlay_.hidden(counted.vessel->id, place); });
      while (!hand_.tired()) {
        task_.throw_if_cancelled();
        const auto stroke = reader.next(*hand_.live()->surface(id));
        if (!stroke) break;
        if (!hand_.draw(id, *stroke, place_of(*stroke, *counted.vessel))) reader.refused();
      }
      if (reader.why_stopped() != "no visible disagreement" && !hand_.tired()) left(reader.why_stopped());
    } catch (const InvalidInput& error) {
      left(error.what());
    }
  }

  const ReadingOptions options_;
  const core::TaskContext& task_;
  ReadingRun run_;
  ReadingOverlay overlay_;
  ReadingHand hand_;
};

}  // namespace

const char* word(ReadingAct act) {
  switch (act) {
    case ReadingAct::search:
      return "search";
    case ReadingAct::removal:
      return "removal";
    case ReadingAct::addition:
      return "addition";
    case ReadingAct::naming:
      return "naming";
    case ReadingAct::ending:
      return "ending";
    case ReadingAct::axis:
      return "axis";
    case ReadingAct::stroke:
      return "stroke";
    case ReadingAct::undo:
      break;
  }
  return "undo";
}

void validate(const ReadingOptions& options) {
  const auto within = [](double value, double low, double high, const char* what) {
    if (!(value >= low && value <= high))
      throw InvalidInput(std::string("reading: ") + what + " of " + core::trimmed_text(low, 1) + " to " +
                         core::trimmed_text(high, 1) + ", not " + core::trimmed_text(value, 3));
  };
  within(options.tolerance_mm, 0.1, 2.0, "a tolerance");
  within(options.least_diameter_mm, 0.5, 4.0, "a least diameter");
  within(options.astray_mm, 0.01, 20.0, "an axis astray outside");
  within(options.click_sigma_mm, 0.0, 2.0, "an error of clicks");
  within(options.view_mm, 10.0, 200.0, "a view's length");
  within(options.most_actions, 1.0, 10000.0, "the most actions");
  const HandTimes& t = options.times;
  for (const double seconds : {t.think_s, t.home_s, t.key_s, t.point_s, t.press_s})
    within(seconds, 0.0, 60.0, "a time of the hand's");
  validate(options.strokes);
}

std::size_t ReadingRun::count(ReadingAct act) const {
  return static_cast<std::size_t>(std::count_if(actions.begin(), actions.end(),
                                                [act](const ReadingAction& one) { return one.act == act; }));
}

std::size_t ReadingRun::refused() const {
  return static_cast<std::size_t>(std::count_if(
      actions.begin(), actions.end(), [](const ReadingAction& one) { return !one.refusal.empty(); }));
}

int ReadingRun::clicks() const {
  int sum = 0;
  for (const ReadingAction& one : actions) sum += one.clicks;
  return sum;
}

double ReadingRun::seconds() const {
  double sum = looking_s;
  for (const ReadingAction& one : actions) sum += one.seconds;
  return sum;
}

ReadingRun read_tree(const phantom::CoronaryTree& truth, const imaging::ImageVolume& image,
                     const std::shared_ptr<const lumen::LumenModel>& start, const ReadingOptions& options,
                     const core::TaskContext& task) {
  validate(options);
  ReadingRun run = TreeReader(truth, image, start, options, task).read();
  run.automatic = start != nullptr;
  task.set_progress(1.0);
  return run;
}

}  // namespace ostia::experiments
