#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/acquire/raw_curve.h"
#include "keyline/core/error.h"
#include "keyline/exchange/points/points_blocks.h"
#include "keyline/exchange/points/points_columns.h"
#include "keyline/exchange/points/points_head.h"
#include "keyline/exchange/points/points_nodes.h"
#include "keyline/exchange/points/points_reader.h"
#include "keyline/exchange/points/points_row.h"
#include "keyline/exchange/points/row_width.h"

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
  struct Count {  // a number by itself between rows, and what it is where it counts none
    double rows = 0;
    core::Failure failure;
  };

  core::Result<void> before_data(std::string_view line, int number, const std::string& place);
  core::Result<void> start(const Fields& fields, int number, const std::string& place);
  core::Result<void> among_data(std::string_view line, int number, const std::string& place);
  bool is_lone(const Fields& fields) const;
  core::Result<void> set_aside(const Fields& fields, std::string_view line, int number,
                               const std::string& place);
  core::Result<void> take_up_again();
  core::Result<void> meet_count();
  bool first_was_none(const Fields& fields) const;
  bool is_first_of_many() const;
  bool is_behind_nodes(int number);
  std::string_view without_remark(std::string_view line);
  core::Result<void> check_width(const Fields& fields, int number, const std::string& place);
  void add(const PointsRow& row, int number);
  void meet_blank(int number);
  acquire::RawCurve& curve_of(std::string_view id);
  void restart(std::size_t fields, const std::string& place);
  void watch_counter(const Fields& fields);
  void drop_counter();
  bool title_counts(double number) const;
  void name_curves();
  void tell_columns();
  void tell_left_out();

  const PointsOptions& options_;
  PointsHead head_;
  PointsColumns columns_;
  std::string unit_;
  bool started_ = false;
  std::size_t width_ = 0;  // fields of the first row
  RowWidth row_width_;     // the same, and which of them are numbers
  std::string_view row_;   // the line being taken, with the tabs at its end
  std::size_t rows_ = 0;
  int first_line_ = 0;
  std::size_t ignored_columns_ = 0;
  std::size_t remarks_ = 0;                // rows with one behind them
  std::optional<core::Failure> remark_;    // the last line of text behind rows, as a failure
  std::optional<core::Failure> unproven_;  // of the text before rows too few to be a curve
  std::optional<core::Failure> misfit_;    // of rows that do not fit the first line of numbers
  std::optional<NodeCounts> nodes_;        // where the first line has them
  std::vector<double> first_row_;          // its numbers, -1 for what is none
  bool told_behind_ = false;
  bool zone_ = false;           // the line before is of Tecplot's head of a zone
  ZoneCount zone_count_;        // of the last zone
  std::optional<Count> count_;  // of the rows since the last such line
  std::string remark_text_;
  bool like_row_ = false;  // the remark is rather a row with a mistake in it: it names no curve
  std::size_t run_ = 0;    // rows since the last line of text
  bool counting_ = false;  // column 1 counts the rows so far: 1, 2, 3 ...
  std::vector<double> fourth_;  // numbers of column 4 then
  std::vector<std::string> left_out_;
  Curves curves_;
  Curves seconds_;                  // the second curve of each, where columns_.two()
  std::vector<BlankLines> blanks_;  // among the rows
  std::map<std::string, std::size_t, std::less<>> index_;
  std::size_t current_ = 0;
};

}  // namespace keyline::exchange::detail
