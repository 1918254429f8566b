#pragma once

#include <optional>
#include <string>
#include <vector>

/// The commands: each takes what was parsed and returns the exit status.
namespace keyline::app {

/// Options that mean the same everywhere.
struct CommonOptions {
  std::vector<std::string> outputs;  ///< -o, the extension chooses the format
  bool json = false;
  bool quiet = false;
  long seed = 1;
  int threads = 0;
  std::optional<double> tolerance;
  std::string command_line;  ///< as it was typed, for reports
};

/// Where a curve or points come from and how they are to be read.
struct InputOptions {
  std::vector<std::string> files;
  std::vector<std::string> columns;
  std::string weights;
  std::string id;
  std::string select;   ///< id or name of one of several curves
  std::string section;  ///< "y=0" or "auto"
  std::string glyphs;   ///< of a font
  std::optional<double> band;
  std::optional<long> row;
  std::optional<long> column;
  bool closed = false;
  bool open = false;
  bool keep_order = false;
  bool keep_strays = false;
  std::optional<double> noise;
  std::string unit;
};

/// How the knots of the points' spline are searched; empty: the defaults of `fair`.
struct SplineSearch {
  std::optional<int> order;
  std::optional<int> population;
  std::optional<int> generations;
  std::optional<int> trials;
  std::string knots;
  std::string parameter;
};

struct FairCommand {
  CommonOptions common;
  InputOptions input;
  int pieces = 0;
  std::string criterion;  ///< empty: the default of `fair`
  std::string clamp;
  std::string region;
  std::vector<std::string> interpretations;
  std::vector<long> must_pass;
  bool keep_corners = true;
  SplineSearch spline;
};
int run_fair(const FairCommand& command);

struct AnalyzeCommand {
  CommonOptions common;
  InputOptions input;
  std::vector<std::string> show;  ///< pictures of a surface: lit, zebra, gaussian, …
  std::vector<double> view;       ///< direction to the eye
  std::optional<double> stripes;  ///< pairs of the zebra
};
int run_analyze(const AnalyzeCommand& command);

struct EditCommand {
  CommonOptions common;
  InputOptions input;
  std::vector<double> to;  ///< alpha, s; empty: the minimum-energy point
  double amount = 1;
  std::string hold = "ends-and-tangent";
  std::string direction = "growing";
  std::string branch = "own";
  std::optional<double> alpha_max;
  std::optional<double> end_tolerance;
  std::string keep;                     ///< of a surface; empty: as surface.edit chooses
  std::optional<double> limit;          ///< of a surface: largest departure
  std::vector<std::string> conditions;  ///< of network curves: "A1:s=1.1..1.4"
  std::vector<double> alpha_range;      ///< of the minimum; empty: 0 to alpha_max
  std::vector<double> s_range;
};
int run_edit(const EditCommand& command);

struct DrawCommand {
  CommonOptions common;
  std::vector<std::string> points;  ///< "x,y", or "x,y,z" with --space
  std::vector<double> alpha;
  std::optional<double> ratio;
  std::string form;
  int degree = 8;
  std::string about;
  std::vector<double> directions;
  std::vector<double> curvatures;
  std::optional<double> volume;
  bool spline = false;
  bool closed = false;
  bool space = false;
  double beta = -1;
  double omega = 0;
  std::string show;
};
int run_draw(const DrawCommand& command);

struct SketchCommand {
  CommonOptions common;
  std::string file;
  std::optional<double> threshold;
  std::optional<double> gain;
  std::optional<double> gap;
  std::optional<int> specks;
  std::vector<std::string> thresholds;  ///< of the 64 regions, numbers or "auto"
  std::string edge = "center";
  std::string curvature = "none";
  std::string flatten = "auto";
  std::string polarity = "auto";
  bool consolidate = false;
  bool per_segment = false;     ///< a quintic per line segment, as [Sketch]
  std::optional<double> scale;  ///< mm per pixel
  std::optional<double> dpi;
  std::string debug;  ///< folder for the pictures of every stage
};
int run_sketch(const SketchCommand& command);

struct ConvertCommand {
  CommonOptions common;
  InputOptions input;
  bool polylines = false;
  bool grid = false;
  bool trims = false;
};
int run_convert(const ConvertCommand& command);

struct BatchCommand {
  CommonOptions common;
  std::optional<long> seed;  ///< of requests that take one and give none; so with the tolerance
  std::string resume;        ///< file of answers to go on with; empty: standard output
  std::optional<double> time_limit;  ///< seconds a line may take
};
int run_batch(const BatchCommand& command);

struct OperationsCommand {
  CommonOptions common;
  std::string name;    ///< of the one to describe; empty: list all
  std::string format;  ///< schema, result (its schema), typescript, python, openapi, markdown
};
int run_operations(const OperationsCommand& command);

}  // namespace keyline::app
