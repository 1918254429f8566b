#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/acquire/raw_curve.h"
#include "keyline/core/error.h"
#include "keyline/core/point.h"
#include "keyline/exchange/points/points_blocks.h"
#include "keyline/exchange/points/points_columns.h"
#include "keyline/exchange/points/points_reader.h"
#include "keyline/exchange/points/points_sides.h"
#include "keyline/exchange/text/header_unit.h"
#include "keyline/exchange/text/text_table.h"

/// Internals of points_reader.cpp: lines of text become curves.
namespace keyline::exchange::detail {

/// Reads lines one after the other into curves.
class PointsTable {
 public:
  using Curves = std::vector<acquire::RawCurve>;

  explicit PointsTable(const PointsOptions& options) : options_(options) {}

  core::Result<void> take(std::string_view line, int number, const std::string& place);
  /// What the end of the input cut off, in words.
  void cut_off(std::string what) { left_out_.push_back(std::move(what)); }
  core::Result<Curves> finish(const std::string& name);
  /// The unit that the header tells of the columns taken; else empty.
  const std::string& unit() const { return unit_; }

 private:
  using Fields = std::vector<std::string_view>;
  struct Row {
    core::Point3 point;
    core::Point3 second;  // where columns_.two()
    double weight = 1;
    std::string id;
  };
  struct Count {  // a number by itself between rows, and what it is where it counts none
    double rows = 0;
    core::Failure failure;
  };

  core::Result<void> before_data(std::string_view line, int number, const std::string& place);
  core::Result<void> start(const Fields& fields, int number, const std::string& place);
  void learn_fraction(std::string_view line);
  core::Result<void> among_data(std::string_view line, int number, const std::string& place);
  bool is_lone(const Fields& fields) const;
  core::Result<void> set_aside(const Fields& fields, std::string_view line, int number,
                               const std::string& place);
  core::Result<void> take_up_again();
  core::Result<void> meet_count();
  core::Failure too_few(std::size_t fields, const std::string& place) const;
  bool first_was_none(const Fields& fields) const;
  bool take_header(std::string_view text, int number, bool comment);
  bool take_unit_row(std::string_view text, int number);
  void take_style(std::string_view line);
  std::string_view without_remark(std::string_view line);
  bool tabs_part(std::string_view line) const;
  core::Result<void> take_units(const std::string& place);
  core::Result<void> surplus(const Fields& fields, int number, const std::string& place);
  core::Result<double> number_in(const Fields& fields, int column, const std::string& place) const;
  core::Result<Row> row_of(const Fields& fields, const std::string& place) const;
  core::Result<core::Point3> second_of(const Fields& fields, const std::string& place) const;
  void add(const Row& row, int number);
  void put(acquire::RawCurve& curve, core::Point3 p, double weight, int number) const;
  void meet_blank(int number);
  acquire::RawCurve& curve_of(std::string_view id);
  bool all_numbers(const Fields& fields, std::size_t from) const;
  void remember_title(std::string_view line, int number);
  void tell_titles();
  void restart(std::size_t fields, const std::string& place);
  void watch_counter(const Fields& fields);
  void drop_counter();
  void tell_columns();
  void take_sides();
  void join_named_points();
  void part_curves();
  void part_sides();
  bool title_counts(double number) const;
  void name_curves();
  void tell_left_out();

  const PointsOptions& options_;
  TableStyle style_;
  bool fraction_known_ = false;  ///< whether style_.decimal_comma is settled
  PointsColumns columns_;
  std::vector<std::string> names_;
  std::vector<HeaderUnit> units_;  // of the columns that have names
  std::string unit_;
  std::string said_unit_;  // by a line of text before the rows
  char header_separator_ = 0;
  bool header_counts_ = false;  // it is a comment: its mark may stand for a number of the point
  std::string first_text_;      // shortened
  std::string last_text_;
  std::vector<std::string> titles_;  // lines of text before the rows, the first some of them
  bool unknown_header_ = false;
  bool started_ = false;
  bool text_id_ = false;
  std::size_t text_lines_ = 0;
  std::size_t width_ = 0;  // fields of the first row
  std::size_t most_ = 0;  // the same, or of its header: empty fields at a row's end are not counted
  std::size_t rows_ = 0;
  int first_line_ = 0;
  int header_line_ = 0;
  std::size_t ignored_columns_ = 0;
  std::size_t remarks_ = 0;                // rows with one behind them
  std::optional<core::Failure> remark_;    // the last line of text behind rows, as a failure
  std::optional<core::Failure> unproven_;  // of the text before rows too few to be a curve
  std::optional<core::Failure> misfit_;    // of rows that do not fit the first line of numbers
  std::optional<Count> count_;             // of the rows since the last such line
  std::string remark_text_;
  bool like_row_ = false;  // the remark is rather a row with a mistake in it: it names no curve
  std::size_t run_ = 0;    // rows since the last line of text
  bool counting_ = false;  // column 1 counts the rows so far: 1, 2, 3 ...
  std::vector<double> fourth_;  // numbers of column 4 then
  std::vector<std::string> left_out_;
  Curves curves_;
  Curves seconds_;                  // the second curve of each, where columns_.two()
  std::optional<Sides> sides_;      // what the header says of two curves
  std::vector<BlankLines> blanks_;  // among the rows
  std::map<std::string, std::size_t, std::less<>> index_;
  std::size_t current_ = 0;
};

}  // namespace keyline::exchange::detail
