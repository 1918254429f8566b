#include "keyline/exchange/dxf/dxf_names.h"

#include <algorithm>
#include <set>
#include <utility>

#include "keyline/core/text.h"
#include "keyline/exchange/dxf/dxf_frame.h"
#include "keyline/exchange/dxf/dxf_tags.h"
#include "keyline/exchange/text/ascii.h"

namespace keyline::exchange::detail {
namespace {

/// As a reader finds it.
std::string read_back(const std::string& written) { return text_of({.text = written}); }

/// Names of one table.
class Names {
 public:
  explicit Names(const char* first) : in_use_{first} {}

  bool has(const std::string& name) const { return in_use_.contains(lower_case(name)); }

  /// The name, or the first of "name_2", "name_3" … that is not taken.
  std::string take(const std::string& name) {
    if (in_use_.insert(lower_case(name)).second) return name;
    int& number = last_.try_emplace(lower_case(name), 1).first->second;
    std::string free;
    do free = name + '_' + std::to_string(++number);
    while (!in_use_.insert(lower_case(free)).second);
    return free;
  }

 private:
  std::set<std::string> in_use_;
  std::map<std::string, int> last_;  ///< number behind a name
};

using Renamed = std::vector<std::pair<std::string, std::string>>;

void tell(std::vector<std::string>& notes, const Renamed& renamed, const char* one,
          const char* more) {
  constexpr std::size_t kTold = 3;
  if (renamed.empty()) return;
  std::string note = "called otherwise in the file: " + core::counted(renamed.size(), one, more);
  for (std::size_t i = 0; i < std::min(kTold, renamed.size()); ++i)
    note += std::string(", \"") + core::on_one_line(renamed[i].first) + "\" as \"" +
            renamed[i].second + '"';
  notes.push_back(note + (renamed.size() > kTold ? " and others" : ""));
}

}  // namespace

std::map<std::string, std::string> dxf_layers(const document::Document& document) {
  std::map<std::string, std::string> layers{{"", "0"}, {"0", "0"}};
  Names names("0");
  std::vector<std::string> others;
  for (const document::Label& label : labels(document)) {
    if (layers.contains(label.layer)) continue;
    const std::string name = dxf_name(label.layer);
    const bool fits = read_back(name) == label.layer && !names.has(name);
    if (!fits) others.push_back(label.layer);
    if (fits) layers.emplace(label.layer, names.take(name));
  }
  for (const std::string& layer : others)
    if (!layers.contains(layer)) layers.emplace(layer, names.take(dxf_name(layer)));
  return layers;
}

std::vector<std::string> changed_names(const document::Document& document,
                                       const std::map<std::string, std::string>& layers) {
  Renamed of_layers, of_curves;
  for (const auto& [layer, name] : layers)
    if (!layer.empty() && read_back(name) != layer) of_layers.emplace_back(layer, read_back(name));
  for (const document::Label& label : labels(document))
    if (const std::string name = read_back(dxf_text(label.name)); name != label.name)
      of_curves.emplace_back(label.name, name);
  std::vector<std::string> notes;
  tell(notes, of_layers, "layer", "layers");
  tell(notes, of_curves, "curve", "curves");
  return notes;
}

}  // namespace keyline::exchange::detail
