#include <algorithm>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "keyline/core/text.h"
#include "keyline/operations/at_once.h"
#include "keyline/operations/fair.h"

#include "copies.h"
#include "session.h"
#include "terminal.h"

namespace keyline::app {
namespace {

using core::Result;
using nlohmann::json;
using presentation::Shown;

Session new_session() {
  return Session(
      {"fair", "FILE... ", "The main job: points or a curve in, a faired key-line out.",
       "Example: keyline fair examples/bonnet-scan.csv -o faired.svg -o report.html\n"
       "Formats: svg, json (the exact chain), csv (samples), html (report), pdf, png, dxf and what "
       "convert writes.",
       operations::further_options(*operations::find_operation("fair"))},
      {group_of(*operations::find_operation("fair"), "Fairing"), reading_group(), door_group()});
}

const operations::FairAnswer& answer_of(const Shown& faired) {
  return *faired.outcome.result_as<operations::FairAnswer>();
}

std::string table_of(const Shown& faired) {
  std::string text = faired.name.empty() ? "" : faired.name + "\n";
  text += fmt::format("{:>5} {:>9} {:>11} {:>11} {:>11} {:>11}  {}\n", "piece", "rhythm", "slope",
                      "length", "volume", "deviation", "impression");
  int i = 0;
  for (const operations::FairedPiece& shown : answer_of(faired).pieces) {
    const auto& p = shown.piece;
    text += fmt::format("{:>5} {:>9} {:>11} {:>11.5g} {:>11.4g} {:>11.3g}  {}\n", i++,
                        core::word_of(p.rhythm),
                        p.slopes.empty() ? "" : fmt::format("{:.4g}", p.slopes[0]), p.length,
                        p.volume, p.deviation, shown.impression);
  }
  return text;
}

const char* verdict_of(bool near, bool fair) {
  if (near) return fair ? " - near enough and fair" : " - near enough, but not fair";
  return fair ? " - fair, but not near enough" : " - neither near enough nor fair";
}

std::string comb_of(const operations::FairAnswer& a) {
  const fairing::FairFigures& f = a.fairness;
  const analysis::CombFigures& other = f.rival();
  const char* whose = f.smoothing_spline ? "the smoothest spline as near" : "the points' spline";
  return fmt::format("comb: {}, variation {:.3g}, jolt {:.2g}; {}: {}, {:.3g}, {:.2g}{}",
                     core::counted(static_cast<std::size_t>(f.answer.waves), "wave"),
                     f.answer.energy, f.answer.jolt, whose,
                     core::counted(static_cast<std::size_t>(other.waves), "wave"), other.energy,
                     other.jolt, verdict_of(a.within_tolerance, f.fair));
}

void tell(const Session& session, const Shown& faired) {
  const auto& a = answer_of(faired);
  const bool quiet = session.door().quiet;
  const std::string name = faired.name.empty() ? "" : faired.name + ": ";
  for (const std::string& note : a.report) say(quiet, name + note);
  say(quiet, fmt::format("{}{}, {} in {}; largest deviation {:.4g}, rms "
                         "{:.4g}, tolerance {:.4g}, noise {:.3g}",
                         name, core::counted(a.line.points.size(), "point"),
                         core::counted(a.pieces.size(), "piece"),
                         core::counted(a.faired.curves.size(), "chain"), a.deviation.max,
                         a.deviation.rms, a.tolerance, a.noise));
  say(quiet, name + comb_of(a));
}

std::string name_of(const Shown& faired) {
  return faired.name.empty() ? "" : " (" + faired.name + ")";
}

/// One line for all that miss their tolerance: of the one that misses by most tolerances.
int report_missed(const std::vector<const Shown*>& missed, const std::string& file) {
  const auto excess = [](const Shown* f) {
    return answer_of(*f).deviation.max / answer_of(*f).tolerance;
  };
  const Shown& worst = **std::ranges::max_element(missed, {}, excess);
  const auto& a = answer_of(worst);
  const core::Point2 p = a.line.points[a.deviation.worst_point];
  const std::size_t others = missed.size() - 1;
  const std::string more =
      others == 0 ? "" : fmt::format("; {} more key-line{} too", others, others == 1 ? "" : "s");
  return report_failure(
      {core::ErrorCode::not_converged,
       fmt::format("no chain found{} within {:.4g}: the best misses point {} at ({:.6g}, {:.6g}) "
                   "by {:.4g}{}",
                   name_of(worst), a.tolerance, a.deviation.worst_point, p.x, p.y, a.deviation.max,
                   more),
       "give a larger --tolerance, or look for strays there", ""},
      file);
}

/// What was faired, in the order of the things it was made of.
struct Faired {
  std::vector<Shown> all;
  std::vector<json> things;
  std::size_t wanted = 0;

