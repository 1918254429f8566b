#include "keyline/exchange/file/read_file.h"

#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

#include "keyline/exchange/text/utf16.h"

namespace keyline::exchange {

namespace fs = std::filesystem;
using core::ErrorCode;
using core::fail;
using core::Result;

core::Failure in_file(core::Failure failure, const std::string& file) {
  if (failure.path.starts_with(file)) return failure;
  const bool line = failure.path.starts_with("line ");
  if (line)
    failure.path = file + ":" + failure.path.substr(5);
  else
    failure.path = failure.path.empty() ? file : file + ": " + failure.path;
  return failure;
}

Result<std::ifstream> open_file(const fs::path& file) {
  std::error_code error;
  if (fs::is_directory(file, error))
    return fail(ErrorCode::io, "is a directory", "name a file", file.string());
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in)
    return fail(ErrorCode::io,
                "cannot be opened: " + std::generic_category().message(errno == 0 ? EIO : errno),
                "check the name and the rights", file.string());
  return in;
}

Result<std::string> head_of(const fs::path& file) {
  auto in = open_file(file);
  if (!in) return std::unexpected(in.error());
  std::string head(kHead, '\0');
  in->read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in->gcount()));
  return head;
}

Result<std::string> read_file(const fs::path& file, std::uintmax_t largest) {
  auto in = open_file(file);
  if (!in) return std::unexpected(in.error());
  std::string content;
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  const auto too_large = [&] {
    return fail(ErrorCode::bad_input,
                "the file is larger than " + std::to_string(largest >> 20) + " MB", "split it",
                file.string());
  };
  if (!error && size > largest) return too_large();  // before anything is read, holes and all
  if (!error) content.reserve(size);
  std::string chunk(std::size_t{1} << 20, '\0');
  while (in->read(chunk.data(), static_cast<std::streamsize>(chunk.size())), in->gcount() > 0) {
    content.append(chunk.data(), static_cast<std::size_t>(in->gcount()));
    if (content.size() > largest) return too_large();
  }
  if (in->bad())
    return fail(ErrorCode::io, "reading failed", "check the device or the network", file.string());
  return detail::in_utf8(std::move(content));
}

}  // namespace keyline::exchange
