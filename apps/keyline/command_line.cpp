#include "command_line.h"

#include <cmath>
#include <memory>

#include <CLI/CLI.hpp>

#include "commands.h"

namespace keyline::app {
namespace {

/// What runs a command once its options are parsed and the line that was typed is known.
template <class Options>
std::function<int(const std::string&)> runs(std::shared_ptr<Options> options,
                                            int (*run)(const Options&)) {
  return [options = std::move(options), run](const std::string& typed) {
    options->common.command_line = typed;
    return run(*options);
  };
}

bool read_number(const std::string& text, double& value) {
  return CLI::detail::lexical_cast(text, value) && std::isfinite(value);
}

CLI::Validator positive() {
  return {[](const std::string& text) {
            double value = 0;
            return read_number(text, value) && value > 0
                       ? std::string()
                       : "\"" + text + "\" is not a number greater than 0";
          },
          "POSITIVE"};
}

CLI::Validator not_negative() {
  return {[](const std::string& text) {
            double value = 0;
            return read_number(text, value) && value >= 0
                       ? std::string()
                       : "\"" + text + "\" is not a number from 0 on";
          },
          "NONNEGATIVE"};
}

void add_common(CLI::App& app, CommonOptions& common, bool outputs = true) {
  app.set_version_flag("--version", "keyline " KEYLINE_VERSION, "print the version and exit");
  if (outputs)
    app.add_option("-o,--output", common.outputs,
                   "file to write; may be repeated; the extension chooses the format")
        ->type_name("FILE")
        ->allow_extra_args(false);
  app.add_flag("--json", common.json, "print the result object on standard output");
  app.add_option("--tolerance", common.tolerance, "largest deviation, in the input's unit")
      ->check(positive());
  app.add_option("--seed", common.seed, "of everything random; the same seed, the same result")
      ->capture_default_str();
  app.add_option("--threads", common.threads, "0: all; the result does not depend on it")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_flag("--quiet", common.quiet, "no messages but errors");
}

void add_input(CLI::App& app, InputOptions& input) {
  app.add_option(
         "INPUT", input.files,
         "points (csv, tsv, dat, xyz, pts), curves (svg, dxf, step, iges, glif, json), fonts (ttf, "
         "otf; with --glyph), meshes (obj, "
         "stl, ply; with --section), drawings (png, jpeg, tiff, webp); - for standard input; "
         "several "
         "files are parts of one key-line")
      ->required()
      ->type_name("FILE");
  const char* points = "Reading points";
  app.add_option("--columns", input.columns, "names or numbers of the columns: x y [z]")
      ->expected(2, 3)
      ->delimiter(',')
      ->group(points);
  app.add_option("--weights", input.weights, "column of weights")->group(points);
  app.add_option("--id", input.id, "column that tells curves apart")->group(points);
  app.add_option("--select", input.select,
                 "take only what has this name, lies on this layer, or has this number");
  app.add_option("--glyph", input.glyphs, "of a font: characters, /name or U+0053");
  app.add_option("--section", input.section,
                 "cut a cloud or mesh by a plane, as in y=0; auto: by its symmetry plane")
      ->group(points);
  app.add_option("--band", input.band, "half thickness of the section of a cloud")
      ->check(positive())
      ->group(points);
  app.add_option("--row", input.row, "row of a lattice of range data, from 0")->group(points);
  app.add_option("--column", input.column, "column of a lattice, from 0")->group(points);
  app.add_option("--noise", input.noise, "standard deviation of the points; else estimated")
      ->check(not_negative())
      ->group(points);
  auto* closed = app.add_flag("--closed", input.closed, "the points are a closed outline");
  auto* open = app.add_flag("--open", input.open, "they are not");
  closed->excludes(open)->group(points);
  open->group(points);
  app.add_flag("--keep-order", input.keep_order, "never put points in another order")
      ->group(points);
  app.add_flag("--keep-strays", input.keep_strays, "never drop a point as stray")->group(points);
  app.add_option("--unit", input.unit, "of the coordinates, for drawings: mm, cm, m, in, pt, px")
      ->group(points);
}

void add_spline_search(CLI::App& app, SplineSearch& search) {
  const char* group = "Spline through the points";
  app.add_option("--order", search.order, "degree + 1, 4 to 6 (5)")->group(group);
  app.add_option("--knots", search.knots, "polished (default) or ga, the plain genetic search")
      ->group(group);
  app.add_option("--population", search.population, "of the genetic search (30)")->group(group);
  app.add_option("--generations", search.generations, "of the genetic search (30)")->group(group);
  app.add_option("--trials", search.trials, "searches, the best is kept (1)")->group(group);
  app.add_option("--parameter", search.parameter, "smooth-chord (default), chord or centripetal")
      ->group(group);
}

Command add_fair(CLI::App& app) {
  auto options = std::make_shared<FairCommand>();
  FairCommand& fair = *options;
  auto* sub =
      app.add_subcommand("fair", "the main job: points or a curve in, a faired key-line out");
  add_input(*sub, fair.input);
  add_common(*sub, fair.common);
  sub->add_option("--pieces", fair.pieces, "wanted number of pieces; 0: as few as possible")
      ->check(CLI::Range(0, 400));
  sub->add_option("--criterion", fair.criterion,
                  "what the chain is to be within the tolerance: fewest-pieces (default) or "
                  "least-variation, of curvature");
  sub->add_option("--clamp", fair.clamp,
                  "hold ends: start:G1,end:G2 (G0 position, G1 direction, "
                  "G2 curvature)");
  sub->add_option("--region", fair.region, "a:b, fair only this part of the length (0 to 1)");
  sub->add_option("--interpretation", fair.interpretations,
                  "PIECE:RHYTHM or PIECE:slope=NUMBER, pieces counted from 0; rhythms: straight "
                  "arc minus zero plus plus+minus minus+plus")
      ->allow_extra_args(false);
  sub->add_option("--must-pass", fair.must_pass, "indices of points to pass, from 0")
      ->delimiter(',');
  sub->add_flag("!--no-keep-corners,--keep-corners", fair.keep_corners,
                "corners end chains (default)");
  add_spline_search(*sub, fair.spline);
  sub->footer(
      "Example: keyline fair examples/bonnet-scan.csv -o faired.svg -o report.html\n"
      "Formats: svg, json (the exact chain), csv (samples), html (report), pdf, png.");
  return {sub, runs(options, run_fair)};
}

Command add_draw(CLI::App& app) {
  auto options = std::make_shared<DrawCommand>();
  DrawCommand& draw = *options;
  auto* sub = app.add_subcommand("draw", "a log-aesthetic curve from handles or through points");
  sub->add_option(
         "--points", draw.points,
         "handles P0 P1 P2 as x,y; two ends with --directions or --volume; any number with "
         "--spline; P0 T0 T2 P2 as x,y,z with --space")
      ->required()
      ->expected(1, 100000);
  sub->add_option("--alpha", draw.alpha,
                  "slope (default -1); two, as a0,a1, for a compound rhythm; one per span with "
                  "--spline")
      ->delimiter(',');
  sub->add_option("--ratio", draw.ratio, "compound: share of the turning with the first slope");
  sub->add_option("--form", draw.form,
                  "quasi-log-aesthetic Bezier: taylor-angle taylor-arc discrete-angle discrete-arc "
                  "rational-cubic best");
  sub->add_option("--degree", draw.degree, "of the Bezier, 3 to 30")->capture_default_str();
  sub->add_option("--about", draw.about, "Taylor: 0 to 1, where to expand; or auto");
  sub->add_option("--directions", draw.directions,
                  "start,end direction of travel in radians, in place of P1")
      ->delimiter(',');
  sub->add_option("--curvatures", draw.curvatures, "start,end signed curvature (G2)")
      ->delimiter(',');
  sub->add_option("--volume", draw.volume,
                  "area over the chord, with one --directions value at the start");
  sub->add_flag("--spline", draw.spline, "a G2 spline through all points");
  sub->add_flag("--closed", draw.closed, "the spline returns to its first point");
  sub->add_flag("--space", draw.space, "a space curve; see --points");
  sub->add_option("--beta", draw.beta, "space: slope of the torsion graph")->capture_default_str();
  sub->add_option("--omega", draw.omega, "space: rate of the radius of torsion")
      ->capture_default_str();
  sub->add_option("--show", draw.show,
                  "figures in svg, pdf, png and html: comb,evolute,lcg,region");
  add_common(*sub, draw.common);
  sub->footer(
      "Example: keyline draw --points 0,0 2,0 3,1.5 --alpha -1,1.5 --ratio 0.4 -o curve.svg\n"
      "Formats: svg, json (the exact curve), csv (samples), pdf, png, html (report).");
  return {sub, runs(options, run_draw)};
}

Command add_sketch(CLI::App& app) {
  auto options = std::make_shared<SketchCommand>();
  SketchCommand& sketch = *options;
  auto* sub = app.add_subcommand("sketch", "a picture of a drawing in, its lines as curves out");
  sub->add_option("IMAGE", sketch.file,
                  "drawing: png, jpeg, tiff or webp; or pen strokes: scap, svg, dxf, json")
      ->required()
      ->type_name("FILE");
  sub->add_option("--edge", sketch.edge, "center of the lines, or the ink's outer border")
      ->check(CLI::IsMember({"center", "outer"}))
      ->capture_default_str();
  sub->add_flag("--consolidate", sketch.consolidate, "lines drawn several times become one");
  sub->add_option("--curvature", sketch.curvature, "what the curves' curvature is driven to")
      ->check(CLI::IsMember({"none", "smooth", "rhythm"}))
      ->capture_default_str();
  sub->add_flag("--per-segment", sketch.per_segment,
                "a quintic per line segment, as the paper has it; else as few as follow the lines");
  const char* ink = "Telling ink from paper";
  sub->add_option("--threshold", sketch.threshold, "0 to 1: what is darker is ink; else by region")
      ->group(ink);
  sub->add_option("--thresholds", sketch.thresholds,
                  "of the 8 x 8 regions, row by row: 64 numbers or auto")
      ->delimiter(',')
      ->group(ink);
  sub->add_option("--log-gain", sketch.gain, "the a of y = a log x; else such that paper is white")
      ->group(ink);
  sub->add_option("--flatten", sketch.flatten, "take the paper's own shades out: auto, on, off")
      ->check(CLI::IsMember({"auto", "on", "off"}))
      ->group(ink);
  sub->add_option("--polarity", sketch.polarity, "auto, dark (lines on light paper), light")
      ->check(CLI::IsMember({"auto", "dark", "light"}))
      ->group(ink);
  sub->add_option("--specks", sketch.specks, "pieces of ink of fewer pixels are dirt")->group(ink);
  sub->add_option("--gap", sketch.gap, "longest gap to bridge, in pixels");
  auto* scale = sub->add_option("--scale", sketch.scale, "mm per pixel; without it lengths are px")
                    ->check(positive());
  sub->add_option("--dpi", sketch.dpi, "pixels per inch; lengths are mm then")
      ->check(positive())
      ->excludes(scale);
  sub->add_option("--debug", sketch.debug, "folder for a picture of every stage")->type_name("DIR");
  add_common(*sub, sketch.common);
  sub->footer(
      "Example: keyline sketch examples/sketch.png -o sketch.svg\n"
      "Formats: svg, json (the exact quintics), csv (samples), dxf and what convert writes. "
      "--tolerance counts in pixels (0.5).");
  return {sub, runs(options, run_sketch)};
}

Command add_analyze(CLI::App& app) {
  auto options = std::make_shared<AnalyzeCommand>();
  auto* sub =
      app.add_subcommand("analyze", "curvature and rhythm of curves, SAV and zebra of surfaces");
  add_input(*sub, options->input);
  add_common(*sub, options->common);
  const char* surfaces = "Pictures of surfaces";
  sub->add_option("--show", options->show,
                  "lit zebra gaussian mean principal isophote reflection highlight")
      ->delimiter(',')
      ->group(surfaces);
  sub->add_option("--view", options->view, "x,y,z, direction to the eye; else on the mean normal")
      ->delimiter(',')
      ->expected(3)
      ->group(surfaces);
  sub->add_option("--stripes", options->stripes,
                  "zebra: black and white pairs to the half turn; else about eight show")
      ->check(positive())
      ->group(surfaces);
  sub->footer(
      "Example: keyline analyze examples/clothoid.csv -o report.html\n"
      "         keyline analyze examples/panel-c.json -o panel.html");
  return {sub, runs(options, run_analyze)};
}

Command add_edit(CLI::App& app) {
  auto options = std::make_shared<EditCommand>();
  EditCommand& edit = *options;
  auto* sub = app.add_subcommand("edit", "a curve or patch towards Class A and least energy");
  add_input(*sub, edit.input);
  add_common(*sub, edit.common);
  sub->add_option("--to", edit.to, "alpha,s to move to; the minimum-energy point unless given")
      ->delimiter(',')
      ->expected(2);
  sub->add_option("--amount", edit.amount, "0: the given curve, 1: all the way")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  sub->add_option("--hold", edit.hold, "with --to: ends-and-tangent, ends or start")
      ->capture_default_str();
  sub->add_option("--direction", edit.direction, "growing edges, or as-given")
      ->capture_default_str();
  sub->add_option("--branch", edit.branch, "of the minimum: own, growing or falling")
      ->capture_default_str();
  sub->add_option("--alpha-max", edit.alpha_max, "largest rotation, radians (1.0982)");
  sub->add_option("--end-tolerance", edit.end_tolerance,
                  "how far the end may move, a length (0.01 of the chord; surfaces: 0)");
  sub->add_option("--keep", edit.keep,
                  "surfaces: start, corners, joints or boundary; one patch start, several joints");
  sub->add_option("--limit", edit.limit, "surfaces: largest departure, a length")
      ->check(not_negative());
  sub->add_option("--condition", edit.conditions,
                  "surfaces: of a network curve, A1:s=1.1..1.4,alpha=0..0.3,end=0.1, "
                  "branch=falling, tangent=kept; without A1: of all; may be repeated")
      ->type_name("[CURVE:]NAME=VALUE,...")
      ->allow_extra_args(false);
  sub->add_option("--alpha-range", edit.alpha_range, "low,high: where the minimum may lie")
      ->delimiter(',')
      ->expected(2);
  sub->add_option("--s-range", edit.s_range, "low,high: where the minimum may lie")
      ->delimiter(',')
      ->expected(2);
  sub->footer(
      "Example: keyline edit examples/cubic.json --end-tolerance 0.01 -o report.html\n"
      "         keyline edit examples/panel-c.json --keep corners --limit 5 -o panel.json\n"
      "Formats: svg, json (the exact Bezier), csv (samples), html (report), pdf, png.");
  return {sub, runs(options, run_edit)};
}

Command add_convert(CLI::App& app) {
  auto options = std::make_shared<ConvertCommand>();
  auto* sub = app.add_subcommand("convert", "a curve from one format to another");
  add_input(*sub, options->input);
  add_common(*sub, options->common);
  sub->add_flag("--grid", options->grid, "glif: nodes and handles on whole numbers");
  sub->add_flag("--trims", options->trims, "also the curves that trim surfaces, as curves");
  sub->add_flag("--polylines", options->polylines,
                "dxf: one polyline per curve, arcs as bulges, in place of splines");
  sub->footer("Example: keyline convert faired.json -o faired.dxf --tolerance 0.001");
  return {sub, runs(options, run_convert)};
}

Command add_batch(CLI::App& app) {
  auto options = std::make_shared<BatchCommand>();
  auto* sub = app.add_subcommand(
      "batch", "requests as lines of JSON on standard input, answers in the same order");
  add_common(*sub, options->common, false);
  sub->remove_option(sub->get_option("--json"));
  sub->get_option("--seed")->description("of requests that take a seed and give none");
  sub->get_option("--tolerance")->description("of requests that take a length so and give none");
  sub->get_option("--threads")->description("processes that answer; 0: one for each core");
  sub->add_option("--resume", options->resume,
                  "file the answers go to; those in it already are not asked for again")
      ->type_name("FILE");
  sub->add_option("--time-limit", options->time_limit, "seconds a line may take; else any")
      ->check(positive());
  sub->footer("Example: echo '{\"op\":\"lac.region\",\"theta\":1,\"alpha\":-1}' | keyline batch");
  return {sub, [options, sub](const std::string&) {
            if (sub->count("--seed") > 0) options->seed = options->common.seed;
            return run_batch(*options);
          }};
}

Command add_operations(CLI::App& app) {
  auto options = std::make_shared<OperationsCommand>();
  auto* sub = app.add_subcommand("operations", "what can be requested; with a name, its schema");
  sub->add_option("NAME", options->name, "of an operation");
  sub->add_option("--format", options->format,
                  "schema; of one: result (its schema) or markdown; of all: typescript, python, "
                  "openapi or markdown")
      ->check(CLI::IsMember({"schema", "result", "typescript", "python", "openapi", "markdown"}));
  add_common(*sub, options->common, false);
  sub->footer("Example: keyline operations lac.segment");
  return {sub, runs(options, run_operations)};
}

/// Its options are the studio's own: everything after the name is passed on.
Command add_studio(CLI::App& app) {
  auto* sub = app.add_subcommand("studio", "the browser studio on this machine");
  sub->set_help_flag();
  sub->prefix_command();
  return {sub, [sub](const std::string&) { return run_studio(sub->remaining()); }};
}

}  // namespace

std::vector<Command> add_commands(CLI::App& app) {
  return {add_fair(app),    add_analyze(app), add_draw(app),   add_edit(app),      add_sketch(app),
          add_convert(app), add_batch(app),   add_studio(app), add_operations(app)};
}

}  // namespace keyline::app
