#include "studio.h"

#include <nlohmann/json.hpp>

#include "keyline/core/leading_number.h"
#include "keyline/core/version.h"
#include "keyline/operations/perform.h"
#include "keyline/operations/references.h"
#include "keyline/presentation/output.h"

#include "guard.h"
#include "report.h"

namespace keyline::studio {

namespace fs = std::filesystem;
using core::ErrorCode;
using core::Failure;
using core::Result;
using nlohmann::json;
using operations::Operation;

namespace {

constexpr std::size_t kMostWaiting = 2048;         // requests
constexpr std::size_t kMostLong = 16;              // long works
constexpr std::uintmax_t kLargestSent = 64 << 20;  // as large as what is uploaded
constexpr std::size_t kEndedEarly = 64;  // names of cancelled works that have not come yet

std::string text_of(const json& j) {
  return j.dump(-1, ' ', false, json::error_handler_t::replace);
}

int status_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::bad_input:
      return 400;
    case ErrorCode::undrawable:
    case ErrorCode::not_converged:
      return 422;
    case ErrorCode::unsupported:
      return 404;
    case ErrorCode::cancelled:
      return 409;
    case ErrorCode::io:
      return 404;
    case ErrorCode::internal:
      break;
  }
  return 500;
}

Reply data(int status, std::string body) {
  Reply reply{status, "application/json", std::move(body), {}};
  reply.headers.emplace_back("Cache-Control", "no-store");
  reply.headers.emplace_back("X-Content-Type-Options", "nosniff");
  return reply;
}

std::string failed_text(const Failure& failure) {
  return text_of({{"ok", false}, {"error", operations::failure_json(failure)}});
}

Reply failed(const Failure& failure) { return data(status_of(failure.code), failed_text(failure)); }

Failure busy() {
  return {ErrorCode::unsupported, "the server has too much to do", "ask again in a moment", ""};
}

Reply too_busy() {
  Reply reply = data(503, failed_text(busy()));
  reply.headers.emplace_back("Retry-After", "1");
  return reply;
}

std::string answer_text(const Result<json>& result) {
  if (!result) return failed_text(result.error());
  return text_of({{"ok", true}, {"result", *result}});
}

Reply answer(const Result<json>& result) {
  if (!result) return failed(result.error());
  return data(200, answer_text(result));
}

Result<json> request_in(const std::string& body) {
  auto request = operations::parse_request(body);
  if (request && !request->is_object())
    return core::fail(ErrorCode::bad_input, "the request is not a JSON object",
                      "give the operation's fields");
  return request;
}

std::string operation_list() {
  json list = json::array();
  for (const Operation& o : operations::operations())
    list.push_back({{"name", o.name},
                    {"summary", o.summary},
                    {"long_running", o.long_running},
                    {"reads_files", o.reads_files},
                    {"writes_files", o.writes_files}});
  return text_of({{"operations", list}});
}

/// The value of a name in "a=b&c=d", escapes undone.
std::string query_value(const std::string& query, const std::string& name) {
  std::string all = "&" + query;
  const std::size_t at = all.find("&" + name + "=");
  if (at == std::string::npos) return "";
  const std::size_t from = at + name.size() + 2;
  const std::string raw = all.substr(from, all.find('&', from) - from);
  std::string value;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const auto code = raw[i] == '%' && i + 2 < raw.size()
                          ? core::parse_whole<unsigned char>(raw.substr(i + 1, 2), 16)
                          : std::nullopt;
    if (code) {
      value += static_cast<char>(*code);
      i += 2;
    } else {
      value += raw[i] == '+' ? ' ' : raw[i];
    }
  }
  return value;
}

/// Curves and surfaces as one file; pictures and pages where the extension means one, of what
/// "report" tells where that is there.
Result<operations::WrittenFile> written_as(const std::string& file, json request,
                                           const Folder& folder,
                                           const operations::Context& context) {
  request["file"] = file;
  const json told = request.value("report", json());
  request.erase("report");
  auto output = presentation::output_of(std::move(request));
  if (!output) return std::unexpected(std::move(output.error()));
  presentation::ReportOptions options;
  options.title = "Keyline Studio";
  options.unit = output->document.unit;
  options.generator = std::string("Keyline ") + core::version();
  Result<presentation::Pages> pages = presentation::document_pages(output->document, options);
  if (!told.is_null()) {
    options.title = "";
    pages = report_pages(told, folder, options, context);
  }
  if (!pages) return std::unexpected(std::move(pages.error()));
  auto answer = presentation::write_files({file}, *pages, *output);
  if (!answer) return std::unexpected(std::move(answer.error()));
  return answer->written.at(0);
}

constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
    "connect-src 'self'; font-src 'self'; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'";

std::string type_of(const fs::path& file) {
  const std::string extension = file.extension().string();
  if (extension == ".html") return "text/html; charset=utf-8";
  if (extension == ".js") return "text/javascript; charset=utf-8";
  if (extension == ".css") return "text/css; charset=utf-8";
  if (extension == ".svg") return "image/svg+xml";
  return "application/octet-stream";
}

