#include "folder.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include <nlohmann/json.hpp>

namespace keyline::studio {

namespace fs = std::filesystem;
using core::ErrorCode;
using core::Result;
using nlohmann::json;

namespace {

fs::path resolved(const fs::path& path) {
  std::error_code failed;
  const fs::path whole = fs::weakly_canonical(fs::absolute(path), failed);
  return failed ? fs::path() : whole;
}

bool is_inside(const fs::path& path, const fs::path& root) {
  const auto [left, right] = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
  return left == root.end() && right != path.end();
}

/// Whether requests have a field of this name.
bool may_name(const operations::Operation& operation, std::string_view wanted) {
  bool found = false;
  core::visit_fields(*operation.request, operation.request->make().get(),
                     [&](const core::Field& field, void*) { found |= field.name == wanted; });
  return found;
}

}  // namespace

Folder::Folder(const fs::path& root, const std::vector<std::string>& named)
    : root_(resolved(root)) {
  for (const std::string& file : named) named_.push_back(resolved(file));
}

void Folder::allow(const fs::path& file) {
  const std::scoped_lock lock(mutex_);
  named_.push_back(resolved(file));
}

bool Folder::is_named(const fs::path& place) const {
  const std::scoped_lock lock(mutex_);
  return std::ranges::find(named_, place) != named_.end();
}

Result<std::string> Folder::place_of(const std::string& name) const {
  const bool plain = !name.empty() && name.find('\0') == std::string::npos;
  const fs::path place = plain ? resolved(root_ / name) : fs::path();
  if (!place.empty() && (is_named(place) || is_inside(place, root_))) return place.string();
  return core::fail(ErrorCode::bad_input, "the file is outside the folder the studio works in",
                    "start keyline studio in the folder that holds it", name);
}

Result<void> Folder::confine(const operations::Operation& operation, json& request) const {
  if (!operation.reads_files && !operation.writes_files) return {};
  const auto place = [this](json& name) -> Result<void> {
    if (!name.is_string()) return {};  // the operation says what is wrong with it
    auto found = place_of(name.get<std::string>());
    if (!found) return std::unexpected(std::move(found.error()));
    name = *found;
    return {};
  };
  for (const char* field : {"file", "library"}) {
    const auto at = request.find(field);
    if (at == request.end()) continue;
    if (!at->is_array()) {
      if (auto done = place(*at); !done) return done;
      continue;
    }
    for (json& name : *at)
      if (auto done = place(name); !done) return done;
  }
  if (may_name(operation, "library") && !request.contains("library"))
    return core::fail(ErrorCode::unsupported, "the studio keeps to its folder",
                      "name a library inside it", "library");
  return {};
}

Scratch::Scratch() {
  std::string pattern = (fs::temp_directory_path() / "keyline-studio-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr)
    throw std::runtime_error("no folder can be made in " + fs::temp_directory_path().string());
  folder_ = pattern;
}

Scratch::~Scratch() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::string plain_name(const std::string& name) {
  std::string plain = fs::path(name).filename().string();
  std::erase_if(plain, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  while (plain.starts_with('.')) plain.erase(0, 1);
  constexpr std::size_t kLongest = 120;
  if (plain.size() > kLongest) plain.erase(0, plain.size() - kLongest);
  return plain.empty() ? "file" : plain;
}

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace keyline::studio
