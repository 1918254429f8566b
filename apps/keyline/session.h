#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "keyline/operations/json_form.h"
#include "keyline/operations/perform.h"
#include "keyline/presentation/output.h"

#include "arguments.h"
#include "commands.h"
#include "option_uses.h"
#include "words.h"

/// What the commands share: their options beside an operation's own, files in, results out.
namespace keyline::app {

/// What every command takes.
struct DoorOptions {
  std::vector<std::string> output;
  bool json = false;
  std::optional<double> tolerance;
  std::optional<long> seed;
  int threads = 0;
  bool quiet = false;
  bool help = false;
  bool version = false;
  static constexpr auto describe() {
    using Door = DoorOptions;
    return core::fields(
        core::field<&Door::output>("file to write (-o); may be repeated; the extension chooses the "
                                   "format"),
        core::field<&Door::json>("print the result object on standard output"),
        core::field<&Door::tolerance>("largest deviation, in the input's unit")
            .in("length")
            .within(core::kPositive),
        core::field<&Door::seed>("seed of everything random; the same seed gives the same result"),
        core::field<&Door::threads>("how many to use, 0 for all; the result does not depend on it")
            .within(core::from_to(0, 1024)),
        core::field<&Door::quiet>("no messages but errors"),
        core::field<&Door::help>("this text (-h)"),
        core::field<&Door::version>("print the version"));
  }
};

/// Fields of a request that a file's contents fill: no options.
std::vector<std::string_view> filled_by_files();

OptionGroup group_of(const operations::Operation& operation, const std::string& title);
OptionGroup reading_group();
OptionGroup door_group();

/// How a command is called and told of.
struct Usage {
  std::string command;  ///< "fair"
  std::string words;    ///< "FILE... "
  std::string text;
  std::string more;  ///< example and formats
  /// Further forms of the curves it makes, as operations::further_options() tells them; or null.
  const core::Type* forms = nullptr;
};

/// A command line that was read.
class Session {
 public:
  /// Precondition: the last group is door_group().
  Session(Usage usage, const std::vector<OptionGroup>& groups, bool takes_files = true);

  /// Reads the words. Returns the exit status where that is all: help, version, a failure.
  std::optional<int> begin(const Words& words);

  const DoorOptions& door() const { return door_; }
  Arguments& arguments() { return arguments_; }
  const std::vector<std::string>& files() const { return arguments_.files; }
  nlohmann::json& of(std::size_t record) { return arguments_.of(record); }

  /// What is said beside an option that the command does not have.
  void explain_refused(std::function<std::string(const std::string&)> explain) {
    explain_ = std::move(explain);
  }

  /// The command's name and its words, as a shell takes them.
  const std::string& typed() const { return typed_; }
  presentation::ReportOptions report_options() const;

  /// Progress with a bar; ended by the next message.
  core::Progress progress() const;

  /// bad_input, io: what stands against the files of -o. Writes none of them.
  core::Result<void> check_outputs(const std::vector<std::string>& known) const;
  core::Result<void> check_outputs() const;

  /// Performs one operation, its curves also in the forms asked for; failures name options. Several
  /// threads may perform at a time.
  core::Result<operations::Outcome> perform(const std::string& operation, nlohmann::json request,
                                            const core::Progress& progress);

  /// A failure of the library as the command line tells it: its field as the option of that name,
  /// where there is one. Fields that files fill stay what they are.
  core::Failure told(core::Failure failure) const;

  /// The i-th record as it was given; failures name options.
  template <class Record>
  core::Result<Record> record(std::size_t i) {
    Record record;
    const operations::Part part{&core::type_of<Record>(), &record};
    if (auto read = operations::read_json(of(i), {&part, 1}, {}, usage_.command); !read)
      return std::unexpected(told(read.error()));
    return record;
  }

  /// Ctrl-C ends writing, or what it cut short is kept and written all the same.
  enum class Ending { cancellable, kept };

  /// Writes the files of -o; says what a format could not hold.
  core::Result<nlohmann::json> write(const presentation::Pages& pages,
                                     const presentation::Output& output,
                                     Ending ending = Ending::cancellable);
  /// The same of a request of document.write; "tolerance" of the door where it has none.
  core::Result<nlohmann::json> write(const presentation::Pages& pages, nlohmann::json document,
                                     Ending ending = Ending::cancellable);

  /// Says it, and keeps it for the notes of the result; of many lines some are said (say_some()).
  void note(const std::string& text);
  void note_some(const std::string& lead, const std::vector<std::string>& lines,
                 const std::string& rest);
  /// The same of what a file tells: how curves lie in space, and what was left out.
  void note_read(const operations::ReadAnswer& read);

  /// Notes the options that nothing which was performed had a use for; those that the result tells
  /// itself are only said.
  void note_unused(const nlohmann::json& result);
  /// With --json the object, what was noted among its "notes"; else the text unless quiet. Notes
  /// unused options first.
  void print(const nlohmann::json& shown, const std::string& text);

  /// The command as completion and manual pages tell it.
  Manual manual() const;
  std::string help() const;
  std::string usage_hint() const { return "see keyline " + usage_.command + " --help"; }

 private:
  Usage usage_;
  Arguments arguments_;
  bool takes_files_;
  std::size_t door_record_;
  DoorOptions door_;
  std::string typed_;
  std::function<std::string(const std::string&)> explain_;
  std::vector<std::string> notes_;
  OptionUses uses_;
};

/// Files of a session through document.read.
struct ReadFiles {
  operations::Outcome outcome;
  nlohmann::json shown;  ///< its result
  const operations::ReadAnswer& answer() const {
    return *outcome.result_as<operations::ReadAnswer>();
  }
};

/// `request`: what was given of reading_group(). Failures name the file.
core::Result<operations::Outcome> read_outcome(Session& session, nlohmann::json request,
                                               bool planar);
core::Result<ReadFiles> read_files(Session& session, nlohmann::json request, bool planar);

/// Points and curves in the plane among what was read, where there are any and not too many to work
/// on; what is left out beside them is told.
core::Result<std::vector<nlohmann::json>> planar_things(Session& session, const ReadFiles& read);

/// Of a file whose result tells it too: how curves lie in space, and what was left out.
void say_read(bool quiet, const operations::ReadAnswer& read);

/// What a thing of a file is called where it is told of: by its name, else "curve 3", by its place
/// among those read, from 1. One alone without a name is called nothing.
std::string called(const std::string& name, const char* kind, std::size_t index, std::size_t count);

/// A curve of document.read as a request for measured points has it.
nlohmann::json subject_of(const nlohmann::json& thing);

/// What a curve of document.read carries beside its geometry and name, on its way into a file.
void take_look(nlohmann::json& to, const nlohmann::json& thing);

/// {"curves": […]} of several, each with its name; the one alone.
nlohmann::json one_or_all(const std::vector<nlohmann::json>& shown, const char* what);

/// The result of an outcome; internal failures are told as such.
core::Result<nlohmann::json> shown_of(const operations::Outcome& outcome);

/// bad_input where an option was given that has a meaning for other input alone: fields of
/// `unused` that are not in `used`.
core::Result<void> check_unused(const nlohmann::json& used, const nlohmann::json& unused,
                                const std::string& what);

}  // namespace keyline::app
