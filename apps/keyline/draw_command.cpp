#include <algorithm>

#include <fmt/format.h>

#include "keyline/core/text.h"

#include "session.h"
#include "terminal.h"
#include "words.h"

namespace keyline::app {
namespace {

using core::ErrorCode;
using core::Result;
using nlohmann::json;
using operations::Operation;

/// What draw itself reads: the points, which stand for other fields with some operations.
struct DrawWords {
  std::vector<std::variant<core::Point2, core::Point3>> points;
  bool spline = false;
  bool space = false;
  static constexpr auto describe() {
    return core::fields(
        core::field<&DrawWords::points>(
            "handles P0 P1 P2 as x,y; two ends with --directions, or with --direction and "
            "--volume; any number with "
            "--spline; P0 T0 T2 P2, ends and points along their tangents, as x,y,z with --space")
            .needed(),
        core::field<&DrawWords::spline>("a G2 spline through all points"),
        core::field<&DrawWords::space>("a space curve"));
  }
};

/// An operation and the option that asks for it.
struct CurveKind {
  const char* operation;
  const char* sign;
};
constexpr CurveKind kKinds[] = {{"lac.spline", "--spline"}, {"lac.space", "--space"},
                                {"lac.volume", "--volume"}, {"lac.hermite", "--directions"},
                                {"lac.quasi", "--form"},    {"lac.compound", "--ratio"},
                                {"lac.segment", ""}};

bool is_given(const Words& words, const std::string& option) {
  return std::ranges::any_of(words, [&](const std::string& word) {
    return word == option || word.starts_with(option + "=");
  });
}

/// Two slopes ask for a compound rhythm too.
bool has_two_slopes(const Words& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i].starts_with("--alpha=")) return words[i].find(',') != std::string::npos;
    if (words[i] == "--alpha" && i + 1 < words.size())
      return words[i + 1].find(',') != std::string::npos;
  }
  return false;
}

const Operation& operation_for(const Words& words) {
  std::string name = kKinds[std::size(kKinds) - 1].operation;
  if (has_two_slopes(words)) name = "lac.compound";
  for (const CurveKind& kind : kKinds)
    if (*kind.sign != '\0' && is_given(words, kind.sign)) {
      name = kind.operation;
      break;
    }
  return *operations::find_operation(name);
}

constexpr std::size_t kOwn = 0;  // records of the command line
constexpr std::size_t kCurve = 1;
constexpr std::size_t kView = 2;

OptionGroup group_for(const Operation& operation) {
  OptionGroup group = group_of(operation, "For " + operation.name);
  for (const char* other : {"start", "end", "tangents"}) group.without.emplace_back(other);
  return group;
}

/// Options of the operation asked for; in the help those of all.
Session new_session(const Operation& asked, bool all) {
  std::vector<OptionGroup> groups{{"Drawing", &core::type_of<DrawWords>()},
                                  group_for(asked),
                                  {"Figures", &core::type_of<presentation::HandleView>()}};
  if (all)
    for (const CurveKind& kind : kKinds)
      if (asked.name != kind.operation)
        groups.push_back(group_for(*operations::find_operation(kind.operation)));
  groups.push_back(door_group());
  return Session(
      {"draw", "--points P0 P1 P2 ", "A log-aesthetic curve from handles or through points.",
       "Example: keyline draw --points 0,0 2,0 3,1.5 --alpha -1,1.5 --ratio 0.4 -o curve.svg\n"
       "Formats: svg, json (the exact curve), csv (samples), pdf, png, html (report), dxf and what "
       "convert writes.",
       operations::further_options(asked)},
      groups, false);
}

std::unexpected<core::Failure> wrong(const std::string& message, const std::string& hint) {
  return core::fail(ErrorCode::bad_input, message, hint, "--points");
}

Result<json> points_of(const json& given, bool space) {
  const std::size_t coordinates = space ? 3 : 2;
  const std::string form = space ? "give points as x,y,z" : "give points as x,y";
  for (const json& point : given) {
    if (!point.is_array()) return wrong("\"" + point.get<std::string>() + "\" is no point", form);
    if (point.size() != coordinates)
      return wrong(
          fmt::format("{} has {}", point.dump(), core::counted(point.size(), "coordinate")), form);
  }
  return given;
}

Result<void> want(const json& points, std::size_t count, const std::string& what) {
  if (points.size() == count) return {};
  return wrong(core::counted(points.size(), "point is given", "points are given"), "give " + what);
}

json less(const json& a, const json& b) {
  json difference = json::array();
  for (std::size_t i = 0; i < a.size(); ++i)
    difference.push_back(a[i].get<double>() - b[i].get<double>());
  return difference;
}

