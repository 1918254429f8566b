#pragma once

#include <string>
#include <string_view>

namespace keyline::core {

/// Text fit for element content and quoted attributes of XML and HTML: &, <, >, ", ' and carriage
/// returns as references; other control characters but line feeds and tabs, and all but ASCII of
/// text that is no UTF-8, as "?".
std::string escape_markup(std::string_view text);

}  // namespace keyline::core
