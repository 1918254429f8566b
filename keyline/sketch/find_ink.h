#pragma once

#include <vector>

#include "keyline/sketch/faint_ink.h"
#include "keyline/sketch/morphology.h"
#include "keyline/sketch/refine_stroke.h"
#include "keyline/sketch/thinning.h"
#include "keyline/sketch/tone.h"
#include "keyline/sketch/trace.h"

namespace keyline::sketch {

/// Ink of the lines, smoothed and free of dirt.
struct Ink {
  Binary picture;
  FaintPixels faint;    ///< darker than paper, but no ink
  int specks = 0;       ///< pieces of fewer pixels were taken for dirt
  Removed dirt{};       ///< these, and pinholes
  InkPieces lost{};     ///< what smoothing left nothing of
  double width = 1;     ///< of its lines
  bool grainy = false;  ///< full of pinholes and ragged, as pencil on rough paper leaves it
};

/// The ink of a picture. Grainy ink is looked at again through a blur of part of its width, and so
/// is what follows (`tone` is blurred). In other pictures lines too faint beside darker ones (blue
/// pencil under ink) are ink as well.
Ink find_ink(Tone& tone, const TraceOptions& options);

/// What was taken for dirt, or lost, and lies on a line after all (dots of a row) is ink again.
void put_back_drawn(const std::vector<FineStroke>& lines, Ink& ink);

/// A faint line beside lines of that width: farther from ink than the darkness of their border
/// reaches, in pieces of so many pixels at least.
FaintLine faint_line(double width, int specks);

/// Gives a stage's picture to the caller, if the options ask for stages.
void show_stage(const TraceOptions& options, const char* name, const Binary& binary);

/// Shows the log picture as the stage "log".
void show_stage(const TraceOptions& options, const Tone& tone);

}  // namespace keyline::sketch
