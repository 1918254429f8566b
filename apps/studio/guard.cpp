#include "guard.h"

#include <algorithm>
#include <random>

namespace keyline::studio {
namespace {

/// Takes as long for a wrong token as for a nearly right one.
bool same(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  unsigned differs = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    differs |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return differs == 0;
}

/// Browsers give a socket no header but its protocols: "keyline.v1, token.<token>".
std::string token_of(const RequestHead& head) {
  constexpr std::string_view kBearer = "Bearer ";
  if (head.authorization.starts_with(kBearer)) return head.authorization.substr(kBearer.size());
  constexpr std::string_view kProtocol = "token.";
  const std::size_t at = head.protocols.find(kProtocol);
  if (at == std::string::npos) return "";
  const std::size_t from = at + kProtocol.size();
  return head.protocols.substr(from, head.protocols.find_first_of(", ", from) - from);
}

bool is_known(const Access& access, const std::string& host) {
  return std::ranges::find(access.hosts, host) != access.hosts.end();
}

bool is_own_origin(const Access& access, const std::string& origin) {
  constexpr std::string_view kSchemes[] = {"http://", "https://"};
  return std::ranges::any_of(kSchemes, [&](std::string_view scheme) {
    return origin.starts_with(scheme) && is_known(access, origin.substr(scheme.size()));
  });
}

}  // namespace

Refusal refusal(const Access& access, const RequestHead& head) {
  if (!is_known(access, head.host)) return {421, "this is not the host \"" + head.host + "\""};
  if (!head.origin.empty() && !is_own_origin(access, head.origin))
    return {403, "pages of " + head.origin + " may not ask"};
  if (!head.fetch_site.empty() && head.fetch_site != "same-origin" && head.fetch_site != "none")
    return {403, "asked from another site"};
  if (head.method != "GET" && head.method != "POST")
    return {405, "only GET and POST are understood"};
  if (!head.path.starts_with(kApi)) {
    if (head.method != "GET") return {405, "the page is only read"};
    return {0, ""};
  }
  if (!same(token_of(head), access.token)) return {401, "the token is missing or wrong"};
  return {0, ""};
}

std::string make_token() {
  std::random_device random;
  std::string token;
  for (int i = 0; i < 32; ++i) token += "0123456789abcdef"[random() & 15];
  return token;
}

std::vector<std::string> host_names(const std::string& address, unsigned short port,
                                    const std::vector<std::string>& further) {
  const std::string behind = ":" + std::to_string(port);
  std::vector<std::string> names;
  const bool here =
      address == "127.0.0.1" || address == "::1" || address == "0.0.0.0" || address == "::";
  if (here)
    for (const char* name : {"127.0.0.1", "localhost", "[::1]"}) names.push_back(name + behind);
  else
    names.push_back((address.find(':') == std::string::npos ? address : "[" + address + "]") +
                    behind);
  for (const std::string& name : further) {
    names.push_back(name);
    names.push_back(name + behind);
  }
  return names;
}

}  // namespace keyline::studio