/// The points as the fields that the operation has for them.
Result<void> put_points(const Operation& operation, const json& points, json& request) {
  const bool space = operation.name == "lac.space";
  if (space || operation.name == "lac.hermite") {
    if (auto right = space ? want(points, 4, "P0 T0 T2 P2: ends and points along their tangents")
                           : want(points, 2, "the two ends");
        !right)
      return right;
    request["start"] = points.front();
    request["end"] = points.back();
    if (space) request["tangents"] = {less(points[1], points[0]), less(points[3], points[2])};
    return {};
  }
  if (operation.name == "lac.volume")
    if (auto right = want(points, 2, "P0 and P2"); !right) return right;
  if (operation.name != "lac.volume" && operation.name != "lac.spline")
    if (auto right = want(points, 3, "the handles P0 P1 P2, or --spline for a curve through all");
        !right)
      return right;
  request["points"] = points;
  return {};
}

/// Slopes and the like that were not given are what a fresh request holds.
void complete(const Operation& operation, json& request) {
  const auto fresh = operations::write_json(*operation.request, operation.request->make().get());
  for (const char* name : {"alpha", "beta", "omega"}) {
    if (!fresh || request.contains(name)) continue;
    const json value = fresh->value(name, json());
    if (value.is_number() || (value.is_array() && value.size() == 1)) request[name] = value;
  }
}

/// Numbers, words and ranges as a person writes them: a range tells the ends it has.
std::string in_words(const json& value) {
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return core::number_text(value.get<double>(), 6);
  if (value.is_string()) return value.get<std::string>();
  if (value.is_array() && value.size() == 2 && (value[0].is_null() || value[1].is_null()))
    return !value[0].is_null()   ? "from " + in_words(value[0])
           : !value[1].is_null() ? "up to " + in_words(value[1])
                                 : "any";
  if (!value.is_structured()) return value.dump();
  std::string all;
  for (const auto& [name, item] : value.items())
    all += (all.empty() ? "" : ", ") + (value.is_object() ? name + " " : "") + in_words(item);
  return value.is_object() ? all : "(" + all + ")";
}

/// One line per piece, and what the operation tells beside the curve.
std::string text_of(const json& result) {
  const json& curve = result["curve"];
  std::string text;
  if (curve.contains("pieces")) {
    text += fmt::format("{:>5} {:>8} {:>14} {:>14} {:>14}\n", "piece", "slope", "length",
                        "curvature from", "to");
    int index = 0;
    for (const json& piece : curve["pieces"]) {
      const bool cusp = piece.contains("radius");
      const json& ends = cusp ? piece["radius"] : piece["curvature"];
      text += fmt::format("{:>5} {:>8.5g} {:>14.9g} {:>14.9g} {:>14.9g}{}\n", index++,
                          piece["alpha"].get<double>(), piece["length"].get<double>(),
                          ends[0].get<double>(), ends[1].get<double>(), cusp ? "  (radii)" : "");
    }
  }
  std::string line;
  for (const auto& [name, value] : result.items())
    if (name != "curve" && name != "report" && name != "target" && !value.is_null())
      line += fmt::format("{}{} {}", line.empty() ? "" : "  ", name, in_words(value));
  if (result.contains("report"))
    for (const json& span : result["report"]["overridden"])
      line += fmt::format("{}span {} got slope -1", line.empty() ? "" : "  ", span["span"].dump());
  return text + (line.empty() ? "" : line + "\n");
}

Result<operations::Outcome> drawn(Session& session, const Operation& operation) {
  const json own = session.of(kOwn);
  const auto points = points_of(own.value("points", json::array()), operation.name == "lac.space");
  if (!points) return std::unexpected(points.error());
  json request = session.of(kCurve);
  if (auto done = put_points(operation, *points, request); !done)
    return std::unexpected(done.error());
  complete(operation, request);
  return session.perform(operation.name, request, session.progress());
}

/// Which option asks for the operation that has the option refused.
std::string asked_by(const std::string& option) {
  for (const CurveKind& kind : kKinds) {
    const auto options = option_names(plain_manual(kind.operation));
    if (*kind.sign != '\0' && std::ranges::find(options, option) != options.end())
      return std::string(kind.sign);
  }
  return "";
}

}  // namespace

int run_draw(const Words& words) {
  const Operation& operation = operation_for(words);
  const bool help = is_given(words, "--help") || is_given(words, "-h");
  Session session = new_session(operation, help);
  session.explain_refused([](const std::string& option) {
    const std::string sign = asked_by(option);
    return sign.empty() ? "" : "it goes with " + sign + ";";
  });
  if (const auto status = session.begin(words)) return *status;
  if (auto done = session.check_outputs(); !done) return report_failure(done.error());
  const auto outcome = drawn(session, operation);
  end_progress();
  if (!outcome) return report_failure(outcome.error());
  const auto result = shown_of(*outcome);
  if (!result) return report_failure(result.error());
  const auto view = session.record<presentation::HandleView>(kView);
  if (!view) return report_failure(view.error());
  const auto pages = presentation::handle_pages(*outcome, *view, session.report_options());
  if (!pages) return report_failure(session.told(pages.error()));
  const json curves = json::array({{{"curve", (*result)["curve"]}}});
  auto written = session.write(*pages, json{{"curves", curves}});
  if (!written) return report_failure(written.error());
  session.print(*result, text_of(*result));
  return kDone;
}

Manual draw_manual() { return new_session(operation_for({}), true).manual(); }

}  // namespace keyline::app
