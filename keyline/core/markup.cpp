#include "keyline/core/markup.h"

#include "keyline/core/utf8.h"

namespace keyline::core {

std::string escape_markup(std::string_view text) {
  const bool ascii_only = !is_utf8(text);
  std::string safe;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool control = (byte < 0x20 && c != '\n' && c != '\t' && c != '\r') || byte == 0x7f;
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '"')
      safe += "&quot;";
    else if (c == '\'')
      safe += "&#39;";
    else if (c == '\r')
      safe += "&#13;";
    else if (control || (ascii_only && byte >= 0x80))
      safe += '?';
    else
      safe += c;
  }
  return safe;
}

}  // namespace keyline::core