/// The whole page in memory: nothing a request says leads to a file.
std::map<std::string, Reply> assets_in(const fs::path& folder) {
  std::map<std::string, Reply> assets;
  std::error_code none;
  for (const auto& entry : fs::recursive_directory_iterator(folder, none)) {
    if (!entry.is_regular_file()) continue;
    Reply reply{200, type_of(entry.path()), contents(entry.path()), {}};
    reply.headers = {{"Content-Security-Policy", kPolicy},
                     {"X-Content-Type-Options", "nosniff"},
                     {"Referrer-Policy", "no-referrer"},
                     {"Cross-Origin-Opener-Policy", "same-origin"},
                     {"Cross-Origin-Resource-Policy", "same-origin"},
                     {"Cache-Control", "no-cache"}};
    assets.emplace("/" + fs::relative(entry.path(), folder).generic_string(), std::move(reply));
  }
  return assets;
}

}  // namespace

Studio::Studio(Settings settings)
    : settings_(std::move(settings)),
      folder_(settings_.root, settings_.files),
      recovery_(settings_.recovery),
      assets_(assets_in(settings_.page)),
      hand_(settings_.hands, kMostWaiting, false),
      work_(settings_.long_works, kMostLong, true) {}

Studio::~Studio() { stop(); }

void Studio::stop() {
  const std::scoped_lock lock(mutex_);
  for (const auto& [name, token] : jobs_) token.request_stop();
}

void Studio::serve(const RequestHead& head, std::string body,
                   const std::shared_ptr<Responder>& back) {
  if (!head.path.starts_with(kApi)) return send_asset(head.path, *back);
  const std::string name = head.path.substr(std::string(kApi).size());
  if (head.method == "GET") {
    if (name == "operations") return back->reply(data(200, operation_list()));
    if (name == "openapi.json")
      return back->reply(data(200, text_of(operations::openapi_document())));
    if (name == "studio/session") return back->reply(data(200, session()));
    if (name == "studio/recovery") return back->reply(data(200, recovery_.kept()));
    if (name == "studio/file") return send_given(head, *back);
    return back->reply(failed({ErrorCode::unsupported, "there is nothing at " + head.path,
                               "GET /api/v1/operations lists what can be asked", ""}));
  }
  if (name == "cancel") return cancel(body, *back);
  if (name == "studio/upload") return upload(head, body, *back);
  if (name == "studio/export") return export_document(head, std::move(body), back);
  if (name == "studio/recovery") {
    const auto kept = recovery_.keep(body);
    return back->reply(kept ? data(200, R"({"ok":true})") : failed(kept.error()));
  }
  perform(name, head, std::move(body), back);
}

void Studio::perform(const std::string& name, const RequestHead& head, std::string body,
                     const std::shared_ptr<Responder>& back) {
  const Operation* operation = operations::find_operation(name);
  if (!operation)
    return back->reply(failed({ErrorCode::unsupported, "there is no operation \"" + name + "\"",
                               "GET /api/v1/operations lists them", "op"}));
  if (!head.content_type.starts_with("application/json"))
    return back->reply(failed(
        {ErrorCode::bad_input, "a request is application/json", "set the Content-Type", ""}));
  if (operation->long_running) return perform_long(*operation, head, std::move(body), back);
  const bool taken = hand_.take([this, operation, body = std::move(body), back] {
    auto request = request_in(body);
    if (!request) return back->reply(failed(request.error()));
    if (auto inside = folder_.confine(*operation, *request); !inside)
      return back->reply(failed(inside.error()));
    back->reply(answer(operations::perform(operation->name, *request, {1, {}})));
  });
  if (!taken) back->reply(too_busy());
}

void Studio::perform_long(const Operation& operation, const RequestHead& head, std::string body,
                          const std::shared_ptr<Responder>& back) {
  const bool told = head.accept.find("text/event-stream") != std::string::npos;
  const core::CancellationToken token = back->gone();
  std::string job = head.job;
  {
    const std::scoped_lock lock(mutex_);
    if (job.empty()) job = "unnamed " + std::to_string(unnamed_++);
    jobs_.insert_or_assign(job, token);
    if (std::erase(ended_early_, job) > 0) token.request_stop();
  }
  const auto work = [this, &operation, told, token, job, body = std::move(body), back] {
    core::Progress progress{nullptr, token};
    if (told)
      progress.sink = [&back](double fraction, std::string_view doing) {
        back->event("progress", text_of({{"fraction", fraction}, {"doing", doing}}));
      };
    Result<json> result = request_in(body);
    if (result)
      if (auto inside = folder_.confine(operation, *result); !inside)
        result = std::unexpected(inside.error());
    if (result)
      result = operations::perform(operation.name, *result, {settings_.threads, progress});
    forget(job);
    if (!told) return back->reply(answer(result));
    back->event("answer", answer_text(result));
    back->end();
  };
  if (work_.take(work)) return;
  forget(job);
  back->reply(too_busy());
}

