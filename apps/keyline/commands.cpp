#include "commands.h"

namespace keyline::app {
namespace {

constexpr Command kCommands[] = {
    {"fair", "the main job: points or a curve in, a faired key-line out", run_fair, fair_manual},
    {"analyze", "curvature and rhythm of curves, SAV and zebra of surfaces", run_analyze,
     analyze_manual},
    {"draw", "a log-aesthetic curve from handles or through points", run_draw, draw_manual},
    {"edit", "a curve or patch towards Class A and least energy", run_edit, edit_manual},
#ifdef KEYLINE_HAS_SKETCH
    {"sketch", "a picture of a drawing in, its lines as curves out", run_sketch, sketch_manual},
#endif
    {"convert", "curves and surfaces from one format to another", run_convert, convert_manual},
    {"list", "what a file holds", run_list, list_manual},
    {"batch", "requests as lines of JSON in, answers out in the same order", run_batch,
     batch_manual},
    {"studio", "the browser studio on this machine", run_studio, studio_manual},
    {"operations", "what can be requested; with a name, its schema", run_operations,
     operations_manual}};

}  // namespace

std::span<const Command> commands() { return kCommands; }

}  // namespace keyline::app