  /// Those that were not cut short.
  std::size_t done() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(all, [](const Shown& f) { return !answer_of(f).cancelled; }));
  }
};

/// Where the tolerance is missed, or that the work was cut short: after everything is written.
int verdict_of(const Faired& faired, const std::string& file) {
  std::vector<const Shown*> missed;
  for (const Shown& one : faired.all) {
    if (answer_of(one).cancelled) {
      const core::Failure failure{core::ErrorCode::cancelled, "cancelled" + name_of(one),
                                  "the best found was kept", ""};
      return report_failure(told_how_far(failure, faired.done(), faired.wanted));
    }
    if (!answer_of(one).within_tolerance) missed.push_back(&one);
  }
  if (!missed.empty()) return report_missed(missed, file);
  const auto most = std::ranges::max_element(
      faired.all, {}, [](const Shown& one) { return answer_of(one).outside; });
  if (most == faired.all.end() || answer_of(*most).outside == 0) return kDone;
  return report_failure({core::ErrorCode::not_converged,
                         fmt::format("no chain found{} that keeps its bounds: the best passes one "
                                     "by {:.3g}",
                                     name_of(*most), answer_of(*most).outside),
                         "give a larger --tolerance, or a wider --keep-inside", ""},
                        file);
}

using Answers = std::vector<std::optional<Result<operations::Outcome>>>;

/// A failure of the curve that was read: told by the file and, of many, by the curve's name instead
/// of the option that a request gives it with.
core::Failure of_file(core::Failure failure, const std::string& file, const json& thing,
                      bool many) {
  const bool of_curve = failure.path.empty() || failure.path.starts_with("points") ||
                        failure.path.starts_with("curve");
  if (!of_curve) return failure;
  failure.path = many ? file + ": " + thing["name"].get<std::string>() : file;
  return failure;
}

/// Those that there are. What failed decides for all, the first of them first; work that was
/// cancelled has come to something where one of those at work had a best until then.
Result<Faired> kept(Answers answers, const std::vector<json>& things, const std::string& file) {
  Faired faired{{}, {}, things.size()};
  core::Failure cancelled{core::ErrorCode::cancelled, "cancelled", "", ""};
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (!answers[i]) continue;
    if (*answers[i]) {
      const std::string name = things[i]["name"].get<std::string>();
      faired.all.push_back({called(name, "curve", i, things.size()), std::move(**answers[i])});
      faired.things.push_back(things[i]);
      continue;
    }
    if (answers[i]->error().code != core::ErrorCode::cancelled)
      return std::unexpected(of_file(answers[i]->error(), file, things[i], things.size() > 1));
    cancelled = answers[i]->error();
  }
  const std::size_t done = faired.done();
  if (done < things.size() && done == faired.all.size())
    return std::unexpected(told_how_far(cancelled, done, things.size()));
  return faired;
}

/// The requests for all key-lines.
std::vector<json> requests_of(Session& session, const std::vector<json>& things) {
  std::vector<json> requests(things.size(), session.of(0));
  for (std::size_t i = 0; i < things.size(); ++i) {
    requests[i].update(subject_of(things[i]));
    if (!requests[i].contains("keep_inside") && things[i].contains("keep_inside"))
      requests[i]["keep_inside"] = things[i]["keep_inside"];
  }
  return requests;
}

/// The answer to a curve as that of another which is the same, and says so.
Result<operations::Outcome> as_copy(Result<operations::Outcome> answer, const std::string& of) {
  if (!answer) return answer;
  auto told =
      std::make_shared<operations::FairAnswer>(*answer->result_as<operations::FairAnswer>());
  told->report.push_back("in its plane the same curve as " + of + ": its answer");
  answer->result = std::move(told);
  return answer;
}

