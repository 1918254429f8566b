#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "folder.h"
#include "http.h"
#include "lanes.h"
#include "recovery.h"

/// The operations and the page behind HTTP. Every call stands for itself: what is asked for is all
/// in the request, so that any of several servers can answer it.
namespace keyline::studio {

struct Settings {
  std::filesystem::path root;      ///< the folder whose files may be read and written
  std::filesystem::path page;      ///< the built page
  std::filesystem::path recovery;  ///< the file that keeps what was being worked on
  std::vector<std::string> files;  ///< to open, as they were named at the start
  int threads = 1;                 ///< a long work may use
  int hands = 2;                   ///< threads for what is answered at once
  int long_works = 1;              ///< at a time
};

class Studio {
 public:
  explicit Studio(Settings settings);
  ~Studio();

  void serve(const RequestHead& head, std::string body, const std::shared_ptr<Responder>& back);
  /// One line of `keyline batch`, for operations that are answered at once.
  void message(const std::string& line, const std::function<void(std::string)>& answer);

  /// Long works are told to end.
  void stop();

 private:
  void perform(const std::string& name, const RequestHead& head, std::string body,
               const std::shared_ptr<Responder>& back);
  void perform_long(const operations::Operation& operation, const RequestHead& head,
                    std::string body, const std::shared_ptr<Responder>& back);
  void forget(const std::string& job);
  void cancel(const std::string& body, Responder& back);
  void upload(const RequestHead& head, const std::string& body, Responder& back);
  void export_document(const RequestHead& head, std::string body,
                       const std::shared_ptr<Responder>& back);
  /// A file that was named at the start or uploaded.
  void send_given(const RequestHead& head, Responder& back) const;
  void send_asset(const std::string& path, Responder& back) const;
  std::string session() const;

  Settings settings_;
  Folder folder_;
  Scratch scratch_;
  Recovery recovery_;
  std::map<std::string, Reply> assets_;
  std::mutex mutex_;
  std::map<std::string, core::CancellationToken> jobs_;  ///< by their names
  std::deque<std::string> ended_early_;                  ///< cancelled before they came
  std::uint64_t unnamed_ = 0;
  std::size_t uploads_ = 0;
  Lane hand_;
  Lane work_;
};

}  // namespace keyline::studio
