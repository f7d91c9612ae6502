// SPDX-License-Identifier: MIT
/// \file
/// What a request must be before it is answered. A page of another origin, or a name that another machine has pointed to this one (DNS
/// rebinding), may send requests to this computer, but not with the right Host, Origin and token.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace risorius::serve {

/// A file of the page, in memory.
struct PageFile {
    std::string type;  ///< "text/html; charset=utf-8"
    std::string bytes;
};
/// By the target of the request, "/" or "/page.js". Nothing else is served: there is no path that could lead out of a folder.
using Page = std::map<std::string, PageFile, std::less<>>;

inline constexpr std::string_view kSocketTarget = "/socket";

/// What a request says about itself; a header that is missing is empty.
struct RequestHead {
    std::string_view method, target, host, origin;
    bool upgrade = false;     ///< it asks for a WebSocket
    bool one_of_each = true;  ///< Host and Origin are given once at most
};

enum class Answer {
    kFile,
    kSocket,
    kForbidden,   ///< 403: not from this page
    kNotFound,    ///< 404
    kNotAllowed,  ///< 405: another method than GET and HEAD
};

/// Compares whole strings: "127.0.0.1:80801" and "localhost:8080.example" are not port 8080 of this computer.
Answer answer_to(const RequestHead& request, int port, const Page& page);

/// Compares in a time that depends on the length of `given` only.
bool same_token(std::string_view token, std::string_view given);

/// 128 random bits from the system as 32 digits.
std::string new_token();

/// Reads the files of the page from a folder. Throws Error when one is missing.
Page read_page(const std::string& folder);

/// The headers that keep a page from loading anything from elsewhere, or from being shown in another page.
extern const char* const kContentPolicy;

}  // namespace risorius::serve