/// All key-lines of the input; the best until then where the work is cancelled. Those that are the
/// same to rounding (the two sides of a plate) are solved for once.
Result<Faired> fair_all(Session& session, const std::vector<json>& things) {
  Answers answers(things.size());
  const std::vector<json> requests = requests_of(session, things);
  const std::vector<std::size_t> original = originals(requests);
  std::vector<std::size_t> own;
  for (std::size_t i = 0; i < things.size(); ++i)
    if (original[i] == i) own.push_back(i);
  const auto fair_one = [&](std::size_t k, const core::Progress& progress) {
    auto& answer = answers[own[k]];
    answer = session.perform("fair", requests[own[k]], progress);
    return answer->has_value();
  };
  operations::work_on_all(session.progress(), own.size(), session.door().threads, fair_one);
  end_progress();
  for (std::size_t i = 0; i < things.size(); ++i) {
    const std::size_t k = original[i];
    if (k == i || !answers[k]) continue;
    const std::string name = things[k]["name"].get<std::string>();
    answers[i] = as_copy(*answers[k], called(name, "curve", k, things.size()));
  }
  return kept(std::move(answers), things, session.files().front());
}

/// A request of document.write, within a tenth of the tolerance: what is written is faired too.
/// It lies over what was read: with its page, layers and colours.
json document_of(const Faired& faired, const std::vector<json>& shown, const ReadFiles& read) {
  json document{{"unit", read.shown["unit"]}, {"curves", json::array()}};
  double tolerance = answer_of(faired.all.front()).tolerance;
  for (std::size_t i = 0; i < faired.all.size(); ++i) {
    const Shown& one = faired.all[i];
    json curve{{"name", faired.things[i]["name"]}, {"curve", shown[i]["curve"]}};
    take_look(curve, faired.things[i]);
    if (faired.things[i].contains("plane")) curve["plane"] = faired.things[i]["plane"];
    document["curves"].push_back(std::move(curve));
    tolerance = std::min(tolerance, answer_of(one).tolerance);
  }
  document["tolerance"] = 0.1 * tolerance;
  if (read.shown.contains("page")) {
    document["page"] = read.shown["page"];
    document["on_page"] = read.answer().document.paths.empty();  // a picture's, in pixels
  }
  return document;
}

/// What was read, shown and written; then the verdict.
int finish(Session& session, const ReadFiles& read, const Faired& faired) {
  std::vector<json> shown;
  std::string text;
  for (const Shown& one : faired.all) {
    auto made = shown_of(one.outcome);
    if (!made) return report_failure(made.error());
    shown.push_back(std::move(*made));
    text += table_of(one);
  }
  presentation::ReportOptions options = session.report_options();
  options.unit = read.shown["unit"].get<std::string>();
  const bool cut_short = faired.done() < faired.wanted;
  auto written =
      session.write(presentation::fair_pages(faired.all, options), document_of(faired, shown, read),
                    cut_short ? Session::Ending::kept : Session::Ending::cancellable);
  if (!written) return report_failure(written.error());
  if (faired.all.size() > 1)
    for (std::size_t i = 0; i < shown.size(); ++i) shown[i]["id"] = faired.all[i].name;
  session.print(one_or_all(shown, "curves"), text);
  for (const Shown& one : faired.all) tell(session, one);
  return verdict_of(faired, session.files().front());
}

}  // namespace

int run_fair(const Words& words) {
  Session session = new_session();
  if (const auto status = session.begin(words)) return *status;
  if (auto done = session.check_outputs(); !done) return report_failure(done.error());
  const auto read = read_files(session, session.of(1), true);
  if (!read) return report_failure(read.error());
  const auto things = planar_things(session, *read);
  if (!things) return report_failure(things.error(), session.files().front());
  // Measured points tell it among their notes.
  if (!things->front().contains("line")) session.note_read(read->answer());
  const auto faired = fair_all(session, *things);
  if (!faired) return report_failure(faired.error());
  return finish(session, *read, *faired);
}

Manual fair_manual() { return new_session().manual(); }

}  // namespace keyline::app