void Studio::forget(const std::string& job) {
  const std::scoped_lock lock(mutex_);
  jobs_.erase(job);
}

void Studio::cancel(const std::string& body, Responder& back) {
  const auto request = request_in(body);
  if (!request) return back.reply(failed(request.error()));
  const auto job = request->find("job");
  const std::string name = job != request->end() && job->is_string() ? job->get<std::string>() : "";
  const std::scoped_lock lock(mutex_);
  const auto at = jobs_.find(name);
  if (at != jobs_.end())
    at->second.request_stop();
  else if (!name.empty())
    ended_early_.push_back(name);
  if (ended_early_.size() > kEndedEarly) ended_early_.pop_front();
  back.reply(data(200, text_of({{"ok", true}, {"found", at != jobs_.end()}})));
}

void Studio::message(const std::string& line, const std::function<void(std::string)>& answer) {
  const auto work = [this, line, answer] {
    auto request = request_in(line);
    if (!request) return answer(operations::failed_line(line, request.error()));
    const Operation* operation = operations::find_operation(
        request->value("op", json("")).is_string() ? request->value("op", "") : "");
    if (operation && operation->long_running)
      return answer(operations::failed_line(
          line, {ErrorCode::unsupported, "this may take long", "POST it", "op"}));
    if (operation)
      if (auto inside = folder_.confine(*operation, *request); !inside)
        return answer(operations::failed_line(line, inside.error()));
    answer(text_of(operations::answer(*request, {1, {}})));
  };
  if (!hand_.take(work)) answer(operations::failed_line(line, busy()));
}

void Studio::upload(const RequestHead& head, const std::string& body, Responder& back) {
  const std::string name = plain_name(query_value(head.query, "name"));
  const fs::path folder = scratch_.file(std::to_string(uploads_++));
  std::error_code failed_to;
  fs::create_directory(folder, failed_to);
  const auto kept = Recovery(folder / name).keep(body);
  if (!kept) return back.reply(failed(kept.error()));
  folder_.allow(folder / name);
  back.reply(data(200, text_of({{"ok", true}, {"file", (folder / name).string()}})));
}

void Studio::send_given(const RequestHead& head, Responder& back) const {
  const std::string name = query_value(head.query, "name");
  const auto place = folder_.place_of(name);
  if (!place) return back.reply(failed(place.error()));
  if (!folder_.is_named(*place))
    return back.reply(failed({ErrorCode::bad_input, "the studio was not given this file",
                              "start it with the file, or upload it", name}));
  std::error_code unknown;
  if (!(fs::file_size(*place, unknown) <= kLargestSent) || unknown)
    return back.reply(failed({ErrorCode::bad_input, "the file is no file, or too large to be sent",
                              "files of up to 64 MB are", name}));
  Reply reply = data(200, contents(*place));
  reply.type = "application/octet-stream";
  back.reply(std::move(reply));
}

void Studio::export_document(const RequestHead& head, std::string body,
                             const std::shared_ptr<Responder>& back) {
  const auto work = [this, body = std::move(body), back] {
    auto request = request_in(body);
    if (!request) return back->reply(failed(request.error()));
    const auto named = request->find("file");
    if (named == request->end() || !named->is_string())
      return back->reply(failed({ErrorCode::bad_input, "\"file\" is missing",
                                 "name the file; its extension chooses the format", "file"}));
    const Scratch scratch;
    const fs::path file = scratch.file(plain_name(named->get<std::string>()));
    const operations::Context context{settings_.threads, {nullptr, back->gone()}};
    const auto written = written_as(file.string(), std::move(*request), folder_, context);
    if (!written) return back->reply(failed(written.error()));
    const json deviation = written->deviation;
    const json notes = written->notes;
    Reply reply = data(200, contents(file));
    reply.type = "application/octet-stream";
    reply.headers.emplace_back("Keyline-Deviation", text_of(deviation));
    reply.headers.emplace_back("Keyline-Notes",
                               notes.dump(-1, ' ', true, json::error_handler_t::replace));
    back->reply(std::move(reply));
  };
  Lane& lane =
      query_value(head.query, "report").empty() ? hand_ : work_;  // reports take their time
  if (!lane.take(work)) back->reply(too_busy());
}

void Studio::send_asset(const std::string& path, Responder& back) const {
  const auto asset = assets_.find(path == "/" ? "/index.html" : path);
  if (asset != assets_.end()) return back.reply(asset->second);
  back.reply({404, "text/plain; charset=utf-8", "there is no such page\n", {}});
}

std::string Studio::session() const {
  return text_of({{"version", core::version()},
                  {"folder", folder_.root().string()},
                  {"files", settings_.files},
                  {"kept", !recovery_.kept().empty()}});
}

}  // namespace keyline::studio
