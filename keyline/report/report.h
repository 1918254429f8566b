#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "keyline/figure/curve_charts.h"
#include "keyline/figure/drawing.h"

namespace keyline::report {

/// What a report says, as plain data. All strings are UTF-8 text, never markup: whatever stands in
/// them is shown as it is.

/// How the work ended. Shown by word and sign, not by colour alone.
enum class Verdict { good, caution, bad };

/// One number the reader should see first.
struct KeyNumber {
  std::string label = {};  ///< "Largest deviation"
  std::string value = {};  ///< "0.42 mm"
  std::string note = {};   ///< "tolerance 0.5 mm"; may be empty
};

struct ReportFigure {
  figure::Drawing drawing = {};
  std::string caption = {};
  bool on_paper = false;  ///< for paper and where no script runs: else a linked curve shows it
};

/// A curve that the page draws by itself: comb and curvature plot, linked and zoomed together.
/// Lists of equal length (InvalidInput otherwise), all finite.
struct LinkedCurve {
  figure::SampledCurve curve = {};
  figure::SampledCurve before = {};      ///< its curvature behind the curve's; may be empty
  std::vector<std::string> pieces = {};  ///< a text about each; may be empty
  std::string unit = {};                 ///< of length
};

enum class Alignment { text, number };

struct Column {
  std::string title = {};
  Alignment alignment = Alignment::number;
};

/// Rows shorter than the header are filled up with empty cells, longer ones are cut.
struct ReportTable {
  std::string caption = {};
  std::vector<Column> columns = {};
  std::vector<std::vector<std::string>> rows = {};
};

/// A heading with what belongs under it, in this order: text, figures, tables.
struct Section {
  std::string title = {};
  std::vector<std::string> paragraphs = {};
  std::vector<ReportFigure> figures = {};  ///< narrow ones (under 480 px) stand side by side
  std::vector<ReportTable> tables = {};
  std::optional<LinkedCurve> linked = {};  ///< stands before the figures
};

enum class NoteKind { note, warning };

/// Something dropped, merged, overridden or to be looked at.
struct ReportNote {
  NoteKind kind = NoteKind::note;
  std::string text = {};
};

struct Report {
  std::string title = {};
  std::string subtitle = {};  ///< input file and curve, for example
  Verdict verdict = Verdict::good;
  std::string verdict_line = {};  ///< one sentence
  std::vector<KeyNumber> numbers = {};
  std::vector<Section> sections = {};
  std::vector<ReportNote> notes = {};
  std::vector<std::pair<std::string, std::string>> options = {};  ///< name and value
  std::string command = {};                                       ///< repeats the run
  std::string generator = {};                                     ///< the program and its version
};

/// One row of the table of pieces; lengths and radii already carry their unit.
struct PieceRow {
  std::string rhythm = {};
  std::string slope = {};
  std::string length = {};
  std::string radii = {};  ///< at start and end
  std::string turning = {};
  std::string volume = {};
  std::string impression = {};
};
/// Numbered from 1; columns that are empty in every row are left out.
ReportTable piece_table(const std::vector<PieceRow>& rows);

/// One row of the table of joints.
struct JointRow {
  std::string between = {};  ///< "1–2"
  std::string gap = {};
  std::string angle = {};
  std::string curvature_jump = {};
  std::string rate_jump = {};
  std::string order = {};  ///< "G2"
};
ReportTable joint_table(const std::vector<JointRow>& rows);

}  // namespace keyline::report
