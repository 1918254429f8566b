#pragma once

#include <string>
#include <vector>

#include "http.h"

/// Who may ask what: no page of another site, no name that was bent to this address, nobody
/// without the token that this start printed.
namespace keyline::studio {

struct Access {
  std::vector<std::string> hosts;  ///< "127.0.0.1:8080", …: what Host and Origin may name
  std::string token;               ///< of at least 16 characters
};

inline constexpr const char* kApi = "/api/v1/";

/// Empty reason: the request may be served. The page itself needs no token: there is nothing in it.
Refusal refusal(const Access& access, const RequestHead& head);

/// A token nobody guesses: 32 hexadecimal digits from the system's random source.
std::string make_token();

/// Names under which a server on that address and port is reached from this machine, and others
/// it was told.
std::vector<std::string> host_names(const std::string& address, unsigned short port,
                                    const std::vector<std::string>& further);

}  // namespace keyline::studio
