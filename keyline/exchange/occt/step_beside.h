#pragma once

#include <string>
#include <vector>

namespace opencascade {
template <class T>
class handle;
}
class XSControl_WorkSession;

namespace keyline::exchange::occt {

/// Says how many entities that became shapes a STEP file has not to be seen (ISO 10303-46,
/// invisibility), by layer.
void tell_step_beside(const opencascade::handle<XSControl_WorkSession>& session,
                      std::vector<std::string>& lines);

}  // namespace keyline::exchange::occt
